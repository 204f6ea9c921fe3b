//! What the proofs say of one mistake.

use std::time::{Duration, Instant};

use super::record::{Outcome, Tried};
use super::run::Task;
use crate::copy::Copy;
use crate::error::ToolError;
use crate::prove::{Harness, Options, Tools, Verdict, verify};

/// The package with the harnesses.
const PACKAGE: &str = "supervisor-proofs";

/// Runs a harness on a copy with a mistake in it.
pub trait Prover: Sync {
    /// Whether the copy compiles; if not, what the compiler says.
    ///
    /// # Errors
    /// The compiler does not start.
    fn compiles(&self, copy: &Copy) -> Result<Result<(), String>, ToolError>;

    /// The verdict on the assertions of a harness whose text contains `assertion`, which get this much time.
    ///
    /// # Errors
    /// The tool fails.
    fn verdict(
        &self,
        copy: &Copy,
        harness: &Harness,
        assertion: &str,
        within: Duration,
    ) -> Result<(Verdict, Option<Tools>), ToolError>;
}

/// Kani.
#[derive(Clone, Copy, Debug)]
pub struct Kani;

impl Prover for Kani {
    fn compiles(&self, copy: &Copy) -> Result<Result<(), String>, ToolError> {
        copy.compiles(PACKAGE)
    }

    fn verdict(
        &self,
        copy: &Copy,
        harness: &Harness,
        assertion: &str,
        within: Duration,
    ) -> Result<(Verdict, Option<Tools>), ToolError> {
        let timeout = within.min(Duration::from_secs(harness.timeout));
        let options = Options { timeout: Some(timeout), assertion: Some(assertion.to_owned()), ..Options::default() };
        match verify(copy.root(), &copy.target().join("kani"), harness, &options) {
            // No cover was decided, so none is missing.
            Ok(done) if matches!(done.verdict, Verdict::Vacuous(_)) => Ok((Verdict::Proved, Some(done.tools))),
            Ok(done) => Ok((done.verdict, Some(done.tools))),
            // The shipped code compiles, so it is the harnesses that do not: then no mistake can be judged.
            Err(ToolError::NoResult { harness, log }) if log.contains("Failed to execute cargo") => {
                Err(ToolError::NoResult { harness, log })
            }
            // Kani or CBMC itself: no catch.
            Err(ToolError::NoResult { log, .. }) => {
                let last = log.lines().last().unwrap_or("nothing").to_owned();
                Ok((Verdict::Undetermined(format!("no result: {last}")), None))
            }
            Err(error) => Err(error),
        }
    }
}

/// Plants a mistake and tries its harnesses until one fails on it.
pub(super) fn judge(
    prover: &impl Prover,
    copy: &Copy,
    task: &Task,
) -> Result<(Outcome, Vec<Tried>, Option<Tools>), ToolError> {
    let started = Instant::now();
    copy.plant(&task.change)?;
    if let Err(error) = prover.compiles(copy)? {
        return Ok((Outcome::DoesNotCompile { error }, Vec::new(), None));
    }
    let (mut outcome, mut tried, mut tools) = (Outcome::Survived, Vec::new(), None);
    for harness in &task.harnesses {
        let left = task.within.saturating_sub(started.elapsed());
        if left.as_secs() == 0 {
            outcome = if outcome == Outcome::Survived { Outcome::Undecided } else { outcome };
            break;
        }
        let begun = Instant::now();
        let (mut verdict, with) = prover.verdict(copy, harness, &task.assertion, left)?;
        tools = tools.or(with);
        // A run ends at the first assertion that fails: one before may hide the named one, which then never fails. It may
        // as well be the one that catches.
        if verdict == Verdict::Proved && !task.assertion.is_empty() {
            (verdict, _) = prover.verdict(copy, harness, "", left)?;
        }
        let name = harness.name.clone();
        tried.push(Tried { harness: name.clone(), verdict: word(&verdict), seconds: begun.elapsed().as_secs() });
        outcome = match (verdict, outcome) {
            (Verdict::Failed(check), _) => {
                outcome = Outcome::Caught { harness: name, check };
                break;
            }
            (Verdict::Undetermined(_), Outcome::Survived) => Outcome::Undecided,
            (Verdict::Proved | Verdict::Vacuous(_) | Verdict::Undetermined(_), before) => before,
        };
    }
    Ok((outcome, tried, tools))
}

fn word(verdict: &Verdict) -> String {
    match verdict {
        Verdict::Proved => "proved".to_owned(),
        Verdict::Failed(_) => "failed".to_owned(),
        Verdict::Vacuous(_) => "vacuous".to_owned(),
        Verdict::Undetermined(why) => format!("undetermined: {why}"),
    }
}
