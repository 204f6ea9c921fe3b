//! Reads the results that Kani exports.

use std::fmt::{self, Display, Formatter};

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

impl Display for Verdict {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Proved => f.write_str("proved"),
            Self::Failed(why) => write!(f, "FAILED: {why}"),
            Self::Vacuous(why) => write!(f, "VACUOUS: {why}"),
            Self::Undetermined(why) => write!(f, "UNDETERMINED: {why}"),
        }
    }
}

fn text<'a>(value: &'a Value, key: &str) -> &'a str {
    value.get(key).and_then(Value::as_str).unwrap_or("")
}

/// A failed check of these kinds is no counterexample: a loop went further than it was unrolled, or Kani met what it
/// does not know.
const UNDECIDED: [&str; 2] = ["unwind", "unsupported_construct"];

/// The verdict on `harness` in an exported result.
///
/// Proved is only what succeeded with every check decided and with at least one cover, every one satisfied: Kani itself
/// ends well on a proof that shows nothing.
#[must_use]
pub fn judge(export: &Value, harness: &str) -> Verdict {
    let results = export.pointer("/verification_results/results").and_then(Value::as_array);
    let Some(result) = results.into_iter().flatten().find(|result| text(result, "harness_id") == harness) else {
        return Verdict::Undetermined("no result for this harness".to_owned());
    };
    let checks = result.get("checks").and_then(Value::as_array).map(Vec::as_slice).unwrap_or_default();
    let (covers, others): (Vec<&Value>, Vec<&Value>) =
        checks.iter().partition(|check| text(check, "category") == "cover");
    let (undecided, decided): (Vec<&Value>, Vec<&Value>) = (others.iter().copied())
        .filter(|check| text(check, "status") == "Failure")
        .partition(|check| UNDECIDED.contains(&text(check, "category")));
    if let Some(failed) = decided.first() {
        return Verdict::Failed(told(failed));
    }
    if let Some(failed) = undecided.first() {
        return Verdict::Undetermined(told(failed));
    }
    if checks.is_empty() {
        return Verdict::Undetermined(ended(export, harness));
    }
    if let Some(open) = others.iter().find(|check| !matches!(text(check, "status"), "Success" | "Unreachable")) {
        return Verdict::Undetermined(format!("{}: {}", text(open, "status").to_lowercase(), told(open)));
    }
    if text(result, "status") != "Success" {
        return Verdict::Undetermined("Kani tells no success, and no failed check".to_owned());
    }
    for cover in &covers {
        match text(cover, "status") {
            "Satisfied" => {}
            "Unsatisfiable" | "Unreachable" => {
                return Verdict::Vacuous(format!("cover not satisfied: {}", text(cover, "description")));
            }
            status => return Verdict::Undetermined(format!("cover {}: {}", status.to_lowercase(), told(cover))),
        }
    }
    if covers.is_empty() {
        return Verdict::Vacuous("no cover".to_owned());
    }
    // A contradictory assumption makes every check of the harness itself unreachable.
    let own: Vec<_> = others.iter().filter(|check| text(check, "function").contains(harness)).collect();
    if !own.is_empty() && own.iter().all(|check| text(check, "status") == "Unreachable") {
        return Verdict::Vacuous("no check of the harness is reachable".to_owned());
    }
    Verdict::Proved
}

/// A check: what it is, and where.
fn told(check: &Value) -> String {
    let at = |key: &str| check.pointer(key).and_then(Value::as_str).unwrap_or("?");
    format!("{} ({}:{})", text(check, "description"), at("/location/file"), at("/location/line"))
}

/// Why there are no checks.
fn ended(export: &Value, harness: &str) -> String {
    let details = export.get("error_details").and_then(Value::as_array);
    let detail = details.into_iter().flatten().find(|detail| text(detail, "harness_id") == harness);
    match detail.map_or("", |detail| text(detail, "exit_status")) {
        "" => "no checks".to_owned(),
        status => format!("no checks: {}", status.replace('_', " ")),
    }
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
        let unreachable = json!({"category": "assertion", "status": "Unreachable", "function": "core::f"});
        let export =
            export("Success", &json!([check("assertion", "Success"), unreachable, check("cover", "Satisfied")]));
        assert_eq!(judge(&export, "h"), Verdict::Proved);
    }

    #[test]
    fn an_unsatisfiable_cover_is_vacuous_though_kani_says_success() {
        for status in ["Unsatisfiable", "Unreachable"] {
            let covers = [check("assertion", "Success"), check("cover", "Satisfied"), check("cover", status)];
            let export = export("Success", &json!(covers));
            assert!(matches!(judge(&export, "h"), Verdict::Vacuous(_)), "{status}");
        }
    }

    #[test]
    fn a_contradictory_assumption_is_vacuous() {
        let checks = [check("assertion", "Unreachable"), check("cover", "Satisfied")];
        assert!(matches!(judge(&export("Success", &json!(checks)), "h"), Verdict::Vacuous(_)));
    }

    #[test]
    fn every_harness_needs_a_cover() {
        let export = export("Success", &json!([check("assertion", "Success")]));
        assert_eq!(judge(&export, "h"), Verdict::Vacuous("no cover".to_owned()));
    }

    #[test]
    fn what_is_not_decided_is_undetermined() {
        for status in ["Undetermined", "Unknown", "Error", "SomethingNew", ""] {
            for kind in ["assertion", "cover"] {
                let checks = [check("assertion", "Success"), check("cover", "Satisfied"), check(kind, status)];
                let verdict = judge(&export("Success", &json!(checks)), "h");
                assert!(matches!(verdict, Verdict::Undetermined(_)), "{kind} {status}: {verdict:?}");
            }
        }
    }

    #[test]
    fn a_loop_unrolled_too_little_is_no_counterexample() {
        for kind in UNDECIDED {
            let short =
                json!([check(kind, "Failure"), check("assertion", "Undetermined"), check("cover", "Undetermined")]);
            assert!(matches!(judge(&export("Failure", &short), "h"), Verdict::Undetermined(_)), "{kind}");
            let real = json!([check(kind, "Failure"), check("assertion", "Failure")]);
            assert!(matches!(judge(&export("Failure", &real), "h"), Verdict::Failed(_)), "{kind}");
        }
    }

    #[test]
    fn failure_time_out_and_absence_are_not_proved() {
        let failed = export("Failure", &json!([check("assertion", "Failure"), check("cover", "Satisfied")]));
        assert_eq!(judge(&failed, "h"), Verdict::Failed("d (f:1)".to_owned()));
        let mut timeout = export("Failure", &json!([]));
        timeout["error_details"] = json!([{"harness_id": "h", "exit_status": "timeout"}]);
        assert_eq!(judge(&timeout, "h"), Verdict::Undetermined("no checks: timeout".to_owned()));
        assert!(matches!(judge(&json!({}), "h"), Verdict::Undetermined(_)));
        assert!(matches!(judge(&failed, "other"), Verdict::Undetermined(_)));
        let odd = export("Failure", &json!([check("assertion", "Success"), check("cover", "Satisfied")]));
        assert!(matches!(judge(&odd, "h"), Verdict::Undetermined(_)));
    }
}
