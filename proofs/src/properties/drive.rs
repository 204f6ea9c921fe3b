//! Torque, mode and target speed (TRQ, MODE, SPD, VLC-1).

use supervisor_core::{Deviation, DrivingMode, Origin, Percent};

use super::{Cycle, Property, all, implies};

/// Every property of this file.
pub const ALL: &[Property] = all![
    no_torque_under_obligation,
    trq_7_excess_is_answered,
    self_10_bypass_is_answered,
    vlc_1_mode_not_configured_commands_nothing
];

/// SEAT-2a, MIT-5a, SELF-5c: no drive torque while leave, a mitigation latch or the safe state runs.
#[must_use]
pub fn no_torque_under_obligation(cycle: &Cycle<'_>) -> bool {
    let obliged = cycle.new.seat.leave || cycle.new.mitigation.running() || cycle.new.is_safe_state();
    implies(obliged, cycle.outputs.drive.torque == Percent::ZERO)
}

/// TRQ-7b: a drive that gives more than it was told is told 0; one that still drives is braked against.
#[must_use]
pub fn trq_7_excess_is_answered(cycle: &Cycle<'_>) -> bool {
    let response = cycle.response.torque;
    implies(response != Deviation::None, cycle.outputs.drive.torque == Percent::ZERO)
        && implies(response == Deviation::Persistent, cycle.outputs.brake.total >= cycle.config.leave_hold)
}

/// SELF-10c: while somebody else commands an actuator there is no automated mode, and the drive is told 0.
#[must_use]
pub fn self_10_bypass_is_answered(cycle: &Cycle<'_>) -> bool {
    implies(
        cycle.response.bypass,
        cycle.outputs.mode == DrivingMode::Manual && cycle.outputs.drive.torque == Percent::ZERO,
    )
}

/// VLC-1d: drive torque of the longitudinal mode that is not configured is none.
#[must_use]
pub fn vlc_1_mode_not_configured_commands_nothing(cycle: &Cycle<'_>) -> bool {
    let drive = &cycle.outputs.drive;
    let by_epbi = cycle.config.longitudinal_mode.raw() != 0;
    implies(drive.origin == Origin::Adas && by_epbi, drive.torque == Percent::ZERO)
        && implies(drive.origin == Origin::Epbi && !by_epbi, drive.torque == Percent::ZERO)
}
