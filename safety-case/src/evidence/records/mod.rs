//! The one list of records: what was run, whether it is of the present sources, what it says and what it does not show.
//!
//! A record that is not there says "not run"; one whose digests are not those of the present sources says "stale", with what
//! changed. Nothing here runs a campaign: it reads what others have written.

mod at_hand;
mod committed;
mod other;
mod tests_log;

use std::collections::BTreeMap;
use std::path::Path;

use serde::Serialize;

pub use tests_log::{LOG, TestLog, TestResult};

use crate::drives::Drive;
use crate::error::ToolError;
use crate::trace::{Summary, Trace};

/// Whether a record speaks of what is here.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case", tag = "state")]
pub enum State {
    /// Of the present sources.
    Fresh,
    /// Of other sources: what changed.
    Stale {
        /// What changed since.
        changed: Vec<String>,
    },
    /// There is none.
    NotRun,
}

impl State {
    /// Fresh if nothing changed.
    #[must_use]
    pub fn of(changed: Vec<String>) -> Self {
        if changed.is_empty() { Self::Fresh } else { Self::Stale { changed } }
    }

    /// In a word.
    #[must_use]
    pub const fn word(&self) -> &'static str {
        match self {
            Self::Fresh => "fresh",
            Self::Stale { .. } => "stale",
            Self::NotRun => "not run",
        }
    }
}

/// A figure of a record.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Figure {
    /// Its name in the record, for whoever quotes it.
    pub name: String,
    /// Its value.
    pub value: String,
    /// What it counts.
    pub what: String,
}

/// How a record stands.
#[derive(Clone, Debug, Serialize)]
pub struct Standing {
    /// Its name: what an argument refers to as "record NAME".
    pub name: &'static str,
    /// What it is about.
    pub title: String,
    /// The file.
    pub file: String,
    /// What makes it anew.
    pub command: &'static str,
    /// Whether it is of the present sources.
    #[serde(flatten)]
    pub state: State,
    /// Its figures.
    pub figures: Vec<Figure>,
    /// What in it is open, each in a line.
    pub open: Vec<String>,
    /// What it does not show.
    pub not_shown: &'static str,
    /// A file of this folder that shows all of it.
    pub page: Option<String>,
}

impl Standing {
    fn new(name: &'static str, title: &str, file: &str, command: &'static str, not_shown: &'static str) -> Self {
        Self {
            name,
            title: title.to_owned(),
            file: file.to_owned(),
            command,
            state: State::NotRun,
            figures: Vec::new(),
            open: Vec::new(),
            not_shown,
            page: None,
        }
    }

    fn figure(&mut self, name: &str, value: impl std::fmt::Display, what: &str) {
        self.figures.push(Figure { name: name.to_owned(), value: value.to_string(), what: what.to_owned() });
    }

    /// Nothing is open, stale or missing.
    #[must_use]
    pub fn is_good(&self) -> bool {
        self.state == State::Fresh && self.open.is_empty()
    }

    /// A figure by its name.
    #[must_use]
    pub fn get(&self, name: &str) -> Option<&str> {
        self.figures.iter().find(|figure| figure.name == name).map(|figure| figure.value.as_str())
    }
}

/// What was made beside the records, to be among them.
#[derive(Clone, Copy, Debug)]
pub struct Made<'a> {
    /// The table of requirements.
    pub trace: &'a Trace,
    /// The log of a run of the tests, if one is at hand.
    pub log: Option<&'a TestLog>,
    /// The drives that were replayed; none if they were left out.
    pub drives: Option<&'a [Drive]>,
}

/// The page of the scenarios, beside those of the drives.
pub const SCENARIOS: &str = "scenarios.html";

/// Every record.
///
/// # Errors
/// A record or a source is there and cannot be read.
pub fn standings(
    root: &Path,
    made: Made<'_>,
    say: &mut dyn FnMut(&str),
) -> Result<Vec<Standing>, Box<dyn std::error::Error>> {
    let mut all = Vec::new();
    say("records");
    let shared = committed::Shared::load(root)?;
    for (name, read) in committed::RECORDS {
        say(&format!("record: {name}"));
        all.push(read(&shared)?);
    }
    all.push(trace(made.trace));
    all.push(at_hand::tests(root, made)?);
    all.push(at_hand::exploration(root)?);
    all.push(at_hand::drives(made.drives));
    all.push(other::cost(root)?);
    all.push(other::fuzz(root)?);
    all.push(other::disturb(root)?);
    all.push(other::simulate(root, made.drives.is_some())?);
    all.push(other::target(root)?);
    Ok(all)
}

/// Records that are committed, in the order of the tables.
pub const COMMITTED: [&str; 11] = [
    "proofs",
    "mistakes",
    "contracts",
    "inject",
    "coverage",
    "mutants",
    "fuzz",
    "disturb",
    "simulate",
    "cost",
    "target",
];
/// Those that every run makes anew.
pub const MADE: [&str; 4] = ["trace", "tests", "exploration", "drives"];

/// The figures of all records: `inject.dangerous`.
#[must_use]
pub fn figures(standings: &[Standing]) -> BTreeMap<String, String> {
    standings
        .iter()
        .flat_map(|standing| {
            standing.figures.iter().map(|figure| (format!("{}.{}", standing.name, figure.name), figure.value.clone()))
        })
        .collect()
}

/// The table of requirements is made anew each time: always fresh.
fn trace(trace: &Trace) -> Standing {
    let mut standing =
        Standing::new("trace", "Traceability", "trace.html", "supervise trace", "That an item does what its tag says.");
    let summary = Summary::of(&trace.rows);
    standing.state = State::Fresh;
    standing.page = Some("trace.html".to_owned());
    standing.figure("requirements", summary.requirements, "requirements");
    standing.figure("covered", summary.covered, "with code, and a test, a check or a proof");
    standing.figure("by_review", summary.by_review, "with code; by analysis or review alone");
    standing.figure("tested", summary.tested, "with a test");
    standing.figure("proved", summary.proved, "with a recorded proof");
    standing.figure("planned", summary.planned_not_proved, "whose planned proof is not recorded");
    standing.figure("orphans", summary.orphans, "orphans");
    if summary.planned_not_proved > 0 {
        standing
            .open
            .push(format!("{} requirements have a planned proof that is not recorded", summary.planned_not_proved));
    }
    standing.open.extend(trace.findings.iter().map(ToString::to_string));
    standing
}

/// Whether a file that carries no digest is older than the newest of these sources.
fn older_than_sources(root: &Path, path: &Path, folders: &[&str]) -> Result<bool, ToolError> {
    let changed = |path: &Path| {
        let meta = std::fs::metadata(path).and_then(|meta| meta.modified());
        meta.map_err(|error| crate::error::file(path, error))
    };
    let made = changed(path)?;
    for folder in folders {
        for entry in walkdir::WalkDir::new(root.join(folder)).into_iter().filter_map(std::result::Result::ok) {
            let is_source = entry.path().extension().is_some_and(|extension| extension == "rs" || extension == "toml");
            if entry.file_type().is_file() && is_source && changed(entry.path())? > made {
                return Ok(true);
            }
        }
    }
    Ok(false)
}
