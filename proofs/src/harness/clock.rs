//! Time and latches (SELF-3, SELF-7).

use supervisor_core::{Clock, Config, DrivingMode, Faults, Millis, Outputs, vet_mode};

use super::Any;
use crate::properties::clock::{
    self_3_clock_exactly, self_3_fault_ends_the_mode, self_3_fault_is_reported, self_3_obligations_stay,
    self_3_three_in_a_row_are_the_safe_state,
};
use crate::properties::supervisor::self_7_latches_exactly;

/// SELF-3, SELF-7: what a clock fault does, and the latches, exactly.
#[kani::proof]
#[kani::unwind(17)]
#[kani::stub(supervisor_core::kernel::within_percent, crate::harness::uninterpreted::within_percent)]
fn self_3_clock_and_latches() {
    let any = Any::new();
    let outputs = Outputs { mode: vet_mode(&any.decided.envelope, any.commands.mode).0, ..kani::any() };
    let cycle = any.cycle(&outputs);
    assert!(self_3_clock_exactly(&cycle));
    assert!(self_3_fault_is_reported(&cycle));
    assert!(self_3_obligations_stay(&cycle));
    assert!(self_3_fault_ends_the_mode(&cycle));
    assert!(self_3_three_in_a_row_are_the_safe_state(&cycle));
    assert!(self_7_latches_exactly(&cycle));
    let (old, new) = (&any.old.latches, &any.decided.state.latches);
    kani::cover!(cycle.clock_fault() && !cycle.safe_state(), "a single clock fault");
    kani::cover!(cycle.clock_fault() && any.old.mitigation.three, "a clock fault in level 3");
    kani::cover!(new.faults.contains(Faults::CLOCK_LATCHED) && old.faults == Faults::NONE, "three in a row");
    kani::cover!(old.faults != Faults::NONE && new.faults == Faults::NONE, "the latches clear");
    kani::cover!(outputs.mode == DrivingMode::Automated, "automated, without a fault");
}

/// SELF-3b, END-1b: a wrap changes nothing: moved in time, the same cycle counts the same.
#[kani::proof]
fn self_3_wrap_changes_nothing() {
    let (clock, config): (Clock, Config) = (kani::any(), kani::any());
    let (now, offset): (u32, u32) = (kani::any(), kani::any());
    let moved = Clock { last: Millis::new(clock.last.raw().wrapping_add(offset)), ..clock };
    let (next, ticks) = clock.advance(Millis::new(now), &config);
    let (moved_next, moved_ticks) = moved.advance(Millis::new(now.wrapping_add(offset)), &config);
    assert!(ticks.permission == moved_ticks.permission && ticks.safety == moved_ticks.safety);
    assert!(ticks.fault == moved_ticks.fault);
    assert!(next.started == moved_next.started && next.faults == moved_next.faults);
    kani::cover!(moved.last.raw() > now.wrapping_add(offset) && !ticks.fault, "a good cycle over the wrap");
}
