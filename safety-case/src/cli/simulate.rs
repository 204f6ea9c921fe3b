//! The command line of `simulate`.

use std::path::PathBuf;

use clap::Args;

use super::part;

pub(super) const ABOUT: &str = "\
Drives scenarios in closed loop: the model of the bus, its driver, the road, a correct main controller, and the real \
supervisor between them. Each scenario is a file of tests/scenarios: who does what, where that comes from, and what must \
come of it. Some come in several variants.

Demanded of every one: no hazard (no collision, no level that falls while the bus closes in, no release of the parking \
brake without a driver, K4 before K1, ...), and no intervention against the correct main controller but on the channels \
that the file names. An intervention is a stretch of more than 3 cycles in which a channel is not passed.

The page shows speed, acceleration, gap, time to collision, level and verdicts of each; where the scenario is S1's, the \
published approach stands beside ours. A log (--log) can be replayed: the same verdicts come of it.

Examples:
  supervise simulate --list                              what there is
  supervise simulate --all --html target/simulate.html   all of them
  supervise simulate s1-approach                         one, in all its variants
  supervise simulate \"s1-approach/0.7 s\" --log target    one variant, and its log for `supervise replay`
  supervise simulate my.toml                             one of your own
  supervise simulate --all --shard 1/2 --json part.json  one half

The JSON document is described in safety-case/src/simulate/document.rs.

How a scenario stands: pass; KNOWN: not as demanded, with the reason in its file; FAIL: not as demanded; CURED: as \
demanded, though its file says that it is not.

Exit codes: 0 nothing fails and nothing is cured unseen; 1 something is; 2 bad arguments or files.";

/// Arguments of `simulate`.
#[derive(Debug, Args)]
pub struct Simulate {
    /// Scenarios, with or without a variant (NAME/VARIANT), or files of your own (*.toml)
    #[arg(value_name = "SCENARIO", required_unless_present_any = ["all", "list"])]
    pub scenarios: Vec<String>,
    /// Every scenario
    #[arg(long, conflicts_with = "scenarios")]
    pub all: bool,
    /// Show what there is; drive nothing
    #[arg(long)]
    pub list: bool,
    /// Where something is disturbed, it is drawn from this
    #[arg(long, value_name = "NUMBER", default_value_t = 1)]
    pub seed: u64,
    /// Only the K-th of N parts
    #[arg(long, value_name = "K/N", value_parser = part)]
    pub shard: Option<(usize, usize)>,
    /// How many are driven at once; without it, one for each core
    #[arg(long, value_name = "COUNT")]
    pub jobs: Option<usize>,
    /// Write what came of them as JSON
    #[arg(long, value_name = "FILE")]
    pub json: Option<PathBuf>,
    /// Write one page that works offline
    #[arg(long, value_name = "FILE")]
    pub html: Option<PathBuf>,
    /// Write a candump log of each into this folder
    #[arg(long, value_name = "DIR")]
    pub log: Option<PathBuf>,
}
