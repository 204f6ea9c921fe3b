//! Records that are committed and carry digests of their sources; each is judged as its own command judges it.

use std::collections::BTreeSet;
use std::path::Path;

use serde::Deserialize;

use super::{Standing, State};
use crate::coverage;
use crate::error::ToolError;
use crate::inject::{self, Standing as FaultStanding};
use crate::mistakes;
use crate::mutants;
use crate::prove::{self, Place, Present, Verdict, sha256, shipped};

type Outcome = Result<Standing, Box<dyn std::error::Error>>;
type Read = fn(&Shared<'_>) -> Outcome;

/// What several records are judged by, read once.
pub(super) struct Shared<'a> {
    root: &'a Path,
    present: Present,
    list: prove::List,
    proofs: prove::Record,
    /// Of each harness of the list.
    states: Vec<prove::State>,
}

impl<'a> Shared<'a> {
    /// Reads the sources, and judges every proof.
    ///
    /// # Errors
    /// A source or a list cannot be read.
    pub(super) fn load(root: &'a Path) -> Result<Self, ToolError> {
        let present = Present { sources: prove::Sources::load(root)?, configuration: prove::default_configuration()? };
        let (list, proofs) = (prove::List::load(root)?, prove::Record::load(&root.join(prove::RECORD))?);
        let place = Place::committed(root);
        let states = list.harness.iter().map(|harness| prove::State::of(harness, &proofs, &place, &present)).collect();
        Ok(Self { root, present, list, proofs, states })
    }

    fn judged(&self) -> impl Iterator<Item = (&prove::Harness, &prove::State)> {
        self.list.harness.iter().zip(&self.states)
    }
}

/// Each with what reads it.
pub(super) const RECORDS: [(&str, Read); 6] = [
    ("proofs", |shared| Ok(proofs(shared))),
    ("mistakes", named_mistakes),
    ("contracts", contracts),
    ("inject", faults),
    ("coverage", reached),
    ("mutants", mutated),
];

fn proofs(shared: &Shared<'_>) -> Standing {
    let mut standing = Standing::new(
        "proofs",
        "Proofs by model checking",
        prove::RECORD,
        "supervise prove",
        "The object code, timing, the hardware; the step as one piece; the arithmetic of the kernels where a harness says any.",
    );
    if shared.proofs.proofs.is_empty() {
        return standing;
    }
    let (mut proved, mut bounded, mut open, mut stale) = (0_usize, 0_usize, 0_usize, 0_usize);
    for (harness, now) in shared.judged() {
        match now {
            prove::State::Ran(Verdict::Proved) if harness.extent.starts_with("exhaustive") => proved += 1,
            prove::State::Ran(Verdict::Proved) => bounded += 1,
            prove::State::Stale(_) => stale += 1,
            prove::State::Open(_) => open += 1,
            prove::State::NotRun | prove::State::Unsupported(_) | prove::State::Ran(_) => {}
        }
        if !now.is_proved() && !matches!(now, prove::State::Stale(_)) {
            standing.open.push(format!("{}: {now}", harness.name));
        }
    }
    let bad = shared.states.len().saturating_sub(proved + bounded + open + stale);
    standing.state = State::of(if stale > 0 { vec![format!("sources of {stale} harnesses")] } else { Vec::new() });
    standing.figure("harnesses", shared.states.len(), "harnesses");
    standing.figure("proved", proved, "proved for all inputs and time");
    standing.figure("bounded", bounded, "proved within a bound that they say");
    standing.figure("open", open, "known not to hold as stated");
    standing.figure("stale", stale, "proved on other sources");
    standing.figure("bad", bad, "failed, vacuous, undecided, unsupported or not run");
    let seconds: u64 = shared.proofs.proofs.iter().map(|proof| proof.seconds).sum();
    standing.figure("minutes", seconds.div_ceil(60), "minutes on one core");
    standing
}

fn named_mistakes(shared: &Shared<'_>) -> Outcome {
    let root = shared.root;
    let mut standing = Standing::new(
        "mistakes",
        "Mistakes planted against the proofs",
        mistakes::RECORD,
        "supervise mistakes",
        "That every mistake would be caught.",
    );
    let (list, record) = (mistakes::List::load(root)?, mistakes::Record::load(root)?);
    if record.named.is_empty() {
        return Ok(standing);
    }
    let proved: BTreeSet<String> =
        shared.judged().filter(|(_, state)| state.is_proved()).map(|(harness, _)| harness.name.clone()).collect();
    let drawn: Vec<_> = record.drawn.mistakes.iter().filter(|entry| entry.outcome.is_mistake()).collect();
    let mut changed = Vec::new();
    for finding in mistakes::check(&list, &record, root, &shared.present.sources, &proved)? {
        if let mistakes::Finding::Stale(count) = finding {
            changed.push(format!("sources of {count} planted mistakes"));
        } else {
            if let mistakes::Finding::Drawn(current, _) = finding
                && current < drawn.len()
            {
                changed.push(format!("sources of {} drawn mistakes", drawn.len().saturating_sub(current)));
            }
            standing.open.push(finding.to_string());
        }
    }
    standing.state = State::of(changed);
    let caught = record.named.iter().filter(|entry| entry.outcome.is_caught()).count();
    let surviving = list.mistake.iter().filter(|mistake| mistake.survives.is_some()).count();
    standing.figure("named", list.mistake.len(), "named mistakes");
    standing.figure("caught", caught, "caught by a proof alone");
    standing.figure("surviving", surviving, "that change nothing that goes out, and say why");
    standing.figure("drawn", drawn.len(), "drawn ones that ran");
    let caught = drawn.iter().filter(|entry| entry.outcome.is_caught()).count();
    standing.figure("drawn_caught", caught, "of these caught by a proof alone");
    Ok(standing)
}

/// The record of the contracts, as far as it is read here.
#[derive(Deserialize)]
struct Contracts {
    sources: std::collections::BTreeMap<String, String>,
    contracts: Vec<Contract>,
}

#[derive(Deserialize)]
struct Contract {
    function: String,
    verdict: String,
}

fn contracts(shared: &Shared<'_>) -> Outcome {
    const FILE: &str = "proofs/creusot/record.json";
    let root = shared.root;
    let mut standing = Standing::new(
        "contracts",
        "Contracts of the arithmetic kernels",
        FILE,
        "cargo run --example discharge (proofs/creusot)",
        "Anything, where a contract is stated and not discharged; tests evaluate it on edge values.",
    );
    let path = root.join(FILE);
    if !path.exists() {
        return Ok(standing);
    }
    let record: Contracts =
        serde_json::from_str(&crate::error::read(&path)?).map_err(|error| crate::error::form(&path, &error))?;
    let folder = root.join("proofs/creusot");
    let differs = |(file, digest): (&String, &String)| {
        let text = std::fs::read(folder.join(file)).unwrap_or_default();
        (sha256(&text) != *digest).then(|| file.trim_start_matches("../").to_owned())
    };
    standing.state = State::of(record.sources.iter().filter_map(differs).collect());
    let open: Vec<&Contract> = record.contracts.iter().filter(|contract| contract.verdict != "discharged").collect();
    standing.figure("contracts", record.contracts.len(), "contracts");
    standing.figure("discharged", record.contracts.len().saturating_sub(open.len()), "discharged by a prover");
    if let Some(first) = open.first() {
        standing.open.push(format!(
            "{} contracts are not discharged, {} the first of them: {}",
            open.len(),
            first.function,
            first.verdict
        ));
    }
    Ok(standing)
}

fn faults(shared: &Shared<'_>) -> Outcome {
    let root = shared.root;
    let mut standing = Standing::new(
        "inject",
        "Faults injected into correct drives",
        inject::record::RECORD,
        "supervise inject",
        "Faults that nobody thought of, and a real bus.",
    );
    let path = root.join(inject::record::RECORD);
    if !path.exists() {
        return Ok(standing);
    }
    let list = inject::List::load(&root.join("safety-case/analysis"))?;
    let matrix = inject::record::read(&path)?;
    let sources = inject::Sources::load(root)?;
    standing.state = State::of(matrix.sources.differences(&sources).into_iter().map(str::to_owned).collect());
    standing.page = Some("inject.html".to_owned());
    let rows = inject::rows(&list, &matrix);
    let names = [
        "faults",
        "cells",
        "runs",
        "dangerous",
        "averted",
        "reported",
        "late",
        "missed",
        "residual",
        "tolerated",
        "not_shown",
        "known",
        "against",
        "drives",
        "interventions",
    ];
    for (name, (value, what)) in names.iter().zip(inject::table::figures(&rows, &matrix)) {
        standing.figure(name, value, what);
    }
    for row in &rows {
        let fault = row.fault;
        match row.standing {
            FaultStanding::Against => standing.open.push(format!("{} stands against its expectation", fault.run.id)),
            FaultStanding::Known => {
                standing.open.push(format!("{}: {}", fault.run.id, fault.known.as_deref().unwrap_or_default()));
            }
            FaultStanding::NotShown => {
                standing.open.push(format!("{} was never dangerous: nothing is shown for it", fault.run.id));
            }
            FaultStanding::NotRun => standing.open.push(format!("{} was not run", fault.run.id)),
            FaultStanding::AsExpected | FaultStanding::Residual => {}
        }
    }
    Ok(standing)
}

fn reached(shared: &Shared<'_>) -> Outcome {
    let root = shared.root;
    let mut standing = Standing::new(
        "coverage",
        "Structural coverage of decide and vet",
        coverage::RECORD,
        "supervise coverage",
        "That what ran was right; perception, link and reports are not measured.",
    );
    if !root.join(coverage::RECORD).exists() {
        return Ok(standing);
    }
    let record = coverage::Record::load(root)?;
    let (sources, tests) = record.is_current(root)?;
    let mut changed = Vec::new();
    changed.extend((!sources).then(|| "the shipped sources".to_owned()));
    // Other tests may reach as much: a note, as for `coverage --check`.
    standing
        .open
        .extend((!tests).then(|| "the tests changed since: these figures are of the tests of then".to_owned()));
    standing.state = State::of(changed);
    let sum = record.sum;
    for (name, count, what) in [
        ("statements", sum.statements, "statements"),
        ("branches", sum.branches, "branches"),
        ("conditions", sum.conditions, "conditions, MC/DC by masking"),
        ("unique", sum.unique, "conditions, MC/DC by unique cause"),
    ] {
        standing.figure(name, format!("{} of {}", count.covered, count.of), what);
    }
    standing.figure("open", record.open.len(), "listed as open, each with its reason");
    let accepted = coverage::Accepted::load(root)?;
    standing.open.extend(coverage::compare(&record.open, &accepted).iter().map(ToString::to_string));
    standing.open.extend(record.open.iter().map(|open| format!("not covered, by reading out of reach: {open}")));
    Ok(standing)
}

fn mutated(shared: &Shared<'_>) -> Outcome {
    let root = shared.root;
    let mut standing = Standing::new(
        "mutants",
        "Mutants against the tests",
        mutants::RECORD,
        "supervise mutants",
        "Mutants that were not run; what a test program would have caught that takes too long to run for each.",
    );
    let record = mutants::Record::load(root)?;
    if record.mutants.is_empty() {
        return Ok(standing);
    }
    let changed = if record.sources == shipped(root)? { Vec::new() } else { vec!["the shipped sources".to_owned()] };
    standing.state = State::of(changed);
    let [caught, survived, equal, unviable] = record.counts();
    let explained = mutants::Explained::all(root)?;
    let unexplained: Vec<&str> =
        record.survivors().filter(|name| mutants::Explained::of(&explained, name, &record).is_none()).collect();
    standing.figure("listed", record.listed, "mutants listed");
    standing.figure("run", record.mutants.len(), "with an outcome");
    standing.figure("caught", caught, "caught by a test");
    standing.figure("survived", survived, "survived");
    standing.figure(
        "explained",
        survived.saturating_sub(unexplained.len()),
        "of these with a reason why nothing changes",
    );
    standing.figure("equal", equal, "proved by Kani to change nothing");
    standing.figure("unviable", unviable, "do not compile");
    if record.mutants.len() < record.listed {
        standing.open.push(format!(
            "{} of {} mutants were not run",
            record.listed.saturating_sub(record.mutants.len()),
            record.listed
        ));
    }
    standing.open.extend(mutants::findings(&explained, &record));
    standing.open.extend(unexplained.iter().map(|name| format!("survived: {name}")));
    Ok(standing)
}
