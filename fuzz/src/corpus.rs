//! The committed corpus.

use std::path::{Path, PathBuf};

/// Where a target's corpus stands.
pub fn folder(target: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../fuzz/corpus").join(target)
}

/// Every file of a target's corpus, in the order of their names.
///
/// # Errors
/// A file cannot be read, or the folder is not there.
pub fn files(target: &str) -> std::io::Result<Vec<Vec<u8>>> {
    let entries = std::fs::read_dir(folder(target))?.map(|entry| entry.map(|entry| entry.path()));
    let mut files: Vec<PathBuf> = entries.collect::<Result<_, _>>()?;
    files.sort();
    files.iter().map(std::fs::read).collect()
}
