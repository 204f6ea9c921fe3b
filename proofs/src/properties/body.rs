//! Lamps, wipers, horn (BODY-1, E2E-2).

use supervisor_core::{Body, DecelMs2Q11, Millis, kernel};

use super::known::asked;
use super::{Cycle, Property, all, implies};

/// Every property of this file.
pub const ALL: &[Property] = all![
    body_1_brake_lamps_exactly,
    body_1c_lamps_go_off_after_the_delay,
    body_1c_delay_counts_real_time,
    body_1d_flashers_override_indicators,
    self_11j_body_passes,
    e2e_1g_timeouts_as_configured
];

/// Whether the lamps are due by themselves: by the total deceleration that goes out, or by an obligation.
fn due(of: &Cycle<'_>, least: DecelMs2Q11) -> bool {
    let (bound, out) = (&of.envelope.brake, of.outputs);
    let total = kernel::together(out.brake.total.raw(), bound.retarder_decel.raw(), out.retarder.torque.raw());
    total >= least.raw() || bound.floor.most > DecelMs2Q11::ZERO
}

/// BODY-1a, BODY-1b, RET-1a: the brake lamps are on while service brake and retarder together reach the threshold, with every
/// obligation to brake, for the delay after that, and when they are asked for; and not otherwise.
#[must_use]
pub fn body_1_brake_lamps_exactly(cycle: &Cycle<'_>) -> bool {
    let asked = asked(cycle.commands.body, cycle.envelope.timeouts.ms200).is_some_and(|command| command.brake_lamps);
    let due = due(cycle, cycle.envelope.lamp_decel) || cycle.envelope.lamps_delayed;
    cycle.outputs.body.brake_lamps == (due || asked)
}

/// BODY-1c, E2E-2j: they are still due while some of the delay is left; the threshold and the last output are what they were
/// configured and recorded to be.
#[must_use]
pub fn body_1c_lamps_go_off_after_the_delay(cycle: &Cycle<'_>) -> bool {
    cycle.envelope.lamps_delayed == (cycle.old.brake.lamps > Millis::ZERO)
        && cycle.envelope.lamp_decel == cycle.config.lamp_decel
        && cycle.envelope.body_fallback == cycle.old.body
}

/// BODY-1c, E2E-2j: the delay begins anew with every cycle that has a reason of its own, and else passes in real time.
#[must_use]
pub fn body_1c_delay_counts_real_time(cycle: &Cycle<'_>) -> bool {
    let (elapsed, _) = cycle.elapsed();
    let left = cycle.new.brake.lamps.raw().saturating_sub(elapsed);
    let due = due(cycle, cycle.config.lamp_decel);
    cycle.next.brake.lamps == if due { cycle.config.lamp_delay } else { Millis::new(left) }
        && cycle.next.body == cycle.outputs.body
}

/// BODY-1d: while the hazard flashers are obliged, in leave, neither indicator is on beside them.
#[must_use]
pub fn body_1d_flashers_override_indicators(cycle: &Cycle<'_>) -> bool {
    let (body, flashers) = (&cycle.outputs.body, cycle.envelope.warnings.hazard_flashers);
    implies(flashers, !body.indicator_left && !body.indicator_right)
}

/// SELF-11j, E2E-2j, CMD-3c: all else passes as it is asked for, without a usable command as it was; the horn falls silent.
#[must_use]
pub fn self_11j_body_passes(cycle: &Cycle<'_>) -> bool {
    let out = &cycle.outputs.body;
    let last = Body { horn: false, ..cycle.envelope.body_fallback };
    let wanted = asked(cycle.commands.body, cycle.envelope.timeouts.ms200).unwrap_or(last);
    let flashers = cycle.envelope.warnings.hazard_flashers;
    out.wipers == wanted.wipers
        && out.low_beam == wanted.low_beam
        && out.high_beam == wanted.high_beam
        && out.horn == wanted.horn
        && implies(!flashers, out.indicator_left == wanted.indicator_left)
        && implies(!flashers, out.indicator_right == wanted.indicator_right)
}

/// E2E-1g: a command counts as lost after the configured time-outs.
#[must_use]
pub fn e2e_1g_timeouts_as_configured(cycle: &Cycle<'_>) -> bool {
    let (timeouts, config) = (cycle.envelope.timeouts, cycle.config);
    timeouts.ms50 == config.timeout_50 && timeouts.ms100 == config.timeout_100 && timeouts.ms200 == config.timeout_200
}
