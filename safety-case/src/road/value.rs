//! What a mapped signal can become: the supervisor's numbers with their units, its enums by name, yes and no.

use std::fmt::Debug;

use supervisor::{
    AdsState, AngleDeciDeg, BarTorque50mNm, BrakeMode, Class, ClosingCmS, Contact, ContactorRequest, CurrentDeciA,
    DecelMs2Q11, DistanceCm, DrivingMode, EpbMode, EpbRequest, EpbState, EpbSwitch, EpsState, Gear, GearRequest, Key,
    Mass10Kg, OffsetCm, Origin, Pedal250, Percent, Pressure5KPa, Priority, RateDeciDegS, RetarderMode, Seat,
    SpeedKmhQ8, TorqueNmQ10, Wiper, XbrStatus,
};

/// How a value is written in a mapping.
#[derive(Clone, Debug, PartialEq)]
pub enum Kind {
    /// A physical number.
    Number {
        /// Its unit.
        unit: &'static str,
        /// How many bits make one unit.
        per_unit: f64,
    },
    /// One of these names; the code of each.
    Names(Vec<(String, i32)>),
}

impl Kind {
    /// For error messages: what may stand there.
    #[must_use]
    pub fn expected(&self) -> String {
        match self {
            Self::Number { unit, .. } => format!("a number in {unit}"),
            Self::Names(names) => names.iter().map(|(name, _)| format!("\"{name}\"")).collect::<Vec<_>>().join(", "),
        }
    }
    /// The code of a name.
    #[must_use]
    pub fn code(&self, wanted: &str) -> Option<i32> {
        match self {
            Self::Number { .. } => None,
            Self::Names(names) => names.iter().find(|(name, _)| name == wanted).map(|(_, code)| *code),
        }
    }
}

/// A type that a mapping can fill.
pub trait Value: Sized {
    /// How it is written.
    fn kind() -> Kind;
    /// From the number of bits, or the code; `None` if it does not fit.
    fn from_raw(raw: i32) -> Option<Self>;
}

impl Value for bool {
    fn kind() -> Kind {
        Kind::Names(vec![("no".to_owned(), 0), ("yes".to_owned(), 1)])
    }
    fn from_raw(raw: i32) -> Option<Self> {
        match raw {
            0 => Some(false),
            1 => Some(true),
            _ => None,
        }
    }
}

/// `EmergencyOnly` becomes `emergency_only`.
#[must_use]
pub fn snake(name: &impl Debug) -> String {
    let mut text = String::new();
    for each in format!("{name:?}").chars() {
        if each.is_ascii_uppercase() && !text.is_empty() && !text.ends_with('_') {
            text.push('_');
        }
        text.push(each.to_ascii_lowercase());
    }
    text
}

macro_rules! names {
    ($($name:ident),* $(,)?) => {$(
        impl Value for $name {
            fn kind() -> Kind {
                Kind::Names($name::ALL.iter().map(|each| (snake(each), i32::from(each.code()))).collect())
            }
            fn from_raw(raw: i32) -> Option<Self> {
                Self::from_code(u8::try_from(raw).ok()?)
            }
        }
    )*};
}
names!(AdsState, BrakeMode, Contact, ContactorRequest, DrivingMode, EpbMode, EpbRequest, EpbState, EpbSwitch);
names!(Class, EpsState, Gear, GearRequest, Key, Origin, Priority, RetarderMode, Seat, Wiper, XbrStatus);

macro_rules! numbers {
    ($($name:ident: $unit:literal, $per_unit:literal;)*) => {$(
        impl Value for $name {
            fn kind() -> Kind {
                Kind::Number { unit: $unit, per_unit: $per_unit }
            }
            fn from_raw(raw: i32) -> Option<Self> {
                raw.try_into().ok().map($name::new)
            }
        }
    )*};
}
numbers! {
    SpeedKmhQ8: "km/h", 256.0;
    DecelMs2Q11: "m/s²", 2048.0;
    Percent: "%", 1.0;
    Pedal250: "%", 2.5;
    AngleDeciDeg: "°", 10.0;
    RateDeciDegS: "°/s", 10.0;
    TorqueNmQ10: "Nm", 1024.0;
    BarTorque50mNm: "Nm", 20.0;
    CurrentDeciA: "A", 10.0;
    Mass10Kg: "kg", 0.1;
    Pressure5KPa: "kPa", 0.2;
    DistanceCm: "m", 100.0;
    OffsetCm: "m", 100.0;
    ClosingCmS: "m/s", 100.0;
}

#[cfg(test)]
mod tests {
    use super::{Kind, Value, snake};
    use supervisor::{Gear, SpeedKmhQ8, XbrStatus};

    #[test]
    fn names_are_in_snake_case() {
        assert_eq!(snake(&XbrStatus::EmergencyOnly), "emergency_only");
        assert_eq!(Gear::kind().code("reverse"), Some(2));
        assert_eq!(Gear::from_raw(2), Some(Gear::Reverse));
        assert_eq!(Gear::from_raw(4), None);
    }

    #[test]
    fn numbers_that_do_not_fit_are_none() {
        assert_eq!(SpeedKmhQ8::kind(), Kind::Number { unit: "km/h", per_unit: 256.0 });
        assert_eq!(SpeedKmhQ8::from_raw(65_535), Some(SpeedKmhQ8::new(65_535)));
        assert_eq!(SpeedKmhQ8::from_raw(65_536), None);
        assert_eq!(SpeedKmhQ8::from_raw(-1), None);
    }
}
