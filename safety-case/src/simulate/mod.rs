//! Scenarios in closed loop: `tests/scenarios` says what happens and what must come of it, `supervisor_tests::scenario`
//! drives it, and here stands what people look at.
//!
//! - [`mod@run`]: scenes, or a part of them, on all cores; [`table`]: for the terminal; [`document`]: as JSON;
//! - [`picture`]: the curves; [`page`]: for a browser.

pub mod document;
pub mod page;
pub mod picture;
pub mod run;
pub mod table;

pub use run::{Driven, Request, simulate};
