//! The rules of all machines: what unknown means (RULE-1), which speed counts (RULE-6), and what a command can do (CMD).

use supervisor_core::{AngleDeciDeg, EpbState, Faults, Gear, HighVoltage, Level, Mode, Percent, Signal, Stage};

use super::facts::has_run;
use super::{Cycle, Property, all, implies};

/// Every property of this file.
pub const ALL: &[Property] = all![
    rule_1_unknown_is_reported,
    rule_1_unknown_begins_nothing,
    rule_1_unknown_permits_nothing,
    rule_1_unknown_ends_nothing,
    rule_6_speeds,
    cmd_1_fields_in_range,
    cmd_3_rates_count_from_the_output,
    cmd_7_commands_are_no_evidence,
];

/// RULE-1a, RULE-6c: a redundant input is unknown exactly when a source of it is, is out of range, or the two disagree; each is reported.
#[must_use]
pub fn rule_1_unknown_is_reported(cycle: &Cycle<'_>) -> bool {
    cycle.reports(Faults::SPEED_UNKNOWN, cycle.known_speeds().is_none())
        && cycle.reports(Faults::ACCELERATOR_UNKNOWN, cycle.accelerator().is_none())
        && cycle.reports(Faults::PERCEPTION_UNKNOWN, !cycle.threat.known)
}

/// RULE-1b: every obligation that begins in this cycle has its evidence in known inputs of this cycle, or in time that was counted by
/// them: leave, *parked by leave*, the shutdown and the levels.
#[must_use]
pub fn rule_1_unknown_begins_nothing(cycle: &Cycle<'_>) -> bool {
    let (old, new, inputs) = (cycle.old, cycle.new, cycle.inputs);
    let begins = |before: bool, after: bool| !before && after;
    let leaves = begins(old.seat.leave, new.seat.leave);
    let parks = begins(old.parking.by_leave, new.parking.by_leave);
    let opening = |machine: &HighVoltage| machine.stage == Stage::OpeningK4;
    let shuts = begins(opening(&old.high_voltage), opening(&new.high_voltage));
    let (before, after) = (&old.mitigation, &new.mitigation);
    let level = begins(before.one, after.one) || begins(before.two, after.two) || begins(before.three, after.three);
    implies(leaves, cycle.not_parked() && has_run(new.seat.vacant, cycle.config.seat_vacant))
        && implies(
            parks,
            (new.seat.leave && (cycle.known_speeds().is_some() || cycle.speedless()))
                || inputs.epb.is(EpbState::Applied),
        )
        && implies(shuts, cycle.vacant() && cycle.stands() && inputs.epb.is(EpbState::Applied))
        && implies(level, cycle.threat.level != Level::None && inputs.steering_angle.known().is_some())
}

/// A signal that is known.
fn known<T: Copy + PartialEq>(signal: Signal<T>) -> bool {
    signal.known().is_some()
}

/// RULE-1c, RULE-6b: no permission without known evidence for it, each signal by itself.
#[must_use]
pub fn rule_1_unknown_permits_nothing(cycle: &Cycle<'_>) -> bool {
    let (envelope, inputs) = (cycle.envelope, cycle.inputs);
    let seat = inputs.seat.iter().all(|sensor| known(*sensor));
    let speed = cycle.known_speeds().is_some();
    let driver = seat || (speed && known(inputs.epb));
    let gears = [envelope.gear.drive, envelope.gear.reverse];
    let in_gear = matches!(inputs.gear.known(), Some(Gear::Drive | Gear::Reverse))
        && inputs.drive_limit.known().is_some_and(|limit| limit <= Percent::FULL);
    let bounds = [envelope.torque.driver.most, envelope.torque.automated.most, envelope.torque.epbi.most];
    let torque = inputs.executed_torque.known().is_some_and(|torque| torque <= Percent::FULL);
    let loads = known(inputs.hv_current) && known(inputs.drive_stopped) && known(inputs.auxiliaries_stopped);
    implies(envelope.epb.release.is_ok(), seat)
        && implies(envelope.epb.apply.is_ok() && envelope.epb.obliged.is_none(), speed)
        && gears.iter().all(|gear| implies(gear.is_ok(), driver && speed && known(inputs.selector)))
        && implies(envelope.gear.park.is_ok(), seat && speed && known(inputs.selector))
        && bounds.iter().all(|most| implies(*most > Percent::ZERO, driver && in_gear))
        && implies(envelope.torque.driver.most > Percent::ZERO, cycle.accelerator().is_some())
        && implies(envelope.torque.hill_hold, seat && speed)
        && implies(envelope.k4.open.is_ok(), speed && torque)
        && implies(envelope.k1.open.is_ok(), speed && loads && known(inputs.k4))
        && implies(envelope.k4.close.is_ok(), seat && known(inputs.k1))
        && implies(envelope.k1.close.is_ok(), seat && known(inputs.k4))
        && implies(envelope.auxiliaries_off.is_ok(), speed)
        && implies(
            envelope.automated.is_ok() && cycle.new.drive.mode == Mode::Manual,
            cycle.threat.known && speed && seat && known(inputs.cruise_switch) && known(inputs.driver_set),
        )
}

/// RULE-1d, SEAT-3e: what has begun is not ended by an unknown input: leave without both sensors, the demand of leave without a speed,
/// *parked by leave*, the committed shutdown, level 3 without evidence of standstill (but for MIT-7c, which holds the bus instead),
/// latched faults without their evidence.
#[must_use]
pub fn rule_1_unknown_ends_nothing(cycle: &Cycle<'_>) -> bool {
    let (old, new, inputs) = (cycle.old, cycle.new, cycle.inputs);
    let no_speed = cycle.known_speeds().is_none();
    let no_seat = inputs.seat.iter().any(|sensor| !known(*sensor));
    let committed = matches!(old.high_voltage.stage, Stage::OpeningK4 | Stage::OpeningK1);
    let braked = inputs.epb.is(EpbState::Applied) || cycle.brake_pressed();
    implies(no_seat && old.seat.leave, new.seat.leave)
        && implies(no_speed && new.seat.leave, new.brake.leave >= old.brake.leave.max(cycle.config.leave_hold))
        && implies(no_speed, new.parking.slow == old.parking.slow && new.brake.slow == old.brake.slow)
        && implies(old.parking.by_leave, new.parking.by_leave)
        && implies(committed, new.high_voltage.stage != Stage::Up)
        && implies(no_speed && old.mitigation.three, new.mitigation.three || new.mitigation.hold || braked)
        && implies(
            no_speed || !known(inputs.epb) || !known(inputs.key),
            new.latches.faults.contains(old.latches.faults),
        )
}

/// RULE-6a, RULE-6b, SEAT-3d: obligations take the lower speed, interlocks the higher: the parking brake is applied and the bus held by the
/// lower one, standstill and a requested apply need the higher one.
#[must_use]
pub fn rule_6_speeds(cycle: &Cycle<'_>) -> bool {
    let (envelope, config) = (cycle.envelope, cycle.config);
    let held = cycle.new.seat.leave && !cycle.inputs.epb.is(EpbState::Applied);
    implies(held && cycle.lower_below(config.leave_hold_speed), cycle.new.brake.leave >= config.leave_hold)
        && envelope.auxiliaries_off.is_ok() == cycle.stands()
        && implies(envelope.gear.park.is_ok(), cycle.stands())
        && implies(envelope.k4.open.is_ok() || envelope.k1.open.is_ok(), cycle.stands())
        && implies(envelope.torque.hill_hold, cycle.higher_below(config.hill_hold_speed))
        && implies(envelope.epb.obliged.is_none() && envelope.epb.apply.is_ok(), cycle.higher_below(config.epb_speed))
}

/// CMD-1b, SELF-4f: whatever a command carries, no percentage beyond 100 and no angle beyond the window goes out.
#[must_use]
pub fn cmd_1_fields_in_range(cycle: &Cycle<'_>) -> bool {
    let (out, bound) = (cycle.outputs, &cycle.envelope.steering);
    let angle: AngleDeciDeg = out.steering.angle;
    out.drive.torque <= Percent::FULL
        && out.retarder.torque <= Percent::FULL
        && out.steering.weight <= Percent::FULL
        && implies(out.steering.enable, angle >= bound.angle_least && angle <= bound.angle_most)
        && out.brake.electric <= out.brake.total
}

/// CMD-3f: what rates and ramps count from is our last output.
#[must_use]
pub fn cmd_3_rates_count_from_the_output(cycle: &Cycle<'_>) -> bool {
    let (next, out) = (cycle.next, cycle.outputs);
    next.drive.torque == out.drive.torque
        && next.brake.total == out.brake.total
        && next.brake.retarder == out.retarder.torque
        && next.steering.weight == out.steering.weight
        && next.steering.angle == out.steering.angle
        && next.steering.overlay == out.steering.overlay
        && next.body == out.body
}

/// CMD-7a, CMD-2e: what the main controller sends is no evidence: after `record` seat, boot, clock, high voltage, gear, mitigation and
/// latches are what the inputs made of them, *parked by leave* ends by our own release only, and no mode begins that driver
/// evidence does not permit.
#[must_use]
pub fn cmd_7_commands_are_no_evidence(cycle: &Cycle<'_>) -> bool {
    let (new, next) = (cycle.new, cycle.next);
    next.seat == new.seat
        && next.boot == new.boot
        && next.clock == new.clock
        && next.high_voltage == new.high_voltage
        && next.gear == new.gear
        && next.mitigation == new.mitigation
        && next.latches == new.latches
        && next.flow == new.flow
        && next.parking.pedal == new.parking.pedal
        && next.parking.by_leave == (new.parking.by_leave && !cycle.releases())
        && implies(next.drive.armed, new.drive.armed)
        && implies(next.drive.mode != Mode::Manual && new.drive.mode == Mode::Manual, cycle.envelope.automated.is_ok())
        && next.brake.leave == new.brake.leave
}
