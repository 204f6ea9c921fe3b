//! High voltage (SEAT-7, SEAT-8, SEAT-11, HV-1).

use supervisor_core::{ContactorRequest, Contactors, Outputs, Pending, Percent, Restart, Stage, vet_contactors};

use super::Any;
use crate::properties::high_voltage::{
    hv_1_k4_opens_without_load, rule_4_guard_lost_waits, seat_7_committed, seat_7_deadlines, seat_7_k1_after_k4,
    seat_7_k1_follows, seat_7_k4_opens_with_parking_brake, seat_7_sequence_stays_owed, seat_7_shutdown_happens,
    seat_7_stages_exactly, seat_8_close_needs_restart, seat_8_restart_in_order, seat_11_ten_minutes_are_real,
    seat_11_ten_minutes_exactly, self_9_clean_key_on, self_11_contactors_pass,
};

impl Any {
    /// The contactors as vetted, any command, beside any torque that may go out: none while a shutdown runs
    /// (`trq_1_bounds_of_the_torque`, `self_11_torque_up_to_its_bounds`).
    pub(super) fn contactors(&self) -> Outputs {
        let others: Outputs = kani::any();
        kani::assume(self.decided.state.high_voltage.stage == Stage::Up || others.drive.torque == Percent::ZERO);
        let (contactors, _) = vet_contactors(&self.decided.envelope, others.drive.torque, self.commands.contactors);
        Outputs { contactors, ..others }
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

/// SEAT-7, SEAT-8, SEAT-9b, SEAT-11, SELF-9b: stages, deadlines, the ten minutes and the restart, exactly.
#[kani::proof]
#[kani::unwind(17)]
#[kani::stub(supervisor_core::kernel::within_percent, crate::harness::uninterpreted::within_percent)]
fn seat_7_high_voltage_exactly() {
    let any = Any::new();
    let outputs = kani::any();
    let cycle = any.cycle(&outputs);
    assert!(seat_7_stages_exactly(&cycle));
    assert!(seat_7_deadlines(&cycle));
    assert!(seat_11_ten_minutes_exactly(&cycle));
    assert!(self_9_clean_key_on(&cycle));
    let (old, new) = (&any.old.high_voltage, &any.decided.state.high_voltage);
    kani::cover!(old.stage == Stage::Up && new.stage == Stage::OpeningK4, "the shutdown begins");
    kani::cover!(old.stage == Stage::Down && new.stage == Stage::Up, "high voltage may come again");
    kani::cover!(old.stage == Stage::Down && new.stage == Stage::OpeningK4, "what came back by itself is opened again");
    kani::cover!(new.parked > old.parked && !cycle.vacant(), "an unknown seat lets the ten minutes continue");
    kani::cover!(any.old.boot.pending == Pending::Clean && new.restart == Restart::OffSeen, "a clean key-on");
}

/// SEAT-7, RULE-4b, SELF-11h: what is owed goes out and waits for its guards, and what is in order passes.
#[kani::proof]
#[kani::unwind(17)]
#[kani::stub(supervisor_core::kernel::within_percent, crate::harness::uninterpreted::within_percent)]
fn seat_7_contactors_exactly() {
    let any = Any::new();
    let outputs = any.contactors();
    let cycle = any.cycle(&outputs);
    assert!(seat_7_k4_opens_with_parking_brake(&cycle));
    assert!(seat_7_sequence_stays_owed(&cycle));
    assert!(rule_4_guard_lost_waits(&cycle));
    assert!(self_11_contactors_pass(&cycle));
    let new = &any.decided.state.high_voltage;
    let k4 = outputs.contactors.k4 == ContactorRequest::Open;
    kani::cover!(k4 && new.wait.reached(any.config.k4_deadline), "K4 stays commanded after its deadline");
    kani::cover!(new.stage == Stage::OpeningK4 && outputs.contactors == Contactors::NEUTRAL, "it waits");
    kani::cover!(k4 && new.stage == Stage::Up, "K4 opens on request");
}
