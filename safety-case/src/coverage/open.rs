//! What may stay open, each with its reason; and what follows from it for a run.

use std::path::Path;

use serde::Deserialize;

use super::figures::Open;
use super::plan::Kind;
use crate::error::{ToolError, form, read};

/// The list.
pub const LIST: &str = "safety-case/analysis/coverage-open.toml";

/// Something that may stay open. Found by how it reads, so it moves with its lines.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Accepted {
    /// Its file.
    pub file: String,
    /// Its function.
    pub function: String,
    /// What it is.
    pub kind: Kind,
    /// How it reads.
    pub text: String,
    /// The decision that a condition belongs to, where the condition alone does not say which.
    pub decision: Option<String>,
    /// Why no test can, or needs to, cover it.
    pub reason: String,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct List {
    #[serde(default)]
    open: Vec<Accepted>,
}

impl Accepted {
    /// Reads the list.
    ///
    /// # Errors
    /// It cannot be read, or an entry has no reason.
    pub fn load(root: &Path) -> Result<Vec<Self>, ToolError> {
        let path = root.join(LIST);
        let list: List = toml::from_str(&read(&path)?).map_err(|error| form(&path, &error))?;
        match list.open.iter().find(|entry| entry.reason.trim().is_empty()) {
            Some(entry) => Err(form(&path, &format!("{} has no reason", entry.text))),
            None => Ok(list.open),
        }
    }

    pub(super) fn is_of(&self, open: &Open) -> bool {
        self.file == open.file
            && self.function == open.function
            && self.kind == open.kind
            && self.text == open.text
            && (self.decision.is_none() || self.decision == open.decision)
    }
}

/// What is not as it must be.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Finding {
    /// Open, and not in the list.
    Open(Open),
    /// In the list, and covered now, or gone.
    Idle(Accepted),
    /// The record is of other sources.
    Stale,
    /// The record is of other tests: a note, because it may be as good.
    OtherTests,
}

impl Finding {
    /// Whether it fails the check.
    #[must_use]
    pub const fn fails(&self) -> bool {
        !matches!(self, Self::OtherTests)
    }
}

impl std::fmt::Display for Finding {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Open(open) => write!(f, "OPEN: {open}"),
            Self::Idle(entry) => {
                write!(f, "listed as open, and is not: {} {}: {}", entry.file, entry.function, entry.text)
            }
            Self::Stale => {
                f.write_str("STALE: the sources are others than those that were measured; run `supervise coverage`")
            }
            Self::OtherTests => f.write_str("note: the tests changed since; these figures are of the tests of then"),
        }
    }
}

/// Compares what is open with the list.
#[must_use]
pub fn compare(open: &[Open], accepted: &[Accepted]) -> Vec<Finding> {
    let unlisted = open.iter().filter(|open| !accepted.iter().any(|entry| entry.is_of(open)));
    let idle = accepted.iter().filter(|entry| !open.iter().any(|open| entry.is_of(open)));
    unlisted.cloned().map(Finding::Open).chain(idle.cloned().map(Finding::Idle)).collect()
}
