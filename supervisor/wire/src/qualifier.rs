//! Is a sender to be trusted yet? (E2E-1g, E2E-1j, RULE-5a)

use supervisor_core::{Cause, Millis};

/// The times of one message.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(kani, derive(kani::Arbitrary))]
pub struct Timing {
    /// Silent for longer than this is a gap.
    pub timeout: Millis,
    /// How long frames must be good after a gap.
    pub requalify: Millis,
}

/// Qualification of one message, or of one foreign signal.
///
/// Never → requalifying → known; a failed frame is disobeyed at once and until the next good one; a gap, a failed
/// frame while requalifying, and the very start call for requalification. At the start no gap was seen, but an ECU
/// that has just started sends wrong content too (0.64 s in the recorded log), so it counts as one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(kani, derive(kani::Arbitrary))]
pub struct Qualifier {
    phase: Phase,
    /// Of the last good frame; while failed unqualified, of the last failed one.
    last: Millis,
    /// Of the first good frame after the gap.
    since: Millis,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(kani, derive(kani::Arbitrary))]
enum Phase {
    Never,
    Stale,
    Requalifying,
    Known,
    /// Failed after it was known: the next good frame is enough.
    Failed,
    /// Failed before it was known: requalification starts again.
    FailedUnqualified,
}

/// Longer than any time-out.
pub(crate) const FOREVER: Millis = Millis::new(u32::MAX);

/// Time from `then` to `now`, across a wrap of the clock. A clock that steps back makes it very long.
pub(crate) const fn elapsed(now: Millis, then: Millis) -> Millis {
    Millis::new(now.raw().wrapping_sub(then.raw()))
}

impl Qualifier {
    /// Nothing received yet.
    pub const NEVER: Self = Self { phase: Phase::Never, last: Millis::ZERO, since: Millis::ZERO };

    /// A frame that passed its checks.
    ///
    /// E2E-1j: after a gap, known only once good frames have run for `requalify`.
    pub fn good(&mut self, now: Millis, timing: Timing) {
        self.expire(now, timing);
        let begins = matches!(self.phase, Phase::Never | Phase::Stale | Phase::FailedUnqualified);
        if begins {
            self.since = now;
        }
        let proving = begins || self.phase == Phase::Requalifying;
        let short = elapsed(now, self.since) < timing.requalify;
        self.phase = if proving && short { Phase::Requalifying } else { Phase::Known };
        self.last = now;
    }

    /// A frame that failed a check.
    pub fn bad(&mut self, now: Millis, timing: Timing) {
        self.expire(now, timing);
        let qualified = matches!(self.phase, Phase::Known | Phase::Failed);
        (self.phase, self.last) = if qualified { (Phase::Failed, self.last) } else { (Phase::FailedUnqualified, now) };
    }

    /// RULE-1a: the age of what was received last, or why it does not count. Once stale, it stays so until a good frame.
    ///
    /// # Errors
    /// The cause of "unknown".
    pub fn quality(&mut self, now: Millis, timing: Timing) -> Result<Millis, Cause> {
        self.expire(now, timing);
        match self.phase {
            Phase::Never => Err(Cause::NeverReceived),
            Phase::Stale => Err(Cause::Stale),
            Phase::Requalifying => Err(Cause::Requalifying),
            Phase::Known => Ok(elapsed(now, self.last)),
            Phase::Failed | Phase::FailedUnqualified => Err(Cause::EndToEnd),
        }
    }

    /// E2E-1g: older than the time-out is stale. Kept, so that a wrap of the clock cannot make it young again.
    fn expire(&mut self, now: Millis, timing: Timing) {
        if self.phase != Phase::Never && elapsed(now, self.last) > timing.timeout {
            self.phase = Phase::Stale;
        }
    }
}
