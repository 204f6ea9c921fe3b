//! Fault injection: `faults.toml` says which faults there are and what is expected of each, `supervisor_tests::inject`
//! drives them, and here stands what comes of it: the matrix fault × scenario.
//!
//! - [`list`]: the faults and their expectations; [`run`]: a campaign, or a part of it;
//! - [`matrix`]: its result, as JSON and back, parts merged; [`judge`]: what of it contradicts the expectations;
//! - [`table`]: for the terminal; [`page`]: for a browser; [`record`]: the committed result and whether it is stale.

pub mod judge;
pub mod list;
pub mod matrix;
pub mod page;
pub mod record;
pub mod run;
pub mod table;

#[cfg(test)]
mod tests;

pub use judge::{Row, Standing, rows};
pub use list::{Expected, Fault, List, ListError};
pub use matrix::{Cell, Drive, Matrix, Sources};
pub use run::{Request, campaign};
