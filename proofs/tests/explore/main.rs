//! Exhaustive exploration.
#![forbid(unsafe_code)]

mod candump;
mod checks;
mod coverage;
mod identity;
mod model;
mod plant;
mod report;
mod seat;
mod trace;
mod vectors;
