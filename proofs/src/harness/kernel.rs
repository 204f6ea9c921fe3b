//! The supervisor itself: state at rest, boot, safe state.
use supervisor_core::{
    Commands, Inputs, Millis, Outputs, Percent, Record, ResetCause, STATE_WORDS, Sealed, State, StateImage, Threat,
    step, vet_brake, vet_contactors, vet_drive, vet_epb, vet_gear, vet_mode, vet_warnings,
};

use super::Any;
use crate::properties::self_9_boot;

/// SELF-5: what is put to rest comes back.
#[kani::proof]
#[kani::unwind(90)]
fn self_5_state_at_rest_comes_back() {
    let state: State = kani::any();
    assert!(StateImage::encode(&state).decode() == Some(state));
}

/// SELF-5: any single flipped bit of any intact image is detected; what is not intact does not decode.
#[kani::proof]
#[kani::unwind(90)]
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
    assert!(cycle.self_5_safe_state());
    assert!(cycle.self_5_latched());
    assert!(cycle.no_torque_under_obligation());
    assert!(cycle.seat_6_neutral());
    kani::cover!(any.decided.state.is_safe_state(), "the safe state");
    kani::cover!(outputs.drive.torque > Percent::ZERO, "torque passes");
}

/// SEAT-3, MIT-1 to MIT-4: the service brake is never below an obligation, whatever the command.
#[kani::proof]
#[kani::unwind(17)]
fn mit_4_brake_never_below_obligation() {
    let any = Any::new();
    let outputs = Outputs { brake: vet_brake(&any.decided.envelope, kani::any()).0, ..kani::any() };
    assert!(any.cycle(&outputs).brake_never_below_obligation());
    kani::cover!(any.decided.state.mitigation.three, "level 3");
    kani::cover!(any.decided.state.seat.leave, "leave");
}

/// SELF-1: the whole shipped step, any image bytes: total.
#[kani::proof]
#[kani::unwind(160)]
fn self_1_step_is_total() {
    let mut image: StateImage = kani::any();
    let sealed: Sealed = kani::any();
    let (now, inputs, threat, commands): (Millis, Inputs, Threat, Commands) =
        (kani::any(), kani::any(), kani::any(), kani::any());
    let decision = step(&mut image, &sealed, now, &inputs, &threat, &commands);
    assert!(image.decode().is_some());
    kani::cover!(decision.status.safe_state, "the safe state");
}
