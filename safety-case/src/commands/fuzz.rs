//! `supervise fuzz`.

use super::hold::Held;
use super::{FINDINGS, NOT_RUN, Outcome, print, root, telling};
use crate::cli::Fuzz;
use crate::fuzz::{RECORD, Record, Request, Sources, TARGETS, Target, available, run as fuzz};
use crate::number::grouped;
use crate::spread::cores;

pub(super) fn run(arguments: &Fuzz) -> Outcome {
    let root = root()?;
    let (path, sources) = (root.join(RECORD), Sources::load(root)?);
    let record = Record::load(&path)?;
    if arguments.check {
        show(&record)?;
        return missing(&record, &sources);
    }
    if !arguments.merge.is_empty() {
        let mut record = record.for_sources(&sources);
        for part in &arguments.merge {
            record.merge(Record::load(part)?)?;
        }
        record.save(&path)?;
        show(&record)?;
        return Ok(0);
    }
    if !available() {
        print(
            "NOT RUN HERE: needs a nightly compiler and cargo install --locked cargo-fuzz. What follows is the record.\n",
        )?;
        show(&record)?;
        return Ok(NOT_RUN);
    }
    let (shard, _) = arguments.shard.unwrap_or((1, 1));
    let request = Request {
        targets: each_once(&arguments.targets),
        seconds: arguments.seconds,
        seed: arguments.seed.wrapping_add(u64::try_from(shard)?.saturating_sub(1).wrapping_mul(0x9E37_79B9))
            & 0xFFFF_FFFF,
        jobs: arguments.jobs.unwrap_or_else(cores),
    };
    // One target may run beside another, but not beside itself: both would write the same corpus and count the same cycles.
    let held = request.targets.iter().map(|target| Held::at_once(root, &format!("fuzz {target}")));
    let _held = held.collect::<Result<Vec<_>, _>>()?;
    let ran = telling(|say| fuzz(root, &request, say))?;
    if Sources::load(root)? != sources {
        return Err("the sources have changed while this ran: nothing is recorded".into());
    }
    let found: u64 = ran.iter().map(|target| target.found).sum();
    let _turn = Held::in_turn(root, "fuzz record")?;
    let (mut record, path) = match arguments.shard {
        // As it is now: another run may have written it meanwhile.
        None => (Record::load(&path)?.for_sources(&sources), path),
        Some((part, of)) => {
            let path = root.join(format!("target/fuzz/shard-{part}-of-{of}.json"));
            (Record { sources, targets: Vec::new() }, path)
        }
    };
    for target in ran {
        record.add(target);
    }
    record.save(&path)?;
    show(&record)?;
    print(format_args!("{}\n", path.display()))?;
    if found > 0 {
        print(format_args!("FOUND {found}: now in fuzz/corpus as regression-…; cargo test --test corpus shows it\n"))?;
    }
    Ok(if found > 0 { FINDINGS } else { 0 })
}

/// The targets that are named, each once, in the order in which they run; all if none is.
fn each_once(named: &[String]) -> Vec<String> {
    let runs = |target: &&str| named.is_empty() || named.iter().any(|name| name == target);
    TARGETS.into_iter().filter(runs).map(str::to_owned).collect()
}

fn show(record: &Record) -> Result<(), std::io::Error> {
    print(format_args!(
        "{:<16} {:>13} {:>15} {:>9} {:>9} {:>10} {:>9} {:>6}\n",
        "target", "inputs", "cycles", "seconds", "cycles/s", "edges", "quiet s", "found"
    ))?;
    for target in &record.targets {
        let Target { target: name, inputs, cycles, seconds, edges, quiet_seconds, found, .. } = target;
        print(format_args!(
            "{name:<16} {:>13} {:>15} {seconds:>9} {:>9} {edges:>10} {quiet_seconds:>9} {found:>6}\n",
            grouped(*inputs),
            grouped(*cycles),
            grouped(cycles.checked_div(*seconds).unwrap_or(0)),
        ))?;
    }
    print(format_args!("{} cycles in all\n", grouped(record.cycles())))
}

/// What the record does not show.
fn missing(record: &Record, sources: &Sources) -> Outcome {
    let mut findings = Vec::new();
    if record.targets.is_empty() {
        findings.push("no campaign is on record".to_owned());
    } else if record.sources.shipped != sources.shipped {
        findings.push("STALE: the shipped sources changed since".to_owned());
    } else if record.sources.judges != sources.judges {
        findings.push("STALE: targets, properties or the oracle changed since".to_owned());
    } else if record.sources.parsers != sources.parsers {
        findings.push("STALE: the parsers of the host changed since".to_owned());
    }
    findings.extend(record.short());
    for finding in &findings {
        print(format_args!("{finding}\n"))?;
    }
    Ok(if findings.is_empty() { 0 } else { FINDINGS })
}

#[cfg(test)]
mod tests {
    use super::{TARGETS, each_once};

    #[test]
    fn a_target_that_is_named_twice_runs_once() {
        let named = ["dbc_map", "wire_bytes", "dbc_map"].map(str::to_owned);
        assert_eq!(each_once(&named), ["wire_bytes", "dbc_map"]);
        assert_eq!(each_once(&[]), TARGETS);
    }
}
