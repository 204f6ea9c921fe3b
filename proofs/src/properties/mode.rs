//! The automated mode and the driver's override (MODE-1, TRQ-3, TRQ-4), and the target speed (SPD-1).

use supervisor_core::{AdsState, DrivingMode, ExitReason, Level, Mode, Origin, Percent, SpeedKmhQ8, Timer};

use super::reading::{accelerator, agreed_speeds, brake_released, confirmed, mitigates, obliged, ticks};
use super::{Cycle, Property, all, implies};

/// Every property of this file.
pub const ALL: &[Property] = all![
    mode_1_ends_exactly_for_a_reason,
    trq_4_override_suspends,
    trq_4_never_against_an_obligation,
    mode_1_permission_exactly,
    mode_1_goes_out_within_its_bounds,
    mode_1_begins_only_by_the_driver,
    mode_1_set_is_new_evidence,
    mode_1_follows_what_went_out,
    mode_1_end_is_shown,
    trq_4_compares_with_what_was_asked,
    spd_1_target_speed_is_exactly_bounded
];

/// The first reason for which the automated mode may not go on; none: everything that it needs is healthy.
fn ends(cycle: &Cycle<'_>) -> Option<ExitReason> {
    let inputs = cycle.inputs;
    let inputs_known = cycle.threat.known && agreed_speeds(cycle).is_some() && accelerator(cycle).is_some();
    if cycle.new.is_safe_state() || ticks(cycle).fault {
        Some(ExitReason::Fault)
    } else if cycle.new.seat.leave {
        Some(ExitReason::Leave)
    } else if mitigates(cycle) {
        Some(ExitReason::Mitigation)
    } else if obliged(cycle) {
        Some(ExitReason::Bypass)
    } else if !brake_released(cycle) {
        Some(ExitReason::BrakePedal)
    } else if cycle.new.steering.takeover.reached(cycle.config.takeover_time) {
        Some(ExitReason::Takeover)
    } else if !inputs.cruise_switch.is(true) {
        Some(ExitReason::Switch)
    } else if !inputs.ads.is(AdsState::Ready) && !inputs.ads.is(AdsState::Active) {
        Some(ExitReason::AdsState)
    } else if cycle.old.brake.lost.reached(cycle.config.brake_hold) {
        Some(ExitReason::CommandLost)
    } else if !inputs_known {
        Some(ExitReason::InputLost)
    } else {
        None
    }
}

/// MODE-1b, MODE-1c, MODE-1e, MODE-1f, TRQ-3c, E2E-2f: a running mode ends exactly when there is a reason, and the
/// first one is kept; nothing begins before the outputs have gone out.
#[must_use]
pub fn mode_1_ends_exactly_for_a_reason(cycle: &Cycle<'_>) -> bool {
    let (old, new) = (&cycle.old.drive, &cycle.new.drive);
    match (old.mode, ends(cycle)) {
        (Mode::Manual, _) => new.mode == Mode::Manual && new.exit == old.exit,
        (_, Some(reason)) => new.mode == Mode::Manual && new.exit == reason,
        (_, None) => new.mode != Mode::Manual && new.exit == old.exit,
    }
}

/// TRQ-4a to TRQ-4d: the accelerator against the torque that ADAS last asked for, both as per cent of the same map;
/// unknown keeps the last decision.
fn overrides(cycle: &Cycle<'_>) -> bool {
    let before = cycle.old.drive.mode == Mode::Suspended;
    let asked = u32::from(cycle.old.drive.automated.raw());
    let Some(travel) = accelerator(cycle) else { return before };
    // 0.4 % of pedal are two, 1 % of torque five fifths of a per cent.
    let (pedal, torque) = (u32::from(travel) * 2, asked * 5);
    let offset = u32::from(cycle.config.override_offset.raw()) * 5;
    if asked == 0 {
        travel > cycle.config.override_least.raw()
    } else {
        pedal > torque + offset || (pedal >= torque && before)
    }
}

/// TRQ-4a to TRQ-4e, MODE-1d: an override suspends the mode and does not end it; its end is the mode again.
#[must_use]
pub fn trq_4_override_suspends(cycle: &Cycle<'_>) -> bool {
    let runs = cycle.old.drive.mode != Mode::Manual && ends(cycle).is_none();
    (cycle.new.drive.mode == Mode::Suspended) == (runs && overrides(cycle))
}

/// TRQ-4h: an override never takes effect while a mitigation latch is set or leave runs.
#[must_use]
pub fn trq_4_never_against_an_obligation(cycle: &Cycle<'_>) -> bool {
    implies(
        cycle.new.mitigation.running() || cycle.new.seat.leave,
        cycle.new.drive.mode == Mode::Manual && cycle.outputs.drive.torque == Percent::ZERO,
    )
}

/// Nothing speaks against the automated mode, and it runs already or the driver, confirmed on the seat, has set it anew.
fn may_be_automated(cycle: &Cycle<'_>) -> bool {
    let by_driver = cycle.new.drive.armed && cycle.inputs.driver_set.is(true) && confirmed(cycle);
    ends(cycle).is_none() && (cycle.new.drive.mode != Mode::Manual || by_driver)
}

/// The most that the target speed may be.
fn target_speed(cycle: &Cycle<'_>) -> SpeedKmhQ8 {
    let may = cycle.new.drive.mode != Mode::Manual && cycle.envelope.automated.is_ok();
    let free = !obliged(cycle) && cycle.threat.level == Level::None;
    if may && free { cycle.config.speed_limit } else { SpeedKmhQ8::ZERO }
}

/// MODE-1a to MODE-1c, SELF-11k, SPD-1a, SPD-1b, SELF-11f: what the mode and the target speed are bounded by, exactly.
#[must_use]
pub fn mode_1_permission_exactly(cycle: &Cycle<'_>) -> bool {
    cycle.envelope.automated.is_ok() == may_be_automated(cycle)
        && cycle.envelope.target_speed.most == target_speed(cycle)
        && cycle.envelope.timeouts.ms200 == cycle.config.timeout_200
}

/// MODE-1a, SELF-11k, SPD-1a, SELF-11f: *automated* goes out exactly when it is asked for and permitted; and beside it the target speed
/// that is asked for, up to its bound.
#[must_use]
pub fn mode_1_goes_out_within_its_bounds(cycle: &Cycle<'_>) -> bool {
    let asked = cycle.commands.mode.usable(cycle.config.timeout_200) == Ok(DrivingMode::Automated);
    let speed = cycle.commands.target_speed.usable(cycle.config.timeout_50).unwrap_or(SpeedKmhQ8::ZERO);
    let automated = cycle.outputs.mode == DrivingMode::Automated;
    let most = if automated { cycle.envelope.target_speed.most } else { SpeedKmhQ8::ZERO };
    automated == (asked && cycle.envelope.automated.is_ok()) && cycle.outputs.target_speed == speed.min(most)
}

/// MODE-1a to MODE-1c, SELF-11k: *automated* goes out exactly when it is asked for, nothing speaks against it, and it
/// runs already or the driver, confirmed on the seat, has set it anew.
#[must_use]
pub fn mode_1_begins_only_by_the_driver(cycle: &Cycle<'_>) -> bool {
    let asked = cycle.commands.mode.usable(cycle.config.timeout_200) == Ok(DrivingMode::Automated);
    (cycle.outputs.mode == DrivingMode::Automated) == (asked && may_be_automated(cycle))
}

/// MODE-1a, TRQ-2b, TRQ-3c: what the driver sets counts only after it was seen off since the mode last ended.
#[must_use]
pub fn mode_1_set_is_new_evidence(cycle: &Cycle<'_>) -> bool {
    let manual = cycle.new.drive.mode == Mode::Manual;
    let still = cycle.old.drive.armed && cycle.old.drive.mode == Mode::Manual;
    let armed = manual && (cycle.inputs.driver_set.is(false) || still);
    cycle.new.drive.armed == armed && cycle.next.drive.armed == (armed && cycle.next.drive.mode == Mode::Manual)
}

/// MODE-1a, MODE-1f: the mode is what went out; where the main controller ends it, or is lost, that is the reason.
#[must_use]
pub fn mode_1_follows_what_went_out(cycle: &Cycle<'_>) -> bool {
    let (new, next) = (&cycle.new.drive, &cycle.next.drive);
    let lost = cycle.commands.mode.usable(cycle.config.timeout_200).is_err();
    let reason = if lost { ExitReason::CommandLost } else { ExitReason::Requested };
    match (new.mode, cycle.outputs.mode) {
        (Mode::Manual, DrivingMode::Automated) => next.mode == Mode::Automated && next.exit == ExitReason::None,
        (Mode::Manual, DrivingMode::Manual) => next.mode == Mode::Manual && next.exit == new.exit,
        (_, DrivingMode::Manual) => next.mode == Mode::Manual && next.exit == reason,
        (mode, DrivingMode::Automated) => next.mode == mode && next.exit == new.exit,
    }
}

/// MODE-1f: an end that the driver did not give, and that no other warning tells, is shown for its time.
#[must_use]
pub fn mode_1_end_is_shown(cycle: &Cycle<'_>) -> bool {
    let new = &cycle.new.drive;
    let told = matches!(
        new.exit,
        ExitReason::None | ExitReason::Requested | ExitReason::BrakePedal | ExitReason::Switch | ExitReason::Mitigation
    );
    let untold = new.mode == Mode::Manual && !told;
    let counted = cycle.old.drive.notice.run(ticks(cycle).permission);
    new.notice == (if untold { counted } else { Timer::STOPPED })
        && cycle.next.drive.notice == new.notice
        && implies(untold && !new.notice.reached(cycle.config.notice_time), cycle.outputs.warnings.notice_lamp)
}

/// TRQ-4b to TRQ-4d: what the accelerator is compared with: the active torque that ADAS or EPBi asked for, up to our
/// bound.
#[must_use]
pub fn trq_4_compares_with_what_was_asked(cycle: &Cycle<'_>) -> bool {
    let asked = match cycle.commands.drive.usable(cycle.config.timeout_50) {
        Ok(drive) if drive.origin != Origin::Driver && drive.active => drive.torque.min(cycle.config.automated_torque),
        Ok(_) | Err(_) => Percent::ZERO,
    };
    cycle.new.drive.automated == cycle.old.drive.automated && cycle.next.drive.automated == asked
}

/// SPD-1a, SPD-1b, SELF-11f: the target speed is what is asked for, up to the limit; 0 while an obligation runs or the
/// mode is manual, or with an obstacle ahead.
#[must_use]
pub fn spd_1_target_speed_is_exactly_bounded(cycle: &Cycle<'_>) -> bool {
    let asked = cycle.commands.target_speed.usable(cycle.config.timeout_50).unwrap_or(SpeedKmhQ8::ZERO);
    let automated = cycle.outputs.mode == DrivingMode::Automated;
    cycle.outputs.target_speed == (if automated { asked.min(target_speed(cycle)) } else { SpeedKmhQ8::ZERO })
}
