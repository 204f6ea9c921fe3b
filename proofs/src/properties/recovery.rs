//! What a damaged state keeps, and what it permits (SELF-5).

use supervisor_core::{
    Faults, HighVoltage, Image, LastKey, Mode, Parking, Pending, Percent, Restart, Row, SeatState, State, Timer,
};

use supervisor_core::{Flow, PedalChain};

/// SELF-5c, RULE-1d: after damage every obligation of the old state goes on: leave, its demand and counters, *parked by leave*, the shutdown,
/// every mitigation latch, every latched fault; and it is the safe state.
#[must_use]
pub fn self_5_damage_keeps_obligations(old: &State, damaged: &State) -> bool {
    let SeatState { leave, vacant, unknown, .. } = damaged.seat;
    let Parking { by_leave, unconfirmed, slow, speedless, .. } = damaged.parking;
    let HighVoltage { stage, parked, wait, .. } = damaged.high_voltage;
    (leave, vacant, unknown) == (old.seat.leave, old.seat.vacant, old.seat.unknown)
        && (by_leave, unconfirmed) == (old.parking.by_leave, old.parking.unconfirmed)
        && (slow, speedless) == (old.parking.slow, old.parking.speedless)
        && (stage, parked, wait) == (old.high_voltage.stage, old.high_voltage.parked, old.high_voltage.wait)
        && damaged.mitigation == old.mitigation
        && damaged.brake == old.brake
        && damaged.gear == old.gear
        && damaged.steering == old.steering
        && damaged.clock == old.clock
        && damaged.monitors == old.monitors
        && damaged.drive.release_needed
        && damaged.latches.faults == old.latches.faults.with(Faults::STATE)
}

/// SELF-5b, SELF-5c: and it permits nothing: the safe state, nobody confirmed, no pedal, no restart, no mode, no torque, no clean boot, and no
/// fault-free time.
#[must_use]
pub fn self_5_damage_permits_nothing(damaged: &State) -> bool {
    damaged.is_safe_state()
        && damaged.latches.faults.contains(Faults::STATE)
        && damaged.latches.quiet == Timer::STOPPED
        && !damaged.latches.off_seen
        && damaged.seat.occupied == Timer::STOPPED
        && damaged.parking.pedal == PedalChain::Waiting
        && damaged.high_voltage.restart == Restart::Idle
        && damaged.high_voltage.key == LastKey::None
        && damaged.drive.mode == Mode::Manual
        && damaged.drive.torque == Percent::ZERO
        && !damaged.drive.armed
        && damaged.boot.pending == Pending::Other
        && damaged.flow == Flow::RECORDED
}

/// SELF-5a, SELF-5c: after any single flipped bit of an image of `N` words and complements, which decodes without it, it does not decode, and what is
/// recovered is what was put to rest; one of the digest, which nothing else needs, changes nothing. The shipped code is generic
/// in `N`.
#[must_use]
pub fn self_5_flipped_bit_is_recovered<const N: usize>(words: [u32; N], index: usize, bit: u32) -> bool {
    let value = Row(words);
    let intact = Image::<N>::encode(&value);
    let image = intact.with_flipped_bit(index, bit);
    let decoded = image.decode::<Row<u32, N>>();
    if intact.decode() != Some(value) {
        false
    } else if index >= N.saturating_mul(2) {
        decoded == Some(value)
    } else {
        decoded.is_none() && image.recover::<Row<u32, N>>() == Some(value)
    }
}
