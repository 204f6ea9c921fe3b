//! The command line of `mutants`.

use clap::Args;

use super::part;

pub(super) const ABOUT: &str = "\
Tests the tests: runs them once for every mutant that cargo-mutants lists of the shipped crates (an operator, a guard, a body,
a field changed). All mutants are built once, each behind a switch, into target/mutants; then the test programs of the packages
supervisor-tests, supervisor-proofs, supervisor-wire and supervisor-observe run for each mutant until one fails: first the one
that caught it on the sources of before, then those that catch most in the least time. A program in which a mutant makes no
difference where it stands is not run for it: it would run as it does without. The few mutants that cannot be switched are built
alone.
Nothing but tests counts here; what the proofs catch is `supervise mistakes`.

A test program that takes longer than --longest, or does not pass without a mutant, is left out, and told. A mutant that no test
notices survived; the next run tries it again, after those that have not run yet. safety-case/analysis/mutants.toml may
explain why it changes nothing, with a harness that --prove has Kani decide. The record is safety-case/records/mutants.json; it
is stale as soon as a token of the shipped sources changed.

Examples:
  supervise mutants                     all of them; goes on where a run was broken off
  supervise mutants --within 30         no further one after half an hour
  supervise mutants --longest 60        with test programs that take up to a minute: for what survived the quick ones
  supervise mutants --prove             have Kani prove of the explained ones that they change nothing
  supervise mutants --shard 1/4         one part of four, on a machine of its own
  supervise mutants --check             what the record shows

Exit codes: 0 every mutant is caught, or its survival proved or explained; 1 one is not, or was not run, or the record is stale;
2 something cannot be read or built; 4 cargo mutants (for --prove: cargo kani) is not here, nothing was run.";

/// Arguments of `mutants`.
#[derive(Debug, Args)]
pub struct Mutants {
    /// Only the K-th of N parts
    #[arg(long, value_name = "K/N", value_parser = part)]
    pub shard: Option<(usize, usize)>,
    /// How many at a time; without it, one for each core
    #[arg(long, value_name = "COUNT")]
    pub jobs: Option<usize>,
    /// Begin no further mutant after so many minutes; the next run goes on
    #[arg(long, value_name = "MINUTES")]
    pub within: Option<u64>,
    /// Leave out test programs that take longer without a mutant
    #[arg(long, value_name = "SECONDS", default_value_t = 20)]
    pub longest: u64,
    /// Run again what the record already has for the present sources
    #[arg(long)]
    pub again: bool,
    /// Prove with Kani that what survived and has a proof in its explanation changes nothing
    #[arg(long, conflicts_with_all = ["shard", "jobs", "within", "longest", "again"])]
    pub prove: bool,
    /// Run nothing: say what the record does not show on the present sources
    #[arg(long, conflicts_with_all = ["shard", "within", "longest", "again", "prove"])]
    pub check: bool,
}
