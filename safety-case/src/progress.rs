//! A progress bar on the standard error, only if that is a terminal and the log is long.

use std::io::IsTerminal;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use crate::replay::Request;

/// Logs shorter than this many bytes are done before a bar could be read.
const LONG: u64 = 4 << 20;
/// The bar is looked at every so many frames.
const EVERY: u64 = 1 << 16;

/// A bar, or nothing.
#[derive(Debug)]
pub struct Progress {
    bar: Option<ProgressBar>,
    read: Arc<AtomicU64>,
}

impl Progress {
    /// Begins to show how far `read` has come through the logs.
    #[must_use]
    pub fn start(request: &Request, read: Arc<AtomicU64>) -> Self {
        let size = |file: &Path| std::fs::metadata(file).map_or(0, |data| data.len());
        let total: u64 = request.logs.iter().map(|file| size(file)).sum();
        let wanted = request.progress && total >= LONG && std::io::stderr().is_terminal();
        let bar = wanted.then(|| {
            let bar = ProgressBar::with_draw_target(Some(total), ProgressDrawTarget::stderr());
            let style = "{bar:40} {percent:>3} %  {bytes_per_sec}  {msg}  {eta} left";
            if let Ok(style) = ProgressStyle::with_template(style) {
                bar.set_style(style);
            }
            bar.enable_steady_tick(Duration::from_millis(200));
            bar
        });
        Self { bar, read }
    }

    /// So many frames were read.
    pub fn tick(&self, frames: u64) {
        if frames.is_multiple_of(EVERY)
            && let Some(bar) = &self.bar
        {
            bar.set_position(self.read.load(Ordering::Relaxed));
            bar.set_message(format!("{} frames", crate::number::grouped(frames)));
        }
    }

    /// Takes the bar away.
    pub fn finish(&self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}
