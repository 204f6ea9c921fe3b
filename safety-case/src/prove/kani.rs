//! Runs `cargo kani`: one harness, on the workspace at any root.
//!
//! Each harness is an invocation of its own. Kani generates code for that harness alone and exports its result when it
//! ends, so the crash of one loses nothing of another. Two invocations at once need target directories of their own:
//! each would build what the other has just built.

use std::collections::BTreeSet;
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::harness::{Checks, Harness, Solver};
use super::judge::{Verdict, judge};
use super::raw::Raw;
use crate::error::{ToolError, file, form, read};

/// The package with the harnesses.
const PACKAGE: &str = "supervisor-proofs";
/// Names the sealed configuration for which `proofs` is built; see `proofs/build.rs`.
pub const CONFIGURATION: &str = "SUPERVISE_CONFIG";
/// So many lines of what Kani said stand in an error.
const TOLD: usize = 25;

/// How to run a harness, where that differs from what the list says.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// Another solver.
    pub solver: Option<Solver>,
    /// Another limit for the solver.
    pub timeout: Option<Duration>,
    /// Another package than that with the harnesses.
    pub package: Option<String>,
    /// A sealed configuration, an absolute path; without it, the default one.
    pub configuration: Option<PathBuf>,
    /// Decide nothing but the assertions of the harness whose text contains this: for one who looks for a failure. It
    /// proves nothing, for no cover is decided.
    pub assertion: Option<String>,
}

/// What a run of one harness came to.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// The verdict.
    pub verdict: Verdict,
    /// Checks decided, without covers.
    pub checks: usize,
    /// Covers.
    pub covers: usize,
    /// How long it took, compilation included.
    pub seconds: u64,
    /// The solver that decided.
    pub solver: Solver,
    /// Versions of the tools.
    pub tools: Tools,
    /// What Kani exported, without the machine it ran on.
    pub raw: Raw,
}

/// Versions of the tools.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Tools {
    /// Kani.
    pub kani: String,
    /// Its compiler.
    pub rustc: String,
    /// CBMC.
    pub cbmc: String,
    /// The solver, where it is a program of its own.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub solver: String,
}

impl Tools {
    fn of(export: &Value) -> Self {
        let text = |at: &str| export.pointer(at).and_then(Value::as_str).unwrap_or("").to_owned();
        Self {
            kani: text("/tools/kani"),
            rustc: text("/tools/rustc"),
            cbmc: text("/tools/cbmc"),
            solver: text("/tools/solvers/0/version"),
        }
    }
}

/// Whether `cargo kani` is there.
#[must_use]
pub fn available() -> bool {
    let mut command = Command::new("cargo");
    command.args(["kani", "--version"]).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    command.status().is_ok_and(|status| status.success())
}

/// Runs one harness on the workspace at `root`; what is built, exported and said goes to `target`.
///
/// A time-out, a failed check and a vacuous proof are verdicts. Sources that do not compile are an error: a mistake
/// that the compiler finds was not found by a proof.
///
/// # Errors
/// A file or the tool fails, or Kani exports nothing for this harness.
pub fn verify(root: &Path, target: &Path, harness: &Harness, options: &Options) -> Result<Outcome, ToolError> {
    let solver = options.solver.unwrap_or(harness.solver);
    fs::create_dir_all(target).map_err(|error| file(target, error))?;
    let export = target.join(format!("{}.json", harness.name));
    // An old export would be read as this run's: it goes first.
    if export.exists() {
        fs::remove_file(&export).map_err(|error| file(&export, error))?;
    }
    let mut command = command(root, target, options.package.as_deref(), options.configuration.as_deref());
    select(&mut command, harness, options);
    command.args(["--output-format", "terse", "--export-json"]).arg(&export);
    let started = Instant::now();
    restrict(&mut command, root, target, harness, options)?;
    let log = run(&mut command, &target.join(format!("{}.log", harness.name)))?;
    let seconds = started.elapsed().as_secs();
    if !export.exists() {
        return Err(ToolError::NoResult { harness: harness.name.clone(), log: end(&read(&log)?) });
    }
    let json: Value = serde_json::from_str(&read(&export)?).map_err(|error| form(&export, &error))?;
    let raw = Raw::of(&json, root);
    let json = raw.export().map_err(|error| form(&export, &error))?;
    let id = harness.id();
    let Some((checks, covers)) = counts(&json, &id) else {
        return Err(ToolError::NoResult { harness: harness.name.clone(), log: end(&read(&log)?) });
    };
    Ok(Outcome { verdict: judge(&json, &id), checks, covers, seconds, solver, tools: Tools::of(&json), raw })
}

/// Which checks Kani has CBMC make.
const CHECKS: [&str; 6] = [
    "--no-malloc-may-fail",
    "--no-undefined-shift-check",
    "--no-signed-overflow-check",
    "--nan-check",
    "--no-self-loops-to-assumptions",
    "--no-pointer-primitive-check",
];

/// Leaves a harness of [`Checks::Own`] its own checks. Goes last: Kani hands on whatever follows to CBMC.
fn restrict(
    command: &mut Command,
    root: &Path,
    target: &Path,
    harness: &Harness,
    options: &Options,
) -> Result<(), ToolError> {
    if harness.checks == Checks::Own || options.assertion.is_some() {
        command.arg("--cbmc-args");
        for name in own(root, target, harness, options)? {
            command.args(["--property", &name]);
        }
    }
    Ok(())
}

/// The names of the checks that a harness of [`Checks::Own`] decides: what stands in this package, and the bound of
/// every loop, without which a proof would be one of the first few rounds only.
fn own(root: &Path, target: &Path, harness: &Harness, options: &Options) -> Result<Vec<String>, ToolError> {
    let mut command = command(root, target, options.package.as_deref(), options.configuration.as_deref());
    select(&mut command, harness, options);
    let log = run(command.arg("--only-codegen"), &target.join(format!("{}-codegen.log", harness.name)))?;
    let none = |log: String| ToolError::NoResult { harness: harness.name.clone(), log };
    let Some(program) = program(target, &harness.name) else { return Err(none(end(&read(&log)?))) };
    let mut command = Command::new(cbmc());
    // As Kani calls it: a check that only CBMC's own defaults make is unknown where Kani makes none, and naming it ends the run.
    command.args(CHECKS).args(["--object-bits", "16", "--show-properties", "--json-ui"]).arg(&program);
    let said = command.stdin(Stdio::null()).stderr(Stdio::null()).output().map_err(ToolError::start("cargo"))?;
    let json: Value = serde_json::from_slice(&said.stdout).map_err(|error| none(format!("cbmc: {error}")))?;
    let listed = json.as_array().into_iter().flatten().filter_map(|item| item.get("properties")?.as_array());
    let chosen = |property: &&Value| {
        let text = |key: &str| property.get(key).and_then(Value::as_str).unwrap_or("");
        match &options.assertion {
            None => is_own(text("name")),
            Some(wanted) => is_assertion(text("name")) && text("description").contains(wanted.as_str()),
        }
    };
    let names = listed.flatten().filter(chosen).filter_map(|property| property.get("name")?.as_str());
    let names: Vec<String> = names.map(str::to_owned).collect();
    if names.is_empty() { Err(none("cbmc lists no check of this harness".to_owned())) } else { Ok(names) }
}

/// Whether a check stands in the package with the harnesses, or bounds a loop. That package forbids unsafe code: its pointers
/// are the compiler's matter.
fn is_own(name: &str) -> bool {
    let package = name.starts_with("harness::") || name.starts_with("properties::");
    package && !name.contains(".pointer_dereference.") || name.contains(".unwind.")
}

/// Whether it is an assertion that a harness makes of the shipped code; those of the functions that stand in for
/// arithmetic are about the proof.
fn is_assertion(name: &str) -> bool {
    name.starts_with("harness::") && !name.starts_with("harness::uninterpreted") && name.contains(".assertion.")
}

/// The program that Kani linked last for a harness.
fn program(target: &Path, name: &str) -> Option<PathBuf> {
    let ends = format!("{}{name}.out", name.len());
    let files = walkdir::WalkDir::new(target.join("kani")).into_iter().filter_map(Result::ok);
    let linked = files.filter(|entry| entry.file_name().to_str().is_some_and(|file| file.ends_with(&ends)));
    linked.max_by_key(|entry| entry.metadata().ok().and_then(|of| of.modified().ok())).map(walkdir::DirEntry::into_path)
}

/// CBMC: on the path, or where `cargo kani setup` puts it.
fn cbmc() -> PathBuf {
    let named = |folder: PathBuf| Some(folder.join("cbmc")).filter(|program| program.is_file());
    let on_path = std::env::var_os("PATH").and_then(|path| std::env::split_paths(&path).find_map(named));
    let home = std::env::var_os("KANI_HOME").map(PathBuf::from);
    let home = home.or_else(|| std::env::var_os("HOME").map(|home| PathBuf::from(home).join(".kani")));
    let beside = || {
        let kanis = fs::read_dir(home?).ok()?.filter_map(Result::ok);
        kanis.filter_map(|entry| named(entry.path().join("bin"))).max()
    };
    on_path.or_else(beside).unwrap_or_else(|| PathBuf::from("cbmc"))
}

/// Compiles every harness; the names of those that Kani knows.
///
/// # Errors
/// A file or the tool fails, or the sources do not compile.
pub fn compile(root: &Path, target: &Path, options: &Options) -> Result<BTreeSet<String>, ToolError> {
    fs::create_dir_all(target).map_err(|error| file(target, error))?;
    // Kani writes its list into the folder it runs in.
    let list = target.join("kani-list.json");
    if list.exists() {
        fs::remove_file(&list).map_err(|error| file(&list, error))?;
    }
    let mut command = command(root, target, options.package.as_deref(), options.configuration.as_deref());
    command.current_dir(target).arg("--manifest-path").arg(root.join("Cargo.toml"));
    let log = run(command.args(["list", "--format", "json", "-Z", "stubbing"]), &target.join("kani-list.log"))?;
    if !list.exists() {
        return Err(ToolError::NoResult { harness: "the list of harnesses".to_owned(), log: end(&read(&log)?) });
    }
    let json: Value = serde_json::from_str(&read(&list)?).map_err(|error| form(&list, &error))?;
    let kinds = ["standard-harnesses", "contract-harnesses"];
    let files =
        kinds.iter().filter_map(|kind| json.get(kind).and_then(Value::as_object)).flat_map(|files| files.values());
    Ok(files.filter_map(Value::as_array).flatten().filter_map(Value::as_str).map(str::to_owned).collect())
}

/// Runs a harness that fails once more, for the counterexample; the tests that Kani makes of it, each one a function to
/// paste beside the harness. Empty if it fails no check that a test could show.
///
/// # Errors
/// A file or the tool fails.
pub fn playback(root: &Path, target: &Path, harness: &Harness, options: &Options) -> Result<Vec<String>, ToolError> {
    fs::create_dir_all(target).map_err(|error| file(target, error))?;
    let mut command = command(root, target, options.package.as_deref(), options.configuration.as_deref());
    select(&mut command, harness, options);
    command.args(["-Z", "concrete-playback", "--concrete-playback=print"]);
    restrict(&mut command, root, target, harness, options)?;
    let log = run(&mut command, &target.join(format!("{}-playback.log", harness.name)))?;
    Ok(tests_in(&read(&log)?))
}

/// The tests that Kani printed, without those that only show how a cover is reached.
fn tests_in(log: &str) -> Vec<String> {
    let fenced = log.split("```").skip(1).step_by(2);
    let tests =
        fenced.map(str::trim).filter(|test| test.contains("#[test]") && !test.contains("/// Check for `cover`"));
    tests.map(str::to_owned).collect()
}

/// `cargo kani` for the package with the harnesses.
fn command(root: &Path, target: &Path, package: Option<&str>, configuration: Option<&Path>) -> Command {
    let mut command = Command::new("cargo");
    command.current_dir(root).args(["kani", "-p", package.unwrap_or(PACKAGE), "--target-dir"]).arg(target);
    // Kani refuses sources with a stub in any of their harnesses without it, also where another one runs.
    command.args(["-Z", "stubbing"]);
    match configuration {
        Some(file) => command.env(CONFIGURATION, file),
        None => command.env_remove(CONFIGURATION),
    };
    command
}

/// Chooses the harness and how it is decided.
fn select(command: &mut Command, harness: &Harness, options: &Options) {
    let solver = options.solver.unwrap_or(harness.solver);
    let timeout = options.timeout.unwrap_or(Duration::from_secs(harness.timeout));
    command.args(["--exact", "--harness", &harness.id(), "-Z", "unstable-options"]);
    command.args(["--solver", &solver.to_string(), "--harness-timeout", &format!("{}s", timeout.as_secs())]);
    if !harness.reach_checks {
        command.arg("--no-assertion-reach-checks");
    }
}

/// Runs it; everything it says goes to `log`.
fn run(command: &mut Command, log: &Path) -> Result<PathBuf, ToolError> {
    let said = File::create(log).map_err(|error| file(log, error))?;
    let too = said.try_clone().map_err(|error| file(log, error))?;
    command.stdin(Stdio::null()).stdout(said).stderr(too);
    command.status().map_err(ToolError::start("cargo"))?;
    Ok(log.to_owned())
}

/// The last lines.
fn end(log: &str) -> String {
    let lines: Vec<&str> = log.lines().collect();
    let skip = lines.len().saturating_sub(TOLD);
    lines.into_iter().skip(skip).collect::<Vec<_>>().join("\n")
}

/// How many checks and covers the result of a harness has.
#[must_use]
pub fn counts(export: &Value, harness: &str) -> Option<(usize, usize)> {
    let results = export.pointer("/verification_results/results").and_then(Value::as_array)?;
    let named = |result: &&Value| result.get("harness_id").and_then(Value::as_str) == Some(harness);
    let checks = results.iter().find(named)?.get("checks").and_then(Value::as_array)?;
    let is_cover = |check: &&Value| check.get("category").and_then(Value::as_str) == Some("cover");
    let covers = checks.iter().filter(is_cover).count();
    Some((checks.len().saturating_sub(covers), covers))
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn own_are_the_checks_of_the_package_and_the_bounds_of_loops() {
        assert!(is_own("harness::parking::seat_4_x.assertion.1"));
        assert!(is_own("properties::parking::seat_4_y.overflow.3"));
        assert!(!is_own("properties::parking::seat_4_y.pointer_dereference.3"));
        assert!(is_own("core::iter::Iterator::all.unwind.0"));
        assert!(!is_own("supervisor_core::decide::decide.assertion.1"));
    }

    #[test]
    fn assertions_are_those_of_harnesses() {
        assert!(is_assertion("harness::parking::seat_4_x.assertion.1"));
        assert!(!is_assertion("harness::parking::seat_4_x.cover.1"));
        assert!(!is_assertion("harness::uninterpreted::portion.assertion.1"));
        assert!(!is_assertion("supervisor_core::decide::decide.assertion.1"));
    }

    #[test]
    fn covers_are_counted_apart() {
        let check = |category: &str| json!({"category": category});
        let checks = [check("assertion"), check("cover"), check("overflow")];
        let export = json!({"verification_results": {"results": [{"harness_id": "h", "checks": checks}]}});
        assert_eq!(counts(&export, "h"), Some((2, 1)));
        assert_eq!(counts(&export, "other"), None);
    }

    #[test]
    fn only_tests_of_failed_checks_are_counterexamples() {
        let test = |kind: &str| {
            format!(
                "Concrete playback unit test for `h`:\n```\n/// Check for `{kind}`: \"d\"\n#[test]\nfn t() {{}}\n```\n"
            )
        };
        let log = format!("said\n{}between\n{}end\n", test("cover"), test("assertion"));
        assert_eq!(tests_in(&log), ["/// Check for `assertion`: \"d\"\n#[test]\nfn t() {}"]);
        assert!(tests_in("nothing").is_empty());
    }
}
