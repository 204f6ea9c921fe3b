//! The matrix as a page that works offline.

use serde_json::{Value, json};

use super::judge::{Row, Standing, against};
use super::list::{Effect, Expected};
use super::matrix::{Cell, Matrix};
use super::table::{expected, figures};
use crate::template::render;

const PAGE: &str = include_str!("../../templates/inject.html");

/// The page as one HTML file.
///
/// # Errors
/// If the template does not render.
pub fn page(rows: &[Row<'_>], matrix: &Matrix) -> Result<String, minijinja::Error> {
    let cards: Vec<Value> =
        figures(rows, matrix).into_iter().map(|(value, label)| json!({"label": label, "value": value})).collect();
    let run: Vec<Value> =
        rows.iter().filter(|row| row.standing != Standing::NotRun).map(|row| shown(row, matrix)).collect();
    let context = json!({
        "seed": matrix.seed,
        "runs": matrix.runs,
        "sources": matrix.sources.shipped.chars().take(12).collect::<String>(),
        "cards": cards,
        "drives": matrix.drives,
        "rows": run,
    });
    render(PAGE, context)
}

fn shown(row: &Row<'_>, matrix: &Matrix) -> Value {
    let cells = matrix.of(&row.fault.run.id);
    let cells: Vec<Value> =
        matrix.drives.iter().map(|drive| place(row, cells.get(drive.name.as_str()).copied())).collect();
    let class = match row.standing {
        Standing::Against => "bad",
        Standing::Known => "known",
        Standing::NotShown => "quiet",
        Standing::AsExpected | Standing::Residual | Standing::NotRun => "",
    };
    let reaction = row.detection().map(|[least, middle, most]| format!("{least} / {middle} / {most}"));
    let goals: Vec<String> = row.fault.run.goals.iter().map(|goal| format!("SG-{:02}", goal.0)).collect();
    json!({
        "id": row.fault.run.id, "what": row.fault.what, "group": row.fault.group, "expected": expected(row),
        "reason": row.fault.reason, "assumption": row.fault.assumption, "known": row.fault.known,
        "goals": goals.join(", "), "class": class, "standing": row.standing.word(), "cells": cells,
        "reaction": reaction, "share": row.sum.share,
    })
}

fn place(row: &Row<'_>, cell: Option<&Cell>) -> Value {
    let Some(cell) = cell else { return json!({"class": "none", "text": "", "note": "does not apply"}) };
    let unseen = cell.late.saturating_add(cell.missed);
    let class = match (row.fault.expected, row.fault.effect) {
        _ if against(row.fault, cell) > 0 => "bad",
        _ if cell.dangerous() == 0 => "quiet",
        (Expected::Residual, _) if unseen.saturating_add(cell.reported) > 0 => "residual",
        (Expected::Detected, Effect::Reported) if cell.reported > 0 => "reported",
        (Expected::Detected | Expected::Residual | Expected::Tolerated, _) => "good",
    };
    let text = if cell.dangerous() == 0 { "·".to_owned() } else { format!("{}/{}", cell.averted, cell.dangerous()) };
    let said = |example: &super::matrix::Example| {
        let at = f64::from(example.from_ms) / 1000.0;
        format!("; {} at {at:.2} s, {} {}", example.outcome, example.goal, example.said)
    };
    let examples: String = cell.examples.iter().map(said).collect();
    let note = format!(
        "{} runs: {} harmless, {} averted, {} reported, {} late, {} missed{examples}",
        cell.runs(),
        cell.harmless,
        cell.averted,
        cell.reported,
        cell.late,
        cell.missed
    );
    json!({"class": class, "text": text, "note": note})
}
