//! Diagnosis: what happened, for people and records. It reads decisions and cannot influence them.
//!
//! - [`EventRecord`] keeps the last changes of every verdict and of the status in a bounded ring, and for those that
//!   matter a [`Snapshot`] of their surroundings.
//! - [`TROUBLE_CODES`] says of every fault what does not work and why: SPN, FMI, lamp, what driver and ADS are told.
//! - [`FaultReport`] debounces the faults: a frame that fails its check is disobeyed at once, only its *report* waits.
//! - [`BodyMonitor`] finds lamps and wipers that do not follow; that is reported, and nothing more (RSP-1h).
//! - [`Dm1Sender`] puts what is active on the bus as J1939 DM1.
//! - [`exit_notice`] says why the automated mode ended.
//!
//! ```
//! use supervisor_core::{Commands, ConfigError, Flow, Inputs, Millis, Record, ResetCause, Sealed, State, StateImage, Threat};
//! use supervisor_report::{BodyFeedback, BodyMonitor, Dm1Sender, EventRecord, FaultReport};
//!
//! # fn main() -> Result<(), ConfigError> {
//! # let (mut image, sealed) = (StateImage::encode(&State::boot(ResetCause::PowerOn, Some(Record::None))), Sealed::from_default()?);
//! # let (inputs, mut sent) = (Inputs::NEVER, Vec::new());
//! let (mut lamps, mut faults, mut dm1) = (BodyMonitor::new(), FaultReport::default(), Dm1Sender::new(0x80));
//! let mut record = EventRecord::<64, 4>::new();
//! for now in (0..5000).step_by(10).map(Millis::new) {
//! #   let decision = supervisor_core::step(&mut image, &sealed, Flow::PERCEIVED, now, &inputs, &Threat::UNKNOWN, &Commands::ABSENT);
//!     // In every cycle, after the step:
//!     record.observe(now, &decision, Some(&inputs));
//!     faults.observe(now, &decision, lamps.observe(now, &decision, &BodyFeedback::NEVER));
//!     sent.extend(dm1.poll(now, &faults));
//! }
//! // Nothing was ever received, so there is much to tell: a broadcast is announced, then follow its packets.
//! assert!(faults.lamps().amber_warning && faults.active().any(|trouble| trouble.code.spn.raw() == 84));
//! assert!(sent.len() > 2 && sent.iter().take(1).all(|frame| frame.id == 0x1CEC_FF80));
//! # Ok(())
//! # }
//! ```
#![no_std]
#![forbid(unsafe_code)]
#![deny(clippy::arithmetic_side_effects, clippy::float_arithmetic, clippy::indexing_slicing, clippy::unreachable)]

#[cfg(kani)]
extern crate kani;

mod body;
mod clock;
mod code;
mod dm1;
mod event;
mod fault;
mod notice;
mod ring;
mod sender;
mod snapshot;
mod table;

pub use body::{BodyFaults, BodyFeedback, BodyMonitor, BodyPart, FOLLOW};
pub use code::{Fmi, Lamp, Source, Spn, System, TroubleCode};
pub use event::{Event, EventRecord, What};
pub use fault::{DEBOUNCE, FaultReport, HEAL, Lamps, SETTLE, Trouble};
pub use notice::{ExitNotice, exit_notice};
pub use sender::{Dm1Sender, J1939Frame, PERIOD, SPACING};
pub use snapshot::{Bounds, Snapshot};
pub use table::{OWN_SPN, TROUBLE_CODES};
