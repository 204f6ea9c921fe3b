//! The command line.

mod coverage;
mod disturb;
mod evidence;
mod fuzz;
mod inject;
mod mutants;
mod simulate;

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand, ValueEnum};
use supervisor::{Record, ResetCause};

pub use coverage::Coverage;
pub use disturb::Disturb;
pub use evidence::Evidence;
pub use fuzz::Fuzz;
pub use inject::Inject;
pub use mutants::Mutants;
pub use simulate::Simulate;

use crate::prove::Solver;

const ABOUT: &str = "\
The supervisor stands between the main controller of an electric bus and its actuators. This program replays \
recorded drives through it, exactly as it runs on the target, and shows what it obliged, what it vetted, and why.

Without a command it replays the drives that ship with the project and writes a page for each.";

const EXAMPLES: &str = "\
Examples:
  supervise                                          replay the shipped drives, write target/supervise/index.html
  supervise replay drive.log                         the timeline and a summary, in text
  supervise replay a.candump.gz --html drive.html    one page that works offline: zoom, hover, reasons
  supervise replay a.log b.log --json drive.json     two logs of one drive, every verdict as JSON
  candump -L can0 | supervise replay -               from a pipe, until it ends
  supervise replay bus.log --map my.toml --dbc my.dbc      decode with your own DBC
  supervise replay bus.log --fail-on-intervention    for CI: exit code 3 if anything was vetted
  supervise limits                                   every number of the supervisor, its unit and source
  supervise config seal my.toml my.bin               seal a configuration
  supervise analysis                                 check the safety analysis
  supervise inject --html target/inject.html         faults in correct drives, and what becomes of the bus
  supervise simulate --all --html target/simulate.html   every scenario, with curves and what must come of it
  supervise disturb --check                          whom the supervisor disturbs: the committed record
  supervise trace --html target/trace.html           which code, proof and test belongs to which requirement
  supervise coverage --html target/coverage.html     which statements, branches and conditions the tests reach
  supervise evidence                                 all of it in one folder, open items first
  supervise fuzz --seconds 600                       fuzz every target for ten minutes

Exit codes: 0 done; 1 the analysis or the traceability has findings, a harness is not proved, or a bar of the design is not
met; 2 bad arguments, files, mapping or configuration; 3 with --fail-on-intervention, if the supervisor intervened;
4 a tool is missing, nothing was measured.";

const REPLAY: &str = "\
Logs are candump's, in both layouts, plain or gzip:
  (0.022500) can0 0CF00300#FD00FFFFFFFFFFFF
  (0.022500)  can0  0CF00300   [8]  FD 00 FF FF FF FF FF FF

Without --map, our own link and the standard J1939 frames CCVS1 and EBC1 are decoded. A mapping says in TOML which \
signal of which DBC is which input or command, from whatever frame: that a bare one is evidence enough is then the \
integrator's responsibility (E2E-1f). safety-case/maps/ebus.toml is a worked example:
  name = \"my bus\"
  dbc = \"my.dbc\"          # beside this file; --dbc goes before it
  ids = \"j1939\"           # compare the parameter group only; \"exact\" compares every bit
  [[input]]
  field = \"wheel_speed\"
  message = \"CCVS1\"
  signal = \"WheelBasedVehicleSpeed\"
  [[input]]
  field = \"epb\"
  message = \"CCVS1\"
  signal = \"ParkingBrakeSwitch\"
  values = { 0 = \"released\", 1 = \"applied\" }
  [[command]]
  channel = \"service_brake\"
  message = \"MyBrake\"
  fields = { total = { signal = \"Demand\" }, mode = \"maximum\", priority = \"medium\" }
What is not mapped is unknown, and what needs it is refused: that is what the supervisor would do.

Time: the supervisor steps every 10 ms of log time, after the frames up to then. A clock that runs backwards, or \
leaps ahead by more than an hour, is named with file and line; the supervisor gets the time as it is (SELF-3).

Lines that are not understood, unknown identifiers, refused frames and truncated files are counted and named, and \
never end the replay.

The JSON document (--json) is written while the replay goes on, one event per line; its schema is described in \
safety-case/src/document.rs.";

const TRACE: &str = "\
Every requirement of safety-case/analysis has one id, SEAT-5a, and SEAT-5 is the group of its demands. The sources carry \
these ids, and this command makes the table from them: requirement, code, limits, proofs, tests. Nothing is kept by hand.

Where an id is a tag:
  /// SEAT-5a: never ...        code in supervisor: at the start of any comment of a function or constant,
  // SEAT-5a, b: ...            or alone in parentheses: (SEAT-5a, MIT-4)
  ..., \"own\", \"SEAT-5a\";     a row of limits!: the requirement column
  /// SEAT-5a: never ...        a property in proofs/src/properties; a harness names its demands in proofs/harnesses.toml
  /// SEAT-5a to SEAT-5d: ...   a test: at the start of its doc comment
  # SEAT-5a: ...               a step of .ci/run: a comment below `step`
Code may name a group; it then stands for each demand of the group, as long as no code names one of them. Tests, \
properties, limits and harnesses name demands. An id anywhere else is a mention: it must exist, and counts for nothing.

Findings, each with file and line:
  NoCode, NoEvidence   a requirement without code; without test, check or recorded proof
  UnknownId            a tag or mention of what nothing defines
  BrokenRange          \"SEAT-5d to SEAT-5a\"
  Coarse               a group where a demand is meant
  UntaggedTest         a test in tests or supervisor/*/tests that belongs to no requirement
  NoHarness            a listed harness without function
  Idle                 an exception that nothing needs
Exceptions stand with their reason in safety-case/analysis/trace.toml, and as without_code at a requirement. \
A proof that is planned and not recorded as proved is counted and shown, and is no finding. A tag says that something \
belongs to a requirement; whether it does what is demanded, only its test or proof shows.

Examples:
  supervise trace                        findings and figures
  supervise trace SEAT-5 MIT-4d          everything that carries these
  supervise trace --html target/trace.html --json target/trace.json

The JSON document is described in safety-case/src/trace/json.rs.

Exit codes: 0 no findings; 1 findings; 2 something cannot be read or written, or no such id.";

const PROVE: &str = "\
Runs the harnesses of proofs/harnesses.toml with Kani, each in an invocation of its own, side by side, the longest first, \
and keeps proofs/record.json and, for each, what Kani exported: proofs/results. Both are committed.

A harness counts as proved only if it succeeded, every check is decided, and it has covers that are all satisfied: Kani \
itself ends well on a proof that shows nothing. It is stale when a token of the sources or the default configuration \
changed since; comments and layout make nothing stale. --check judges every raw result again, and fails on whatever is \
stale, failed, vacuous, undetermined, not run, listed but not there, there but not listed, and on a table of \
proofs/README.md that is not that of the record.

A counterexample becomes a test: `supervise prove --playback --harness NAME` writes target/kani/NAME-playback.rs. Paste \
it at the end of the file that the harness stands in, and run
  cargo kani playback -Z concrete-playback -p supervisor-proofs -- NAME
It replays the values that Kani found through the harness, where they can be printed or debugged.

Examples:
  supervise prove                                    all of them, and the record
  supervise prove --harness seat_4_epb_applied_in_leave
  supervise prove --stale                            what is not proved today, after a change or a broken-off run
  supervise prove --quick                            for CI: compiles all, proves some again
  supervise prove --shard 2/4                        one part of four, on a machine of its own
  supervise prove --merge part-*/record.json         the record out of all parts
  supervise prove --config my.bin                    the kernels for your numbers; my.bin.proofs.json

Exit codes: 0 everything that was asked for is proved; 1 it is not; 2 bad arguments or files, or the sources do not \
compile; 4 cargo kani is not here, nothing was run.";

/// The program.
#[derive(Debug, Parser)]
#[command(name = "supervise", version, about = "Replays drives through the bus safety supervisor", long_about = ABOUT, after_help = EXAMPLES)]
pub struct Cli {
    /// What to do; without it, the shipped drives are replayed.
    #[command(subcommand)]
    pub command: Option<Command>,
}

/// What to do.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Replay candump logs through the supervisor
    #[command(long_about = REPLAY)]
    Replay(ReplayArgs),
    /// Print every limit of the supervisor: value, range, unit, source, requirement
    Limits(LimitsArgs),
    /// Seal a configuration, or show a sealed one
    #[command(subcommand)]
    Config(ConfigCommand),
    /// Check the safety analysis and print what does not hold together
    Analysis(AnalysisArgs),
    /// Run the Kani harnesses, read the results as data, and keep the record
    #[command(long_about = PROVE)]
    Prove(Prove),
    /// Plant mistakes in a copy of the sources and expect the proofs to fail
    ///
    /// The named ones of proofs/mistakes.toml, or with --drawn those that a seed draws from the list of cargo-mutants.
    /// What the record already has for the present sources is not run again. Exits with 1 if a named mistake is not
    /// caught by a proof on the present sources, or a drawn one survives without an explanation; with 4 if cargo kani
    /// (or, for --drawn, cargo mutants) is not installed: nothing was run.
    Mistakes(Mistakes),
    /// Fuzz every target for a while, and keep the record of what was tried
    #[command(long_about = fuzz::ABOUT)]
    Fuzz(Fuzz),
    /// Test the tests: run them once for every mutant of the shipped crates
    #[command(long_about = mutants::ABOUT)]
    Mutants(Mutants),
    /// Trace every requirement to its code, limits, proofs and tests, by the ids in the sources
    #[command(long_about = TRACE)]
    Trace(TraceArgs),
    /// Count the instructions of every stage of a cycle, and the bytes of code and state
    ///
    /// Needs valgrind; without it nothing is measured, and it exits with 4. Writes target/cost.md and
    /// target/cost.json. Exits with 1 if a bar of the design is not met, or a file does not show what was measured.
    Cost(Cost),
    /// Inject faults into correct drives at random times, and judge what becomes of the bus
    #[command(long_about = inject::ABOUT)]
    Inject(Inject),
    /// Drive the scenarios of tests/scenarios in closed loop, and judge what must come of them
    #[command(long_about = simulate::ABOUT)]
    Simulate(Simulate),
    /// Count how often a correct main controller and an ordinary driver are disturbed
    #[command(long_about = disturb::ABOUT)]
    Disturb(Disturb),
    /// Measure which statements, branches and conditions of the decision the tests reach
    #[command(long_about = coverage::ABOUT)]
    Coverage(Coverage),
    /// Collect everything that speaks for the supervisor, open items first, and check that it still does
    #[command(long_about = evidence::ABOUT)]
    Evidence(Evidence),
}

/// Arguments of `replay`.
#[derive(Debug, Args)]
pub struct ReplayArgs {
    /// Logs of one drive, in order; `-` is the standard input
    #[arg(required = true, value_name = "LOG")]
    pub logs: Vec<PathBuf>,
    /// The DBC that the mapping speaks of
    #[arg(long, value_name = "FILE", requires = "map")]
    pub dbc: Option<PathBuf>,
    /// Which signals are which inputs and commands (TOML)
    #[arg(long, value_name = "FILE")]
    pub map: Option<PathBuf>,
    /// Write every verdict and state over time as JSON
    #[arg(long, value_name = "FILE")]
    pub json: Option<PathBuf>,
    /// Write one page that works offline
    #[arg(long, value_name = "FILE")]
    pub html: Option<PathBuf>,
    /// A sealed configuration; without it, the defaults of the table of limits
    #[arg(long, value_name = "FILE")]
    pub config: Option<PathBuf>,
    /// Why the supervisor starts
    #[arg(long, value_enum, default_value = "power-on")]
    pub boot: Boot,
    /// What it had persisted before it started
    #[arg(long, value_enum, default_value = "none")]
    pub record: Persisted,
    /// Only frames of this bus, for example can0
    #[arg(long, value_name = "NAME")]
    pub bus: Option<String>,
    /// Title of the page
    #[arg(long, value_name = "TEXT")]
    pub title: Option<String>,
    /// Greatest number of entries in the timeline
    #[arg(long, value_name = "COUNT", default_value_t = 500)]
    pub timeline: usize,
    /// Exit with 3 if the supervisor intervened
    #[arg(long)]
    pub fail_on_intervention: bool,
    /// No timeline and no progress bar, only the summary
    #[arg(long, short)]
    pub quiet: bool,
}

/// Why the supervisor starts.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum Boot {
    /// Power was switched on
    PowerOn,
    /// The watchdog
    Watchdog,
    /// Anything else
    Other,
}

impl From<Boot> for ResetCause {
    fn from(boot: Boot) -> Self {
        match boot {
            Boot::PowerOn => Self::PowerOn,
            Boot::Watchdog => Self::Watchdog,
            Boot::Other => Self::Other,
        }
    }
}

/// The persisted record.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum Persisted {
    /// Nothing
    None,
    /// In leave, or parked by leave
    Leave,
    /// High voltage was shut down after leave
    HvDown,
    /// The record failed its CRC
    Lost,
}

impl From<Persisted> for Option<Record> {
    fn from(record: Persisted) -> Self {
        match record {
            Persisted::None => Some(Record::None),
            Persisted::Leave => Some(Record::Leave),
            Persisted::HvDown => Some(Record::HighVoltageDown),
            Persisted::Lost => None,
        }
    }
}

/// Arguments of `limits`.
#[derive(Debug, Args)]
pub struct LimitsArgs {
    /// As JSON
    #[arg(long)]
    pub json: bool,
}

/// What to do with a configuration.
#[derive(Debug, Subcommand)]
pub enum ConfigCommand {
    /// Check a configuration written in TOML and seal it
    ///
    /// The file names fields of the table of limits, for example `comfort_cap = 6144` or
    /// `level_ttc = [4400, 3600, 2700]`, in the unit of the table; what it leaves out keeps its default.
    Seal {
        /// TOML with values that differ from the defaults
        #[arg(value_name = "IN.toml")]
        input: PathBuf,
        /// The sealed bytes
        #[arg(value_name = "OUT.bin")]
        output: PathBuf,
    },
    /// Show a sealed configuration, and what differs from the defaults
    Show {
        /// Sealed bytes; without it, the defaults
        #[arg(value_name = "FILE")]
        file: Option<PathBuf>,
    },
}

/// Arguments of `analysis`.
#[derive(Debug, Args)]
pub struct AnalysisArgs {
    /// The folder; without it, the one of this project
    #[arg(value_name = "FOLDER")]
    pub folder: Option<PathBuf>,
}

/// Arguments of `trace`.
#[derive(Debug, Args)]
pub struct TraceArgs {
    /// Show only these demands or groups, in full
    #[arg(value_name = "ID")]
    pub ids: Vec<String>,
    /// The root of the project; without it, this project
    #[arg(long, value_name = "FOLDER")]
    pub root: Option<PathBuf>,
    /// Write the table as JSON
    #[arg(long, value_name = "FILE")]
    pub json: Option<PathBuf>,
    /// Write the table as one page that works offline
    #[arg(long, value_name = "FILE")]
    pub html: Option<PathBuf>,
}

/// Arguments of `prove`.
#[derive(Debug, Args)]
pub struct Prove {
    /// Only these harnesses (names of proofs/harnesses.toml)
    #[arg(long, value_name = "NAME", num_args = 1..)]
    pub harness: Vec<String>,
    /// Only what the record does not show as proved on the present sources: goes on where a run was broken off
    #[arg(long, conflicts_with_all = ["quick", "check", "merge", "playback"])]
    pub stale: bool,
    /// How many run at once; without it, one for each core
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub jobs: Option<u16>,
    /// Another solver than the list names
    #[arg(long, value_enum)]
    pub solver: Option<Solver>,
    /// Another limit for the solver than the list names
    #[arg(long, value_name = "SECONDS")]
    pub timeout: Option<u64>,
    /// Part K of N of about the same time each; its record goes to target/kani/shard-K-of-N/record.json
    #[arg(long, value_name = "K/N", value_parser = part, conflicts_with_all = ["quick", "check", "config", "merge"])]
    pub shard: Option<(usize, usize)>,
    /// Join the parts of all shards, each with the folder `results` beside it, into the record
    #[arg(long, value_name = "FILE", num_args = 1.., conflicts_with_all = ["quick", "check", "config"])]
    pub merge: Vec<PathBuf>,
    /// Compile all, run the key harnesses and a random tenth of the rest again, compare with the record
    #[arg(long, conflicts_with_all = ["harness", "check", "config"])]
    pub quick: bool,
    /// Run nothing: show the record, and whether it is stale or its raw results say something else
    #[arg(long)]
    pub check: bool,
    /// Show the list of harnesses
    #[arg(long)]
    pub list: bool,
    /// Make tests of the counterexamples of harnesses that failed: target/kani/NAME-playback.rs
    #[arg(long, conflicts_with_all = ["quick", "check", "shard", "merge"])]
    pub playback: bool,
    /// Prove for this sealed configuration what multiplies by configured numbers; the record is FILE.proofs.json
    #[arg(long, value_name = "FILE")]
    pub config: Option<PathBuf>,
    /// Print the record as a table in Markdown
    #[arg(long)]
    pub table: bool,
    /// Put the table into this file, between its marks
    #[arg(long, value_name = "FILE", requires = "table")]
    pub write: Option<PathBuf>,
    /// The root of the project; without it, this project
    #[arg(long, value_name = "FOLDER")]
    pub root: Option<PathBuf>,
}

/// K of N, as in "2/3".
fn part(text: &str) -> Result<(usize, usize), String> {
    let numbers = text.split_once('/').and_then(|(shard, of)| Some((shard.parse().ok()?, of.parse().ok()?)));
    numbers.filter(|(shard, of)| (1..=*of).contains(shard)).ok_or_else(|| "is not K/N with K from 1 to N".to_owned())
}

/// Arguments of `mistakes`.
#[derive(Debug, Args)]
pub struct Mistakes {
    /// Only these named mistakes
    #[arg(long, value_name = "NAME", conflicts_with_all = ["drawn", "shard"])]
    pub name: Vec<String>,
    /// So many drawn mistakes instead of the named ones
    #[arg(long, value_name = "COUNT")]
    pub drawn: Option<usize>,
    /// Another seed than that of the list
    #[arg(long, value_name = "NUMBER", requires = "drawn")]
    pub seed: Option<u64>,
    /// Only the K-th of N parts
    #[arg(long, value_name = "K/N", value_parser = part)]
    pub shard: Option<(usize, usize)>,
    /// How many at a time
    #[arg(long, value_name = "COUNT", default_value_t = 2)]
    pub jobs: usize,
    /// Run again what the record already has for the present sources
    #[arg(long)]
    pub again: bool,
    /// Run nothing: say what the record does not show on the present sources
    #[arg(long, conflicts_with_all = ["name", "drawn", "shard", "again"])]
    pub check: bool,
    /// Run nothing: write the table of the record into this file, between its marks
    #[arg(long, value_name = "FILE", conflicts_with_all = ["name", "drawn", "shard", "again"])]
    pub write: Option<PathBuf>,
}

/// Arguments of `cost`.
#[derive(Debug, Args)]
pub struct Cost {
    /// Compare the rows of this file with what was measured
    #[arg(long, value_name = "FILE")]
    pub check: Option<PathBuf>,
    /// Write the rows into this file, between its marks
    #[arg(long, value_name = "FILE", conflicts_with = "check")]
    pub write: Option<PathBuf>,
    /// One more argument for cargo when it builds for the target
    #[arg(long, value_name = "ARGUMENT", allow_hyphen_values = true)]
    pub cargo_arg: Vec<String>,
}

#[cfg(test)]
mod tests {
    use super::{Cli, part};
    use clap::CommandFactory;

    #[test]
    fn the_command_line_is_consistent() {
        Cli::command().debug_assert();
    }

    #[test]
    fn a_shard_is_one_of_so_many() {
        assert_eq!(part("2/3"), Ok((2, 3)));
        for bad in ["0/3", "4/3", "1", "1/0", "a/b", "1/2/3"] {
            assert!(part(bad).is_err(), "{bad}");
        }
    }
}
