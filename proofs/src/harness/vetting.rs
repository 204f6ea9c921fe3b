//! Vetting against any feasible envelope, channel by channel; `decide` gives only feasible ones (second cut).
//!
//! `vet` calls these very functions in a fixed order, each with the outputs given so far. Here the given outputs are
//! *any*, so what is proved per channel holds for the whole vector.

use supervisor_core::{
    Bound, Command, Commands, Envelope, Kind, Millis, Percent, Verdict, vet_auxiliaries, vet_body, vet_brake,
    vet_contactors, vet_drive, vet_epb, vet_gear, vet_mode, vet_retarder, vet_steering, vet_target_speed, vet_warnings,
};

use super::Any;
use crate::properties::vetting::{
    self_2_brake_sound, self_2_contactors_sound, self_2_drive_sound, self_2_epb_sound, self_2_gear_sound,
    self_2_steering_sound, self_2_warnings_sound, went_unchanged,
};

/// Any feasible envelope.
pub(super) fn any_envelope() -> Envelope {
    let envelope: Envelope = kani::any();
    kani::assume(envelope.is_feasible());
    kani::cover!(envelope.brake.floor.most > supervisor_core::DecelMs2Q11::ZERO, "an envelope that obliges");
    envelope
}

/// Transparent and idempotent: pass exactly when unchanged; vetting the output changes nothing.
fn holds<T: Copy + PartialEq>(command: Command<T>, timeout: Millis, vetted: (T, Verdict), again: (T, Verdict)) {
    let (out, verdict) = vetted;
    assert!(verdict.passed() == went_unchanged(command, timeout, out));
    assert!(again.0 == out && again.1.passed());
    kani::cover!(verdict.passed(), "a command passes");
    kani::cover!(verdict.kind == Kind::Block || verdict.kind == Kind::Limit, "a command is refused or limited");
}

/// SELF-1, SELF-2, rule 4: `decide` is total, and every channel has a legal command.
#[kani::proof]
#[kani::unwind(17)]
fn self_1_decide_total_and_feasible() {
    let any = Any::new();
    assert!(any.decided.envelope.is_feasible());
    kani::cover!(any.decided.envelope.epb.obliged.is_some(), "something is obliged");
}

/// SELF-2: service brake.
#[kani::proof]
fn self_2_brake() {
    let (envelope, command) = (any_envelope(), kani::any());
    let vetted = vet_brake(&envelope, command);
    assert!(self_2_brake_sound(&envelope, &vetted.0));
    holds(command, envelope.timeouts.ms50, vetted, vet_brake(&envelope, Command::Fresh(vetted.0)));
}

/// SELF-2, RET-1: retarder, transparent and idempotent for any configuration.
#[kani::proof]
fn self_2_retarder() {
    let (envelope, command, most): (_, _, Bound<Percent>) = (any_envelope(), kani::any(), kani::any());
    let vetted = vet_retarder(&envelope, most, command);
    assert!(vetted.0.torque <= most.most);
    holds(command, envelope.timeouts.ms100, vetted, vet_retarder(&envelope, most, Command::Fresh(vetted.0)));
}

/// SELF-2, TRQ-6: drive torque.
#[kani::proof]
fn self_2_drive() {
    let (envelope, command, mode) = (any_envelope(), kani::any(), kani::any());
    let (gear, braking) = (kani::any(), kani::any());
    let vetted = vet_drive(&envelope, mode, gear, braking, command);
    assert!(self_2_drive_sound(&envelope, mode, gear, braking, &vetted.0));
    holds(command, envelope.timeouts.ms50, vetted, vet_drive(&envelope, mode, gear, braking, Command::Fresh(vetted.0)));
}

/// SELF-2, STR-1: steering.
#[kani::proof]
fn self_2_steering() {
    let (envelope, command) = (any_envelope(), kani::any());
    let vetted = vet_steering(&envelope, command);
    assert!(self_2_steering_sound(&envelope, &vetted.0));
    holds(command, envelope.timeouts.ms50, vetted, vet_steering(&envelope, Command::Fresh(vetted.0)));
}

/// SELF-2: gear, parking brake, contactors.
#[kani::proof]
fn self_2_gear_epb_contactors() {
    let (envelope, torque, commands): (_, Percent, Commands) = (any_envelope(), kani::any(), kani::any());
    let timeouts = envelope.timeouts;
    let gear = vet_gear(&envelope, commands.gear);
    assert!(self_2_gear_sound(&envelope, gear.0));
    holds(commands.gear, timeouts.ms100, gear, vet_gear(&envelope, Command::Fresh(gear.0)));
    let epb = vet_epb(&envelope, commands.epb);
    assert!(self_2_epb_sound(&envelope, &epb.0));
    holds(commands.epb, timeouts.ms200, epb, vet_epb(&envelope, Command::Fresh(epb.0)));
    let contactors = vet_contactors(&envelope, torque, commands.contactors);
    assert!(self_2_contactors_sound(&envelope, &contactors.0));
    let again = vet_contactors(&envelope, torque, Command::Fresh(contactors.0));
    holds(commands.contactors, timeouts.ms100, contactors, again);
}

/// SELF-2: target speed, auxiliaries, warnings, body, mode.
#[kani::proof]
fn self_2_other_channels() {
    let (envelope, braking, commands): (_, _, Commands) = (any_envelope(), kani::any(), kani::any());
    let given = kani::any();
    let timeouts = envelope.timeouts;
    let speed = vet_target_speed(&envelope, given, commands.target_speed);
    assert!(speed.0 <= envelope.target_speed.most);
    holds(commands.target_speed, timeouts.ms50, speed, vet_target_speed(&envelope, given, Command::Fresh(speed.0)));
    let auxiliaries = vet_auxiliaries(&envelope, commands.auxiliaries);
    let again = vet_auxiliaries(&envelope, Command::Fresh(auxiliaries.0));
    holds(commands.auxiliaries, timeouts.ms200, auxiliaries, again);
    let warnings = vet_warnings(&envelope, commands.warnings);
    assert!(self_2_warnings_sound(&envelope, &warnings.0));
    let again = vet_warnings(&envelope, Command::Fresh(warnings.0));
    assert!(warnings.1.passed() == went_unchanged(commands.warnings, timeouts.ms200, warnings.0));
    assert!(again.0 == warnings.0);
    let body = vet_body(&envelope, braking, commands.body);
    let again = vet_body(&envelope, braking, Command::Fresh(body.0));
    holds(commands.body, timeouts.ms200, body, again);
    let mode = vet_mode(&envelope, commands.mode);
    assert!(mode.0 == supervisor_core::DrivingMode::Manual || envelope.automated.is_ok());
    holds(commands.mode, timeouts.ms200, mode, vet_mode(&envelope, Command::Fresh(mode.0)));
}
