//! `supervise prove`: runs the Kani harnesses, reads the results as data, and keeps one record.
//!
//! Kani exits with 0 on an unsatisfiable cover and on a proof whose assumptions contradict each other. So nothing
//! counts here but the exported results: a harness is *proved* only if it succeeded, has at least one cover or
//! needs none, and every cover is satisfied.

mod judge;
mod record;
mod run;

pub use judge::{Verdict, judge};
pub use record::{Harness, List, Proof, ProveError, Record, Tools, sources_digest};
pub use run::{Options, available, prove};
