//! candump logs: lines, files, and what was wrong with them.

mod line;
mod lines;
mod log;
mod source;

pub use line::{Line, LogFrame, Malformed, Skipped, parse};
pub use lines::{Lines, Text};
pub use log::Log;
pub use source::{OpenError, Source};
