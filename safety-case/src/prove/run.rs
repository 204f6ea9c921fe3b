//! Runs `cargo kani`, one harness at a time, and keeps the record.

use std::path::Path;

use super::error::ProveError;
use super::harness::{Harness, List, Solver};
use super::judge::Verdict;
use super::kani::{self, Tools};
use super::record::{Proof, Record, sources_digest};

/// What to run.
#[derive(Clone, Debug, Default)]
pub struct Request {
    /// Only these; all if empty.
    pub harnesses: Vec<String>,
    /// Only what took no longer than this when it was recorded, in seconds.
    pub within: Option<u64>,
    /// Run nothing: show the record and whether it is stale.
    pub check: bool,
    /// The solver. Always named: Kani's default falls back silently where it is not there.
    pub solver: Option<Solver>,
}

/// Runs the chosen harnesses, updates the record, tells `say` of each line; the number of harnesses that ran and are
/// not proved on the present sources. What was never run is told as open, and is no failure.
///
/// # Errors
/// A file or the tool fails; a harness is unknown.
pub fn prove(root: &Path, options: &Request, say: &mut impl FnMut(&str)) -> Result<usize, ProveError> {
    let list = List::load(root)?;
    let mut record = Record::load(root)?;
    let sources = sources_digest(root)?;
    if let Some(name) = options.harnesses.iter().find(|name| !list.harness.iter().any(|harness| harness.name == **name))
    {
        return Err(ProveError::Unknown(name.clone()));
    }
    if !options.check {
        let chosen: Vec<&Harness> =
            list.harness.iter().filter(|harness| is_chosen(harness, options, &record)).collect();
        for (index, harness) in chosen.iter().enumerate() {
            say(&format!("[{}/{}] {} ...", index.saturating_add(1), chosen.len(), harness.name));
            let (proof, tools) = run(root, harness, options.solver, &sources)?;
            say(&format!(
                "        {} in {} s, {} checks, {} covers",
                word(&proof.verdict),
                proof.seconds,
                proof.checks,
                proof.covers
            ));
            record.put(proof, &list);
            record.tools = tools;
            record.save(root)?;
        }
    }
    Ok(show(&list, &record, &sources, say))
}

fn is_chosen(harness: &Harness, options: &Request, record: &Record) -> bool {
    let named = options.harnesses.is_empty() || options.harnesses.contains(&harness.name);
    let quick = |within| record.of(&harness.name).is_some_and(|proof| proof.seconds <= within);
    named && options.within.is_none_or(quick)
}

fn word(verdict: &Verdict) -> String {
    match verdict {
        Verdict::Proved => "proved".to_owned(),
        Verdict::Failed(why) => format!("FAILED: {why}"),
        Verdict::Vacuous(why) => format!("VACUOUS: {why}"),
        Verdict::Undetermined(why) => format!("UNDETERMINED: {why}"),
    }
}

/// Shows every harness of the list with what the record says of it; counts what ran and is not proved now.
fn show(list: &List, record: &Record, sources: &str, say: &mut impl FnMut(&str)) -> usize {
    let (mut proved, mut bad) = (0_usize, 0_usize);
    say("");
    for harness in &list.harness {
        let line = match record.of(&harness.name) {
            _ if harness.open.is_some() => format!("OPEN: {}", harness.open.as_deref().unwrap_or("")),
            None => "stated, NOT RUN".to_owned(),
            Some(proof) if proof.sources != sources => format!("STALE (was: {})", word(&proof.verdict)),
            Some(proof) => format!("{} ({}, {} s)", word(&proof.verdict), proof.extent, proof.seconds),
        };
        if line.starts_with("proved") {
            proved = proved.saturating_add(1);
        } else if !line.starts_with("stated") && !line.starts_with("OPEN") {
            bad = bad.saturating_add(1);
        }
        say(&format!("{:<52} {line}", harness.name));
    }
    let open = list.harness.len().saturating_sub(proved).saturating_sub(bad);
    say(&format!(
        "{proved} proved on the present sources, {bad} failed, vacuous, undetermined or stale, {open} open or not run"
    ));
    bad
}

fn run(root: &Path, harness: &Harness, solver: Option<Solver>, sources: &str) -> Result<(Proof, Tools), ProveError> {
    let options = kani::Options { solver, ..kani::Options::default() };
    let outcome = kani::verify(root, &root.join("target/kani/0"), harness, &options)?;
    let proof = Proof {
        name: harness.name.clone(),
        requirements: harness.requirements.clone(),
        extent: harness.extent.clone(),
        verdict: outcome.verdict,
        checks: outcome.checks,
        covers: outcome.covers,
        solver: outcome.solver,
        seconds: outcome.seconds,
        sources: sources.to_owned(),
    };
    Ok((proof, outcome.tools))
}
