//! The result of a campaign, fault × scenario, as JSON and back.
//!
//! ```text
//! { "schema": "supervise-inject", "version": 1, "seed": 1, "runs": 5, "shards": 1,
//!   "sources": { "shipped": "sha256", "configuration": "sha256", "bench": "sha256", "faults": "sha256" },
//!   "drives": [ { "name": "cruise", "cycles": 6600, "interventions": 0, "harms": 0 } ],
//!   "cells": [ { "fault": "FI-01", "scenario": "cruise", "harmless": 3, "averted": 2, "reported": 0, "late": 0,
//!                "missed": 0, "detection_ms": [0, 30], "share": 3,
//!                "examples": [ { "outcome": "averted", "from_ms": 31230, "lasts_ms": 4000, "goal": "SG-01",
//!                               "said": "EXCESS_TORQUE" } ] } ] }
//! ```
//! `detection_ms`: for each dangerous run with a reaction, from the moment from which the FTTI counts; sorted. `share`: the
//! greatest of them as percent of its FTTI. `examples`: the first run of each outcome that is not harmless.

use std::collections::{BTreeMap, BTreeSet};

use serde::{Deserialize, Serialize};
use supervisor::Faults;
use supervisor_tests::inject::baseline::Baseline;
use supervisor_tests::inject::campaign;
use supervisor_tests::inject::harm::Ftti;
use supervisor_tests::inject::outcome::Outcome;

/// Digests of all that a campaign depends on.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Sources {
    /// The shipped sources.
    pub shipped: String,
    /// The default configuration.
    pub configuration: String,
    /// Bus, main controller, injector, judge.
    pub bench: String,
    /// `faults.toml`, and the FTTI of `goals.toml`.
    pub faults: String,
}

/// A drive without a fault.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Drive {
    /// Its name.
    pub name: String,
    /// How long it is.
    pub cycles: usize,
    /// False interventions.
    pub interventions: usize,
    /// Goals violated without any fault.
    pub harms: usize,
}

impl From<&Baseline> for Drive {
    fn from(baseline: &Baseline) -> Self {
        Self {
            name: baseline.scenario.name.to_owned(),
            cycles: baseline.said.len(),
            interventions: baseline.interventions.len(),
            harms: baseline.harms.len(),
        }
    }
}

/// One run, for whoever wants to look into it.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Example {
    /// What came of it.
    pub outcome: String,
    /// When the fault began, in ms of the drive.
    pub from_ms: u32,
    /// For how long, in ms.
    pub lasts_ms: u32,
    /// The goal whose time runs out first.
    pub goal: String,
    /// What the supervisor reported first, by the names of its faults.
    pub said: String,
}

/// All runs of a fault in a scenario.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Cell {
    /// The fault's id.
    pub fault: String,
    /// The scenario's name.
    pub scenario: String,
    /// No harm, with the supervisor or without.
    pub harmless: usize,
    /// Harm without, none with it.
    pub averted: usize,
    /// Harm, reported in time.
    pub reported: usize,
    /// Seen too late.
    pub late: usize,
    /// Not seen.
    pub missed: usize,
    /// Times to the reaction in ms, sorted.
    pub detection_ms: Vec<u32>,
    /// The greatest as percent of its FTTI.
    pub share: u32,
    /// The first run of each outcome that is not harmless.
    pub examples: Vec<Example>,
}

/// The word for an outcome.
#[must_use]
pub const fn word(outcome: Outcome) -> &'static str {
    match outcome {
        Outcome::Harmless => "harmless",
        Outcome::Averted => "averted",
        Outcome::Reported => "reported",
        Outcome::Late => "late",
        Outcome::Missed => "missed",
    }
}

/// The names of faults, by their bits.
fn names(bits: u32) -> String {
    let named = Faults::NAMES.iter().filter(|(fault, _)| bits & fault.bits() != 0);
    named.map(|(_, name)| *name).collect::<Vec<_>>().join(" ")
}

impl Cell {
    /// From its runs.
    #[must_use]
    pub fn new(fault: &str, scenario: &str, cell: &campaign::Cell, ftti: &Ftti) -> Self {
        let mut detection_ms: Vec<u32> = cell.runs.iter().filter_map(|run| run.verdict.detection_ms).collect();
        detection_ms.sort_unstable();
        let share = |run: &campaign::Run| {
            let (goal, after) = (run.verdict.goal?, run.verdict.detection_ms?);
            after.saturating_mul(100).checked_div(*ftti.get(&goal)?)
        };
        let examples = [Outcome::Averted, Outcome::Reported, Outcome::Late, Outcome::Missed];
        let example = |outcome| {
            let run = cell.runs.iter().find(|run| run.verdict.outcome == outcome)?;
            let goal = run.verdict.goal.map(|goal| format!("SG-{:02}", goal.0)).unwrap_or_default();
            let (from_ms, lasts_ms, said) = (run.from_ms, run.lasts_ms, names(run.reaction.faults));
            Some(Example { outcome: word(outcome).to_owned(), from_ms, lasts_ms, goal, said })
        };
        Self {
            fault: fault.to_owned(),
            scenario: scenario.to_owned(),
            harmless: cell.count(Outcome::Harmless),
            averted: cell.count(Outcome::Averted),
            reported: cell.count(Outcome::Reported),
            late: cell.count(Outcome::Late),
            missed: cell.count(Outcome::Missed),
            detection_ms,
            share: cell.runs.iter().filter_map(share).max().unwrap_or(0),
            examples: examples.into_iter().filter_map(example).collect(),
        }
    }

    /// How many runs were dangerous.
    #[must_use]
    pub const fn dangerous(&self) -> usize {
        self.averted.saturating_add(self.reported).saturating_add(self.late).saturating_add(self.missed)
    }

    /// How many runs there were.
    #[must_use]
    pub const fn runs(&self) -> usize {
        self.harmless.saturating_add(self.dangerous())
    }
}

/// The result of a campaign or of a part of it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Matrix {
    /// `supervise-inject`.
    pub schema: String,
    /// Version of this layout.
    pub version: u32,
    /// The seed.
    pub seed: u64,
    /// Runs for each cell.
    pub runs: u32,
    /// Into how many parts it was divided.
    pub shards: usize,
    /// What it depends on.
    pub sources: Sources,
    /// The drives without a fault.
    pub drives: Vec<Drive>,
    /// Fault × scenario; where a fault does not apply there is none.
    pub cells: Vec<Cell>,
}

/// The schema of the document.
pub const SCHEMA: &str = "supervise-inject";

impl Matrix {
    /// Reads a document.
    ///
    /// # Errors
    /// It is none.
    pub fn read(text: &str) -> Result<Self, String> {
        let matrix: Self = serde_json::from_str(text).map_err(|error| error.to_string())?;
        if matrix.schema == SCHEMA && matrix.version == 1 {
            Ok(matrix)
        } else {
            Err(format!("is {} {}, not {SCHEMA} 1", matrix.schema, matrix.version))
        }
    }

    /// The document, one cell in a line.
    ///
    /// # Errors
    /// If a value has no JSON.
    pub fn write(&self) -> Result<String, serde_json::Error> {
        let mut head = serde_json::to_value(Self { drives: Vec::new(), cells: Vec::new(), ..self.clone() })?;
        let fields = head.as_object_mut().map(std::mem::take).unwrap_or_default();
        let mut lines = Vec::new();
        for (name, value) in fields.iter().filter(|(name, _)| !matches!(name.as_str(), "drives" | "cells")) {
            lines.push(format!("\"{name}\": {value}"));
        }
        let list = |items: Vec<String>| format!("[\n  {}\n]", items.join(",\n  "));
        let drives: Result<Vec<_>, _> = self.drives.iter().map(serde_json::to_string).collect();
        let cells: Result<Vec<_>, _> = self.cells.iter().map(serde_json::to_string).collect();
        lines.push(format!("\"drives\": {}", list(drives?)));
        lines.push(format!("\"cells\": {}", list(cells?)));
        Ok(format!("{{\n{}\n}}\n", lines.join(",\n")))
    }

    /// The whole out of its parts.
    ///
    /// # Errors
    /// They do not belong together, one is missing, or two say something of one cell.
    pub fn merge(parts: Vec<Self>) -> Result<Self, String> {
        let count = parts.len();
        let mut parts = parts.into_iter();
        let mut whole = parts.next().ok_or("nothing to merge")?;
        if whole.shards != count {
            return Err(format!("{count} of {} parts", whole.shards));
        }
        for part in parts {
            let same = part.seed == whole.seed
                && part.runs == whole.runs
                && part.shards == whole.shards
                && part.sources == whole.sources
                && part.drives == whole.drives;
            if !same {
                return Err("the parts are not of one campaign: seed, runs, sources or drives differ".to_owned());
            }
            whole.cells.extend(part.cells);
        }
        whole.cells.sort();
        let mut seen = BTreeSet::new();
        for cell in &whole.cells {
            if !seen.insert((&cell.fault, &cell.scenario)) {
                return Err(format!("{} in {} stands in two parts", cell.fault, cell.scenario));
            }
        }
        whole.shards = 1;
        Ok(whole)
    }

    /// The cells of one fault, by scenario.
    #[must_use]
    pub fn of<'a>(&'a self, fault: &str) -> BTreeMap<&'a str, &'a Cell> {
        self.cells.iter().filter(|cell| cell.fault == fault).map(|cell| (cell.scenario.as_str(), cell)).collect()
    }
}
