//! The command line of `fuzz`.

use std::path::PathBuf;

use clap::Args;

use super::part;
use crate::fuzz::TARGETS;

pub(super) const ABOUT: &str = "\
Runs the fuzz targets of fuzz/, each for the given time, side by side on the cores there are, and adds what they did to \
safety-case/records/fuzz.json: inputs, vetted cycles (at least: what comes after the last 256 inputs is not counted), edges, and for how \
long no new one was found. What the targets judge in each cycle stands in fuzz/README.md.

What is found is made small and becomes a file of fuzz/corpus, which the tests replay from then on: `cargo test --test corpus` shows \
it. What grows stays in fuzz/target/grown, so that the next run goes on from there.

Examples:
  supervise fuzz                                  every target for ten minutes
  supervise fuzz --seconds 1800 --seed 7 differential
  supervise fuzz --shard 2/4                      the second of four machines: another seed, its own record
  supervise fuzz --merge part-*.json              adds the parts of other machines to the record
  supervise fuzz --check                          runs nothing: the record, whether it is stale, what is not reached yet

Exit codes: 0 nothing was found, and with --check nothing is missing; 1 something was found, or the record is stale or short of a billion \
cycles and half an hour without a new edge for each target; 2 something cannot be read or built, or a target ended before its time; \
4 cargo fuzz or a nightly compiler is not here, nothing was run.";

/// Arguments of `fuzz`.
#[derive(Debug, Args)]
pub struct Fuzz {
    /// Only these targets
    #[arg(value_name = "TARGET", value_parser = TARGETS)]
    pub targets: Vec<String>,
    /// Each for so long
    #[arg(long, value_name = "COUNT", default_value_t = 600, value_parser = clap::value_parser!(u64).range(1..))]
    pub seconds: u64,
    /// Where the random numbers begin
    #[arg(long, value_name = "NUMBER", default_value_t = 1, value_parser = clap::value_parser!(u64).range(1..=0xFFFF_FFFF))]
    pub seed: u64,
    /// The K-th of N machines: another seed on each; writes target/fuzz/shard-K-of-N.json instead of the record
    #[arg(long, value_name = "K/N", value_parser = part)]
    pub shard: Option<(usize, usize)>,
    /// How many run at once; without it, one for each core
    #[arg(long, value_name = "COUNT")]
    pub jobs: Option<usize>,
    /// Run nothing: add these parts to the record
    #[arg(long, value_name = "FILE", num_args = 1.., conflicts_with_all = ["targets", "seconds", "seed", "shard", "jobs"])]
    pub merge: Vec<PathBuf>,
    /// Run nothing: show the record, and what it does not show
    #[arg(long, conflicts_with_all = ["targets", "seconds", "seed", "shard", "jobs", "merge"])]
    pub check: bool,
}
