//! The supervisor itself: clock, latches, safe state, boot (SELF).

use supervisor_core::{
    Contactors, DecelMs2Q11, Deviation, DrivingMode, EpbRequest, EpbState, Faults, Flow, GearRequest, Key, Pending,
    Percent, SpeedKmhQ8, Stage, Timer,
};

use super::facts::{asked, has_run, runs_while};
use super::{Cycle, Property, all, implies};

/// Every property of this file.
pub const ALL: &[Property] = all![
    self_5_safe_state,
    self_7_latched,
    self_7_quiet_counts_real_time,
    self_6_flow_fault_is_the_safe_state,
    self_5_brake_in_the_safe_state,
    self_5_request_passes_in_the_safe_state,
    self_5_steering_in_the_safe_state,
    self_7_latches_exactly,
    self_9_boot_settles_exactly,
];

/// SELF-5c, f, h: the safe state. Torque 0, no release, apply when slow, gear and contactors hold, flashers on.
#[must_use]
pub fn self_5_safe_state(cycle: &Cycle<'_>) -> bool {
    let out = cycle.outputs;
    implies(
        cycle.new.is_safe_state(),
        out.drive.torque == Percent::ZERO
            && out.epb.request != EpbRequest::Release
            && out.gear == GearRequest::Hold
            && out.contactors == Contactors::NEUTRAL
            && out.warnings.hazard_flashers
            && out.mode == DrivingMode::Manual,
    )
}

/// SELF-5b, SELF-7a, SELF-7b, SELF-7c: latched faults stay, or all go together: at standstill, parking brake applied, after
/// the fault-free time, by the key seen Off before and On or Start now.
#[must_use]
pub fn self_7_latched(cycle: &Cycle<'_>) -> bool {
    let (old, new) = (&cycle.old.latches, &cycle.new.latches);
    let key = cycle.inputs.key.is(Key::On) || cycle.inputs.key.is(Key::Start);
    let may_clear = cycle.standstill()
        && cycle.inputs.epb.is(EpbState::Applied)
        && new.quiet.reached(cycle.config.fault_free)
        && old.off_seen
        && key;
    new.faults.contains(old.faults) || (may_clear && new.faults == Faults::NONE)
}

/// SELF-7b: the fault-free time counts no more than real time, and only at standstill with the parking brake applied.
#[must_use]
pub fn self_7_quiet_counts_real_time(cycle: &Cycle<'_>) -> bool {
    let (old, new) = (cycle.old.latches.quiet, cycle.new.latches.quiet);
    let passed = cycle.now.raw().wrapping_sub(cycle.old.clock.last.raw());
    let counted = new.elapsed().raw().saturating_sub(old.elapsed().raw());
    implies(new.is_running(), cycle.standstill() && cycle.inputs.epb.is(EpbState::Applied))
        && implies(cycle.old.clock.started, counted <= passed)
}

/// SELF-6b: a cycle that did not run whole and in order leads to the safe state.
#[must_use]
pub fn self_6_flow_fault_is_the_safe_state(cycle: &Cycle<'_>) -> bool {
    implies(cycle.old.flow != Flow::RECORDED, cycle.new.is_safe_state())
}

/// SEAT-3a: the table of leave at the last point at or below this speed, and at the point above it.
fn table_around(speed: SpeedKmhQ8, table: &[DecelMs2Q11; 16]) -> (DecelMs2Q11, DecelMs2Q11) {
    /// S3 table 1, in km/h.
    const POINTS: [u16; 16] = [0, 2, 4, 6, 8, 10, 15, 20, 25, 30, 35, 40, 45, 50, 55, 60];
    let mut around = (DecelMs2Q11::ZERO, DecelMs2Q11::ZERO);
    let mut passed = false;
    for (point, decel) in POINTS.iter().zip(table) {
        if speed.raw() >= point.saturating_mul(256) {
            around = (*decel, *decel);
        } else if !passed {
            (around.1, passed) = (*decel, true);
        }
    }
    around
}

/// SELF-5d, SEAT-10a, RULE-6a: in the safe state the brake demand is, exactly, the greatest of the obligations that
/// persist, the table of leave at the lower speed if the seat is known vacant (1.35 m/s² without a speed), and 1.35 m/s²
/// below 2 km/h as last known; between two points of the table it lies between theirs.
#[must_use]
pub fn self_5_brake_in_the_safe_state(cycle: &Cycle<'_>) -> bool {
    let (new, config, response) = (cycle.new, cycle.config, cycle.response);
    let slow = cycle.known_speeds().map_or(cycle.old.brake.slow, |(low, _)| low < config.leave_hold_speed);
    let [one, two, three] = config.level_decel.0;
    let loose = response.parking && !cycle.confirmed() && slow;
    let held = new.mitigation.hold || response.torque == Deviation::Persistent || loose || slow;
    let when = |condition: bool, decel: DecelMs2Q11| if condition { decel } else { DecelMs2Q11::ZERO };
    let besides = when(new.mitigation.one, one)
        .max(when(new.mitigation.two, two))
        .max(when(new.mitigation.three, three))
        .max(when(held, config.leave_hold))
        .max(new.brake.leave);
    let (below, above) = match (cycle.vacant(), cycle.known_speeds()) {
        (false, _) => (DecelMs2Q11::ZERO, DecelMs2Q11::ZERO),
        (true, None) => (config.leave_hold, config.leave_hold),
        (true, Some((low, _))) => table_around(low, &config.leave_decel.0),
    };
    let (floor, most) = (cycle.envelope.brake.floor.most, besides.max(below).max(above));
    let demanded = floor >= besides.max(below) && floor <= most && cycle.outputs.brake.total >= floor;
    new.brake.slow == slow && implies(cycle.safe_state(), demanded)
}

/// SELF-5d, RULE-3a: in the safe state a valid request of the controller still brakes, up to the greatest deceleration.
#[must_use]
pub fn self_5_request_passes_in_the_safe_state(cycle: &Cycle<'_>) -> bool {
    let Some(wanted) = asked(cycle.commands.brake, cycle.config.timeout_50) else { return true };
    implies(cycle.safe_state(), cycle.outputs.brake.total >= wanted.total.min(cycle.config.brake_cap))
}

/// SELF-5g: in the safe state automatic steering may not stay: whatever is asked, its weight is the least that fading
/// leaves, never more than before.
#[must_use]
pub fn self_5_steering_in_the_safe_state(cycle: &Cycle<'_>) -> bool {
    let (bound, out) = (&cycle.envelope.steering, &cycle.outputs.steering);
    implies(
        cycle.safe_state(),
        bound.enable.is_err()
            && out.weight == bound.weight_least
            && out.weight <= cycle.old.steering.weight
            && out.enable == (bound.weight_least > Percent::ZERO),
    )
}

/// SELF-7a, SELF-7b, SELF-7c, SELF-3d, SELF-5b: the latches, exactly. The fault-free time runs without a break while the
/// bus stands with its parking brake known applied, no cause and no clock fault; after it the key is seen Off and then On
/// or Start, and all clear together; nothing else clears any, and every cause latches.
#[must_use]
pub fn self_7_latches_exactly(cycle: &Cycle<'_>) -> bool {
    let (old, new, config) = (cycle.old, &cycle.new.latches, cycle.config);
    let overdue = |stage, deadline| old.high_voltage.stage == stage && has_run(old.high_voltage.wait, deadline);
    let contactor = cycle.response.faults.contains(Faults::CONTACTOR)
        || overdue(Stage::OpeningK4, config.k4_deadline)
        || overdue(Stage::OpeningK1, config.k1_deadline);
    let cause = Faults::NONE
        .when(cycle.new.clock.faults >= 3, Faults::CLOCK_LATCHED)
        .when(contactor, Faults::CONTACTOR)
        .when(old.flow != Flow::RECORDED, Faults::FLOW)
        .when(old.latches.faults.contains(Faults::CONFIGURATION), Faults::CONFIGURATION);
    let still = cycle.stands() && cycle.inputs.epb.is(EpbState::Applied);
    let calm = still && cause == Faults::NONE && !cycle.clock_fault();
    let off_seen = has_run(new.quiet, config.fault_free) && (old.latches.off_seen || cycle.inputs.key.is(Key::Off));
    let clears = off_seen && cycle.key_on();
    runs_while(calm, old.latches.quiet, new.quiet, cycle.permitting())
        && new.off_seen == (off_seen && !clears)
        && new.faults == if clears { Faults::NONE } else { old.latches.faults.with(cause) }
        && cycle.safe_state() == (new.faults.and(Faults::SAFE_STATE) != Faults::NONE)
}

/// SELF-9b, SELF-9d: until boot has settled it waits, and settles exactly with the driver confirmed, or with the parking
/// brake known and the seat known vacant or waited for; then never again.
#[must_use]
pub fn self_9_boot_settles_exactly(cycle: &Cycle<'_>) -> bool {
    let (old, new, inputs) = (&cycle.old.boot, &cycle.new.boot, cycle.inputs);
    let waited = cycle.vacant() || old.wait.run(cycle.obliging()).reached(cycle.config.boot_settle);
    let settles = cycle.confirmed() || (waited && inputs.epb.known().is_some());
    if old.pending == Pending::Done || settles {
        new.pending == Pending::Done && new.wait == Timer::STOPPED
    } else {
        new.pending == old.pending && runs_while(true, old.wait, new.wait, cycle.obliging())
    }
}
