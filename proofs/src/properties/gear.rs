//! The gear (GEAR-1, SEAT-6).

use supervisor_core::{EpbState, GearRequest, Percent};

use super::{Cycle, Property, all, implies};

/// Every property of this file.
pub const ALL: &[Property] = all![seat_6_neutral];

/// SEAT-6a to SEAT-6c: parked by leave, confirmed and nobody there: neutral goes out; and no other gear ever with an empty seat
/// at rest.
#[must_use]
pub fn seat_6_neutral(cycle: &Cycle<'_>) -> bool {
    let confirmed = cycle.new.seat.occupied.reached(cycle.config.seat_confirm);
    let parked = cycle.new.parking.by_leave
        && cycle.inputs.epb.is(EpbState::Applied)
        && !confirmed
        && !cycle.new.is_safe_state();
    let at_rest = cycle.inputs.epb.is(EpbState::Applied)
        || cycle.speeds().is_some_and(|(low, _)| low < cycle.config.epb_speed.raw());
    implies(parked, cycle.outputs.gear == GearRequest::Neutral)
        && implies(
            at_rest && !confirmed,
            matches!(cycle.outputs.gear, GearRequest::Hold | GearRequest::Neutral)
                && cycle.outputs.drive.torque == Percent::ZERO,
        )
}
