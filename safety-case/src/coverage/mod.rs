//! `supervise coverage`: which statements, branches and conditions of the decision the tests reach.
//!
//! A copy of the workspace gets a recorder: every statement, arm and condition of the decision core, of what it reads the
//! inputs with and of its arithmetic says that it ran, and with which values. The shipped sources stay as they are. The tests
//! of the step run in the copy, and must pass there: what is put in changes nothing.
//!
//! MC/DC is shown by *masking*: for each condition there are two recorded evaluations in which it is true and false, and
//! nothing beside it masks it, so that the outcome is by it. What `&&` and `||` pass over is not evaluated and counts as any
//! value. Beside it stands how many conditions are shown by *unique cause*, where nothing else may differ.
//!
//! Where to look: what is put in, `instrument.rs`; what records, `recorder.rs`; MC/DC, `plan.rs`; the run, `run.rs`; the
//! figures, `figures.rs`; what may stay open, `open.rs`.

mod figures;
mod form;
mod insert;
mod instrument;
mod macros;
mod open;
mod page;
mod plan;
mod record;
pub mod recorder;
mod run;
#[cfg(test)]
mod tests;

pub use figures::{Count, Figures, Open, figures};
pub use instrument::instrument;
pub use open::{Accepted, Finding, LIST, compare};
pub use page::page;
pub use plan::{Decision, Kind, Place, Plan, Point, Tree, Vector};
pub use record::{RECORD, Record, document};
pub use run::{Measured, Seen, plan, run};
