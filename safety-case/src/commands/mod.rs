//! The commands of `supervise`: they print, and say with which exit code to end.

mod analysis;
mod config;
mod cost;
mod coverage;
mod disturb;
mod drives;
mod evidence;
mod fuzz;
mod hold;
mod inject;
mod limits;
mod mistakes;
mod mutants;
mod prove;
mod replay;
mod simulate;
mod trace;

use std::fmt::Display;
use std::fs;
use std::io::{self, Write};
use std::path::Path;
use std::process::ExitCode;

use crate::built::fingerprint;
use crate::cli::{Cli, Command};

/// The analysis or the traceability has findings, or a harness is not proved.
pub const FINDINGS: u8 = 1;
/// Bad arguments, files, mapping or configuration.
pub const BAD: u8 = 2;
/// The supervisor intervened, and `--fail-on-intervention` was given.
pub const INTERVENED: u8 = 3;
/// A tool is missing, so nothing was measured.
pub const NOT_RUN: u8 = 4;

/// What a command came to: an exit code, or what was bad.
pub type Outcome = Result<u8, Box<dyn std::error::Error>>;

/// Runs the command.
#[must_use]
pub fn run(cli: &Cli) -> ExitCode {
    let outcome = match &cli.command {
        None => drives::run(),
        Some(Command::Replay(arguments)) => replay::run(arguments),
        Some(Command::Limits(arguments)) => limits::run(arguments),
        Some(Command::Config(command)) => config::run(command),
        Some(Command::Analysis(arguments)) => analysis::run(arguments),
        Some(Command::Prove(arguments)) => prove::run(arguments),
        Some(Command::Mistakes(arguments)) => mistakes::run(arguments),
        Some(Command::Fuzz(arguments)) => fuzz::run(arguments),
        Some(Command::Mutants(arguments)) => mutants::run(arguments),
        Some(Command::Trace(arguments)) => trace::run(arguments),
        Some(Command::Cost(arguments)) => cost::run(arguments),
        Some(Command::Inject(arguments)) => inject::run(arguments),
        Some(Command::Simulate(arguments)) => simulate::run(arguments),
        Some(Command::Disturb(arguments)) => disturb::run(arguments),
        Some(Command::Coverage(arguments)) => coverage::run(arguments),
        Some(Command::Evidence(arguments)) => evidence::run(arguments),
    };
    match outcome {
        Ok(code) => ExitCode::from(code),
        // Whoever reads our output has read enough.
        Err(error) if is_broken_pipe(error.as_ref()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("supervise: {error}");
            ExitCode::from(BAD)
        }
    }
}

fn is_broken_pipe(error: &(dyn std::error::Error + 'static)) -> bool {
    error.downcast_ref::<io::Error>().is_some_and(|error| error.kind() == io::ErrorKind::BrokenPipe)
}

/// The root of the workspace.
fn root() -> Result<&'static Path, &'static str> {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().ok_or("the workspace has no folder")
}

/// The root of the workspace, for what records a behaviour that is built into this program.
fn built_root() -> Result<&'static Path, String> {
    let root = root()?;
    match fingerprint(root) {
        Ok(present) if present == env!("BUILT_FROM") => Ok(root),
        Ok(_) => Err(
            "this program was built from other sources than those that are here: `cargo run --release` builds it anew"
                .to_owned(),
        ),
        Err(error) => Err(format!("{}: the sources cannot be read: {error}", root.display())),
    }
}

/// Writes a file, and its folder if there is none.
fn write(path: &Path, text: &str) -> Result<(), String> {
    let folder = path.parent().map_or(Ok(()), fs::create_dir_all);
    folder.and_then(|()| fs::write(path, text)).map_err(|error| format!("{}: {error}", path.display()))
}

/// Does something long that tells how far it is, and prints what it tells, line by line.
fn telling<T, E: std::error::Error + 'static>(
    work: impl FnOnce(&mut dyn FnMut(&str)) -> Result<T, E>,
) -> Result<T, Box<dyn std::error::Error>> {
    let mut failure = None;
    let done = work(&mut |line| {
        if let Err(error) = print(format_args!("{line}\n")) {
            failure = Some(error);
        }
    })?;
    failure.map_or(Ok(done), |error| Err(error.into()))
}

/// Prints to the standard output.
fn print(text: impl Display) -> io::Result<()> {
    let mut out = io::stdout().lock();
    write!(out, "{text}")?;
    out.flush()
}
