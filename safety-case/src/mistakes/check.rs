//! Whether the record shows what it must, on the present sources.

use std::collections::BTreeSet;
use std::path::Path;

use super::list::{List, Mistake};
use super::record::{Entry, Outcome, Record};
use crate::error::ToolError;
use crate::prove::Sources;

/// What the record does not show.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Finding {
    /// A named mistake that was never run.
    NotRun(String),
    /// So many named ones ran on other sources, or were other mistakes then.
    Stale(usize),
    /// A named mistake that no check catches: what became of it.
    NotCaught(String, Outcome),
    /// It was caught by this harness, which is no longer the one that must catch it.
    ByAnother(String, String),
    /// It was caught by this harness, which is not proved without it: a proof that always fails catches everything.
    ByUnproved(String, String),
    /// Of the drawn ones, so many ran on the present sources, of so many.
    Drawn(usize, usize),
    /// A drawn mistake that survives without an explanation.
    Unexplained(String),
    /// An explanation of what does not survive.
    Idle(String),
}

impl std::fmt::Display for Finding {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::NotRun(name) => write!(f, "NOT RUN: {name}"),
            Self::Stale(count) => write!(f, "STALE: {count} named mistakes ran on other sources"),
            Self::NotCaught(name, outcome) => write!(f, "NOT CAUGHT: {name} ({})", word(outcome)),
            Self::ByAnother(name, harness) => write!(f, "{name} was caught by {harness}, which is not in its list"),
            Self::ByUnproved(name, harness) => {
                write!(f, "{name} was caught by {harness}, which is not proved without it")
            }
            Self::Drawn(run, count) => write!(f, "{run} of {count} drawn mistakes ran on these sources"),
            Self::Unexplained(name) => write!(f, "SURVIVED, not explained: {name}"),
            Self::Idle(name) => write!(f, "explained, and does not survive: {name}"),
        }
    }
}

/// In a word.
pub(super) const fn word(outcome: &Outcome) -> &'static str {
    match outcome {
        Outcome::Caught { .. } => "caught",
        Outcome::Survived => "survived",
        Outcome::Undecided => "not decided in time",
        Outcome::DoesNotCompile { .. } => "does not compile",
    }
}

/// Compares list and record with the sources at `root`, of which the harnesses `proved` are.
///
/// # Errors
/// A mistake does not fit its file.
pub fn check(
    list: &List,
    record: &Record,
    root: &Path,
    sources: &Sources,
    proved: &BTreeSet<String>,
) -> Result<Vec<Finding>, ToolError> {
    let changed = |mistake: &Mistake| mistake.change(root).map(|change| change.digest());
    let (mut findings, mut stale) = (Vec::new(), 0_usize);
    for mistake in list.mistake.iter().filter(|mistake| mistake.survives.is_none()) {
        let name = mistake.name.clone();
        match record.named.iter().find(|entry| entry.name == name) {
            None => findings.push(Finding::NotRun(name)),
            Some(entry) if !entry.is_current(sources) || entry.change != changed(mistake)? => {
                stale = stale.saturating_add(1);
            }
            Some(entry) => findings.extend(of(mistake, entry, proved)),
        }
    }
    if stale > 0 {
        findings.push(Finding::Stale(stale));
    }
    findings.extend(drawn(list, record, sources, proved));
    Ok(findings)
}

fn of(mistake: &Mistake, entry: &Entry, proved: &BTreeSet<String>) -> Option<Finding> {
    let name = mistake.name.clone();
    match &entry.outcome {
        Outcome::Caught { harness, .. } if !mistake.harness.contains(harness) => {
            Some(Finding::ByAnother(name, harness.clone()))
        }
        Outcome::Caught { harness, .. } => {
            (!proved.contains(harness)).then(|| Finding::ByUnproved(name, harness.clone()))
        }
        outcome @ (Outcome::Survived | Outcome::Undecided | Outcome::DoesNotCompile { .. }) => {
            Some(Finding::NotCaught(name, outcome.clone()))
        }
    }
}

fn drawn(list: &List, record: &Record, sources: &Sources, proved: &BTreeSet<String>) -> Vec<Finding> {
    let is_current = |entry: &&Entry| entry.is_current(sources) && record.drawn.seed == list.drawn.seed;
    let run: Vec<&Entry> = record.drawn.mistakes.iter().filter(is_current).collect();
    let survives = |name: &str| run.iter().any(|entry| entry.name == name && !entry.outcome.is_caught());
    let real = run.iter().filter(|entry| entry.outcome.is_mistake());
    let mut findings = Vec::new();
    let count = real.clone().count();
    if count < list.drawn.count {
        findings.push(Finding::Drawn(count, list.drawn.count));
    }
    findings.extend(real.clone().filter_map(|entry| match &entry.outcome {
        Outcome::Caught { harness, .. } if !proved.contains(harness) => {
            Some(Finding::ByUnproved(entry.name.clone(), harness.clone()))
        }
        Outcome::Caught { .. } | Outcome::Survived | Outcome::Undecided | Outcome::DoesNotCompile { .. } => None,
    }));
    let explained = |name: &str| list.explained.iter().any(|explained| explained.mutation == name);
    let open = real.filter(|entry| !entry.outcome.is_caught() && !explained(&entry.name));
    findings.extend(open.map(|entry| Finding::Unexplained(entry.name.clone())));
    if count >= list.drawn.count {
        let idle = list.explained.iter().filter(|explained| !survives(&explained.mutation));
        findings.extend(idle.map(|explained| Finding::Idle(explained.mutation.clone())));
    }
    findings
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::{BTreeSet, Finding, Sources, check};
    use crate::mistakes::{Drawn, Entry, Explained, List, Mistake, Outcome, Record};

    const FILE: &str = "supervisor/core/src/seat.rs";

    fn root() -> &'static Path {
        Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap_or(Path::new("."))
    }

    fn mistake() -> Mistake {
        let text = str::to_owned;
        Mistake {
            name: text("m"),
            what: text("x"),
            file: text(FILE),
            find: String::new(),
            replace: String::new(),
            harness: vec![text("h")],
            assertion: None,
            requirements: Vec::new(),
            survives: None,
        }
    }

    fn list() -> List {
        // Any text that stands there once.
        let find = "impl SeatState {".to_owned();
        let mistake = Mistake { replace: find.clone() + "\n    const A: u8 = 0;", find, ..mistake() };
        let drawn = Drawn { seed: 7, count: 1, package: "p".to_owned(), within: 1 };
        List { drawn, module: Vec::new(), explained: Vec::new(), mistake: vec![mistake] }
    }

    fn caught(harness: &str) -> Outcome {
        Outcome::Caught { harness: harness.to_owned(), check: "c".to_owned() }
    }

    fn entry(list: &List, outcome: Outcome) -> Entry {
        let change = list.mistake.first().and_then(|mistake| mistake.change(root()).ok());
        let change = change.map(|change| change.digest()).unwrap_or_default();
        Entry { name: "m".to_owned(), change, outcome, tried: Vec::new(), seconds: 1, sources: "now".to_owned() }
    }

    fn findings(list: &List, record: &Record, sources: &str) -> Vec<Finding> {
        let proved = ["h", "another", "any"].map(str::to_owned).into();
        check(list, record, root(), &Sources::same(sources), &proved).unwrap_or_else(|error| unreachable!("{error}"))
    }

    fn record(list: &List, named: Outcome, drawn: Outcome) -> Record {
        let mut record = Record { named: vec![entry(list, named)], ..Record::default() };
        record.drawn.seed = 7;
        record.drawn.mistakes = vec![entry(list, drawn)];
        record
    }

    #[test]
    fn a_full_record_has_no_finding_and_any_gap_has_one() {
        let list = list();
        let full = record(&list, caught("h"), caught("any"));
        assert_eq!(findings(&list, &full, "now"), []);
        assert_eq!(findings(&list, &full, "later"), [Finding::Stale(1), Finding::Drawn(0, 1)]);
        let none = [Finding::NotRun("m".to_owned()), Finding::Drawn(0, 1)];
        assert_eq!(findings(&list, &Record::default(), "now"), none);
        let other = record(&list, caught("another"), caught("any"));
        assert_eq!(findings(&list, &other, "now"), [Finding::ByAnother("m".to_owned(), "another".to_owned())]);
    }

    #[test]
    fn what_survives_or_is_not_decided_is_not_caught() {
        let list = list();
        for outcome in [Outcome::Survived, Outcome::Undecided] {
            let found = findings(&list, &record(&list, outcome.clone(), caught("h")), "now");
            assert_eq!(found, [Finding::NotCaught("m".to_owned(), outcome)]);
        }
    }

    #[test]
    fn a_mistake_that_has_changed_is_stale() {
        let mut list = list();
        let full = record(&list, caught("h"), caught("h"));
        if let Some(mistake) = list.mistake.first_mut() {
            mistake.replace.push_str("\n    const B: u8 = 0;");
        }
        assert_eq!(findings(&list, &full, "now"), [Finding::Stale(1)]);
    }

    #[test]
    fn a_catch_by_what_is_not_proved_is_none() {
        let list = list();
        let full = record(&list, caught("h"), caught("h"));
        let found = check(&list, &full, root(), &Sources::same("now"), &BTreeSet::new())
            .unwrap_or_else(|error| unreachable!("{error}"));
        let by = |name: &str| Finding::ByUnproved(name.to_owned(), "h".to_owned());
        assert_eq!(found, [by("m"), by("m")]);
    }

    #[test]
    fn a_drawn_survivor_needs_an_explanation_that_is_needed() {
        let mut list = list();
        let survived = record(&list, caught("h"), Outcome::Survived);
        assert_eq!(findings(&list, &survived, "now"), [Finding::Unexplained("m".to_owned())]);
        list.explained = vec![Explained { mutation: "m".to_owned(), why: "equal".to_owned() }];
        assert_eq!(findings(&list, &survived, "now"), []);
        let idle = record(&list, caught("h"), caught("h"));
        assert_eq!(findings(&list, &idle, "now"), [Finding::Idle("m".to_owned())]);
    }
}
