//! `StrictDoc`: goals, requirements and assumptions as one `.sdoc` document, with parents and the files that carry them.

use std::fmt::Write;

use super::line;
use crate::analysis::Analysis;
use crate::trace::Trace;

/// The grammar: what fields a node may have, in their order.
const GRAMMAR: &str = "\
[GRAMMAR]
ELEMENTS:
- TAG: TEXT
  FIELDS:
  - TITLE: STATEMENT
    TYPE: String
    REQUIRED: True
- TAG: GOAL
  FIELDS:
  - TITLE: UID
    TYPE: String
    REQUIRED: True
  - TITLE: TITLE
    TYPE: String
    REQUIRED: True
  - TITLE: STATEMENT
    TYPE: String
    REQUIRED: True
  - TITLE: SAFE_STATE
    TYPE: String
    REQUIRED: True
  - TITLE: FTTI_MS
    TYPE: String
    REQUIRED: True
- TAG: REQUIREMENT
  FIELDS:
  - TITLE: UID
    TYPE: String
    REQUIRED: True
  - TITLE: STATUS
    TYPE: String
    REQUIRED: True
  - TITLE: TITLE
    TYPE: String
    REQUIRED: True
  - TITLE: STATEMENT
    TYPE: String
    REQUIRED: True
  - TITLE: SOURCE
    TYPE: String
    REQUIRED: True
  - TITLE: VERIFICATION
    TYPE: String
    REQUIRED: True
  - TITLE: CARRIED_BY
    TYPE: String
    REQUIRED: False
  RELATIONS:
  - TYPE: Parent
- TAG: ASSUMPTION
  FIELDS:
  - TITLE: UID
    TYPE: String
    REQUIRED: True
  - TITLE: TITLE
    TYPE: String
    REQUIRED: True
  - TITLE: STATEMENT
    TYPE: String
    REQUIRED: True
  - TITLE: VERIFICATION
    TYPE: String
    REQUIRED: True
  - TITLE: VIOLATED
    TYPE: String
    REQUIRED: True
";

/// The document.
#[must_use]
pub fn strictdoc(analysis: &Analysis, trace: &Trace) -> String {
    let mut text = format!("[DOCUMENT]\nTITLE: Safety supervisor, requirements\n\n{GRAMMAR}\n");
    section(&mut text, "Safety goals");
    for goal in &analysis.goals {
        node(
            &mut text,
            "GOAL",
            &[
                ("UID", &goal.id),
                ("TITLE", &goal.id),
                ("STATEMENT", &goal.text),
                ("SAFE_STATE", &goal.safe_state),
                ("FTTI_MS", &goal.ftti_ms.to_string()),
            ],
            &[],
        );
    }
    end(&mut text);
    section(&mut text, "Requirements");
    for requirement in &analysis.requirements {
        let methods: Vec<String> =
            requirement.method.iter().map(|method| format!("{method:?}").to_lowercase()).collect();
        let row = trace.rows.iter().find(|row| row.id == requirement.id);
        let carried = row.map(|row| {
            let code = row.code.iter().map(|carrier| &carrier.place);
            let harnesses = row.harnesses.iter().map(|harness| &harness.place);
            let all = code.chain(&row.limits).chain(&row.properties).chain(harnesses).chain(&row.tests);
            all.map(|place| format!("{} ({})", place.item, place.file)).collect::<Vec<_>>().join(", ")
        });
        let status = row.map_or("unknown", |row| match row.status {
            crate::trace::Status::Covered => "covered",
            crate::trace::Status::ByReview => "by review",
            crate::trace::Status::Orphan => "orphan",
            crate::trace::Status::Exempt => "later",
        });
        let methods = methods.join(", ");
        let carried = carried.unwrap_or_default();
        let mut fields: Vec<(&str, &str)> = vec![
            ("UID", &requirement.id),
            ("STATUS", status),
            ("TITLE", &requirement.id),
            ("STATEMENT", &requirement.text),
            ("SOURCE", &requirement.source),
            ("VERIFICATION", &methods),
        ];
        if !carried.is_empty() {
            fields.push(("CARRIED_BY", &carried));
        }
        node(&mut text, "REQUIREMENT", &fields, &requirement.goal);
    }
    end(&mut text);
    section(&mut text, "Assumptions of use");
    for assumption in &analysis.assumptions {
        let title = format!("{}: {}", assumption.id, assumption.topic);
        node(
            &mut text,
            "ASSUMPTION",
            &[
                ("UID", &assumption.id),
                ("TITLE", &title),
                ("STATEMENT", &assumption.text),
                ("VERIFICATION", &assumption.verify),
                ("VIOLATED", &assumption.violated),
            ],
            &[],
        );
    }
    end(&mut text);
    // One line break at the end.
    text.truncate(text.trim_end().len());
    text.push('\n');
    text
}

fn section(text: &mut String, title: &str) {
    // Writing to a string does not fail.
    let _ = writeln!(text, "[[SECTION]]\nTITLE: {title}\n");
}

fn end(text: &mut String) {
    text.push_str("[[/SECTION]]\n\n");
}

fn node(text: &mut String, tag: &str, fields: &[(&str, &str)], parents: &[String]) {
    let _ = writeln!(text, "[{tag}]");
    for (name, value) in fields {
        let _ = writeln!(text, "{name}: {}", line(value));
    }
    if !parents.is_empty() {
        text.push_str("RELATIONS:\n");
        for parent in parents {
            let _ = writeln!(text, "- TYPE: Parent\n  VALUE: {parent}");
        }
    }
    text.push('\n');
}
