//! Torque, gear and mode that go out, any command (TRQ, VLC-1, SELF-11a).

use supervisor_core::{
    ExitReason, Mode, Origin, Outputs, Percent, vet_drive, vet_gear, vet_mode, vet_target_speed, vet_warnings,
};

use super::Any;
use crate::properties::drive::{
    e2e_2_lost_drive_command, self_11_torque_is_exactly_bounded, trq_1_pedal_governs, trq_2_automated_torque_needs_all,
    trq_5_counts_from_our_last_output, trq_5_release_after_leave, trq_5_within_limit_and_ramp, trq_6_hill_hold,
    trq_6_hill_hold_counts_real_time,
};
use crate::properties::mode::{
    mode_1_end_is_shown, mode_1_follows_what_went_out, mode_1_set_is_new_evidence, trq_4_compares_with_what_was_asked,
};

impl Any {
    /// The channels of the drive as vetted for the commands of the cycle, whatever brake and retarder do.
    pub(super) fn driving(&self) -> Outputs {
        let (envelope, others): (_, Outputs) = (&self.decided.envelope, kani::any());
        let gear = vet_gear(envelope, self.commands.gear).0;
        let mode = vet_mode(envelope, self.commands.mode).0;
        let braking = envelope.brake.total(&others);
        let drive = vet_drive(envelope, mode, gear, braking, self.commands.drive).0;
        let target_speed = vet_target_speed(envelope, mode, self.commands.target_speed).0;
        let warnings = vet_warnings(envelope, self.commands.warnings).0;
        Outputs { gear, mode, drive, target_speed, warnings, ..others }
    }
}

/// SELF-11a, TRQ-1, TRQ-2, TRQ-5, TRQ-6, RSP-1n, E2E-2a, E2E-2b: the torque that goes out is exactly what is asked for,
/// up to what is permitted; and what each requirement says of it, one by one.
#[kani::proof]
#[kani::unwind(17)]
#[kani::stub(supervisor_core::kernel::together, crate::harness::uninterpreted::together)]
#[kani::stub(supervisor_core::kernel::portion, crate::harness::uninterpreted::portion)]
#[kani::stub(supervisor_core::kernel::between_down, crate::harness::uninterpreted::between_down)]
#[kani::stub(supervisor_core::kernel::within_percent, crate::harness::uninterpreted::within_percent)]
fn self_11_torque_up_to_what_is_permitted() {
    let any = Any::new();
    let outputs = any.driving();
    let cycle = any.cycle(&outputs);
    assert!(trq_1_pedal_governs(&cycle));
    assert!(trq_2_automated_torque_needs_all(&cycle));
    assert!(trq_5_within_limit_and_ramp(&cycle));
    assert!(trq_6_hill_hold(&cycle));
    assert!(self_11_torque_is_exactly_bounded(&cycle));
    assert!(e2e_2_lost_drive_command(&cycle));
    let (torque, origin) = (outputs.drive.torque, outputs.drive.origin);
    let (flows, mode) = (torque > Percent::ZERO, any.decided.state.drive.mode);
    kani::cover!(flows && origin == Origin::Driver && outputs.brake.total.raw() > 0, "hill-hold");
    kani::cover!(flows && origin == Origin::Adas && mode == Mode::Suspended, "the driver overrides");
    kani::cover!(flows && origin == Origin::Epbi && torque < any.old.drive.torque, "torque of EPBi passes, and falls");
    kani::cover!(torque == Percent::new(1) && origin == Origin::Adas, "1 % passes");
}

/// TRQ-5b, TRQ-5d, TRQ-5e, TRQ-6b, MODE-1a, MODE-1f, TRQ-2b, TRQ-4b, CMD-3f: what the next cycle counts from and remembers
/// of the drive and its mode.
#[kani::proof]
#[kani::unwind(17)]
#[kani::stub(supervisor_core::kernel::together, crate::harness::uninterpreted::together)]
#[kani::stub(supervisor_core::kernel::portion, crate::harness::uninterpreted::portion)]
#[kani::stub(supervisor_core::kernel::within_percent, crate::harness::uninterpreted::within_percent)]
fn trq_5_next_cycle_counts_from_the_output() {
    let mut any = Any::new();
    let outputs = any.driving();
    any.record(&outputs);
    let cycle = any.cycle(&outputs);
    assert!(trq_5_counts_from_our_last_output(&cycle));
    assert!(trq_6_hill_hold_counts_real_time(&cycle));
    assert!(trq_5_release_after_leave(&cycle));
    assert!(mode_1_set_is_new_evidence(&cycle));
    assert!(mode_1_follows_what_went_out(&cycle));
    assert!(mode_1_end_is_shown(&cycle));
    assert!(trq_4_compares_with_what_was_asked(&cycle));
    let (old, next) = (&any.old.drive, &any.next.drive);
    kani::cover!(next.hill.is_running() && !old.hill.is_running(), "hill-hold begins");
    kani::cover!(next.torque > old.torque, "torque rises");
    kani::cover!(old.release_needed && !next.release_needed, "the accelerator is released");
    kani::cover!(next.mode == Mode::Automated && old.mode == Mode::Manual, "the mode begins");
    kani::cover!(next.exit == ExitReason::CommandLost && outputs.warnings.notice_lamp, "an end is shown");
}
