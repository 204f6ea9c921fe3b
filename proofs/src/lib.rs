//! Properties of the supervisor, each stated once as a plain function, and the Kani harnesses that prove them on
//! the shipped [`decide`](supervisor_core::decide()), [`vet`](supervisor_core::vet()) and
//! [`record`](supervisor_core::record()).
//!
//! Inputs, threats, commands, retained states and configurations are never narrowed: the machines have no illegal
//! state, and what is proved for any configuration holds for every valid one. A harness without a loop over data is
//! therefore exhaustive: it holds for every state, reachable or not, and so for all time.
#![forbid(unsafe_code)]

pub mod properties;

#[cfg(kani)]
mod harness;
