//! `safety-case/analysis/trace.toml`: what looks like an orphan and is none, each with its reason.

use std::fs;
use std::path::Path;

use serde::Deserialize;

use super::TraceError;

/// Where it stands.
pub const FILE: &str = "safety-case/analysis/trace.toml";

/// Something that has the form of an id and is none: the part before the hyphen.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Word {
    /// As in `UTF` of UTF-8.
    pub area: String,
    /// What it is.
    pub reason: String,
}

/// A test that belongs to no requirement.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Untagged {
    /// Its file.
    pub file: String,
    /// Its function.
    pub test: String,
    /// What it is for, then.
    pub reason: String,
}

/// All of them.
#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Allowances {
    /// What is no id.
    #[serde(default)]
    pub word: Vec<Word>,
    /// Tests without requirement.
    #[serde(default)]
    pub untagged: Vec<Untagged>,
    /// The file.
    #[serde(skip)]
    text: String,
}

impl Allowances {
    /// Reads the list; an absent one is empty.
    pub fn load(root: &Path) -> Result<Self, TraceError> {
        let path = root.join(FILE);
        if !path.exists() {
            return Ok(Self::default());
        }
        let text = fs::read_to_string(&path).map_err(|error| TraceError::File { path, error })?;
        let failed = |message: String| TraceError::Allowances { file: FILE.to_owned(), message };
        let mut list: Self = toml::from_str(&text).map_err(|error| failed(error.to_string().trim_end().to_owned()))?;
        let reasons = list.word.iter().map(|entry| (&entry.area, &entry.reason));
        let mut reasons = reasons.chain(list.untagged.iter().map(|entry| (&entry.test, &entry.reason)));
        if let Some((name, _)) = reasons.find(|(_, reason)| reason.trim().is_empty()) {
            return Err(failed(format!("{name} is allowed without a reason")));
        }
        list.text = text;
        Ok(list)
    }

    /// The line on which a name stands, from 1.
    pub fn line(&self, name: &str) -> usize {
        let name = format!("\"{name}\"");
        self.text.lines().position(|line| line.contains(&name)).map_or(0, |line| line + 1)
    }
}
