//! The committed result of a campaign, and whether it speaks of the present sources.

use std::fs;
use std::path::Path;

use supervisor::Sealed;

use super::tally::{Sources, Tally};
use crate::error::ToolError;
use crate::prove::{configuration_digest, stepped, tokens};

/// Where it stands.
pub const RECORD: &str = "safety-case/records/disturb.json";

/// Bus, driver, road, main controller and disturbance.
const BENCH: [&str; 1] = ["tests/src"];

impl Sources {
    /// Of the present sources, and this configuration.
    ///
    /// # Errors
    /// A file cannot be read or is no Rust.
    pub fn load(root: &Path, sealed: &Sealed) -> Result<Self, ToolError> {
        let configuration = configuration_digest(&sealed.to_bytes());
        Ok(Self { shipped: stepped(root)?, configuration, bench: tokens(root, &BENCH)? })
    }

    /// What has changed between these and others.
    #[must_use]
    pub fn differences(&self, other: &Self) -> Vec<&'static str> {
        let pairs = [
            ("the shipped sources", &self.shipped, &other.shipped),
            ("the configuration", &self.configuration, &other.configuration),
            ("the bus on the desk, its driver or the disturbance", &self.bench, &other.bench),
        ];
        pairs.into_iter().filter(|(_, one, two)| one != two).map(|(what, ..)| what).collect()
    }
}

/// Reads a result.
///
/// # Errors
/// The file cannot be read or is none.
pub fn read(path: &Path) -> Result<Tally, String> {
    let text = fs::read_to_string(path).map_err(|error| format!("{}: {error}", path.display()))?;
    Tally::read(&text).map_err(|error| format!("{}: {error}", path.display()))
}
