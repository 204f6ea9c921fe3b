//! The command line of `inject`.

use std::path::PathBuf;

use clap::Args;

use super::part;

pub(super) const ABOUT: &str = "\
Puts every fault of safety-case/analysis/faults.toml into every correct drive that it applies to, at random times, and \
shows the matrix fault × scenario.

Each run is driven twice from the moment of the fault on: without the supervisor, by actuators that obey the main \
controller and check nothing, and with it. Dangerous is a run in which a safety goal is violated either way, by the truth \
of the bus: the condition of its hazard lasts longer than its FTTI. What becomes of a dangerous run:
  averted    the supervisor refused, substituted or reported within the FTTI, and with it no goal is violated
  reported   it reported a fault within the FTTI, and a goal is violated all the same
  late       it reacted after the FTTI
  missed     none of these
How the faults stand:
  as expected, residual   what faults.toml says, written before the first run
  never dangerous         nothing was shown: no run of it was dangerous
  AGAINST                 a fault that is to be detected was late or missed (or only reported), one to be tolerated did harm
  KNOWN                   the same, with the reason in faults.toml

The same seed gives the same runs, on any machine and in any order. Times of reaction count from the moment from which \
the FTTI counts; 0 is a reaction before it.

Examples:
  supervise inject                                       all, 5 runs for each cell, some minutes
  supervise inject --runs 1                              the short form of .ci/run
  supervise inject --runs 40 --html target/inject.html --json safety-case/records/inject.json
  supervise inject --fault FI-14 --scenario approach-correct --runs 20
  supervise inject --shard 1/3 --json part-1.json        one part of three, on a machine of its own
  supervise inject --merge part-*.json --json all.json   the whole out of all parts
  supervise inject --check                               runs nothing: the committed record, and whether it is stale

The JSON document is described in safety-case/src/inject/matrix.rs.

Exit codes: 0 all as expected; 1 a fault stands against its expectation, a drive without a fault was disturbed, or the \
result is stale; 2 bad arguments or files.";

/// Arguments of `inject`.
#[derive(Debug, Args)]
pub struct Inject {
    /// Runs for each fault and scenario, each at another time
    #[arg(long, value_name = "COUNT", default_value_t = 5, value_parser = clap::value_parser!(u32).range(1..))]
    pub runs: u32,
    /// From which everything is drawn
    #[arg(long, value_name = "NUMBER", default_value_t = 1)]
    pub seed: u64,
    /// Only the K-th of N parts
    #[arg(long, value_name = "K/N", value_parser = part)]
    pub shard: Option<(usize, usize)>,
    /// Run nothing: join the JSON of all parts
    #[arg(long, value_name = "FILE", num_args = 1.., conflicts_with_all = ["shard", "fault", "scenario"])]
    pub merge: Vec<PathBuf>,
    /// Only these faults (ids of faults.toml)
    #[arg(long, value_name = "ID", num_args = 1..)]
    pub fault: Vec<String>,
    /// Only these scenarios
    #[arg(long, value_name = "NAME", num_args = 1..)]
    pub scenario: Vec<String>,
    /// How many run at once; without it, one for each core
    #[arg(long, value_name = "COUNT")]
    pub jobs: Option<usize>,
    /// Write the matrix as JSON
    #[arg(long, value_name = "FILE")]
    pub json: Option<PathBuf>,
    /// Write the matrix as one page that works offline
    #[arg(long, value_name = "FILE")]
    pub html: Option<PathBuf>,
    /// Run nothing: show the committed record, and whether it is stale
    #[arg(long, conflicts_with_all = ["runs", "seed", "shard", "merge", "fault", "scenario", "jobs"])]
    pub check: bool,
}
