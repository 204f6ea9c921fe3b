//! Runs harnesses side by side: each worker has a target directory of its own and takes the next one.

use std::collections::VecDeque;
use std::path::Path;
use std::sync::Mutex;
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::thread;
use std::time::Duration;

use super::harness::Harness;
use super::kani::{self, Options, Outcome};
use super::progress::Progress;
use super::record::Record;
use crate::error::ToolError;

/// The display is brought up to date so often.
const TICK: Duration = Duration::from_secs(1);

/// How harnesses run.
#[derive(Debug)]
pub struct Workers<'a> {
    /// The workspace.
    pub root: &'a Path,
    /// Each worker builds in a folder of this one.
    pub target: &'a Path,
    /// How many run at once.
    pub jobs: usize,
    /// How each of them runs.
    pub options: &'a Options,
}

enum Event {
    Begun(usize),
    Ended(usize, Box<Result<Outcome, ToolError>>),
}

impl Workers<'_> {
    /// Runs these harnesses in this order, and hands over what each came to as soon as it ended, with a way to say lines
    /// that does not disturb the display. A harness without a result stops no other.
    ///
    /// # Errors
    /// The first one of `ended`; what runs then still ends, and nothing new begins.
    pub fn run(
        &self,
        harnesses: &[&Harness],
        record: &Record,
        mut ended: impl FnMut(&Harness, Result<Outcome, ToolError>, &Progress) -> Result<(), ToolError>,
    ) -> Result<(), ToolError> {
        let jobs = self.jobs.clamp(1, harnesses.len().max(1));
        let queue = Mutex::new((0..harnesses.len()).collect::<VecDeque<usize>>());
        let mut progress = Progress::start(harnesses, record, jobs);
        let (sender, events) = channel();
        thread::scope(|scope| {
            for worker in 0..jobs {
                let (sender, queue) = (sender.clone(), &queue);
                scope.spawn(move || self.work(worker, harnesses, queue, &sender));
            }
            drop(sender);
            let mut outcome = Ok(());
            loop {
                match events.recv_timeout(TICK) {
                    Ok(Event::Begun(index)) => progress.begin(index),
                    Ok(Event::Ended(index, result)) => {
                        progress.end(index);
                        if let (Some(harness), true) = (harnesses.get(index), outcome.is_ok()) {
                            outcome = ended(harness, *result, &progress);
                        }
                        if outcome.is_err()
                            && let Ok(mut queue) = queue.lock()
                        {
                            queue.clear();
                        }
                    }
                    Err(RecvTimeoutError::Timeout) => progress.show(),
                    Err(RecvTimeoutError::Disconnected) => break,
                }
            }
            progress.finish();
            outcome
        })
    }

    fn work(&self, worker: usize, harnesses: &[&Harness], queue: &Mutex<VecDeque<usize>>, events: &Sender<Event>) {
        let target = self.target.join(worker.to_string());
        loop {
            let next = queue.lock().ok().and_then(|mut queue| queue.pop_front());
            let Some((index, harness)) = next.and_then(|index| Some((index, harnesses.get(index)?))) else { return };
            let begun = events.send(Event::Begun(index));
            let result = kani::verify(self.root, &target, harness, self.options);
            if begun.and_then(|()| events.send(Event::Ended(index, Box::new(result)))).is_err() {
                return;
            }
        }
    }
}
