//! The retarder (RET-1, PHB-1).

use supervisor_core::{Percent, Retarder, RetarderMode, kernel};

use super::known::asked;
use super::{Cycle, Property, all, implies};

/// Every property of this file.
pub const ALL: &[Property] = all![
    ret_1b_none_beside_abs,
    ret_1b_bound_exactly,
    ret_1a_as_much_as_fits,
    ret_1a_total_below_cap,
    self_11g_request_inside_cap_passes,
];

/// RET-1b: while ABS is at work the retarder is told 0 %.
#[must_use]
pub fn ret_1b_none_beside_abs(cycle: &Cycle<'_>) -> bool {
    implies(cycle.inputs.abs.is(true), cycle.outputs.retarder.torque == Percent::ZERO)
}

/// RET-1b: ABS known at work is the only thing that bounds the retarder beside the cap; then it is not obliged to help.
#[must_use]
pub fn ret_1b_bound_exactly(cycle: &Cycle<'_>) -> bool {
    let bound = &cycle.envelope.brake;
    let most = if cycle.inputs.abs.is(true) { Percent::ZERO } else { Percent::FULL };
    bound.retarder.most == most
        && implies(bound.retarder_obliged, most == Percent::FULL)
        && bound.retarder_decel == cycle.config.retarder_decel
}

/// RET-1a, SELF-11g: the retarder is told what was asked for, but no more than its bound and what fits beside the service
/// brake below the cap; obliged, it is told all of that.
#[must_use]
pub fn ret_1a_as_much_as_fits(cycle: &Cycle<'_>) -> bool {
    let (bound, out) = (&cycle.envelope.brake, cycle.outputs.retarder);
    let room = bound.cap.most.raw().saturating_sub(cycle.outputs.brake.total.raw());
    let most = bound.retarder.most.min(Percent::new(kernel::fits(room, bound.retarder_decel.raw())));
    if bound.retarder_obliged {
        return out.torque == most && out.mode == RetarderMode::Torque;
    }
    match asked(cycle.commands.retarder, cycle.envelope.timeouts.ms100) {
        Some(wanted) => out == Retarder { torque: wanted.torque.min(most), ..wanted },
        None => out.torque == bound.retarder_fallback.min(most),
    }
}

/// RET-1a, PHB-1a, PHB-1b: service brake and retarder together stay below the cap, counted with what the retarder gives for
/// each per cent.
#[must_use]
pub fn ret_1a_total_below_cap(cycle: &Cycle<'_>) -> bool {
    let (bound, out) = (&cycle.envelope.brake, cycle.outputs);
    let each = u32::from(bound.retarder_decel.raw());
    let total = u32::from(out.brake.total.raw()) + each * u32::from(out.retarder.torque.raw());
    total <= u32::from(bound.cap.most.raw()).max(u32::from(out.brake.total.raw()))
}

/// SELF-11g, CMD-3c: a retarder request that keeps the total below the cap goes out unchanged while ABS is not known at work
/// and nothing is obliged of the retarder. What goes beyond it is limited by the smallest possible amount.
#[must_use]
pub fn self_11g_request_inside_cap_passes(cycle: &Cycle<'_>) -> bool {
    let (bound, out) = (&cycle.envelope.brake, cycle.outputs);
    let (each, service) = (u32::from(bound.retarder_decel.raw()), u32::from(out.brake.total.raw()));
    let fits = |percents: u8| service + each * u32::from(percents) <= u32::from(bound.cap.most.raw());
    asked(cycle.commands.retarder, cycle.envelope.timeouts.ms100).is_none_or(|wanted| {
        let fits_all = fits(wanted.torque.raw()) && wanted.torque <= bound.retarder.most.min(Percent::FULL);
        let limited =
            out.retarder.torque < wanted.torque && out.retarder.torque < bound.retarder.most.min(Percent::FULL);
        implies(!bound.retarder_obliged && fits_all, out.retarder == wanted)
            && implies(
                limited && service <= u32::from(bound.cap.most.raw()),
                !fits(out.retarder.torque.raw().saturating_add(1)),
            )
            && implies(bound.retarder_obliged, out.retarder.mode == RetarderMode::Torque)
    })
}
