//! The command line of `coverage`.

use std::path::PathBuf;

use clap::Args;

pub(super) const ABOUT: &str = "\
Measures which statements, branches and conditions of the decision the tests reach.

Instruments a copy of the sources, runs the tests of the step in it, and reports statement, branch and MC/DC coverage (by \
masking) of each file. A whole run writes safety-case/records/coverage.json.

Exit codes: 0 everything is covered or listed; 1 something is open that safety-case/analysis/coverage-open.toml does not list, \
or is listed there and covered, or the record is stale; 2 something cannot be read, built or passed.";

/// Arguments of `coverage`.
#[derive(Debug, Args)]
pub struct Coverage {
    /// Write the figures, every decision and the vectors seen of it as JSON
    #[arg(long, value_name = "FILE")]
    pub json: Option<PathBuf>,
    /// Write the sources with what is open in them as one page that works offline
    #[arg(long, value_name = "FILE")]
    pub html: Option<PathBuf>,
    /// Run nothing: show the record, and whether it is stale or does not agree with the list
    #[arg(long, conflicts_with_all = ["json", "html", "test"])]
    pub check: bool,
    /// Only these test programs; writes no record
    #[arg(long, value_name = "NAME", num_args = 1..)]
    pub test: Vec<String>,
    /// Run again what has passed in the same copy before
    #[arg(long, conflicts_with = "check")]
    pub again: bool,
}
