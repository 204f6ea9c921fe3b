//! What can go wrong besides a proof.

use std::fmt::Display;
use std::fs;
use std::path::{Path, PathBuf};

/// What can go wrong besides a proof.
#[derive(Debug, thiserror::Error)]
pub enum ProveError {
    /// A file cannot be read or written.
    #[error("{path}: {error}", path = path.display())]
    File {
        /// Which.
        path: PathBuf,
        /// Why.
        error: std::io::Error,
    },
    /// A file does not say what it should.
    #[error("{path}: {message}", path = path.display())]
    Form {
        /// Which.
        path: PathBuf,
        /// What is wrong.
        message: String,
    },
    /// `cargo kani` did not start.
    #[error("cargo kani: {0}")]
    Tool(std::io::Error),
    /// `cargo kani` ended without a result: the sources do not compile, or Kani itself failed.
    #[error("cargo kani ended without a result for {harness}:\n{log}")]
    NoResult {
        /// What it should have run.
        harness: String,
        /// The end of what it said.
        log: String,
    },
    /// A harness of that name is not in the list.
    #[error("no harness named {0} in proofs/harnesses.toml")]
    Unknown(String),
    /// Arguments that do not fit.
    #[error("{0}")]
    Arguments(String),
}

pub(super) fn read(path: &Path) -> Result<String, ProveError> {
    fs::read_to_string(path).map_err(|error| file(path, error))
}

pub(super) fn write(path: &Path, bytes: &[u8]) -> Result<(), ProveError> {
    let folder = path.parent().map_or(Ok(()), fs::create_dir_all);
    folder.and_then(|()| fs::write(path, bytes)).map_err(|error| file(path, error))
}

pub(super) fn file(path: &Path, error: std::io::Error) -> ProveError {
    ProveError::File { path: path.to_owned(), error }
}

pub(super) fn form(path: &Path, message: &dyn Display) -> ProveError {
    ProveError::Form { path: path.to_owned(), message: message.to_string() }
}
