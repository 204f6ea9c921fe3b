//! Perception, object by object: time to collision, valid obstacles, warnings, what may be permitted, and the merge of
//! several (TTC, MIT, FUS-3, FCW, PCW). With the merge, one object and the empty list stand for every list: a list is
//! folded by it.

use supervisor_core::{
    Alert, Closing, ClosingCmS, Config, DecelMs2Q11, DistanceCm, Level, Millis, Object, OffsetCm, Threat, kernel,
};
use supervisor_perceive::{
    Assessment, CameraObject, Class, RadarObject, Worst, camera_object, merge, moved, radar_object, reached,
    reached_or_equal,
};

use super::implies;

/// One radar object, what the camera says of it, and what was made of it.
#[derive(Clone, Copy, Debug)]
pub struct Sight<'a> {
    /// The object.
    pub object: &'a RadarObject,
    /// The class of the camera's object that it matches.
    pub class: Option<Class>,
    /// Configuration.
    pub config: &'a Config,
    /// The assessment.
    pub assessed: Assessment,
    /// How far it is now.
    distance: DistanceCm,
}

/// A property of one radar object.
pub type Holds = fn(&Sight<'_>) -> bool;

/// Every property of one radar object, by its name.
pub const ALL: &[(&str, Holds)] = &[
    ("mit_1_level_is_that_of_the_time", mit_1_level_is_that_of_the_time),
    ("fus_3c_only_a_valid_obstacle_obliges", fus_3c_only_a_valid_obstacle_obliges),
    ("fus_3e_one_corridor", fus_3e_one_corridor),
    ("fcw_1_forward_warning", fcw_1_forward_warning),
    ("pcw_1_pedestrian_warning", pcw_1_pedestrian_warning),
    ("fus_3d_any_object_permits", fus_3d_any_object_permits),
    ("fus_3d_any_object_permits_by_need", fus_3d_any_object_permits_by_need),
    ("mit_8b_disagreement_is_reported", mit_8b_disagreement_is_reported),
    ("mit_6c_required_is_exact", mit_6c_required_is_exact),
];

impl<'a> Sight<'a> {
    /// Assesses an object as [`perceive`](supervisor_perceive::perceive) does.
    #[must_use]
    pub fn of(object: &'a RadarObject, class: Option<Class>, config: &'a Config) -> Self {
        let distance = moved(object.distance, object.closing, object.age, Millis::ZERO);
        Self { object, class, config, assessed: radar_object(object, class, config), distance }
    }
    fn closes(&self) -> bool {
        self.object.closing > ClosingCmS::ZERO
    }
    /// T < `limit`; the next harness says what that means.
    fn nearer(&self, limit: Millis) -> bool {
        reached(self.distance, self.object.closing, limit)
    }
    /// T ≤ `limit`.
    fn not_farther(&self, limit: Millis) -> bool {
        reached_or_equal(self.distance, self.object.closing, limit)
    }
    fn in_corridor(&self) -> bool {
        magnitude(self.object.offset) <= magnitude(self.config.corridor)
    }
    /// Matched, or the same object over enough updates.
    fn certain(&self) -> bool {
        self.class.is_some() || self.object.updates.raw() >= self.config.consistent_updates.raw()
    }
    /// FUS-3c: a valid obstacle.
    #[must_use]
    pub fn valid(&self) -> bool {
        self.in_corridor() && self.certain()
    }
}

fn magnitude(offset: OffsetCm) -> i32 {
    i32::from(offset.raw()).abs()
}

/// TTC-1a, TTC-1b, TTC-1c: T < `limit` exactly when distance / closing speed < `limit`, and T ≤ `limit` likewise, in products that no
/// value can make overflow; what is not closing has no T.
#[must_use]
pub fn ttc_1_products_are_exact(distance: DistanceCm, closing: ClosingCmS, limit: Millis) -> bool {
    let Ok(speed) = u16::try_from(closing.raw()) else {
        return !reached(distance, closing, limit) && !reached_or_equal(distance, closing, limit);
    };
    let way = u64::from(distance.raw()) * 1000;
    let reach = u64::from(limit.raw()) * u64::from(speed);
    reached(distance, closing, limit) == (way < reach)
        && reached_or_equal(distance, closing, limit) == (speed > 0 && way <= reach)
}

/// TTC-1b, TTC-1c: what is not closing has no T; T < `limit` and T ≤ `limit` are the two comparisons of products, whatever they give.
#[must_use]
pub fn ttc_1_only_what_closes_has_a_time(distance: DistanceCm, closing: ClosingCmS, limit: Millis) -> bool {
    let (below, at_most) = (reached(distance, closing, limit), reached_or_equal(distance, closing, limit));
    let Ok(speed) = u16::try_from(closing.raw()) else { return !below && !at_most };
    below == kernel::nearer_than(distance.raw(), speed, limit.raw())
        && at_most == (speed > 0 && !kernel::farther_than(distance.raw(), speed, limit.raw()))
}

/// FUS-1a: where the object is now, rounded to the nearer centimetre: the way that it closed in its age is taken off; never below
/// 0, at most 655.35 m. An age beyond 32.767 s counts as that.
#[must_use]
pub fn fus_1a_moved_is_exact(distance: DistanceCm, closing: ClosingCmS, age: Millis) -> bool {
    let whole = i32::from(u16::try_from(age.raw()).unwrap_or(u16::MAX).min(32_767));
    let way = (i32::from(distance.raw()) * 1000 - i32::from(closing.raw()) * whole).max(0);
    let now = i32::from(moved(distance, closing, age, Millis::ZERO).raw());
    now * 1000 <= way && (way - now * 1000 < 1000 || now == 65_535)
}

/// MIT-1a, MIT-2a, MIT-3a, TTC-1b, MIT-8c: the level of a valid obstacle is that of its time to collision and of nothing else: T < 4.4 s,
/// T ≤ 3.6 s, T ≤ 2.7 s, the most severe that holds; the second opinion obliges no level.
#[must_use]
pub fn mit_1_level_is_that_of_the_time(sight: &Sight<'_>) -> bool {
    let [one, two, three] = sight.config.level_ttc.0;
    let valid = sight.valid();
    let (third, second, first) = (sight.not_farther(three), sight.not_farther(two), sight.nearer(one));
    let level = sight.assessed.level;
    (level == Level::Three) == (valid && third)
        && (level == Level::Two) == (valid && second && !third)
        && (level == Level::One) == (valid && first && !second && !third)
        && implies(!sight.closes(), level == Level::None)
}

/// FUS-3c: only what is valid obliges anything, and everything that is valid is named as it is now.
#[must_use]
pub fn fus_3c_only_a_valid_obstacle_obliges(sight: &Sight<'_>) -> bool {
    let Assessment { level, required, disagreement, worst, .. } = sight.assessed;
    let RadarObject { offset, closing, .. } = *sight.object;
    let named = Worst { level, required, object: Object { distance: sight.distance, offset, closing } };
    let silent = level == Level::None && required == DecelMs2Q11::ZERO && !disagreement;
    if sight.valid() { worst == Some(named) } else { silent && worst.is_none() }
}

/// FUS-3e: one corridor, its edge included, for the obstacle that is valid and for the object that is closing.
#[must_use]
pub fn fus_3e_one_corridor(sight: &Sight<'_>) -> bool {
    sight.assessed.closing == (sight.in_corridor() && sight.closes())
        && sight.assessed.worst.is_some() == (sight.in_corridor() && sight.certain())
}

/// FCW-1a, FCW-1b: begins with an object beside less than 1.8 m and T < 4.0 s, may end beyond 4.5 s; a pedestrian is none.
#[must_use]
pub fn fcw_1_forward_warning(sight: &Sight<'_>) -> bool {
    let [on, off] = sight.config.forward_ttc.0;
    let concerns = sight.class != Some(Class::Pedestrian)
        && sight.certain()
        && magnitude(sight.object.offset) < magnitude(sight.config.forward_offset);
    sight.assessed.forward_begins == (concerns && sight.nearer(on))
        && sight.assessed.forward_holds == (concerns && sight.not_farther(off))
}

/// PCW-1a, PCW-1b: begins with a pedestrian beside less than 2.0 m and T < 4.2 s, may end beyond 4.5 s.
#[must_use]
pub fn pcw_1_pedestrian_warning(sight: &Sight<'_>) -> bool {
    let [on, off] = sight.config.pedestrian_ttc.0;
    let concerns = sight.class == Some(Class::Pedestrian)
        && magnitude(sight.object.offset) < magnitude(sight.config.pedestrian_offset);
    sight.assessed.pedestrian_begins == (concerns && sight.nearer(on))
        && sight.assessed.pedestrian_holds == (concerns && sight.not_farther(off))
}

/// Gap that is left before the margin.
fn gap(distance: DistanceCm, config: &Config) -> u64 {
    u64::from(distance.raw()).saturating_sub(u64::from(config.gap_margin.raw()))
}

/// v², in the unit in which a deceleration in 1/2048 m/s² times 25 gaps in cm is 2·a·gap; 0 when not closing.
fn square(closing: ClosingCmS) -> u64 {
    let speed = u64::from(u16::try_from(closing.raw()).unwrap_or(0));
    speed * speed * 256
}

/// MIT-8a: v² ≥ 2·a·gap, the deceleration rounded up to the next 1/2048 m/s²; without a gap always.
fn severe(distance: DistanceCm, closing: ClosingCmS, config: &Config) -> bool {
    let Some(below) = u64::from(config.severe_decel.raw()).checked_sub(1) else { return true };
    distance == DistanceCm::ZERO || square(closing) > below * 25 * gap(distance, config)
}

/// What one object of any sensor may permit: mitigation of any level, the full cap.
fn permitted(distance: DistanceCm, closing: ClosingCmS, config: &Config) -> (bool, bool) {
    let severe = severe(distance, closing, config);
    let within = |limit| reached_or_equal(distance, closing, limit);
    (severe || within(config.mitigable_ttc), severe || within(config.emergency_ttc))
}

/// FUS-3d, MIT-8a, MIT-8d: any radar object permits, in the corridor or not, matched or not: by the more severe of T and second opinion.
#[must_use]
pub fn fus_3d_any_object_permits(sight: &Sight<'_>) -> bool {
    let (mitigable, emergency) = permitted(sight.distance, sight.object.closing, sight.config);
    sight.assessed.mitigable == mitigable && sight.assessed.emergency == emergency
}

/// The deceleration that takes away the closing speed before the margin, by its kernel.
fn needed(distance: DistanceCm, closing: ClosingCmS, config: &Config) -> DecelMs2Q11 {
    let gap = distance.raw().saturating_sub(config.gap_margin.raw());
    u16::try_from(closing.raw()).map_or(DecelMs2Q11::ZERO, |speed| DecelMs2Q11::new(kernel::needed(speed, gap)))
}

/// What one object of any sensor may permit, by the deceleration that it needs.
fn permitted_by_need(distance: DistanceCm, closing: ClosingCmS, config: &Config) -> (bool, bool) {
    let severe = needed(distance, closing, config) >= config.severe_decel || distance == DistanceCm::ZERO;
    let within = |limit| reached_or_equal(distance, closing, limit);
    (severe || within(config.mitigable_ttc), severe || within(config.emergency_ttc))
}

/// FUS-3d, MIT-8d, MIT-6c: any radar object permits, in the corridor or not, matched or not, by the deceleration that it needs or by T; a
/// valid one requires that deceleration.
#[must_use]
pub fn fus_3d_any_object_permits_by_need(sight: &Sight<'_>) -> bool {
    let (mitigable, emergency) = permitted_by_need(sight.distance, sight.object.closing, sight.config);
    let required = needed(sight.distance, sight.object.closing, sight.config);
    sight.assessed.mitigable == mitigable
        && sight.assessed.emergency == emergency
        && implies(sight.valid(), sight.assessed.required == required)
}

/// FUS-3d, FUS-3c, MIT-8d: a camera's object alone obliges nothing; it permits as a radar's does.
#[must_use]
pub fn fus_3d_camera_permits_by_need(object: &CameraObject, config: &Config) -> bool {
    let assessed = camera_object(object, config);
    let distance = moved(object.distance, object.closing, object.age, Millis::ZERO);
    let rest = Assessment { mitigable: false, emergency: false, ..assessed };
    let permitted = permitted_by_need(distance, object.closing, config);
    rest == Assessment::NOTHING && (assessed.mitigable, assessed.emergency) == permitted
}

/// MIT-8a, MIT-8d: the same of a valid obstacle, by the deceleration that it requires.
#[must_use]
pub fn mit_8d_more_severe_decides(sight: &Sight<'_>) -> bool {
    let severe = sight.assessed.required >= sight.config.severe_decel || sight.distance == DistanceCm::ZERO;
    let [mitigable, emergency] =
        [sight.config.mitigable_ttc, sight.config.emergency_ttc].map(|limit| severe || sight.not_farther(limit));
    implies(sight.valid(), sight.assessed.mitigable == mitigable && sight.assessed.emergency == emergency)
        // Not valid: at least what T permits.
        && implies(sight.not_farther(sight.config.mitigable_ttc), sight.assessed.mitigable)
        && implies(sight.not_farther(sight.config.emergency_ttc), sight.assessed.emergency)
        && implies(sight.distance == DistanceCm::ZERO, sight.assessed.mitigable && sight.assessed.emergency)
}

/// MIT-8b: severe by one judgement and nothing by the other is reported, and nothing else is.
#[must_use]
pub fn mit_8b_disagreement_is_reported(sight: &Sight<'_>) -> bool {
    let Assessment { level, required, disagreement, .. } = sight.assessed;
    let [mild, ..] = sight.config.level_decel.0;
    let overlooked = required >= sight.config.severe_decel && level == Level::None;
    let exaggerated = required < mild && level == Level::Three;
    disagreement == (sight.valid() && (overlooked || exaggerated))
}

/// MIT-6c: what a valid obstacle requires is the least deceleration with 2·a·(gap − margin) ≥ v²; 0 when it is not closing.
#[must_use]
pub fn mit_6c_required_is_exact(sight: &Sight<'_>) -> bool {
    let (square, gap) = (square(sight.object.closing), gap(sight.distance, sight.config) * 25);
    let required = u64::from(sight.assessed.required.raw());
    let enough = required * gap >= square || required == u64::from(u16::MAX);
    let least = required.checked_sub(1).is_none_or(|less| less * gap < square);
    implies(sight.valid(), enough && least)
}

/// TTC-1a, FUS-3c: nearer and faster is never less severe, as long as all else is equal.
#[must_use]
pub fn ttc_1_level_is_monotone(sight: &Sight<'_>, worse: &Sight<'_>) -> bool {
    let (one, other) = (sight.object, worse.object);
    let nearer_and_faster = other.distance <= one.distance && other.closing >= one.closing;
    let [first, second] = [one, other].map(|object| (object.offset, object.age, object.updates));
    let [one, other] = [sight.assessed, worse.assessed];
    implies(
        nearer_and_faster && first == second && sight.class == worse.class,
        one.level <= other.level && one.closing <= other.closing && one.forward_begins <= other.forward_begins,
    )
}

/// FUS-3d, FUS-3c: a camera's object alone obliges nothing, warns of nothing and names nothing; it permits as a radar's does.
#[must_use]
pub fn fus_3d_camera_only_permits(object: &CameraObject, config: &Config) -> bool {
    let Assessment { mitigable, emergency, .. } = camera_object(object, config);
    let distance = moved(object.distance, object.closing, object.age, Millis::ZERO);
    let rest = Assessment { mitigable: false, emergency: false, ..camera_object(object, config) };
    rest == Assessment::NOTHING && (mitigable, emergency) == permitted(distance, object.closing, config)
}

/// How severe an obstacle is; of equally severe ones the nearer, then the faster, then the one farther left.
fn severity(of: Worst) -> (Level, DecelMs2Q11, i32, ClosingCmS, OffsetCm) {
    let Worst { level, required, object } = of;
    (level, required, -object.distance.wide(), object.closing, object.offset)
}

/// MIT-6a: the merge obliges and permits what either does, and names the object of the more severe, not the nearer one.
#[must_use]
pub fn mit_6a_most_severe_decides(first: Assessment, second: Assessment) -> bool {
    let both = merge(first, second);
    let either = [
        (both.closing, first.closing, second.closing),
        (both.mitigable, first.mitigable, second.mitigable),
        (both.emergency, first.emergency, second.emergency),
        (both.forward_begins, first.forward_begins, second.forward_begins),
        (both.forward_holds, first.forward_holds, second.forward_holds),
        (both.pedestrian_begins, first.pedestrian_begins, second.pedestrian_begins),
        (both.pedestrian_holds, first.pedestrian_holds, second.pedestrian_holds),
        (both.disagreement, first.disagreement, second.disagreement),
    ];
    let [one, other, chosen] = [first, second, both].map(|of| of.worst.map(severity));
    both.level == first.level.max(second.level)
        && both.required == first.required.max(second.required)
        && either.iter().all(|(both, one, other)| *both == (*one || *other))
        && chosen == one.max(other)
}

/// MIT-6a: no order and no repetition in a list changes what it obliges, permits and names.
#[must_use]
pub fn mit_6a_order_does_not_matter(one: Assessment, two: Assessment, three: Assessment) -> bool {
    merge(one, two) == merge(two, one)
        && merge(one, one) == one
        && merge(Assessment::NOTHING, one) == one
        && merge(merge(one, two), three) == merge(one, merge(two, three))
}

/// RULE-1a, FCW-1b, PCW-1b, MIT-6a: what is merged is what the threat says; unknown perception ends no warning and knows of nothing that it is
/// gone.
#[must_use]
pub fn fcw_1_threat_says_what_was_merged(merged: Assessment, known: bool) -> bool {
    let threat = merged.threat(known);
    let warning = |alert: Alert, begins: bool, holds: bool| {
        (alert == Alert::On) == begins && (alert == Alert::Off) == (known && !begins && !holds)
    };
    let kept = Threat { forward: Alert::Keep, pedestrian: Alert::Keep, closing: Closing::Unknown, ..threat };
    let expected = Threat {
        known,
        level: merged.level,
        required: merged.required,
        mitigable: merged.mitigable,
        emergency: merged.emergency,
        disagreement: merged.disagreement,
        object: merged.worst.map(|worst| worst.object),
        ..Threat::UNKNOWN
    };
    kept == expected
        && warning(threat.forward, merged.forward_begins, merged.forward_holds)
        && warning(threat.pedestrian, merged.pedestrian_begins, merged.pedestrian_holds)
        && (threat.closing == Closing::Yes) == merged.closing
        && (threat.closing == Closing::No) == (known && !merged.closing)
}
