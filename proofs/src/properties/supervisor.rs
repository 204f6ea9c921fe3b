//! The supervisor itself: clock, latches, safe state, boot (SELF).

use supervisor_core::{Contactors, DrivingMode, EpbRequest, EpbState, Faults, Flow, GearRequest, Key, Percent};

use super::{Cycle, Property, all, implies};

/// Every property of this file.
pub const ALL: &[Property] =
    all![self_5_safe_state, self_7_latched, self_7_quiet_counts_real_time, self_6_flow_fault_is_the_safe_state];

/// SELF-5c, f, h: the safe state. Torque 0, no release, apply when slow, gear and contactors hold, flashers on.
#[must_use]
pub fn self_5_safe_state(cycle: &Cycle<'_>) -> bool {
    let out = cycle.outputs;
    implies(
        cycle.new.is_safe_state(),
        out.drive.torque == Percent::ZERO
            && out.epb.request != EpbRequest::Release
            && out.gear == GearRequest::Hold
            && out.contactors == Contactors::NEUTRAL
            && out.warnings.hazard_flashers
            && out.mode == DrivingMode::Manual,
    )
}

/// SELF-5b, SELF-7a, SELF-7b, SELF-7c: latched faults stay, or all go together: at standstill, parking brake applied, after
/// the fault-free time, by the key seen Off before and On or Start now.
#[must_use]
pub fn self_7_latched(cycle: &Cycle<'_>) -> bool {
    let (old, new) = (&cycle.old.latches, &cycle.new.latches);
    let key = cycle.inputs.key.is(Key::On) || cycle.inputs.key.is(Key::Start);
    let may_clear = cycle.standstill()
        && cycle.inputs.epb.is(EpbState::Applied)
        && new.quiet.reached(cycle.config.fault_free)
        && old.off_seen
        && key;
    new.faults.contains(old.faults) || (may_clear && new.faults == Faults::NONE)
}

/// SELF-7b: the fault-free time counts no more than real time, and only at standstill with the parking brake applied.
#[must_use]
pub fn self_7_quiet_counts_real_time(cycle: &Cycle<'_>) -> bool {
    let (old, new) = (cycle.old.latches.quiet, cycle.new.latches.quiet);
    let passed = cycle.now.raw().wrapping_sub(cycle.old.clock.last.raw());
    let counted = new.elapsed().raw().saturating_sub(old.elapsed().raw());
    implies(new.is_running(), cycle.standstill() && cycle.inputs.epb.is(EpbState::Applied))
        && implies(cycle.old.clock.started, counted <= passed)
}

/// SELF-6b: a cycle that did not run whole and in order leads to the safe state.
#[must_use]
pub fn self_6_flow_fault_is_the_safe_state(cycle: &Cycle<'_>) -> bool {
    implies(cycle.old.flow != Flow::RECORDED, cycle.new.is_safe_state())
}
