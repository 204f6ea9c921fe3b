//! Diagnosis: what happened, for people and records. It reads decisions and cannot influence them.
//!
//! [`EventRecord`] keeps the last changes of every verdict and of the status in a bounded ring.
//! [`FaultReport`] debounces the faults: a frame that fails its check is disobeyed at once, only its *report* waits.
#![no_std]
#![forbid(unsafe_code)]
#![deny(clippy::arithmetic_side_effects, clippy::float_arithmetic, clippy::indexing_slicing, clippy::unreachable)]

mod event;
mod fault;

pub use event::{Event, EventRecord, What};
pub use fault::FaultReport;
