//! May the parking brake be released, must it be applied? (SEAT-4, SEAT-5, EPB-1)

use supervisor_core::{
    Contact, Deviation, EpbRequest, EpbState, EpbSwitch, Faults, Gear, GearRequest, Parking, PedalChain, Pending,
    Reason,
};

use super::facts::{asked, has_run, runs_while};
use super::{Cycle, Property, all, implies, sits};

/// Every property of this file.
pub const ALL: &[Property] = all![
    seat_5a_no_release_without_confirmed_seat,
    seat_5_release_after_leave_needs_all,
    seat_5_pedal_chain_is_honest,
    seat_4_apply_in_leave,
    seat_4_latch_holds,
    epb_1_parking_brake_helps,
    seat_4_apply_exactly,
    seat_4_latch_exactly,
    seat_4c_unconfirmed_is_held_and_reported,
    seat_3_speedless_leave_is_parked,
    seat_5_pedal_chain_exactly,
    epb_1_apply_above_speed,
    epb_1_switch_goes_first,
    self_5_parking_in_the_safe_state,
    self_11_parking_passes,
];

/// SEAT-5a: the EPB is never released while the seat is not confirmed occupied, in any state, whoever asks.
#[must_use]
pub fn seat_5a_no_release_without_confirmed_seat(cycle: &Cycle<'_>) -> bool {
    implies(cycle.releases(), sits(cycle.inputs) && cycle.new.seat.occupied.reached(cycle.config.seat_confirm))
}

/// SEAT-5b to SEAT-5d: after parked by leave, release also needs K1 and K4 closed, a gear other than N, and the
/// accelerator pressed after it was seen released under those conditions.
#[must_use]
pub fn seat_5_release_after_leave_needs_all(cycle: &Cycle<'_>) -> bool {
    let inputs = cycle.inputs;
    let ready = inputs.k1.is(Contact::Closed)
        && inputs.k4.is(Contact::Closed)
        && matches!(inputs.gear.known(), Some(Gear::Drive | Gear::Reverse | Gear::Park));
    let pressed =
        inputs.accelerator.iter().all(|track| track.known().is_some_and(|travel| travel > cycle.config.pedal_pressed));
    let before = cycle.old.parking.pedal != PedalChain::Waiting;
    implies(cycle.releases() && cycle.old.parking.by_leave, ready && pressed && before)
}

/// SEAT-5d: the chain says *released* only in a cycle in which the accelerator is known released.
#[must_use]
pub fn seat_5_pedal_chain_is_honest(cycle: &Cycle<'_>) -> bool {
    let released = cycle
        .inputs
        .accelerator
        .iter()
        .any(|track| track.known().is_some_and(|travel| travel <= cycle.config.pedal_pressed));
    let (old, new) = (cycle.old.parking.pedal, cycle.new.parking.pedal);
    implies(new == PedalChain::Released, released)
        && implies(new == PedalChain::PressedAnew, old != PedalChain::Waiting)
}

/// SEAT-4a, b, d: leave below 1.5 km/h with the brake not confirmed: apply, and the latch is set.
#[must_use]
pub fn seat_4_apply_in_leave(cycle: &Cycle<'_>) -> bool {
    let Some((low, high)) = cycle.speeds() else { return true };
    let agree = u32::from(high - low) <= u32::from(cycle.config.speed_agree.raw());
    let slow = low < cycle.config.epb_speed.raw() && agree;
    let due = cycle.new.seat.leave && slow;
    let applied = cycle.inputs.epb.is(EpbState::Applied);
    implies(due, cycle.new.parking.by_leave) && implies(due && !applied, cycle.outputs.epb.request == EpbRequest::Apply)
}

/// SEAT-4e: the latch is cleared by nothing in `decide`; only [`record`](supervisor_core::record()) of a release clears it.
#[must_use]
pub fn seat_4_latch_holds(cycle: &Cycle<'_>) -> bool {
    implies(cycle.old.parking.by_leave, cycle.new.parking.by_leave)
}

/// EPB-1b, EPB-1c: in leave or level 3, brakes that still fall short are helped by the parking brake at any speed,
/// and by that reason never while ABS is, or may be, at work.
#[must_use]
pub fn epb_1_parking_brake_helps(cycle: &Cycle<'_>) -> bool {
    let due = cycle.response.brake == Deviation::Persistent
        && (cycle.new.seat.leave || cycle.new.mitigation.three)
        && cycle.inputs.abs.is(false)
        && !cycle.new.is_safe_state();
    implies(due, cycle.outputs.epb.request == EpbRequest::Apply)
        && implies(cycle.envelope.epb.obliged == Some(Reason::BrakeResponse), cycle.inputs.abs.is(false))
}

/// SEAT-3f, SEAT-4a, SEAT-4b, SEAT-11d, RULE-4b, RULE-6a: apply is obliged, in every cycle until it is confirmed and again
/// when it comes loose, exactly while leave or an unconfirmed *parked by leave* runs below 1.5 km/h; above it waits.
#[must_use]
pub fn seat_4_apply_exactly(cycle: &Cycle<'_>) -> bool {
    (cycle.envelope.epb.obliged == Some(Reason::EpbApply)) == cycle.apply_owed()
        && implies(cycle.apply_owed(), cycle.outputs.epb.request == EpbRequest::Apply)
}

/// SEAT-4d, SELF-9d, RULE-1b: *parked by leave* begins exactly in leave below 1.5 km/h, or by the boot rule: until boot has
/// settled, with nobody confirmed, the parking brake known applied, and the seat known vacant or waited for long enough.
#[must_use]
pub fn seat_4_latch_exactly(cycle: &Cycle<'_>) -> bool {
    let (old, new) = (cycle.old, cycle.new);
    let slow = cycle.lower_below(cycle.config.epb_speed) || cycle.speedless();
    let waited = has_run(new.boot.wait, cycle.config.boot_settle)
        // The wait is set back in the cycle in which it ends.
        || (new.boot.pending == Pending::Done
            && old.boot.wait.run(cycle.obliging()).reached(cycle.config.boot_settle));
    let boots = old.boot.pending != Pending::Done
        && !cycle.confirmed()
        && cycle.inputs.epb.is(EpbState::Applied)
        && (cycle.vacant() || waited);
    new.parking.by_leave == (old.parking.by_leave || (new.seat.leave && slow) || boots)
        && implies(boots, new.boot.pending == Pending::Done)
}

/// SEAT-4c: an apply that is owed and not confirmed within 2 s is reported; in leave the service brake then holds the bus
/// and the gear stays as it is.
#[must_use]
pub fn seat_4c_unconfirmed_is_held_and_reported(cycle: &Cycle<'_>) -> bool {
    let (old, new, config) = (cycle.old.parking.unconfirmed, cycle.new.parking.unconfirmed, cycle.config);
    let overdue = has_run(new, config.epb_confirm);
    runs_while(cycle.apply_owed(), old, new, cycle.obliging())
        && cycle.reports(Faults::EPB_UNCONFIRMED, overdue)
        && implies(overdue, cycle.outputs.gear == GearRequest::Hold)
        && implies(
            overdue && cycle.new.seat.leave && config.epb_speed <= config.leave_hold_speed,
            cycle.outputs.brake.total >= config.leave_hold,
        )
}

/// SEAT-3f, SELF-3e: speed unknown during leave is counted without a break, and after 20 s the parking brake is applied.
#[must_use]
pub fn seat_3_speedless_leave_is_parked(cycle: &Cycle<'_>) -> bool {
    let (old, new) = (cycle.old.parking.speedless, cycle.new.parking.speedless);
    let unknown = cycle.new.seat.leave && cycle.known_speeds().is_none();
    let due = unknown && has_run(new, cycle.config.epb_speedless);
    runs_while(unknown, old, new, cycle.obliging())
        && implies(due, cycle.new.parking.by_leave)
        && implies(due && !cycle.inputs.epb.is(EpbState::Applied), cycle.outputs.epb.request == EpbRequest::Apply)
}

/// SEAT-5b to SEAT-5d: the chain waits unless, parked by leave, seat, K1, K4 and gear are confirmed and both tracks agree; then
/// it goes *released* by a released pedal, and *pressed anew* from there only.
#[must_use]
pub fn seat_5_pedal_chain_exactly(cycle: &Cycle<'_>) -> bool {
    let inputs = cycle.inputs;
    let Parking { by_leave, pedal, .. } = cycle.new.parking;
    let ready = by_leave
        && cycle.confirmed()
        && inputs.k1.is(Contact::Closed)
        && inputs.k4.is(Contact::Closed)
        && matches!(inputs.gear.known(), Some(Gear::Drive | Gear::Reverse | Gear::Park));
    pedal
        == match (ready, cycle.accelerator()) {
            (false, _) | (_, None) => PedalChain::Waiting,
            (true, Some(travel)) if travel <= cycle.config.pedal_pressed => PedalChain::Released,
            (true, Some(_)) if cycle.old.parking.pedal == PedalChain::Waiting => PedalChain::Waiting,
            (true, Some(_)) => PedalChain::PressedAnew,
        }
}

/// EPB-1a, RULE-1c, RULE-6b: at 1.5 km/h and above apply goes out only for the driver's switch or for EPB-1b; with unknown speed also
/// after 20 s of it in leave and in the safe state of a bus last known slow; a mere request passes below it by the higher speed.
#[must_use]
pub fn epb_1_apply_above_speed(cycle: &Cycle<'_>) -> bool {
    let applies = cycle.outputs.epb.request == EpbRequest::Apply;
    let answered = cycle.switched(EpbSwitch::Apply) || cycle.parking_helps();
    let lasting = (cycle.parking_kept() && cycle.speedless()) || (cycle.safe_state() && cycle.new.parking.slow);
    implies(applies && cycle.lower_at_least(cycle.config.epb_speed), answered)
        && implies(applies && cycle.known_speeds().is_none(), answered || lasting)
        && implies(applies && cycle.envelope.epb.obliged.is_none(), cycle.higher_below(cycle.config.epb_speed))
}

/// EPB-1d: the driver's switch goes first: pulled, apply goes out and never a release, whoever asks; pushed, no apply goes out that
/// nothing obliges while the release is permitted (SEAT-5).
#[must_use]
pub fn epb_1_switch_goes_first(cycle: &Cycle<'_>) -> bool {
    let request = cycle.outputs.epb.request;
    implies(cycle.switched(EpbSwitch::Apply), request == EpbRequest::Apply)
        && implies(
            cycle.switched(EpbSwitch::Release) && cycle.envelope.epb.release.is_ok(),
            request != EpbRequest::Apply,
        )
}

/// SELF-5e, RULE-1d, RULE-6a: in the safe state apply goes out below 1.5 km/h, as last known by the lower speed, or for the driver's
/// switch, or where SEAT-3f owes it; otherwise none.
#[must_use]
pub fn self_5_parking_in_the_safe_state(cycle: &Cycle<'_>) -> bool {
    let slow = cycle.known_speeds().map_or(cycle.old.parking.slow, |(low, _)| low < cycle.config.epb_speed);
    let applies = slow || cycle.switched(EpbSwitch::Apply) || cycle.apply_owed();
    let request = if applies { EpbRequest::Apply } else { EpbRequest::None };
    cycle.new.parking.slow == slow && implies(cycle.safe_state(), cycle.outputs.epb.request == request)
}

/// SELF-11d: driver confirmed in the seat, no obligation, nothing latched: none, apply below 1.5 km/h and release pass unchanged,
/// a release after leave once its own conditions are met.
#[must_use]
pub fn self_11_parking_passes(cycle: &Cycle<'_>) -> bool {
    let (new, config) = (cycle.new, cycle.config);
    let healthy = cycle.confirmed()
        && !cycle.safe_state()
        && !cycle.switched(EpbSwitch::Apply)
        && cycle.response.brake == Deviation::None;
    let Some(wanted) = asked(cycle.commands.epb, config.timeout_200) else { return true };
    let legal = match wanted.request {
        EpbRequest::None => true,
        EpbRequest::Apply => cycle.higher_below(config.epb_speed) && !cycle.switched(EpbSwitch::Release),
        EpbRequest::Release => !new.parking.by_leave || new.parking.pedal == PedalChain::PressedAnew,
    };
    implies(healthy && legal, cycle.outputs.epb == wanted)
}
