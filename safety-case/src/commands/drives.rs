//! `supervise` alone: the drives that ship with the project.

use super::{Outcome, print, root};
use crate::drives::replayed;

/// Runs it.
///
/// # Errors
/// If there are no drives, one cannot be read, or the pages cannot be written.
pub fn run() -> Outcome {
    let root = root()?;
    let target = root.join("target").join("supervise");
    let mut failure = None;
    let drives = replayed(root, &target, &mut |told| {
        failure = failure.take().or_else(|| print(format_args!("{told}\n")).err());
    })?;
    if let Some(error) = failure {
        return Err(error.into());
    }
    print(format!("\nOpen {}\n", target.join("index.html").display()))?;
    if !drives.iter().all(|drive| drive.same) {
        eprintln!("supervise: warning: the supervisor has changed since the drives were made; to make them anew:");
        eprintln!("    cargo run --release -p supervisor-tests --bin make-drives");
    }
    Ok(0)
}
