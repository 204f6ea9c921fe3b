//! The warnings (FCW-1, PCW-1, SEAT-1, RPT-1).

use supervisor_core::{Alert, Faults, Warnings};

use super::known::asked;
use super::{Cycle, Property, all};

/// Every property of this file.
pub const ALL: &[Property] =
    all![fcw_1_pcw_1_begin_and_end_exactly, warnings_obliged_exactly, self_11j_warnings_given_exactly];

/// FCW-1a, FCW-1b, PCW-1a, PCW-1b, RULE-1d: each warning is on when its condition to begin holds, off when its condition to
/// end holds, and otherwise, perception unknown included, as it was.
#[must_use]
pub fn fcw_1_pcw_1_begin_and_end_exactly(cycle: &Cycle<'_>) -> bool {
    let (old, new) = (&cycle.old.mitigation, &cycle.new.mitigation);
    let follows = |old: bool, new: bool, says: Alert| match says {
        Alert::On => new,
        Alert::Off => !new,
        Alert::Keep => new == old,
    };
    follows(old.forward, new.forward, cycle.threat.forward)
        && follows(old.pedestrian, new.pedestrian, cycle.threat.pedestrian)
}

/// FCW-1a, FCW-1b, PCW-1a, PCW-1b, SEAT-1a, SELF-5h: what is obliged: the two warnings that run, seat leave in leave, the
/// hazard flashers in leave and in the safe state, the fault lamp by every fault that is not a mere hint.
#[must_use]
pub fn warnings_obliged_exactly(cycle: &Cycle<'_>) -> bool {
    let (bound, new) = (&cycle.envelope.warnings, cycle.new);
    bound.forward_collision == new.mitigation.forward
        && bound.pedestrian == new.mitigation.pedestrian
        && bound.seat_leave == new.seat.leave
        && bound.hazard_flashers == (new.seat.leave || new.is_safe_state())
        && bound.fault_lamp == (cycle.faults.bits() & !(Faults::TTC_DISAGREEMENT.bits() | Faults::TAKEOVER.bits()) != 0)
}

/// FCW-1c, PCW-1c, SELF-11j, RULE-3a: a warning is given exactly when it is asked for or obliged, so one that is asked for
/// earlier passes; the others pass as they are. Without a usable command only what is obliged.
#[must_use]
pub fn self_11j_warnings_given_exactly(cycle: &Cycle<'_>) -> bool {
    let (bound, out) = (&cycle.envelope.warnings, &cycle.outputs.warnings);
    let asked = asked(cycle.commands.warnings, cycle.envelope.timeouts.ms200).unwrap_or(Warnings::NEUTRAL);
    out.forward_collision == (asked.forward_collision || bound.forward_collision)
        && out.pedestrian == (asked.pedestrian || bound.pedestrian)
        && out.seat_leave == (asked.seat_leave || bound.seat_leave)
        && out.hazard_flashers == (asked.hazard_flashers || bound.hazard_flashers)
        && out.fault_lamp == (asked.fault_lamp || bound.fault_lamp)
        && out.notice_lamp == (asked.notice_lamp || bound.notice_lamp)
        && out.lane_departure == asked.lane_departure
        && out.speed_limit == asked.speed_limit
        && out.headway == asked.headway
}
