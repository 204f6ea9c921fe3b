//! Who sits, and when *leave* begins and ends (SEAT-0, SEAT-1, SEAT-9, SEAT-10).

use supervisor_core::{Millis, Timer};

use super::{Cycle, Property, all, implies, sits};

/// Every property of this file.
pub const ALL: &[Property] = all![seat_5_confirmation_counts_real_time];

/// SEAT-0a: what *confirmed* rests on: the timer counts no more than the time that passed with both sensors known
/// occupied in this cycle and the one before, and is lost at once on anything else.
#[must_use]
pub fn seat_5_confirmation_counts_real_time(cycle: &Cycle<'_>) -> bool {
    let (old, new) = (cycle.old.seat.occupied, cycle.new.seat.occupied);
    let passed = cycle.now.raw().wrapping_sub(cycle.old.clock.last.raw());
    let counted = new.elapsed().raw().saturating_sub(old.elapsed().raw());
    implies(!sits(cycle.inputs), new == Timer::STOPPED)
        && implies(!old.is_running(), new.elapsed() == Millis::ZERO)
        && implies(cycle.old.clock.started, counted <= passed)
        && implies(!cycle.old.clock.started, counted == 0)
}
