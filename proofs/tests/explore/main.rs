//! Exhaustive exploration.
#![forbid(unsafe_code)]

mod candump;
mod checks;
mod collision;
mod coverage;
mod drive;
mod identity;
mod model;
mod plant;
mod report;
mod seat;
mod selftest;
mod trace;
mod vectors;
