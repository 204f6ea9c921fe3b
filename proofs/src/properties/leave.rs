//! How strongly does the bus brake in leave? (SEAT-3)

use supervisor_core::{Config, DecelMs2Q11, EpbState, kernel};

use super::{Cycle, Property, all, implies};

/// Every property of this file.
pub const ALL: &[Property] = all![seat_3_table, seat_3_demand_of_leave];

/// The speeds of S3 table 1 in 1/256 km/h: 0, 2, 4, 6, 8, 10, 15, 20, ... 60 km/h.
const SPEEDS: [u16; 16] =
    [0, 512, 1024, 1536, 2048, 2560, 3840, 5120, 6400, 7680, 8960, 10240, 11520, 12800, 14080, 15360];

/// How far apart two points lie: 2 km/h up to 10 km/h, 5 km/h above (S3 table 1).
pub const FINE: u16 = 512;
/// See [`FINE`].
pub const COARSE: u16 = 1280;

/// Where `speed` lies between two points of the table: how far from the lower one, how far apart they are, and their values.
#[derive(Clone, Copy)]
struct Place {
    here: u16,
    next: u16,
    rest: u16,
    step: u16,
}

fn place(speed: u16, config: &Config) -> Place {
    let values = config.leave_decel.0.map(DecelMs2Q11::raw);
    let last = values.last().copied().unwrap_or(0);
    let mut place = Place { here: last, next: last, rest: 0, step: 1 };
    let points = SPEEDS.into_iter().zip(values);
    for ((start, here), (end, next)) in points.clone().zip(points.skip(1)) {
        if (start..end).contains(&speed) {
            place = Place { here, next, rest: speed - start, step: end - start };
        }
    }
    place
}

/// On the line or above it, by cross-multiplication; a table that falls counts as level.
fn at_least_line(decel: u16, Place { here, next, rest, step }: Place) -> bool {
    let way = u32::from(next.saturating_sub(here)) * u32::from(rest);
    decel >= here && u32::from(decel - here) * u32::from(step) >= way
}

/// SEAT-3b, SEAT-3c: the least value that is on the line between two points or above it.
#[must_use]
pub fn is_line(decel: u16, here: u16, next: u16, rest: u16, step: u16) -> bool {
    let way = u32::from(next.saturating_sub(here)) * u32::from(rest);
    let place = Place { here, next, rest, step };
    at_least_line(decel, place) && u32::from(decel - here) * u32::from(step) < way + u32::from(step)
}

/// SEAT-3a, SEAT-3b, SEAT-3c: whether `decel` is a₀ at `speed`, exactly.
#[must_use]
pub fn is_table(decel: DecelMs2Q11, speed: u16, config: &Config) -> bool {
    let Place { here, next, rest, step } = place(speed, config);
    is_line(decel.raw(), here, next, rest, step)
}

/// SEAT-3a, SEAT-3b: a₀ at `speed` where the kernel is any function: beyond the last point its value, everywhere else the
/// line between the points on both sides.
#[must_use]
pub fn line_of_table(speed: u16, config: &Config) -> DecelMs2Q11 {
    let Place { here, next, rest, step } = place(speed, config);
    DecelMs2Q11::new(if step == 1 { here } else { kernel::between_up(here, next, rest, step) })
}

/// SEAT-3a: whether `decel` is at least a₀ at `speed`.
#[must_use]
pub fn at_least_table(decel: DecelMs2Q11, speed: u16, config: &Config) -> bool {
    at_least_line(decel.raw(), place(speed, config))
}

/// SEAT-3a, SEAT-3b, SEAT-3c, SEAT-3d: in leave with a known speed, by the lower one: at each of the 16 points the value of
/// the table, between two of them the line, rounded up, beyond the last point its value; slower than the hold speed at least
/// the hold, until the parking brake is known applied.
#[must_use]
pub fn seat_3_table(cycle: &Cycle<'_>) -> bool {
    let Some((low, _)) = cycle.agreed_speeds() else { return true };
    let (demand, hold) = (cycle.new.brake.leave, cycle.config.leave_hold);
    let slow = low < cycle.config.leave_hold_speed.raw();
    let loose = !cycle.inputs.epb.is(EpbState::Applied);
    let by_table = is_table(demand, low, cycle.config);
    let by_hold = demand == hold && at_least_table(demand, low, cycle.config);
    implies(cycle.new.seat.leave, if slow && loose { demand >= hold && (by_table || by_hold) } else { by_table })
}

/// SEAT-3e, RULE-1d: in leave with an unknown speed the last demand, at least the hold; without leave there is none.
#[must_use]
pub fn seat_3_demand_of_leave(cycle: &Cycle<'_>) -> bool {
    let (demand, before) = (cycle.new.brake.leave, cycle.old.brake.leave);
    let unknown = cycle.agreed_speeds().is_none();
    implies(cycle.new.seat.leave && unknown, demand == before.max(cycle.config.leave_hold))
        && implies(!cycle.new.seat.leave, demand == DecelMs2Q11::ZERO)
}
