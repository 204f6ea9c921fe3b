//! The parking brake (SEAT-4, SEAT-5).

use supervisor_core::{EpbRequest, GearRequest, Outputs, PedalChain, Pending, Reason, vet_brake, vet_epb, vet_gear};

use super::Any;
use crate::properties::parking::{
    epb_1_apply_above_speed, epb_1_switch_goes_first, seat_3_speedless_leave_is_parked, seat_4_apply_exactly,
    seat_4_apply_in_leave, seat_4_latch_exactly, seat_4_latch_holds, seat_4c_unconfirmed_is_held_and_reported,
    seat_5_pedal_chain_exactly, seat_5_pedal_chain_is_honest, seat_5_release_after_leave_needs_all,
    seat_5a_no_release_without_confirmed_seat, self_5_parking_in_the_safe_state, self_11_parking_passes,
};
use crate::properties::seat::seat_5_confirmation_counts_real_time;
use crate::properties::supervisor::self_9_boot_settles_exactly;

impl Any {
    /// The parking brake as vetted, any command.
    pub(super) fn parking(&self) -> Outputs {
        let (epb, _) = vet_epb(&self.decided.envelope, self.commands.epb);
        Outputs { epb, ..kani::any() }
    }
}

/// SEAT-5a.
#[kani::proof]
#[kani::unwind(17)]
fn seat_5_epb_never_released_without_confirmed_seat() {
    let any = Any::new();
    let outputs = any.parking();
    let cycle = any.cycle(&outputs);
    assert!(seat_5a_no_release_without_confirmed_seat(&cycle));
    assert!(seat_5_confirmation_counts_real_time(&cycle));
    assert!(seat_5_release_after_leave_needs_all(&cycle));
    assert!(seat_5_pedal_chain_is_honest(&cycle));
    kani::cover!(outputs.epb.request == EpbRequest::Release, "a release passes");
    kani::cover!(
        outputs.epb.request == EpbRequest::Release && any.old.parking.by_leave,
        "a release after leave passes"
    );
}

/// SEAT-4.
#[kani::proof]
#[kani::unwind(17)]
fn seat_4_epb_applied_in_leave() {
    let any = Any::new();
    let outputs = any.parking();
    let cycle = any.cycle(&outputs);
    assert!(seat_4_apply_in_leave(&cycle));
    assert!(seat_4_latch_holds(&cycle));
    kani::cover!(any.decided.state.seat.leave && outputs.epb.request == EpbRequest::Apply, "leave applies");
    kani::cover!(!any.old.parking.by_leave && any.decided.state.parking.by_leave, "the latch is set");
}

/// SEAT-3f, SEAT-4, SEAT-5d, SEAT-11d, SELF-9d, EPB-1, SELF-5e, SELF-11d: when apply is owed and what may apply, when the latch is
/// set, the chain, the driver's switch, the safe state, exactly; what must pass.
#[kani::proof]
#[kani::unwind(17)]
#[kani::stub(supervisor_core::kernel::within_percent, crate::harness::uninterpreted::within_percent)]
fn seat_4_parking_exactly() {
    let any = Any::new();
    let outputs = any.parking();
    let cycle = any.cycle(&outputs);
    assert!(seat_4_apply_exactly(&cycle));
    assert!(seat_4_latch_exactly(&cycle));
    assert!(seat_3_speedless_leave_is_parked(&cycle));
    assert!(seat_5_pedal_chain_exactly(&cycle));
    assert!(self_9_boot_settles_exactly(&cycle));
    assert!(epb_1_apply_above_speed(&cycle));
    assert!(epb_1_switch_goes_first(&cycle));
    assert!(self_5_parking_in_the_safe_state(&cycle));
    assert!(self_11_parking_passes(&cycle));
    let (old, new, bound) = (&any.old, &any.decided.state, &any.decided.envelope.epb);
    kani::cover!(cycle.speedless() && outputs.epb.request == EpbRequest::Apply, "applied for want of a speed");
    kani::cover!(cycle.apply_owed() && !new.seat.leave, "applied again after leave");
    kani::cover!(!old.parking.by_leave && new.parking.by_leave && !new.seat.leave, "the boot rule parks");
    kani::cover!(new.parking.pedal == PedalChain::PressedAnew, "pressed anew");
    kani::cover!(new.boot.pending == Pending::Clean, "boot still waits");
    let apply = outputs.epb.request == EpbRequest::Apply;
    let fast = cycle.lower_at_least(any.config.epb_speed);
    kani::cover!(apply && fast && bound.obliged == Some(Reason::DriverSwitch), "the switch, rolling");
    kani::cover!(apply && bound.obliged.is_none(), "a request applies");
    kani::cover!(apply && cycle.safe_state() && cycle.known_speeds().is_none(), "the safe state, last known slow");
    kani::cover!(outputs.epb.request == EpbRequest::Release && new.parking.by_leave, "a release passes after leave");
}

/// SEAT-4c: an apply that is not confirmed in time is reported, and brake and gear are held.
#[kani::proof]
#[kani::unwind(17)]
#[kani::stub(supervisor_core::kernel::within_percent, crate::harness::uninterpreted::within_percent)]
#[kani::stub(supervisor_core::kernel::share_up, crate::harness::uninterpreted::share_up)]
#[kani::stub(supervisor_core::kernel::fallen, crate::harness::uninterpreted::fallen)]
#[kani::stub(supervisor_core::kernel::between_up, crate::harness::uninterpreted::between_up)]
fn seat_4c_unconfirmed_is_held() {
    let any = Any::new();
    let envelope = &any.decided.envelope;
    let outputs = Outputs {
        gear: vet_gear(envelope, any.commands.gear).0,
        brake: vet_brake(envelope, any.commands.brake).0,
        ..kani::any()
    };
    let cycle = any.cycle(&outputs);
    assert!(seat_4c_unconfirmed_is_held_and_reported(&cycle));
    let overdue = any.decided.state.parking.unconfirmed.reached(any.config.epb_confirm);
    kani::cover!(overdue && any.decided.state.seat.leave, "overdue in leave");
    kani::cover!(!overdue && outputs.gear == GearRequest::Neutral, "neutral passes");
}
