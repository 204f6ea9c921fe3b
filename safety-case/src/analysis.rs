//! The safety analysis as data: hazards, goals, requirements, assumptions, timing, readings, and their checks; and what an
//! assessor asks of the making: failure modes of the parts, tools, methods, limitations and the risks that are left.
//!
//! [`load`] reads the folder `safety-case/analysis` and accepts only what the structs below describe: an unknown or
//! missing key is an error that names file and entry. [`check`] then looks at the whole and finds what does not hold
//! together; an analysis without a finding has, for every hazardous event, a goal; for every goal, requirements and a chain of
//! times that fits its FTTI; for every requirement, a source, a goal and a method; and no reference that leads nowhere.
//!
//! Everything in the analysis is *assumed* until an integrator confirms it: the words that claim more are findings.

mod check;
mod fmea;
mod limitations;
mod load;
mod methods;
mod model;
#[cfg(test)]
mod plants;
#[cfg(test)]
mod tests;
mod tools;

pub use check::{FORBIDDEN, Finding, Rule, check, check_words};
pub use fmea::{Evidence, Failure, Kind};
pub use limitations::{Limitation, LimitationKind, Risk};
pub use load::{AnalysisError, load};
pub use methods::{Answer, Degree, MethodRow, MethodTable};
pub use model::*;
pub use tools::{Tool, ToolFailure};
