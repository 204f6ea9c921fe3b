//! One actuator that shall reach a target (RSP-1): time to 95 %, then no more than 15 % below it.

use supervisor_terms::word::retained;
use supervisor_terms::{Millis, Timer};

retained! {
    /// Compares what an actuator gives with what it was told. Target and measured value in the same unit.
    ///
    /// A target that rises on is no fault: the actuator is measured against the lowest target since it fell short.
    Follow {
        /// Lowest target since it fell short; the target while it follows.
        reference: u16 = 0,
        /// What was measured when it fell short.
        start: u16 = 0,
        /// Since the command that it does not follow.
        command: Timer = Timer::STOPPED,
        /// Since its first response to that command.
        response: Timer = Timer::STOPPED,
        /// The target was reached.
        following: bool = false,
        /// Short by more than the steady-state error allowed.
        far: bool = false,
    }
}

/// 95 % of the target is reached (S4 3.8).
const REACHED: u32 = 95;
/// 5 % of the way there is a first response.
const RESPONDED: u32 = 5;

impl Follow {
    /// One cycle. `error` is the steady-state error allowed, in per cent. Nothing measured: it stays as it is.
    #[must_use]
    pub fn advance(self, target: u16, measured: Option<u16>, error: u8, elapsed: Millis) -> Self {
        if target == 0 {
            return Self::INITIAL;
        }
        let Some(measured) = measured else { return self };
        let reference = if self.reference == 0 { target } else { self.reference.min(target) };
        let needed = if self.following { 100_u32.saturating_sub(u32::from(error)) } else { REACHED };
        let hundredfold = u32::from(measured).saturating_mul(100);
        if hundredfold >= u32::from(reference).saturating_mul(needed) {
            return Self { reference: target, following: true, ..Self::INITIAL };
        }
        let start = if self.command.is_running() { self.start } else { measured };
        let way = u32::from(reference.saturating_sub(start)).saturating_mul(RESPONDED);
        let responds = hundredfold >= u32::from(start).saturating_mul(100).saturating_add(way);
        Self {
            reference,
            start,
            command: self.command.run(elapsed),
            response: self.response.run_while(responds, elapsed),
            following: false,
            far: hundredfold < u32::from(reference).saturating_mul(100_u32.saturating_sub(u32::from(error))),
        }
    }

    /// The same with its times begun anew: the demand has become a stronger one.
    #[must_use]
    pub const fn restarted(self) -> Self {
        Self { command: Timer::STOPPED, response: Timer::STOPPED, ..self }
    }

    /// It does not follow: `outer` since the command, or `inner` since its first response, has passed.
    #[must_use]
    pub const fn fails(&self, inner: Millis, outer: Millis) -> bool {
        self.command.reached(outer) || self.response.reached(inner)
    }
}
