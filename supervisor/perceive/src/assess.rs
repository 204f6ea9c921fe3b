//! One object: time to collision, second opinion, and what it may oblige or permit.

use core::cmp::Reverse;

use supervisor_core::kernel::{self, farther_than, nearer_than};
use supervisor_core::{ClosingCmS, Config, DecelMs2Q11, DistanceCm, Level, Millis, Object, OffsetCm};

use crate::scene::{CameraObject, Class, RadarObject};
use crate::time::moved;

/// What one object, or several merged, may oblige and permit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(kani, derive(kani::Arbitrary))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
pub struct Assessment {
    /// Level obliged by a valid obstacle.
    pub level: Level,
    /// An object in the corridor is closing.
    pub closing: bool,
    /// Deceleration a valid obstacle requires.
    pub required: DecelMs2Q11,
    /// Mitigation of any level may be asked for.
    pub mitigable: bool,
    /// The full cap may be used.
    pub emergency: bool,
    /// The forward-collision warning begins.
    pub forward_begins: bool,
    /// The forward-collision warning may not end yet.
    pub forward_holds: bool,
    /// The pedestrian warning begins.
    pub pedestrian_begins: bool,
    /// The pedestrian warning may not end yet.
    pub pedestrian_holds: bool,
    /// Time to collision and second opinion disagree.
    pub disagreement: bool,
    /// The most severe valid obstacle.
    pub worst: Option<Worst>,
}

/// An obstacle, and how severe it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(kani, derive(kani::Arbitrary))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
pub struct Worst {
    /// Level it obliges.
    pub level: Level,
    /// Deceleration it requires.
    pub required: DecelMs2Q11,
    /// Which.
    pub object: Object,
}

impl Assessment {
    /// No object.
    pub const NOTHING: Self = Self {
        level: Level::None,
        closing: false,
        required: DecelMs2Q11::ZERO,
        mitigable: false,
        emergency: false,
        forward_begins: false,
        forward_holds: false,
        pedestrian_begins: false,
        pedestrian_holds: false,
        disagreement: false,
        worst: None,
    };
}

/// TTC-1: T < `limit`. Not closing: no TTC, never.
#[must_use]
pub fn reached(distance: DistanceCm, closing: ClosingCmS, limit: Millis) -> bool {
    u16::try_from(closing.raw()).is_ok_and(|closing| nearer_than(distance.raw(), closing, limit.raw()))
}

/// TTC-1: T ≤ `limit`. Not closing: no TTC, never.
#[must_use]
pub fn reached_or_equal(distance: DistanceCm, closing: ClosingCmS, limit: Millis) -> bool {
    u16::try_from(closing.raw()).is_ok_and(|closing| closing > 0 && !farther_than(distance.raw(), closing, limit.raw()))
}

/// MIT-1 to MIT-3: the level that the time to collision calls for; the equalities are reading b.
fn level(distance: DistanceCm, closing: ClosingCmS, config: &Config) -> Level {
    let [one, two, three] = config.level_ttc.0;
    if reached_or_equal(distance, closing, three) {
        Level::Three
    } else if reached_or_equal(distance, closing, two) {
        Level::Two
    } else if reached(distance, closing, one) {
        Level::One
    } else {
        Level::None
    }
}

/// Deceleration that takes away the closing speed before the margin: v²/(2·(gap − margin)), rounded up.
/// Saturates, also where the margin is used up; 0 when not closing (MIT-6, MIT-8).
fn required(distance: DistanceCm, closing: ClosingCmS, config: &Config) -> DecelMs2Q11 {
    let Ok(closing) = u16::try_from(closing.raw()) else { return DecelMs2Q11::ZERO };
    let gap = distance.raw().saturating_sub(config.gap_margin.raw());
    DecelMs2Q11::new(kernel::needed(closing, gap))
}

fn within(offset: OffsetCm, half: OffsetCm) -> bool {
    offset.raw().unsigned_abs() <= half.raw().unsigned_abs()
}

/// Strictly within: S1 says "less than 1.8 m", "less than 2 m".
fn inside(offset: OffsetCm, half: OffsetCm) -> bool {
    offset.raw().unsigned_abs() < half.raw().unsigned_abs()
}

/// FUS-3d: what a single sensor's object may permit: (mitigation of any level, the full cap).
fn permits(distance: DistanceCm, closing: ClosingCmS, required: DecelMs2Q11, config: &Config) -> (bool, bool) {
    // MIT-8: no gap at all is most severe.
    let severe = required >= config.severe_decel || distance == DistanceCm::ZERO;
    let mitigable = severe || reached_or_equal(distance, closing, config.mitigable_ttc);
    (mitigable, severe || reached_or_equal(distance, closing, config.emergency_ttc))
}

/// FUS-3c, e: assesses a radar object as it is now (FUS-1a): it obliges in the corridor, matched or seen consistently.
/// `class` is what the camera says, `None` if unmatched.
#[must_use]
pub fn radar_object(object: &RadarObject, class: Option<Class>, config: &Config) -> Assessment {
    let RadarObject { distance, offset, closing, age, updates } = *object;
    let distance = moved(distance, closing, age, Millis::ZERO);
    let in_corridor = within(offset, config.corridor);
    let certain = class.is_some() || updates >= config.consistent_updates;
    let required = required(distance, closing, config);
    let (mitigable, emergency) = permits(distance, closing, required, config);
    let valid = in_corridor && certain;
    let level = if valid { level(distance, closing, config) } else { Level::None };

    // FCW-1, PCW-1: "distance" is the lateral offset (reading a); what is not a pedestrian is an object.
    let walks = class == Some(Class::Pedestrian);
    let pedestrian = walks && inside(offset, config.pedestrian_offset);
    let forward = certain && !walks && inside(offset, config.forward_offset);
    let [forward_on, forward_off] = config.forward_ttc.0;
    let [pedestrian_on, pedestrian_off] = config.pedestrian_ttc.0;

    // MIT-8: severe by one, nothing by the other.
    let [mild, ..] = config.level_decel.0;
    let disagreement = valid
        && ((required >= config.severe_decel && level == Level::None) || (level == Level::Three && required < mild));
    let required = if valid { required } else { DecelMs2Q11::ZERO };
    Assessment {
        level,
        // MIT-4: an object that is not certain begins no level, but is not known to be gone either.
        closing: in_corridor && closing > ClosingCmS::ZERO,
        required,
        mitigable,
        emergency,
        forward_begins: forward && reached(distance, closing, forward_on),
        forward_holds: forward && reached_or_equal(distance, closing, forward_off),
        pedestrian_begins: pedestrian && reached(distance, closing, pedestrian_on),
        pedestrian_holds: pedestrian && reached_or_equal(distance, closing, pedestrian_off),
        disagreement,
        worst: valid.then_some(Worst { level, required, object: Object { distance, offset, closing } }),
    }
}

/// Assesses a camera object as it is now: alone it obliges nothing, but it may permit, matched or not (rule 1).
#[must_use]
pub fn camera_object(object: &CameraObject, config: &Config) -> Assessment {
    let CameraObject { distance, closing, age, .. } = *object;
    let distance = moved(distance, closing, age, Millis::ZERO);
    let required = required(distance, closing, config);
    let (mitigable, emergency) = permits(distance, closing, required, config);
    Assessment { mitigable, emergency, ..Assessment::NOTHING }
}

/// Merges two assessments: everything that either says, and the more severe obstacle. Commutative, associative, idempotent:
/// no order of a list decides.
#[must_use]
pub fn merge(first: Assessment, second: Assessment) -> Assessment {
    // Between equally severe obstacles their values decide, the nearer one first.
    let severity = |Worst { level, required, object }: Worst| {
        (level, required, Reverse(object.distance), object.closing, object.offset)
    };
    let second_is_worse = second.worst.map(severity) > first.worst.map(severity);
    Assessment {
        level: first.level.max(second.level),
        closing: first.closing || second.closing,
        required: first.required.max(second.required),
        mitigable: first.mitigable || second.mitigable,
        emergency: first.emergency || second.emergency,
        forward_begins: first.forward_begins || second.forward_begins,
        forward_holds: first.forward_holds || second.forward_holds,
        pedestrian_begins: first.pedestrian_begins || second.pedestrian_begins,
        pedestrian_holds: first.pedestrian_holds || second.pedestrian_holds,
        disagreement: first.disagreement || second.disagreement,
        worst: if second_is_worse { second.worst } else { first.worst },
    }
}
