//! What does not hold.

use std::collections::BTreeSet;
use std::fmt;

use serde::Serialize;

use super::allow::{self, Allowances};
use super::id::Id;
use super::scan::{Kind, Place, Scan};
use super::table::{HARNESSES, Proofs, Row, Status};
use crate::analysis::Analysis;

/// What kind of finding it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
pub enum Rule {
    /// A requirement that no code carries.
    NoCode,
    /// A requirement that no test, no check and no recorded proof carries.
    NoEvidence,
    /// An id that nothing defines.
    UnknownId,
    /// A range that rises not, or leaves its group.
    BrokenRange,
    /// A test, property, limit, check or harness that names a group where a demand is meant.
    Coarse,
    /// A test that belongs to no requirement, and is not listed as such.
    UntaggedTest,
    /// A listed harness that has no function.
    NoHarness,
    /// An allowance, or a reason to be without code, that nothing needs.
    Idle,
}

/// One finding.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
pub struct Finding {
    /// Where.
    #[serde(flatten)]
    pub place: Place,
    /// What kind.
    pub rule: Rule,
    /// What is wrong.
    pub message: String,
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Place { file, line, item } = &self.place;
        write!(f, "{file}:{line}: {item}: {} [{:?}]", self.message, self.rule)
    }
}

/// Everything that the sources may name.
struct Known {
    /// Demands and groups.
    requirements: BTreeSet<String>,
    /// Ids of the other entries of the analysis.
    others: BTreeSet<String>,
}

impl Known {
    fn of(analysis: &Analysis) -> Self {
        let groups =
            analysis.requirements.iter().filter_map(|entry| Id::parse(&entry.id)).map(|id| id.group().to_string());
        let requirements = analysis.requirements.iter().map(|entry| entry.id.clone()).chain(groups).collect();
        let others = analysis.all_ids().map(|(_, id)| id.to_owned()).collect();
        Self { requirements, others }
    }
}

/// Every finding, by place.
pub fn findings(analysis: &Analysis, scan: &Scan, allowed: &Allowances, proofs: &Proofs, rows: &[Row]) -> Vec<Finding> {
    let mut found = Vec::new();
    let mut add = |rule, place: &Place, message: String| found.push(Finding { place: place.clone(), rule, message });
    for row in rows {
        requirement(row, &mut add);
    }
    names(&Known::of(analysis), scan, allowed, proofs, &mut add);
    for (range, place) in &scan.broken {
        add(Rule::BrokenRange, place, format!("{range} is no range: it has to rise inside one group or area"));
    }
    for tag in scan.tags.iter().filter(|tag| tag.id.letter.is_none() && tag.kind != Kind::Code) {
        add(Rule::Coarse, &tag.place, coarse(&tag.id.to_string()));
    }
    tests(scan, allowed, &mut add);
    found.sort();
    found.dedup();
    found
}

fn coarse(id: &str) -> String {
    format!("{id} is a group; only code may name one, here the demand is meant")
}

fn requirement(row: &Row, add: &mut impl FnMut(Rule, &Place, String)) {
    if row.status != Status::Orphan {
        return idle(row, add);
    }
    let package = row.package;
    if !row.has_code() {
        let message = format!("no code carries it, by itself or by its group (package {package}): {}", row.text);
        add(Rule::NoCode, &row.place, message);
    }
    if !row.has_evidence() {
        let verdicts: Vec<_> =
            row.harnesses.iter().map(|entry| format!("{}: {}", entry.place.item, entry.verdict)).collect();
        let proofs = if verdicts.is_empty() { String::new() } else { format!(" ({})", verdicts.join("; ")) };
        let message = format!("no test, check or recorded proof carries it (package {package}){proofs}: {}", row.text);
        add(Rule::NoEvidence, &row.place, message);
    }
    idle(row, add);
}

fn idle(row: &Row, add: &mut impl FnMut(Rule, &Place, String)) {
    let named = row.code.iter().find(|carrier| !carrier.by_group);
    if let (Some(_), Some(carrier)) = (&row.without_code, named) {
        let Place { file, line, item } = &carrier.place;
        add(Rule::Idle, &row.place, format!("says why it is without code, and {item} ({file}:{line}) carries it"));
    }
}

/// Whatever is named exists.
fn names(
    known: &Known,
    scan: &Scan,
    allowed: &Allowances,
    proofs: &Proofs,
    add: &mut impl FnMut(Rule, &Place, String),
) {
    let exists = |id: &str| known.requirements.contains(id) || known.others.contains(id);
    let area = |id: &str| id.split('-').next().unwrap_or_default().to_owned();
    let mut used = BTreeSet::new();
    let tags = scan.tags.iter().map(|tag| (tag.id.to_string(), &tag.place));
    for (id, place) in scan.mentions.iter().map(|(id, place)| (id.clone(), place)).chain(tags) {
        if exists(&id) {
            continue;
        }
        match allowed.word.iter().find(|word| word.area == area(&id)) {
            Some(word) => {
                used.insert(&word.area);
            }
            None => add(Rule::UnknownId, place, format!("names {id}, which nothing defines")),
        }
    }
    let list = |item: &str| Place { file: allow::FILE.to_owned(), line: allowed.line(item), item: item.to_owned() };
    for word in allowed.word.iter().filter(|word| !used.contains(&word.area)) {
        add(Rule::Idle, &list(&word.area), format!("allowed ({}), and nothing needs it", word.reason));
    }
    for (harness, line, ..) in &proofs.listed {
        let place = Place { file: HARNESSES.to_owned(), line: *line, item: harness.name.clone() };
        if !scan.harnesses.iter().any(|function| function.item == harness.name) {
            add(Rule::NoHarness, &place, "is listed and has no function in proofs/src/harness".to_owned());
        }
        for id in &harness.requirements {
            if !known.requirements.contains(id) {
                add(Rule::UnknownId, &place, format!("names {id}, which nothing defines"));
            } else if Id::parse(id).is_some_and(|id| id.letter.is_none()) {
                add(Rule::Coarse, &place, coarse(id));
            }
        }
    }
}

fn tests(scan: &Scan, allowed: &Allowances, add: &mut impl FnMut(Rule, &Place, String)) {
    let mut used = Vec::new();
    for test in scan.tests.iter().filter(|test| test.needs_tag && !test.tagged) {
        let listed = |entry: &allow::Untagged| entry.file == test.place.file && entry.test == test.place.item;
        match allowed.untagged.iter().position(listed) {
            Some(index) => used.push(index),
            None => add(Rule::UntaggedTest, &test.place, "belongs to no requirement".to_owned()),
        }
    }
    for (_, entry) in allowed.untagged.iter().enumerate().filter(|(index, _)| !used.contains(index)) {
        let line = allowed.line(&entry.test);
        let place = Place { file: allow::FILE.to_owned(), line, item: entry.test.clone() };
        add(Rule::Idle, &place, format!("allowed ({}), and nothing needs it", entry.reason));
    }
}
