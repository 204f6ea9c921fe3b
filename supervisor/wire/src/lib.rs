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
pub use message::{ControlTime, Destination, E2eClass, SignalLayout, Source};
pub use protection::Protection;
pub use qualifier::{Qualifier, Timing};
pub use receiver::{Receiver, Sample};
pub use refusal::{Accepted, Fault, Refusal};
pub use sender::Sender;
pub use table::Message;
