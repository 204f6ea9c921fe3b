//! K4 before K1, no load, ten minutes, and closing only by a restart (SEAT-7, SEAT-8, SEAT-11, HV-1).

use supervisor_core::{
    Contact, ContactorRequest, EpbState, Faults, HighVoltage, Key, LastKey, Pending, Percent, Restart, Seat, Stage,
    Timer,
};

use super::facts::{asked, has_run, runs, runs_while};
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
    self_7_contactor_fault_closes_nothing,
    seat_7_stages_exactly,
    seat_7_k4_opens_with_parking_brake,
    seat_7_deadlines,
    seat_7_sequence_stays_owed,
    seat_11_ten_minutes_exactly,
    rule_4_guard_lost_waits,
    self_9_clean_key_on,
    self_11_contactors_pass,
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

/// SEAT-7a: ten minutes parked by leave with the guards kept: K4 is commanded open, whatever the controller says, and also where a
/// shutdown was complete and high voltage is on again.
#[must_use]
pub fn seat_7_shutdown_happens(cycle: &Cycle<'_>) -> bool {
    let due = matches!(cycle.old.high_voltage.stage, Stage::Up | Stage::Down)
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

/// SEAT-7k, SEAT-8a: once K4 is commanded the sequence is committed: it ends in *down* only; from there only the driver's restart
/// leads up.
#[must_use]
pub fn seat_7_committed(cycle: &Cycle<'_>) -> bool {
    let (old, new) = (cycle.old.high_voltage.stage, cycle.new.high_voltage.stage);
    match old {
        Stage::Up => matches!(new, Stage::Up | Stage::OpeningK4),
        Stage::OpeningK4 => matches!(new, Stage::OpeningK4 | Stage::OpeningK1),
        Stage::OpeningK1 => matches!(new, Stage::OpeningK1 | Stage::Down),
        Stage::Down => {
            matches!(new, Stage::Down | Stage::OpeningK4 | Stage::Up)
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

/// SEAT-7a, SEAT-7e, SEAT-7k, SEAT-8a: every step of the shutdown on its own evidence, and no other: it begins exactly when ten
/// minutes have run and every guard is kept, and again when high voltage is on after it was down, goes on by the confirmed
/// contactors, and ends by the driver's restart.
#[must_use]
pub fn seat_7_stages_exactly(cycle: &Cycle<'_>) -> bool {
    let (old, new, inputs) = (&cycle.old.high_voltage, &cycle.new.high_voltage, cycle.inputs);
    let (k4_open, k1_open) = (inputs.k4.is(Contact::Open), inputs.k1.is(Contact::Open));
    let begins = has_run(new.parked, cycle.config.shutdown_after)
        && !(k4_open && k1_open)
        && cycle.vacant()
        && cycle.stands()
        && inputs.epb.is(EpbState::Applied)
        && cycle.torque_stopped();
    let next = match old.stage {
        Stage::Up | Stage::Down if begins => Stage::OpeningK4,
        Stage::OpeningK4 if k4_open => Stage::OpeningK1,
        Stage::OpeningK1 if k4_open && k1_open => Stage::Down,
        Stage::Down if new.restart == Restart::Started => Stage::Up,
        Stage::Up | Stage::OpeningK4 | Stage::OpeningK1 | Stage::Down => old.stage,
    };
    new.stage == next
}

/// A shutdown that has begun and is not complete.
const fn committed(stage: Stage) -> bool {
    matches!(stage, Stage::OpeningK4 | Stage::OpeningK1)
}

/// SEAT-7c: what no usable command asks for, K4 open, goes out only by the shutdown, with the parking brake confirmed applied.
#[must_use]
pub fn seat_7_k4_opens_with_parking_brake(cycle: &Cycle<'_>) -> bool {
    let wanted = asked(cycle.commands.contactors, cycle.config.timeout_100);
    let by_request = wanted.is_some_and(|contactors| contactors.k4 == ContactorRequest::Open);
    let opens = cycle.outputs.contactors.k4 == ContactorRequest::Open;
    let stage = cycle.new.high_voltage.stage;
    implies(opens && !by_request, cycle.inputs.epb.is(EpbState::Applied) && committed(stage))
        && implies(cycle.envelope.k4.obliged, cycle.inputs.epb.is(EpbState::Applied) && committed(stage))
}

/// SEAT-7h, SELF-3e: the wait of each stage begins anew with it; a missed deadline is reported at once, and as a contactor fault
/// that latches in the next cycle.
#[must_use]
pub fn seat_7_deadlines(cycle: &Cycle<'_>) -> bool {
    let (old, new, config) = (&cycle.old.high_voltage, &cycle.new.high_voltage, cycle.config);
    let overdue = |machine: &HighVoltage, stage, deadline| machine.stage == stage && has_run(machine.wait, deadline);
    let k4 = |machine| overdue(machine, Stage::OpeningK4, config.k4_deadline);
    let k1 = |machine| overdue(machine, Stage::OpeningK1, config.k1_deadline);
    let before = if new.stage == old.stage { old.wait } else { Timer::STOPPED };
    runs_while(new.stage != Stage::Up, before, new.wait, cycle.obliging())
        && cycle.reports(Faults::K4_OVERDUE, k4(new))
        && cycle.reports(Faults::K1_OVERDUE, k1(new))
        && implies(k4(old) || k1(old), cycle.new.latches.faults.contains(Faults::CONTACTOR))
}

/// SEAT-7i, SEAT-7j, SEAT-7k, RULE-4b: however long it takes, a committed shutdown keeps K4 commanded open while its guards are
/// kept, and K1 as soon as its guards are met; nothing closes meanwhile.
#[must_use]
pub fn seat_7_sequence_stays_owed(cycle: &Cycle<'_>) -> bool {
    let (stage, inputs, out) = (cycle.new.high_voltage.stage, cycle.inputs, &cycle.outputs.contactors);
    let standing = cycle.stands() && !cycle.safe_state();
    let k4 = committed(stage) && standing && inputs.epb.is(EpbState::Applied) && cycle.torque_stopped();
    let k1 = stage == Stage::OpeningK1 && standing && inputs.k4.is(Contact::Open) && cycle.loads_stopped();
    let closes = out.k4 == ContactorRequest::Close || out.k1 == ContactorRequest::Close;
    implies(k4, out.k4 == ContactorRequest::Open)
        && implies(k1, out.k1 == ContactorRequest::Open)
        && implies(committed(stage), !closes)
}

/// SEAT-9b, SEAT-11a to SEAT-11f: the ten minutes, exactly. Reset without *parked by leave*, by the confirmed driver and by the parking
/// brake known released; frozen while its state or the seat forbids; an unknown seat lets them continue, not begin; saturating.
#[must_use]
pub fn seat_11_ten_minutes_exactly(cycle: &Cycle<'_>) -> bool {
    let (old, new) = (cycle.old.high_voltage.parked, cycle.new.high_voltage.parked);
    let inputs = cycle.inputs;
    if !cycle.new.parking.by_leave || cycle.confirmed() || inputs.epb.is(EpbState::Released) {
        return new == Timer::STOPPED;
    }
    let counts = cycle.vacant() || (!cycle.partly_occupied() && old.is_running());
    if counts && inputs.epb.is(EpbState::Applied) { runs(old, new, cycle.permitting()) } else { new == old }
}

/// RULE-4b: a shutdown whose guard is lost waits and stays owed: nothing opens while the bus rolls or its speed is unknown, and the stage
/// is kept but for what the contactors confirm.
#[must_use]
pub fn rule_4_guard_lost_waits(cycle: &Cycle<'_>) -> bool {
    let out = &cycle.outputs.contactors;
    let opens = out.k4 == ContactorRequest::Open || out.k1 == ContactorRequest::Open;
    implies(!cycle.stands(), !opens)
        && implies(committed(cycle.old.high_voltage.stage), cycle.new.high_voltage.stage != Stage::Up)
}

/// SELF-9b, SEAT-8a, SEAT-8b: a clean key-on with the seat confirmed occupied counts as Off seen, once; nothing else but the key known Off does, and a
/// restart that was begun goes on by Start after another known position, while the seat is not lost and not both contactors are closed.
#[must_use]
pub fn self_9_clean_key_on(cycle: &Cycle<'_>) -> bool {
    let (old, new, inputs) = (&cycle.old.high_voltage, cycle.new.high_voltage.restart, cycle.inputs);
    let clean = cycle.old.boot.pending == Pending::Clean;
    let used = inputs.k1.is(Contact::Closed) && inputs.k4.is(Contact::Closed);
    let edge = inputs.key.is(Key::Start) && !matches!(old.key, LastKey::Start | LastKey::None);
    let restart = if !(cycle.confirmed() && sits(inputs)) {
        Restart::Idle
    } else if inputs.key.is(Key::Off) {
        Restart::OffSeen
    } else {
        match old.restart {
            Restart::Idle if clean => Restart::OffSeen,
            Restart::OffSeen if edge => Restart::Started,
            Restart::Started if used => Restart::Idle,
            Restart::Idle | Restart::OffSeen | Restart::Started => old.restart,
        }
    };
    let key = match inputs.key.known() {
        None => old.key,
        Some(Key::Off) => LastKey::Off,
        Some(Key::On) => LastKey::On,
        Some(Key::Start) => LastKey::Start,
    };
    new == restart
        && cycle.new.high_voltage.key == key
        && implies(cycle.confirmed(), cycle.new.boot.pending == Pending::Done)
}

/// SELF-11h: no shutdown, nothing latched: hold passes, and so does what is in order at standstill: K4 open without torque, then K1 open
/// without load; after the restart K1 closed before K4.
#[must_use]
pub fn self_11_contactors_pass(cycle: &Cycle<'_>) -> bool {
    let Some(wanted) = asked(cycle.commands.contactors, cycle.config.timeout_100) else { return true };
    let (machine, inputs) = (&cycle.new.high_voltage, cycle.inputs);
    let restarted = machine.restart == Restart::Started && !cycle.new.latches.faults.contains(Faults::CONTACTOR);
    let (k4_open, k1_closed) = (inputs.k4.is(Contact::Open), inputs.k1.is(Contact::Closed));
    let no_torque = cycle.torque_stopped() && cycle.outputs.drive.torque == Percent::ZERO;
    let in_order = |request, may_open, may_close| match request {
        ContactorRequest::Hold => true,
        ContactorRequest::Open => cycle.stands() && may_open,
        ContactorRequest::Close => restarted && may_close,
    };
    let legal =
        in_order(wanted.k4, no_torque, k1_closed) && in_order(wanted.k1, k4_open && cycle.loads_stopped(), k4_open);
    implies(!committed(machine.stage) && !cycle.safe_state() && legal, cycle.outputs.contactors == wanted)
}
