//! Numbers with their unit in the name.
//!
//! Every type wraps one integer and accepts every bit pattern: whether a value is *plausible* is decided
//! against the table of [`limits`](crate::Config), never by the type. `Q8`, `Q10`, `Q11` are fixed-point
//! formats: the value is the integer divided by 2⁸, 2¹⁰, 2¹¹.

use crate::kernel;
use crate::word::Word;

macro_rules! unit {
    ($($(#[$doc:meta])* $name:ident($raw:ty, $wide:ty);)*) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
        #[cfg_attr(kani, derive(kani::Arbitrary))]
        #[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
        pub struct $name($raw);

        impl $name {
            /// Zero of this unit.
            pub const ZERO: Self = Self(0);
            /// Wraps a number that is already in this unit.
            #[must_use]
            pub const fn new(raw: $raw) -> Self {
                Self(raw)
            }
            /// The number in this unit.
            #[must_use]
            pub const fn raw(self) -> $raw {
                self.0
            }
            /// The number in this unit, wide enough for verdicts and products.
            #[must_use]
            pub fn wide(self) -> $wide {
                <$wide>::from(self.0)
            }
        }
    )*};
}

unit! {
    /// Speed, 1/256 km/h per bit (J1939 SPN 84 and S4 table 5), 0 to 255.996 km/h.
    SpeedKmhQ8(u16, i32);
    /// Deceleration, 1/2048 m/s² per bit, 0 to 31.999 m/s².
    /// Finer than S4's 1/256 m/s² by 8, so that S4's values and those of J1939 XBR are both exact.
    DecelMs2Q11(u16, i32);
    /// Percentage, 1 % per bit; 0 to 100 is plausible.
    Percent(u8, i32);
    /// A number of things.
    Count(u8, i32);
    /// Rise or fall of a percentage, 1 %/s per bit.
    PercentPerS(u16, i32);
    /// Pedal travel, 0.4 % per bit (J1939 SPN 91, 521); 0 to 250 is plausible.
    Pedal250(u8, i32);
    /// Steering-wheel angle, 0.1° per bit, left positive (S4 STS 1).
    AngleDeciDeg(i16, i32);
    /// Steering-wheel rate, 0.1°/s per bit, magnitude (S4 STS 4).
    RateDeciDegS(u16, i32);
    /// Steering torque, 1/1024 Nm per bit, signed (S4 STS 3).
    TorqueNmQ10(i16, i32);
    /// Limit of the overlaid bar torque, 0.05 Nm per bit (S4 STS 6).
    BarTorque50mNm(u8, i32);
    /// High-voltage current, 0.1 A per bit, discharge positive.
    CurrentDeciA(i16, i32);
    /// Mass, 10 kg per bit (J1939 SPN 1760).
    Mass10Kg(u16, i32);
    /// Brake pressure, 5 kPa per bit (J1939 SPN 1091).
    Pressure5KPa(u8, i32);
    /// Longitudinal distance, 1 cm per bit, 0 to 655.35 m.
    DistanceCm(u16, i32);
    /// Lateral offset from the predicted path, 1 cm per bit, left positive.
    OffsetCm(i16, i32);
    /// Closing speed, 1 cm/s per bit, positive while the gap shrinks.
    ClosingCmS(i16, i32);
    /// A span of time, 1 ms per bit.
    Millis(u32, i64);
    /// Element of a rotation matrix, 1/2¹⁴ per bit: ±16 384 is ±1.
    RotationQ14(i16, i32);
    /// Distance in an image, 1 pixel per bit.
    Pixel(u16, i32);
}

impl Percent {
    /// One hundred per cent.
    pub const FULL: Self = Self(100);
}

macro_rules! unsigned_word {
    ($($name:ident($raw:ty)),*) => {$(
        impl Word for $name {
            fn to_word(self) -> u32 {
                u32::from(self.0)
            }
            fn from_word(word: u32) -> Option<Self> {
                <$raw>::try_from(word).ok().map(Self)
            }
        }
    )*};
}
unsigned_word!(SpeedKmhQ8(u16), DecelMs2Q11(u16), Percent(u8), Pedal250(u8), RateDeciDegS(u16));
unsigned_word!(Count(u8), PercentPerS(u16), Mass10Kg(u16), Pressure5KPa(u8));
unsigned_word!(BarTorque50mNm(u8), DistanceCm(u16), Millis(u32), Pixel(u16));

macro_rules! signed_word {
    ($($name:ident),*) => {$(
        impl Word for $name {
            fn to_word(self) -> u32 {
                // Two's complement in the low half: lossless both ways, and no sign extension to check.
                u32::from(self.0.cast_unsigned())
            }
            fn from_word(word: u32) -> Option<Self> {
                u16::try_from(word).ok().map(|raw| Self(raw.cast_signed()))
            }
        }
    )*};
}
signed_word!(AngleDeciDeg, TorqueNmQ10, CurrentDeciA, OffsetCm, ClosingCmS, RotationQ14);

/// A timer that counts from the first sample at which its condition held.
///
/// One word: 0 while it does not run, else elapsed milliseconds + 1. The first sample therefore counts nothing
/// (`elapsed = 0`), so a condition "for at least T" is never met early, whatever the cycle. Saturates.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
#[cfg_attr(kani, derive(kani::Arbitrary))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
pub struct Timer(u32);

impl Timer {
    /// Not running.
    pub const STOPPED: Self = Self(0);

    /// END-1a: starts a stopped timer at 0 ms, or adds `elapsed` to a running one.
    #[must_use]
    pub fn run(self, elapsed: Millis) -> Self {
        Self(kernel::counted(self.0, elapsed.0))
    }
    /// Runs while `condition` holds, else stops.
    #[must_use]
    pub fn run_while(self, condition: bool, elapsed: Millis) -> Self {
        if condition { self.run(elapsed) } else { Self::STOPPED }
    }
    /// Whether the condition has held for at least `span`.
    #[must_use]
    pub const fn reached(self, span: Millis) -> bool {
        self.0 > span.0
    }
    /// Whether it runs and will have held for at least `span` in the cycle that adds `elapsed`.
    #[must_use]
    pub fn due(self, span: Millis, elapsed: Millis) -> bool {
        self.is_running() && self.run(elapsed).reached(span)
    }
    /// Whether it runs at all.
    #[must_use]
    pub const fn is_running(self) -> bool {
        self.0 != 0
    }
    /// Elapsed time, 0 when stopped.
    #[must_use]
    pub const fn elapsed(self) -> Millis {
        Millis(self.0.saturating_sub(1))
    }
}

/// What a rate leaves over below one unit, in thousandths: slow rates and short cycles lose nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(kani, derive(kani::Arbitrary))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
pub struct Rest(u16);

impl Rest {
    /// Nothing left over.
    pub const ZERO: Self = Self(0);

    /// Whole units that `per_second` gives in `elapsed`, and what is left over.
    #[must_use]
    pub fn portion(self, per_second: u16, elapsed: Millis) -> (u32, Self) {
        let (whole, rest) = kernel::portion(per_second, elapsed.0, self.0);
        (whole, Self(rest))
    }
}

impl Word for Rest {
    fn to_word(self) -> u32 {
        u32::from(self.0)
    }
    fn from_word(word: u32) -> Option<Self> {
        u16::try_from(word).ok().map(Self)
    }
}

impl Word for Timer {
    fn to_word(self) -> u32 {
        self.0
    }
    fn from_word(word: u32) -> Option<Self> {
        Some(Self(word))
    }
}
