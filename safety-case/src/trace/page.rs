//! The table as a page that works offline.

use serde_json::{Value, json};

use super::scan::Place;
use super::table::{Row, Status, Summary};
use super::{Trace, text};
use crate::template::render;

const PAGE: &str = include_str!("../../templates/trace.html");
const SCRIPT: &str = include_str!("../../templates/trace.js");

/// The page as one HTML file.
///
/// # Errors
/// If the template does not render.
pub fn page(trace: &Trace) -> Result<String, minijinja::Error> {
    let summary = Summary::of(&trace.rows);
    let orphans = if summary.orphans == 0 { "good" } else { "alarm" };
    let findings = if trace.findings.is_empty() { "good" } else { "alarm" };
    let cards = json!([
        {"label": "requirements", "value": summary.requirements},
        {"label": "covered", "value": summary.covered},
        {"label": "by analysis or review alone", "value": summary.by_review},
        {"label": "orphans", "value": summary.orphans, "class": orphans},
        {"label": "tested", "value": summary.tested},
        {"label": "with a recorded proof", "value": summary.proved},
        {"label": "proof planned, not proved", "value": summary.planned_not_proved, "class": "caution"},
        {"label": "findings", "value": trace.findings.len(), "class": findings},
    ]);
    let context = json!({
        "cards": cards,
        "rows": trace.rows.iter().map(row).collect::<Vec<_>>(),
        "findings": trace.findings,
        "script": SCRIPT,
    });
    render(PAGE, context)
}

fn row(row: &Row) -> Value {
    let class = match row.status {
        Status::Covered => "",
        Status::ByReview | Status::Exempt => "review",
        Status::Orphan => "orphan",
    };
    let places = |places: &[Place]| places.iter().map(|place| entry(place, "", "")).collect::<Vec<_>>();
    let code = row.code.iter().map(|carrier| {
        let note = if carrier.by_group { "by its group" } else { "" };
        entry(&carrier.place, note, if carrier.by_group { "group" } else { "" })
    });
    let proofs = row.properties.iter().map(|place| entry(place, "property", ""));
    let harnesses = row
        .harnesses
        .iter()
        .map(|harness| entry(&harness.place, &harness.verdict, if harness.proved { "proved" } else { "open" }));
    let mut tests = places(&row.tests);
    tests.extend(row.checks.iter().map(|place| entry(place, "step of .ci/run", "")));
    json!({
        "id": row.id, "text": row.text, "source": row.source, "package": row.package, "place": row.place,
        "class": class, "status": text::status(row), "code": code.collect::<Vec<_>>(),
        "without_code": row.without_code, "limits": places(&row.limits),
        "proofs": harnesses.chain(proofs).collect::<Vec<_>>(), "tests": tests, "awaits_proof": row.awaits_proof(),
    })
}

fn entry(place: &Place, note: &str, class: &str) -> Value {
    json!({"file": place.file, "line": place.line, "item": place.item, "note": note, "class": class})
}
