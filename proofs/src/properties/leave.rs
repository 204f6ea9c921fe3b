//! How strongly does the bus brake in leave? (SEAT-3)

use supervisor_core::{Config, DecelMs2Q11, EpbState};

use super::{Cycle, Property, all, implies};

/// Every property of this file.
pub const ALL: &[Property] = all![seat_3_table, seat_3_demand_of_leave];

/// The speeds of S3 table 1 in 1/256 km/h: 0, 2, 4, 6, 8, 10, 15, 20, ... 60 km/h.
const SPEEDS: [u16; 16] =
    [0, 512, 1024, 1536, 2048, 2560, 3840, 5120, 6400, 7680, 8960, 10240, 11520, 12800, 14080, 15360];

/// Where `speed` lies between two points of the table: how far from the lower one, how far apart they are, and their values.
struct Place {
    rest: u32,
    step: u32,
    here: u32,
    next: u32,
}

fn place(speed: u16, config: &Config) -> Place {
    let values = config.leave_decel.0.map(|decel| u32::from(decel.raw()));
    let last = values.last().copied().unwrap_or(0);
    let mut place = Place { rest: 0, step: 1, here: last, next: last };
    let points = SPEEDS.into_iter().zip(values);
    for ((start, here), (end, next)) in points.clone().zip(points.skip(1)) {
        if (start..end).contains(&speed) {
            place = Place { rest: u32::from(speed - start), step: u32::from(end - start), here, next };
        }
    }
    place
}

impl Place {
    /// On the line or above it, by cross-multiplication; a table that falls counts as level.
    fn at_least(&self, decel: u16) -> bool {
        let way = self.next.saturating_sub(self.here) * self.rest;
        u32::from(decel) >= self.here && (u32::from(decel) - self.here) * self.step >= way
    }
    /// The least value that is: the line, rounded to the stronger side.
    fn exactly(&self, decel: u16) -> bool {
        let way = self.next.saturating_sub(self.here) * self.rest;
        self.at_least(decel) && (u32::from(decel) - self.here) * self.step < way + self.step
    }
}

/// SEAT-3a, SEAT-3b, SEAT-3c: whether `decel` is a₀ at `speed`, exactly.
#[must_use]
pub fn is_table(decel: DecelMs2Q11, speed: u16, config: &Config) -> bool {
    place(speed, config).exactly(decel.raw())
}

/// SEAT-3a: whether `decel` is at least a₀ at `speed`.
#[must_use]
pub fn at_least_table(decel: DecelMs2Q11, speed: u16, config: &Config) -> bool {
    place(speed, config).at_least(decel.raw())
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
    let place = place(low, cycle.config);
    let by_table = place.exactly(demand.raw());
    let by_hold = demand == hold && place.at_least(demand.raw());
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
