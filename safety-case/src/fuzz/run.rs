//! Runs the targets, side by side.

use std::collections::BTreeSet;
use std::fs;
use std::io::{BufRead, BufReader, Write};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::{Mutex, PoisonError};
use std::time::Instant;

use super::log::Heard;
use super::record::Target;
use crate::error::{ToolError, file};
use crate::spread::as_it_comes;

/// Targets whose bytes are text.
const PARSERS: [&str; 2] = ["candump_log", "dbc_map"];

/// What to run.
#[derive(Clone, Debug)]
pub struct Request {
    /// Which targets.
    pub targets: Vec<String>,
    /// Each for so long, s.
    pub seconds: u64,
    /// Where libFuzzer's random numbers begin.
    pub seed: u64,
    /// How many run at once.
    pub jobs: usize,
}

/// Whether cargo-fuzz and a nightly compiler are there.
#[must_use]
pub fn available() -> bool {
    let silent =
        |command: &mut Command| command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null()).status();
    silent(Command::new("cargo").args(["+nightly", "fuzz", "--version"])).is_ok_and(|status| status.success())
}

/// `cargo fuzz` on an optimised target without a sanitizer of memory: what is fuzzed has no `unsafe`, and a sanitizer costs most of the
/// speed. So would looking at every comparison of a target that steps: its bytes are choices and never stand in a comparison. A
/// parser compares its bytes with words.
fn cargo_fuzz(root: &Path, command: &str, target: &str) -> Command {
    let mut cargo = Command::new("cargo");
    cargo.current_dir(root.join("fuzz")).args(["+nightly", "fuzz", command, "--release", "--sanitizer", "none"]);
    if !PARSERS.contains(&target) {
        // Other flags would build the same files again each time, so they have a folder of their own.
        cargo.args(["--no-trace-compares", "--target-dir", "target/choices"]);
    }
    cargo.arg(target).stdin(Stdio::null());
    cargo
}

/// Builds and runs what is asked for; tells `say` how far it is. What is found is made small and put into the corpus.
///
/// # Errors
/// The targets do not compile, cargo-fuzz does not start, or a file cannot be read or written.
pub fn run(root: &Path, request: &Request, say: &mut dyn FnMut(&str)) -> Result<Vec<Target>, ToolError> {
    say("building the targets, some minutes");
    for target in &request.targets {
        let built = cargo_fuzz(root, "build", target).output().map_err(ToolError::start("cargo"))?;
        if !built.status.success() {
            let text = String::from_utf8_lossy(&built.stderr);
            return Err(ToolError::Arguments(format!("{target} does not compile:\n{text}")));
        }
    }
    let work: Vec<(&str, Mutex<Heard>)> =
        request.targets.iter().map(|name| (name.as_str(), Mutex::default())).collect();
    let (mut done, began) = (Vec::new(), Instant::now());
    let each = |(target, heard): &(&str, Mutex<Heard>)| fuzz(root, target, request, heard);
    as_it_comes(work.iter(), request.jobs, each, |result| {
        let Some(result) = result else {
            say(&format!("{} min; {}", began.elapsed().as_secs() / 60, progress(root, &work)));
            return Ok(());
        };
        let target: Target = result?;
        say(&format!("{}: done, {} inputs, {} cycles", target.target, target.inputs, target.cycles));
        done.push(target);
        Ok::<(), ToolError>(())
    })?;
    done.sort_by_key(|done| request.targets.iter().position(|target| *target == done.target));
    Ok(done)
}

/// How far the targets are that run or have run.
fn progress(root: &Path, work: &[(&str, Mutex<Heard>)]) -> String {
    let told = work.iter().filter_map(|(target, heard)| {
        let heard = *heard.lock().unwrap_or_else(PoisonError::into_inner);
        let cycles = cycles(&tally(root, target));
        (heard.edges > 0)
            .then(|| format!("{target} {cycles} cycles, {} edges, last new one at {} s", heard.edges, heard.grew))
    });
    told.collect::<Vec<_>>().join("; ")
}

/// What grows while it is fuzzed; not committed.
fn grown(root: &Path) -> PathBuf {
    root.join("fuzz/target/grown")
}

/// Where a target counts its cycles.
fn tally(root: &Path, target: &str) -> PathBuf {
    grown(root).join(format!("{target}.cycles"))
}

fn cycles(tally: &Path) -> u64 {
    fs::read_to_string(tally).ok().and_then(|text| text.trim().parse().ok()).unwrap_or(0)
}

/// Inputs that libFuzzer kept because something broke.
fn artifacts(folder: &Path) -> BTreeSet<PathBuf> {
    let broke = |path: &PathBuf| {
        let name = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
        ["crash-", "oom-", "timeout-"].iter().any(|kind| name.starts_with(kind))
    };
    fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path()).filter(broke).collect()
}

/// One target, until its time is over or something breaks.
fn fuzz(root: &Path, target: &str, request: &Request, heard: &Mutex<Heard>) -> Result<Target, ToolError> {
    let (grown, artifact_folder) = (grown(root), root.join("fuzz/artifacts").join(target));
    for folder in [grown.join(target), artifact_folder.clone()] {
        fs::create_dir_all(&folder).map_err(|error| file(&folder, error))?;
    }
    let (tally, before) = (tally(root, target), artifacts(&artifact_folder));
    if tally.exists() {
        fs::remove_file(&tally).map_err(|error| file(&tally, error))?;
    }
    let log = grown.join(format!("{target}.log"));
    let mut kept = fs::File::create(&log).map_err(|error| file(&log, error))?;
    let mut command = cargo_fuzz(root, "run", target);
    // What it finds new goes to the first folder; the committed corpus is only read.
    command.arg(grown.join(target)).arg(root.join("fuzz/corpus").join(target)).arg("--");
    command.arg(format!("-max_total_time={}", request.seconds)).arg(format!("-seed={}", request.seed));
    command.arg("-print_final_stats=1");
    let dictionary = root.join("fuzz/dictionaries").join(target);
    if dictionary.exists() {
        command.arg(format!("-dict={}", dictionary.display()));
    }
    let began = Instant::now();
    let mut child = command
        .env("TALLY", &tally)
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .map_err(ToolError::start("cargo"))?;
    for line in child.stderr.take().map(|stderr| BufReader::new(stderr).split(b'\n')).into_iter().flatten() {
        let line = line.map_err(|error| file(&log, error))?;
        let said = kept.write_all(&line).and_then(|()| kept.write_all(b"\n"));
        said.map_err(|error| file(&log, error))?;
        let mut heard = heard.lock().unwrap_or_else(PoisonError::into_inner);
        heard.line(&String::from_utf8_lossy(&line), began.elapsed().as_secs());
    }
    child.wait().map_err(ToolError::start("cargo"))?;
    let (heard, second) = (*heard.lock().unwrap_or_else(PoisonError::into_inner), began.elapsed().as_secs());
    let [seconds, read_seconds, quiet_seconds] = heard.times(second);
    let found: Vec<PathBuf> = artifacts(&artifact_folder).difference(&before).cloned().collect();
    if heard.inputs.is_none() && found.is_empty() {
        return Err(ToolError::Arguments(format!("{target} ended before its time, see {}", log.display())));
    }
    for artifact in &found {
        keep(root, target, artifact)?;
    }
    Ok(Target {
        target: target.to_owned(),
        inputs: heard.inputs.unwrap_or(0),
        cycles: cycles(&tally),
        seconds,
        read_seconds,
        edges: heard.edges,
        quiet_seconds,
        found: u64::try_from(found.len()).unwrap_or(u64::MAX),
    })
}

/// Makes an input small that breaks something, and puts it into the committed corpus.
fn keep(root: &Path, target: &str, artifact: &Path) -> Result<(), ToolError> {
    let folder = artifact.parent().unwrap_or(artifact);
    let minimized = || -> BTreeSet<PathBuf> {
        let small = |path: &PathBuf| path.to_string_lossy().contains("minimized-from-");
        fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path()).filter(small).collect()
    };
    let before = minimized();
    // Where it cannot be made smaller it stays as it is.
    let _ended = cargo_fuzz(root, "tmin", target).arg(artifact).args(["--runs", "10000"]).output();
    let size = |path: &PathBuf| fs::metadata(path).map_or(u64::MAX, |data| data.len());
    let smallest = minimized().difference(&before).min_by_key(|path| size(path)).cloned();
    let name = artifact.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    let kept = root.join("fuzz/corpus").join(target).join(format!("regression-{name}"));
    fs::copy(smallest.as_deref().unwrap_or(artifact), &kept).map_err(|error| file(&kept, error))?;
    Ok(())
}
