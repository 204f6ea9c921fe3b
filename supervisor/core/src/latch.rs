//! Which faults stay, and what clears them? (SELF-3, SELF-4, SELF-5, SELF-6, SELF-7)
//!
//! Latched faults clear only all together: at standstill, with the parking brake applied, after a time without a
//! cause, by the key seen Off and then On or Start.

use supervisor_observe::{Evidence, Ticks};

use supervisor_terms::word::retained;
use supervisor_terms::{Config, EpbState, Faults, Inputs, Key, Timer};

retained! {
    /// The latched faults.
    Latches {
        /// Clock, state, flow, configuration: the safe state. Contactor: nothing closes.
        faults: Faults = Faults::NONE,
        /// Since when there has been no cause, at standstill with the parking brake applied.
        quiet: Timer = Timer::STOPPED,
        /// After that time the key was seen Off.
        off_seen: bool = false,
    }
}

impl Latches {
    /// These faults latched.
    pub(crate) const fn with(faults: Faults) -> Self {
        Self { faults, ..Self::INITIAL }
    }

    /// SELF-5: any latched fault of the supervisor itself is the safe state.
    pub(crate) fn safe_state(&self) -> bool {
        self.faults.and(Faults::SAFE_STATE) != Faults::NONE
    }

    /// SELF-7: a contactor fault is latched.
    pub(crate) fn contactor(&self) -> bool {
        self.faults.contains(Faults::CONTACTOR)
    }

    /// `cause` is what latches in this cycle.
    pub(crate) fn advance(
        self,
        cause: Faults,
        evidence: &Evidence,
        inputs: &Inputs,
        ticks: Ticks,
        config: &Config,
    ) -> Self {
        let still = evidence.standstill && inputs.epb.is(EpbState::Applied);
        let calm = still && cause == Faults::NONE && !ticks.fault;
        let quiet = self.quiet.run_while(calm, ticks.permission);
        let ready = quiet.reached(config.fault_free);
        let off_seen = ready && (self.off_seen || inputs.key.is(Key::Off));
        let clears = off_seen && (inputs.key.is(Key::On) || inputs.key.is(Key::Start));
        if clears { Self { quiet, ..Self::INITIAL } } else { Self { faults: self.faults.with(cause), quiet, off_seen } }
    }
}
