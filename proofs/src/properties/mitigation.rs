//! Collision mitigation: when a level begins, and when it ends (MIT).

use supervisor_core::{AngleDeciDeg, Closing, DecelMs2Q11, EpbState, Level, Mitigation, Percent};

use super::known::{BrakePedal, counts, lasted, magnitude};
use super::{Cycle, Property, all, implies};

/// Every property of this file.
pub const ALL: &[Property] = all![
    mit_1_latches_begin_exactly,
    mit_4_latches_end_exactly,
    mit_4_timers_run_without_a_break,
    mit_4h_every_latch_ends_at_standstill,
    mit_4g_level_three_ends_at_standstill_only,
    mit_7_hold_follows_lost_speed,
    mit_7_unknown_keeps_what_has_begun,
    mit_8c_only_time_to_collision_obliges,
    mit_6d_braking_stays_permitted,
    rxn_1_same_cycle
];

const fn latches(of: &Mitigation) -> [bool; 3] {
    [of.one, of.two, of.three]
}

/// Whether the conditions hold in this cycle under which a level begins, level by level.
fn begins(of: &Cycle<'_>) -> [bool; 3] {
    let (inputs, config, threat) = (of.inputs, of.config, of.threat);
    let slow = of.agreed_speeds().is_some_and(|(low, _)| low < config.level_least_speed.raw());
    let plausible = |measured: &DecelMs2Q11| *measured <= config.decel_plausible;
    let enough = inputs.deceleration.known().filter(plausible).is_some_and(|measured| measured >= threat.required);
    // MIT-6e: where little braking is enough, none is obliged.
    let enough = enough || threat.required < config.level_least_required;
    let straight = |limit| of.steering_angle().is_some_and(|angle| angle < magnitude(limit));
    let [one, two, three] = config.level_angle.0;
    [
        threat.level != Level::None && straight(one) && !slow && !enough,
        matches!(threat.level, Level::Two | Level::Three) && straight(two) && !slow && !enough,
        threat.level == Level::Three && straight(three) && !slow && !enough,
    ]
}

/// Whether what ends every level has lasted long enough.
fn over(of: &Cycle<'_>) -> bool {
    let new = &of.new.mitigation;
    lasted(new.standstill, of.config.level_standstill) || lasted(new.speedless, of.config.level_speedless)
}

/// Whether the driver steers beyond `limit`; while automatic steering acts, only after a takeover.
fn steers(of: &Cycle<'_>, limit: AngleDeciDeg) -> bool {
    let takeover = of.new.steering.barred || lasted(of.new.steering.takeover, of.config.takeover_time);
    let driver = of.old.steering.weight == Percent::ZERO || takeover;
    driver && of.steering_angle().is_some_and(|angle| angle > magnitude(limit))
}

/// Whether a level ends in this cycle, level by level.
fn ends(of: &Cycle<'_>) -> [bool; 3] {
    let over = over(of);
    let gone = lasted(of.new.mitigation.gone, of.config.level_gone);
    let [one, two] = of.config.level_exit_angle.0;
    [over || gone || steers(of, one), over || gone || steers(of, two), over]
}

/// MIT-1a, MIT-2a, MIT-3a, MIT-4a, MIT-6b, MIT-6c, MIT-6e, MIT-7d: a latch is set exactly when perception calls for its
/// level (or a higher one), the angle is known and strictly inside its limit, the bus is not known to be slower than the
/// least speed, is not known to brake enough already, and no less than the least deceleration is required. No latch looks at
/// another.
#[must_use]
pub fn mit_1_latches_begin_exactly(cycle: &Cycle<'_>) -> bool {
    let ([old_one, old_two, old_three], [one, two, three]) =
        (latches(&cycle.old.mitigation), latches(&cycle.new.mitigation));
    let [begin_one, begin_two, begin_three] = begins(cycle);
    let exactly = |old: bool, new: bool, begin: bool| implies(begin, new) && implies(new && !old, begin);
    exactly(old_one, one, begin_one) && exactly(old_two, two, begin_two) && exactly(old_three, three, begin_three)
}

/// MIT-4a, MIT-4c, MIT-4d, MIT-4e, MIT-4f, MIT-4g, MIT-4h, MIT-7a, MIT-7e, MIT-7f: a latch that is set ends exactly by
/// its own exits, and then only if it does not begin anew in the same cycle.
#[must_use]
pub fn mit_4_latches_end_exactly(cycle: &Cycle<'_>) -> bool {
    let ([old_one, old_two, old_three], [one, two, three]) =
        (latches(&cycle.old.mitigation), latches(&cycle.new.mitigation));
    let ([begin_one, begin_two, begin_three], [end_one, end_two, end_three]) = (begins(cycle), ends(cycle));
    let exactly = |old: bool, new: bool, begin: bool, end: bool| implies(old, new == (begin || !end));
    exactly(old_one, one, begin_one, end_one)
        && exactly(old_two, two, begin_two, end_two)
        && exactly(old_three, three, begin_three, end_three)
}

/// MIT-4d, MIT-4h, MIT-7a, MIT-7b: what ends a level counts real time without a break: known not to close, known to stand,
/// speed unknown while a level runs. Each begins anew after one cycle without its condition.
#[must_use]
pub fn mit_4_timers_run_without_a_break(cycle: &Cycle<'_>) -> bool {
    let (old, new) = (&cycle.old.mitigation, &cycle.new.mitigation);
    let (elapsed, _) = cycle.elapsed();
    let ran = old.one || old.two || old.three;
    counts(old.gone, new.gone, cycle.threat.closing == Closing::No, elapsed)
        && counts(old.standstill, new.standstill, cycle.stands(), elapsed)
        && counts(old.speedless, new.speedless, ran && cycle.agreed_speeds().is_none(), elapsed)
}

/// MIT-4h: once standstill has lasted its time no latch is set, whatever perception says: below the least speed none begins.
#[must_use]
pub fn mit_4h_every_latch_ends_at_standstill(cycle: &Cycle<'_>) -> bool {
    let stood = lasted(cycle.new.mitigation.standstill, cycle.config.level_standstill);
    implies(
        stood && cycle.config.standstill_speed <= cycle.config.level_least_speed,
        latches(&cycle.new.mitigation) == [false; 3],
    )
}

/// MIT-3b, MIT-4g: level 3 is left by nothing but standstill that has lasted, or speed unknown for as long as MIT-7b says.
#[must_use]
pub fn mit_4g_level_three_ends_at_standstill_only(cycle: &Cycle<'_>) -> bool {
    implies(cycle.old.mitigation.three && !over(cycle), cycle.new.mitigation.three)
}

/// MIT-7b, MIT-7c: when the speed of a level has been unknown for its time, the bus is held, until the parking brake is
/// known applied or the driver is known to brake; nothing else begins or ends that. Meanwhile there is no drive torque.
#[must_use]
pub fn mit_7_hold_follows_lost_speed(cycle: &Cycle<'_>) -> bool {
    let lost = lasted(cycle.new.mitigation.speedless, cycle.config.level_speedless);
    let braked = matches!(cycle.brake_pedal(), BrakePedal::Pressed(_)) || cycle.inputs.epb.is(EpbState::Applied);
    let hold = cycle.new.mitigation.hold;
    hold == ((cycle.old.mitigation.hold || lost) && !braked)
        && implies(hold, cycle.envelope.brake.floor.most >= cycle.config.leave_hold)
        && implies(hold, cycle.envelope.torque.driver.most == Percent::ZERO)
        && implies(hold, cycle.envelope.torque.automated.most == Percent::ZERO)
        && implies(hold, cycle.envelope.torque.epbi.most == Percent::ZERO)
}

/// RULE-1b, RULE-1d, MIT-7a, MIT-7b, MIT-7d, MIT-7e: with perception, speed and angle unknown no level begins, and every
/// level goes on, until its speed has been unknown for its time: then the bus is held.
#[must_use]
pub fn mit_7_unknown_keeps_what_has_begun(cycle: &Cycle<'_>) -> bool {
    let blind =
        cycle.threat.closing == Closing::Unknown && cycle.agreed_speeds().is_none() && cycle.steering_angle().is_none();
    let lost = lasted(cycle.new.mitigation.speedless, cycle.config.level_speedless);
    let (old, new) = (latches(&cycle.old.mitigation), latches(&cycle.new.mitigation));
    implies(blind && !lost, new == old) && implies(blind && lost, new == [false; 3])
}

/// MIT-8c, RULE-1b: the second opinion, and what only permits, set no latch; nor does perception that calls for no level.
#[must_use]
pub fn mit_8c_only_time_to_collision_obliges(cycle: &Cycle<'_>) -> bool {
    let (old, new) = (&cycle.old.mitigation, &cycle.new.mitigation);
    implies(
        cycle.threat.level == Level::None,
        implies(new.one, old.one) && implies(new.two, old.two) && implies(new.three, old.three),
    )
}

/// MIT-6d, MIT-8d: what is not obliged stays permitted: the full cap is free as soon as perception calls for level 3 or for
/// the full cap, and until the object is known to be gone or the bus has stood. The gates of MIT-6b and MIT-6c have no part in
/// it. What levels 1 and 2 demand lies below the cap of comfort, or raises it (PHB-1d).
#[must_use]
pub fn mit_6d_braking_stays_permitted(cycle: &Cycle<'_>) -> bool {
    let (old, new) = (&cycle.old.mitigation, &cycle.new.mitigation);
    let danger = cycle.threat.level == Level::Three || cycle.threat.emergency;
    let ended = over(cycle) || lasted(new.gone, cycle.config.level_gone);
    new.permitted == (danger || (old.permitted && !ended))
        && implies(new.permitted, cycle.envelope.brake.cap.most >= cycle.config.brake_cap)
}

/// RXN-1a, MIT-1b, MIT-2b, MIT-3b: the demand of a level goes out in the very cycle in which it begins.
#[must_use]
pub fn rxn_1_same_cycle(cycle: &Cycle<'_>) -> bool {
    let [begin_one, begin_two, begin_three] = begins(cycle);
    let [one, two, three] = cycle.config.level_decel.0;
    let total = cycle.outputs.brake.total;
    implies(begin_one, total >= one) && implies(begin_two, total >= two) && implies(begin_three, total >= three)
}
