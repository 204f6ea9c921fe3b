//! The record, `safety-case/records/mutants.json`.

use std::collections::BTreeMap;
use std::path::Path;

use serde::{Deserialize, Serialize};

use crate::error::{ToolError, form, write};

/// Where it stands.
pub const RECORD: &str = "safety-case/records/mutants.json";

/// What became of a mutant.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", tag = "outcome")]
pub enum Outcome {
    /// A test program failed, or did not end.
    Caught {
        /// Which.
        by: String,
    },
    /// Every test passed.
    Survived,
    /// Every test passed, and a proof shows that it changes nothing.
    Equal {
        /// Digest of the proof in the explanation.
        proof: String,
        /// The version of Kani.
        by: String,
    },
    /// It does not compile, so it is no mutant.
    Unviable,
}

/// A mutant that ran.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Entry {
    /// As cargo-mutants names it.
    pub name: String,
    /// What became of it.
    #[serde(flatten)]
    pub outcome: Outcome,
}

/// The record.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Record {
    /// Digest of the shipped sources that were mutated.
    pub sources: String,
    /// How many mutants cargo-mutants lists of them.
    pub listed: usize,
    /// Test programs that ran for every mutant that the ones before did not catch.
    pub tests: Vec<String>,
    /// Every mutant that ran, by its name.
    pub mutants: Vec<Entry>,
}

impl Record {
    /// The committed one; empty if there is none.
    ///
    /// # Errors
    /// It cannot be read or understood.
    pub fn load(root: &Path) -> Result<Self, ToolError> {
        let path = root.join(RECORD);
        match std::fs::read(&path) {
            Ok(bytes) => serde_json::from_slice(&bytes).map_err(|error| form(&path, &error)),
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => Ok(Self::default()),
            Err(error) => Err(ToolError::File { path, error }),
        }
    }

    /// Writes it.
    ///
    /// # Errors
    /// It cannot be written.
    pub fn save(&self, root: &Path) -> Result<(), ToolError> {
        let path = root.join(RECORD);
        let form = |error: serde_json::Error| form(&path, &error);
        // One line for each mutant: a change is one line of a diff.
        let mut text = format!(
            "{{\n\"sources\": {},\n\"listed\": {},\n\"tests\": {},\n\"mutants\": [\n",
            serde_json::to_string(&self.sources).map_err(form)?,
            self.listed,
            serde_json::to_string(&self.tests).map_err(form)?
        );
        for (index, entry) in self.mutants.iter().enumerate() {
            let comma = if index == 0 { "" } else { ",\n" };
            text.push_str(comma);
            text.push_str(&serde_json::to_string(entry).map_err(form)?);
        }
        text.push_str("\n]\n}\n");
        write(&path, text.as_bytes())
    }

    /// Takes over what ran, in the order of the names.
    pub fn put(&mut self, entry: Entry) {
        match self.mutants.binary_search_by(|present| present.name.cmp(&entry.name)) {
            Ok(at) => {
                if let Some(present) = self.mutants.get_mut(at) {
                    *present = entry;
                }
            }
            Err(at) => self.mutants.insert(at, entry),
        }
    }

    /// How many came to each end: caught, survived, proved to change nothing, unviable.
    #[must_use]
    pub fn counts(&self) -> [usize; 4] {
        let mut counts = [0_usize; 4];
        let [caught, survived, equal, unviable] = &mut counts;
        for entry in &self.mutants {
            let count = match entry.outcome {
                Outcome::Caught { .. } => &mut *caught,
                Outcome::Survived => &mut *survived,
                Outcome::Equal { .. } => &mut *equal,
                Outcome::Unviable => &mut *unviable,
            };
            *count = count.saturating_add(1);
        }
        counts
    }

    /// Which test program caught each mutant that was caught.
    #[must_use]
    pub fn catchers(&self) -> BTreeMap<String, String> {
        let caught = self.mutants.iter().filter_map(|entry| match &entry.outcome {
            Outcome::Caught { by } => Some((entry.name.clone(), by.clone())),
            Outcome::Survived | Outcome::Equal { .. } | Outcome::Unviable => None,
        });
        caught.collect()
    }

    /// The mutants that survived, and of which no proof shows that they change nothing.
    pub fn survivors(&self) -> impl Iterator<Item = &str> {
        self.mutants.iter().filter(|entry| entry.outcome == Outcome::Survived).map(|entry| entry.name.as_str())
    }

    /// The mutants that a proof shows to change nothing, with the digest of the proof.
    pub fn equals(&self) -> impl Iterator<Item = (&str, &str)> {
        self.mutants.iter().filter_map(|entry| match &entry.outcome {
            Outcome::Equal { proof, .. } => Some((entry.name.as_str(), proof.as_str())),
            Outcome::Caught { .. } | Outcome::Survived | Outcome::Unviable => None,
        })
    }

    /// How many each file has: caught, survived, proved to change nothing, unviable.
    #[must_use]
    pub fn by_file(&self) -> BTreeMap<&str, [usize; 4]> {
        let mut files: BTreeMap<&str, Self> = BTreeMap::new();
        for entry in &self.mutants {
            let file = entry.name.split(':').next().unwrap_or_default();
            files.entry(file).or_default().mutants.push(entry.clone());
        }
        files.into_iter().map(|(file, record)| (file, record.counts())).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::{Entry, Outcome, Record};

    #[test]
    fn what_ran_stands_once_and_in_order_and_is_read_back() {
        let entry = |name: &str, outcome| Entry { name: name.to_owned(), outcome };
        let mut record = Record { sources: "s".into(), listed: 3, tests: vec!["t".into()], mutants: Vec::new() };
        record.put(entry("b.rs:1:1: x", Outcome::Survived));
        record.put(entry("a.rs:1:1: x", Outcome::Caught { by: "t".into() }));
        record.put(entry("b.rs:1:1: x", Outcome::Unviable));
        assert_eq!(record.counts(), [1, 0, 0, 1]);
        assert_eq!(record.catchers(), [("a.rs:1:1: x".to_owned(), "t".to_owned())].into());
        assert_eq!(record.by_file().get("b.rs"), Some(&[0, 0, 0, 1]));
        let Ok(folder) = tempfile::tempdir() else { unreachable!("there is a temporary folder") };
        let path = folder.path().join("safety-case/records");
        assert!(std::fs::create_dir_all(&path).is_ok() && record.save(folder.path()).is_ok());
        assert!(Record::load(folder.path()).is_ok_and(|read| read == record));
    }
}
