//! From object lists to [`Threat`](supervisor_core::Threat): time to collision, the second opinion, the most severe object (S1 §3.1).
//!
//! Each object is assessed alone, then the assessments are merged; both are pure. An object may *oblige* only if
//! it is valid: in the corridor, and matched by both sensors or seen consistently by the radar (FUS-3). Any object
//! of a single sensor may *permit*.
#![no_std]
#![forbid(unsafe_code)]
#![deny(
    clippy::arithmetic_side_effects,
    clippy::float_arithmetic,
    clippy::indexing_slicing,
    clippy::string_slice,
    clippy::unreachable
)]

#[cfg(kani)]
extern crate kani;

mod assess;
mod kernel;
mod scene;

pub use assess::{Assessment, camera_object, merge, radar_object, reached, reached_or_equal};
pub use scene::{CameraObject, Class, MAX_CAMERA, MAX_RADAR, PixelBox, RadarObject, Scene, perceive};
