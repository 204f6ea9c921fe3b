//! `supervise mutants`: the tests are tested. Every mutant that cargo-mutants lists of the shipped crates, against the tests alone.
//!
//! Building each mutant anew would take days here, so all of them are built once, each behind a switch ([`switched`]); then the tests run
//! once for each, the quickest test program first, until one fails. One run of each program without a mutant shows which mutants would
//! make a difference in it where they stand: only those can be caught by it. The few that cannot be switched are built alone (`alone.rs`).
//!
//! A mutant that no test notices *survived*: `safety-case/analysis/mutants.toml` may explain why it changes nothing, and prove it ([`prove`]).
//! The record is `safety-case/records/mutants.json`; it is stale as soon as the shipped sources differ.

mod alone;
mod build;
mod equal;
mod list;
mod record;
mod run;
mod switch;

pub use equal::prove;
pub use list::{Explained, PACKAGES, findings};
pub use record::{Entry, Outcome, RECORD, Record};
pub use run::{Request, run};
pub use switch::{CRATE, Genre, Mutant, Switched, switched};
