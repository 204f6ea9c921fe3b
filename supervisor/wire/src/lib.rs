//! CAN frames to inputs and commands, outputs to CAN frames.
//!
//! Principles:
//! 1. **Described once.** `table.rs` holds every message with every signal; reading and writing come from the same
//!    row, `ebus.dbc` says the same to other tools, and a test compares both.
//! 2. **Closed and strict.** A protected frame is accepted only if writing what was read gives the same bytes. Bare
//!    J1939 frames carry signals of others: their bits are left alone.
//! 3. **A checksum alone proves nothing**: the frame of zeros with id 0 passes the one of TSC1, and an old frame
//!    passes any. A command needs a counter that goes on from the frame before.
//! 4. **Nothing counts before it has proved itself**: after a gap, and the start is one, inputs are unknown until
//!    their sender was right for a time.
//! 5. **Time is an argument**, u32 milliseconds, and may wrap.
//!
//! # How a receiver tells a dead supervisor (SELF-8a)
//! Every output comes by its period or sooner, with a running counter and a check field: Profile 11, and in TSC1 and
//! XBR those of J1939. A receiver goes to its safe reaction when one of these holds, each for itself:
//! - *silent*: no good frame of a message for 2.5 times its control time (XBR and TSC1 of the drive: 125 ms);
//! - *frozen*: the counter stands still. Such a frame is not a good one, so this ends in the same time-out;
//! - *old*: frames that run on, but from a queue. `SupervisorStatus` carries the supervisor's clock as time stamp. The
//!   receiver keeps the least difference *own clock − time stamp* it has seen: its age is by how much the difference
//!   of the newest frame is greater, plus the time since that frame came. Older than 125 ms is dead. A time stamp that
//!   does not move on with the counter is a supervisor whose clock stands. Two crystals of 100 ppm drift apart by
//!   0.72 s in an hour: take the least difference of the last ten seconds.
//!
//! TSC1 and XBR have no room for a time stamp; what they say is as old as the status that comes with them.
//!
//! # Who else commands the actuators? (SELF-10)
//! [`Receiver::accept_actuator`] takes every frame that the node reads from the bus of the actuators, and compares it
//! with what the [`Sender`] has sent. The main controller belongs on another bus: there, its commands would be foreign.
//!
//! # Load of the bus
//! At 500 kbit/s, frames of at most 160 bits: outputs and status take 12 % at rest, and 42 % when every output changes
//! in every cycle; inputs with empty object lists 11 %, commands 11 %. Full object lists need a bus of their own.
//!
//! # Simulation
//! The feature `simulate` adds what sends inputs and commands, for tests and simulators; no shipped build has it.
//!
//! Where to look: which frames exist? `table.rs`. Is this frame intact? `protection.rs`. In order? `link.rs`. Is its
//! sender to be trusted yet? `qualifier.rs`.
#![no_std]
#![forbid(unsafe_code)]
#![deny(
    clippy::arithmetic_side_effects,
    clippy::float_arithmetic,
    clippy::indexing_slicing,
    clippy::string_slice,
    clippy::unreachable,
    clippy::integer_division_remainder_used
)]

#[cfg(kani)]
extern crate kani;

mod coding;
mod frame;
#[cfg(any(kani, feature = "inspect"))]
pub mod inspect;
mod link;
mod list;
mod message;
mod protection;
mod qualifier;
mod receiver;
mod refusal;
mod sender;
mod table;

pub use frame::Frame;
pub use message::{ControlTime, Destination, SignalLayout, Source};
pub use protection::Protection;
pub use qualifier::{Qualifier, Timing};
pub use receiver::{Receiver, Sample};
pub use refusal::{Accepted, Fault, Refusal};
pub use sender::Sender;
pub use table::Message;
