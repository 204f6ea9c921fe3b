//! The command line of `disturb`.

use std::path::PathBuf;

use clap::Args;

use super::part;

pub(super) const ABOUT: &str = "\
Counts how often the supervisor disturbs somebody who does nothing wrong.

  runs   random situations with the correct main controller, 70 % bus load with jitter and loss of frames, noise, missing \
objects and latency of radar and camera. Counted: runs with an intervention, levels that began without a cause (S1's \
\"false trigger\"), collisions; and the time from an object to a deceleration, split into bus, wait and supervisor.
  days   ordinary driving of a city bus without any disturbance of sensors and bus, and with a main controller that warns \
and leaves the braking to the driver: stops at 0.5 to 1.5 m/s² with 1 to 4 m left, queues that creep, stop bays, bends past \
parked cars, cut-ins, cars that turn off. Counted: interventions per 1 000 km, by channel and reason, each with an example.

An intervention is a stretch of more than 3 cycles of 10 ms in which a channel is not passed. Intervals are exact, 95 %: \
Clopper-Pearson for shares, Poisson for rates. S1's 0.097 % and 30.2 ms stand beside ours; ours are simulated, not \
comparable.

The same seed gives the same runs and days, on any machine and in any order.

Examples:
  supervise disturb                                      some minutes
  supervise disturb --runs 200 --km 10                   a short look
  supervise disturb --json safety-case/records/disturb.json --html target/disturb.html
  supervise disturb --km 200 --config my.bin             with your numbers, from `supervise config seal`
  supervise disturb --run 17659 --html target/run.html   one of the runs: what happened, when and where, with curves
  supervise disturb --shard 1/4 --json part-1.json       one part of four, on a machine of its own
  supervise disturb --merge part-*.json --json all.json  the whole out of all parts
  supervise disturb --check                              runs nothing: the committed record, and whether it is stale

The JSON document is described in safety-case/src/disturb/tally.rs.

Exit codes: 0 it was counted, whatever came of it; 1 the record is stale; 2 bad arguments or files.";

/// Arguments of `disturb`.
#[derive(Debug, Args)]
pub struct Disturb {
    /// Randomised runs with the correct main controller
    #[arg(long, value_name = "COUNT", default_value_t = 4000)]
    pub runs: u64,
    /// Ordinary driving, in km
    #[arg(long, value_name = "KM", default_value_t = 200)]
    pub km: u64,
    /// Drive only the run of this number, and show what happened in it
    #[arg(long, value_name = "NUMBER", conflicts_with_all = ["runs", "km", "shard", "merge", "jobs", "check"])]
    pub run: Option<u64>,
    /// From which everything is drawn
    #[arg(long, value_name = "NUMBER", default_value_t = 1)]
    pub seed: u64,
    /// Sealed configuration of the supervisor; without it, the defaults
    #[arg(long, value_name = "FILE")]
    pub config: Option<PathBuf>,
    /// Only the K-th of N parts
    #[arg(long, value_name = "K/N", value_parser = part)]
    pub shard: Option<(usize, usize)>,
    /// Run nothing: join the JSON of all parts
    #[arg(long, value_name = "FILE", num_args = 1.., conflicts_with = "shard")]
    pub merge: Vec<PathBuf>,
    /// How many run at once; without it, one for each core
    #[arg(long, value_name = "COUNT")]
    pub jobs: Option<usize>,
    /// Write the counts as JSON
    #[arg(long, value_name = "FILE")]
    pub json: Option<PathBuf>,
    /// Write one page that works offline
    #[arg(long, value_name = "FILE")]
    pub html: Option<PathBuf>,
    /// Run nothing: show the committed record, and whether it is stale
    #[arg(long, conflicts_with_all = ["runs", "km", "seed", "config", "shard", "merge", "jobs"])]
    pub check: bool,
}
