//! What can go wrong while a tool works on the workspace.

use std::fmt::Display;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// What can go wrong while a tool works on the workspace.
#[derive(Debug, thiserror::Error)]
pub enum ToolError {
    /// A file cannot be read or written.
    #[error("{path}: {error}", path = path.display())]
    File {
        /// Which.
        path: PathBuf,
        /// Why.
        error: io::Error,
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
        error: io::Error,
    },
    /// A changed copy does not compile, or there is no test of that name.
    #[error("the copy does not compile:\n{0}")]
    Compile(String),
    /// A test fails in a copy in which it must pass.
    #[error("{test} fails in the instrumented copy:\n{text}")]
    Test {
        /// Which.
        test: String,
        /// The end of what it said.
        text: String,
    },
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

impl ToolError {
    /// For a program that does not start.
    pub(crate) fn start(program: &str) -> impl Fn(io::Error) -> Self + '_ {
        move |error| Self::Start { program: program.to_owned(), error }
    }
}

pub(crate) fn read(path: &Path) -> Result<String, ToolError> {
    fs::read_to_string(path).map_err(|error| file(path, error))
}

pub(crate) fn write(path: &Path, bytes: &[u8]) -> Result<(), ToolError> {
    let folder = path.parent().map_or(Ok(()), fs::create_dir_all);
    folder.and_then(|()| fs::write(path, bytes)).map_err(|error| file(path, error))
}

pub(crate) fn file(path: &Path, error: io::Error) -> ToolError {
    ToolError::File { path: path.to_owned(), error }
}

pub(crate) fn form(path: &Path, message: &dyn Display) -> ToolError {
    ToolError::Form { path: path.to_owned(), message: message.to_string() }
}
