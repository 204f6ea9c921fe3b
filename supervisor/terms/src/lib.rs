//! Vocabulary of the bus safety supervisor: what its parts say to each other. Declarations, no decision.
//!
//! Units with their unit in the name, signals that may be unknown, commands of a closed world, the threat that
//! perception reports, verdicts with stable codes, and the one table of limits with its seal. `supervisor-core`
//! decides with them; perception, wire and report need no more than these.
#![no_std]
#![forbid(unsafe_code)]
#![deny(
    clippy::arithmetic_side_effects,
    clippy::float_arithmetic,
    clippy::indexing_slicing,
    clippy::string_slice,
    clippy::unreachable
)]

// What derives `Arbitrary` guards its recursion with std.
#[cfg(feature = "arbitrary")]
extern crate std;

#[cfg(kani)]
extern crate kani;

mod command;
mod flow;
mod image;
mod input;
pub mod kernel;
mod limits;
mod response;
mod sealed;
mod status;
mod threat;
mod units;
mod unknown;
mod verdict;
#[doc(hidden)]
pub mod word;

pub use command::{
    Auxiliaries, Body, BrakeMode, Channel, Channels, Command, Commands, ContactorRequest, Contactors, DriveTorque,
    DrivingMode, EpbRequest, GearRequest, Origin, Outputs, ParkingBrake, Priority, Rejection, Retarder, RetarderMode,
    ServiceBrake, Steering, Warnings, Wiper,
};
pub use flow::{Checkpoint, Flow};
pub use image::Image;
pub use input::{
    AdsState, Cause, Contact, EpbMode, EpbState, EpbSwitch, EpsState, Gear, Inputs, Key, Seat, Signal, XbrStatus,
};
pub use limits::{Config, LIMITS, Limit, Row};
pub use response::{Deviation, Response};
pub use sealed::{ConfigError, SEALED_BYTES, Sealed};
pub use status::{Mode, Occupancy, Record, ResetCause, Stage};
pub use threat::{Alert, Closing, Level, Object, Threat};
pub use units::{
    AngleDeciDeg, BarTorque50mNm, ClosingCmS, Count, CurrentDeciA, DecelMs2Q11, DistanceCm, Mass10Kg, Millis, OffsetCm,
    Pedal250, Percent, PercentPerS, Pixel, Pressure5KPa, RateDeciDegS, Rest, RotationQ14, SpeedKmhQ8, Timer,
    TorqueNmQ10,
};
pub use unknown::{Group, Meaning, meaning};
pub use verdict::{ExitReason, Faults, Kind, Reason, Verdict, Verdicts};
pub use word::{Word, Words};
