//! The supervisor itself: state at rest, boot, safe state, record (SELF).

use supervisor_core::{
    Commands, Decided, EpbRequest, Outputs, Percent, Record, ResetCause, STATE_WORDS, State, StateImage, decide,
    record, vet, vet_brake, vet_contactors, vet_drive, vet_epb, vet_gear, vet_mode, vet_steering, vet_warnings,
};

use super::Any;
use crate::properties::boot::{self_9_boot, self_9_boot_exactly, self_9_record_survives};
use crate::properties::drive::no_torque_under_obligation;
use crate::properties::gear::seat_6_neutral;
use crate::properties::high_voltage::self_7_contactor_fault_closes_nothing;
use crate::properties::supervisor::{
    self_5_brake_in_the_safe_state, self_5_request_passes_in_the_safe_state, self_5_safe_state,
    self_5_steering_in_the_safe_state, self_6_flow_fault_is_the_safe_state, self_7_latched,
    self_7_quiet_counts_real_time,
};

/// SELF-5: any single flipped bit of any intact image is detected; what is not intact does not decode.
#[kani::proof]
#[kani::unwind(140)]
fn self_5_flipped_bit_is_detected() {
    let image: StateImage = kani::any();
    let (index, bit): (usize, u32) = (kani::any(), kani::any());
    kani::assume(index < 2 * STATE_WORDS && bit < 32 && image.intact());
    assert!(!image.with_flipped_bit(index, bit).intact());
    kani::cover!(index == 2 * STATE_WORDS - 1 && bit == 31, "the last bit too");
}

/// SELF-9: base of every induction.
#[kani::proof]
fn self_9_boot_leaves_nothing_permitted() {
    let (cause, persisted): (ResetCause, Option<Record>) = (kani::any(), kani::any());
    let state = State::boot(cause, persisted);
    assert!(self_9_boot(&state, persisted));
    assert!(self_9_boot_exactly(&state, cause, persisted));
    assert!(self_9_record_survives(&kani::any(), cause));
    kani::cover!(state.parking.by_leave, "a record parks by leave");
}

/// SELF-5, SEAT-2, SEAT-6, MIT-5: the safe state; no torque and no gear against an obligation.
#[kani::proof]
#[kani::unwind(17)]
fn self_5_safe_state_and_no_torque() {
    let any = Any::new();
    let envelope = &any.decided.envelope;
    let others: Outputs = kani::any();
    let outputs = Outputs {
        gear: vet_gear(envelope, kani::any()).0,
        drive: vet_drive(envelope, kani::any(), kani::any(), kani::any(), kani::any()).0,
        epb: vet_epb(envelope, kani::any()).0,
        contactors: vet_contactors(envelope, kani::any(), kani::any()).0,
        warnings: vet_warnings(envelope, kani::any()).0,
        mode: vet_mode(envelope, kani::any()).0,
        ..others
    };
    let cycle = any.cycle(&outputs);
    assert!(self_5_safe_state(&cycle));
    assert!(self_7_latched(&cycle));
    assert!(self_7_quiet_counts_real_time(&cycle));
    assert!(self_6_flow_fault_is_the_safe_state(&cycle));
    assert!(self_7_contactor_fault_closes_nothing(&cycle));
    assert!(no_torque_under_obligation(&cycle));
    assert!(seat_6_neutral(&cycle));
    kani::cover!(any.decided.state.is_safe_state(), "the safe state");
    kani::cover!(any.old.is_safe_state() && !any.decided.state.is_safe_state(), "the safe state ends by a key cycle");
    kani::cover!(outputs.drive.torque > Percent::ZERO, "torque passes");
}

/// SELF-1, SEAT-4: `record` is total after any decision, and only a release that went out clears *parked by leave*. With `decide`, every
/// `vet_*` and the state image this is the whole of `step`.
#[kani::proof]
#[kani::unwind(17)]
fn seat_4_record_is_total_and_keeps_the_latch() {
    let (decided, outputs, commands): (Decided, Outputs, Commands) = (kani::any(), kani::any(), kani::any());
    let next = record(&decided, &outputs, &commands, &kani::any());
    let (state, released) = (&decided.state, outputs.epb.request == EpbRequest::Release);
    assert!(next.parking.by_leave == (state.parking.by_leave && !released));
    assert!(next.latches == state.latches);
    assert!(next.high_voltage == state.high_voltage && next.seat == state.seat);
    kani::cover!(next.parking.by_leave, "parked by leave stays");
    kani::cover!(state.parking.by_leave && released, "a release ends it");
}

/// SELF-5d, SELF-5g: how the safe state brakes, and that steering fades.
#[kani::proof]
#[kani::unwind(17)]
#[kani::stub(supervisor_core::kernel::within_percent, crate::harness::uninterpreted::within_percent)]
#[kani::stub(supervisor_core::kernel::portion, crate::harness::uninterpreted::portion)]
#[kani::stub(supervisor_core::kernel::share_up, crate::harness::uninterpreted::share_up)]
#[kani::stub(supervisor_core::kernel::fallen, crate::harness::uninterpreted::fallen)]
#[kani::stub(supervisor_core::kernel::between_up, crate::harness::uninterpreted::between_up)]
fn self_5_safe_state_brakes_and_fades() {
    let any = Any::new();
    let envelope = &any.decided.envelope;
    let outputs = Outputs {
        brake: vet_brake(envelope, any.commands.brake).0,
        steering: vet_steering(envelope, any.commands.steering).0,
        ..kani::any()
    };
    let cycle = any.cycle(&outputs);
    assert!(self_5_brake_in_the_safe_state(&cycle));
    assert!(self_5_request_passes_in_the_safe_state(&cycle));
    assert!(self_5_steering_in_the_safe_state(&cycle));
    let safe = cycle.safe_state();
    kani::cover!(
        safe && cycle.vacant() && !any.decided.state.seat.leave && cycle.known_speeds().is_some(),
        "empty seat"
    );
    kani::cover!(safe && outputs.steering.weight > Percent::ZERO, "steering fades");
    kani::cover!(safe && outputs.brake.total > envelope.brake.floor.most, "a request brakes more than is obliged");
}
