//! The safety analysis as data, and the host program `supervise`: it replays drives through the supervisor, shows
//! and explains every verdict.
//!
//! Where to look: a line of a log, `candump`; how frames become inputs, `road`; when to step, `grid.rs`; the loop,
//! `replay.rs`; what is worth seeing over time, `lanes` and `runs.rs`; what people read, `timeline.rs`,
//! `summary.rs`, `document.rs` (JSON), `page` (HTML). Which code and test belongs to which requirement, `trace`.
//! What becomes of injected faults, `inject`; of scenarios, `simulate`; whom the supervisor disturbs, `disturb`. Why all of it shows that the goals are kept, `argument`; all of
//! it in one folder, `evidence`.
#![forbid(unsafe_code)]

pub mod analysis;
pub mod argument;
pub mod built;
pub mod candump;
pub mod cli;
pub mod commands;
pub mod copy;
pub mod cost;
pub mod coverage;
pub mod cycle;
pub mod difference;
pub mod digest;
pub mod disturb;
pub mod document;
pub mod drives;
pub mod error;
pub mod evidence;
pub mod fuzz;
pub mod grid;
pub mod inject;
pub mod lanes;
pub mod mistakes;
pub mod mutants;
pub mod notes;
pub mod number;
pub mod page;
pub mod physical;
pub mod progress;
pub mod prove;
pub mod replay;
pub mod road;
pub mod runs;
pub mod simulate;
pub mod spread;
pub mod statistics;
pub mod stretches;
pub mod summary;
pub mod template;
pub mod timeline;
pub mod trace;
pub mod troubles;
pub mod words;
