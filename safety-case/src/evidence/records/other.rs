//! Records whose commands stand elsewhere: read by what all records have, whatever else is in them.
//!
//! A record is one JSON object. `sources` says of what it is: a digest of the shipped sources, or an object with digests by the
//! names of [`Sources`]: `shipped`, `configuration`, `bench`, `faults`. Figures are the numbers and words at its top, or
//! in an object `figures`. `open` is a list of what is open.

use std::path::Path;

use serde_json::Value;

use super::{SCENARIOS, Standing, State};
use crate::disturb::Tally;
use crate::disturb::tally::quantile;
use crate::error::{ToolError, form, read};
use crate::fuzz;
use crate::inject::Sources;
use crate::prove::shipped;

pub(super) fn fuzz(root: &Path) -> Result<Standing, ToolError> {
    let mut standing = Standing::new(
        "fuzz",
        "Fuzzing campaigns",
        fuzz::RECORD,
        "supervise fuzz",
        "Anything by itself: totals say for how long nothing was found.",
    );
    fill(root, &mut standing)?;
    standing.open.extend(fuzz::Record::load(&root.join(fuzz::RECORD))?.short());
    Ok(standing)
}

pub(super) fn disturb(root: &Path) -> Result<Standing, ToolError> {
    let mut standing = Standing::new(
        "disturb",
        "Ordinary driving, and how often it is disturbed",
        "safety-case/records/disturb.json",
        "supervise disturb",
        "How often a real driver is disturbed: it is a model of driving.",
    );
    let path = root.join(&standing.file);
    if !path.exists() {
        return Ok(standing);
    }
    let tally = Tally::read(&read(&path)?).map_err(|error| form(&path, &error))?;
    let sources = serde_json::to_value(&tally.sources).map_err(|error| form(&path, &error))?;
    standing.state = State::of(changed(root, Some(&sources))?);
    let (runs, causes) = (tally.all_runs(), tally.all_causes());
    let braked = causes.get("ServiceBrake Mitigation").copied().unwrap_or_default();
    for (name, value, what) in [
        ("runs", runs.runs, "runs with a correct main controller"),
        ("disturbed", runs.disturbed, "of these with an intervention, warnings apart"),
        ("false_triggers", runs.false_triggers, "of these with a level without a cause"),
        ("collisions", runs.collisions, "of these with a collision"),
        ("metres", tally.metres, "m of ordinary driving"),
        ("stops", tally.stops, "stops in it"),
        ("braked", braked, "times that collision mitigation braked in it"),
        ("warnings", tally.warnings, "collision warnings in it"),
    ] {
        standing.figure(name, value, what);
    }
    if let (Some(median), Some(late)) = (quantile(&tally.reaction.all, 50), quantile(&tally.reaction.all, 99)) {
        standing.figure("reaction_median", median, "ms from an object to a deceleration, median");
        standing.figure("reaction_99", late, "ms, in 99 of 100");
    }
    Ok(standing)
}

pub(super) fn simulate(root: &Path, drawn: bool) -> Result<Standing, ToolError> {
    let mut standing = Standing::new(
        "simulate",
        "Scenarios of the sources in closed loop",
        "safety-case/records/simulate.json",
        "supervise simulate --all",
        "A vehicle: the bus is a model.",
    );
    standing.page = drawn.then(|| format!("drives/{SCENARIOS}"));
    fill(root, &mut standing)?;
    Ok(standing)
}

pub(super) fn target(root: &Path) -> Result<Standing, ToolError> {
    let mut standing = Standing::new(
        "target",
        "Golden vectors and figures of the target",
        "safety-case/records/target.json",
        "supervisor/capi/example/run, supervisor/capi/example/figures --write",
        "The integrator's own target, compiler and clock.",
    );
    fill(root, &mut standing)?;
    Ok(standing)
}

pub(super) fn cost(root: &Path) -> Result<Standing, ToolError> {
    let mut standing = Standing::new(
        "cost",
        "Instructions",
        "safety-case/records/cost.json",
        "supervise cost --write README.md",
        "Time, stack and caches on a target; the greatest measured is no bound.",
    );
    let path = root.join(&standing.file);
    if !path.exists() {
        return Ok(standing);
    }
    let record: Value = serde_json::from_str(&read(&path)?).map_err(|error| form(&path, &error))?;
    standing.state = State::of(changed(root, record.get("sources"))?);
    let stages = record.get("stages").and_then(Value::as_array).cloned().unwrap_or_default();
    for stage in &stages {
        let (name, greatest) =
            (stage.get("stage").and_then(Value::as_str), stage.get("greatest").and_then(Value::as_u64));
        let bar = stage.get("bar").and_then(Value::as_u64);
        let (Some(name), Some(greatest)) = (name, greatest) else { continue };
        if name == "decide + vet" || name == "whole step" {
            standing.figure(name, greatest, "instructions, greatest of all scenarios");
        }
        if bar.is_some_and(|bar| greatest > bar) {
            standing.open.push(format!("{name}: {greatest} instructions, above the bar"));
        }
    }
    Ok(standing)
}

/// Reads the record, where there is one.
fn fill(root: &Path, standing: &mut Standing) -> Result<(), ToolError> {
    let path = root.join(&standing.file);
    if !path.exists() {
        return Ok(());
    }
    let record: Value = serde_json::from_str(&read(&path)?).map_err(|error| form(&path, &error))?;
    let Some(fields) = record.as_object() else { return Err(form(&path, &"is no record: not one object")) };
    standing.state = State::of(changed(root, fields.get("sources"))?);
    let scalars = |value: &Value| match value {
        Value::Number(number) => Some(number.to_string()),
        Value::String(text) => Some(text.clone()),
        Value::Bool(_) | Value::Null | Value::Array(_) | Value::Object(_) => None,
    };
    let own = fields.get("figures").and_then(Value::as_object).unwrap_or(fields);
    for (name, value) in own.iter().filter(|(name, _)| !matches!(name.as_str(), "schema" | "version" | "sources")) {
        if let Some(value) = scalars(value) {
            standing.figure(name, value, &name.replace('_', " "));
        }
    }
    // What the campaigns of the fuzzers write: a row for each target.
    for row in fields.get("targets").and_then(Value::as_array).into_iter().flatten().filter_map(Value::as_object) {
        let target = row.get("target").and_then(Value::as_str).unwrap_or("?");
        for name in ["inputs", "cycles", "edges", "quiet_seconds", "found"] {
            if let Some(value) = row.get(name).and_then(scalars) {
                standing.figure(&format!("{target}.{name}"), value, &format!("{target}: {}", name.replace('_', " ")));
            }
        }
    }
    let open = fields.get("open").and_then(Value::as_array).into_iter().flatten();
    standing.open.extend(open.filter_map(scalars));
    Ok(())
}

/// What is not as it was when the record was made; a record that says nothing of its sources can not be told from a stale one.
fn changed(root: &Path, sources: Option<&Value>) -> Result<Vec<String>, ToolError> {
    let present = Sources::load(root)?;
    let plain = shipped(root)?;
    let mut changed = Vec::new();
    match sources {
        Some(Value::String(digest)) => {
            if *digest != plain && *digest != present.shipped {
                changed.push("the shipped sources".to_owned());
            }
        }
        Some(Value::Object(digests)) => {
            for (name, digest) in digests {
                let same = match name.as_str() {
                    "shipped" => *digest == plain || *digest == present.shipped,
                    "configuration" => *digest == present.configuration,
                    "bench" | "tests" => *digest == present.bench,
                    "faults" => *digest == present.faults,
                    // Unknown here: its own command compares it.
                    _ => continue,
                };
                if !same {
                    changed.push(name.clone());
                }
            }
        }
        Some(Value::Null | Value::Bool(_) | Value::Number(_) | Value::Array(_)) | None => {
            changed.push("unknown: the record does not say of which sources it is".to_owned());
        }
    }
    Ok(changed)
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use serde_json::{Value, json};

    use super::{Sources, changed};

    #[test]
    fn a_record_is_fresh_only_with_the_digests_of_the_present_sources() -> Result<(), Box<dyn std::error::Error>> {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().ok_or("no root")?;
        let present = Sources::load(root)?;
        let fresh = json!({"shipped": present.shipped, "bench": present.bench, "other": "x"});
        assert_eq!(changed(root, Some(&fresh))?, Vec::<String>::new());
        assert_eq!(changed(root, Some(&Value::from(present.shipped.clone())))?, Vec::<String>::new());
        let old = json!({"shipped": "0", "bench": present.bench, "configuration": "0"});
        assert_eq!(changed(root, Some(&old))?, ["configuration", "shipped"]);
        assert_eq!(changed(root, Some(&Value::from("0")))?, ["the shipped sources"]);
        assert_eq!(changed(root, None)?.len(), 1, "a record that says nothing of its sources");
        Ok(())
    }
}
