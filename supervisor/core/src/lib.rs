//! Decision core of the bus safety supervisor.
//!
//! Principles:
//! 1. **Obligation needs evidence of a hazard; permission needs evidence of safety.** Unknown is evidence for
//!    neither, and never cancels an obligation that has begun.
//! 2. **Three cuts.** [`Threat`] is what perception says, [`Response`] whether the actuators follow, any value of both
//!    legal; [`Envelope`] is what must and may happen in this cycle. [`decide()`] goes from the first two to the
//!    third, [`vet()`] applies it. Both are pure.
//! 3. **[`step()`] is the only way in**, for the target, tests, proofs, fuzzers, replay and the C ABI.
//! 4. **Every state is legal.** No proof needs an invariant between machines; state rests as integers beside their
//!    complement, and what does not decode is the safe state.
//! 5. **No division of labour with the main controller**: nothing it says is evidence.
//!
//! Where to look: may the parking brake be released? `parking.rs`. Contactors: `high_voltage.rs`. How much must,
//! and may, the bus brake? `brake.rs`. Torque and mode: `drive.rs`. Every number: `limits.rs`.
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

mod boot;
mod brake;
mod decide;
mod drive;
mod envelope;
mod gear;
mod high_voltage;
mod latch;
mod mitigation;
mod parking;
mod seat;
mod state;
mod steering;
mod step;
mod vet;

pub use supervisor_observe::{Clock, Evidence, Follow, Monitors, Moves, SteeredAngle, Ticks};
pub use supervisor_terms::*;

pub use boot::{Boot, Pending};
pub use brake::Brake;
pub use decide::{Decided, decide};
pub use drive::Drive;
pub use envelope::*;
pub use gear::{Direction, GearState};
pub use high_voltage::{HighVoltage, LastKey, Restart};
pub use latch::Latches;
pub use mitigation::Mitigation;
pub use parking::{Parking, PedalChain};
pub use seat::SeatState;
pub use state::{STATE_WORDS, State, StateImage};
pub use steering::SteeringState;
pub use step::{Decision, Status, record, step};
pub use vet::*;
