//! Which versions of the tools are on this machine.

use std::process::{Command, Stdio};

use serde::Serialize;

use crate::analysis::Tool;

/// A tool and its version.
#[derive(Clone, Debug, Serialize)]
pub struct Version {
    /// The id of the tool.
    pub id: String,
    /// Its name.
    pub name: String,
    /// What it says of itself; none if it is not installed or no program.
    pub version: Option<String>,
}

/// Asks every tool.
#[must_use]
pub fn versions(tools: &[Tool]) -> Vec<Version> {
    tools
        .iter()
        .map(|tool| Version { id: tool.id.clone(), name: tool.name.clone(), version: asked(&tool.version) })
        .collect()
}

fn asked(command: &[String]) -> Option<String> {
    let (program, arguments) = command.split_first()?;
    let done = Command::new(program).args(arguments).stdin(Stdio::null()).output().ok()?;
    let said = String::from_utf8_lossy(&done.stdout);
    let first = said.lines().map(str::trim).find(|line| !line.is_empty())?.to_owned();
    done.status.success().then_some(first)
}
