//! The functions that C calls, by what they are for.
//!
//! Each looks at its arguments, does one thing, and gives a code. What stands under *Safety* is all that is not looked
//! at: that pointers lead to memory of the caller's program, and that no other context touches it during the call.

mod diagnosis;
mod query;
mod run;
mod start;
mod vet;

pub use diagnosis::*;
pub use query::*;
pub use run::*;
pub use start::*;
pub use vet::*;

use crate::SupervisorCode;

/// A refusal is a code like any other.
fn code(call: impl FnOnce() -> Result<SupervisorCode, SupervisorCode>) -> SupervisorCode {
    call().unwrap_or_else(|refusal| refusal)
}
