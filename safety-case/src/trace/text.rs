//! The table as text.

use std::fmt::Write;

use super::Trace;
use super::scan::Place;
use super::table::{Row, Status, Summary};

/// The figures, a line each.
#[must_use]
pub fn summary(trace: &Trace) -> String {
    let Summary { requirements, covered, by_review, orphans, exempt, .. } = Summary::of(&trace.rows);
    let Summary { code_by_demand, code_by_group, without_code, tested, proved, planned_not_proved, .. } =
        Summary::of(&trace.rows);
    let (files, tags, tests) = (trace.scan.files, trace.scan.tags.len(), trace.scan.tests.len());
    let tagged = trace.scan.tests.iter().filter(|test| test.tagged).count();
    let mut text = String::new();
    for (what, figures) in [
        (
            "requirements",
            format!(
                "{requirements}: {covered} covered, {by_review} by analysis or review alone, {orphans} orphans, {exempt} of a later package"
            ),
        ),
        (
            "code",
            format!(
                "{code_by_demand} by their own id, {code_by_group} by the id of their group, {without_code} need none"
            ),
        ),
        (
            "evidence",
            format!("{tested} tested, {proved} with a recorded proof; {planned_not_proved} proofs planned, not proved"),
        ),
        ("sources", format!("{files} files, {tags} tags, {tagged} of {tests} tests tagged")),
        ("findings", trace.findings.len().to_string()),
    ] {
        // Writing to a string does not fail.
        let _ = writeln!(text, "{what:<13} {figures}");
    }
    text
}

/// The rows of a demand or of a group, in full; none if there is no such id.
#[must_use]
pub fn rows(trace: &Trace, id: &str) -> String {
    let of_group = |row: &Row| row.id == id || row.id.trim_end_matches(|last: char| last.is_ascii_lowercase()) == id;
    trace.rows.iter().filter(|row| of_group(row)).map(row).collect()
}

fn row(row: &Row) -> String {
    let mut text = format!("{} ({}, package {}, {}): {}\n", row.id, row.source, row.package, status(row), row.text);
    let mut line = |what: &str, place: &Place, note: &str| {
        let Place { file, line, item } = place;
        let _ = writeln!(text, "  {what:<9} {file}:{line}: {item}{note}");
    };
    line("defined", &row.place, "");
    for carrier in &row.code {
        line("code", &carrier.place, if carrier.by_group { " (by its group)" } else { "" });
    }
    for place in &row.limits {
        line("limit", place, "");
    }
    for place in &row.properties {
        line("property", place, "");
    }
    for harness in &row.harnesses {
        line("harness", &harness.place, &format!(": {}", harness.verdict));
    }
    for place in &row.tests {
        line("test", place, "");
    }
    for place in &row.checks {
        line("check", place, "");
    }
    if let Some(reason) = &row.without_code {
        let _ = writeln!(text, "  no code   {reason}");
    }
    if row.awaits_proof() {
        text.push_str("  a proof is planned, not proved\n");
    }
    text
}

/// The status of a row in words.
pub fn status(row: &Row) -> &'static str {
    match (row.status, row.has_code(), row.has_evidence()) {
        (Status::Covered, ..) => "covered",
        (Status::ByReview, ..) => "by analysis or review",
        (Status::Exempt, ..) => "of a later package",
        (Status::Orphan, false, false) => "no code, no evidence",
        (Status::Orphan, false, true) => "no code",
        (Status::Orphan, true, _) => "no evidence",
    }
}
