//! The list of harnesses, the record of their runs, and whether it is stale.

use std::fs;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

use super::judge::Verdict;

/// Folders whose sources a proof speaks of.
const SOURCES: [&str; 5] =
    ["supervisor/terms/src", "supervisor/observe/src", "supervisor/core/src", "supervisor/perceive/src", "proofs/src"];

/// What can go wrong besides a proof.
#[derive(Debug, thiserror::Error)]
pub enum ProveError {
    /// A file cannot be read or written.
    #[error("{path}: {error}", path = path.display())]
    File {
        /// Which.
        path: PathBuf,
        /// Why.
        error: std::io::Error,
    },
    /// A file does not say what it should.
    #[error("{path}: {message}", path = path.display())]
    Form {
        /// Which.
        path: PathBuf,
        /// What is wrong.
        message: String,
    },
    /// `cargo kani` did not start.
    #[error("cargo kani: {0}")]
    Tool(std::io::Error),
    /// A harness of that name is not in the list.
    #[error("no harness named {0} in proofs/harnesses.toml")]
    Unknown(String),
}

/// One harness of `proofs/harnesses.toml`.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Harness {
    /// Its name, unique.
    pub name: String,
    /// Its module.
    pub path: String,
    /// base, step, safety, reach.
    pub family: String,
    /// Rows of the specification that it proves.
    pub requirements: Vec<String>,
    /// exhaustive, or bounded with the bound.
    pub extent: String,
    /// Why it is known not to hold as stated; it then counts as open, never as proved.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub open: Option<String>,
}

impl Harness {
    /// As Kani names it.
    #[must_use]
    pub fn id(&self) -> String {
        format!("{}::{}", self.path, self.name)
    }
    /// Whether it must show that it is not vacuous by covers.
    #[must_use]
    pub fn reaches(&self) -> bool {
        self.family.contains("reach")
    }
}

/// `proofs/harnesses.toml`.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct List {
    /// The harnesses.
    pub harness: Vec<Harness>,
}

/// One harness as it ran.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Proof {
    /// The harness.
    #[serde(flatten)]
    pub harness: Harness,
    /// What came out.
    #[serde(flatten)]
    pub verdict: Verdict,
    /// Checks decided.
    pub checks: usize,
    /// Covers satisfied.
    pub covers: usize,
    /// The solver.
    pub solver: String,
    /// How long it took, in seconds.
    pub seconds: u64,
    /// Digest of the sources it ran on.
    pub sources: String,
}

/// Versions of the tools.
#[derive(Clone, Debug, Default, Serialize, Deserialize, PartialEq, Eq)]
pub struct Tools {
    /// Kani.
    pub kani: String,
    /// Its compiler.
    pub rustc: String,
    /// CBMC.
    pub cbmc: String,
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

fn read(path: &Path) -> Result<String, ProveError> {
    fs::read_to_string(path).map_err(|error| ProveError::File { path: path.to_owned(), error })
}

fn form(path: &Path, message: &dyn std::fmt::Display) -> ProveError {
    ProveError::Form { path: path.to_owned(), message: message.to_string() }
}

impl List {
    /// Reads the list.
    ///
    /// # Errors
    /// The file cannot be read, or names a harness twice.
    pub fn load(root: &Path) -> Result<Self, ProveError> {
        let path = root.join("proofs/harnesses.toml");
        let list: Self = toml::from_str(&read(&path)?).map_err(|error| form(&path, &error))?;
        let mut names: Vec<_> = list.harness.iter().map(|harness| &harness.name).collect();
        names.sort();
        match names.windows(2).find(|pair| pair.first() == pair.last()) {
            Some(pair) => Err(form(&path, &format!("harness {pair:?} stands twice"))),
            None => Ok(list),
        }
    }
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
        self.proofs.iter().find(|proof| proof.harness.name == name)
    }

    /// Puts an entry in the place that the list gives it.
    pub fn put(&mut self, proof: Proof, list: &List) {
        self.proofs.retain(|entry| entry.harness.name != proof.harness.name);
        self.proofs.push(proof);
        let place = |name: &str| list.harness.iter().position(|harness| harness.name == name);
        self.proofs.retain(|entry| place(&entry.harness.name).is_some());
        self.proofs.sort_by_key(|entry| place(&entry.harness.name));
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
