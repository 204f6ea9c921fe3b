//! A bus that stands without its driver: its parking brake and its high voltage (HZ-04, HZ-07).

use supervisor::EpbState;

use crate::plant::{CYCLE_MS, Truth};

/// S3 §2.6: how long an unattended bus may stay under high voltage, in ms.
const TOLERATED_MS: u32 = 600_000;

/// What became of parking brake and contactors since the seat is empty.
#[derive(Clone, Copy, Debug, Default)]
pub struct Parked {
    /// The parking brake was applied with the seat empty ...
    applied: bool,
    /// ... and is no longer.
    let_go: bool,
    for_ms: u32,
    /// A contactor was open with the seat empty.
    open: [bool; 2],
}

impl Parked {
    /// One cycle.
    pub fn see(&mut self, truth: &Truth, empty: bool) {
        if !empty {
            *self = Self::default();
            return;
        }
        let applied = truth.epb == Some(EpbState::Applied);
        self.let_go = (self.let_go || self.applied) && !applied;
        self.applied |= applied;
        self.for_ms = if applied { self.for_ms.saturating_add(CYCLE_MS) } else { 0 };
        for (was_open, closed) in self.open.iter_mut().zip(truth.closed) {
            *was_open |= !closed;
        }
    }

    /// It was applied with an empty seat and is no longer.
    #[must_use]
    pub const fn let_go(&self) -> bool {
        self.let_go
    }

    /// High voltage beyond the ten minutes, or come back by itself.
    #[must_use]
    pub fn live(&self, truth: &Truth) -> bool {
        let back = self.open.iter().zip(truth.closed).any(|(was_open, closed)| *was_open && closed);
        back || (self.for_ms > TOLERATED_MS && truth.closed.contains(&true))
    }
}
