//! Driver out of seat: who sits, and when *leave* begins and ends (S3 §2.1, SEAT-1, SEAT-9, SEAT-10).
//!
//! - *Confirmed occupied*: both sensors known occupied for `seat_confirm`; lost at once on anything else.
//! - *Leave* begins when the bus is not parked and both sensors are vacant together for `seat_vacant`; it ends
//!   only by confirmed occupied.

use supervisor_observe::Ticks;
use supervisor_observe::{Evidence, SeatView};

use supervisor_terms::word::retained;
use supervisor_terms::{Config, Contact, EpbState, Inputs, Key, Timer};

retained! {
    /// The seat machine.
    SeatState {
        /// Both sensors known occupied.
        occupied: Timer = Timer::STOPPED,
        /// Both sensors known vacant, over short gaps.
        vacant: Timer = Timer::STOPPED,
        /// Sensors unknown while the vacancy is frozen.
        unknown: Timer = Timer::STOPPED,
        /// Leave runs.
        leave: bool = false,
    }
}

impl SeatState {
    /// SEAT-0a, SEAT-10b: *confirmed occupied*, the evidence of every permission that needs a driver.
    #[must_use]
    pub const fn confirmed(&self, config: &Config) -> bool {
        self.occupied.reached(config.seat_confirm)
    }

    /// SEAT-10a: sensors that disagree or are unknown begin no leave and end none.
    pub(crate) fn advance(self, evidence: &Evidence, inputs: &Inputs, ticks: Ticks, config: &Config) -> Self {
        let occupied = self.occupied.run_while(evidence.seat == SeatView::Occupied, ticks.permission);
        let (vacant, unknown) = match evidence.seat {
            // SEAT-1: a sensor known occupied resets the 2 s.
            SeatView::Occupied | SeatView::HalfOccupied => (Timer::STOPPED, Timer::STOPPED),
            SeatView::Vacant => (self.vacant.run(ticks.safety), Timer::STOPPED),
            // SEAT-1: unknown freezes it for a while, then resets.
            SeatView::Unknown => {
                let unknown = self.unknown.run(ticks.permission);
                (if unknown.reached(config.seat_freeze) { Timer::STOPPED } else { self.vacant }, unknown)
            }
        };
        let next = Self { occupied, vacant, unknown, leave: self.leave };
        // SEAT-9a, d: confirmed ends it; the next one begins like the first.
        let leave = if self.leave {
            !next.confirmed(config)
        } else {
            not_parked(evidence, inputs, config) && vacant.reached(config.seat_vacant)
        };
        Self { leave, ..next }
    }
}

/// SEAT-0b: *not parked* = powered on and (EPB known not applied, or speed known ≥ 1.5 km/h).
///
/// *Powered on* is read both ways of S3's 上电: the key is on, or the battery's main contactor is closed.
fn not_parked(evidence: &Evidence, inputs: &Inputs, config: &Config) -> bool {
    let powered = inputs.key.is(Key::On) || inputs.key.is(Key::Start) || inputs.k1.is(Contact::Closed);
    powered && (inputs.epb.is(EpbState::Released) || evidence.surely_at_least(config.epb_speed))
}
