//! A campaign, or a part of it, on all cores.

use std::io::IsTerminal;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use supervisor::ConfigError;
use supervisor_tests::drive::Scenario;
use supervisor_tests::inject::baseline::Baseline;
use supervisor_tests::inject::campaign::{Guard, cell};
use supervisor_tests::inject::scenarios;

use super::list::{Fault, List};
use super::matrix::{Cell, Drive, Matrix, SCHEMA, Sources};

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
    let jobs = request.jobs.or_else(|| std::thread::available_parallelism().ok().map(usize::from)).unwrap_or(1);

    let steps = Steps::new("drives without a fault", scenarios.len());
    let drive = |scenario: &&Scenario<'static>| Baseline::drive(scenario, &list.ftti);
    let baselines: Vec<Baseline> = spread(&scenarios, jobs, &steps, drive).into_iter().collect::<Result<_, _>>()?;

    let (shard, shards) = request.shard.unwrap_or((1, 1));
    let pairs = faults.iter().flat_map(|fault| baselines.iter().map(move |baseline| (*fault, baseline)));
    let applies = |(fault, baseline): &(&Fault, &Baseline)| !baseline.times(fault.run.when).is_empty();
    let mine = |number: usize| number.checked_rem(shards).is_some_and(|rest| rest + 1 == shard);
    let work: Vec<(&Fault, &Baseline)> =
        pairs.filter(applies).enumerate().filter(|(number, _)| mine(*number)).map(|(_, pair)| pair).collect();
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

/// Does the work on so many threads; the results are in the order of the work.
fn spread<T: Sync, R: Send>(work: &[T], jobs: usize, steps: &Steps, each: impl Fn(&T) -> R + Sync) -> Vec<R> {
    let (next, done) = (AtomicUsize::new(0), Mutex::new(Vec::new()));
    std::thread::scope(|scope| {
        for _ in 0..jobs.min(work.len()).max(1) {
            scope.spawn(|| {
                loop {
                    let number = next.fetch_add(1, Ordering::Relaxed);
                    let Some(item) = work.get(number) else { break };
                    let result = each(item);
                    if let Ok(mut done) = done.lock() {
                        done.push((number, result));
                    }
                    steps.one();
                }
            });
        }
    });
    steps.finish();
    let mut done = done.into_inner().unwrap_or_default();
    done.sort_by_key(|(number, _)| *number);
    done.into_iter().map(|(_, result)| result).collect()
}

/// Progress on the standard error: a bar on a terminal, else a line for each tenth.
struct Steps {
    bar: Option<ProgressBar>,
    what: &'static str,
    of: usize,
    done: AtomicUsize,
}

impl Steps {
    fn new(what: &'static str, of: usize) -> Self {
        let bar = std::io::stderr().is_terminal().then(|| {
            let length = u64::try_from(of).unwrap_or(u64::MAX);
            let bar = ProgressBar::with_draw_target(Some(length), ProgressDrawTarget::stderr());
            if let Ok(style) = ProgressStyle::with_template("{msg} {bar:40} {pos} of {len}, {eta} left") {
                bar.set_style(style);
            }
            bar.set_message(what);
            bar
        });
        Self { bar, what, of, done: AtomicUsize::new(0) }
    }

    fn one(&self) {
        let done = self.done.fetch_add(1, Ordering::Relaxed).saturating_add(1);
        match &self.bar {
            Some(bar) => bar.inc(1),
            None if done.is_multiple_of((self.of / 10).max(1)) => eprintln!("{}: {done} of {}", self.what, self.of),
            None => {}
        }
    }

    fn finish(&self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}
