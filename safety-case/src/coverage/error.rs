//! What can go wrong besides something that is not covered.

use std::path::{Path, PathBuf};

use crate::prove::ProveError;

/// What can go wrong besides something that is not covered.
#[derive(Debug, thiserror::Error)]
pub enum CoverageError {
    /// The copy cannot be made, or the sources cannot be read.
    #[error(transparent)]
    Copy(#[from] ProveError),
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
    /// A program did not start.
    #[error("{program}: {error}")]
    Start {
        /// Which.
        program: String,
        /// Why.
        error: std::io::Error,
    },
    /// The instrumented copy does not compile, or there is no test of that name.
    #[error("the instrumented copy does not compile:\n{0}")]
    Compile(String),
    /// A test fails in the instrumented copy.
    #[error("{test} fails in the instrumented copy:\n{text}")]
    Test {
        /// Which.
        test: String,
        /// The end of what it said.
        text: String,
    },
}

impl CoverageError {
    pub(super) fn file(path: &Path, error: std::io::Error) -> Self {
        Self::File { path: path.to_owned(), error }
    }

    pub(super) fn form(path: &Path, message: &dyn std::fmt::Display) -> Self {
        Self::Form { path: path.to_owned(), message: message.to_string() }
    }
}
