//! Work on all cores, or a part of it, with progress.

use std::io::IsTerminal;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// How many cores there are.
#[must_use]
pub fn cores() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}

/// Whether a piece of work belongs to part K of N, from 1; without parts, all does.
#[must_use]
pub fn mine(shard: Option<(usize, usize)>, number: usize) -> bool {
    let (shard, shards) = shard.unwrap_or((1, 1));
    number.checked_rem(shards).is_some_and(|rest| rest + 1 == shard)
}

/// Does the work on so many threads; the results are in the order of the work.
pub fn spread<T: Sync, R: Send>(work: &[T], jobs: usize, steps: &Steps, each: impl Fn(&T) -> R + Sync) -> Vec<R> {
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

/// So long nothing comes before it is told.
const QUIET: Duration = Duration::from_secs(60);

/// Does the work on so many threads, and gives each result to `take` as it comes, on this thread; `None` where for a minute nothing
/// came. Takes up nothing more once `take` fails.
///
/// # Errors
/// The first one of `take`.
pub fn as_it_comes<T: Send, R: Send, E>(
    work: impl Iterator<Item = T> + Send,
    jobs: usize,
    each: impl Fn(T) -> R + Sync,
    mut take: impl FnMut(Option<R>) -> Result<(), E>,
) -> Result<(), E> {
    let work = Mutex::new(work);
    std::thread::scope(|scope| {
        let (sender, results) = channel();
        for _ in 0..jobs.max(1) {
            let (sender, work, each) = (sender.clone(), &work, &each);
            scope.spawn(move || {
                let next = || work.lock().unwrap_or_else(PoisonError::into_inner).next();
                // Whoever stops receiving ends the workers.
                while next().is_some_and(|item| sender.send(each(item)).is_ok()) {}
            });
        }
        drop(sender);
        loop {
            match results.recv_timeout(QUIET) {
                Ok(result) => take(Some(result))?,
                Err(RecvTimeoutError::Timeout) => take(None)?,
                Err(RecvTimeoutError::Disconnected) => return Ok(()),
            }
        }
    })
}

/// Progress on the standard error: a bar on a terminal, else a line for each tenth.
#[derive(Debug)]
pub struct Steps {
    bar: Option<ProgressBar>,
    what: &'static str,
    of: usize,
    done: AtomicUsize,
}

impl Steps {
    /// So many pieces of work.
    #[must_use]
    pub fn new(what: &'static str, of: usize) -> Self {
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

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicUsize, Ordering};

    use super::as_it_comes;

    #[test]
    fn every_piece_is_done_once_and_its_result_comes() {
        for jobs in [0, 1, 3] {
            let mut came = Vec::new();
            let done = as_it_comes(
                0..20,
                jobs,
                |number| number * 2,
                |result| {
                    came.extend(result);
                    Ok::<(), ()>(())
                },
            );
            came.sort_unstable();
            assert_eq!((done, came), (Ok(()), (0..20).map(|number| number * 2).collect()));
        }
    }

    #[test]
    fn after_a_failure_nothing_is_taken_up() {
        let begun = AtomicUsize::new(0);
        let each = |number: usize| {
            begun.fetch_add(1, Ordering::Relaxed);
            number
        };
        assert_eq!(as_it_comes(0..1_000_000, 2, each, |_| Err("no")), Err("no"));
        assert!(begun.load(Ordering::Relaxed) < 1_000_000);
    }
}
