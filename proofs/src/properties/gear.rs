//! The gear (GEAR-1, SEAT-6).

use supervisor_core::{Direction, EpbState, Gear, GearRequest, Percent};

use super::facts::{asked, has_run};
use super::{Cycle, Property, all, implies};

/// Every property of this file.
pub const ALL: &[Property] = all![
    seat_6_neutral,
    gear_1_direction_exactly,
    gear_1_no_change_while_rolling,
    gear_1_speed_unknown_holds,
    gear_1_selector_decides,
    self_11_gear_passes,
];

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

/// GEAR-1b: the direction driven in is that of the last confirmed driving gear, through neutral, until the bus stands
/// without one.
#[must_use]
pub fn gear_1_direction_exactly(cycle: &Cycle<'_>) -> bool {
    let kept = cycle.old.gear.direction;
    cycle.new.gear.direction
        == match cycle.inputs.gear.known() {
            Some(Gear::Drive) => Direction::Forward,
            Some(Gear::Reverse) => Direction::Reverse,
            Some(Gear::Neutral | Gear::Park) => {
                if cycle.stands() {
                    Direction::None
                } else {
                    kept
                }
            }
            None => kept,
        }
}

/// GEAR-1a, GEAR-1b, RULE-6b: above standstill, by the higher speed, no P goes out, and D or R only in the direction driven in.
#[must_use]
pub fn gear_1_no_change_while_rolling(cycle: &Cycle<'_>) -> bool {
    let (out, direction) = (cycle.outputs.gear, cycle.new.gear.direction);
    implies(
        !cycle.stands(),
        out != GearRequest::Park
            && implies(out == GearRequest::Drive, direction == Direction::Forward)
            && implies(out == GearRequest::Reverse, direction == Direction::Reverse),
    )
}

/// GEAR-1c, RULE-1c: while the speed is unknown no gear is engaged: it is held, but for neutral, which takes torque away only.
#[must_use]
pub fn gear_1_speed_unknown_holds(cycle: &Cycle<'_>) -> bool {
    implies(cycle.known_speeds().is_none(), matches!(cycle.outputs.gear, GearRequest::Hold | GearRequest::Neutral))
}

/// GEAR-1d, RULE-1c: D, R and P go out only when the driver's selector is known to show the same gear.
#[must_use]
pub fn gear_1_selector_decides(cycle: &Cycle<'_>) -> bool {
    let selected = |gear| cycle.inputs.selector.is(gear);
    match cycle.outputs.gear {
        GearRequest::Hold | GearRequest::Neutral => true,
        GearRequest::Drive => selected(Gear::Drive),
        GearRequest::Reverse => selected(Gear::Reverse),
        GearRequest::Park => selected(Gear::Park),
    }
}

/// SELF-11c, SEAT-4c: seat confirmed and no safe state: hold passes, N unless an apply is overdue, and the gear that the selector
/// shows passes at standstill, D and R also at a known speed in the direction driven in.
#[must_use]
pub fn self_11_gear_passes(cycle: &Cycle<'_>) -> bool {
    let Some(wanted) = asked(cycle.commands.gear, cycle.config.timeout_100) else { return true };
    let along = |direction| cycle.known_speeds().is_some() && cycle.new.gear.direction == direction;
    let selected = |gear| cycle.inputs.selector.is(gear);
    let legal = match wanted {
        GearRequest::Hold => true,
        GearRequest::Neutral => !has_run(cycle.new.parking.unconfirmed, cycle.config.epb_confirm),
        GearRequest::Drive => selected(Gear::Drive) && (cycle.stands() || along(Direction::Forward)),
        GearRequest::Reverse => selected(Gear::Reverse) && (cycle.stands() || along(Direction::Reverse)),
        GearRequest::Park => selected(Gear::Park) && cycle.stands(),
    };
    implies(cycle.confirmed() && !cycle.safe_state() && legal, cycle.outputs.gear == wanted)
}
