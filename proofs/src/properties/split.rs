//! How a brake demand is split between drive and friction (VLC-2, VLC-3).

use supervisor_core::{DecelMs2Q11, Faults, Signal};

use super::known::asked;
use super::{Cycle, Property, all};

/// Every property of this file.
pub const ALL: &[Property] = all![vlc_2_electric_limit_exactly, vlc_3_implausible_is_told, vlc_2_split_exactly];

/// Whether a value is known and in its range, known and out of it, or unknown.
fn judged<T: Copy + PartialEq + PartialOrd>(signal: Signal<T>, least: T, most: T) -> Option<bool> {
    signal.known().map(|value| least <= value && value <= most)
}

/// The values by which the brake system splits: mass, pressure of both axles, actual electric deceleration.
fn values(of: &Cycle<'_>) -> [Option<bool>; 4] {
    let (inputs, config) = (of.inputs, of.config);
    let ([lightest, heaviest], [front, rear]) = (config.mass_range.0, inputs.axle_pressure);
    let none = supervisor_core::Pressure5KPa::ZERO;
    let actual = inputs.electric_limit.known().and_then(|limit| {
        let most = DecelMs2Q11::new(limit.raw().saturating_add(config.electric_excess.raw()));
        judged(inputs.electric_actual, DecelMs2Q11::ZERO, most)
    });
    [
        judged(inputs.mass, lightest, heaviest),
        judged(front, none, config.axle_pressure_most),
        judged(rear, none, config.axle_pressure_most),
        actual,
    ]
}

/// VLC-2b, VLC-2c, VLC-2d, VLC-3a, RULE-1c: the electric part may be as much as its known limit exactly while ABS, ASR and
/// stability control are each known not at work and every value by which the brake system splits is known and plausible;
/// else nothing.
#[must_use]
pub fn vlc_2_electric_limit_exactly(cycle: &Cycle<'_>) -> bool {
    let inputs = cycle.inputs;
    let grip = inputs.abs.is(false) && inputs.asr.is(false) && inputs.stability.is(false);
    let sound = values(cycle) == [Some(true); 4];
    let limit = inputs.electric_limit.known().filter(|_| grip && sound).unwrap_or(DecelMs2Q11::ZERO);
    cycle.envelope.brake.electric == limit
}

/// VLC-3a: a value that is known and not plausible is reported, and nothing else is reported as that.
#[must_use]
pub fn vlc_3_implausible_is_told(cycle: &Cycle<'_>) -> bool {
    let bad = values(cycle).contains(&Some(false));
    // The latches, the response and this are all that the faults come from; neither of the first two is of this kind, unless
    // what they are given already says so.
    let given = cycle.response.faults.with(cycle.new.latches.faults).contains(Faults::SPLIT_IMPLAUSIBLE);
    cycle.faults.contains(Faults::SPLIT_IMPLAUSIBLE) == (bad || given)
}

/// VLC-1b, VLC-2a, VLC-2c, VLC-2e, VLC-2g: an obligation beyond the request is split electric first, as far as its limit
/// allows; any other request keeps the electric part that it asks for, as far as its limit and the total allow. What is left
/// of the total is friction: a limit of a part takes nothing from the total, see
/// [`vlc_1e_requests_merge`](super::brake::vlc_1e_requests_merge).
#[must_use]
pub fn vlc_2_split_exactly(cycle: &Cycle<'_>) -> bool {
    let (bound, out) = (&cycle.envelope.brake, &cycle.outputs.brake);
    let command = asked(cycle.commands.brake, cycle.envelope.timeouts.ms50);
    let (total, electric) =
        command.map_or((bound.fallback, DecelMs2Q11::ZERO), |wanted| (wanted.total, wanted.electric));
    let raised = total < bound.floor.most;
    let electric = if raised { bound.electric } else { electric.min(bound.electric) };
    out.electric == electric.min(out.total)
}
