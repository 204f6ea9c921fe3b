//! The functions behind the fuzz targets.
#![forbid(unsafe_code)]

#[path = "../../tests/tests/common/mod.rs"]
mod common;
#[path = "../../tests/tests/oracle/mod.rs"]
mod oracle;

pub mod attack;
pub mod corpus;
pub mod host;
pub mod tally;

pub use common::random::Dice;
