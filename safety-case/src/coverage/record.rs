//! The record of the last whole run, which is committed; and the whole document for other programs.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use serde::{Deserialize, Serialize};
use serde_json::{Value, json};
use sha2::{Digest, Sha256};

use super::figures::{Figures, Open, figures};
use super::run::Measured;
use crate::error::{ToolError, file, form, read, write};
use crate::prove::shipped;

/// The record.
pub const RECORD: &str = "safety-case/records/coverage.json";
/// What the figures depend on beside the shipped sources.
const TESTS: [&str; 4] = ["tests/src", "tests/tests", "proofs/src", "proofs/tests"];

/// What a whole run has measured.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Record {
    /// Names the form of this file.
    pub schema: String,
    /// Digest of the shipped sources, without comments and layout.
    pub sources: String,
    /// Digest of the tests.
    pub tests: String,
    /// The test programs that ran, by package.
    pub ran: BTreeMap<String, Vec<String>>,
    /// Everything together.
    pub sum: Figures,
    /// Each file.
    pub files: BTreeMap<String, Figures>,
    /// What no test covers.
    pub open: Vec<Open>,
    /// What is not instrumented, and why.
    pub left_out: Vec<String>,
}

impl Record {
    /// The record of a run.
    ///
    /// # Errors
    /// The sources or tests cannot be read.
    pub fn of(root: &Path, measured: &Measured) -> Result<Self, ToolError> {
        let (rows, open) = figures(&measured.plan, &measured.seen);
        let mut ran: BTreeMap<String, Vec<String>> = BTreeMap::new();
        for target in &measured.targets {
            ran.entry(target.package.clone()).or_default().push(target.name.clone());
        }
        let left_out = measured.plan.left_out.iter();
        let full = measured.seen.full.iter().filter_map(|number| measured.plan.decisions.get(*number));
        let more = full.map(|decision| (&decision.place, "more vectors than were recorded"));
        let left_out = left_out.map(|(place, why)| (place, why.as_str())).chain(more);
        let shown = left_out.map(|(place, why)| format!("{}:{} {}: {why}", place.file, place.line, place.function));
        Ok(Self {
            schema: "supervise-coverage 1".to_owned(),
            sources: shipped(root)?,
            tests: tests(root)?,
            ran,
            sum: Figures::sum(rows.values().flat_map(BTreeMap::values)),
            files: rows.iter().map(|(file, functions)| (file.clone(), Figures::sum(functions.values()))).collect(),
            open,
            left_out: shown.collect(),
        })
    }

    /// Reads it.
    ///
    /// # Errors
    /// It is not there or not one.
    pub fn load(root: &Path) -> Result<Self, ToolError> {
        let path = root.join(RECORD);
        serde_json::from_str(&read(&path)?).map_err(|error| form(&path, &error))
    }

    /// Writes it.
    ///
    /// # Errors
    /// It cannot be written.
    pub fn save(&self, root: &Path) -> Result<(), ToolError> {
        let path = root.join(RECORD);
        let text = serde_json::to_string_pretty(self).map_err(|error| form(&path, &error))?;
        write(&path, (text + "\n").as_bytes())
    }

    /// Whether the shipped sources, and the tests, are still those that were measured.
    ///
    /// # Errors
    /// The sources or tests cannot be read.
    pub fn is_current(&self, root: &Path) -> Result<(bool, bool), ToolError> {
        Ok((self.sources == shipped(root)?, self.tests == tests(root)?))
    }
}

/// Digest of the tests' files, as they are.
fn tests(root: &Path) -> Result<String, ToolError> {
    let mut digest = Sha256::new();
    for folder in TESTS {
        let walk = walkdir::WalkDir::new(root.join(folder)).sort_by_file_name();
        for entry in walk.into_iter().filter_map(Result::ok).filter(|entry| entry.file_type().is_file()) {
            let name = entry.path().strip_prefix(root).unwrap_or(entry.path()).to_string_lossy().replace('\\', "/");
            let text = fs::read(entry.path()).map_err(|error| file(entry.path(), error))?;
            digest.update(format!("{name}\0{}\0", text.len()));
            digest.update(text);
        }
    }
    Ok(format!("{:x}", digest.finalize()))
}

/// Everything: the record, each function, and each decision with its conditions and vectors.
///
/// # Errors
/// It cannot be written as JSON.
pub fn document(record: &Record, measured: &Measured) -> Result<Value, serde_json::Error> {
    let (rows, _) = figures(&measured.plan, &measured.seen);
    let decisions = measured.plan.decisions.iter().enumerate().map(|(number, decision)| {
        let vectors = measured.seen.of(number);
        let (masking, unique) = (decision.shown(&vectors), decision.shown_uniquely(&vectors));
        let conditions = decision.conditions.iter().zip(masking).zip(unique);
        let conditions = conditions.map(|(((line, text), masking), unique)| {
            json!({"line": line, "text": text, "masking": masking, "unique_cause": unique})
        });
        json!({
            "file": decision.place.file, "line": decision.place.line, "function": decision.place.function,
            "text": decision.text, "branches": decision.branches, "conditions": conditions.collect::<Vec<_>>(),
            "seen": vectors.iter().map(|vector| decision.letters(vector)).collect::<Vec<_>>(),
        })
    });
    let mut document = serde_json::to_value(record)?;
    if let Some(fields) = document.as_object_mut() {
        fields.insert("decisions".to_owned(), decisions.collect());
        fields.insert("functions".to_owned(), serde_json::to_value(&rows)?);
    }
    Ok(document)
}
