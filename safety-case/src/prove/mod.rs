//! `supervise prove`: runs the Kani harnesses, reads the results as data, and keeps one record.
//!
//! Kani exits with 0 on an unsatisfiable cover and on a proof whose assumptions contradict each other. So nothing
//! counts here but the exported results: a harness is *proved* only if it succeeded, every check is decided, and it has
//! covers that are all satisfied.

mod error;
mod harness;
mod judge;
mod kani;
mod record;
mod run;

pub use error::ProveError;
pub use harness::{Harness, LIST, List, Solver};
pub use judge::{Verdict, judge};
pub use kani::{CONFIGURATION, Options, Outcome, Tools, available, verify};
pub use record::{Proof, Record, sources_digest};
pub use run::{Request, prove};
