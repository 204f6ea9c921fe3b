//! What came of scenarios, as JSON.
//!
//! ```text
//! { "schema": "supervise-simulate", "version": 1, "seed": 1, "as_expected": true, "sources": { "shipped": "...", "bench": "..." },
//!   "figures": { "variants": 55, "as_demanded": 46, "known_not_to": 9, "not_as_expected": 0, "demands": 315 }, "open": [ "..." ],
//!   "drives": [ { "scenario": "s1-approach", "variant": "0.3 s", "title": "...", "source": "S1 §3.2", "requirements": ["MIT-1a"],
//!                 "stands": "pass", "known": null, "cycles": 7200, "level": 2, "digest": "0123456789abcdef", "log": "s1-approach-0.3-s.candump.gz",
//!                 "demands": [ { "what": "hazards", "wanted": "none", "found": "none", "passed": true } ],
//!                 "events": [ { "t": 61.98, "what": "60 m left" } ] } ] }
//! ```
//! `digest`: FNV-1a over every verdict, as in `tests/drives/drives.toml`: a replay of the log has the same.

use serde_json::{Value, json};

use supervisor_tests::scenario::criteria::Standing;

use super::run::{Driven, log_name};
use crate::inject::Sources;

/// The document; `sources` say of what it is, `open` what is known not to hold.
#[must_use]
pub fn document(driven: &[Driven], seed: u64, sources: &Sources) -> Value {
    let told: Vec<Value> = driven.iter().map(drive).collect();
    let as_expected = driven.iter().all(|drive| drive.standing().as_expected());
    let count = |standing| driven.iter().filter(|drive| drive.standing() == standing).count();
    let (met, known) = (count(Standing::Met), count(Standing::Known));
    let demands: usize = driven.iter().map(|drive| drive.rows.len()).sum();
    let why = |drive: &Driven| {
        Some(format!(
            "{}: {}",
            log_name(&drive.scene).trim_end_matches(".candump.gz"),
            drive.scene.expected.known.as_ref()?
        ))
    };
    json!({
        "schema": "supervise-simulate", "version": 1, "seed": seed, "as_expected": as_expected,
        "sources": {"shipped": sources.shipped, "configuration": sources.configuration, "bench": sources.bench},
        "figures": {
            "variants": driven.len(), "as_demanded": met, "known_not_to": known,
            "not_as_expected": driven.len().saturating_sub(met.saturating_add(known)), "demands": demands
        },
        "open": driven.iter().filter_map(why).collect::<Vec<_>>(), "drives": told
    })
}

fn drive(drive: &Driven) -> Value {
    let scene = &drive.scene;
    let demands = drive
        .rows
        .iter()
        .map(|row| json!({"what": row.what, "wanted": row.wanted, "found": row.found, "passed": row.passed}));
    let events = drive.events.iter().map(|event| json!({"t": f64::from(event.at_ms) / 1000.0, "what": event.what}));
    json!({
        "scenario": scene.name, "variant": scene.variant, "title": scene.title, "source": scene.source,
        "requirements": scene.requirements, "stands": drive.word(), "known": scene.expected.known, "cycles": drive.cycles,
        "level": drive.level.code(), "digest": format!("{:016x}", drive.digest), "log": log_name(scene),
        "demands": demands.collect::<Vec<_>>(), "events": events.collect::<Vec<_>>(),
    })
}
