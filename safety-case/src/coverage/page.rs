//! The sources as a page that works offline, with what is open in them.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use serde_json::{Value, json};

use super::figures::{Count, Figures, Open};
use super::open::Accepted;
use super::record::Record;
use super::run::Measured;
use crate::template::render;

const PAGE: &str = include_str!("../../templates/coverage.html");

/// The page as one HTML file.
///
/// # Errors
/// If the template does not render.
pub fn page(
    root: &Path,
    record: &Record,
    measured: &Measured,
    accepted: &[Accepted],
) -> Result<String, minijinja::Error> {
    let sum = &record.sum;
    let card = |label: &str, count: Count| json!({"label": label, "value": count.to_string(), "class": if count.covered == count.of { "good" } else { "caution" }});
    let unlisted = record.open.iter().filter(|open| reason(open, accepted).is_none()).count();
    let cards = json!([
        card("statements", sum.statements),
        card("branches", sum.branches),
        card("decisions both ways", sum.decisions),
        card("conditions, MC/DC by masking", sum.conditions),
        card("the same by unique cause", sum.unique),
        {"label": "open, listed with a reason", "value": record.open.len().saturating_sub(unlisted)},
        {"label": "open", "value": unlisted, "class": if unlisted == 0 { "good" } else { "alarm" }},
    ]);
    let files: Vec<Value> =
        record.files.iter().map(|(name, figures)| file(root, name, figures, record, measured, accepted)).collect();
    let programs: usize = record.ran.values().map(Vec::len).sum();
    let context = json!({
        "cards": cards, "files": files, "programs": programs,
    });
    render(PAGE, context)
}

fn file(
    root: &Path,
    name: &str,
    figures: &Figures,
    record: &Record,
    measured: &Measured,
    accepted: &[Accepted],
) -> Value {
    let mut open: BTreeMap<usize, Vec<&Open>> = BTreeMap::new();
    for one in record.open.iter().filter(|open| open.file == name) {
        open.entry(one.line).or_default().push(one);
    }
    let points = measured.plan.points.iter().filter(|point| point.place.file == name);
    let reached: Vec<usize> = points.map(|point| point.place.line).collect();
    let text = fs::read_to_string(root.join(name)).unwrap_or_default();
    let lines = text.lines().enumerate().map(|(before, text)| {
        let number = before.saturating_add(1);
        let here = open.get(&number).map(Vec::as_slice).unwrap_or_default();
        let class = if here.iter().any(|open| reason(open, accepted).is_none()) {
            "open"
        } else if !here.is_empty() {
            "listed"
        } else if reached.contains(&number) {
            "ran"
        } else {
            ""
        };
        let notes: Vec<String> = here.iter().map(|open| note(open, accepted)).collect();
        json!({"number": number, "text": text, "class": class, "notes": notes})
    });
    let counts = [figures.statements, figures.branches, figures.decisions, figures.conditions, figures.unique]
        .map(|count| count.to_string());
    let open = open.values().map(Vec::len).sum::<usize>();
    json!({"name": name, "counts": counts, "open": open, "lines": lines.collect::<Vec<_>>()})
}

fn reason<'a>(open: &Open, accepted: &'a [Accepted]) -> Option<&'a str> {
    accepted.iter().find(|entry| entry.is_of(open)).map(|entry| entry.reason.as_str())
}

fn note(open: &Open, accepted: &[Accepted]) -> String {
    let seen = if open.seen.is_empty() { String::new() } else { format!("; seen {}", open.seen.join(", ")) };
    let reason = reason(open, accepted).map_or(String::new(), |reason| format!(": {reason}"));
    format!("{} {}{seen}{reason}", open.kind.word(), open.text)
}
