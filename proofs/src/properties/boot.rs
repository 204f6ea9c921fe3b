//! What boot may leave behind (SELF-9).

use supervisor_core::{
    Boot, Clock, HighVoltage, Parking, PedalChain, Pending, Record, ResetCause, Restart, SeatState, Stage, State, Timer,
};

/// SELF-9c, d: what boot may leave behind: nothing confirmed, no restart, and every record but *none* parks by leave.
#[must_use]
pub fn self_9_boot(state: &State, record: Option<Record>) -> bool {
    let State { seat: SeatState { occupied, .. }, parking: Parking { by_leave, pedal, .. }, .. } = *state;
    let State { high_voltage: HighVoltage { restart, parked, .. }, clock: Clock { started, .. }, .. } = *state;
    occupied == Timer::STOPPED
        && !started
        && pedal == PedalChain::Waiting
        && restart == Restart::Idle
        && parked == Timer::STOPPED
        && by_leave == matches!(record, Some(Record::Leave | Record::HighVoltageDown))
}

/// SELF-9a, SELF-9e, SELF-9d: what boot makes of the reset cause and the record: only power-on with an intact record of
/// nothing is clean; leave goes on as leave, high voltage that was going down is still owed; everything else is as after
/// any reset.
#[must_use]
pub fn self_9_boot_exactly(state: &State, cause: ResetCause, record: Option<Record>) -> bool {
    let clean = cause == ResetCause::PowerOn && record == Some(Record::None);
    let leave = record == Some(Record::Leave);
    let down = record == Some(Record::HighVoltageDown);
    let pending = if clean { Pending::Clean } else { Pending::Other };
    let shutdown = if down { Stage::OpeningK4 } else { Stage::Up };
    let expected = State {
        boot: Boot { pending, ..Boot::INITIAL },
        seat: SeatState { leave, ..SeatState::INITIAL },
        parking: Parking { by_leave: leave || down, ..Parking::INITIAL },
        high_voltage: HighVoltage { stage: shutdown, ..HighVoltage::INITIAL },
        ..State::INITIAL
    };
    *state == expected
}

/// SELF-9a: what is persisted leads back to it: leave or *parked by leave*, and a shutdown that has begun, survive any
/// reset.
#[must_use]
pub fn self_9_record_survives(state: &State, cause: ResetCause) -> bool {
    let booted = State::boot(cause, Some(state.record()));
    let shut = state.high_voltage.stage != Stage::Up;
    booted.parking.by_leave == (shut || state.seat.leave || state.parking.by_leave)
        && (booted.high_voltage.stage != Stage::Up) == shut
        && booted.seat.leave == (!shut && (state.seat.leave || state.parking.by_leave))
}
