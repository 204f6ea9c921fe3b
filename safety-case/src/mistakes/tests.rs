//! The whole run, on a small workspace and with a prover that reads instead of proving.

use std::fs;
use std::path::Path;
use std::time::Duration;

use super::{Outcome, Prover, Record, Request, Shard, run};
use crate::copy::Copy;
use crate::error::ToolError;
use crate::prove::{Harness, Tools, Verdict};

const SOURCE: &str = "fn first(a: u8) -> bool { a < 1 }\nfn second(a: u8) -> bool { a < 2 }\n";

/// A harness fails on what it is named after.
struct Reader;

impl Prover for Reader {
    fn compiles(&self, copy: &Copy) -> Result<Result<(), String>, ToolError> {
        let text = fs::read_to_string(copy.root().join("supervisor/core/src/lib.rs")).unwrap_or_default();
        Ok(if text.contains("missing") { Err("error: no such name".to_owned()) } else { Ok(()) })
    }
    fn verdict(
        &self,
        copy: &Copy,
        harness: &Harness,
        assertion: &str,
        _: Duration,
    ) -> Result<(Verdict, Option<Tools>), ToolError> {
        let text = fs::read_to_string(copy.root().join("supervisor/core/src/lib.rs")).unwrap_or_default();
        // Another assertion fails before the hidden one.
        let fails = harness.name == "finds_first" && text.contains("a <= 1") && assertion != "hidden";
        let slow = harness.name == "finds_first" && text.contains("a <= 2");
        let verdict = match (fails, slow) {
            (true, _) => Verdict::Failed("assertion".to_owned()),
            (false, true) => Verdict::Undetermined("time-out".to_owned()),
            (false, false) => Verdict::Proved,
        };
        Ok((verdict, None))
    }
}

fn write(root: &Path, file: &str, text: &str) {
    let path = root.join(file);
    let folder = path.parent().map_or(Ok(()), fs::create_dir_all);
    let done = folder.and_then(|()| fs::write(&path, text));
    assert!(done.is_ok(), "{done:?}");
}

fn mistake(name: &str, find: &str, replace: &str, harness: &str) -> String {
    format!(
        "[[mistake]]\nname = \"{name}\"\nwhat = \"w\"\nfile = \"supervisor/core/src/lib.rs\"\nfind = \"{find}\"\n\
         replace = \"{replace}\"\nharness = [{harness}]\nrequirements = []\n"
    )
}

fn workspace(root: &Path) {
    for package in ["terms", "observe", "perceive", "wire"] {
        write(root, &format!("supervisor/{package}/src/lib.rs"), "");
    }
    for file in ["Cargo.lock", "clippy.toml", "proofs/src/lib.rs"] {
        write(root, file, "");
    }
    write(root, "Cargo.toml", "[workspace]\nmembers = [\"proofs\", \"supervisor\"]\n");
    write(root, "supervisor/core/src/lib.rs", SOURCE);
    let harness = |name: &str| {
        format!(
            "[[harness]]\nname = \"{name}\"\npath = \"p\"\nfamily = \"f\"\nrequirements = []\nextent = \"exhaustive\"\n"
        )
    };
    write(root, "proofs/harnesses.toml", &(harness("finds_first") + &harness("finds_nothing")));
    write(root, "proofs/src/p.rs", "fn finds_first() {\n    assert!(hidden());\n}\n");
    let both = "\"finds_nothing\", \"finds_first\"";
    let list = "[drawn]\nseed = 1\ncount = 1\npackage = \"p\"\nwithin = 1\n".to_owned()
        + &mistake("one", "a < 1", "a <= 1", both)
        + "assertion = \"hidden\"\n"
        + &mistake("two", "a < 2", "a <= 2", both)
        + &mistake("three", "a < 2", "a < 3", both)
        + &mistake("four", "a < 2", "missing < 2", both);
    write(root, "proofs/mistakes.toml", &list);
}

fn request() -> Request {
    Request { names: Vec::new(), drawn: None, seed: None, shard: Shard::WHOLE, jobs: 2, again: false }
}

#[test]
fn a_mistake_is_caught_survives_or_is_none() {
    let Ok(folder) = tempfile::tempdir() else { unreachable!("there is a temporary folder") };
    let root = folder.path();
    workspace(root);
    let mut said = Vec::new();
    let done = run(root, &request(), &Reader, &mut |line: &str| said.push(line.to_owned()));
    assert!(done.is_ok(), "{done:?}");
    let record = Record::load(root).unwrap_or_default();
    let outcome = |name: &str| record.named.iter().find(|entry| entry.name == name).map(|entry| entry.outcome.clone());
    let harness = "finds_first".to_owned();
    let caught = Outcome::Caught { harness, check: "assertion".to_owned() };
    assert_eq!(outcome("one"), Some(caught));
    assert_eq!(outcome("two"), Some(Outcome::Undecided));
    assert_eq!(outcome("three"), Some(Outcome::Survived));
    assert!(matches!(outcome("four"), Some(Outcome::DoesNotCompile { .. })));
    let order: Vec<&str> = record.named.iter().map(|entry| entry.name.as_str()).collect();
    assert_eq!(order, ["one", "two", "three", "four"], "the order of the list, whichever ended first");
    assert_eq!(fs::read_to_string(root.join("supervisor/core/src/lib.rs")).unwrap_or_default(), SOURCE);
    assert_eq!(said.len(), 5, "{said:?}");

    said.clear();
    let again = run(root, &request(), &Reader, &mut |line: &str| said.push(line.to_owned()));
    assert!(again.is_ok() && said == ["0 to plant, 2 at a time"], "the record has them all: {said:?}");
}

#[test]
fn a_list_that_does_not_fit_the_sources_runs_nothing() {
    let Ok(folder) = tempfile::tempdir() else { unreachable!("there is a temporary folder") };
    let root = folder.path();
    workspace(root);
    write(root, "supervisor/core/src/lib.rs", "fn first(a: u8) -> bool { a < 1 }\n");
    let done = run(root, &request(), &Reader, &mut |_: &str| ());
    assert!(matches!(done, Err(ToolError::Arguments(_))), "{done:?}");
    assert!(!root.join("proofs/mistakes.json").exists());
}
