//! sphinx-needs: goals, requirements, assumptions and tests as `needs.json`.

use std::collections::{BTreeMap, BTreeSet};

use serde_json::{Map, Value, json};

use super::line;
use crate::analysis::Analysis;
use crate::trace::{Kind, Trace};

/// The document; `version` is that of the project.
#[must_use]
pub fn needs(analysis: &Analysis, trace: &Trace, version: &str) -> Value {
    let mut needs = Map::new();
    let mut add = |id: String, kind: &str, title: &str, content: &str, more: &[(&str, Value)]| {
        let mut need = json!({
            "id": id, "type": kind, "title": line(title), "content": content, "status": "open",
            "tags": [], "links": [],
        });
        if let Some(fields) = need.as_object_mut() {
            fields.extend(more.iter().map(|(name, value)| ((*name).to_owned(), value.clone())));
        }
        needs.insert(id, need);
    };
    for goal in &analysis.goals {
        let more = [("safe_state", json!(goal.safe_state)), ("ftti_ms", json!(goal.ftti_ms.to_string()))];
        add(goal.id.clone(), "goal", &goal.id, &goal.text, &more);
    }
    for requirement in &analysis.requirements {
        let row = trace.rows.iter().find(|row| row.id == requirement.id);
        let methods: Vec<String> =
            requirement.method.iter().map(|method| format!("{method:?}").to_lowercase()).collect();
        let status = row.map_or(json!("unknown"), |row| json!(row.status));
        let code =
            row.map(|row| row.code.iter().map(|carrier| format!("{}:{}", carrier.place.file, carrier.place.line)));
        let code: Vec<String> = code.into_iter().flatten().collect();
        let more = [
            ("links", json!(requirement.goal)),
            ("status", status),
            ("source", json!(requirement.source)),
            ("verification", json!(methods.join(", "))),
            ("implemented_in", json!(code.join(", "))),
        ];
        add(requirement.id.clone(), "req", &requirement.id, &requirement.text, &more);
    }
    for assumption in &analysis.assumptions {
        let more = [
            ("links", json!(assumption.requirements)),
            ("verification", json!(assumption.verify)),
            ("violated", json!(assumption.violated)),
        ];
        let title = format!("{}: {}", assumption.id, assumption.topic);
        add(assumption.id.clone(), "assumption", &title, &assumption.text, &more);
    }
    // A test and all that it verifies.
    let mut tests: BTreeMap<(&str, &str), BTreeSet<String>> = BTreeMap::new();
    for tag in trace.scan.tags.iter().filter(|tag| tag.kind == Kind::Test) {
        tests.entry((&tag.place.file, &tag.place.item)).or_default().insert(tag.id.to_string());
    }
    for ((file, item), verifies) in tests {
        let id = format!("T-{}-{item}", file.replace(['/', '.'], "_"));
        add(id, "test", item, file, &[("links", json!(verifies)), ("source", json!(file))]);
    }
    let count = needs.len();
    json!({
        "project": "Safety supervisor",
        "current_version": version,
        "versions": { version: { "needs": needs, "needs_amount": count, "filters": {}, "filters_amount": 0 } },
    })
}
