//! The tools that evidence rests on, and the confidence in them: `tools.toml`.

use serde::{Deserialize, Serialize};

use super::check::{Findings, Rule};

/// The file.
pub(super) const FILE: &str = "tools.toml";

/// A tool.
#[derive(Debug, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Tool {
    /// Id, `TL-nn`.
    pub id: String,
    /// Its name.
    pub name: String,
    /// What it is used for.
    #[serde(rename = "use")]
    pub used: String,
    /// What says its version, where it is installed.
    #[serde(default)]
    pub version: Vec<String>,
    /// Tool impact, 1 or 2.
    pub ti: u8,
    /// Why.
    pub ti_reason: String,
    /// Tool error detection, 1 to 3.
    pub td: u8,
    /// Why.
    pub td_reason: String,
    /// Confidence level that is asked for, 1 to 3; it follows from the two.
    pub tcl: u8,
    /// How it can fail.
    pub failure: Vec<ToolFailure>,
}

/// A failure of a tool.
#[derive(Debug, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct ToolFailure {
    /// What goes wrong.
    pub mode: String,
    /// What stands against it.
    pub mitigation: String,
}

impl Tool {
    /// The level that follows from impact and detection by the table of ISO 26262-8; `None` outside of their scales.
    #[must_use]
    pub const fn level(ti: u8, td: u8) -> Option<u8> {
        match (ti, td) {
            (1, 1..=3) | (2, 1) => Some(1),
            (2, 2) => Some(2),
            (2, 3) => Some(3),
            _ => None,
        }
    }
}

pub(super) fn check(tools: &[Tool], findings: &mut Findings) {
    for tool in tools {
        let place = format!("{FILE}: {}", tool.id);
        findings.blank(&place, "name", &tool.name);
        findings.blank(&place, "use", &tool.used);
        findings.blank(&place, "reason for TI", &tool.ti_reason);
        findings.blank(&place, "reason for TD", &tool.td_reason);
        if Tool::level(tool.ti, tool.td) != Some(tool.tcl) {
            let Tool { ti, td, tcl, .. } = tool;
            findings.add(Rule::ToolLevel, &place, format!("TCL{tcl} does not follow from TI{ti} and TD{td}"));
        }
        if tool.failure.is_empty() {
            findings.add(Rule::Incomplete, &place, "has no way to fail");
        }
        for failure in &tool.failure {
            findings.blank(&place, "failure mode", &failure.mode);
            findings.blank(&place, "mitigation", &failure.mitigation);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Tool;

    #[test]
    fn the_level_follows_the_published_table() {
        let level = |ti| [1, 2, 3].map(|td| Tool::level(ti, td));
        assert_eq!(level(1), [Some(1), Some(1), Some(1)]);
        assert_eq!(level(2), [Some(1), Some(2), Some(3)]);
        assert_eq!([Tool::level(0, 1), Tool::level(3, 1), Tool::level(2, 0), Tool::level(2, 4)], [None; 4]);
    }
}
