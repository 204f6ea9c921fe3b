//! What is not committed: the log of the tests, the explorations, the drives. It says "not run" unless a run is at hand.

use std::path::Path;

use serde_json::Value;

use super::{Made, Standing, State, TestLog, older_than_sources};
use crate::drives::Drive;
use crate::error::{ToolError, form, read};

/// What the tests are made of.
const TESTED: [&str; 4] = ["supervisor", "tests", "proofs", "safety-case/src"];

/// Fresh unless a source is newer.
fn by_age(root: &Path, path: &Path, folders: &[&str]) -> Result<State, ToolError> {
    let older = older_than_sources(root, path, folders)?;
    Ok(State::of(if older { vec!["a source, by its time".to_owned()] } else { Vec::new() }))
}

pub(super) fn tests(root: &Path, made: Made<'_>) -> Result<Standing, ToolError> {
    let mut standing = Standing::new(
        "tests",
        "Tests",
        super::LOG,
        "cargo test 2>&1 | tee target/tests.log",
        "More than the inputs that they give; and that the tags are right.",
    );
    let scan = &made.trace.scan;
    standing.page = Some("tests.xml".to_owned());
    standing.figure("tests", scan.tests.len(), "test functions in the sources");
    standing.figure(
        "tagged",
        scan.tests.iter().filter(|test| test.tagged).count(),
        "with the requirements that they test",
    );
    let Some(log) = made.log else { return Ok(standing) };
    standing.state = by_age(root, &log.path, &TESTED)?;
    let [passed, failed, ignored] = log.counts();
    standing.figure("passed", passed, "passed in the log");
    standing.figure("failed", failed, "failed in the log");
    standing.figure("ignored", ignored, "left out in the log");
    if failed > 0 {
        standing.open.push(format!("{failed} tests failed"));
    }
    let missing = unseen(made, log);
    if missing > 0 {
        standing.open.push(format!("{missing} test functions of the sources do not stand in the log"));
    }
    Ok(standing)
}

/// Tests of the workspace that the log does not show.
fn unseen(made: Made<'_>, log: &TestLog) -> usize {
    let of_workspace = |file: &str| !file.starts_with("fuzz/") && !file.starts_with("proofs/creusot/");
    let tests = made.trace.scan.tests.iter().filter(|test| of_workspace(&test.place.file));
    tests.filter(|test| log.of(&test.place.file, &test.place.item).is_none()).count()
}

pub(super) fn exploration(root: &Path) -> Result<Standing, ToolError> {
    const FOLDER: &str = "target/exploration";
    let mut standing = Standing::new(
        "exploration",
        "Exhaustive exploration of three slices",
        FOLDER,
        "cargo test -p supervisor-proofs --test explore",
        "Inputs beside the listed vectors, timers at their true length, slices together.",
    );
    let (mut states, mut transitions, mut slices) = (0_u64, 0_u64, 0_u64);
    let mut state = State::NotRun;
    for slice in ["seat", "collision", "drive"] {
        let path = root.join(FOLDER).join(format!("{slice}.json"));
        if !path.exists() {
            standing.open.push(format!("no run of the slice {slice} is at hand"));
            continue;
        }
        let record: Value = serde_json::from_str(&read(&path)?).map_err(|error| form(&path, &error))?;
        let number = |name: &str| record.get(name).and_then(Value::as_u64).unwrap_or(0);
        states = states.saturating_add(number("states"));
        transitions = transitions.saturating_add(number("transitions"));
        slices = slices.saturating_add(1);
        let next = by_age(root, &path, &["supervisor", "proofs"])?;
        state = if matches!(state, State::Stale { .. }) { state } else { next };
    }
    if slices > 0 {
        standing.state = state;
        standing.figure("slices", slices, "slices explored without a finding");
        standing.figure("states", states, "states");
        standing.figure("transitions", transitions, "transitions");
    } else {
        standing.open.clear();
    }
    Ok(standing)
}

pub(super) fn drives(drives: Option<&[Drive]>) -> Standing {
    let mut standing = Standing::new(
        "drives",
        "Shipped drives, replayed",
        "tests/drives",
        "supervise",
        "A vehicle. They are drives of the model, over the real link.",
    );
    let Some(drives) = drives else { return standing };
    standing.state = State::Fresh;
    standing.page = Some("drives/index.html".to_owned());
    let correct = drives.iter().filter(|drive| drive.name.ends_with("-correct"));
    let disturbed: u64 = correct.clone().map(|drive| drive.interventions).sum();
    standing.figure("drives", drives.len(), "drives");
    standing.figure("correct", correct.count(), "of these with a correct main controller");
    standing.figure("disturbed", disturbed, "interventions in those");
    standing.figure(
        "same",
        drives.iter().filter(|drive| drive.same).count(),
        "with every verdict as in the simulation that made it",
    );
    if disturbed > 0 {
        standing.open.push(format!("{disturbed} interventions in drives with a correct main controller"));
    }
    for drive in drives.iter().filter(|drive| !drive.same) {
        standing.open.push(format!("{}: the verdicts are not those of the simulation that made it", drive.name));
    }
    standing
}
