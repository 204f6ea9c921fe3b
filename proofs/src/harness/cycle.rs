//! Safety of one whole cycle: any state, inputs, threat, commands, valid configuration.

use supervisor_core::{ContactorRequest, EpbRequest, Stage};

use supervisor_core::{Outputs, vet_contactors, vet_drive, vet_epb};

use super::Any;

impl Any {
    /// The parking brake as vetted, any command.
    fn parking(&self) -> Outputs {
        let (epb, _) = vet_epb(&self.decided.envelope, kani::any());
        Outputs { epb, ..kani::any() }
    }
    /// The contactors as vetted, any command; the drive torque as vetted for them, whatever the other channels do.
    fn contactors(&self) -> Outputs {
        let others: Outputs = kani::any();
        let (drive, _) = vet_drive(&self.decided.envelope, kani::any(), others.gear, kani::any(), kani::any());
        let (contactors, _) = vet_contactors(&self.decided.envelope, drive.torque, kani::any());
        Outputs { contactors, drive, ..others }
    }
}

/// SEAT-5a.
#[kani::proof]
#[kani::unwind(17)]
fn seat_5_epb_never_released_without_confirmed_seat() {
    let any = Any::new();
    let outputs = any.parking();
    let cycle = any.cycle(&outputs);
    assert!(cycle.seat_5a_no_release_without_confirmed_seat());
    assert!(cycle.seat_5_confirmation_counts_real_time());
    assert!(cycle.seat_5_release_after_leave_needs_all());
    assert!(cycle.seat_5_pedal_chain_is_honest());
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
    assert!(cycle.seat_4_apply_in_leave());
    assert!(cycle.seat_4_latch_holds());
    kani::cover!(any.decided.state.seat.leave && outputs.epb.request == EpbRequest::Apply, "leave applies");
    kani::cover!(!any.old.parking.by_leave && any.decided.state.parking.by_leave, "the latch is set");
}

/// SEAT-7, SEAT-11, HV-1.
#[kani::proof]
#[kani::unwind(17)]
fn seat_7_k1_never_before_k4() {
    let any = Any::new();
    let outputs = any.contactors();
    let cycle = any.cycle(&outputs);
    assert!(cycle.seat_7_k1_after_k4());
    assert!(cycle.hv_1_k4_opens_without_load());
    assert!(cycle.seat_7_shutdown_happens());
    assert!(cycle.seat_7_k1_follows());
    assert!(cycle.seat_7_committed());
    assert!(cycle.seat_11_ten_minutes_are_real());
    let stage = any.decided.state.high_voltage.stage;
    kani::cover!(outputs.contactors.k1 == ContactorRequest::Open && stage == Stage::OpeningK1, "K1 opens after leave");
    kani::cover!(outputs.contactors.k1 == ContactorRequest::Open && stage == Stage::Up, "K1 opens at key-off");
    kani::cover!(outputs.contactors.k4 == ContactorRequest::Open && stage == Stage::OpeningK4, "K4 opens after leave");
    kani::cover!(any.old.high_voltage.stage == Stage::Up && stage == Stage::OpeningK4, "the shutdown begins");
}

/// SEAT-8, HV-1.
#[kani::proof]
#[kani::unwind(17)]
fn seat_8_high_voltage_only_by_restart() {
    let any = Any::new();
    let outputs = any.contactors();
    let cycle = any.cycle(&outputs);
    assert!(cycle.seat_8_close_needs_restart());
    assert!(cycle.seat_8_restart_in_order());
    kani::cover!(outputs.contactors.k1 == ContactorRequest::Close, "K1 closes");
    kani::cover!(outputs.contactors.k4 == ContactorRequest::Close, "K4 closes");
}
