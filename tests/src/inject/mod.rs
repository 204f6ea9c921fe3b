//! Faults at random times in correct drives, and what comes of them, judged by the truth of the bus.
//!
//! A run is driven twice from the moment of the injection on: with the supervisor, and without it, with actuators that
//! obey the main controller and check nothing. Where the second does harm, the fault was dangerous there; the first
//! shows what the supervisor made of it.
//!
//! - [`kind`]: what can be done, by name; [`injector`]: one of it in the loop ([`commands`], [`frames`], [`inputs`],
//!   [`own`]);
//! - [`scenarios`]: the correct drives; [`baseline`]: each of them once without a fault, and where a fault may begin;
//! - [`harm`]: which safety goal is violated ([`parked`], [`wheel`]); [`outcome`]: the verdict on one run;
//! - [`campaign`]: fault × scenario, from a seed.

pub mod baseline;
pub mod campaign;
pub mod commands;
pub mod frames;
pub mod harm;
pub mod injector;
pub mod inputs;
pub mod kind;
pub mod outcome;
pub mod own;
pub mod parked;
pub mod scenarios;
pub mod wheel;
