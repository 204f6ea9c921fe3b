//! Is a sender to be trusted? Any qualifier, timing and times (E2E-1g, E2E-1j, RULE-1a, RULE-5a).

use supervisor_core::{Cause, Millis};
use supervisor_wire::{Qualifier, Timing};

use crate::properties::qualifier::{
    e2e_1g_stale_stays_stale, e2e_1g_timeout_is_exact, e2e_1j_first_good_frame_begins,
    e2e_1j_further_good_frames_go_on, rule_1a_quality_is_one_of_five, rule_5a_failure_counts_at_once,
};

/// E2E-1, RULE-1, RULE-5.
#[kani::proof]
fn e2e_1_qualifier() {
    let (before, timing): (Qualifier, Timing) = (kani::any(), kani::any());
    let (now, later): (Millis, Millis) = (kani::any(), kani::any());
    assert!(e2e_1g_timeout_is_exact(before, timing, now, later));
    assert!(e2e_1g_stale_stays_stale(before, timing, now, later));
    assert!(e2e_1j_first_good_frame_begins(before, timing, now, later));
    assert!(e2e_1j_further_good_frames_go_on(before, timing, now, later));
    assert!(rule_5a_failure_counts_at_once(before, timing, now, later));
    assert!(rule_1a_quality_is_one_of_five(before, timing, now));
    let quality = { before }.quality(now, timing);
    kani::cover!(quality == Err(Cause::Requalifying), "requalifying");
    kani::cover!(quality == Err(Cause::Stale), "stale");
    kani::cover!(quality.is_ok(), "known");
}

/// E2E-1j: base of the induction: nothing received yet is known by no frame but after its requalification.
#[kani::proof]
fn e2e_1j_nothing_is_known_at_the_start() {
    let (timing, now): (Timing, Millis) = (kani::any(), kani::any());
    let mut start = Qualifier::NEVER;
    assert!(start.quality(now, timing) == Err(Cause::NeverReceived));
    start.good(now, timing);
    assert!((start.quality(now, timing) == Ok(Millis::ZERO)) == (timing.requalify == Millis::ZERO));
    kani::cover!(start.quality(now, timing) == Err(Cause::Requalifying), "requalification begins");
}
