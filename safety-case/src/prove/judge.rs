//! Reads the results that Kani exports.

use serde::{Deserialize, Serialize};
use serde_json::Value;

/// What a run of one harness shows.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", tag = "verdict", content = "why")]
pub enum Verdict {
    /// Every check holds and every cover is satisfied.
    Proved,
    /// A check fails: the first one.
    Failed(String),
    /// It succeeded, but shows nothing: a cover that is not satisfied.
    Vacuous(String),
    /// No verdict: time-out, undetermined checks, or no result at all.
    Undetermined(String),
}

fn text<'a>(value: &'a Value, key: &str) -> &'a str {
    value.get(key).and_then(Value::as_str).unwrap_or("")
}

/// The verdict on `harness` in an exported result.
///
/// `reach` demands at least one satisfied cover.
#[must_use]
pub fn judge(export: &Value, harness: &str, reach: bool) -> Verdict {
    let results = export.pointer("/verification_results/results").and_then(Value::as_array);
    let Some(result) = results.into_iter().flatten().find(|result| text(result, "harness_id") == harness) else {
        return Verdict::Undetermined("no result for this harness".to_owned());
    };
    let checks = result.get("checks").and_then(Value::as_array).map(Vec::as_slice).unwrap_or_default();
    let (covers, others): (Vec<&Value>, Vec<&Value>) =
        checks.iter().partition(|check| text(check, "category") == "cover");
    if let Some(failed) = others.iter().find(|check| text(check, "status") == "Failure") {
        let line = failed.pointer("/location/line").and_then(Value::as_str).unwrap_or("?");
        let file = failed.pointer("/location/file").and_then(Value::as_str).unwrap_or("?");
        return Verdict::Failed(format!("{} ({file}:{line})", text(failed, "description")));
    }
    if checks.is_empty() || text(result, "status") != "Success" {
        return Verdict::Undetermined("time-out or solver failure: no checks".to_owned());
    }
    if others.iter().any(|check| text(check, "status") == "Undetermined") {
        return Verdict::Undetermined("undetermined checks".to_owned());
    }
    if let Some(cover) = covers.iter().find(|check| text(check, "status") != "Satisfied") {
        return Verdict::Vacuous(format!("cover not satisfied: {}", text(cover, "description")));
    }
    if reach && covers.is_empty() {
        return Verdict::Vacuous("no cover".to_owned());
    }
    // A contradictory assumption makes every check of the harness itself unreachable.
    let own: Vec<_> = others.iter().filter(|check| text(check, "function").contains(harness)).collect();
    if !own.is_empty() && own.iter().all(|check| text(check, "status") == "Unreachable") {
        return Verdict::Vacuous("no check of the harness is reachable".to_owned());
    }
    Verdict::Proved
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn export(status: &str, checks: &Value) -> Value {
        json!({"verification_results": {"results": [{"harness_id": "h", "status": status, "checks": checks}]}})
    }
    fn check(category: &str, status: &str) -> Value {
        json!({"category": category, "status": status, "description": "d", "function": "h", "location": {"file": "f", "line": "1"}})
    }

    #[test]
    fn a_success_with_satisfied_covers_is_proved() {
        let export = export("Success", &json!([check("assertion", "Success"), check("cover", "Satisfied")]));
        assert_eq!(judge(&export, "h", true), Verdict::Proved);
    }

    #[test]
    fn an_unsatisfiable_cover_is_vacuous_though_kani_says_success() {
        for status in ["Unsatisfiable", "Unreachable", "Undetermined"] {
            let export = export("Success", &json!([check("assertion", "Success"), check("cover", status)]));
            assert!(matches!(judge(&export, "h", true), Verdict::Vacuous(_)), "{status}");
        }
    }

    #[test]
    fn a_contradictory_assumption_is_vacuous() {
        let export = export("Success", &json!([check("assertion", "Unreachable")]));
        assert!(matches!(judge(&export, "h", false), Verdict::Vacuous(_)));
    }

    #[test]
    fn a_harness_that_must_reach_needs_a_cover() {
        let export = export("Success", &json!([check("assertion", "Success")]));
        assert!(matches!(judge(&export, "h", true), Verdict::Vacuous(_)));
        assert_eq!(judge(&export, "h", false), Verdict::Proved);
    }

    #[test]
    fn failure_time_out_and_absence_are_not_proved() {
        let failed = export("Failure", &json!([check("assertion", "Failure")]));
        assert!(matches!(judge(&failed, "h", true), Verdict::Failed(_)));
        let timeout = export("Failure", &json!([]));
        assert!(matches!(judge(&timeout, "h", true), Verdict::Undetermined(_)));
        assert!(matches!(judge(&json!({}), "h", true), Verdict::Undetermined(_)));
        assert!(matches!(judge(&failed, "other", true), Verdict::Undetermined(_)));
    }
}
