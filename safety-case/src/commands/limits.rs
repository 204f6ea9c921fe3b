//! `supervise limits`.

use serde_json::json;
use supervisor::{LIMITS, Limit};

use super::{Outcome, print};
use crate::cli::LimitsArgs;

/// Runs it.
///
/// # Errors
/// If the output cannot be written.
pub fn run(arguments: &LimitsArgs) -> Outcome {
    if arguments.json {
        let rows: Vec<_> = LIMITS
            .iter()
            .map(|limit| {
                json!({
                    "name": limit.name, "default": defaults(limit), "least": limit.least, "greatest": limit.greatest,
                    "unit": limit.unit, "source": limit.source, "requirement": limit.requirement,
                })
            })
            .collect();
        print(format!("{:#}\n", json!(rows)))?;
        return Ok(0);
    }
    let mut text =
        format!("{:<24} {:<30} {:<16} {:<20} {:<12} {}\n", "name", "default", "range", "unit", "requirement", "source");
    for limit in LIMITS {
        let range = format!("{}..{}", limit.least, limit.greatest);
        let default = list(&defaults(limit));
        let row = format!(
            "{:<24} {default:<30} {range:<16} {:<20} {:<12} {}",
            limit.name, limit.unit, limit.requirement, limit.source
        );
        text.push_str(row.trim_end());
        text.push('\n');
    }
    print(text)?;
    Ok(0)
}

/// Every default of a row; the last one of the table repeats.
pub(super) fn defaults(limit: &Limit) -> Vec<i64> {
    let last = limit.default.last().copied().unwrap_or(0);
    let mut values = limit.default.to_vec();
    values.resize(limit.count, last);
    values
}

/// "4400, 3600, 2700".
pub(super) fn list(values: &[i64]) -> String {
    values.iter().map(i64::to_string).collect::<Vec<_>>().join(", ")
}
