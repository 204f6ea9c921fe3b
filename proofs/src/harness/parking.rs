//! The parking brake (SEAT-4, SEAT-5).

use supervisor_core::{EpbRequest, Outputs, vet_epb};

use super::Any;
use crate::properties::parking::{
    seat_4_apply_in_leave, seat_4_latch_holds, seat_5_pedal_chain_is_honest, seat_5_release_after_leave_needs_all,
    seat_5a_no_release_without_confirmed_seat,
};
use crate::properties::seat::seat_5_confirmation_counts_real_time;

impl Any {
    /// The parking brake as vetted, any command.
    pub(super) fn parking(&self) -> Outputs {
        let (epb, _) = vet_epb(&self.decided.envelope, kani::any());
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
