//! What came of scenarios, as a page that works offline.

use serde_json::{Value, json};

use super::picture::picture;
use super::run::Driven;
use crate::template::render;

const PAGE: &str = include_str!("../../templates/simulate.html");

/// The page as one HTML file.
///
/// # Errors
/// If a picture cannot be drawn, or the template does not render.
pub fn page(driven: &[Driven], seed: u64) -> Result<String, String> {
    let all: Vec<Value> = driven.iter().map(shown).collect::<Result<_, _>>()?;
    let passed = driven.iter().filter(|drive| drive.passed()).count();
    let demands: usize = driven.iter().map(|drive| drive.rows.len()).sum();
    let cards = json!([
        {"label": "scenarios", "value": driven.len()},
        {"label": "with everything as demanded", "value": passed, "class": if passed == driven.len() { "good" } else { "caution" }},
        {"label": "demands", "value": demands},
    ]);
    render(PAGE, json!({"cards": cards, "drives": all, "seed": seed})).map_err(|error| error.to_string())
}

fn shown(drive: &Driven) -> Result<Value, String> {
    let scene = &drive.scene;
    let rows: Vec<Value> = drive
        .rows
        .iter()
        .map(|row| json!({"what": row.what, "wanted": row.wanted, "found": row.found, "passed": row.passed}))
        .collect();
    Ok(json!({
        "name": scene.full_name(), "title": scene.title, "description": scene.description, "source": scene.source,
        "requirements": scene.requirements.join(", "), "published": scene.published, "passed": drive.passed(), "word": drive.word(), "known": scene.expected.known,
        "rows": rows, "level": drive.level.code(), "picture": picture(&drive.curves())?,
    }))
}
