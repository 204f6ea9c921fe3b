//! How a value stands in a field of a frame.
//!
//! Raw values that mean nothing decode to `None`: the world is closed. "Not available" is the greatest raw value of
//! the field in our messages, and what J1939-71 says in those of J1939 (E2E-1i).

use supervisor_core::{Cause, DecelMs2Q11, Millis, Origin, Percent, Signal, Word};

/// A way to write values of type `T` into a field whose greatest raw value is `full`.
pub(crate) trait Coding<T> {
    /// The raw value.
    fn encode(value: T, full: u64) -> u64;
    /// The value; `None` if no value is written as `raw`.
    fn decode(raw: u64, full: u64) -> Option<T>;
    /// Makes a signal unknown; a command stays as it is.
    fn degrade(_value: &mut T, _cause: Cause) {}
}

fn word<T: Word>(raw: u64) -> Option<T> {
    T::from_word(u32::try_from(raw).ok()?)
}
fn raw<T: Word>(value: T) -> u64 {
    u64::from(value.to_word())
}
fn raw_signal<T: Word>(signal: Signal<T>, not_available: u64) -> u64 {
    match signal {
        Signal::Known(value) => raw(value),
        Signal::Unknown(_) => not_available,
    }
}
/// CMD-1b, c, E2E-1i: "not available" is unknown; what means nothing is refused.
fn word_signal<T: Word>(raw: u64, not_available: u64) -> Option<Signal<T>> {
    if raw == not_available { Some(Signal::Unknown(Cause::NotAvailable)) } else { word(raw).map(Signal::Known) }
}

/// One coding per row; `[signal]` marks those of signals, which can be degraded.
macro_rules! coding {
    ($($(#[$doc:meta])* $([$signal:ident])? $name:ident $(<$generic:ident>)? ($type:ty):
        |$value:ident, $greatest:pat_param| $encode:expr, |$raw:ident, $full:pat_param| $decode:expr;)*) => {$(
        $(#[$doc])*
        pub(crate) struct $name;
        impl $(<$generic: Word>)? Coding<$type> for $name {
            fn encode($value: $type, $greatest: u64) -> u64 {
                $encode
            }
            fn decode($raw: u64, $full: u64) -> Option<$type> {
                $decode
            }
            $(fn degrade($signal: &mut $type, cause: Cause) {
                *$signal = Signal::Unknown(cause);
            })?
        }
    )*};
}

/// Raw value of no torque (SPN 518: 1 %, from −125 %) and of no acceleration (SPN 2920: 1/2048 m/s², from −15.687).
const NO_TORQUE: u64 = 125;
const NO_ACCELERATION: u64 = 32_127;

coding! {
    /// The code of an enumeration, or the bits of a number: every value of the type, exactly.
    Plain<T>(T): |value, _| raw(value), |raw, _| word(raw);
    /// A signal of ours: the same, and the greatest raw value is "not available".
    [signal] Measured<T>(Signal<T>): |value, full| raw_signal(value, full), |raw, full| word_signal(raw, full);
    /// The same for numbers in two's complement.
    [signal] MeasuredSigned<T>(Signal<T>):
        |value, full| raw_signal(value, full >> 1), |raw, full| word_signal(raw, full >> 1);
    /// E2E-1i: a J1939 number of 8 or 16 bits, by its upper byte: up to 0xFA valid, 0xFB to 0xFD out of range, 0xFE
    /// error, 0xFF not available.
    [signal] Spn<T>(Signal<T>): |value, full| raw_signal(value, full),
        |raw, full| match raw >> (full.count_ones().saturating_sub(8)) {
            0..=0xFA => word(raw).map(Signal::Known),
            0xFB..=0xFD => Some(Signal::Unknown(Cause::OutOfRange)),
            _ => Some(Signal::Unknown(Cause::NotAvailable)),
        };
    /// E2E-1i: a J1939 switch of 2 bits: off, on, error, not available.
    [signal] SpnSwitch(Signal<bool>): |value, full| raw_signal(value, full),
        |raw, _| Some(word(raw).map_or(Signal::Unknown(Cause::NotAvailable), Signal::Known));
    /// SPN 518 of a drive: torque 0 to 125 %; more is sent as 125 %, a negative one is refused.
    Torque(Percent): |value, _| raw(value).min(NO_TORQUE).saturating_add(NO_TORQUE),
        |raw, _| word(raw.checked_sub(NO_TORQUE).filter(|torque| *torque <= NO_TORQUE)?);
    /// SPN 518 of a retarder: braking is negative, 0 to −125 %; more is sent as −125 %, a positive one is refused.
    BrakingTorque(Percent): |value, _| NO_TORQUE.saturating_sub(raw(value)),
        |raw, _| word(NO_TORQUE.checked_sub(raw)?);
    /// SPN 2920: deceleration is negative, 0 to −15.687 m/s²; more is sent as that, acceleration is refused.
    Deceleration(DecelMs2Q11): |value, _| NO_ACCELERATION.saturating_sub(raw(value)),
        |raw, _| word(NO_ACCELERATION.checked_sub(raw)?);
    /// SPN 695 as the active flag: disabled or torque control; speed control and limits are refused.
    TorqueControl(bool): |value, _| raw(value) << 1, |raw, _| [(0, false), (2, true)].into_iter()
        .find_map(|(code, active)| (raw == code).then_some(active));
    /// SPN 3350, control purpose: P1 the driver's pedal, P2 cruise control for ADAS, P32 for the brake system.
    Purpose(Origin): |value, full| match value { Origin::Driver => 0, Origin::Adas => 1, Origin::Epbi => full },
        |raw, full| [(0, Origin::Driver), (1, Origin::Adas), (full, Origin::Epbi)].into_iter()
            .find_map(|(code, origin)| (raw == code).then_some(origin));
    /// Age in ms; the greatest raw value is "that old or older", and becomes as old as can be.
    Age(Millis): |value, full| raw(value).min(full),
        |raw, full| if raw == full { Some(Millis::new(u32::MAX)) } else { word(raw) };
    /// Pixels.
    Pixels(u16): |value, _| u64::from(value), |raw, _| u16::try_from(raw).ok();
}
