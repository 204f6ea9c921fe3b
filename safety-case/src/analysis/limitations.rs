//! What does not hold, was not done or is odd, and the risks that are left: `limitations.toml`.

use std::collections::BTreeSet;

use serde::{Deserialize, Serialize};

use super::check::{Findings, Known, Rule};
use super::model::{Reading, Status};

/// The file.
pub(super) const FILE: &str = "limitations.toml";

/// A known limitation or anomaly.
#[derive(Debug, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Limitation {
    /// Id, `LIM-nn`.
    pub id: String,
    /// What kind it is.
    pub kind: LimitationKind,
    /// What it is.
    pub text: String,
    /// The file that holds the details, from the root of the project.
    #[serde(rename = "where")]
    pub place: String,
    /// What follows from it.
    pub effect: String,
    /// What would end it.
    pub cure: String,
    /// The proposed readings that it is about.
    #[serde(default)]
    pub readings: Vec<String>,
}

/// What kind of limitation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Deserialize, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum LimitationKind {
    /// A figure of the design that is not met.
    Bar,
    /// Something that was not done.
    NotRun,
    /// Tested or read where a proof was wished for.
    NotProved,
    /// Odd and known.
    Anomaly,
    /// Decisions of ours on unclear sources.
    Reading,
    /// What no evidence here can show.
    Scope,
}

impl LimitationKind {
    /// In words.
    #[must_use]
    pub const fn word(self) -> &'static str {
        match self {
            Self::Bar => "bar not met",
            Self::NotRun => "not run",
            Self::NotProved => "not proved",
            Self::Anomaly => "anomaly",
            Self::Reading => "reading of ours",
            Self::Scope => "out of scope",
        }
    }
}

/// A risk that is left on purpose.
#[derive(Debug, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Risk {
    /// Id, `RR-nn`.
    pub id: String,
    /// What may happen.
    pub text: String,
    /// The goals that it touches.
    pub goals: Vec<String>,
    /// The assumptions of use that carry it.
    pub assumptions: Vec<String>,
    /// The injected faults that show it.
    #[serde(default)]
    pub faults: Vec<String>,
    /// Why it is left.
    pub why: String,
}

/// The file.
#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct LimitationFile {
    #[serde(default)]
    pub limitation: Vec<Limitation>,
    #[serde(default)]
    pub risk: Vec<Risk>,
}

pub(super) fn check(
    limitations: &[Limitation],
    risks: &[Risk],
    readings: &[Reading],
    known: &Known<'_>,
    findings: &mut Findings,
) {
    for limitation in limitations {
        let place = format!("{FILE}: {}", limitation.id);
        findings.unknown(&place, &limitation.readings, &known.readings);
        findings.blank(&place, "text", &limitation.text);
        findings.blank(&place, "file", &limitation.place);
        findings.blank(&place, "effect", &limitation.effect);
        findings.blank(&place, "cure", &limitation.cure);
    }
    // A folder without the file lists nothing; one that has it lists every reading that nobody has confirmed.
    let listed: BTreeSet<&str> =
        limitations.iter().flat_map(|limitation| &limitation.readings).map(String::as_str).collect();
    let proposed: BTreeSet<&str> = readings
        .iter()
        .filter(|reading| reading.status == Status::Proposed)
        .map(|reading| reading.id.as_str())
        .collect();
    if !limitations.is_empty() {
        for reading in proposed.symmetric_difference(&listed) {
            let what =
                if listed.contains(reading) { "is listed, and is not proposed" } else { "is proposed, and not listed" };
            findings.add(Rule::Unlisted, &format!("{FILE}: {reading}"), what);
        }
    }
    for risk in risks {
        let place = format!("{FILE}: {}", risk.id);
        findings.unknown(&place, &risk.goals, &known.goals);
        findings.unknown(&place, &risk.assumptions, &known.assumptions);
        findings.unknown(&place, &risk.faults, &known.faults);
        findings.blank(&place, "text", &risk.text);
        findings.blank(&place, "reason", &risk.why);
        if risk.goals.is_empty() || risk.assumptions.is_empty() {
            findings.add(Rule::Incomplete, &place, "touches no goal, or no assumption carries it");
        }
    }
}
