//! The mutants, and those whose survival is explained.

use std::path::Path;

use serde::Deserialize;

use super::record::Record;
use super::switch::Mutant;
use crate::error::ToolError;
use crate::mistakes::{Listed, listed};
use crate::prove::sha256;

/// The crates that are mutated: what decides first, then what sees, speaks and observes, and the vocabulary. (`report` only tells.)
pub const PACKAGES: [(&str, &str); 5] = [
    ("supervisor-core", "supervisor/core"),
    ("supervisor-perceive", "supervisor/perceive"),
    ("supervisor-wire", "supervisor/wire"),
    ("supervisor-observe", "supervisor/observe"),
    ("supervisor-terms", "supervisor/terms"),
];

/// Shows single parts to the proofs; no vehicle is built with it.
const NOT_SHIPPED: &str = "supervisor/wire/src/inspect.rs";

/// Where the explanations stand.
const EXPLAINED: &str = "safety-case/analysis/mutants.toml";

/// A mutant that may survive.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Explained {
    /// Its name, without the place in the file.
    pub name: String,
    /// Its file.
    pub file: String,
    /// How many mutants of this name there are that survive: no more are explained.
    #[serde(default = "one")]
    pub times: usize,
    /// Why no test can notice it.
    pub reason: String,
    /// A Kani harness `changes_nothing` that compares the function with the mutated one, which has `_mutated` behind its name.
    pub proof: Option<String>,
}

const fn one() -> usize {
    1
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Explanations {
    #[serde(default)]
    mutant: Vec<Explained>,
}

/// What does not hold of the explanations on this record, in words.
#[must_use]
pub fn findings(all: &[Explained], record: &Record) -> Vec<String> {
    let mut findings = Vec::new();
    for one in all {
        let (Explained { file, name, times, .. }, surviving) = (one, one.surviving(record));
        if surviving != *times {
            findings.push(format!("{times} explained, {surviving} survive: {file}: {name}"));
        }
    }
    for (name, proof) in record.equals() {
        let own = all.iter().filter(|one| one.speaks_of(name)).filter_map(|one| one.proof.as_ref());
        if !own.map(|text| sha256(text.as_bytes())).any(|digest| digest == proof) {
            findings.push(format!("proved to change nothing by a proof that has changed since: {name}"));
        }
    }
    findings
}

impl Explained {
    /// Every explanation; none without the file.
    ///
    /// # Errors
    /// The file cannot be read, or does not say what it should.
    pub fn all(root: &Path) -> Result<Vec<Self>, ToolError> {
        let path = root.join(EXPLAINED);
        let text = match std::fs::read_to_string(&path) {
            Ok(text) => text,
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(Vec::new()),
            Err(error) => return Err(ToolError::File { path, error }),
        };
        let read: Result<Explanations, _> = toml::from_str(&text);
        read.map(|read| read.mutant).map_err(|error| ToolError::Form { path, message: error.to_string() })
    }

    /// Which of them explains that the mutant with this name survives: one that explains just as many as survive.
    #[must_use]
    pub fn of<'a>(all: &'a [Self], name: &str, record: &Record) -> Option<&'a Self> {
        all.iter().find(|one| one.speaks_of(name) && one.surviving(record) == one.times)
    }

    /// How many of those that it speaks of no test notices.
    #[must_use]
    pub fn surviving(&self, record: &Record) -> usize {
        let equals = record.equals().map(|(name, _)| name);
        record.survivors().chain(equals).filter(|name| self.speaks_of(name)).count()
    }

    /// Whether it speaks of the mutant with this name.
    #[must_use]
    pub fn speaks_of(&self, name: &str) -> bool {
        name.starts_with(&format!("{}:", self.file)) && name.ends_with(&format!(": {}", self.name))
    }
}

/// Every mutant with its number, from 1, in the order of the packages.
///
/// # Errors
/// cargo-mutants does not run.
pub fn every(root: &Path) -> Result<Vec<(u32, Listed)>, ToolError> {
    let mut all = Vec::new();
    for (package, _) in PACKAGES {
        all.extend(listed(root, package)?.into_iter().filter(|mutant| mutant.file != NOT_SHIPPED));
    }
    Ok((1..).zip(all).collect())
}

/// A listed mutant as it is put into the text of its file; nothing where its kind or place is not known, or where the type of
/// what it returns is not that of the function's own (both are `impl Iterator`).
pub fn placed(number: u32, listed: &Listed, text: &str) -> Option<Mutant> {
    if listed.replacement().contains("::std::iter::") {
        return None;
    }
    Some(Mutant {
        number,
        genre: listed.genre()?,
        place: listed.place(text)?,
        replacement: listed.replacement().to_owned(),
    })
}

#[cfg(test)]
mod tests {
    use super::Explained;
    use crate::mutants::record::{Entry, Outcome, Record};

    #[test]
    fn an_explanation_does_not_depend_on_the_line() {
        let of = |file: &str, name: &str| Explained {
            name: name.into(),
            file: file.into(),
            times: 1,
            reason: "r".into(),
            proof: None,
        };
        let name = "supervisor/core/src/boot.rs:57:53: replace != with == in Boot::advance";
        assert!(of("supervisor/core/src/boot.rs", "replace != with == in Boot::advance").speaks_of(name));
        assert!(!of("supervisor/core/src/boot.rs", "with == in Boot::advance").speaks_of(name));
        assert!(!of("supervisor/core/src/boot", "replace != with == in Boot::advance").speaks_of(name));
    }

    #[test]
    fn it_explains_just_as_many_as_it_says() {
        let mut record = Record::default();
        let names = ["a.rs:1:1: replace < with <= in f", "a.rs:2:1: replace < with <= in f"];
        let all = |times| {
            vec![Explained {
                name: "replace < with <= in f".into(),
                file: "a.rs".into(),
                times,
                reason: "r".into(),
                proof: None,
            }]
        };
        for (survivors, name) in (1_usize..).zip(names) {
            record.put(Entry { name: name.to_owned(), outcome: Outcome::Survived });
            for times in 0..4 {
                assert_eq!(Explained::of(&all(times), names[0], &record).is_some(), times == survivors, "{times}");
            }
        }
    }
}
