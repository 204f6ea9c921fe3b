//! `supervise mutants`.

use std::path::Path;
use std::time::Duration;

use super::hold::Held;
use super::{FINDINGS, NOT_RUN, Outcome, print, root, telling};
use crate::cli::Mutants;
use crate::mistakes::{Shard, available};
use crate::mutants::{Explained, Record, Request, findings as disagreeing, prove, run as mutate};
use crate::prove::{available as kani, shipped};
use crate::spread::cores;

pub(super) fn run(arguments: &Mutants) -> Outcome {
    let root = root()?;
    if arguments.prove {
        if !kani() {
            print(
                "NOT RUN HERE: cargo kani is not installed (cargo install --locked kani-verifier && cargo kani setup).\n",
            )?;
            return Ok(NOT_RUN);
        }
        let _held = Held::at_once(root, "mutants")?;
        telling(|say| prove(root, say))?;
        return show(root);
    }
    if !arguments.check && !available() {
        print(
            "NOT RUN HERE: cargo mutants is not installed (cargo install --locked cargo-mutants). What follows is the record.\n",
        )?;
        show(root)?;
        return Ok(NOT_RUN);
    }
    if !arguments.check {
        let request = Request {
            shard: arguments.shard.map_or(Shard::WHOLE, Shard::new),
            jobs: arguments.jobs.unwrap_or_else(cores),
            again: arguments.again,
            within: arguments.within.map(|minutes| Duration::from_secs(minutes.saturating_mul(60))),
            longest: Duration::from_secs(arguments.longest),
        };
        let _held = Held::at_once(root, "mutants")?;
        telling(|say| mutate(root, request, say))?;
    }
    show(root)
}

fn show(root: &Path) -> Outcome {
    let (record, explained) = (Record::load(root)?, Explained::all(root)?);
    print(format_args!("{:<42} {:>7} {:>9} {:>9} {:>9}\n", "", "caught", "survived", "equal", "unviable"))?;
    let rows = record.by_file();
    for (file, [caught, survived, equal, unviable]) in &rows {
        print(format_args!("{file:<42} {caught:>7} {survived:>9} {equal:>9} {unviable:>9}\n"))?;
    }
    let [caught, survived, equal, unviable] = record.counts();
    print(format_args!("{:<42} {caught:>7} {survived:>9} {equal:>9} {unviable:>9}\n\n", "all"))?;
    let mut findings = Vec::new();
    for name in record.survivors() {
        match Explained::of(&explained, name, &record) {
            Some(explained) => print(format_args!("explained: {name}\n  {}\n", explained.reason))?,
            None => findings.push(format!("survived: {name}")),
        }
    }
    findings.extend(disagreeing(&explained, &record));
    let run = record.mutants.len();
    if run < record.listed {
        findings.push(format!("{} of {} mutants were not run", record.listed.saturating_sub(run), record.listed));
    }
    if record.sources != shipped(root)? {
        findings.push("the record is stale: the shipped sources have changed since".to_owned());
    }
    for finding in &findings {
        print(format_args!("{finding}\n"))?;
    }
    Ok(if findings.is_empty() { 0 } else { FINDINGS })
}
