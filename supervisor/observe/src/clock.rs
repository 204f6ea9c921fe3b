//! Time (SELF-3): an argument, u32 milliseconds that wrap.

use supervisor_terms::word::retained;
use supervisor_terms::{Config, Millis};

/// Clock faults in a row that lead to the safe state.
const FAULTS_IN_A_ROW: u8 = 3;

retained! {
    /// The clock machine.
    Clock {
        /// A first cycle has been seen.
        started: bool = false,
        /// Time of the last cycle.
        last: Millis = Millis::ZERO,
        /// Clock faults in a row, saturating.
        faults: u8 = 0,
    }
}

/// What this cycle adds to the timers.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(kani, derive(kani::Arbitrary))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
pub struct Ticks {
    /// For everything that leads to a permission, or ends an obligation: 0 in a cycle with a clock fault.
    pub permission: Millis,
    /// For everything that leads to an obligation or ends a permission: nominal in a cycle with a clock fault.
    pub safety: Millis,
    /// dt was outside its range.
    pub fault: bool,
}

impl Clock {
    /// END-1b, SELF-3: judges the time since the last cycle.
    #[must_use]
    pub fn advance(self, now: Millis, config: &Config) -> (Self, Ticks) {
        let elapsed = Millis::new(now.raw().wrapping_sub(self.last.raw()));
        let plausible = elapsed >= config.cycle_least && elapsed <= config.cycle_greatest;
        let next = |faults| Self { started: true, last: now, faults };
        if !self.started {
            let ticks = Ticks { permission: Millis::ZERO, safety: config.cycle_nominal, fault: false };
            (next(0), ticks)
        } else if plausible {
            (next(0), Ticks { permission: elapsed, safety: elapsed, fault: false })
        } else {
            let ticks = Ticks { permission: Millis::ZERO, safety: config.cycle_nominal, fault: true };
            (next(self.faults.saturating_add(1)), ticks)
        }
    }

    /// SELF-3: three in a row lead to the safe state.
    #[must_use]
    pub const fn is_lost(self) -> bool {
        self.faults >= FAULTS_IN_A_ROW
    }
}
