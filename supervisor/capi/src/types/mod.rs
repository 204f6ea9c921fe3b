//! What C sees: structures of integers, every gap named, the same on every target.

mod decision;
mod diagnosis;
mod frame;
mod memory;
mod outputs;

pub use decision::*;
pub use diagnosis::*;
pub use frame::*;
pub use memory::*;
pub use outputs::*;
