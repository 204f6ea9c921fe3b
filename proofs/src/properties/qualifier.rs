//! Is a sender to be trusted? (E2E-1g, E2E-1j, RULE-5a, RULE-1a)
//!
//! Requalification lasts a second, which is a hundred cycles: it is stated as an induction over its frames. The first good frame
//! after a gap sets a moment; each further one leaves it where it is; known is who is good at or after it.

use supervisor_core::{Cause, Millis};
use supervisor_wire::{Qualifier, Timing};

use super::implies;

fn after(now: Millis, then: Millis) -> Millis {
    Millis::new(now.raw().wrapping_sub(then.raw()))
}

fn good(mut qualifier: Qualifier, now: Millis, timing: Timing) -> Qualifier {
    qualifier.good(now, timing);
    qualifier
}

fn bad(mut qualifier: Qualifier, now: Millis, timing: Timing) -> Qualifier {
    qualifier.bad(now, timing);
    qualifier
}

fn quality(mut qualifier: Qualifier, now: Millis, timing: Timing) -> Result<Millis, Cause> {
    qualifier.quality(now, timing)
}

/// Whether a good frame at `now` makes it known.
fn known_by(qualifier: Qualifier, now: Millis, timing: Timing) -> bool {
    quality(good(qualifier, now, timing), now, timing).is_ok()
}

/// E2E-1g, RULE-1a, CMD-2c: after a good frame, what is known is known with its age exactly as long as the time-out, to the millisecond.
#[must_use]
pub fn e2e_1g_timeout_is_exact(before: Qualifier, timing: Timing, now: Millis, later: Millis) -> bool {
    let heard = good(before, now, timing);
    let age = after(later, now);
    let expected = match quality(heard, now, timing) {
        _ if age > timing.timeout => Err(Cause::Stale),
        Ok(_) => Ok(age),
        Err(cause) => Err(cause),
    };
    quality(heard, later, timing) == expected
        && matches!(quality(heard, now, timing), Ok(Millis::ZERO) | Err(Cause::Requalifying))
}

/// E2E-1g, SELF-3b: what is stale or was never received stays so until a good frame, also when the clock comes round.
#[must_use]
pub fn e2e_1g_stale_stays_stale(before: Qualifier, timing: Timing, now: Millis, later: Millis) -> bool {
    let mut looked = before;
    let first = looked.quality(now, timing);
    implies(matches!(first, Err(Cause::Stale | Cause::NeverReceived)), quality(looked, later, timing) == first)
}

/// The same without time-outs: whether its moment has come.
fn proved_by(qualifier: Qualifier, now: Millis, timing: Timing) -> bool {
    known_by(qualifier, now, Timing { timeout: Millis::new(u32::MAX), ..timing })
}

/// E2E-1j: after a gap, at the start, and after a failure before it was known, a good frame begins the requalification: known is who is good
/// `requalify` after *this* frame, no millisecond sooner.
#[must_use]
pub fn e2e_1j_first_good_frame_begins(before: Qualifier, timing: Timing, now: Millis, later: Millis) -> bool {
    let unqualified = match quality(before, now, timing) {
        Err(Cause::NeverReceived | Cause::Stale) => true,
        // Failed: whether it was known before decides.
        Err(Cause::EndToEnd) => !known_by(before, now, timing),
        Ok(_) | Err(_) => false,
    };
    let begun = good(before, now, timing);
    let proved = after(later, now) >= timing.requalify;
    implies(
        unqualified && timing.requalify > Millis::ZERO,
        quality(begun, now, timing) == Err(Cause::Requalifying) && proved_by(begun, later, timing) == proved,
    )
}

/// E2E-1j: each further good frame leaves that moment where it is, and makes known who has come to it; time-outs change no moment.
#[must_use]
pub fn e2e_1j_further_good_frames_go_on(before: Qualifier, timing: Timing, now: Millis, later: Millis) -> bool {
    let going_on = quality(before, now, timing) == Err(Cause::Requalifying);
    let next = good(before, now, timing);
    let known = quality(next, now, timing).is_ok();
    implies(going_on, known == proved_by(before, now, timing))
        && implies(going_on && !known, proved_by(before, later, timing) == proved_by(next, later, timing))
}

/// E2E-1j, RULE-5a: a frame that fails counts at once. Who was known is known again by the next good frame in time; who was not yet begins
/// anew.
#[must_use]
pub fn rule_5a_failure_counts_at_once(before: Qualifier, timing: Timing, now: Millis, later: Millis) -> bool {
    let was = quality(before, now, timing);
    let failed = bad(before, now, timing);
    let at_once = quality(failed, now, timing) == Err(Cause::EndToEnd);
    let restarts = timing.requalify > Millis::ZERO;
    at_once
        && implies(was.is_ok(), known_by(failed, now, timing))
        && implies(
            restarts && was.is_err() && was != Err(Cause::EndToEnd),
            !known_by(failed, now, timing) && !known_by(failed, later, timing),
        )
}

/// RULE-1a: never received, stale, failed, requalifying or known with an age within the time-out: there is nothing else.
#[must_use]
pub fn rule_1a_quality_is_one_of_five(before: Qualifier, timing: Timing, now: Millis) -> bool {
    match quality(before, now, timing) {
        Ok(age) => age <= timing.timeout,
        Err(cause) => {
            matches!(cause, Cause::NeverReceived | Cause::Stale | Cause::EndToEnd | Cause::Requalifying)
        }
    }
}
