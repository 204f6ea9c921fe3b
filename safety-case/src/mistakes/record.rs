//! The record of planted mistakes, `proofs/mistakes.json`.

use std::fs;
use std::path::Path;

use serde::{Deserialize, Serialize};

use crate::error::ToolError;
use crate::prove::{Sources, Tools};

/// Where it stands.
pub const RECORD: &str = "proofs/mistakes.json";

/// What became of a mistake.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", tag = "outcome")]
pub enum Outcome {
    /// A harness failed on it.
    Caught {
        /// Which.
        harness: String,
        /// The check that failed.
        check: String,
    },
    /// No assertion that was decided fails on it.
    Survived,
    /// No verdict within the time: not caught.
    Undecided,
    /// It is no Rust, so it is no mistake.
    DoesNotCompile {
        /// What the compiler says.
        error: String,
    },
}

impl Outcome {
    /// Whether a proof fails on it.
    #[must_use]
    pub const fn is_caught(&self) -> bool {
        matches!(self, Self::Caught { .. })
    }
    /// Whether it compiles.
    #[must_use]
    pub const fn is_mistake(&self) -> bool {
        !matches!(self, Self::DoesNotCompile { .. })
    }
}

/// A harness that was tried.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Tried {
    /// Its name.
    pub harness: String,
    /// Its verdict.
    pub verdict: String,
    /// How long it took, in seconds, compilation included.
    pub seconds: u64,
}

/// A mistake as it ran.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Entry {
    /// Its name; of a drawn one what cargo-mutants says.
    pub name: String,
    /// Digest of the file with the mistake.
    pub change: String,
    /// What became of it.
    #[serde(flatten)]
    pub outcome: Outcome,
    /// What was tried, in order.
    pub tried: Vec<Tried>,
    /// How long all of it took, in seconds.
    pub seconds: u64,
    /// Digest of what the harnesses that were tried speak of, without the mistake.
    pub sources: String,
}

impl Entry {
    /// Whether it ran on these sources, as far as the harnesses that were tried speak of them.
    #[must_use]
    pub fn is_current(&self, sources: &Sources) -> bool {
        self.sources == sources.of_all(self.tried.iter().map(|tried| tried.harness.as_str()))
    }
}

/// The drawn ones.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct DrawnRecord {
    /// The seed.
    pub seed: u64,
    /// How many the list had.
    pub of: usize,
    /// In the order in which they were drawn, those that do not compile among them.
    pub mistakes: Vec<Entry>,
}

/// The record.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Record {
    /// Version of this layout.
    pub version: u32,
    /// Versions of the tools.
    pub tools: Tools,
    /// The named ones, in the order of the list.
    pub named: Vec<Entry>,
    /// The drawn ones.
    pub drawn: DrawnRecord,
}

impl Record {
    /// Reads the record; an absent one is empty.
    ///
    /// # Errors
    /// The file is there but is no record.
    pub fn load(root: &Path) -> Result<Self, ToolError> {
        let path = root.join(RECORD);
        if !path.exists() {
            return Ok(Self { version: 1, ..Self::default() });
        }
        let text = super::change::source(root, RECORD)?;
        serde_json::from_str(&text).map_err(|error| ToolError::Form { path, message: error.to_string() })
    }

    /// Writes it.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn save(&self, root: &Path) -> Result<(), ToolError> {
        let path = root.join(RECORD);
        let text = serde_json::to_string_pretty(self)
            .map_err(|error| ToolError::Form { path: path.clone(), message: error.to_string() })?;
        fs::write(&path, text + "\n").map_err(|error| ToolError::File { path, error })
    }
}

/// Puts an entry in the place that `order` gives it; what has no place goes.
pub(super) fn put(entries: &mut Vec<Entry>, entry: Entry, order: &[String]) {
    let place = |name: &str| order.iter().position(|other| other == name);
    entries.retain(|other| other.name != entry.name && place(&other.name).is_some());
    entries.push(entry);
    entries.sort_by_key(|entry| place(&entry.name));
}

#[cfg(test)]
mod tests {
    use super::{Entry, Outcome, put};

    fn entry(name: &str, seconds: u64) -> Entry {
        let outcome = Outcome::Survived;
        let text = String::new;
        Entry { name: name.to_owned(), change: text(), outcome, tried: Vec::new(), seconds, sources: text() }
    }

    #[test]
    fn an_entry_replaces_its_own_and_what_the_list_no_longer_has_goes() {
        let order = ["a", "b"].map(str::to_owned);
        let mut entries = vec![entry("gone", 0), entry("b", 1)];
        put(&mut entries, entry("a", 2), &order);
        put(&mut entries, entry("b", 3), &order);
        assert_eq!(entries, [entry("a", 2), entry("b", 3)]);
    }

    #[test]
    fn an_entry_is_read_as_it_is_written() {
        let caught = Outcome::Caught { harness: "h".to_owned(), check: "assertion".to_owned() };
        let written = serde_json::to_string(&Entry { outcome: caught.clone(), ..entry("a", 1) }).unwrap_or_default();
        assert!(written.contains(r#""outcome":"caught""#), "{written}");
        let read = serde_json::from_str::<Entry>(&written);
        assert!(read.is_ok_and(|read| read.outcome == caught && read.outcome.is_caught()));
    }
}
