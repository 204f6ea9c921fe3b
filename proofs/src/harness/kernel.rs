//! The supervisor itself: state at rest, boot, safe state.
use supervisor_core::{
    Commands, EpbRequest, Inputs, Millis, Percent, Record, ResetCause, STATE_WORDS, Sealed, State, StateImage, Threat,
    record, step, vet,
};

use super::Any;
use crate::properties::self_9_boot;

/// SELF-5: what is put to rest comes back.
#[kani::proof]
#[kani::unwind(80)]
fn self_5_state_at_rest_comes_back() {
    let state: State = kani::any();
    assert!(StateImage::encode(&state).decode() == Some(state));
}

/// SELF-5: any single flipped bit is detected.
#[kani::proof]
#[kani::unwind(160)]
fn self_5_flipped_bit_is_detected() {
    let state: State = kani::any();
    let (index, bit): (usize, u32) = (kani::any(), kani::any());
    kani::assume(index < 2 * STATE_WORDS && bit < 32);
    assert!(StateImage::encode(&state).with_flipped_bit(index, bit).decode().is_none());
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

/// SELF-5, SEAT-2, SEAT-3, SEAT-6, MIT-5: the safe state, and the obligations that no command weakens.
#[kani::proof]
#[kani::unwind(17)]
fn self_5_safe_state_and_obligations() {
    let any = Any::new();
    let commands: Commands = kani::any();
    let (outputs, _) = vet(&any.decided.envelope, &commands);
    let cycle = any.cycle(&outputs);
    assert!(cycle.self_5_safe_state());
    assert!(cycle.self_5_latched());
    assert!(cycle.no_torque_under_obligation());
    assert!(cycle.seat_6_neutral());
    assert!(cycle.brake_never_below_obligation());
    let next = record(&any.decided, &outputs, &commands, &any.config);
    assert!(
        next.parking.by_leave == (any.decided.state.parking.by_leave && outputs.epb.request != EpbRequest::Release)
    );
    kani::cover!(next.is_safe_state(), "the safe state");
    kani::cover!(any.decided.state.mitigation.three && !next.is_safe_state(), "level 3");
    kani::cover!(outputs.drive.torque > Percent::ZERO, "torque passes");
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
