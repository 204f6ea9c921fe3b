//! The automated mode and the driver's override, any command (MODE-1, TRQ-3, TRQ-4, SPD-1).

use supervisor_core::{Commands, ExitReason, Mode, SpeedKmhQ8, vet};

use super::Any;
use crate::properties::mode::{mode_1_ends_exactly_for_a_reason, mode_1_permission_exactly, trq_4_override_suspends};

/// MODE-1, TRQ-3c, TRQ-4: when the mode is suspended and ends, exactly.
#[kani::proof]
#[kani::unwind(17)]
#[kani::stub(supervisor_core::kernel::within_percent, crate::harness::uninterpreted::within_percent)]
fn mode_1_is_suspended_and_ends() {
    let any = Any::new();
    let outputs = kani::any();
    let cycle = any.cycle(&outputs);
    assert!(mode_1_ends_exactly_for_a_reason(&cycle));
    assert!(trq_4_override_suspends(&cycle));
    let (old, new) = (&any.old.drive, &any.decided.state.drive);
    kani::cover!(old.mode == Mode::Automated && new.mode == Mode::Suspended, "the driver overrides");
    kani::cover!(old.mode != Mode::Manual && new.exit == ExitReason::InputLost, "the last of the reasons");
}

/// MODE-1, SPD-1: when the mode may begin, exactly; and the bound of the target speed.
#[kani::proof]
#[kani::unwind(17)]
#[kani::stub(supervisor_core::kernel::within_percent, crate::harness::uninterpreted::within_percent)]
fn mode_1_may_begin() {
    let any = Any::new();
    let outputs = kani::any();
    assert!(mode_1_permission_exactly(&any.cycle(&outputs)));
    let envelope = &any.decided.envelope;
    kani::cover!(any.old.drive.mode == Mode::Manual && envelope.automated.is_ok(), "the mode may begin");
    kani::cover!(envelope.target_speed.most > SpeedKmhQ8::ZERO, "a target speed may pass");
}

/// SPD-1c: whatever the target speed, nothing else that goes out depends on it, the brake least of all.
#[kani::proof]
#[kani::unwind(17)]
#[kani::stub(supervisor_core::kernel::fits, crate::harness::uninterpreted::fits)]
fn spd_1_target_speed_brakes_nothing() {
    let (envelope, commands): (supervisor_core::Envelope, Commands) = (kani::any(), kani::any());
    let (one, _) = vet(&envelope, &commands);
    let (other, _) = vet(&envelope, &Commands { target_speed: kani::any(), ..commands });
    assert!(one.brake == other.brake && one.retarder == other.retarder);
    assert!(one.drive == other.drive && one.mode == other.mode);
    kani::cover!(one.target_speed > other.target_speed && one.brake.total.raw() > 0, "it falls beside a brake");
}
