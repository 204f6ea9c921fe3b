//! `supervise mutants`.

use std::path::Path;
use std::time::Duration;

use super::{FINDINGS, NOT_RUN, Outcome, print, root, telling};
use crate::cli::Mutants;
use crate::mistakes::{Shard, available};
use crate::mutants::{Explained, Record, Request, run as mutate};
use crate::prove::shipped;
use crate::spread::cores;

pub(super) fn run(arguments: &Mutants) -> Outcome {
    let root = root()?;
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
        telling(|say| mutate(root, request, say))?;
    }
    show(root)
}

fn show(root: &Path) -> Outcome {
    let (record, explained) = (Record::load(root)?, Explained::all(root)?);
    print(format_args!("{:<42} {:>7} {:>9} {:>9} {:>9}\n", "", "caught", "survived", "unviable", "left out"))?;
    let rows = record.by_file();
    for (file, [caught, survived, unviable, left_out]) in &rows {
        print(format_args!("{file:<42} {caught:>7} {survived:>9} {unviable:>9} {left_out:>9}\n"))?;
    }
    let [caught, survived, unviable, left_out] = record.counts();
    print(format_args!("{:<42} {caught:>7} {survived:>9} {unviable:>9} {left_out:>9}\n\n", "all"))?;
    let mut findings = Vec::new();
    for name in record.survivors() {
        match Explained::of(&explained, name, &record) {
            Some(explained) => print(format_args!("explained: {name}\n  {}\n", explained.reason))?,
            None => findings.push(format!("survived: {name}")),
        }
    }
    for explained in &explained {
        let surviving = explained.surviving(&record);
        if surviving != explained.times {
            let Explained { file, name, times, .. } = explained;
            findings.push(format!("{times} explained, {surviving} survive: {file}: {name}"));
        }
    }
    let run = record.mutants.len();
    if run < record.listed {
        findings.push(format!("{} of {} mutants were not run", record.listed.saturating_sub(run), record.listed));
    }
    if left_out > 0 {
        findings.push(format!("{left_out} mutants cannot be switched and were not tried"));
    }
    if record.sources != shipped(root)? {
        findings.push("the record is stale: the shipped sources have changed since".to_owned());
    }
    for finding in &findings {
        print(format_args!("{finding}\n"))?;
    }
    Ok(if findings.is_empty() { 0 } else { FINDINGS })
}
