//! The vocabulary of a trouble code (J1939-73).

use supervisor_core::Faults;
use supervisor_core::word::codes;

use crate::body::BodyPart;

/// Suspect parameter number: what is in trouble. 19 bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Spn(u32);

impl Spn {
    /// The greatest number that 19 bits hold.
    pub const GREATEST: Self = Self(0x7_FFFF);

    /// Wraps a number; only 19 bits of it can be sent.
    #[must_use]
    pub const fn new(raw: u32) -> Self {
        Self(raw)
    }
    /// The number.
    #[must_use]
    pub const fn raw(self) -> u32 {
        self.0
    }
}

codes! {
    /// Failure mode identifier of J1939-73: in which way. Only those that our table speaks of, or soon will.
    Fmi {
        /// Data valid but above the normal range, most severe.
        AboveNormal = 0,
        /// Data erratic, intermittent or incorrect.
        Erratic = 2,
        /// Mechanical system not responding, or out of adjustment.
        NotResponding = 7,
        /// Abnormal update rate.
        UpdateRate = 9,
        /// Bad intelligent device or component.
        BadDevice = 12,
        /// Out of calibration.
        Calibration = 13,
        /// Data valid but above the normal range, moderately severe.
        AboveNormalModerate = 16,
        /// Received network data in error.
        NetworkData = 19,
        /// Condition exists.
        ConditionExists = 31,
    }
    /// The lamp that a code lights (J1939-73). Ours are never emission-related: the MIL stays off.
    Lamp {
        /// None: a hint, no fault (`Faults::HINTS`).
        None = 0,
        /// Amber warning lamp: drive on with what still works.
        AmberWarning = 1,
        /// Red stop lamp: stop the bus safely.
        RedStop = 2,
    }
    /// What does not work, as the ADS is told. The codes are stable.
    System {
        /// The supervisor itself.
        Supervisor = 0,
        /// Drive.
        Drive = 1,
        /// Service brake.
        Brake = 2,
        /// Steering.
        Steering = 3,
        /// Gearbox.
        Gear = 4,
        /// Parking brake.
        ParkingBrake = 5,
        /// High voltage.
        HighVoltage = 6,
        /// Seat sensors.
        Seat = 7,
        /// Radar and camera.
        Perception = 8,
        /// Lamps and wipers.
        Body = 9,
        /// Speed.
        Speed = 10,
    }
}

/// Where a code comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// One fault bit of the decision core.
    Core(Faults),
    /// A lamp or wiper that does not follow: reported only (RSP-1h).
    Body(BodyPart),
}

/// One row of [`TROUBLE_CODES`](crate::TROUBLE_CODES): what driver and ADS are told of a fault (RPT-1a to RPT-1c).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TroubleCode {
    /// Where it comes from.
    pub source: Source,
    /// What is in trouble.
    pub spn: Spn,
    /// In which way.
    pub fmi: Fmi,
    /// Which lamp it lights.
    pub lamp: Lamp,
    /// What does not work, for the ADS.
    pub system: System,
    /// What does not work, for the driver: one short sentence.
    pub driver: &'static str,
    /// Why, for both.
    pub why: &'static str,
}

impl TroubleCode {
    /// First code of [`BodyPart`]s: beyond every bit of [`Faults`].
    const BODY: u8 = 64;

    /// Why, as one byte for the ADS: stable and unique. 1 + bit of a core fault, 64 + part of a body fault; 0 is none.
    #[must_use]
    pub fn ads_code(&self) -> u8 {
        match self.source {
            Source::Core(fault) => {
                u8::try_from(fault.bits().trailing_zeros()).map_or(u8::MAX, |bit| bit.saturating_add(1))
            }
            Source::Body(part) => Self::BODY.saturating_add(part.code()),
        }
    }

    /// The fault's name in the code.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self.source {
            Source::Core(fault) => {
                Faults::NAMES.iter().find(|(named, _)| *named == fault).map_or("", |(_, name)| *name)
            }
            Source::Body(part) => part.name(),
        }
    }
}
