//! Runs the compiler, the measured program and callgrind.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use serde_json::Value;

use super::{Call, CostError, calls, counts};

/// The programs, and what cargo is told beside what it must be.
#[derive(Clone, Debug)]
pub struct Tools {
    /// The workspace.
    pub root: PathBuf,
    /// cargo.
    pub cargo: String,
    /// rustc.
    pub rustc: String,
    /// More arguments for cargo.
    pub arguments: Vec<String>,
}

impl Tools {
    /// Those that run this program, or stand in the path.
    #[must_use]
    pub fn new(root: &Path, arguments: &[String]) -> Self {
        let named = |variable: &str, name: &str| std::env::var(variable).unwrap_or_else(|_| name.to_owned());
        Self {
            root: root.to_owned(),
            cargo: named("CARGO", "cargo"),
            rustc: named("RUSTC", "rustc"),
            arguments: arguments.to_vec(),
        }
    }

    /// A command of cargo, in the workspace; optimised across crates and as one unit, so that a count is that of the code and not of where it was cut.
    #[must_use]
    pub fn cargo(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(&self.cargo);
        command.current_dir(&self.root).args(arguments).args(&self.arguments);
        command.envs([("CARGO_PROFILE_RELEASE_LTO", "fat"), ("CARGO_PROFILE_RELEASE_CODEGEN_UNITS", "1")]);
        command
    }

    /// What `rustc` prints.
    ///
    /// # Errors
    /// If it fails.
    pub fn rustc(&self, arguments: &[&str]) -> Result<String, CostError> {
        let mut command = Command::new(&self.rustc);
        command.current_dir(&self.root).args(arguments);
        Ok(output(&mut command)?.trim().to_owned())
    }
}

/// Runs a command to its end; its standard output.
///
/// # Errors
/// If it does not start, or fails.
pub(super) fn output(command: &mut Command) -> Result<String, CostError> {
    let program = command.get_program().to_string_lossy().into_owned();
    let done = command.stdin(Stdio::null()).output();
    let done = done.map_err(|error| CostError::Start { program: program.clone(), error })?;
    if !done.status.success() {
        return Err(CostError::Failed { program, text: String::from_utf8_lossy(&done.stderr).into_owned() });
    }
    Ok(String::from_utf8_lossy(&done.stdout).into_owned())
}

/// Whether a program is there.
#[must_use]
pub fn has(program: impl AsRef<OsStr>) -> bool {
    let mut command = Command::new(program);
    command.arg("--version").stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    command.status().is_ok_and(|status| status.success())
}

/// What was measured.
#[derive(Clone, Debug)]
pub struct Measured {
    /// Every call.
    pub calls: Vec<Call>,
    /// Nanoseconds of the cheapest batch, per call: of this machine, now.
    pub nanoseconds: Vec<(String, f64)>,
    /// Where cargo builds.
    pub target: PathBuf,
}

/// Builds the measured program, runs it under callgrind, and once more on its own for the time.
///
/// # Errors
/// If anything fails.
pub fn measure(tools: &Tools) -> Result<Measured, CostError> {
    let program = build(tools)?;
    let target = program.ancestors().nth(3).unwrap_or(&tools.root).to_owned();
    let out = target.join("callgrind.out");
    // What an earlier run left would be read as this run's.
    if out.exists() {
        std::fs::remove_file(&out).map_err(|error| CostError::File { path: out.clone(), error })?;
    }
    let mut command = Command::new("valgrind");
    command.args(["--tool=callgrind", "--collect-atstart=no", "--combine-dumps=yes"]);
    command.args(["--toggle-collect=cost::measured", "--dump-after=cost::measured"]);
    command.arg(format!("--callgrind-out-file={}", out.display())).arg(&program);
    let labels = output(&mut command)?;
    let text = std::fs::read_to_string(&out).map_err(|error| CostError::File { path: out.clone(), error })?;
    let calls = calls(&labels, &counts(&text))?;
    let timed = output(Command::new(&program).arg("time"))?;
    Ok(Measured { calls, nanoseconds: nanoseconds(&timed), target })
}

fn build(tools: &Tools) -> Result<PathBuf, CostError> {
    let mut command = tools.cargo(&["build", "--release", "--quiet", "-p", "supervisor-tests", "--example", "cost"]);
    let text = output(command.arg("--message-format=json-render-diagnostics"))?;
    let messages = text.lines().filter_map(|line| serde_json::from_str::<Value>(line).ok());
    let named = |message: &Value| message.pointer("/target/name").and_then(Value::as_str) == Some("cost");
    let path = |message: Value| message.get("executable").and_then(Value::as_str).map(PathBuf::from);
    messages
        .filter(named)
        .find_map(path)
        .ok_or_else(|| CostError::Form("cargo has built no program named cost".to_owned()))
}

/// The dearest scenario of each stage.
fn nanoseconds(text: &str) -> Vec<(String, f64)> {
    let mut all: Vec<(String, f64)> = Vec::new();
    for line in text.lines() {
        let mut parts = line.split('\t').skip(1);
        let (Some(stage), Some(Ok(time))) = (parts.next(), parts.next().map(str::parse::<f64>)) else { continue };
        match all.iter_mut().find(|(name, _)| name == stage) {
            Some((_, greatest)) => *greatest = greatest.max(time),
            None => all.push((stage.to_owned(), time)),
        }
    }
    all
}
