//! Safety of one whole cycle: any state, inputs, threat, commands, valid configuration.

use supervisor_core::{ContactorRequest, EpbRequest, Stage};

use super::Any;

/// SEAT-5a.
#[kani::proof]
#[kani::unwind(17)]
fn seat_5_epb_never_released_without_confirmed_seat() {
    let any = Any::new();
    let cycle = any.cycle();
    assert!(cycle.seat_5a_no_release_without_confirmed_seat());
    assert!(cycle.seat_5_confirmation_counts_real_time());
    assert!(cycle.seat_5_release_after_leave_needs_all());
    assert!(cycle.seat_5_pedal_chain_is_honest());
    kani::cover!(any.outputs.epb.request == EpbRequest::Release, "a release passes");
    kani::cover!(
        any.outputs.epb.request == EpbRequest::Release && any.old.parking.by_leave,
        "a release after leave passes"
    );
}

/// SEAT-4.
#[kani::proof]
#[kani::unwind(17)]
fn seat_4_epb_applied_in_leave() {
    let any = Any::new();
    let cycle = any.cycle();
    assert!(cycle.seat_4_apply_in_leave());
    assert!(cycle.seat_4_latch_holds());
    kani::cover!(any.decided.state.seat.leave && any.outputs.epb.request == EpbRequest::Apply, "leave applies");
    kani::cover!(!any.old.parking.by_leave && any.decided.state.parking.by_leave, "the latch is set");
}

/// SEAT-7, SEAT-11, HV-1.
#[kani::proof]
#[kani::unwind(17)]
fn seat_7_k1_never_before_k4() {
    let any = Any::new();
    let cycle = any.cycle();
    assert!(cycle.seat_7_k1_after_k4());
    assert!(cycle.hv_1_k4_opens_without_load());
    assert!(cycle.seat_7_shutdown_happens());
    assert!(cycle.seat_7_k1_follows());
    assert!(cycle.seat_7_committed());
    assert!(cycle.seat_11_ten_minutes_are_real());
    let stage = any.decided.state.high_voltage.stage;
    kani::cover!(
        any.outputs.contactors.k1 == ContactorRequest::Open && stage == Stage::OpeningK1,
        "K1 opens after leave"
    );
    kani::cover!(any.outputs.contactors.k1 == ContactorRequest::Open && stage == Stage::Up, "K1 opens at key-off");
    kani::cover!(
        any.outputs.contactors.k4 == ContactorRequest::Open && stage == Stage::OpeningK4,
        "K4 opens after leave"
    );
    kani::cover!(any.old.high_voltage.stage == Stage::Up && stage == Stage::OpeningK4, "the shutdown begins");
}

/// SEAT-8, HV-1.
#[kani::proof]
#[kani::unwind(17)]
fn seat_8_high_voltage_only_by_restart() {
    let any = Any::new();
    let cycle = any.cycle();
    assert!(cycle.seat_8_close_needs_restart());
    assert!(cycle.seat_8_restart_in_order());
    kani::cover!(any.outputs.contactors.k1 == ContactorRequest::Close, "K1 closes");
    kani::cover!(any.outputs.contactors.k4 == ContactorRequest::Close, "K4 closes");
}
