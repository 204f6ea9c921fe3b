//! What a cycle costs: instructions per stage, counted by callgrind, and the size of the code and of what it retains.
//!
//! Counted, not timed: a count is the same on a busy machine, so a change of a few per cent is a change of the code.
//! It is the greatest over named scenarios and random cycles, not a bound on the worst case; the stack is not measured.

mod callgrind;
mod readme;
mod size;
mod table;
mod tool;

pub use callgrind::counts;
pub use readme::{Difference, Shown, block, differences, main_rows, replaced};
pub use size::{Size, retained, sizes};
pub use table::{Call, Row, bar, calls, markdown, rows};
pub use tool::{Measured, Tools, has, measure};

use std::path::PathBuf;

/// What can go wrong.
#[derive(Debug, thiserror::Error)]
pub enum CostError {
    /// A file cannot be read or written.
    #[error("{path}: {error}", path = path.display())]
    File {
        /// Which.
        path: PathBuf,
        /// Why.
        error: std::io::Error,
    },
    /// A program did not start.
    #[error("{program}: {error}")]
    Start {
        /// Which.
        program: String,
        /// Why.
        error: std::io::Error,
    },
    /// A program failed.
    #[error("{program} failed:\n{text}")]
    Failed {
        /// Which.
        program: String,
        /// What it said.
        text: String,
    },
    /// What a program wrote is not what was expected.
    #[error("{0}")]
    Form(String),
}
