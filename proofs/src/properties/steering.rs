//! Automatic steering (STR, SELF-5g, SELF-11e, E2E-2i).

use supervisor_core::{EpsState, Mode, Percent, RateDeciDegS, Steering, Timer, kernel};

use super::reading::{agreed_speeds, steering_angle, ticks};
use super::{Cycle, Property, all, implies};

/// Every property of this file.
pub const ALL: &[Property] = all![
    str_2_permitted_exactly,
    str_1_bounds_exactly,
    str_2_fades_exactly,
    str_1_goes_out_within_its_bounds,
    str_1_angle_is_exactly_bounded,
    str_1_angle_stays_in_range,
    str_1_rate_and_bar_never_widened,
    str_1_overlay_below_takeover,
    str_2_overlay_fades,
    str_2_weight_fades,
    str_2_idle_commands_nothing,
    str_2_takeover_ends,
    str_2_asked_for_anew,
    str_2_end_is_shown,
    cmd_3_steering_counts_from_our_last_output
];

/// STR-2c, E2E-2i: what is asked for, if it may be used.
fn asked(cycle: &Cycle<'_>) -> Option<Steering> {
    cycle.commands.steering.usable(cycle.config.timeout_50).ok()
}

/// Automatic steering may act, and a usable command asks for it.
fn granted(cycle: &Cycle<'_>) -> Option<Steering> {
    asked(cycle).filter(|asked| asked.enable && cycle.envelope.steering.enable.is_ok())
}

/// STR-1b, STR-1g: the row of the tables: up to 10, 20, 30, 40, 60, 80 km/h, and above, which is also that of no speed.
fn row(cycle: &Cycle<'_>) -> usize {
    /// 1 km/h.
    const KMH: u16 = 256;
    let up_to = |kmh: u16| agreed_speeds(cycle).is_some_and(|(_, high)| high <= kmh * KMH);
    if up_to(10) {
        0
    } else if up_to(20) {
        1
    } else if up_to(30) {
        2
    } else if up_to(40) {
        3
    } else if up_to(60) {
        4
    } else if up_to(80) {
        5
    } else {
        6
    }
}

fn rate(cycle: &Cycle<'_>) -> RateDeciDegS {
    cycle.config.steering_rate.0.get(row(cycle)).copied().unwrap_or_default()
}

/// Where the change of the angle counts from: our last output while it acts, else the wheel, as far as it is known.
fn start(cycle: &Cycle<'_>) -> i32 {
    let last = cycle.old.steering.angle.raw();
    let acts = cycle.old.steering.weight > Percent::ZERO;
    i32::from(if acts { last } else { steering_angle(cycle).unwrap_or(last) })
}

/// STR-1c, CMD-3f: how far the angle may change in this cycle, with what earlier cycles left below 0.1°.
fn reach(cycle: &Cycle<'_>) -> i32 {
    let (reach, _) = cycle.old.steering.angle_rest.portion(rate(cycle).raw(), ticks(cycle).permission);
    i32::try_from(reach.min(32_767)).unwrap_or(32_767)
}

/// STR-1b to STR-1d: the angles that are permitted: what the rate can reach of the window that the speed and the
/// measured angle allow; outside of that window it goes back to it as fast as the rate permits, and never jumps.
fn angles(cycle: &Cycle<'_>) -> (i32, i32) {
    let limit = cycle.config.steering_angle.0.get(row(cycle)).map_or(0, |angle| i32::from(angle.raw()));
    let deviation = i32::from(cycle.config.steering_deviation.raw()).max(0);
    let (start, reach) = (start(cycle), reach(cycle));
    let measured = steering_angle(cycle).map_or(start, i32::from);
    let within = |angle: i32, least: i32, most: i32| angle.max(least).min(most);
    let reachable = |angle| within(within(angle, -limit, limit), start - reach, start + reach);
    (reachable(measured - deviation), reachable(measured + deviation))
}

/// What the fade adds or takes in this cycle, in per cent.
fn fade(cycle: &Cycle<'_>, outwards: bool) -> u8 {
    let ticks = ticks(cycle);
    let elapsed = if outwards { ticks.safety } else { ticks.permission };
    let (share, _) = cycle.old.steering.fade_rest.portion(cycle.config.steering_fade.raw(), elapsed);
    u8::try_from(share).unwrap_or(u8::MAX)
}

/// The overlay torques that are permitted: what the fade leaves and allows either way from the last one.
fn overlays(cycle: &Cycle<'_>) -> (i32, i32) {
    let full = i32::from(cycle.config.steering_overlay.raw()).max(0);
    let whole = u16::try_from(full).unwrap_or(0);
    let step = |outwards| i32::from(kernel::share_down(whole, fade(cycle, outwards)).min(32_767));
    let before = i32::from(cycle.old.steering.overlay.raw()).max(-full).min(full);
    // Towards 0 it fades out, away from 0 in.
    let (down, up) = (step(before > 0), step(before < 0));
    ((before - down).max(-full), (before + up).min(full))
}

/// The weights that are permitted: what the fade leaves and allows.
fn weights(cycle: &Cycle<'_>) -> (u8, u8) {
    let before = cycle.old.steering.weight.raw().min(100);
    (before.saturating_sub(fade(cycle, true)), before.saturating_add(fade(cycle, false)).min(100))
}

/// STR-1b to STR-1d, STR-1f, STR-1g, SELF-11e, CMD-3f: the bounds of the angle, its rate and the bar torque are exactly what the
/// requirements leave; what it falls back to is where it is, as far as they permit that.
#[must_use]
pub fn str_1_bounds_exactly(cycle: &Cycle<'_>) -> bool {
    let (bound, config) = (&cycle.envelope.steering, cycle.config);
    let (least, most) = angles(cycle);
    let angles = [bound.angle_least, bound.angle_most, bound.angle_neutral].map(|angle| i32::from(angle.raw()));
    angles == [least, most, start(cycle).max(least).min(most)]
        && (bound.range, bound.rate, bound.bar) == (config.steering_range, rate(cycle), config.steering_bar)
        && cycle.envelope.timeouts.ms50 == config.timeout_50
}

/// STR-1e, STR-2c, STR-2d, SELF-5g: so are those of what fades: overlay torque and weight.
#[must_use]
pub fn str_2_fades_exactly(cycle: &Cycle<'_>) -> bool {
    let (bound, (least, most)) = (&cycle.envelope.steering, overlays(cycle));
    let overlays = [bound.overlay_least, bound.overlay_most, bound.overlay_neutral];
    overlays.map(|torque| i32::from(torque.raw())) == [least, most, 0.max(least).min(most)]
        && (bound.weight_least.raw(), bound.weight_most.raw()) == weights(cycle)
}

/// STR-1b to STR-1g, STR-2c, STR-2d, STR-2f, SELF-5g, SELF-11e, E2E-2i: what goes out is what is asked for, each field the nearest inside
/// its bound; not permitted, not asked for or lost, it stays where it is and fades out. What neither acts nor asks for anything
/// passes with its idle fields, in range, or is nothing.
#[must_use]
pub fn str_1_goes_out_within_its_bounds(cycle: &Cycle<'_>) -> bool {
    let (bound, out) = (&cycle.envelope.steering, cycle.outputs.steering);
    if let Some(asked) = granted(cycle) {
        return out
            == Steering {
                enable: true,
                angle: asked.angle.max(bound.angle_least).min(bound.angle_most),
                rate: asked.rate.min(bound.rate),
                overlay: asked.overlay.max(bound.overlay_least).min(bound.overlay_most),
                weight: asked.weight.max(bound.weight_least).min(bound.weight_most),
                bar_limit: asked.bar_limit.min(bound.bar),
            };
    }
    let fading = Steering {
        enable: bound.weight_least > Percent::ZERO,
        angle: bound.angle_neutral,
        rate: RateDeciDegS::ZERO,
        overlay: bound.overlay_neutral,
        weight: bound.weight_least,
        bar_limit: bound.bar,
    };
    let idle = !fading.enable && fading.overlay.raw() == 0;
    let passes = |asked: &Steering| {
        let asks_nothing = !asked.enable && asked.weight == Percent::ZERO && asked.overlay.raw() == 0;
        let in_range = asked.angle.raw().unsigned_abs() <= bound.range.raw().unsigned_abs();
        asks_nothing && in_range && asked.rate <= bound.rate && asked.bar_limit <= bound.bar
    };
    out == if idle { asked(cycle).filter(passes).unwrap_or(Steering::NEUTRAL) } else { fading }
}

/// STR-2a, STR-2e, STR-2g, STR-2h, SELF-5g: automatic steering is permitted exactly outside of the safe state, not
/// taken over, not astray, with the power steering known ready or active, wheel and hands known, within the speed
/// range, and while it acts already or a mode is granted, the cruise switch not known off. Leave is none of the
/// conditions.
#[must_use]
pub fn str_2_permitted_exactly(cycle: &Cycle<'_>) -> bool {
    let (inputs, config) = (cycle.inputs, cycle.config);
    let (least, greatest) = (config.steering_speed_least.raw(), config.steering_speed_greatest.raw());
    let steering = &cycle.new.steering;
    let sound = !cycle.new.is_safe_state() && !steering.barred && !steering.astray;
    let known = (inputs.eps.is(EpsState::Ready) || inputs.eps.is(EpsState::Active))
        && steering_angle(cycle).is_some()
        && inputs.driver_torque.known().is_some();
    let in_range = agreed_speeds(cycle).is_some_and(|(low, high)| low >= least && high <= greatest);
    let wanted = cycle.old.steering.weight > Percent::ZERO || cycle.new.drive.mode != Mode::Manual;
    let may = sound && known && in_range && wanted && !inputs.cruise_switch.is(false);
    cycle.envelope.steering.enable.is_ok() == may
}

/// STR-1b, STR-1c, STR-1d, STR-1g, STR-2f, SELF-11e, CMD-3f: while it acts, the angle is what is asked for, up to
/// exactly what window and rate permit; not permitted, not asked for or lost, it stays where it is, as far as they
/// permit that.
#[must_use]
pub fn str_1_angle_is_exactly_bounded(cycle: &Cycle<'_>) -> bool {
    let (least, most) = angles(cycle);
    let wanted = granted(cycle).map_or(start(cycle), |asked| i32::from(asked.angle.raw()));
    let out = i32::from(cycle.outputs.steering.angle.raw());
    implies(cycle.outputs.steering.enable, out == wanted.max(least).min(most))
}

/// STR-1a: the angle that goes out, and the one that is kept, never leave ±720° once they are inside and the table is.
#[must_use]
pub fn str_1_angle_stays_in_range(cycle: &Cycle<'_>) -> bool {
    let range = cycle.config.steering_range.raw().unsigned_abs();
    let inside = |angle: i16| angle.unsigned_abs() <= range;
    let table = cycle.config.steering_angle.0.iter().all(|angle| angle.raw() >= 0 && inside(angle.raw()));
    let before = inside(cycle.old.steering.angle.raw()) && table;
    implies(before, inside(cycle.outputs.steering.angle.raw()) && inside(cycle.next.steering.angle.raw()))
}

/// STR-1c, STR-1f, STR-1g: neither the rate nor the bar-torque limit that goes out is beyond ours or the one asked for.
#[must_use]
pub fn str_1_rate_and_bar_never_widened(cycle: &Cycle<'_>) -> bool {
    let (out, own) = (&cycle.outputs.steering, cycle.config.steering_bar);
    let (rate, bar) = match granted(cycle) {
        Some(asked) => (asked.rate.min(rate(cycle)), asked.bar_limit.min(own)),
        None => (RateDeciDegS::ZERO, own),
    };
    implies(out.enable, out.rate == rate && out.bar_limit == bar) && out.bar_limit <= own
}

/// STR-1e: the overlay torque is never beyond its bound, which is below the takeover torque in any valid configuration.
#[must_use]
pub fn str_1_overlay_below_takeover(cycle: &Cycle<'_>) -> bool {
    let (out, bound) = (cycle.outputs.steering.overlay.raw().unsigned_abs(), cycle.config.steering_overlay);
    let takeover = cycle.config.takeover_torque;
    out <= bound.raw().max(0).unsigned_abs()
        && implies(bound < takeover && takeover.raw() > 0, out < takeover.raw().unsigned_abs())
}

/// STR-2c, STR-2d, SELF-5g, SELF-11e, E2E-2i: the overlay torque is what is asked for, up to what the fade permits
/// either way from the last one; not permitted, not asked for or lost, it fades towards 0.
#[must_use]
pub fn str_2_overlay_fades(cycle: &Cycle<'_>) -> bool {
    let (least, most) = overlays(cycle);
    let wanted = granted(cycle).map_or(0, |asked| i32::from(asked.overlay.raw()));
    i32::from(cycle.outputs.steering.overlay.raw()) == wanted.max(least).min(most)
}

/// STR-2c, STR-2d, SELF-5g, SELF-11e, E2E-2i: the weight fades in towards what is asked for and never drops; not
/// permitted, not asked for or lost, it fades out, and automatic steering acts until it has.
#[must_use]
pub fn str_2_weight_fades(cycle: &Cycle<'_>) -> bool {
    let (least, most) = weights(cycle);
    let out = &cycle.outputs.steering;
    match granted(cycle) {
        Some(asked) => out.enable && out.weight.raw() == asked.weight.raw().max(least).min(most),
        None => out.weight.raw() == least && out.enable == (least > 0),
    }
}

/// STR-1a, STR-1f, SELF-11e: what does not act carries no overlay that is not fading, and fields in range only.
#[must_use]
pub fn str_2_idle_commands_nothing(cycle: &Cycle<'_>) -> bool {
    let (out, config) = (&cycle.outputs.steering, cycle.config);
    implies(
        !out.enable,
        out.weight == Percent::ZERO
            && out.angle.raw().unsigned_abs() <= config.steering_range.raw().unsigned_abs().max(kept(cycle))
            && out.rate <= rate(cycle)
            && out.bar_limit <= config.steering_bar,
    )
}

/// The greatest angle that is permitted in this cycle, either way.
fn kept(cycle: &Cycle<'_>) -> u16 {
    let (least, most) = angles(cycle);
    u16::try_from(least.unsigned_abs().max(most.unsigned_abs())).unwrap_or(u16::MAX)
}

/// STR-2a: a torque of the driver's hands beyond the takeover torque, either way, for its time ends automatic steering;
/// what is not known, or less, begins the time anew.
#[must_use]
pub fn str_2_takeover_ends(cycle: &Cycle<'_>) -> bool {
    let (old, new) = (&cycle.old.steering, &cycle.new.steering);
    let limit = cycle.config.takeover_torque.raw().unsigned_abs();
    let strong = cycle.inputs.driver_torque.known().is_some_and(|torque| torque.raw().unsigned_abs() > limit);
    let counted = if strong { old.takeover.run(ticks(cycle).safety) } else { Timer::STOPPED };
    let reached = new.takeover.reached(cycle.config.takeover_time);
    new.takeover == counted
        && new.barred == (old.barred || reached)
        && implies(reached, cycle.envelope.steering.enable.is_err())
        && cycle.next.steering.takeover == new.takeover
}

/// STR-2a, RSP-1k, SEAT-9a: what was taken over, or did not follow with somebody to hand the wheel to, acts again only
/// when a usable command asks for nothing first; a lost command is no such evidence.
#[must_use]
pub fn str_2_asked_for_anew(cycle: &Cycle<'_>) -> bool {
    let (old, new, next) = (&cycle.old.steering, &cycle.new.steering, &cycle.next.steering);
    let anew = asked(cycle).is_some_and(|asked| !asked.enable);
    new.astray == (old.astray || (cycle.response.steering && !cycle.new.seat.leave))
        && next.barred == (new.barred && !anew)
        && next.astray == (new.astray && !anew)
}

/// STR-2b: what has ended, is ending or has lost its command is shown to the driver.
#[must_use]
pub fn str_2_end_is_shown(cycle: &Cycle<'_>) -> bool {
    let (old, new) = (&cycle.old.steering, &cycle.new.steering);
    let acts = old.weight > Percent::ZERO;
    let ending = acts && cycle.envelope.steering.enable.is_err();
    let lost = asked(cycle).is_none() && cycle.outputs.steering.weight > Percent::ZERO;
    implies(new.barred || new.astray || ending || old.lost, cycle.outputs.warnings.notice_lamp)
        && cycle.next.steering.lost == lost
}

/// CMD-3f: everything that fades or moves is counted from what went out, and keeps what is left below one unit.
#[must_use]
pub fn cmd_3_steering_counts_from_our_last_output(cycle: &Cycle<'_>) -> bool {
    let (old, next, out) = (&cycle.old.steering, &cycle.next.steering, &cycle.outputs.steering);
    let elapsed = ticks(cycle).permission;
    next.weight == out.weight
        && next.angle == out.angle
        && next.overlay == out.overlay
        && next.angle_rest == old.angle_rest.portion(rate(cycle).raw(), elapsed).1
        && next.fade_rest == old.fade_rest.portion(cycle.config.steering_fade.raw(), elapsed).1
}
