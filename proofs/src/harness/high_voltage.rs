//! High voltage (SEAT-7, SEAT-8, SEAT-11, HV-1).

use supervisor_core::{ContactorRequest, Outputs, Stage, vet_contactors, vet_drive};

use super::Any;
use crate::properties::high_voltage::{
    hv_1_k4_opens_without_load, seat_7_committed, seat_7_k1_after_k4, seat_7_k1_follows, seat_7_shutdown_happens,
    seat_8_close_needs_restart, seat_8_restart_in_order, seat_11_ten_minutes_are_real,
};

impl Any {
    /// The contactors as vetted, any command; the drive torque as vetted for them, whatever the other channels do.
    pub(super) fn contactors(&self) -> Outputs {
        let others: Outputs = kani::any();
        let (drive, _) = vet_drive(&self.decided.envelope, kani::any(), others.gear, kani::any(), kani::any());
        let (contactors, _) = vet_contactors(&self.decided.envelope, drive.torque, kani::any());
        Outputs { contactors, drive, ..others }
    }
}

/// SEAT-7, SEAT-11, HV-1.
#[kani::proof]
#[kani::unwind(17)]
fn seat_7_k1_never_before_k4() {
    let any = Any::new();
    let outputs = any.contactors();
    let cycle = any.cycle(&outputs);
    assert!(seat_7_k1_after_k4(&cycle));
    assert!(hv_1_k4_opens_without_load(&cycle));
    assert!(seat_7_shutdown_happens(&cycle));
    assert!(seat_7_k1_follows(&cycle));
    assert!(seat_7_committed(&cycle));
    assert!(seat_11_ten_minutes_are_real(&cycle));
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
    assert!(seat_8_close_needs_restart(&cycle));
    assert!(seat_8_restart_in_order(&cycle));
    kani::cover!(outputs.contactors.k1 == ContactorRequest::Close, "K1 closes");
    kani::cover!(outputs.contactors.k4 == ContactorRequest::Close, "K4 closes");
}
