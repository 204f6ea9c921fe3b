//! The list of harnesses, the record of their runs, and whether it is stale.

use std::fs;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

use super::error::{ProveError, form, read};
use super::harness::{List, Solver};
use super::judge::Verdict;
use super::kani::Tools;

/// Folders whose sources a proof speaks of.
const SOURCES: [&str; 5] =
    ["supervisor/terms/src", "supervisor/observe/src", "supervisor/core/src", "supervisor/perceive/src", "proofs/src"];

/// One harness as it ran.
#[derive(Clone, Debug, Serialize, Deserialize)]
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
    /// Checks decided.
    pub checks: usize,
    /// Covers satisfied.
    pub covers: usize,
    /// The solver.
    pub solver: Solver,
    /// How long it took, in seconds.
    pub seconds: u64,
    /// Digest of the sources it ran on.
    pub sources: String,
}

/// The record, `proofs/record.json`.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Record {
    /// Version of this layout.
    pub version: u32,
    /// Versions of the tools.
    pub tools: Tools,
    /// One entry per harness, in the order of the list.
    pub proofs: Vec<Proof>,
}

impl Record {
    /// Reads the record; an absent one is empty.
    ///
    /// # Errors
    /// The file is there but is no record.
    pub fn load(root: &Path) -> Result<Self, ProveError> {
        let path = root.join("proofs/record.json");
        if !path.exists() {
            return Ok(Self { version: 1, ..Self::default() });
        }
        serde_json::from_str(&read(&path)?).map_err(|error| form(&path, &error))
    }

    /// Writes it.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn save(&self, root: &Path) -> Result<(), ProveError> {
        let path = root.join("proofs/record.json");
        let text = serde_json::to_string_pretty(self).map_err(|error| form(&path, &error))?;
        fs::write(&path, text + "\n").map_err(|error| ProveError::File { path, error })
    }

    /// The entry of a harness.
    #[must_use]
    pub fn of(&self, name: &str) -> Option<&Proof> {
        self.proofs.iter().find(|proof| proof.name == name)
    }

    /// Puts an entry in the place that the list gives it.
    pub fn put(&mut self, proof: Proof, list: &List) {
        self.proofs.retain(|entry| entry.name != proof.name);
        self.proofs.push(proof);
        self.proofs.retain(|entry| list.place(&entry.name).is_some());
        self.proofs.sort_by_key(|entry| list.place(&entry.name));
    }
}

/// Digest of the sources that the proofs speak of, without comment lines and blank lines: a comment makes no proof stale.
///
/// # Errors
/// A folder or file cannot be read.
pub fn sources_digest(root: &Path) -> Result<String, ProveError> {
    let mut files = Vec::new();
    for folder in SOURCES {
        collect(&root.join(folder), &mut files)?;
    }
    files.sort();
    let mut digest = Sha256::new();
    for file in files {
        let name = file.strip_prefix(root).unwrap_or(&file).to_string_lossy().replace('\\', "/");
        digest.update(name.as_bytes());
        for line in read(&file)?.lines().map(str::trim).filter(|line| !line.is_empty() && !line.starts_with("//")) {
            digest.update(line.as_bytes());
            digest.update(b"\n");
        }
    }
    Ok(format!("{:x}", digest.finalize()))
}

fn collect(folder: &Path, files: &mut Vec<PathBuf>) -> Result<(), ProveError> {
    let error = |error| ProveError::File { path: folder.to_owned(), error };
    for entry in fs::read_dir(folder).map_err(error)? {
        let path = entry.map_err(error)?.path();
        if path.is_dir() {
            collect(&path, files)?;
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            files.push(path);
        }
    }
    Ok(())
}
