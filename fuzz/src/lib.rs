//! The functions behind the fuzz targets.
#![forbid(unsafe_code)]

#[path = "../../tests/tests/common/mod.rs"]
mod common;

pub mod attack;
pub mod corpus;
pub mod host;

pub use common::random::Dice;
