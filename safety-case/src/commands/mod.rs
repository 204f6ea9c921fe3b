//! The commands of `supervise`: they print, and say with which exit code to end.

mod analysis;
mod config;
mod cost;
mod coverage;
mod drives;
mod inject;
mod limits;
mod mistakes;
mod mutants;
mod prove;
mod replay;
mod trace;

use std::fmt::Display;
use std::io::{self, Write};
use std::process::ExitCode;

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
        Some(Command::Mutants(arguments)) => mutants::run(arguments),
        Some(Command::Trace(arguments)) => trace::run(arguments),
        Some(Command::Cost(arguments)) => cost::run(arguments),
        Some(Command::Inject(arguments)) => inject::run(arguments),
        Some(Command::Coverage(arguments)) => coverage::run(arguments),
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

/// Prints to the standard output.
fn print(text: impl Display) -> io::Result<()> {
    let mut out = io::stdout().lock();
    write!(out, "{text}")?;
    out.flush()
}
