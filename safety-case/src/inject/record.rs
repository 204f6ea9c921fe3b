//! The committed result of a campaign, and whether it speaks of the present sources.

use std::fs;
use std::path::Path;

use super::list::FILE;
use super::matrix::{Matrix, Sources};
use crate::error::ToolError;
use crate::prove::{default_configuration, sha256, stepped, tokens};

/// Where it stands.
pub const RECORD: &str = "safety-case/records/inject.json";

/// Bus, main controller, injector and judge.
const BENCH: [&str; 1] = ["tests/src"];

impl Sources {
    /// Of the present sources.
    ///
    /// # Errors
    /// A file cannot be read or is no Rust.
    pub fn load(root: &Path) -> Result<Self, ToolError> {
        let read = |name: &str| {
            let path = root.join("safety-case/analysis").join(name);
            fs::read(&path).map_err(|error| ToolError::File { path, error })
        };
        Ok(Self {
            shipped: stepped(root)?,
            configuration: default_configuration()?,
            bench: tokens(root, &BENCH)?,
            faults: sha256(&[read(FILE)?, read("goals.toml")?].concat()),
        })
    }

    /// What has changed between these and others.
    #[must_use]
    pub fn differences(&self, other: &Self) -> Vec<&'static str> {
        let pairs = [
            ("the shipped sources", &self.shipped, &other.shipped),
            ("the default configuration", &self.configuration, &other.configuration),
            ("the bus on the desk, injector or judge", &self.bench, &other.bench),
            ("faults.toml or goals.toml", &self.faults, &other.faults),
        ];
        pairs.into_iter().filter(|(_, one, two)| one != two).map(|(what, ..)| what).collect()
    }
}

/// Reads a result.
///
/// # Errors
/// The file cannot be read or is none.
pub fn read(path: &Path) -> Result<Matrix, String> {
    let text = fs::read_to_string(path).map_err(|error| format!("{}: {error}", path.display()))?;
    Matrix::read(&text).map_err(|error| format!("{}: {error}", path.display()))
}
