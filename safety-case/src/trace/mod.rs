//! `supervise trace`: which code, numbers, proofs and tests belong to which requirement, from the ids in the sources.
//!
//! The table is not written by hand: the ids that stand in the comments *are* the table. What an id must look like:
//!
//! | where | a tag is | names |
//! |---|---|---|
//! | functions and constants of `supervisor` | ids at the start of any comment in them, or alone in parentheses: `(MIT-4)` | demands, groups |
//! | rows of `limits!` | the requirement column | a demand |
//! | functions of `proofs/src/properties` | ids at the start of the doc comment | demands |
//! | `proofs/harnesses.toml` | `requirements` | demands |
//! | tests, everywhere | ids at the start of the doc comment: `MIT-4d: ...` | demands |
//! | steps of `.ci/run` | ids at the start of a comment below `step "..."` | demands |
//!
//! Each paragraph of a comment may begin with tags. Lists and ranges are read: `MIT-4a to MIT-4d`, `MIT-4a, b`. An id
//! anywhere else (in a sentence, at the head of a file, at a type, field or variant, in a message of an assertion) is a
//! mention: it must name something that exists, and counts for nothing.
//!
//! A group in code (`MIT-4`) stands for each of its demands as long as *no* code names a demand of that group. As soon as
//! one is named, all have to be: the group then counts for none. So a table can become finer, never coarser.
//!
//! Findings: see [`Rule`]. Only a harness that is recorded as proved is evidence; a planned proof is shown and counted, and
//! is no finding.

mod allow;
mod finding;
mod id;
mod json;
mod page;
mod passages;
mod rust;
mod scan;
mod table;
mod text;

use std::path::{Path, PathBuf};

use crate::analysis::{Analysis, AnalysisError, load};
use crate::error::ToolError;

pub use finding::{Finding, Rule};
pub(crate) use id::named;
pub use json::json;
pub use page::page;
pub use scan::{Kind, Place, Scan, Tag, Test, scan};
pub use table::{Carrier, Harnessed, Row, Status, Summary};
pub use text::{rows, summary};

/// Why nothing can be traced.
#[derive(Debug, thiserror::Error)]
pub enum TraceError {
    /// A file cannot be read.
    #[error("{path}: {error}", path = path.display())]
    File {
        /// Which.
        path: PathBuf,
        /// Why.
        error: std::io::Error,
    },
    /// A source is no Rust.
    #[error("{place}: {message}")]
    Rust {
        /// File and line.
        place: String,
        /// Why.
        message: String,
    },
    /// The list of allowances is malformed.
    #[error("{file}: {message}")]
    Allowances {
        /// Which.
        file: String,
        /// Why.
        message: String,
    },
    /// The analysis cannot be read.
    #[error(transparent)]
    Analysis(#[from] AnalysisError),
    /// The list of harnesses or the record of the proofs cannot be read.
    #[error(transparent)]
    Proofs(#[from] ToolError),
}

/// The traced project.
#[derive(Debug)]
pub struct Trace {
    /// One row for each requirement, in the order of the analysis.
    pub rows: Vec<Row>,
    /// What does not hold, by file and line.
    pub findings: Vec<Finding>,
    /// What was found in the sources.
    pub scan: Scan,
}

/// Traces the project below `root`.
///
/// # Errors
/// The analysis, a source, the list of harnesses or the record cannot be read.
pub fn trace(root: &Path) -> Result<Trace, TraceError> {
    let analysis: Analysis = load(&root.join("safety-case/analysis"))?;
    let scan = scan(root)?;
    let allowed = allow::Allowances::load(root)?;
    let proofs = table::Proofs::load(root)?;
    let rows = table::rows(root, &analysis, &scan, &proofs);
    let findings = finding::findings(&analysis, &scan, &allowed, &proofs, &rows);
    Ok(Trace { rows, findings, scan })
}
