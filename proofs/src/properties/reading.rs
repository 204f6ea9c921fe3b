//! What the inputs of a cycle say about driver, pedals, speed and steering, read once more from the requirements: a
//! property does not take the word of the code that it judges.

use supervisor_core::{AngleDeciDeg, Config, Deviation, Inputs, Pedal250, Signal, Ticks, kernel};

use super::{Cycle, sits};

/// SELF-3: what this cycle adds to the timers.
pub(crate) fn ticks(cycle: &Cycle<'_>) -> Ticks {
    Ticks { permission: cycle.permitting(), safety: cycle.obliging(), fault: cycle.clock_fault() }
}

/// One track of a pedal, where it is known and plausible: 250 × 0.4 % is all of it.
fn track(signal: Signal<Pedal250>) -> Option<u8> {
    signal.known().map(Pedal250::raw).filter(|travel| *travel <= 250)
}

/// E2E-1d: two tracks are known while they agree; the lower one counts.
fn travel([first, second]: [Signal<Pedal250>; 2], config: &Config) -> Option<u8> {
    let (first, second) = (track(first)?, track(second)?);
    (first.abs_diff(second) <= config.pedal_agree.raw()).then_some(first.min(second))
}

/// Any track of a pedal says pressed.
fn any_pressed(tracks: [Signal<Pedal250>; 2], config: &Config) -> bool {
    tracks.iter().any(|signal| track(*signal).is_some_and(|travel| travel > config.pedal_pressed.raw()))
}

/// The accelerator.
pub(crate) fn accelerator(cycle: &Cycle<'_>) -> Option<u8> {
    cycle.accelerator().map(Pedal250::raw)
}

/// The brake pedal is known released: by its switch and by both tracks.
pub(crate) fn brake_released(cycle: &Cycle<'_>) -> bool {
    let Inputs { brake_pedal, brake_switch, .. } = *cycle.inputs;
    brake_switch.is(false) && travel(brake_pedal, cycle.config).is_some() && !any_pressed(brake_pedal, cycle.config)
}

/// TRQ-1c: the accelerator is pressed, and the brake pedal is, or may be.
pub(crate) fn both_pedals(cycle: &Cycle<'_>) -> bool {
    any_pressed(cycle.inputs.accelerator, cycle.config) && !brake_released(cycle)
}

/// RULE-6c: both speeds where they agree, the lower one first.
pub(crate) fn agreed_speeds(cycle: &Cycle<'_>) -> Option<(u16, u16)> {
    cycle.agreed_speeds()
}

/// The same of inputs alone.
pub(crate) fn agreed_speeds_of(inputs: &Inputs, config: &Config) -> Option<(u16, u16)> {
    let (wheel, motor) = (inputs.wheel_speed.known()?.raw(), inputs.motor_speed.known()?.raw());
    let (low, high, difference) = (wheel.min(motor), wheel.max(motor), wheel.abs_diff(motor));
    let close = difference <= config.speed_agree.raw()
        || kernel::within_percent(difference, config.speed_agree_percent.raw(), high);
    close.then_some((low, high))
}

/// SEAT-0a: the seat is confirmed occupied.
pub(crate) fn confirmed(cycle: &Cycle<'_>) -> bool {
    sits(cycle.inputs) && cycle.new.seat.occupied.reached(cycle.config.seat_confirm)
}

/// STR-1d: the steering-wheel angle, where it is known and plausible.
pub(crate) fn steering_angle(cycle: &Cycle<'_>) -> Option<i16> {
    let range = cycle.config.steering_range.raw().unsigned_abs();
    cycle.inputs.steering_angle.known().map(AngleDeciDeg::raw).filter(|angle| angle.unsigned_abs() <= range)
}

/// A mitigation latch, or the hold that follows it.
pub(crate) fn mitigates(cycle: &Cycle<'_>) -> bool {
    cycle.new.mitigation.running() || cycle.new.mitigation.hold
}

/// An obligation runs: leave, mitigation, the safe state, a bypass, a drive that does not obey.
pub(crate) fn obliged(cycle: &Cycle<'_>) -> bool {
    cycle.new.seat.leave
        || mitigates(cycle)
        || cycle.new.is_safe_state()
        || cycle.response.bypass
        || cycle.response.torque != Deviation::None
}
