//! Vetting against any feasible envelope; `decide` gives only feasible ones.
use supervisor_core::{Channel, Commands, Envelope, Kind, vet};

use super::Any;
use crate::properties::{self_2_sound, self_2_transparent};

/// SELF-1, SELF-2, rule 4: decide is total, and every channel has a legal command.
#[kani::proof]
#[kani::unwind(17)]
fn self_1_decide_total_and_feasible() {
    let any = Any::new();
    assert!(any.decided.envelope.is_feasible());
    kani::cover!(any.decided.envelope.epb.obliged.is_some(), "something is obliged");
}

/// SELF-2: sound, transparent, idempotent, for any feasible envelope and any commands.
#[kani::proof]
#[kani::unwind(17)]
fn self_2_vet_sound_transparent_idempotent() {
    let envelope: Envelope = kani::any();
    let commands: Commands = kani::any();
    kani::assume(envelope.is_feasible());
    let (outputs, verdicts) = vet(&envelope, &commands);
    assert!(self_2_sound(&envelope, &outputs));
    assert!(self_2_transparent(&envelope, &commands, &outputs, &verdicts));
    let (again, verdicts_again) = vet(&envelope, &outputs.as_commands());
    assert!(again == outputs);
    assert!(verdicts_again.iter().all(|(_, verdict)| verdict.passed()));
    kani::cover!(verdicts.of(Channel::ServiceBrake).kind == Kind::Pass, "a brake command passes");
    kani::cover!(verdicts.of(Channel::ServiceBrake).kind == Kind::Substitute, "a brake command is substituted");
}
