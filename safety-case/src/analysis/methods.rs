//! The method tables of ISO 26262-6 and how each row is answered: `methods.toml`.

use serde::{Deserialize, Serialize};

use super::check::{Findings, Rule};

/// The file.
pub(super) const FILE: &str = "methods.toml";

/// A table.
#[derive(Debug, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct MethodTable {
    /// Id, `MT-nn`.
    pub id: String,
    /// What it is about, in our words.
    pub title: String,
    /// Which table of the standard.
    pub source: String,
    /// Its methods.
    pub row: Vec<MethodRow>,
}

/// A method.
#[derive(Debug, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct MethodRow {
    /// Id, `MT-nnx`.
    pub id: String,
    /// The method, in our words.
    pub method: String,
    /// How much it is recommended.
    pub degree: Degree,
    /// Whether it is used.
    pub answer: Answer,
    /// Where that is seen, or why not.
    pub place: String,
}

/// How much a method is recommended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize)]
pub enum Degree {
    /// Highly.
    #[serde(rename = "++")]
    Highly,
    /// Recommended.
    #[serde(rename = "+")]
    Recommended,
    /// Neither recommended nor advised against.
    #[serde(rename = "o")]
    Neither,
}

/// Whether a method is used.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Deserialize, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Answer {
    /// It is.
    Yes,
    /// Of a part, or in a part.
    Partly,
    /// It is not.
    No,
    /// Only the integrator can.
    Integrator,
}

pub(super) fn check(tables: &[MethodTable], findings: &mut Findings) {
    for table in tables {
        let place = format!("{FILE}: {}", table.id);
        findings.blank(&place, "title", &table.title);
        findings.blank(&place, "source", &table.source);
        if table.row.is_empty() {
            findings.add(Rule::Incomplete, &place, "has no row");
        }
        for row in &table.row {
            let place = format!("{FILE}: {}", row.id);
            findings.blank(&place, "method", &row.method);
            findings.blank(&place, "place", &row.place);
        }
    }
}
