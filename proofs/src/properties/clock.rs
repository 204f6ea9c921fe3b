//! Time (SELF-3): what counts as a cycle, what each timer gets, and what a clock fault does.

use supervisor_core::{DrivingMode, Faults, Mode, Percent};

use super::{Cycle, Property, all, implies};

/// Every property of this file.
pub const ALL: &[Property] = all![
    self_3_clock_exactly,
    self_3_fault_is_reported,
    self_3_obligations_stay,
    self_3_fault_ends_the_mode,
    self_3_three_in_a_row_are_the_safe_state,
];

/// SELF-3b, SELF-3c, SELF-3h: the clock keeps the time of this cycle and counts faults in a row; one good cycle ends the row.
#[must_use]
pub fn self_3_clock_exactly(cycle: &Cycle<'_>) -> bool {
    let (old, new) = (&cycle.old.clock, &cycle.new.clock);
    let faults = if cycle.clock_fault() { old.faults.saturating_add(1) } else { 0 };
    new.started && new.last == cycle.now && new.faults == faults
}

/// SELF-3c: a time step outside its range is reported in its cycle, and none else is.
#[must_use]
pub fn self_3_fault_is_reported(cycle: &Cycle<'_>) -> bool {
    cycle.reports(Faults::CLOCK, cycle.clock_fault())
}

/// SELF-3f: in a cycle with a clock fault no obligation ends that time alone would end: leave, *parked by leave*, the shutdown,
/// every level, latched faults; only timers that had already run may.
#[must_use]
pub fn self_3_obligations_stay(cycle: &Cycle<'_>) -> bool {
    let (old, new, config) = (cycle.old, cycle.new, cycle.config);
    let (before, after) = (&old.mitigation, &new.mitigation);
    let over =
        before.standstill.elapsed() >= config.level_standstill || before.speedless.elapsed() >= config.level_speedless;
    let gone = before.gone.elapsed() >= config.level_gone;
    let steers = cycle.inputs.steering_angle.known().is_some();
    let stays = |before: bool, after: bool, ends: bool| implies(before && !ends, after);
    implies(
        cycle.clock_fault(),
        stays(old.seat.leave, new.seat.leave, old.seat.occupied.elapsed() >= config.seat_confirm)
            && stays(old.parking.by_leave, new.parking.by_leave, false)
            && stays(before.three, after.three, over)
            && stays(before.two, after.two, over || gone || steers)
            && stays(before.one, after.one, over || gone || steers)
            && new.latches.faults.contains(old.latches.faults),
    )
}

/// SELF-3g: a clock fault ends the automated and the longitudinal mode, and lets neither begin.
#[must_use]
pub fn self_3_fault_ends_the_mode(cycle: &Cycle<'_>) -> bool {
    let bound = &cycle.envelope.torque;
    implies(
        cycle.clock_fault(),
        cycle.new.drive.mode == Mode::Manual
            && cycle.outputs.mode == DrivingMode::Manual
            && bound.automated.most == Percent::ZERO
            && bound.epbi.most == Percent::ZERO,
    )
}

/// SELF-3h: three clock faults in consecutive cycles latch the safe state; fewer do not.
#[must_use]
pub fn self_3_three_in_a_row_are_the_safe_state(cycle: &Cycle<'_>) -> bool {
    let third = cycle.clock_fault() && cycle.old.clock.faults >= 2;
    let latched = cycle.new.latches.faults.contains(Faults::CLOCK_LATCHED);
    let before = cycle.old.latches.faults.contains(Faults::CLOCK_LATCHED);
    implies(third, latched && cycle.safe_state()) && implies(latched, before || third)
}
