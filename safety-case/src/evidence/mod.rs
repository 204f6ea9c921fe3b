//! `supervise evidence`: everything that speaks for the supervisor, in one folder, and whether it still does.
//!
//! - [`records`]: the one list of what was run, each fresh, stale or not run; [`inventory`], [`versions`]: what it is made of;
//! - [`collect`]: all of it together, with what is open; [`page`]: for a browser; [`export`]: for other tools;
//! - [`figures`]: the tables of the documents that follow from the records; [`names`]: whether what is called evidence is there;
//! - [`findings`]: what fails the check; [`folder`]: the files, and the digest of each.
//!
//! Two runs on the same sources, records and machine give the same bytes, but for `run.json`.

pub mod export;
pub mod figures;
pub mod findings;
pub mod folder;
pub mod inventory;
pub mod names;
pub mod open;
pub mod page;
pub mod records;
pub mod tones;
pub mod versions;

use std::path::{Path, PathBuf};

use serde::Serialize;
use supervisor_tests::scenario::load;

use crate::analysis::{self, Analysis};
use crate::argument::{self, Argument};
use crate::drives::{self, Drive};
use crate::error::file;
use crate::simulate::{self, simulate};
use crate::trace::{Trace, trace};
use inventory::Inventory;
use open::Open;
use records::{Made, Standing, TestLog, standings};
use versions::Version;

/// What fails the check.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
pub struct Finding {
    /// Which check.
    pub check: &'static str,
    /// File, and entry or line.
    pub place: String,
    /// What is wrong.
    pub message: String,
}

impl Finding {
    pub(crate) fn new(check: &'static str, place: &str, message: String) -> Self {
        Self { check, place: place.to_owned(), message }
    }
}

impl std::fmt::Display for Finding {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}: {}: {}", self.check, self.place, self.message)
    }
}

/// What to collect.
#[derive(Clone, Debug, Default)]
pub struct Request {
    /// What `cargo test` printed; without it, `target/tests.log` if there is one.
    pub log: Option<PathBuf>,
    /// Where to replay the drives to, and to draw the scenarios; without it, neither is done.
    pub drives: Option<PathBuf>,
}

/// Everything.
#[derive(Debug)]
pub struct Collected {
    /// The safety analysis.
    pub analysis: Analysis,
    /// The argument.
    pub argument: Argument,
    /// From requirement to code, proof and test, and back.
    pub trace: Trace,
    /// How each record stands.
    pub standings: Vec<Standing>,
    /// What it is made of.
    pub inventory: Inventory,
    /// Tools of this machine.
    pub versions: Vec<Version>,
    /// The log of the tests, if one is at hand.
    pub log: Option<TestLog>,
    /// The drives that were replayed.
    pub drives: Option<Vec<Drive>>,
    /// What fails the check.
    pub findings: Vec<Finding>,
    /// What is open.
    pub open: Vec<Open>,
}

/// Collects it from the project at `root`, and says how far it is.
///
/// # Errors
/// Something is there and cannot be read; file and place are named.
pub fn collect(
    root: &Path,
    request: &Request,
    say: &mut dyn FnMut(&str),
) -> Result<Collected, Box<dyn std::error::Error>> {
    say("analysis and argument");
    let analysis = analysis::load(&root.join("safety-case/analysis"))?;
    let argument = argument::load(root)?;
    say("traceability");
    let trace = trace(root)?;
    let log = TestLog::find(root, request.log.as_deref())?;
    let drives = match &request.drives {
        Some(folder) => Some(drives::replayed(root, folder, &mut |told| say(&format!("drive: {}", first(told))))?),
        None => None,
    };
    if let Some(folder) = &request.drives {
        say("scenarios");
        let scenes =
            simulate(&load::all(&root.join("tests/scenarios"))?, &simulate::Request { seed: 1, ..Default::default() })?;
        let path = folder.join(records::SCENARIOS);
        std::fs::write(&path, simulate::page::page(&scenes, 1)?).map_err(|error| file(&path, error))?;
    }
    let made = Made { trace: &trace, log: log.as_ref(), drives: drives.as_deref() };
    let standings = standings(root, made, say)?;
    say("packages and tools");
    let inventory = Inventory::load(root)?;
    let versions = versions::versions(&analysis.tools);
    let mut collected = Collected {
        analysis,
        argument,
        trace,
        standings,
        inventory,
        versions,
        log,
        drives,
        findings: Vec::new(),
        open: Vec::new(),
    };
    say("checks");
    collected.findings = findings::findings(root, &collected)?;
    collected.open = open::open(&collected);
    Ok(collected)
}

fn first(text: &str) -> &str {
    text.lines().next().unwrap_or_default()
}
