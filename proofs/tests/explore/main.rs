//! Exhaustive exploration without Kani: breadth first over the reachable states of the shipped
//! [`step`](supervisor_core::step), by the model checker stateright.
//!
//! A transition is a call of the shipped `step`, never a model of it. An exploration has an alphabet of *vectors*, each
//! all that the supervisor reads in one cycle: values at and just beside the thresholds, known and unknown, and what a
//! bad main controller asks for. It follows **every sequence of its vectors, of any length**, until no new state comes,
//! and asks every property of the package in every cycle. `cargo test -p supervisor-proofs --test explore --
//! --nocapture` shows states, transitions and modes; `target/exploration` keeps them, without times.
//!
//! Nothing of a state is abstracted (`identity.rs`) but the absolute time, and how far a timer is beyond its last span.
//! Two bounds are in *when* an input may change, both on timers, because each cycle of each timer against each cycle of
//! each other is too much:
//! - between two events of its timers (begun, about to pass a span, passed) a vector is held; a short timer's event is
//!   an occasion for every vector, whatever the other short ones do;
//! - the way of a long timer (1 s and more) is crossed by holding one of a few vectors, and that of a very long one (the ten
//!   minutes, a leave without a speed) only from a state in which every short timer stands or has passed.
//!
//! Timers are scaled down by configuration, to the least that the table of limits allows (`vectors.rs`); a cycle takes
//! the longest legal 50 ms. *Within N cycles* is counted in the state (`Promise`), with an environment in which
//! everything cooperates (`plant.rs`).
//!
//! A finding prints the shortest way to it, and writes it as a log that `supervise replay` shows (`candump.rs`).
//! States are told apart by 64-bit fingerprints: that two of 10⁵ states share one has a chance below 10⁻⁹.
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
