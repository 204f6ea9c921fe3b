//! The record of the runs, and the parts that shards make of it.

use std::fs;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::harness::{Checks, List, Solver};
use super::judge::Verdict;
use super::kani::Tools;
use super::raw::{RESULTS, Raw};
use crate::error::{ToolError, file, form, read, write};

/// The record that is committed.
pub const RECORD: &str = "proofs/record.json";
/// Version of the layout.
const VERSION: u32 = 2;

/// One harness as it ran.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Proof {
    /// Name of the harness.
    pub name: String,
    /// Rows of the specification that it proves.
    pub requirements: Vec<String>,
    /// exhaustive, or bounded with the bound.
    pub extent: String,
    /// What came out.
    #[serde(flatten)]
    pub verdict: Verdict,
    /// Which checks it decides.
    #[serde(default)]
    pub decides: Checks,
    /// Checks decided.
    pub checks: usize,
    /// Covers.
    pub covers: usize,
    /// The solver.
    pub solver: Solver,
    /// How long it took, in seconds, compilation included.
    pub seconds: u64,
    /// Versions of the tools.
    pub tools: Tools,
    /// Digest of the sources it ran on.
    pub sources: String,
    /// Digest of the sealed configuration it ran with.
    pub configuration: String,
    /// Digest of its raw result, unpacked.
    pub result: String,
}

/// The record: an entry for each harness that ran, in the order of the list.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Record {
    version: u32,
    /// The entries.
    pub proofs: Vec<Proof>,
}

impl Default for Record {
    fn default() -> Self {
        Self { version: VERSION, proofs: Vec::new() }
    }
}

/// Where a record stands, and its raw results.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// The record.
    pub record: PathBuf,
    /// The folder of the raw results.
    pub results: PathBuf,
}

impl Place {
    /// The one that is committed.
    #[must_use]
    pub fn committed(root: &Path) -> Self {
        Self { record: root.join(RECORD), results: root.join(RESULTS) }
    }

    /// A record with its results in a folder beside it: a shard's part.
    #[must_use]
    pub fn beside(record: &Path) -> Self {
        let results = record.parent().unwrap_or(Path::new("")).join("results");
        Self { record: record.to_owned(), results }
    }
}

impl Record {
    /// Reads a record; an absent one is empty.
    ///
    /// # Errors
    /// The file is there but is no record of this layout.
    pub fn load(path: &Path) -> Result<Self, ToolError> {
        if !path.exists() {
            return Ok(Self::default());
        }
        let record: Self = serde_json::from_str(&read(path)?).map_err(|error| form(path, &error))?;
        if record.version == VERSION {
            Ok(record)
        } else {
            Err(form(path, &format!("layout {}, expected {VERSION}", record.version)))
        }
    }

    /// Writes it, at once: whoever reads it meanwhile sees the old one or the new one.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn save(&self, path: &Path) -> Result<(), ToolError> {
        let text = serde_json::to_string_pretty(self).map_err(|error| form(path, &error))?;
        let beside = path.with_extension("json.tmp");
        write(&beside, (text + "\n").as_bytes())?;
        fs::rename(&beside, path).map_err(|error| file(path, error))
    }

    /// The entry of a harness.
    #[must_use]
    pub fn of(&self, name: &str) -> Option<&Proof> {
        self.proofs.iter().find(|proof| proof.name == name)
    }

    /// Puts an entry in the place that the list gives it, and lets go of entries that the list does not know.
    pub fn put(&mut self, proof: Proof, list: &List) {
        self.proofs.retain(|entry| entry.name != proof.name);
        self.proofs.push(proof);
        self.adopt(list);
    }

    /// Takes requirements, extent and order from the list: they say what a harness is for, and no run changes them.
    pub fn adopt(&mut self, list: &List) {
        self.proofs.retain(|entry| list.of(&entry.name).is_some());
        self.proofs.sort_by_key(|entry| list.place(&entry.name));
        for entry in &mut self.proofs {
            if let Some(harness) = list.of(&entry.name) {
                entry.requirements.clone_from(&harness.requirements);
                entry.extent.clone_from(&harness.extent);
            }
        }
    }

    /// Takes over every entry of a part, with its raw result; the number of entries.
    ///
    /// # Errors
    /// A raw result is missing or is not the one the part speaks of; a file cannot be written.
    pub fn merge(&mut self, from: &Place, to: &Place, list: &List) -> Result<usize, ToolError> {
        if !from.record.exists() {
            return Err(form(&from.record, &"is not there"));
        }
        let part = Self::load(&from.record)?;
        let count = part.proofs.len();
        for proof in part.proofs {
            let raw = Raw::load(&from.results, &proof.name)?;
            if raw.digest() != proof.result {
                return Err(form(&from.record, &format!("the raw result of {} is another one", proof.name)));
            }
            raw.save(&to.results, &proof.name)?;
            self.put(proof, list);
        }
        self.save(&to.record)?;
        Ok(count)
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use serde_json::json;

    pub fn list(names: &[&str]) -> Result<List, toml::de::Error> {
        let entry = |name: &&str| {
            format!(
                "[[harness]]\nname = \"{name}\"\npath = \"harness::m\"\nfamily = \"safety\"\n\
                 requirements = [\"SEAT-5a\"]\nextent = \"exhaustive\"\n"
            )
        };
        toml::from_str(&names.iter().map(entry).collect::<String>())
    }

    pub fn proof(name: &str, seconds: u64) -> Proof {
        Proof {
            name: name.to_owned(),
            requirements: vec!["OLD-1a".to_owned()],
            extent: "old".to_owned(),
            verdict: Verdict::Proved,
            checks: 5,
            decides: Checks::All,
            covers: 2,
            solver: Solver::Kissat,
            seconds,
            tools: Tools::default(),
            sources: "s".to_owned(),
            configuration: "c".to_owned(),
            result: "r".to_owned(),
        }
    }

    #[test]
    fn it_keeps_the_order_and_the_words_of_the_list() -> Result<(), Box<dyn std::error::Error>> {
        let list = list(&["a", "b"])?;
        let mut record = Record::default();
        for name in ["b", "gone", "a", "b"] {
            record.put(proof(name, 1), &list);
        }
        let names: Vec<&str> = record.proofs.iter().map(|proof| proof.name.as_str()).collect();
        assert_eq!(names, ["a", "b"]);
        assert!(record.proofs.iter().all(|proof| proof.requirements == ["SEAT-5a"] && proof.extent == "exhaustive"));
        let folder = tempfile::tempdir()?;
        let path = folder.path().join("proofs/record.json");
        assert_eq!(Record::load(&path)?, Record::default());
        record.save(&path)?;
        assert_eq!(Record::load(&path)?, record);
        fs::write(&path, "{\"version\": 1, \"proofs\": []}")?;
        assert!(Record::load(&path).is_err());
        Ok(())
    }

    #[test]
    fn parts_are_joined_with_their_raw_results() -> Result<(), Box<dyn std::error::Error>> {
        let list = list(&["a", "b", "c"])?;
        let folder = tempfile::tempdir()?;
        let to = Place::committed(folder.path());
        let mut whole = Record::default();
        whole.put(proof("a", 1), &list);
        for name in ["b", "c"] {
            let from = Place::beside(&folder.path().join(name).join("record.json"));
            let raw = Raw::of(&json!({"of": name}), folder.path());
            raw.save(&from.results, name)?;
            let mut part = Record::default();
            part.put(Proof { result: raw.digest(), ..proof(name, 1) }, &list);
            part.save(&from.record)?;
            assert_eq!(whole.merge(&from, &to, &list)?, 1);
            assert_eq!(Raw::load(&to.results, name)?, raw);
        }
        assert_eq!(Record::load(&to.record)?.proofs.len(), 3);

        let from = Place::beside(&folder.path().join("c/record.json"));
        Raw::of(&json!({"of": "another"}), folder.path()).save(&from.results, "c")?;
        assert!(whole.merge(&from, &to, &list).is_err(), "a raw result of another run");
        assert!(whole.merge(&Place::beside(Path::new("nowhere/record.json")), &to, &list).is_err());
        Ok(())
    }
}
