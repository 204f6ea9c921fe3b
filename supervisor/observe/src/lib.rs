//! Observation: what the inputs of a cycle are evidence for, and whether the actuators follow.
//!
//! [`Evidence`] is read anew in every cycle. [`Monitors`] remember what went out and compare it with what comes back:
//! their [`Response`](supervisor_terms::Response) is the third cut, a small value of which any is legal for `decide`.
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

mod clock;
mod evidence;
mod follow;
mod monitors;
mod moves;
mod steered;

pub use clock::{Clock, Ticks};
pub use evidence::{BrakePedal, Evidence, SeatView, Speed, percent};
pub use follow::Follow;
pub use monitors::Monitors;
pub use moves::Moves;
pub use steered::SteeredAngle;
