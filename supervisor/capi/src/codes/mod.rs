//! Numbers with a name. They are those of the supervisor itself and never change their meaning; `tests/header.rs`
//! compares each with the table that it comes from.

mod call;
mod command;
mod fault;
mod status;
mod verdict;

pub use call::*;
pub use command::*;
pub use fault::*;
pub use status::*;
pub use verdict::*;
