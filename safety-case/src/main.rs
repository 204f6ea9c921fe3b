//! The host program `supervise`.

use std::process::ExitCode;

use clap::Parser;
use safety_case::cli::Cli;
use safety_case::commands;

fn main() -> ExitCode {
    commands::run(&Cli::parse())
}
