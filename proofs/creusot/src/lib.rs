//! Creusot contracts on the arithmetic kernels of the supervisor.
//!
//! The kernels are the shipped source files, included by path, not copies. **Stated, not run**: no record of a
//! discharge exists yet. To run: `cargo creusot` with the Creusot release that belongs to creusot-std 0.14.
#![no_std]

/// The arithmetic of the shipped crates.
#[path = "../../../supervisor/terms/src/kernel.rs"]
pub mod kernel;
