//! From object lists to [`Threat`](supervisor_core::Threat): fusion, time to collision, the second opinion, the most
//! severe object (S1 §3.1).
//!
//! Radar and camera objects are brought to one time (FUS-1) and into one picture (FUS-2), and matched (FUS-3). Each
//! object is assessed alone, then the assessments are merged; all of it is pure, and keeps nothing from one cycle to
//! the next. An object may *oblige* only if it is valid: in the corridor, and matched by both sensors or seen
//! consistently by the radar. Any object of a single sensor may *permit*.
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

mod assess;
mod fusion;
mod picture;
mod scene;
mod time;

pub use assess::{Assessment, Worst, camera_object, merge, radar_object, reached, reached_or_equal};
pub use fusion::{Boxed, Overlap, matches};
pub use picture::{Foot, Lens, Outline, STEPS, Size, Span};
pub use scene::{CameraObject, Class, MAX_CAMERA, MAX_RADAR, PixelBox, RadarObject, Scene, perceive};
pub use time::moved;
