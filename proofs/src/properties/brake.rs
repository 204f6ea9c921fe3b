//! How much must and may the bus brake? (SEAT-3, MIT, PHB-1, TRQ-3, VLC-2, RSP-1)

use supervisor_core::{BrakeMode, DecelMs2Q11, Deviation, Priority};

use super::{Cycle, Property, all, implies};

/// Every property of this file.
pub const ALL: &[Property] = all![brake_never_below_obligation, rsp_1_retarder_helps];

/// SEAT-3a, MIT-1b, MIT-2b, MIT-3b: the service brake is never below the demand of leave and of the set latches.
#[must_use]
pub fn brake_never_below_obligation(cycle: &Cycle<'_>) -> bool {
    let [one, two, three] = cycle.config.level_decel.0;
    let mitigation = &cycle.new.mitigation;
    let out = &cycle.outputs.brake;
    let demand = |set, decel: DecelMs2Q11| implies(set, out.total >= decel);
    let obliged = cycle.envelope.brake.floor.most > DecelMs2Q11::ZERO;
    demand(mitigation.one, one)
        && demand(mitigation.two, two)
        && demand(mitigation.three, three)
        && demand(cycle.new.seat.leave, cycle.new.brake.leave)
        && implies(obliged, out.mode == BrakeMode::Maximum && out.priority == Priority::Highest)
}

/// RSP-1k, RSP-1l, RSP-1m: brakes that fall short of an obligation are helped by all that the retarder may give,
/// unless ABS is, or may be, at work.
#[must_use]
pub fn rsp_1_retarder_helps(cycle: &Cycle<'_>) -> bool {
    let bound = &cycle.envelope.brake;
    let due = cycle.response.brake != Deviation::None && bound.floor.most > DecelMs2Q11::ZERO;
    bound.retarder_obliged == (due && cycle.inputs.abs.is(false))
}
