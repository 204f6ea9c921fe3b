//! May the parking brake be released, must it be applied? (SEAT-4, SEAT-5, EPB-1)

use supervisor_core::{Contact, Deviation, EpbRequest, EpbState, Gear, PedalChain, Reason};

use super::{Cycle, Property, all, implies, sits};

/// Every property of this file.
pub const ALL: &[Property] = all![
    seat_5a_no_release_without_confirmed_seat,
    seat_5_release_after_leave_needs_all,
    seat_5_pedal_chain_is_honest,
    seat_4_apply_in_leave,
    seat_4_latch_holds,
    epb_1_parking_brake_helps
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
