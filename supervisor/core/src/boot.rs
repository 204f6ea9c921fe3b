//! The boot rule (SELF-9): what the reset cause and the persisted record make of the first seconds.

use crate::seat::SeatState;
use supervisor_observe::Ticks;
use supervisor_observe::{Evidence, SeatView};

use supervisor_terms::word::{codes, retained};
use supervisor_terms::{Config, EpbState, Inputs, Timer};

codes! {
    /// Whether the boot rule still waits for seat and parking brake.
    Pending {
        /// Settled.
        Done = 0,
        /// A clean key-on.
        Clean = 1,
        /// Any other boot.
        Other = 2,
    }
}

retained! {
    /// The boot machine.
    Boot {
        /// What it waits for.
        pending: Pending = Pending::Other,
        /// How long.
        wait: Timer = Timer::STOPPED,
    }
}

/// What boot decides in a cycle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Verdict {
    /// Nothing.
    Nothing,
    /// A clean key-on with the seat occupied: counts as Off seen.
    OffSeen,
    /// Parking brake applied, seat not occupied: parked by leave.
    ParkedByLeave,
}

impl Boot {
    /// `clean` = power-on with an intact record of nothing.
    pub(crate) const fn new(clean: bool) -> Self {
        Self { pending: if clean { Pending::Clean } else { Pending::Other }, wait: Timer::STOPPED }
    }

    pub(crate) fn advance(
        self,
        seat: &SeatState,
        evidence: &Evidence,
        inputs: &Inputs,
        ticks: Ticks,
        config: &Config,
    ) -> (Self, Verdict) {
        let wait = self.wait.run_while(self.pending != Pending::Done, ticks.safety);
        let settled = evidence.seat == SeatView::Vacant || wait.reached(config.boot_settle);
        let done = Self { pending: Pending::Done, wait: Timer::STOPPED };
        match (self.pending, seat.confirmed(config)) {
            (Pending::Clean, true) => (done, Verdict::OffSeen),
            (Pending::Done, _) | (Pending::Other, true) => (done, Verdict::Nothing),
            (Pending::Clean | Pending::Other, false) if settled && inputs.epb.is(EpbState::Applied) => {
                (done, Verdict::ParkedByLeave)
            }
            (Pending::Clean | Pending::Other, false) if settled && inputs.epb.is(EpbState::Released) => {
                (done, Verdict::Nothing)
            }
            (pending @ (Pending::Clean | Pending::Other), false) => (Self { pending, wait }, Verdict::Nothing),
        }
    }
}
