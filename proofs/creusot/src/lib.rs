//! Creusot contracts on the arithmetic kernels of the supervisor.
//!
//! The kernels are the shipped source file, included by path, not a copy. Which contracts are discharged, by what and
//! when, says `record.json`, which `examples/discharge.rs` writes. `cargo test` evaluates the text of every contract on numbers.
#![no_std]

/// The arithmetic of the shipped crates.
#[path = "../../../supervisor/terms/src/kernel.rs"]
pub mod kernel;

pub mod consequences;
#[cfg(creusot)]
mod library;
