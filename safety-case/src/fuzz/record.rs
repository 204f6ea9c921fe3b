//! The record, `safety-case/records/fuzz.json`: what was tried so far on the present sources.

use std::path::Path;

use serde::{Deserialize, Serialize};

use crate::error::{ToolError, form, write};
use crate::number::grouped;
use crate::prove::{stepped, tokens};

/// Where it stands.
pub const RECORD: &str = "safety-case/records/fuzz.json";

/// The targets, in the order in which they run.
pub const TARGETS: [&str; 5] = ["command_stream", "differential", "wire_bytes", "candump_log", "dbc_map"];

/// Vetted cycles that the design asks for, all targets together.
const CYCLES: u64 = 1_000_000_000;
/// For so long no new edge, for each target, s.
const QUIET: u64 = 1_800;

/// What makes the inputs and judges the cycles.
const JUDGES: [&str; 5] =
    ["fuzz/src", "fuzz/fuzz_targets", "proofs/src/properties", "tests/tests/common", "tests/tests/oracle"];
/// What reads the files of others.
const PARSERS: [&str; 2] = ["safety-case/src/candump", "safety-case/src/road"];
/// The targets that try it.
const PARSER_TARGETS: [&str; 2] = ["candump_log", "dbc_map"];

/// Digests of what was fuzzed.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Sources {
    /// The shipped sources and the facade.
    pub shipped: String,
    /// Targets, properties and oracle.
    pub judges: String,
    /// The parsers of the host, for the targets that try them. A record of before has none.
    #[serde(default)]
    pub parsers: String,
}

impl Sources {
    /// Of the present sources.
    ///
    /// # Errors
    /// A file cannot be read or is no Rust.
    pub fn load(root: &Path) -> Result<Self, ToolError> {
        Ok(Self { shipped: stepped(root)?, judges: tokens(root, &JUDGES)?, parsers: tokens(root, &PARSERS)? })
    }
}

/// What a target has done.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Target {
    /// Its name.
    pub target: String,
    /// Inputs that ran.
    pub inputs: u64,
    /// Cycles that were vetted and judged, at least; 0 for a target that reads files.
    pub cycles: u64,
    /// For how long it ran, s.
    pub seconds: u64,
    /// For how long of that it read the corpus that it began with, s.
    #[serde(default)]
    pub read_seconds: u64,
    /// Edges and counters that it has reached.
    pub edges: u64,
    /// For how long, at the end, no new edge was found, s.
    pub quiet_seconds: u64,
    /// Inputs that broke something, each now a file of the corpus.
    pub found: u64,
}

impl Target {
    /// This, and then another run that began with what this one had found.
    fn then(&mut self, next: &Self) {
        let tried = next.seconds.saturating_sub(next.read_seconds);
        // More edges without growth: somebody put inputs into its corpus between, which find what this one had not.
        let same = next.quiet_seconds >= tried && next.edges <= self.edges;
        let quiet = if same { self.quiet_seconds } else { 0 };
        self.sum(next);
        self.quiet_seconds = quiet.saturating_add(next.quiet_seconds);
    }

    /// This, and another run on another machine.
    fn beside(&mut self, other: &Self) {
        let quiet = self.quiet_seconds.min(other.quiet_seconds);
        self.sum(other);
        self.quiet_seconds = quiet;
    }

    fn sum(&mut self, other: &Self) {
        self.inputs = self.inputs.saturating_add(other.inputs);
        self.cycles = self.cycles.saturating_add(other.cycles);
        self.seconds = self.seconds.saturating_add(other.seconds);
        self.read_seconds = self.read_seconds.saturating_add(other.read_seconds);
        self.found = self.found.saturating_add(other.found);
        self.edges = self.edges.max(other.edges);
    }
}

/// The record.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Record {
    /// Of which sources it speaks.
    pub sources: Sources,
    /// What each target has done, all runs together.
    pub targets: Vec<Target>,
}

impl Record {
    /// The committed one; empty if there is none.
    ///
    /// # Errors
    /// It cannot be read or understood.
    pub fn load(path: &Path) -> Result<Self, ToolError> {
        match std::fs::read(path) {
            Ok(bytes) => serde_json::from_slice(&bytes).map_err(|error| form(path, &error)),
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => Ok(Self::default()),
            Err(error) => Err(ToolError::File { path: path.to_owned(), error }),
        }
    }

    /// Writes it.
    ///
    /// # Errors
    /// It cannot be written.
    pub fn save(&self, path: &Path) -> Result<(), ToolError> {
        let text = serde_json::to_string_pretty(self).map_err(|error| form(path, &error))?;
        write(path, format!("{text}\n").as_bytes())
    }

    /// What still speaks of these sources.
    #[must_use]
    pub fn for_sources(mut self, sources: &Sources) -> Self {
        if (&self.sources.shipped, &self.sources.judges) != (&sources.shipped, &sources.judges) {
            self.targets.clear();
        } else if self.sources.parsers != sources.parsers {
            self.targets.retain(|run| !PARSER_TARGETS.contains(&run.target.as_str()));
        }
        self.sources = sources.clone();
        self
    }

    /// Adds the run of a target that came after those that are in it.
    pub fn add(&mut self, run: Target) {
        self.put(run, Target::then);
    }

    /// Adds what ran on another machine.
    ///
    /// # Errors
    /// It speaks of other sources.
    pub fn merge(&mut self, other: Self) -> Result<(), ToolError> {
        if other.sources != self.sources {
            return Err(ToolError::Arguments("a part speaks of other sources than the present ones".to_owned()));
        }
        for run in other.targets {
            self.put(run, Target::beside);
        }
        Ok(())
    }

    fn put(&mut self, run: Target, join: fn(&mut Target, &Target)) {
        match self.targets.iter_mut().find(|present| present.target == run.target) {
            Some(present) => join(present, &run),
            None => self.targets.push(run),
        }
    }

    /// What is short of the aim of the design.
    #[must_use]
    pub fn short(&self) -> Vec<String> {
        let few = self.cycles() < CYCLES;
        let cycles = few.then(|| format!("{} of {} cycles", grouped(self.cycles()), grouped(CYCLES)));
        let target = |name| match self.targets.iter().find(|target| target.target == name) {
            None => Some(format!("{name}: not run")),
            Some(Target { quiet_seconds: quiet, .. }) => {
                (*quiet < QUIET).then(|| format!("{name}: no new edge for {quiet} s; {QUIET} s are asked for"))
            }
        };
        cycles.into_iter().chain(TARGETS.into_iter().filter_map(target)).collect()
    }

    /// Cycles of all targets.
    #[must_use]
    pub fn cycles(&self) -> u64 {
        self.targets.iter().fold(0, |sum, target| sum.saturating_add(target.cycles))
    }
}

#[cfg(test)]
mod tests {
    use super::{CYCLES, QUIET, Record, Sources, TARGETS, Target, grouped};

    fn ran(seconds: u64, edges: u64, quiet_seconds: u64) -> Target {
        Target { target: "t".into(), inputs: 10, cycles: 100, seconds, read_seconds: 0, edges, quiet_seconds, found: 0 }
    }

    #[test]
    fn a_quiet_run_goes_on_being_quiet() {
        let mut record = Record::default();
        record.add(ran(60, 5, 20));
        record.add(ran(60, 5, 60));
        assert_eq!(record.targets, [Target { inputs: 20, cycles: 200, ..ran(120, 5, 80) }]);
        record.add(Target { read_seconds: 15, ..ran(60, 5, 45) });
        let quiet = Target { inputs: 30, cycles: 300, read_seconds: 15, ..ran(180, 5, 125) };
        assert_eq!(record.targets, [quiet], "to read the corpus again breaks no quiet, and adds nothing to it");
        record.add(ran(60, 7, 10));
        assert_eq!(
            record.targets,
            [Target { inputs: 40, cycles: 400, read_seconds: 15, ..ran(240, 7, 10) }],
            "it grew"
        );
        record.add(ran(60, 9, 60));
        let grown = Target { inputs: 50, cycles: 500, read_seconds: 15, ..ran(300, 9, 60) };
        assert_eq!(record.targets, [grown], "its corpus grew between");
        assert_eq!(record.cycles(), 500);
    }

    #[test]
    fn parts_of_other_machines_are_as_quiet_as_the_least_quiet_and_of_the_same_sources() {
        let mut record = Record::default();
        record.add(ran(60, 5, 20));
        let mut part = Record::default();
        part.add(ran(60, 6, 50));
        assert!(record.merge(part.clone()).is_ok());
        assert_eq!(record.targets, [Target { inputs: 20, cycles: 200, ..ran(120, 6, 20) }]);
        part.sources.shipped = "other".into();
        assert!(record.merge(part).is_err());
    }

    #[test]
    fn a_target_that_did_not_run_and_one_that_still_grows_are_short_of_the_aim() {
        let mut record = Record::default();
        for name in TARGETS.into_iter().filter(|name| *name != "dbc_map") {
            record.add(Target { target: name.into(), cycles: CYCLES / 4, ..ran(2 * QUIET, 5, QUIET) });
        }
        assert_eq!(record.short(), ["dbc_map: not run"]);
        record.add(Target { target: "dbc_map".into(), ..ran(2 * QUIET, 5, QUIET - 1) });
        assert_eq!(record.short(), ["dbc_map: no new edge for 1799 s; 1800 s are asked for"]);
        record.add(Target { target: "dbc_map".into(), ..ran(10, 5, 10) });
        assert!(record.short().is_empty());
        record.targets.retain(|target| target.target != "differential");
        assert_eq!(
            record.short(),
            [format!("{} of {} cycles", grouped(750_000_200), grouped(CYCLES)), "differential: not run".into()]
        );
    }

    #[test]
    fn only_what_speaks_of_the_present_sources_stays() {
        let mut record = Record::default();
        record.add(Target { target: "command_stream".into(), ..ran(60, 5, 20) });
        record.add(Target { target: "dbc_map".into(), ..ran(60, 5, 20) });
        let left = |sources: &Sources| {
            let record = record.clone().for_sources(sources);
            assert_eq!(record.sources, *sources);
            record.targets.iter().map(|run| run.target.clone()).collect::<Vec<_>>()
        };
        assert_eq!(left(&Sources::default()), ["command_stream", "dbc_map"]);
        assert_eq!(left(&Sources { parsers: "other".into(), ..Sources::default() }), ["command_stream"]);
        assert!(left(&Sources { judges: "other".into(), ..Sources::default() }).is_empty());
        assert!(left(&Sources { shipped: "other".into(), ..Sources::default() }).is_empty());
    }

    #[test]
    fn what_is_written_is_read_back() {
        let Ok(folder) = tempfile::tempdir() else { unreachable!("there is a temporary folder") };
        let path = folder.path().join("fuzz.json");
        assert_eq!(Record::load(&path).ok(), Some(Record::default()));
        let mut record = Record::default();
        record.add(ran(60, 5, 20));
        assert!(record.save(&path).is_ok());
        assert_eq!(Record::load(&path).ok(), Some(record));
        assert!(std::fs::write(&path, "{").is_ok());
        assert!(Record::load(&path).is_err_and(|error| error.to_string().contains("fuzz.json")));
    }
}
