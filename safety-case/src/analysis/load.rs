//! Reading the folder; an error names file and entry.

use std::fmt;
use std::fs;
use std::path::Path;

use serde::Deserialize;
use serde::de::DeserializeOwned;

use super::fmea::{self, Failure};
use super::limitations::{self, LimitationFile};
use super::methods::{self, MethodTable};
use super::model::{Analysis, Assumption, Goal, Hazard, Reading, Requirement};
use super::tools::{self, Tool};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct HazardFile {
    hazard: Vec<Hazard>,
}
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct GoalFile {
    goal: Vec<Goal>,
}
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RequirementFile {
    requirement: Vec<Requirement>,
}
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct AssumptionFile {
    assumption: Vec<Assumption>,
}
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ReadingFile {
    reading: Vec<Reading>,
}

#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
struct FailureFile {
    failure: Vec<Failure>,
}
#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
struct ToolFile {
    tool: Vec<Tool>,
}
#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
struct MethodFile {
    table: Vec<MethodTable>,
}
/// Of the faults their ids alone; the rest is read where they are injected.
#[derive(Default, Deserialize)]
struct FaultFile {
    fault: Vec<FaultId>,
}
#[derive(Deserialize)]
struct FaultId {
    id: String,
}

/// Why an analysis can not be loaded.
#[derive(Debug, PartialEq, Eq)]
pub struct AnalysisError {
    /// The file or folder.
    pub file: String,
    /// The entry in it, where one is known.
    pub entry: Option<String>,
    /// What is wrong.
    pub message: String,
}

impl fmt::Display for AnalysisError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: ", self.file)?;
        if let Some(entry) = &self.entry {
            write!(f, "{entry}: ")?;
        }
        f.write_str(&self.message)
    }
}

impl std::error::Error for AnalysisError {}

/// Reads the analysis from `folder`: the six files of the top level that every analysis has, every `.toml` in `requirements`,
/// and what is there of failure modes, tools, methods, limitations and faults.
///
/// # Errors
/// A file that is missing, can not be read, is no TOML, or has a key too many, a key too few or a value of the wrong kind.
pub fn load(folder: &Path) -> Result<Analysis, AnalysisError> {
    let mut texts = Vec::new();
    let item = read(&folder.join("item.toml"), &mut texts)?;
    let hazards = read::<HazardFile>(&folder.join("hazards.toml"), &mut texts)?.hazard;
    let goals = read::<GoalFile>(&folder.join("goals.toml"), &mut texts)?.goal;
    let assumptions = read::<AssumptionFile>(&folder.join("assumptions.toml"), &mut texts)?.assumption;
    let timing = read(&folder.join("timing.toml"), &mut texts)?;
    let readings = read::<ReadingFile>(&folder.join("readings.toml"), &mut texts)?.reading;
    let mut requirements = Vec::new();
    for path in requirement_files(&folder.join("requirements"))? {
        requirements.extend(read::<RequirementFile>(&path, &mut texts)?.requirement);
    }
    let failures = read_if_there::<FailureFile>(&folder.join(fmea::FILE), &mut texts)?.failure;
    let tools = read_if_there::<ToolFile>(&folder.join(tools::FILE), &mut texts)?.tool;
    let methods = read_if_there::<MethodFile>(&folder.join(methods::FILE), &mut texts)?.table;
    let LimitationFile { limitation: limitations, risk: risks } =
        read_if_there(&folder.join(limitations::FILE), &mut texts)?;
    let faults = read_if_there::<FaultFile>(&folder.join("faults.toml"), &mut texts)?.fault;
    let faults = faults.into_iter().map(|fault| fault.id).collect();
    Ok(Analysis {
        item,
        hazards,
        goals,
        requirements,
        assumptions,
        timing,
        readings,
        failures,
        tools,
        methods,
        limitations,
        risks,
        faults,
        texts,
    })
}

/// The same as [`read`]; nothing, where there is no such file.
fn read_if_there<T: DeserializeOwned + Default>(
    path: &Path,
    texts: &mut Vec<(String, String)>,
) -> Result<T, AnalysisError> {
    if path.exists() { read(path, texts) } else { Ok(T::default()) }
}

/// The `.toml` files of a folder in the order of their names.
fn requirement_files(folder: &Path) -> Result<Vec<std::path::PathBuf>, AnalysisError> {
    let failed = |error: std::io::Error| AnalysisError {
        file: folder.display().to_string(),
        entry: None,
        message: error.to_string(),
    };
    let mut files = Vec::new();
    for entry in fs::read_dir(folder).map_err(failed)? {
        let path = entry.map_err(failed)?.path();
        if path.extension().is_some_and(|extension| extension == "toml") {
            files.push(path);
        }
    }
    files.sort();
    Ok(files)
}

fn read<T: DeserializeOwned>(path: &Path, texts: &mut Vec<(String, String)>) -> Result<T, AnalysisError> {
    let file = path.display().to_string();
    let text = fs::read_to_string(path).map_err(|error| AnalysisError {
        file: file.clone(),
        entry: None,
        message: error.to_string(),
    })?;
    let value = parse(&file, &text)?;
    texts.push((file, text));
    Ok(value)
}

/// Parses one file; an error names the entry in which it stands.
pub(super) fn parse<T: DeserializeOwned>(file: &str, text: &str) -> Result<T, AnalysisError> {
    toml::from_str(text).map_err(|error| AnalysisError {
        file: file.to_owned(),
        entry: error.span().and_then(|span| entry_at(text, span.start)),
        message: error.to_string().trim_end().to_owned(),
    })
}

/// The id of the entry around the byte `at`: of the table that the last header line before it opens.
fn entry_at(text: &str, at: usize) -> Option<String> {
    let line_end = text.get(at..)?.find('\n').map_or(text.len(), |rest| at + rest);
    let header = text
        .get(..line_end)?
        .rmatch_indices("[[")
        .find(|(place, _)| *place == 0 || text.get(..*place).is_some_and(|before| before.ends_with('\n')))?;
    text.get(header.0..)?.lines().skip(1).take_while(|line| !line.starts_with('[')).find_map(|line| {
        let id = line.strip_prefix("id")?.trim_start().strip_prefix('=')?;
        Some(id.trim().trim_matches('"').to_owned())
    })
}
