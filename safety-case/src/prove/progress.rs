//! How far a run of the harnesses is: which run, how many are done, how long it will take by the recorded times.

use std::io::IsTerminal;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use super::harness::Harness;
use super::plan::seconds;
use super::record::Record;

/// The progress of a run. The bar stands on the standard error, only if that is a terminal.
#[derive(Debug)]
pub struct Progress {
    bar: Option<ProgressBar>,
    started: Instant,
    jobs: u64,
    tasks: Vec<Task>,
}

#[derive(Debug)]
struct Task {
    name: String,
    expected: Duration,
    state: State,
}

#[derive(Clone, Copy, Debug)]
enum State {
    Waits,
    Runs(Instant),
    Ended,
}

impl Progress {
    pub(super) fn start(harnesses: &[&Harness], record: &Record, jobs: usize) -> Self {
        let tasks: Vec<Task> = harnesses
            .iter()
            .map(|harness| Task {
                name: harness.name.clone(),
                expected: Duration::from_secs(seconds(harness, record)),
                state: State::Waits,
            })
            .collect();
        let total = u64::try_from(tasks.len()).unwrap_or(u64::MAX);
        let bar = std::io::stderr().is_terminal().then(|| {
            let bar = ProgressBar::with_draw_target(Some(total), ProgressDrawTarget::stderr());
            if let Ok(style) = ProgressStyle::with_template("{bar:20} {pos}/{len}  {wide_msg}") {
                bar.set_style(style);
            }
            bar
        });
        Self { bar, started: Instant::now(), jobs: u64::try_from(jobs).unwrap_or(1), tasks }
    }

    pub(super) fn begin(&mut self, index: usize) {
        self.set(index, State::Runs(Instant::now()));
    }

    pub(super) fn end(&mut self, index: usize) {
        self.set(index, State::Ended);
        if let Some(bar) = &self.bar {
            bar.inc(1);
        }
    }

    fn set(&mut self, index: usize, state: State) {
        if let Some(task) = self.tasks.get_mut(index) {
            task.state = state;
        }
        self.show();
    }

    /// Brings the bar up to date.
    pub(super) fn show(&self) {
        let Some(bar) = &self.bar else { return };
        let runs = self.tasks.iter().filter_map(|task| match task.state {
            State::Runs(since) => Some(format!("{} ({})", task.name, words(since.elapsed()))),
            State::Waits | State::Ended => None,
        });
        let runs = runs.collect::<Vec<_>>().join(", ");
        bar.set_message(format!("{}, about {} left: {runs}", words(self.started.elapsed()), words(self.left())));
    }

    /// How many have ended, of how many.
    #[must_use]
    pub fn count(&self) -> (usize, usize) {
        (self.tasks.iter().filter(|task| matches!(task.state, State::Ended)).count(), self.tasks.len())
    }

    /// "3 min so far, about 10 min left".
    #[must_use]
    pub fn times(&self) -> String {
        format!("{} so far, about {} left", words(self.started.elapsed()), words(self.left()))
    }

    /// What is left, by the recorded times: evenly on all cores, but no shorter than the longest that runs.
    fn left(&self) -> Duration {
        let left = |task: &Task| match task.state {
            State::Waits => task.expected,
            State::Runs(since) => task.expected.saturating_sub(since.elapsed()),
            State::Ended => Duration::ZERO,
        };
        let all = self.tasks.iter().map(left).fold(Duration::ZERO, Duration::saturating_add);
        let evenly = Duration::from_secs(all.as_secs().checked_div(self.jobs).unwrap_or(0));
        evenly.max(self.tasks.iter().map(left).max().unwrap_or(Duration::ZERO))
    }

    /// Says something beside the bar.
    pub fn aside<T>(&self, say: impl FnOnce() -> T) -> T {
        match &self.bar {
            Some(bar) => bar.suspend(say),
            None => say(),
        }
    }

    pub(super) fn finish(&self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}

fn words(time: Duration) -> String {
    let seconds = time.as_secs();
    if seconds < 100 { format!("{seconds} s") } else { format!("{} min", seconds.saturating_add(30) / 60) }
}

#[cfg(test)]
mod tests {
    use super::super::record::tests::{list, proof};
    use super::*;

    #[test]
    fn what_is_left_is_told_by_the_recorded_times() -> Result<(), Box<dyn std::error::Error>> {
        let list = list(&["a", "b", "c", "d"])?;
        let mut record = Record::default();
        for (name, seconds) in [("a", 100), ("b", 60), ("c", 40), ("d", 600)] {
            record.put(proof(name, seconds), &list);
        }
        let harnesses: Vec<&Harness> = list.harness.iter().collect();
        let mut progress = Progress::start(&harnesses, &record, 2);
        assert_eq!(progress.left().as_secs(), 600, "the longest alone");
        progress.end(3);
        assert_eq!((progress.left().as_secs(), progress.count()), (100, (1, 4)));
        progress.end(0);
        assert_eq!(progress.left().as_secs(), 60);
        progress.begin(1);
        progress.end(2);
        assert!(progress.left().as_secs() <= 60 && progress.count() == (3, 4));
        assert_eq!(words(Duration::from_secs(99)), "99 s");
        assert_eq!(words(Duration::from_secs(170)), "3 min");
        Ok(())
    }
}
