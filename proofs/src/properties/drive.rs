//! Torque (TRQ, VLC-1, SELF-11a).

use supervisor_core::{
    Count, DecelMs2Q11, Deviation, DriveTorque, DrivingMode, Gear, GearRequest, Level, Mode, Origin, Percent, Stage,
    Timer, kernel,
};

use super::reading::{accelerator, agreed_speeds, both_pedals, brake_released, confirmed, obliged, ticks};
use super::{Cycle, Property, all, implies};

/// Every property of this file.
pub const ALL: &[Property] = all![
    no_torque_under_obligation,
    trq_7_excess_is_answered,
    self_10_bypass_is_answered,
    vlc_1_mode_not_configured_commands_nothing,
    trq_1_pedal_governs,
    trq_2_automated_torque_needs_all,
    trq_5_within_limit_and_ramp,
    trq_5_counts_from_our_last_output,
    trq_5_release_after_leave,
    trq_5e_no_torque_until_released,
    trq_1_bounds_exactly,
    self_11_torque_up_to_its_bound,
    trq_6_hill_hold,
    trq_6_hill_hold_counts_real_time,
    self_11_torque_is_exactly_bounded,
    e2e_2_lost_drive_command
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

/// What is asked for, if it may be used.
fn asked(cycle: &Cycle<'_>) -> Option<DriveTorque> {
    cycle.commands.drive.usable(cycle.config.timeout_50).ok()
}

/// A torque goes out.
fn flows(cycle: &Cycle<'_>) -> bool {
    cycle.outputs.drive.torque > Percent::ZERO
}

/// A deceleration goes out, by service brake or retarder.
fn brakes(cycle: &Cycle<'_>) -> bool {
    cycle.envelope.brake.total(cycle.outputs) > DecelMs2Q11::ZERO
}

/// TRQ-1a, TRQ-1b, TRQ-1c: the most that the accelerator asks for: the map, linear between its points 10 % apart, and its tolerance from
/// where the pedal counts as pressed. Nothing where it is unknown or the brake pedal is, or may be, pressed too.
fn by_pedal(cycle: &Cycle<'_>) -> u8 {
    let Some(travel) = accelerator(cycle).filter(|_| !both_pedals(cycle)) else { return 0 };
    let map = &cycle.config.pedal_map.0;
    let (before, rest) = (usize::from(travel / 25), travel % 25);
    let point = |index: usize| map.get(index.min(10)).map_or(0, |torque| torque.raw());
    let torque = kernel::between_down(point(before), point(before + 1), rest, 25);
    let tolerance = if travel > cycle.config.pedal_pressed.raw() { cycle.config.pedal_tolerance.raw() } else { 0 };
    torque.saturating_add(tolerance).min(100)
}

/// TRQ-5b, CMD-3f: our last output and what the gradient adds to it in this cycle.
fn ramp(cycle: &Cycle<'_>) -> u8 {
    let drive = &cycle.old.drive;
    let (rise, _) = drive.rest.portion(cycle.config.torque_ramp.raw(), ticks(cycle).permission);
    u8::try_from(u32::from(drive.torque.raw()).saturating_add(rise).min(100)).unwrap_or(100)
}

/// TRQ-1a, TRQ-1b, TRQ-1c, TRQ-4f: what the driver asks for, and whoever asks while the driver overrides, gets no more
/// than the accelerator says.
#[must_use]
pub fn trq_1_pedal_governs(cycle: &Cycle<'_>) -> bool {
    let driver = cycle.outputs.drive.origin == Origin::Driver || cycle.new.drive.mode == Mode::Suspended;
    implies(driver, cycle.outputs.drive.torque.raw() <= by_pedal(cycle))
}

/// TRQ-2a to TRQ-2e, TRQ-3a: torque that the driver did not ask for passes only active, in the granted mode, with
/// perception known and no obstacle, no obligation, the brake pedal known released, and within our acceleration bound.
#[must_use]
pub fn trq_2_automated_torque_needs_all(cycle: &Cycle<'_>) -> bool {
    let out = &cycle.outputs.drive;
    let active = asked(cycle).is_some_and(|asked| asked.active && asked.origin == out.origin);
    let granted = cycle.new.drive.mode != Mode::Manual
        && cycle.outputs.mode == DrivingMode::Automated
        && cycle.inputs.cruise_switch.is(true);
    let clear = cycle.threat.known && cycle.threat.level == Level::None;
    implies(
        flows(cycle) && out.origin != Origin::Driver,
        out.active
            && active
            && granted
            && clear
            && !obliged(cycle)
            && brake_released(cycle)
            && out.torque <= cycle.config.automated_torque,
    )
}

/// TRQ-5a, TRQ-5b, TRQ-5c, RSP-1n: never beyond the electric limit, nothing while it is unknown; no steeper rise than
/// the gradient, but EPBi's begins at the idle torque; no rise at all while slip control works or may; and what falls,
/// falls.
#[must_use]
pub fn trq_5_within_limit_and_ramp(cycle: &Cycle<'_>) -> bool {
    let out = cycle.outputs.drive;
    let limit = cycle.inputs.drive_limit.known().filter(|limit| limit.raw() <= 100).unwrap_or(Percent::ZERO);
    let idle = if out.origin == Origin::Epbi { cycle.config.idle_torque.raw() } else { 0 };
    out.torque <= limit
        && out.torque.raw() <= ramp(cycle).max(idle)
        && implies(!cycle.inputs.asr.is(false), out.torque <= cycle.old.drive.torque)
        && out.torque <= asked(cycle).map_or(Percent::ZERO, |asked| asked.torque)
}

/// TRQ-5b, TRQ-5d, CMD-3f: the gradient counts from what went out, also from the 0 of an obligation, and what it leaves
/// below 1 % is kept, no more.
#[must_use]
pub fn trq_5_counts_from_our_last_output(cycle: &Cycle<'_>) -> bool {
    let (old, new, next) = (&cycle.old.drive, &cycle.new.drive, &cycle.next.drive);
    let (_, rest) = old.rest.portion(cycle.config.torque_ramp.raw(), ticks(cycle).permission);
    new.torque == old.torque && next.torque == cycle.outputs.drive.torque && next.rest == rest
}

/// TRQ-5e: after leave, and after a drive that did not obey, no torque until the accelerator was seen released.
#[must_use]
pub fn trq_5_release_after_leave(cycle: &Cycle<'_>) -> bool {
    let released = accelerator(cycle).is_some_and(|travel| travel <= cycle.config.pedal_pressed.raw());
    let begins = cycle.new.seat.leave || cycle.response.torque != Deviation::None;
    let needed = begins || (cycle.old.drive.release_needed && !released);
    cycle.new.drive.release_needed == needed && cycle.next.drive.release_needed == needed
}

/// TRQ-5e: and no torque goes out meanwhile.
#[must_use]
pub fn trq_5e_no_torque_until_released(cycle: &Cycle<'_>) -> bool {
    implies(cycle.new.drive.release_needed, !flows(cycle))
}

/// TRQ-6b: torque may act against the brake: the driver confirmed, slow, and the time not used up.
fn holds_on_hill(cycle: &Cycle<'_>) -> bool {
    let (timer, config) = (cycle.old.drive.hill, cycle.config);
    let slow = agreed_speeds(cycle).is_some_and(|(_, high)| high < config.hill_hold_speed.raw());
    let left = timer == Timer::STOPPED || timer.run(ticks(cycle).safety).elapsed() < config.hill_hold;
    confirmed(cycle) && slow && left
}

/// TRQ-6a, TRQ-6b, TRQ-6c: against the brake only the driver's hill-hold; and only in the direction that the gearbox
/// confirms and no output changes.
#[must_use]
pub fn trq_6_hill_hold(cycle: &Cycle<'_>) -> bool {
    let by_driver = cycle.outputs.drive.origin == Origin::Driver;
    implies(flows(cycle) && brakes(cycle), by_driver && holds_on_hill(cycle)) && implies(flows(cycle), in_gear(cycle))
}

/// TRQ-6b: the time of hill-hold begins with torque against the brake, runs until no deceleration is demanded whatever
/// the torque does meanwhile, and is no shorter than real time.
#[must_use]
pub fn trq_6_hill_hold_counts_real_time(cycle: &Cycle<'_>) -> bool {
    let (old, new, next) = (cycle.old.drive.hill, cycle.new.drive.hill, cycle.next.drive.hill);
    let counts = brakes(cycle) && (flows(cycle) || old.is_running());
    let passed = cycle.now.raw().wrapping_sub(cycle.old.clock.last.raw());
    let known = cycle.old.clock.started && !ticks(cycle).fault && old.is_running() && counts;
    new == old
        && next == (if counts { old.run(ticks(cycle).safety) } else { Timer::STOPPED })
        && implies(known, next.elapsed().raw() >= old.elapsed().raw().saturating_add(passed).min(u32::MAX - 1))
}

/// TRQ-6c: the confirmed gear is D or R, and no other one goes out.
fn in_gear(cycle: &Cycle<'_>) -> bool {
    steady(cycle, cycle.inputs.gear.known()) && matches!(cycle.inputs.gear.known(), Some(Gear::Drive | Gear::Reverse))
}

/// TRQ-6c: no other gear goes out than the confirmed one.
fn steady(cycle: &Cycle<'_>, confirmed: Option<Gear>) -> bool {
    match cycle.outputs.gear {
        GearRequest::Hold => true,
        GearRequest::Drive => confirmed == Some(Gear::Drive),
        GearRequest::Reverse => confirmed == Some(Gear::Reverse),
        GearRequest::Neutral | GearRequest::Park => false,
    }
}

/// SEAT-6b: the driver is confirmed, or the bus is known to roll with the parking brake known released.
fn attended(cycle: &Cycle<'_>) -> bool {
    let rolls = agreed_speeds(cycle).is_some_and(|(low, _)| low >= cycle.config.epb_speed.raw());
    confirmed(cycle) || (rolls && cycle.inputs.epb.is(supervisor_core::EpbState::Released))
}

/// The most that state, inputs and threat leave to driver, ADAS and EPBi, whatever is asked for.
fn bounds(cycle: &Cycle<'_>) -> [u8; 3] {
    let (config, drive) = (cycle.config, &cycle.new.drive);
    let refused = obliged(cycle)
        || drive.release_needed
        || cycle.new.high_voltage.stage != Stage::Up
        || !attended(cycle)
        || !(cycle.inputs.gear.is(Gear::Drive) || cycle.inputs.gear.is(Gear::Reverse));
    let limit = cycle.inputs.drive_limit.known().map_or(0, Percent::raw);
    let held = if cycle.inputs.asr.is(false) { 100 } else { cycle.old.drive.torque.raw().min(100) };
    let common = if refused || limit > 100 { 0 } else { limit.min(held) };
    let (ramp, idle) = (ramp(cycle), config.idle_torque.raw());
    let driver = common.min(ramp).min(by_pedal(cycle));
    let granted = drive.mode != Mode::Manual
        && cycle.envelope.automated.is_ok()
        && brake_released(cycle)
        && cycle.threat.known
        && cycle.threat.level == Level::None;
    let suspended = if drive.mode == Mode::Suspended { driver } else { 100 };
    let bounded = if granted { common.min(suspended).min(config.automated_torque.raw()) } else { 0 };
    let by_epbi = config.longitudinal_mode != Count::ZERO;
    let [adas, epbi] = [!by_epbi, by_epbi].map(|configured| if configured { bounded } else { 0 });
    [driver, adas.min(ramp), epbi.min(ramp.max(idle))]
}

/// SELF-11a, TRQ-1a to TRQ-1c, TRQ-2b to TRQ-2e, TRQ-3a, TRQ-4f, TRQ-5a to TRQ-5g, TRQ-6b, TRQ-6c, VLC-1a, VLC-1c, VLC-1d, SEAT-6b:
/// the bounds of the torque are exactly what the requirements leave: nothing more, and nothing less, were it 1 %.
#[must_use]
pub fn trq_1_bounds_exactly(cycle: &Cycle<'_>) -> bool {
    let (bound, timeouts) = (&cycle.envelope.torque, &cycle.envelope.timeouts);
    [bound.driver, bound.automated, bound.epbi].map(|bound| bound.most.raw()) == bounds(cycle)
        && bound.idle == cycle.config.idle_torque
        && bound.hill_hold == holds_on_hill(cycle)
        && cycle.envelope.gear.confirmed == cycle.inputs.gear.known()
        && timeouts.ms50 == cycle.config.timeout_50
        && timeouts.ms100 == cycle.config.timeout_100
}

/// The most of what is asked for that may go out, given the bounds, the idle torque, and whether it may act against the brake; while
/// the gear is steady.
fn most(cycle: &Cycle<'_>, asked: DriveTorque, [driver, adas, epbi]: [u8; 3], idle: Percent, hill_hold: bool) -> u8 {
    let by_driver = asked.origin == Origin::Driver;
    if brakes(cycle) && !(by_driver && hill_hold) {
        return 0;
    }
    let granted = asked.active && cycle.outputs.mode == DrivingMode::Automated;
    match asked.origin {
        Origin::Driver => driver,
        Origin::Adas if granted => adas,
        // TRQ-5f: below the idle torque there is none.
        Origin::Epbi if granted && epbi.min(asked.torque.raw()) >= idle.raw() => epbi,
        Origin::Adas | Origin::Epbi => 0,
    }
}

/// Whether what goes out is what is asked for, up to `most`. Who may have none keeps no active flag either, but for coasting in the
/// automated mode.
fn goes_out_up_to(cycle: &Cycle<'_>, asked: DriveTorque, most: u8) -> bool {
    let torque = Percent::new(asked.torque.raw().min(most));
    let coasts = asked.torque == Percent::ZERO && cycle.outputs.mode == DrivingMode::Automated;
    let keeps = asked.origin == Origin::Driver || torque > Percent::ZERO || coasts;
    cycle.outputs.drive == (if keeps { DriveTorque { torque, ..asked } } else { DriveTorque::NEUTRAL })
}

/// SELF-11a, TRQ-5f, TRQ-6a, TRQ-6c: what goes out is what is asked for, up to exactly the bound of whoever asks, in the mode and the
/// gear that go out and beside the deceleration that does.
#[must_use]
pub fn self_11_torque_up_to_its_bound(cycle: &Cycle<'_>) -> bool {
    let (bound, asked) = (&cycle.envelope.torque, asked(cycle).unwrap_or(DriveTorque::NEUTRAL));
    let bounds = [bound.driver, bound.automated, bound.epbi].map(|bound| bound.most.raw());
    let most = most(cycle, asked, bounds, bound.idle, bound.hill_hold);
    goes_out_up_to(cycle, asked, if steady(cycle, cycle.envelope.gear.confirmed) { most } else { 0 })
}

/// SELF-11a, TRQ-1a to TRQ-1c, TRQ-2a to TRQ-2e, TRQ-3a, TRQ-4f, TRQ-5a to TRQ-5g, TRQ-6a to TRQ-6c, VLC-1a, VLC-1c,
/// VLC-1d, SEAT-6b: what goes out is what is asked for, up to exactly what the requirements allow: nothing more, and
/// nothing less, were it 1 %: [`trq_1_bounds_exactly`] put into [`self_11_torque_up_to_its_bound`].
#[must_use]
pub fn self_11_torque_is_exactly_bounded(cycle: &Cycle<'_>) -> bool {
    let asked = asked(cycle).unwrap_or(DriveTorque::NEUTRAL);
    let most = most(cycle, asked, bounds(cycle), cycle.config.idle_torque, holds_on_hill(cycle));
    goes_out_up_to(cycle, asked, if in_gear(cycle) { most } else { 0 })
}

/// E2E-2a, E2E-2b: without a usable command there is no torque, and the gear is held, but for an obliged neutral
/// (SEAT-6a).
#[must_use]
pub fn e2e_2_lost_drive_command(cycle: &Cycle<'_>) -> bool {
    let gear_lost = cycle.commands.gear.usable(cycle.config.timeout_100).is_err();
    let held = if cycle.envelope.gear.neutral { GearRequest::Neutral } else { GearRequest::Hold };
    implies(asked(cycle).is_none(), cycle.outputs.drive == DriveTorque::NEUTRAL)
        && implies(gear_lost, cycle.outputs.gear == held)
}
