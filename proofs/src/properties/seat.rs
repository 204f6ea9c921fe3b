//! Who sits, and when *leave* begins and ends (SEAT-0, SEAT-1, SEAT-9, SEAT-10).

use supervisor_core::{
    ContactorRequest, DecelMs2Q11, EpbRequest, EpbState, Faults, GearRequest, Millis, Mode, Percent, Reason, Restart,
    Seat, Stage, Timer,
};

use super::facts::{asked, has_run, runs, runs_while};
use super::{Cycle, Property, all, implies, sits};

/// Every property of this file.
pub const ALL: &[Property] = all![
    seat_5_confirmation_counts_real_time,
    seat_0a_confirmed_exactly,
    seat_1_leave_begins_and_ends_exactly,
    seat_1_vacancy_counts_exactly,
    seat_1_leave_warns,
    seat_9_return_ends_and_resets,
    seat_9_nothing_is_given_back_by_itself,
    seat_10_unknown_obliges_nothing,
    seat_10_unknown_permits_nothing,
    seat_10_unknown_is_reported,
];

/// SEAT-0a: what *confirmed* rests on: the timer counts no more than the time that passed with both sensors known
/// occupied in this cycle and the one before, and is lost at once on anything else.
#[must_use]
pub fn seat_5_confirmation_counts_real_time(cycle: &Cycle<'_>) -> bool {
    let (old, new) = (cycle.old.seat.occupied, cycle.new.seat.occupied);
    let passed = cycle.now.raw().wrapping_sub(cycle.old.clock.last.raw());
    let counted = new.elapsed().raw().saturating_sub(old.elapsed().raw());
    implies(!sits(cycle.inputs), new == Timer::STOPPED)
        && implies(!old.is_running(), new.elapsed() == Millis::ZERO)
        && implies(cycle.old.clock.started, counted <= passed)
        && implies(!cycle.old.clock.started, counted == 0)
}

/// SEAT-0a, SELF-3d: confirmed occupied exactly when both sensors have been known occupied without a break for the
/// configured time, counted as permission timers count; anything else ends it at once.
#[must_use]
pub fn seat_0a_confirmed_exactly(cycle: &Cycle<'_>) -> bool {
    let (old, new) = (cycle.old.seat.occupied, cycle.new.seat.occupied);
    runs_while(sits(cycle.inputs), old, new, cycle.permitting())
        && cycle.new.seat.confirmed(cycle.config) == has_run(new, cycle.config.seat_confirm)
}

/// SEAT-0b, SEAT-1a, SEAT-1h, SEAT-9a, RULE-6a: leave begins exactly when the bus is not parked and both sensors have
/// been known vacant together for 2 s; it ends exactly when the seat is confirmed occupied.
#[must_use]
pub fn seat_1_leave_begins_and_ends_exactly(cycle: &Cycle<'_>) -> bool {
    let begins = cycle.not_parked() && has_run(cycle.new.seat.vacant, cycle.config.seat_vacant);
    cycle.new.seat.leave == if cycle.old.seat.leave { !cycle.confirmed() } else { begins }
}

/// SEAT-1a, SEAT-1e, SEAT-1f, SEAT-1g, SELF-3e: the 2 s run with both sensors known vacant, parked or not; a sensor
/// known occupied resets them at once; unknown sensors freeze them for at most 500 ms and then reset them.
#[must_use]
pub fn seat_1_vacancy_counts_exactly(cycle: &Cycle<'_>) -> bool {
    let (old, new) = (&cycle.old.seat, &cycle.new.seat);
    if cycle.partly_occupied() {
        new.vacant == Timer::STOPPED && new.unknown == Timer::STOPPED
    } else if cycle.vacant() {
        runs(old.vacant, new.vacant, cycle.obliging()) && new.unknown == Timer::STOPPED
    } else {
        let frozen = !has_run(new.unknown, cycle.config.seat_freeze);
        runs(old.unknown, new.unknown, cycle.permitting())
            && new.vacant == if frozen { old.vacant } else { Timer::STOPPED }
    }
}

/// SEAT-1b, SEAT-1c, SEAT-1d, SEAT-9a: during leave the seat-leave warning sounds and flashes (one signal) and the
/// hazard flashers are on, whatever the command; without leave nothing obliges the warning.
#[must_use]
pub fn seat_1_leave_warns(cycle: &Cycle<'_>) -> bool {
    let (out, leave) = (&cycle.outputs.warnings, cycle.new.seat.leave);
    let wanted = asked(cycle.commands.warnings, cycle.config.timeout_200);
    implies(leave, out.seat_leave && out.hazard_flashers)
        && out.seat_leave == (leave || wanted.is_some_and(|warnings| warnings.seat_leave))
        && implies(!leave && !cycle.safe_state(), !cycle.envelope.warnings.hazard_flashers)
}

/// SEAT-9a, SEAT-9b, SEAT-9d: the confirmed return ends leave with its warning, brake demand and torque limit, and sets
/// every counter of it to 0: the next leave begins as the first one did.
#[must_use]
pub fn seat_9_return_ends_and_resets(cycle: &Cycle<'_>) -> bool {
    let (new, envelope) = (cycle.new, cycle.envelope);
    let reasons = [envelope.torque.driver.reason, envelope.torque.automated.reason, envelope.target_speed.reason];
    implies(
        cycle.confirmed(),
        !new.seat.leave
            && new.seat.vacant == Timer::STOPPED
            && new.seat.unknown == Timer::STOPPED
            && !envelope.warnings.seat_leave
            && new.brake.leave == DecelMs2Q11::ZERO
            && reasons.iter().all(|reason| *reason != Reason::Leave)
            && new.parking.unconfirmed == Timer::STOPPED
            && new.parking.speedless == Timer::STOPPED
            && new.high_voltage.parked == Timer::STOPPED,
    )
}

/// SEAT-9c, RULE-1b: nothing is given back by itself: no release of the parking brake, no driving gear and no closed
/// contactor goes out that no usable command asks for; *parked by leave* and the shutdown outlast the return.
#[must_use]
pub fn seat_9_nothing_is_given_back_by_itself(cycle: &Cycle<'_>) -> bool {
    let (out, commands, config) = (cycle.outputs, cycle.commands, cycle.config);
    let asks = |request| asked(commands.epb, config.timeout_200).is_some_and(|epb| epb.request == request);
    let contactors = asked(commands.contactors, config.timeout_100);
    let closes = ContactorRequest::Close;
    let drives = matches!(out.gear, GearRequest::Drive | GearRequest::Reverse | GearRequest::Park);
    implies(out.epb.request == EpbRequest::Release, asks(EpbRequest::Release))
        && implies(drives, asked(commands.gear, config.timeout_100) == Some(out.gear))
        && implies(out.contactors.k4 == closes, contactors.is_some_and(|wanted| wanted.k4 == closes))
        && implies(out.contactors.k1 == closes, contactors.is_some_and(|wanted| wanted.k1 == closes))
        && implies(cycle.old.parking.by_leave, cycle.new.parking.by_leave)
        && implies(
            cycle.old.high_voltage.stage != Stage::Up && cycle.new.high_voltage.stage == Stage::Up,
            cycle.new.high_voltage.restart == Restart::Started,
        )
}

/// SEAT-10a, RULE-1b: sensors that disagree or are unknown count no vacancy, begin no leave (but by 2 s that were counted
/// before and are frozen for at most 500 ms, SEAT-1f), do not start the 10 min, and begin no shutdown.
#[must_use]
pub fn seat_10_unknown_obliges_nothing(cycle: &Cycle<'_>) -> bool {
    let (old, new, config) = (cycle.old, cycle.new, cycle.config);
    let frozen = has_run(old.seat.vacant, config.seat_vacant)
        && !cycle.partly_occupied()
        && !has_run(new.seat.unknown, config.seat_freeze);
    implies(
        !cycle.vacant(),
        implies(new.seat.leave, old.seat.leave || frozen)
            && new.seat.vacant <= old.seat.vacant
            && implies(!old.high_voltage.parked.is_running(), !new.high_voltage.parked.is_running())
            && implies(new.high_voltage.stage == Stage::OpeningK4, old.high_voltage.stage == Stage::OpeningK4),
    )
}

/// SEAT-10b: unless both sensors are known occupied, every permission that needs an occupied seat is refused: release,
/// closing, park, hill-hold, the begin of the automated mode, and, unless the bus is known to roll with its brake
/// released, driving gears and torque.
#[must_use]
pub fn seat_10_unknown_permits_nothing(cycle: &Cycle<'_>) -> bool {
    let envelope = cycle.envelope;
    let rolls = cycle.lower_at_least(cycle.config.epb_speed) && cycle.inputs.epb.is(EpbState::Released);
    let bounds = [envelope.torque.driver, envelope.torque.automated, envelope.torque.epbi];
    implies(
        !sits(cycle.inputs),
        !cycle.confirmed()
            && envelope.epb.release.is_err()
            && envelope.k4.close.is_err()
            && envelope.k1.close.is_err()
            && envelope.gear.park.is_err()
            && !envelope.torque.hill_hold
            && implies(cycle.new.drive.mode == Mode::Manual, envelope.automated.is_err())
            && implies(
                !rolls,
                envelope.gear.drive.is_err()
                    && envelope.gear.reverse.is_err()
                    && bounds.iter().all(|bound| bound.most == Percent::ZERO),
            ),
    )
}

/// SEAT-10c: sensors that disagree, or of which one is unknown, are reported, each by its own fault.
#[must_use]
pub fn seat_10_unknown_is_reported(cycle: &Cycle<'_>) -> bool {
    let unknown = cycle.inputs.seat.iter().any(|sensor| sensor.known().is_none());
    let differ = cycle.partly_occupied() && !sits(cycle.inputs);
    let neither = cycle.inputs.seat.iter().all(|sensor| !sensor.is(Seat::Occupied));
    cycle.reports(Faults::SEAT_DISAGREE, differ) && cycle.reports(Faults::SEAT_UNKNOWN, unknown && neither)
}
