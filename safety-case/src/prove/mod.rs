//! `supervise prove`: runs the Kani harnesses, reads the results as data, and keeps one record.
//!
//! Kani exits with 0 on an unsatisfiable cover and on a proof whose assumptions contradict each other. So nothing
//! counts here but the exported results: a harness is *proved* only if it succeeded, every check is decided, and it has
//! covers that are all satisfied. What was exported is kept beside the record, and judged again at every check.
//!
//! Where to look: the list, `harness.rs`; running one harness, `kani.rs`; the verdict, `judge.rs`; side by side,
//! `run.rs`; which ones, `plan.rs`; what makes a record stale, `sources.rs`; what it says today, `status.rs`.

mod declared;
mod harness;
mod judge;
mod kani;
mod plan;
mod progress;
mod raw;
mod record;
mod run;
mod sources;
mod status;
mod table;

pub use declared::declared;
pub use harness::{Checks, Harness, LIST, List, Solver};
pub use judge::{Verdict, judge};
pub use kani::{CONFIGURATION, Options, Outcome, Tools, available, compile, playback, verify};
pub use plan::{Quick, named, ordered, quick, seconds, shard};
pub use progress::Progress;
pub use raw::{RESULTS, Raw};
pub use record::{Place, Proof, RECORD, Record};
pub use run::Workers;
pub use sources::{Sources, configuration_digest, default_configuration, sha256, shipped, stepped, tokens};
pub use status::{Present, State, differences};
pub use table::{block, claim, replaced, table};
