//! `supervise mistakes`: the proofs are tested, too. Plants mistakes in a copy of the sources and expects a proof to fail.
//!
//! The *named* ones of `proofs/mistakes.toml` are what a person could get wrong; each says which harnesses must fail on
//! it. The *drawn* ones are taken by a seed out of the list that cargo-mutants makes of the core. Nothing but the proofs
//! counts here: no test runs. The record is `proofs/mistakes.json`; it is stale as soon as the sources differ.

mod change;
mod check;
mod drawn;
mod list;
mod prover;
mod record;
mod run;
mod table;
#[cfg(test)]
mod tests;

pub use change::Change;
pub use check::{Finding, check};
pub use drawn::{Listed, available, draw, listed};
pub use list::{Drawn, Explained, LIST, List, Mistake, Module};
pub use prover::{Kani, Prover};
pub use record::{DrawnRecord, Entry, Outcome, RECORD, Record, Tried};
pub use run::{Request, Shard, run};
pub use table::{block, replaced};
