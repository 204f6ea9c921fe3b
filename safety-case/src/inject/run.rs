//! A campaign, or a part of it, on all cores.

use supervisor::ConfigError;
use supervisor_tests::drive::Scenario;
use supervisor_tests::inject::baseline::Baseline;
use supervisor_tests::inject::campaign::{Guard, cell};
use supervisor_tests::inject::scenarios;

use super::list::{Fault, List};
use super::matrix::{Cell, Drive, Matrix, SCHEMA, Sources};
use crate::spread::{Steps, cores, mine, spread};

/// What is wanted.
#[derive(Clone, Debug, Default)]
pub struct Request {
    /// The seed.
    pub seed: u64,
    /// Runs for each cell.
    pub runs: u32,
    /// Part K of N, from 1; none: all.
    pub shard: Option<(usize, usize)>,
    /// Only these faults; none: all.
    pub faults: Vec<String>,
    /// Only these scenarios; none: all.
    pub scenarios: Vec<String>,
    /// Threads; none: one for each core.
    pub jobs: Option<usize>,
}

/// Why a campaign did not run.
#[derive(Debug, thiserror::Error)]
pub enum RunError {
    /// There is no such fault or scenario.
    #[error("no fault or scenario is called {0}")]
    Unknown(String),
    /// The configuration is refused.
    #[error("{0}")]
    Configuration(#[from] ConfigError),
}

/// Runs it.
///
/// # Errors
/// If a name is unknown, or the default configuration is refused.
pub fn campaign(list: &List, request: &Request, sources: Sources) -> Result<Matrix, RunError> {
    let faults = chosen(&list.faults, &request.faults, |fault| &fault.run.id)?;
    let all = scenarios::all();
    let scenarios = chosen(&all, &request.scenarios, |scenario| scenario.name)?;
    let jobs = request.jobs.unwrap_or_else(cores);

    let steps = Steps::new("drives without a fault", scenarios.len());
    let drive = |scenario: &&Scenario<'static>| Baseline::drive(scenario, &list.ftti);
    let baselines: Vec<Baseline> = spread(&scenarios, jobs, &steps, drive).into_iter().collect::<Result<_, _>>()?;

    let (_, shards) = request.shard.unwrap_or((1, 1));
    let pairs = faults.iter().flat_map(|fault| baselines.iter().map(move |baseline| (*fault, baseline)));
    let applies = |(fault, baseline): &(&Fault, &Baseline)| !baseline.times(fault.run.when).is_empty();
    let work: Vec<(&Fault, &Baseline)> = pairs
        .filter(applies)
        .enumerate()
        .filter(|(number, _)| mine(request.shard, *number))
        .map(|(_, pair)| pair)
        .collect();
    let steps = Steps::new("faults in drives", work.len());
    let one = |(fault, baseline): &(&Fault, &Baseline)| {
        let runs = cell(baseline, &fault.run, &list.ftti, request.seed, request.runs, Guard::Supervisor);
        Cell::new(&fault.run.id, baseline.scenario.name, &runs, &list.ftti)
    };
    let mut cells = spread(&work, jobs, &steps, one);
    cells.sort();
    Ok(Matrix {
        schema: SCHEMA.to_owned(),
        version: 1,
        seed: request.seed,
        runs: request.runs,
        shards,
        sources,
        drives: baselines.iter().map(Drive::from).collect(),
        cells,
    })
}

fn chosen<'a, T>(all: &'a [T], names: &[String], name: impl Fn(&T) -> &str) -> Result<Vec<&'a T>, RunError> {
    if let Some(unknown) = names.iter().find(|wanted| !all.iter().any(|item| name(item) == wanted.as_str())) {
        return Err(RunError::Unknown(unknown.clone()));
    }
    Ok(all.iter().filter(|item| names.is_empty() || names.iter().any(|wanted| wanted == name(item))).collect())
}
