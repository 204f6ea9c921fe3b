//! How much must the bus brake, and what becomes of a brake request? (MIT, SEAT-3, E2E-2, VLC-1, CMD-6, RSP-1)

use supervisor_core::{
    BrakeMode, DecelMs2Q11, Deviation, EpbMode, EpbRequest, Faults, Mode, Percent, Priority, Seat, ServiceBrake, Timer,
    kernel,
};

use super::command::brake_instead;
use super::known::{asked, counts, lasted};
use super::leave::at_least_table;
use super::{Cycle, Property, all, implies};

/// Every property of this file.
pub const ALL: &[Property] = all![
    brake_never_below_obligation,
    mit_4b_greatest_demand_exactly,
    self_5d_vacant_brakes_by_the_table,
    rule_1d_slow_is_kept,
    vlc_1e_requests_merge,
    self_11b_request_in_bounds_passes,
    cmd_6a_obligation_has_its_own_mode,
    e2e_2c_lost_request_holds,
    e2e_2d_then_falls_by_the_ramp,
    e2e_2_lost_request_is_told,
    cmd_3f_brake_counts_from_last_output,
    rsp_1_retarder_helps,
    rsp_1_held_against_what_went_out
];

/// SEAT-3a, MIT-1b, MIT-2b, MIT-3b: the service brake is never below the demand of leave and of the set latches.
#[must_use]
pub fn brake_never_below_obligation(cycle: &Cycle<'_>) -> bool {
    let [one, two, three] = cycle.config.level_decel.0;
    let mitigation = &cycle.new.mitigation;
    let out = &cycle.outputs.brake;
    let demand = |set, decel: DecelMs2Q11| implies(set, out.total >= decel);
    let obliged = cycle.envelope.brake.floor.most > DecelMs2Q11::ZERO;
    demand(mitigation.one, one)
        && demand(mitigation.two, two)
        && demand(mitigation.three, three)
        && demand(cycle.new.seat.leave, cycle.new.brake.leave)
        && implies(obliged, out.mode == BrakeMode::Maximum && out.priority == Priority::Highest)
}

/// MIT-4b, MIT-7c, SELF-5d, RULE-1b: the obligation is the greatest demand that runs, and nothing but what runs: the set
/// latches, the hold after a lost speed, leave, a drive that disobeys, a parking brake that came loose, the safe state.
#[must_use]
pub fn mit_4b_greatest_demand_exactly(cycle: &Cycle<'_>) -> bool {
    let (config, new) = (cycle.config, cycle.new);
    let mitigation = &new.mitigation;
    let [one, two, three] = config.level_decel.0;
    let of = |runs: bool, decel: DecelMs2Q11| if runs { decel } else { DecelMs2Q11::ZERO };
    let confirmed = lasted(new.seat.occupied, config.seat_confirm);
    let held = mitigation.hold
        || cycle.response.torque == Deviation::Persistent
        || (cycle.response.parking && !confirmed && new.brake.slow)
        || (new.is_safe_state() && new.brake.slow);
    let greatest = of(mitigation.one, one)
        .max(of(mitigation.two, two))
        .max(of(mitigation.three, three))
        .max(of(held, config.leave_hold))
        .max(of(new.seat.leave, new.brake.leave));
    let vacant = cycle.inputs.seat.iter().all(|sensor| sensor.is(Seat::Vacant));
    let floor = cycle.envelope.brake.floor.most;
    // What the table adds in the safe state is the next property's.
    if new.is_safe_state() && vacant { floor >= greatest } else { floor == greatest }
}

/// SELF-5d, SEAT-3a: in the safe state with the seat known vacant at least a₀, without a speed at least the hold.
#[must_use]
pub fn self_5d_vacant_brakes_by_the_table(cycle: &Cycle<'_>) -> bool {
    let (config, floor) = (cycle.config, cycle.envelope.brake.floor.most);
    let vacant = cycle.inputs.seat.iter().all(|sensor| sensor.is(Seat::Vacant));
    implies(
        cycle.new.is_safe_state() && vacant,
        cycle.agreed_speeds().map_or(floor >= config.leave_hold, |(low, _)| at_least_table(floor, low, config)),
    )
}

/// RULE-1d, SELF-5d: slow by the lower speed; an unknown speed keeps what was last known.
#[must_use]
pub fn rule_1d_slow_is_kept(cycle: &Cycle<'_>) -> bool {
    let slow = cycle.new.brake.slow;
    match cycle.agreed_speeds() {
        Some((low, _)) => slow == (low < cycle.config.leave_hold_speed.raw()),
        None => slow == cycle.old.brake.slow,
    }
}

/// What is asked for: the command, or what a lost one counts as, which the driver's pedal exceeds.
fn wanted(of: &Cycle<'_>) -> ServiceBrake {
    asked(of.commands.brake, of.envelope.timeouts.ms50).unwrap_or_else(|| brake_instead(of.envelope))
}

/// VLC-1e, VLC-2e, VLC-2g, CMD-6b, RULE-3a, RULE-3b, PHB-1d: request and obligation merge to the greater deceleration. The
/// total is that of the request up to the cap, and at least the obligation; no part of it has a say. An obligation takes the
/// highest priority and the mode with the driver's demand as the floor; without one both stay as they were asked for.
#[must_use]
pub fn vlc_1e_requests_merge(cycle: &Cycle<'_>) -> bool {
    let (bound, out, wanted) = (&cycle.envelope.brake, &cycle.outputs.brake, wanted(cycle));
    let obliged = bound.floor.most > DecelMs2Q11::ZERO;
    let (mode, priority) =
        if obliged { (BrakeMode::Maximum, Priority::Highest) } else { (wanted.mode, wanted.priority) };
    out.total == wanted.total.min(bound.cap.most).max(bound.floor.most) && out.mode == mode && out.priority == priority
}

/// SELF-11b, CMD-3c, RULE-3a: a request between obligation and cap whose electric part is within its limit and the total goes
/// out unchanged; beside an obligation, in the mode and with the priority that this needs.
#[must_use]
pub fn self_11b_request_in_bounds_passes(cycle: &Cycle<'_>) -> bool {
    let bound = &cycle.envelope.brake;
    asked(cycle.commands.brake, cycle.envelope.timeouts.ms50).is_none_or(|wanted| {
        let suits = bound.floor.most == DecelMs2Q11::ZERO
            || (wanted.mode == BrakeMode::Maximum && wanted.priority == Priority::Highest);
        let within = wanted.total >= bound.floor.most && wanted.total <= bound.cap.most;
        let split = wanted.electric <= bound.electric && wanted.electric <= wanted.total;
        implies(suits && within && split, cycle.outputs.brake == wanted)
    })
}

/// CMD-6a: an obliged parking brake is applied in its own mode, as [`vlc_1e_requests_merge`] says of the service brake.
#[must_use]
pub fn cmd_6a_obligation_has_its_own_mode(cycle: &Cycle<'_>) -> bool {
    let epb = &cycle.outputs.epb;
    implies(cycle.envelope.epb.obliged.is_some(), epb.request == EpbRequest::Apply && epb.mode == EpbMode::Automatic)
}

/// Whether a request will have been lost for the hold in this cycle; the first cycle without one counts for no time.
fn held_long_enough(since: Timer, of: &Cycle<'_>) -> bool {
    let (_, elapsed) = of.elapsed();
    // A timer saturates one below the top.
    since.is_running() && since.elapsed().raw().saturating_add(elapsed).min(u32::MAX - 1) >= of.config.brake_hold.raw()
}

/// E2E-2c: a lost request counts as the last output exactly while it has been lost for less than the hold; then as no more
/// than that, and a retarder torque as nothing.
#[must_use]
pub fn e2e_2c_lost_request_holds(cycle: &Cycle<'_>) -> bool {
    let (brake, bound) = (&cycle.old.brake, &cycle.envelope.brake);
    let (over, retarder_over) = (held_long_enough(brake.lost, cycle), held_long_enough(brake.retarder_lost, cycle));
    (bound.fallback == brake.total || over && bound.fallback < brake.total)
        && bound.retarder_fallback == if retarder_over { Percent::ZERO } else { brake.retarder }
}

/// E2E-2d: after the hold it falls in every cycle by the configured ramp, down to nothing.
#[must_use]
pub fn e2e_2d_then_falls_by_the_ramp(cycle: &Cycle<'_>) -> bool {
    let (brake, config) = (&cycle.old.brake, cycle.config);
    // The clock's own ticks, as `cmd_3f_brake_counts_from_last_output` pins them: two products of the same numbers match.
    let (_, ticks) = cycle.old.clock.advance(cycle.now, config);
    let left = brake.total.raw().saturating_sub(kernel::fallen(config.brake_ramp.raw(), ticks.safety.raw()));
    implies(held_long_enough(brake.lost, cycle), cycle.envelope.brake.fallback.raw() == left)
}

/// E2E-2e, E2E-2f: while the request is lost the driver is told; once it was lost for the hold no automated mode runs.
#[must_use]
pub fn e2e_2_lost_request_is_told(cycle: &Cycle<'_>) -> bool {
    let lost = cycle.old.brake.lost;
    implies(lost.is_running(), cycle.faults.contains(Faults::BRAKE_COMMAND_LOST) && cycle.envelope.warnings.fault_lamp)
        && implies(
            lasted(lost, cycle.config.brake_hold),
            cycle.new.drive.mode == Mode::Manual && cycle.envelope.automated.is_err(),
        )
}

/// CMD-3f, E2E-2c: the next cycle counts from what went out in this one, and knows for how long no usable request came.
#[must_use]
pub fn cmd_3f_brake_counts_from_last_output(cycle: &Cycle<'_>) -> bool {
    let (before, next) = (&cycle.new.brake, &cycle.next.brake);
    let (_, elapsed) = cycle.elapsed();
    let lost = asked(cycle.commands.brake, cycle.config.timeout_50).is_none();
    let retarder_lost = asked(cycle.commands.retarder, cycle.config.timeout_100).is_none();
    // Saturating at the top of the timer only.
    next.total == cycle.outputs.brake.total
        && next.retarder == cycle.outputs.retarder.torque
        && next.leave == before.leave
        && next.slow == before.slow
        && counts(before.lost, next.lost, lost, elapsed)
        && counts(before.retarder_lost, next.retarder_lost, retarder_lost, elapsed)
}

/// RSP-1a, RSP-1b, RSP-1c, RSP-1d, RSP-1e, SELF-10a: the actuators are held against what went out in this cycle: the outputs,
/// service brake and retarder together, and whether level 3 runs.
#[must_use]
pub fn rsp_1_held_against_what_went_out(cycle: &Cycle<'_>) -> bool {
    let (bound, out) = (&cycle.envelope.brake, cycle.outputs);
    let together = kernel::together(out.brake.total.raw(), bound.retarder_decel.raw(), out.retarder.torque.raw());
    cycle.next.monitors == cycle.new.monitors.record(out, DecelMs2Q11::new(together), cycle.new.mitigation.three)
}

/// RSP-1k, RSP-1l, RSP-1m: brakes that fall short of an obligation are helped by all that the retarder may give,
/// unless ABS is, or may be, at work.
#[must_use]
pub fn rsp_1_retarder_helps(cycle: &Cycle<'_>) -> bool {
    let bound = &cycle.envelope.brake;
    let due = cycle.response.brake != Deviation::None && bound.floor.most > DecelMs2Q11::ZERO;
    bound.retarder_obliged == (due && cycle.inputs.abs.is(false))
}
