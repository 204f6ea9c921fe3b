//! Whom the supervisor disturbs, though nobody does anything wrong: `supervisor_tests::disturb` and
//! `supervisor_tests::ordinary` drive, here it is counted.
//!
//! - [`mod@run`]: a campaign, or a part of it, on all cores; [`tally`]: what was counted, as JSON and back, parts merged;
//! - [`table`]: for the terminal; [`page`]: for a browser; [`record`]: the committed result and whether it is stale;
//! - [`mod@single`]: one run of it, driven again and shown.

pub mod page;
pub mod record;
pub mod run;
pub mod single;
pub mod table;
pub mod tally;

pub use run::{Request, campaign};
pub use single::single;
pub use tally::{Sources, Tally};
