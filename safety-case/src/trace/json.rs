//! The table as JSON.
//!
//! ```text
//! { "version": 1,
//!   "summary":      { "requirements": 339, "covered": .., "by_review": .., "orphans": .., "exempt": ..,
//!                     "code_by_demand": .., "code_by_group": .., "without_code": .., "tested": .., "proved": ..,
//!                     "planned_not_proved": .. },
//!   "findings":     [ { PLACE, "rule": "NoCode", "message": ".." } ],
//!   "requirements": [ { "id": "SEAT-5a", "text": "..", "source": "..", "package": 1, "method": ["proof", "test"],
//!                       "place": { PLACE }, "status": "covered" | "by_review" | "orphan" | "exempt",
//!                       "code": [ { PLACE, "by_group": false } ], "without_code": null | "why",
//!                       "limits": [ { PLACE } ], "properties": [ { PLACE } ],
//!                       "harnesses": [ { PLACE, "proved": true, "verdict": "proved" } ],
//!                       "tests": [ { PLACE } ], "checks": [ { PLACE } ], "planned_not_proved": false } ] }
//! ```
//!
//! `PLACE` is `"file": "supervisor/core/src/parking.rs", "line": 61, "item": "Parking::next"`; files
//! from the root of the project.

use serde_json::{Value, json as value};

use super::Trace;
use super::table::Summary;

/// The document.
#[must_use]
pub fn json(trace: &Trace) -> Value {
    let rows: Vec<Value> = (trace.rows.iter())
        .map(|row| {
            let mut entry = value!(row);
            if let Some(fields) = entry.as_object_mut() {
                fields.insert("planned_not_proved".to_owned(), row.awaits_proof().into());
            }
            entry
        })
        .collect();
    value!({
        "version": 1,
        "summary": Summary::of(&trace.rows),
        "findings": trace.findings,
        "requirements": rows,
    })
}
