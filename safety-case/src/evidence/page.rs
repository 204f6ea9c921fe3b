//! The page: open items first.

use std::collections::{BTreeMap, BTreeSet};

use serde_json::{Value, json};

use super::Collected;
use super::open::Why;
use super::records::State;
use super::tones::tone;
use crate::analysis::{Answer, Degree, Evidence, Phase};
use crate::argument::{Element, Sheet};
use crate::template::render;
use crate::trace::{Kind, Summary};

const PAGE: &str = include_str!("../../templates/evidence.html");

/// The page as one HTML file.
///
/// # Errors
/// The template does not render.
pub fn page(
    collected: &Collected,
    sheets: &[Sheet],
    tones: &BTreeMap<String, &'static str>,
) -> Result<String, minijinja::Error> {
    let Collected { analysis, argument, inventory, .. } = collected;
    let modules: Vec<Value> = (argument.modules.iter())
        .map(|module| {
            let sheets: Vec<&str> =
                sheets.iter().filter(|sheet| sheet.module == module.name).map(|sheet| sheet.svg.as_str()).collect();
            json!({"name": module.name, "brief": module.brief, "file": module.file, "sheets": sheets})
        })
        .collect();
    let licenses: Vec<Value> = (inventory.licenses().into_iter())
        .map(|(license, packages)| {
            let names: Vec<String> = packages.iter().map(|package| package.id()).collect();
            let shipped: Vec<String> = packages.iter().filter(|package| package.shipped).map(|package| package.id()).collect();
            json!({"license": license, "count": names.len(), "packages": names.join(", "), "shipped": shipped.join(", ")})
        })
        .collect();
    let context = json!({
        "cards": cards(collected),
        "open": groups(collected),
        "records": records(collected),
        "modules": modules,
        "solutions": solutions(collected, tones),
        "goals": goals(collected),
        "items": items(collected),
        "failures": failures(collected),
        "tools": tools(collected),
        "tables": methods(collected),
        "limitations": analysis.limitations.iter().map(|entry| json!({
            "id": entry.id, "kind": entry.kind.word(), "text": entry.text, "effect": entry.effect, "cure": entry.cure,
            "place": entry.place, "readings": entry.readings.join(", "),
        })).collect::<Vec<_>>(),
        "risks": analysis.risks,
        "assumptions": analysis.assumptions,
        "inventory": inventory,
        "licenses": licenses,
        "drives": collected.drives.is_some(),
    });
    render(PAGE, context)
}

fn cards(collected: &Collected) -> Value {
    let summary = Summary::of(&collected.trace.rows);
    let count = |wanted: &str| collected.standings.iter().filter(|standing| standing.state.word() == wanted).count();
    let figure = |record: &str, name: &str| {
        let standing = collected.standings.iter().find(|standing| standing.name == record);
        standing.and_then(|standing| standing.get(name)).unwrap_or("–").to_owned()
    };
    let tone = |bad: bool, class: &'static str| if bad { class } else { "good" };
    let (stale, not_run, findings) = (count("stale"), count("not run"), collected.findings.len());
    json!([
        {"label": "findings of the check", "value": findings, "class": tone(findings > 0, "alarm")},
        {"label": "records of these sources", "value": format!("{} of {}", count("fresh"), collected.standings.len()), "class": ""},
        {"label": "stale", "value": stale, "class": tone(stale > 0, "alarm")},
        {"label": "not run", "value": not_run, "class": tone(not_run > 0, "caution")},
        {"label": "requirements covered", "value": format!("{} of {}", summary.covered, summary.requirements), "class": ""},
        {"label": "with a recorded proof", "value": summary.proved, "class": ""},
        {"label": "harnesses proved", "value": figure("proofs", "proved"), "class": ""},
        {"label": "dangerous faults missed or late", "value": format!("{} / {}", figure("inject", "missed"), figure("inject", "late")), "class": ""},
        {"label": "open items", "value": collected.open.len(), "class": "caution"},
    ])
}

fn groups(collected: &Collected) -> Vec<Value> {
    Why::ALL
        .iter()
        .map(|(why, title)| {
            let items: Vec<Value> = (collected.open.iter().filter(|open| open.why == *why))
                .map(|open| json!({"place": open.place, "text": open.text, "cure": open.cure}))
                .collect();
            let class = match why {
                Why::Finding | Why::Stale => "alarm",
                Why::NotRun | Why::InRecord | Why::Undeveloped | Why::Doubt => "caution",
                Why::Limitation | Why::Method | Why::Risk => "",
            };
            let last = match why {
                Why::Finding => "check",
                Why::Stale | Why::NotRun => "made by",
                Why::InRecord => "",
                Why::Undeveloped => "module",
                Why::Doubt => "doubts",
                Why::Limitation => "what would end it",
                Why::Method => "where",
                Why::Risk => "carried by",
            };
            json!({"title": title, "class": class, "items": items, "last": last, "long": items.len() > 12})
        })
        .filter(|group| group.get("items").and_then(Value::as_array).is_some_and(|items| !items.is_empty()))
        .collect()
}

fn records(collected: &Collected) -> Vec<Value> {
    (collected.standings.iter())
        .map(|standing| {
            let changed = match &standing.state {
                State::Stale { changed } => changed.join(", "),
                State::Fresh | State::NotRun => String::new(),
            };
            json!({
                "title": standing.title, "state": standing.state.word(), "changed": changed, "figures": standing.figures,
                "not_shown": standing.not_shown, "command": standing.command, "file": standing.file, "page": standing.page,
                "open": standing.open.len(), "name": standing.name,
            })
        })
        .collect()
}

fn solutions(collected: &Collected, tones: &BTreeMap<String, &'static str>) -> Vec<Value> {
    let nodes = collected.argument.nodes().filter(|(_, id, _)| Element::of(id).is_some_and(Element::is_solution));
    nodes
        .map(|(module, id, node)| {
            let pieces: Vec<Value> = (node.pieces())
                .map(|piece| {
                    let evidence = Evidence::try_from(piece.to_owned());
                    let tone =
                        evidence.map_or("bad", |evidence| tone(&evidence, &collected.standings, &collected.trace));
                    json!({"text": piece, "tone": tone})
                })
                .collect();
            json!({
                "id": id, "module": module.name, "text": node.text, "not_shown": node.not_shown, "pieces": pieces,
                "tone": tones.get(id).copied().unwrap_or_default(),
            })
        })
        .collect()
}

/// Each goal with the longest chain against its time, and how its requirements stand.
fn goals(collected: &Collected) -> Vec<Value> {
    let analysis = &collected.analysis;
    let value = |id: &str| analysis.timing.timer.iter().find(|timer| timer.id == id).map_or(0, |timer| timer.value_ms);
    (analysis.goals.iter())
        .map(|goal| {
            let chains = analysis.timing.chain.iter().filter(|chain| chain.goal == goal.id && chain.budget_ms.is_none());
            let sum = |chain: &&crate::analysis::Chain| chain.steps.iter().map(|step| value(&step.timer)).fold(0_u32, u32::saturating_add);
            let longest = chains.max_by_key(sum);
            let steps = longest.map(|chain| {
                let phase = |phase: Phase| match phase {
                    Phase::Detection => "detection",
                    Phase::Decision => "decision",
                    Phase::Actuation => "actuation",
                };
                chain.steps.iter().map(|step| json!({"phase": phase(step.phase), "ms": value(&step.timer)})).collect::<Vec<_>>()
            });
            let rows: Vec<&crate::trace::Row> = (analysis.requirements.iter())
                .filter(|requirement| requirement.goal.contains(&goal.id))
                .filter_map(|requirement| collected.trace.rows.iter().find(|row| row.id == requirement.id))
                .collect();
            let longest_ms = longest.map(|chain| sum(&chain));
            let share = longest_ms.map(|ms| ms.saturating_mul(100).checked_div(goal.ftti_ms).unwrap_or(0));
            json!({
                "id": goal.id, "text": goal.text, "safe_state": goal.safe_state, "ftti": goal.ftti_ms, "level": goal.asil,
                "events": goal.events.join(", "), "longest": longest_ms, "share": share, "steps": steps,
                "fault": longest.map(|chain| chain.fault.clone()), "requirements": rows.len(),
                "proved": rows.iter().filter(|row| row.is_proved()).count(),
                "tested": rows.iter().filter(|row| !row.tests.is_empty()).count(),
            })
        })
        .collect()
}

/// The items of a file, and the ids that they carry.
type Carried<'a> = (BTreeSet<&'a str>, BTreeSet<String>);

/// The other direction: from each file to the requirements that its items carry.
fn items(collected: &Collected) -> Vec<Value> {
    let kinds = [
        (Kind::Code, "code"),
        (Kind::Limit, "limits"),
        (Kind::Property, "properties"),
        (Kind::Test, "tests"),
        (Kind::Check, "checks"),
    ];
    let mut files: BTreeMap<(&str, &str), Carried<'_>> = BTreeMap::new();
    for tag in &collected.trace.scan.tags {
        let word = kinds.iter().find(|(kind, _)| *kind == tag.kind).map_or("", |(_, word)| *word);
        let (items, ids) = files.entry((word, &tag.place.file)).or_default();
        items.insert(&tag.place.item);
        ids.insert(tag.id.to_string());
    }
    let mut all: Vec<Value> = files
        .into_iter()
        .map(|((kind, file), (items, ids))| {
            let ids: Vec<String> = ids.into_iter().collect();
            json!({"kind": kind, "file": file, "items": items.len(), "ids": ids.join(", ")})
        })
        .collect();
    let mut harnesses: BTreeMap<&str, (&str, BTreeSet<&str>)> = BTreeMap::new();
    for row in &collected.trace.rows {
        for harness in &row.harnesses {
            harnesses.entry(&harness.place.item).or_insert((&harness.verdict, BTreeSet::new())).1.insert(&row.id);
        }
    }
    all.extend(harnesses.into_iter().map(|(name, (verdict, ids))| {
        let ids: Vec<&str> = ids.into_iter().collect();
        json!({"kind": "harness", "file": format!("{name}: {verdict}"), "items": 1, "ids": ids.join(", ")})
    }));
    all
}

fn failures(collected: &Collected) -> Vec<Value> {
    (collected.analysis.failures.iter())
        .map(|failure| {
            let evidence: Vec<Value> = (failure.evidence.iter())
                .map(|piece| json!({"text": piece.to_string(), "tone": tone(piece, &collected.standings, &collected.trace)}))
                .collect();
            let parts: Vec<&str> = failure.parts.iter().map(|part| part.trim_start_matches("supervisor/")).collect();
            json!({
                "id": failure.id, "parts": parts, "mode": failure.mode, "effect": failure.effect, "goals": failure.goals.join(", "),
                "requirements": failure.requirements.join(", "), "detection": failure.detection, "evidence": evidence,
                "residual": failure.residual, "assumptions": failure.assumptions.join(", "),
            })
        })
        .collect()
}

fn tools(collected: &Collected) -> Vec<Value> {
    (collected.analysis.tools.iter())
        .map(|tool| {
            let version = collected.versions.iter().find(|version| version.id == tool.id).and_then(|version| version.version.clone());
            let version = version.or_else(|| (!tool.version.is_empty()).then(|| "not installed here".to_owned()));
            json!({
                "id": tool.id, "name": tool.name, "used": tool.used, "version": version, "ti": tool.ti, "td": tool.td, "tcl": tool.tcl,
                "ti_reason": tool.ti_reason, "td_reason": tool.td_reason, "failures": tool.failure,
            })
        })
        .collect()
}

fn methods(collected: &Collected) -> Vec<Value> {
    (collected.analysis.methods.iter())
        .map(|table| {
            let rows: Vec<Value> = (table.row.iter())
                .map(|row| {
                    let degree = match row.degree {
                        Degree::Highly => "++",
                        Degree::Recommended => "+",
                        Degree::Neither => "o",
                    };
                    let answer = match row.answer {
                        Answer::Yes => "yes",
                        Answer::Partly => "partly",
                        Answer::No => "no",
                        Answer::Integrator => "integrator",
                    };
                    json!({"id": row.id, "method": row.method, "degree": degree, "answer": answer, "place": row.place})
                })
                .collect();
            json!({"id": table.id, "title": table.title, "source": table.source, "rows": rows})
        })
        .collect()
}
