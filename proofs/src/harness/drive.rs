//! Torque, gear and mode that go out, any command (TRQ, VLC-1, SELF-11a).

use supervisor_core::{
    ExitReason, Mode, Origin, Outputs, Percent, SpeedKmhQ8, vet_drive, vet_gear, vet_mode, vet_target_speed,
    vet_warnings,
};

use super::Any;
use super::channels::Around;
use crate::properties::drive::{
    e2e_2_lost_drive_command, self_11_torque_up_to_its_bound, trq_1_bounds_exactly, trq_1_pedal_governs,
    trq_2_automated_torque_needs_all, trq_5_counts_from_our_last_output, trq_5_release_after_leave,
    trq_5_within_limit_and_ramp, trq_5e_no_torque_until_released, trq_6_hill_hold, trq_6_hill_hold_counts_real_time,
};
use crate::properties::mode::{
    mode_1_end_is_shown, mode_1_ends_exactly_for_a_reason, mode_1_follows_what_went_out,
    mode_1_goes_out_within_its_bounds, mode_1_permission_exactly, mode_1_set_is_new_evidence,
    trq_4_compares_with_what_was_asked, trq_4_never_against_an_obligation,
};

/// SELF-11a, TRQ-1 to TRQ-6, VLC-1, SEAT-6b: the bounds of the torque, exactly.
#[kani::proof]
#[kani::unwind(17)]
#[kani::stub(supervisor_core::kernel::portion, crate::harness::uninterpreted::portion)]
#[kani::stub(supervisor_core::kernel::between_down, crate::harness::uninterpreted::between_down)]
#[kani::stub(supervisor_core::kernel::within_percent, crate::harness::uninterpreted::within_percent)]
fn trq_1_bounds_of_the_torque() {
    let any = Any::new();
    let outputs = kani::any();
    assert!(trq_1_bounds_exactly(&any.cycle(&outputs)));
    let (bound, mode) = (&any.decided.envelope.torque, any.decided.state.drive.mode);
    kani::cover!(bound.hill_hold && bound.driver.most == Percent::new(1), "the driver, on a hill");
    kani::cover!(bound.automated.most > Percent::ZERO && mode == Mode::Suspended, "ADAS, overridden");
    kani::cover!(bound.epbi.most > any.old.drive.torque, "EPBi, and it rises");
}

/// What of the drive goes out beside any brake and retarder.
fn driven(around: &Around) -> Outputs {
    let (envelope, commands, others): (_, _, Outputs) = (&around.envelope, &around.commands, kani::any());
    let gear = vet_gear(envelope, commands.gear).0;
    let mode = vet_mode(envelope, commands.mode).0;
    let drive = vet_drive(envelope, mode, gear, envelope.brake.total(&others), commands.drive).0;
    let target_speed = vet_target_speed(envelope, mode, commands.target_speed).0;
    Outputs { gear, mode, drive, target_speed, ..others }
}

/// SELF-11a, TRQ-5f, TRQ-6a, TRQ-6c, E2E-2a, E2E-2b, MODE-1a, SPD-1a: torque, mode and target speed go out exactly as they are asked
/// for, up to their bounds, of any feasible envelope. Put together with the bounds (`trq_1_bounds_of_the_torque`,
/// `mode_1_may_begin`) this is all that goes out.
#[kani::proof]
#[kani::unwind(17)]
#[kani::stub(supervisor_core::kernel::together, crate::harness::uninterpreted::together)]
fn self_11_torque_up_to_its_bounds() {
    let around = Around::timed();
    let outputs = driven(&around);
    let cycle = around.cycle(&outputs);
    assert!(self_11_torque_up_to_its_bound(&cycle));
    assert!(e2e_2_lost_drive_command(&cycle));
    assert!(mode_1_goes_out_within_its_bounds(&cycle));
    let (drive, flows) = (outputs.drive, outputs.drive.torque > Percent::ZERO);
    kani::cover!(flows && drive.origin == Origin::Driver && outputs.brake.total.raw() > 0, "hill-hold");
    kani::cover!(flows && drive.origin == Origin::Epbi, "torque of EPBi passes");
    kani::cover!(drive.torque == Percent::new(1) && drive.origin == Origin::Adas, "1 % passes");
    kani::cover!(outputs.target_speed > SpeedKmhQ8::ZERO, "a target speed passes");
}

/// TRQ-1, TRQ-2, TRQ-4h, TRQ-5, TRQ-6, RSP-1n: what each requirement says of the torque that goes out, one by one.
///
/// Of the envelope nothing is taken for granted but what is proved of it: it is feasible, its bounds are exact. Everything around it is any.
#[kani::proof]
#[kani::unwind(17)]
#[kani::stub(supervisor_core::kernel::together, crate::harness::uninterpreted::together)]
#[kani::stub(supervisor_core::kernel::portion, crate::harness::uninterpreted::portion)]
#[kani::stub(supervisor_core::kernel::between_down, crate::harness::uninterpreted::between_down)]
#[kani::stub(supervisor_core::kernel::within_percent, crate::harness::uninterpreted::within_percent)]
fn trq_1_torque_one_by_one() {
    let around = Around::any();
    let outputs = driven(&around);
    let cycle = around.cycle(&outputs);
    kani::assume(trq_1_bounds_exactly(&cycle) && mode_1_permission_exactly(&cycle));
    kani::assume(mode_1_ends_exactly_for_a_reason(&cycle));
    assert!(trq_1_pedal_governs(&cycle));
    assert!(trq_2_automated_torque_needs_all(&cycle));
    assert!(trq_4_never_against_an_obligation(&cycle));
    assert!(trq_5_within_limit_and_ramp(&cycle));
    assert!(trq_5e_no_torque_until_released(&cycle));
    assert!(trq_6_hill_hold(&cycle));
    kani::cover!(outputs.drive.torque > Percent::ZERO, "torque passes");
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
    let warnings = vet_warnings(&any.decided.envelope, any.commands.warnings).0;
    let outputs = Outputs { warnings, ..kani::any() };
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
