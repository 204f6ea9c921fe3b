//! The C interface of the supervisor.
//!
//! Principles:
//! 1. **The caller owns all memory.** Two opaque types, [`SupervisorState`] and [`SupervisorDiagnosis`], of a size and
//!    alignment that the header says; no global, no allocation.
//! 2. **Every argument is looked at before it is used**: null, misaligned, too small, not initialised, overlapping, in
//!    use by another context, or a code that is not in its table is refused with a stable [`SupervisorCode`].
//! 3. **Frames in, frames out.** What the controller on the other side has is CAN frames; what was decided of them is
//!    said beside: a verdict per channel, the outputs, the status.
//! 4. **Refusal is safe.** A refused step gives no frame, and a watchdog answer that is wrong: whoever ignores the code
//!    is found out from outside.
//! 5. **Diagnosis is apart.** It reads what was decided and cannot influence it; its memory may stand in another
//!    partition.
//!
//! `memory.rs` alone follows pointers, `calls` alone has names that C calls. The header `include/supervisor.h` is made
//! from these sources; `tests/header.rs` compares.
#![no_std]
#![deny(
    clippy::arithmetic_side_effects,
    clippy::float_arithmetic,
    clippy::indexing_slicing,
    clippy::string_slice,
    clippy::undocumented_unsafe_blocks,
    clippy::unreachable,
    unsafe_op_in_unsafe_fn
)]

// A static library needs a panic handler. What ships (a profile with `panic = "abort"`) has its own and knows no
// standard library; tests unwind, and have that of the standard library.
#[cfg(not(panic = "abort"))]
extern crate std;

mod calls;
mod codes;
mod diagnosis;
mod memory;
#[cfg(panic = "abort")]
mod panic;
mod state;
mod types;

pub use calls::*;
pub use codes::*;
pub use types::*;
