//! The steering shall follow its angle (RSP-1): first response, then the target.

use supervisor_terms::word::retained;
use supervisor_terms::{AngleDeciDeg, Millis, Timer};

retained! {
    /// Compares the measured with the commanded angle, either way.
    SteeredAngle {
        /// The measured angle when it began to be off.
        start: AngleDeciDeg = AngleDeciDeg::ZERO,
        /// The target then.
        target: AngleDeciDeg = AngleDeciDeg::ZERO,
        /// Since then.
        off: Timer = Timer::STOPPED,
        /// Since then without any response.
        still: Timer = Timer::STOPPED,
        /// Beyond the target by more than the band.
        over: Timer = Timer::STOPPED,
    }
}

/// A change of more than this, in 0.1°, is a response (S4 table 4: the resolution is 0.1°).
const RESPONSE: u16 = 3;

impl SteeredAngle {
    /// One cycle. `band` is how far off is no fault; nothing measured: it stays as it is.
    #[must_use]
    pub fn advance(self, target: AngleDeciDeg, measured: Option<AngleDeciDeg>, band: u16, elapsed: Millis) -> Self {
        let Some(measured) = measured else { return self };
        let off = |from: AngleDeciDeg| measured.raw().abs_diff(from.raw()) > band;
        if !off(target) {
            return Self::INITIAL;
        }
        // It is measured against the target of then: a target that moves on is no fault.
        let begun = if self.off.is_running() { self } else { Self { start: measured, target, ..Self::INITIAL } };
        let rising = begun.target >= begun.start;
        let reached = if rising { measured >= begun.target } else { measured <= begun.target } || !off(begun.target);
        if reached {
            let beyond = if rising { measured > target } else { measured < target };
            let over = self.over.run_while(beyond, elapsed);
            // Beyond the target the direction stays that of then, or an overshoot would count as the way back.
            let start = if beyond { begun.start } else { measured };
            return Self { start, target, off: Timer::STOPPED.run(elapsed), still: Timer::STOPPED, over };
        }
        let moved = measured.raw().abs_diff(begun.start.raw()) > RESPONSE;
        Self {
            off: begun.off.run(elapsed),
            still: begun.still.run_while(!moved, elapsed),
            over: Timer::STOPPED,
            ..begun
        }
    }

    /// It does not follow: no response for `first`, or off its target for `outer`.
    #[must_use]
    pub const fn fails(&self, first: Millis, outer: Millis) -> bool {
        self.still.reached(first) || self.off.reached(outer)
    }
}
