//! What boot may leave behind (SELF-9).

use supervisor_core::{Clock, HighVoltage, Parking, PedalChain, Record, Restart, SeatState, State, Timer};

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
