//! The keys of a scenario's file. Times are in s of the drive, speeds in km/h, everything else in SI units.

use serde::Deserialize;
use supervisor::{EpbSwitch, Gear, Key};

use super::criteria::Expected;

/// A file.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct File {
    /// One line for people.
    pub title: String,
    /// What happens.
    pub description: String,
    /// Where it comes from.
    pub source: String,
    /// The demands that it shows.
    pub requirements: Vec<String>,
    /// S1's published approach is drawn beside it.
    #[serde(default)]
    pub published: bool,
    /// How long it is, in s.
    pub length: f64,
    /// The bus, where it differs.
    #[serde(default)]
    pub bus: Bus,
    /// The driver.
    #[serde(default)]
    pub driver: Driver,
    /// The others.
    #[serde(default)]
    pub other: Vec<Other>,
    /// Noise and a busy bus, as the campaign has them.
    #[serde(default)]
    pub disturbed: bool,
    /// What must come of it.
    pub expect: Expected,
    /// The same with other values.
    #[serde(default)]
    pub variant: Vec<Variant>,
}

/// The bus, where it differs from the one of the shipped drives.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Bus {
    /// Mass in kg.
    pub mass: Option<f64>,
    /// Dead time of the service brake in s.
    pub brake_dead: Option<f64>,
    /// Time constant of its build-up in s.
    pub brake_lag: Option<f64>,
    /// Friction between tyre and road.
    pub grip: Option<f64>,
    /// Slope, positive uphill ...
    pub slope: f64,
    /// ... from this time on.
    pub slope_from: f64,
}

/// The driver.
#[derive(Clone, Debug, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Driver {
    /// Key, high voltage, D, parking brake: ready to go at 10 s.
    pub starts: bool,
    /// What the driver does then.
    pub acts: Vec<Act>,
}

impl Default for Driver {
    fn default() -> Self {
        Self { starts: true, acts: Vec::new() }
    }
}

/// One act: a time and one thing that is done.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Act {
    /// When.
    pub at: f64,
    /// Sits down or gets up.
    pub sit: Option<bool>,
    /// Accelerator, 0 to 1.
    pub accelerator: Option<f64>,
    /// Brake pedal, 0 to 1.
    pub brake: Option<f64>,
    /// Holds this speed by the accelerator.
    pub hold: Option<f64>,
    /// Gear selector.
    pub selector: Option<Selector>,
    /// Key.
    pub key: Option<KeyName>,
    /// Switch of the parking brake.
    pub epb: Option<EpbName>,
    /// Cruise control on or off.
    pub cruise: Option<bool>,
    /// "Set".
    pub set: Option<bool>,
    /// Steering wheel towards this angle in degrees.
    pub wheel: Option<f64>,
}

macro_rules! names {
    ($($(#[$doc:meta])* $name:ident for $of:ident { $($variant:ident),+ })*) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, Deserialize)]
        #[serde(rename_all = "lowercase")]
        pub enum $name { $(#[doc = stringify!($variant)] $variant,)+ }

        impl From<$name> for $of {
            fn from(name: $name) -> Self {
                match name { $($name::$variant => Self::$variant,)+ }
            }
        }
    )*};
}

names! {
    /// The gear selector.
    Selector for Gear { Neutral, Drive, Reverse, Park }
    /// The key.
    KeyName for Key { Off, On, Start }
    /// The switch of the parking brake.
    EpbName for EpbSwitch { Idle, Apply, Release }
}

/// What somebody is.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum What {
    /// A car.
    Car,
    /// A bus.
    Bus,
    /// A pedestrian.
    Pedestrian,
    /// A cyclist.
    Cyclist,
}

/// One of the others.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Other {
    /// What.
    pub what: What,
    /// Its rear appears so far from where the bus was at first, in m ...
    pub at: Option<f64>,
    /// ... or so far ahead of the bus, in m.
    pub gap: Option<f64>,
    /// When it appears.
    #[serde(default)]
    pub from: f64,
    /// When it is gone.
    pub until: Option<f64>,
    /// Its speed.
    #[serde(default)]
    pub speed: f64,
    /// Its offset, left positive.
    #[serde(default)]
    pub offset: f64,
    /// What it does.
    #[serde(default)]
    pub moves: Vec<Move>,
}

/// What one of the others does from a time on: another speed, or another offset.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Move {
    /// When.
    pub at: f64,
    /// To this speed ...
    pub speed: Option<f64>,
    /// ... or to this offset ...
    pub offset: Option<f64>,
    /// ... by so much: m/s² for a speed, m/s for an offset.
    pub by: f64,
}

/// The same scenario with other values.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Variant {
    /// Its name.
    pub name: String,
    /// Which key, with dots and numbers, gets which value: `"driver.acts.0.hold" = 30`.
    pub set: toml::Table,
}
