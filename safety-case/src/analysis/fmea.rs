//! Failure modes of the supervisor's own parts: `fmea.toml`.

use serde::{Deserialize, Serialize};

use super::check::{Findings, Known, Rule};

/// The file.
pub(super) const FILE: &str = "fmea.toml";

/// One way in which parts fail, and what follows.
#[derive(Debug, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Failure {
    /// Id, `FM-nn`.
    pub id: String,
    /// The source files, or folders of them, that it speaks of, from the root of the project.
    pub parts: Vec<String>,
    /// What is wrong.
    pub mode: String,
    /// What it does to the bus.
    pub effect: String,
    /// The goals that it endangers.
    pub goals: Vec<String>,
    /// The requirements that stand against it.
    pub requirements: Vec<String>,
    /// What would notice it.
    pub detection: String,
    /// What shows that: a kind and a name, see [`Evidence`].
    pub evidence: Vec<Evidence>,
    /// The assumptions of use that carry what is left.
    #[serde(default)]
    pub assumptions: Vec<String>,
    /// What is left.
    pub residual: String,
}

/// A piece of evidence by name: "harness NAME", "mistake NAME", "fault FI-01", "test FILE", "record NAME", "step NAME".
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Deserialize, Serialize)]
#[serde(try_from = "String", into = "String")]
pub struct Evidence {
    /// What kind of evidence it is.
    pub kind: Kind,
    /// Its name among those.
    pub name: String,
}

/// Where a piece of evidence is listed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    /// `proofs/harnesses.toml`.
    Harness,
    /// `proofs/mistakes.toml`.
    Mistake,
    /// `faults.toml`.
    Fault,
    /// A file of tests.
    Test,
    /// A record of `supervise evidence`.
    Record,
    /// A step of `.ci/run`.
    Step,
}

impl Kind {
    /// Every kind, with its word.
    pub const ALL: [(Self, &'static str); 6] = [
        (Self::Harness, "harness"),
        (Self::Mistake, "mistake"),
        (Self::Fault, "fault"),
        (Self::Test, "test"),
        (Self::Record, "record"),
        (Self::Step, "step"),
    ];
}

impl TryFrom<String> for Evidence {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        let (word, name) = text.split_once(' ').unwrap_or((text.as_str(), ""));
        let kind = Kind::ALL.iter().find(|(_, known)| *known == word).map(|(kind, _)| *kind);
        match kind {
            Some(kind) if !name.trim().is_empty() => Ok(Self { kind, name: name.trim().to_owned() }),
            _ => {
                let words: Vec<&str> = Kind::ALL.iter().map(|(_, word)| *word).collect();
                Err(format!("\"{text}\" is no evidence: one of {} and a name", words.join(", ")))
            }
        }
    }
}

impl From<Evidence> for String {
    fn from(evidence: Evidence) -> Self {
        evidence.to_string()
    }
}

impl std::fmt::Display for Evidence {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let word = Kind::ALL.iter().find(|(kind, _)| *kind == self.kind).map_or("", |(_, word)| *word);
        write!(f, "{word} {}", self.name)
    }
}

pub(super) fn check(failures: &[Failure], known: &Known<'_>, findings: &mut Findings) {
    for failure in failures {
        let place = format!("{FILE}: {}", failure.id);
        findings.unknown(&place, &failure.goals, &known.goals);
        findings.unknown(&place, &failure.requirements, &known.requirements);
        findings.unknown(&place, &failure.assumptions, &known.assumptions);
        let faults = failure.evidence.iter().filter(|evidence| evidence.kind == Kind::Fault);
        findings.unknown(&place, faults.map(|evidence| &evidence.name), &known.faults);
        findings.blank(&place, "failure mode", &failure.mode);
        findings.blank(&place, "effect", &failure.effect);
        findings.blank(&place, "detection", &failure.detection);
        findings.blank(&place, "residual", &failure.residual);
        let lists = [
            ("part", failure.parts.is_empty()),
            ("goal", failure.goals.is_empty()),
            ("requirement", failure.requirements.is_empty()),
            ("evidence", failure.evidence.is_empty()),
        ];
        for (what, _) in lists.iter().filter(|(_, empty)| *empty) {
            findings.add(Rule::Incomplete, &place, format!("names no {what}"));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Evidence, Kind};

    #[test]
    fn evidence_is_a_kind_and_a_name() {
        let read = |text: &str| Evidence::try_from(text.to_owned());
        let step = Evidence { kind: Kind::Step, name: "safety analysis".to_owned() };
        assert_eq!(read("step safety analysis"), Ok(step.clone()));
        assert_eq!(String::from(step), "step safety analysis");
        for bad in ["", "step", "step ", "proof a", "harnesses a"] {
            assert!(read(bad).is_err(), "{bad}");
        }
    }
}
