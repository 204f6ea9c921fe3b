//! Plants the mistakes, one at a time in each copy, and asks the proofs.

use std::collections::VecDeque;
use std::path::Path;
use std::sync::mpsc::{Sender, channel};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use super::change::Change;
use super::drawn::{draw, listed};
use super::list::List;
use super::prover::{Prover, judge};
use super::record::{Entry, Outcome, Record, put};
use crate::copy::Copy;
use crate::error::ToolError;
use crate::prove::{Harness, List as Harnesses, Sources, Tools};

/// Longest time for a named mistake: each of its harnesses has a limit of its own.
const NAMED: Duration = Duration::from_secs(3600);

/// One part of several, for a run on several machines.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    /// Which, from 0.
    index: usize,
    /// Of how many.
    of: usize,
}

impl Shard {
    /// Everything.
    pub const WHOLE: Self = Self { index: 0, of: 1 };

    /// The K-th of N, from 1.
    #[must_use]
    pub fn new((part, of): (usize, usize)) -> Self {
        Self { index: part.saturating_sub(1), of: of.max(1) }
    }

    /// What of a list belongs to this part.
    pub fn part<T>(self, all: impl IntoIterator<Item = T>) -> impl Iterator<Item = T> {
        all.into_iter().skip(self.index).step_by(self.of)
    }
}

/// What to run.
#[derive(Clone, Debug)]
pub struct Request {
    /// Only these named ones; all if empty.
    pub names: Vec<String>,
    /// So many drawn ones instead.
    pub drawn: Option<usize>,
    /// Another seed than that of the list.
    pub seed: Option<u64>,
    /// Only this part.
    pub shard: Shard,
    /// How many at a time.
    pub jobs: usize,
    /// Again what the record has for the present sources.
    pub again: bool,
}

/// One mistake to run.
pub(super) struct Task {
    pub name: String,
    pub change: Change,
    pub harnesses: Vec<Harness>,
    /// Only the assertions whose text contains this.
    pub assertion: String,
    pub within: Duration,
}

/// What is left to do. What does not compile is no mistake, and the next one takes its place.
struct Queue {
    tasks: VecDeque<Task>,
    wanted: usize,
}

impl Queue {
    fn next(queue: &Mutex<Self>) -> Option<Task> {
        let mut queue = queue.lock().unwrap_or_else(PoisonError::into_inner);
        queue.wanted = queue.wanted.checked_sub(1)?;
        queue.tasks.pop_front()
    }
    fn one_more(queue: &Mutex<Self>) {
        let mut queue = queue.lock().unwrap_or_else(PoisonError::into_inner);
        queue.wanted = queue.wanted.saturating_add(1);
    }
    fn stop(queue: &Mutex<Self>) {
        queue.lock().unwrap_or_else(PoisonError::into_inner).wanted = 0;
    }
}

/// Runs what is asked for, keeps the record, tells `say` of each mistake.
///
/// # Errors
/// The list is wrong, a file or a tool fails, or the sources change while it runs. What ran before is in the record.
pub fn run(root: &Path, request: &Request, prover: &impl Prover, say: &mut dyn FnMut(&str)) -> Result<(), ToolError> {
    let (mut list, harnesses) = (List::load(root)?, Harnesses::load(root)?);
    let order: Vec<String> = list.mistake.iter().map(|mistake| mistake.name.clone()).collect();
    if let Some(name) = request.names.iter().find(|name| !order.contains(name)) {
        return Err(ToolError::Arguments(format!("no mistake named {name} in proofs/mistakes.toml")));
    }
    list.mistake.retain(|mistake| request.names.is_empty() || request.names.contains(&mistake.name));
    let findings = list.findings(root, &harnesses);
    if !findings.is_empty() {
        return Err(ToolError::Arguments(findings.join("\n")));
    }
    let mut record = Record::load(root)?;
    let sources = Sources::load(root)?;
    let (tasks, order, wanted) = match request.drawn {
        None => named(root, request, order, &list, &harnesses, &record, &sources)?,
        Some(count) => drawn(root, request, count, &list, &harnesses, &mut record, &sources)?,
    };
    let total = wanted.min(tasks.len());
    say(&format!("{total} to plant, {} at a time", request.jobs));
    let queue = Mutex::new(Queue { tasks: tasks.into(), wanted });
    let target = std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root.join("target"), |folder| root.join(folder));
    let folder = target.join("mistakes");
    let mut done = 0_usize;
    std::thread::scope(|scope| {
        let (sender, results) = channel();
        for worker in 0..request.jobs.min(total) {
            let (sender, queue, sources) = (sender.clone(), &queue, &sources);
            let folder = folder.join(worker.to_string());
            scope.spawn(move || work(root, &folder, queue, prover, sources, &sender));
        }
        drop(sender);
        let mut outcome = Ok(());
        for result in results {
            match result {
                Ok((entry, tools)) => {
                    done = done.saturating_add(usize::from(entry.outcome.is_mistake()));
                    say(&told(&entry, done, total));
                    record.tools = tools.unwrap_or(record.tools.clone());
                    let entries = if request.drawn.is_some() { &mut record.drawn.mistakes } else { &mut record.named };
                    put(entries, entry, &order);
                    outcome = outcome.and(record.save(root));
                }
                Err(error) => outcome = outcome.and(Err(error)),
            }
            if outcome.is_err() {
                Queue::stop(&queue);
            }
        }
        outcome
    })
}

/// A mistake as it ran, with the versions of the tools.
type Ran = Result<(Entry, Option<Tools>), ToolError>;

/// One worker: its own copy, until nothing is left.
fn work(
    root: &Path,
    folder: &Path,
    queue: &Mutex<Queue>,
    prover: &impl Prover,
    sources: &Sources,
    results: &Sender<Ran>,
) {
    let copy = match Copy::new(root, folder) {
        Ok(copy) => copy,
        Err(error) => return drop(results.send(Err(error))),
    };
    while let Some(task) = Queue::next(queue) {
        let started = Instant::now();
        let result = judge(prover, &copy, &task).and_then(|(outcome, tried, tools)| {
            if Sources::load(root)? != *sources {
                return Err(ToolError::Arguments("the sources have changed while this ran".to_owned()));
            }
            let (change, seconds) = (task.change.digest(), started.elapsed().as_secs());
            let sources = sources.of_all(tried.iter().map(|tried| tried.harness.as_str()));
            Ok((Entry { name: task.name, change, outcome, tried, seconds, sources }, tools))
        });
        if result.as_ref().is_ok_and(|(entry, _)| !entry.outcome.is_mistake()) {
            Queue::one_more(queue);
        }
        if results.send(result).is_err() {
            return;
        }
    }
}

fn told(entry: &Entry, done: usize, total: usize) -> String {
    let Entry { name, seconds, .. } = entry;
    let what = match &entry.outcome {
        Outcome::Caught { harness, check } => format!("caught by {harness} in {seconds} s: {check}"),
        Outcome::Survived => format!("SURVIVED, {seconds} s"),
        Outcome::Undecided => format!("UNDECIDED, {seconds} s"),
        Outcome::DoesNotCompile { error } => format!("does not compile: {error}"),
    };
    format!("[{done}/{total}] {name}: {what}")
}

/// What to run, the order of the record, and how many of it.
type Work = (Vec<Task>, Vec<String>, usize);

fn named(
    root: &Path,
    request: &Request,
    order: Vec<String>,
    list: &List,
    harnesses: &Harnesses,
    record: &Record,
    sources: &Sources,
) -> Result<Work, ToolError> {
    let chosen = list.mistake.iter().filter(|mistake| mistake.survives.is_none());
    let mut tasks = Vec::new();
    for mistake in request.shard.part(chosen) {
        let change = mistake.change(root)?;
        let digest = change.digest();
        let is_current =
            |entry: &Entry| entry.name == mistake.name && entry.is_current(sources) && entry.change == digest;
        if request.again || !record.named.iter().any(is_current) {
            let harnesses = chosen_of(harnesses, &mistake.harness);
            let assertion = mistake.assertion.clone().unwrap_or_default();
            tasks.push(Task { name: mistake.name.clone(), change, harnesses, assertion, within: NAMED });
        }
    }
    let wanted = tasks.len();
    Ok((tasks, order, wanted))
}

fn drawn(
    root: &Path,
    request: &Request,
    count: usize,
    list: &List,
    harnesses: &Harnesses,
    record: &mut Record,
    sources: &Sources,
) -> Result<Work, ToolError> {
    let seed = request.seed.unwrap_or(list.drawn.seed);
    let all = draw(listed(root, &list.drawn.package)?, seed);
    let order: Vec<String> = all.iter().map(|listed| listed.name.clone()).collect();
    if record.drawn.seed != seed {
        record.drawn.mistakes.clear();
    }
    (record.drawn.seed, record.drawn.of) = (seed, order.len());
    record.drawn.mistakes.retain(|entry| entry.is_current(sources) && !request.again);
    let (mut tasks, mut wanted) = (Vec::new(), count.div_ceil(request.shard.of));
    for listed in request.shard.part(all) {
        if let Some(entry) = record.drawn.mistakes.iter().find(|entry| entry.name == listed.name) {
            wanted = wanted.saturating_sub(usize::from(entry.outcome.is_mistake()));
            continue;
        }
        // The whole list is long, and only what is wanted is read and checked; some do not compile.
        if tasks.len() > wanted.saturating_mul(3) {
            break;
        }
        let harnesses = chosen_of(harnesses, list.harnesses(&listed.file, listed.function()));
        if !harnesses.is_empty() {
            let (change, within) = (listed.change(root)?, Duration::from_secs(list.drawn.within));
            tasks.push(Task { name: listed.name, change, harnesses, assertion: String::new(), within });
        }
    }
    Ok((tasks, order, wanted))
}

fn chosen_of(harnesses: &Harnesses, names: &[String]) -> Vec<Harness> {
    names.iter().filter_map(|name| harnesses.of(name)).cloned().collect()
}

#[cfg(test)]
mod tests {
    use super::Shard;

    #[test]
    fn the_parts_are_the_whole() {
        let mut all: Vec<usize> = Vec::new();
        for part in 1..=3 {
            all.extend(Shard::new((part, 3)).part(0..10));
        }
        all.sort_unstable();
        assert_eq!(all, (0..10).collect::<Vec<_>>());
        assert_eq!(Shard::WHOLE.part(0..3).collect::<Vec<_>>(), [0, 1, 2]);
    }
}
