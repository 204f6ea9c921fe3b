//! What was counted, as a page that works offline.

use serde_json::{Value, json};

use super::table::{S1, first_runs, per_1000_km, percent, times};
use super::tally::{Tally, Times};
use crate::number::float;
use crate::template::render;

const PAGE: &str = include_str!("../../templates/disturb.html");
/// Width of the longest bar in per cent.
const LONGEST: f64 = 60.0;

/// The page as one HTML file.
///
/// # Errors
/// If the template does not render.
pub fn page(tally: &Tally) -> Result<String, minijinja::Error> {
    let all = tally.all_runs();
    let causes = tally.all_causes();
    let interventions: u64 = causes.values().sum();
    let cards = json!([
        {"label": "runs with the correct main controller", "value": all.runs},
        {"label": "of these disturbed", "value": all.disturbed, "class": if all.disturbed == 0 { "good" } else { "alarm" }},
        {"label": "km of ordinary driving", "value": format!("{:.1}", float(tally.metres) / 1000.0)},
        {"label": "interventions on it", "value": interventions, "class": if interventions == 0 { "good" } else { "caution" }},
    ]);
    let shares = json!([
        {"what": "with an intervention that moves the bus", "value": percent(all.disturbed, all.runs)},
        {"what": "with an intervention on the warnings", "value": percent(all.warned, all.runs)},
        {"what": "with a level that began without a cause", "value": percent(all.false_triggers, all.runs)},
        {"what": "with a collision", "value": percent(all.collisions, all.runs)},
    ]);
    let kinds: Vec<Value> = tally.runs.iter().map(|(kind, runs)| json!({"kind": kind, "counts": runs})).collect();
    let run_causes: Vec<Value> = tally
        .run_causes
        .iter()
        .map(|(cause, count)| json!({"cause": cause, "count": count, "example": tally.run_examples.get(cause)}))
        .collect();
    let first: Vec<Value> = first_runs(tally).map(|(what, text)| json!({"what": what, "value": text})).collect();
    let reaction = &tally.reaction;
    let parts = [
        ("bus", &reaction.bus),
        ("wait", &reaction.wait),
        ("supervisor", &reaction.supervisor),
        ("all", &reaction.all),
    ];
    let reactions: Vec<Value> =
        parts.iter().map(|(name, found)| json!({"name": name, "text": times(found), "bars": bars(found)})).collect();
    let rates: Vec<Value> = [("all interventions".to_owned(), interventions)]
        .into_iter()
        .chain(causes)
        .map(|(cause, count)| json!({"what": cause, "value": per_1000_km(count, tally)}))
        .chain([json!({"what": "collision mitigation in all", "value": per_1000_km(tally.levels.values().sum(), tally)})])
        .chain(tally.levels.iter().map(|(level, count)| {
            json!({"what": format!("collision mitigation up to level {level}"), "value": per_1000_km(*count, tally)})
        }))
        .chain([json!({"what": "collision warnings", "value": per_1000_km(tally.warnings, tally)})])
        .collect();
    let pieces: Vec<Value> = tally
        .pieces
        .iter()
        .map(|(piece, count)| {
            let disturbed: u64 = tally.causes.get(piece).map_or(0, |causes| causes.values().sum());
            json!({"piece": piece, "count": count, "disturbed": disturbed})
        })
        .collect();
    let context = json!({
        "seed": tally.seed, "sources": tally.sources.shipped.chars().take(12).collect::<String>(), "cards": cards,
        "shares": shares, "kinds": kinds, "run_causes": run_causes, "first": first, "reactions": reactions, "s1": S1, "rates": rates,
        "pieces": pieces, "cases": tally.cases, "stops": tally.stops, "hard": tally.hard,
        "collisions": tally.collisions, "hours": format!("{:.1}", float(tally.seconds) / 3600.0),
    });
    render(PAGE, context)
}

/// The distribution, one bar for each ms.
fn bars(times: &Times) -> Vec<Value> {
    let most = times.values().max().copied().unwrap_or(1);
    times
        .iter()
        .map(|(value, count)| json!({"ms": value, "count": count, "wide": float(*count) / float(most) * LONGEST}))
        .collect()
}
