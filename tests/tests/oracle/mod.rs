//! The claims, what they are made of, and the drives they are judged in.
#![expect(dead_code, reason = "who includes it uses a part of it")]

pub mod claims;
mod collision;
mod drive;
pub mod facts;
#[cfg(test)]
mod findings;
mod gearbox;
mod lost;
mod past;
mod read;
mod seat;
pub mod starts;
pub mod trace;
mod voltage;
