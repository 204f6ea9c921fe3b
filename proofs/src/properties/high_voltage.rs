//! K4 before K1, no load, ten minutes, and closing only by a restart (SEAT-7, SEAT-8, SEAT-11, HV-1).

use supervisor_core::{
    Contact, ContactorRequest, EpbState, Faults, Key, LastKey, Percent, Restart, Seat, Stage, Timer,
};

use super::{Cycle, Property, all, implies, sits};

/// Every property of this file.
pub const ALL: &[Property] = all![
    seat_7_k1_after_k4,
    hv_1_k4_opens_without_load,
    seat_7_shutdown_happens,
    seat_7_k1_follows,
    seat_7_committed,
    seat_11_ten_minutes_are_real,
    seat_8_close_needs_restart,
    seat_8_restart_in_order,
    self_7_contactor_fault_closes_nothing
];

/// SEAT-7f, g, HV-1b, HV-1c: K1 is never commanded open before K4 is confirmed open and drive and auxiliaries have stopped.
#[must_use]
pub fn seat_7_k1_after_k4(cycle: &Cycle<'_>) -> bool {
    let opens = cycle.outputs.contactors.k1 == ContactorRequest::Open;
    implies(opens, cycle.inputs.k4.is(Contact::Open) && cycle.loads_stopped() && cycle.standstill())
}

/// SEAT-7b, d, HV-1a, HV-1c: K4 opens only at standstill with no drive torque, executed or sent.
#[must_use]
pub fn hv_1_k4_opens_without_load(cycle: &Cycle<'_>) -> bool {
    let opens = cycle.outputs.contactors.k4 == ContactorRequest::Open;
    implies(opens, cycle.standstill() && cycle.torque_stopped() && cycle.outputs.drive.torque == Percent::ZERO)
}

/// SEAT-7a: ten minutes parked by leave with the guards kept: K4 is commanded open, whatever the controller says.
#[must_use]
pub fn seat_7_shutdown_happens(cycle: &Cycle<'_>) -> bool {
    let due = cycle.old.high_voltage.stage == Stage::Up
        && cycle.new.high_voltage.parked.reached(cycle.config.shutdown_after)
        && !(cycle.inputs.k4.is(Contact::Open) && cycle.inputs.k1.is(Contact::Open))
        && cycle.agreed_standstill()
        && cycle.inputs.seat.iter().all(|sensor| sensor.is(Seat::Vacant))
        && cycle.inputs.epb.is(EpbState::Applied)
        && cycle.torque_stopped()
        && !cycle.new.is_safe_state();
    implies(due, cycle.outputs.contactors.k4 == ContactorRequest::Open)
}

/// SEAT-7e: in the second stage K1 is commanded open as soon as K4 and the loads are confirmed.
#[must_use]
pub fn seat_7_k1_follows(cycle: &Cycle<'_>) -> bool {
    let due = cycle.new.high_voltage.stage == Stage::OpeningK1
        && cycle.inputs.k4.is(Contact::Open)
        && cycle.loads_stopped()
        && cycle.agreed_standstill()
        && !cycle.new.is_safe_state();
    implies(due, cycle.outputs.contactors.k1 == ContactorRequest::Open)
}

/// SEAT-7k: once K4 is commanded the sequence is committed: it ends in *down* only.
#[must_use]
pub fn seat_7_committed(cycle: &Cycle<'_>) -> bool {
    let (old, new) = (cycle.old.high_voltage.stage, cycle.new.high_voltage.stage);
    match old {
        Stage::Up => matches!(new, Stage::Up | Stage::OpeningK4),
        Stage::OpeningK4 => matches!(new, Stage::OpeningK4 | Stage::OpeningK1),
        Stage::OpeningK1 => matches!(new, Stage::OpeningK1 | Stage::Down),
        Stage::Down => {
            matches!(new, Stage::Down | Stage::Up)
                && implies(new == Stage::Up, cycle.new.high_voltage.restart == Restart::Started)
        }
    }
}

/// SEAT-7a, SEAT-11a to SEAT-11c: the ten minutes count no more than real time, and only with the brake known applied.
#[must_use]
pub fn seat_11_ten_minutes_are_real(cycle: &Cycle<'_>) -> bool {
    let (old, new) = (cycle.old.high_voltage.parked, cycle.new.high_voltage.parked);
    let passed = cycle.now.raw().wrapping_sub(cycle.old.clock.last.raw());
    let counted = new.elapsed().raw().saturating_sub(old.elapsed().raw());
    implies(counted > 0, cycle.inputs.epb.is(EpbState::Applied) && counted <= passed && !sits(cycle.inputs))
        && implies(cycle.inputs.epb.is(EpbState::Released), new == Timer::STOPPED)
        && implies(!cycle.new.parking.by_leave, new == Timer::STOPPED)
}

/// SEAT-8a, c, HV-1d: a contactor closes only after the driver's restart, K1 before K4.
#[must_use]
pub fn seat_8_close_needs_restart(cycle: &Cycle<'_>) -> bool {
    let closes = |request| request == ContactorRequest::Close;
    let out = cycle.outputs.contactors;
    let restarted = cycle.new.high_voltage.restart == Restart::Started && sits(cycle.inputs);
    implies(closes(out.k1) || closes(out.k4), restarted)
        && implies(closes(out.k4), cycle.inputs.k1.is(Contact::Closed))
        && implies(closes(out.k1), cycle.inputs.k4.is(Contact::Open))
}

/// SEAT-8a, b: the restart goes *idle*, *Off seen*, *started*, each step on its own evidence, and is lost with the seat.
#[must_use]
pub fn seat_8_restart_in_order(cycle: &Cycle<'_>) -> bool {
    let (old, new) = (cycle.old.high_voltage.restart, cycle.new.high_voltage.restart);
    let confirmed = sits(cycle.inputs) && cycle.new.seat.occupied.reached(cycle.config.seat_confirm);
    let off = cycle.inputs.key.is(Key::Off);
    let clean = cycle.old.boot.pending == supervisor_core::Pending::Clean;
    let edge = cycle.inputs.key.is(Key::Start) && !matches!(cycle.old.high_voltage.key, LastKey::Start | LastKey::None);
    implies(new != Restart::Idle, confirmed)
        && implies(new == Restart::OffSeen && old != Restart::OffSeen, off || clean)
        && implies(new == Restart::Started && old != Restart::Started, old == Restart::OffSeen && edge)
}

/// SELF-7a: with a contactor fault latched nothing closes.
#[must_use]
pub fn self_7_contactor_fault_closes_nothing(cycle: &Cycle<'_>) -> bool {
    let out = &cycle.outputs.contactors;
    let closes = out.k1 == ContactorRequest::Close || out.k4 == ContactorRequest::Close;
    implies(cycle.new.latches.faults.contains(Faults::CONTACTOR), !closes)
}
