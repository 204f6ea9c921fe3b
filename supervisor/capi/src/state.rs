//! What is kept between the cycles.

use supervisor::wire::{Receiver, Sender};
use supervisor::{Decision, Flow, Millis, Supervisor};

use crate::memory::Kept;
use crate::types::SupervisorState;

/// The supervisor, its link and what it decided last.
#[derive(Debug)]
pub(crate) struct State {
    pub(crate) supervisor: Supervisor,
    pub(crate) receiver: Receiver,
    pub(crate) sender: Sender,
    pub(crate) last: Option<Last>,
}

/// The last step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Last {
    pub(crate) now: Millis,
    pub(crate) decision: Decision,
    /// What the watchdog has not been told yet. [`Flow::START`] once it has: a step is good for one answer.
    pub(crate) flow: Flow,
}

impl Kept for State {
    type Memory = SupervisorState;
    /// "SUPV".
    const MAGIC: u32 = 0x5650_5553;
}
