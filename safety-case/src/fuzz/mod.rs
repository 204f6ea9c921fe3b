//! `supervise fuzz`: every fuzz target for a given time, and the record of what was tried so far.
//!
//! The targets stand in `fuzz`, a workspace of its own (libFuzzer needs a nightly compiler); this runs them through cargo-fuzz, reads
//! what libFuzzer says line by line, and adds it to `safety-case/records/fuzz.json`. What a target finds is made small and becomes a file of the
//! committed corpus, which the tests of the project replay from then on.

mod log;
mod record;
mod run;

pub use log::Heard;
pub use record::{RECORD, Record, Sources, TARGETS, Target};
pub use run::{Request, available, run};
