//! What each target does with its bytes. `cargo fuzz` runs it for as long as it likes; `tests/tests/corpus.rs` runs the same
//! functions over the committed corpus, on a stable compiler.

mod differential;
mod reached;
mod stream;
mod wire;

pub use differential::differential;
pub use reached::Reached;
pub use stream::command_stream;
pub use wire::wire_bytes;

use crate::common::{Commands, Decision, Inputs, Millis, Scene, Sealed, State, perceive, vet};
use supervisor_proofs::properties::Witness;

/// Judges one cycle that really ran: every property of `proofs/src/properties` holds of it, what went out is what `decide` and
/// `vet` give, and vetting it again changes nothing.
///
/// # Panics
/// With the name of the property that does not hold.
fn judge(
    old: Option<State>,
    now: u32,
    sealed: &Sealed,
    (inputs, scene, commands): (&Inputs, &Scene, &Commands),
    decision: &Decision,
) {
    assert!(decision.envelope.is_feasible(), "SELF-2d: no legal command is left");
    let (again, _) = vet(&decision.envelope, &decision.outputs.as_commands());
    assert_eq!(again, decision.outputs, "SELF-2c: vetting an output changes nothing");
    let (Some(old), Some(config)) = (old, sealed.intact()) else { return };
    let witness = Witness::of(old, Millis::new(now), inputs, &perceive(scene, config), commands, config);
    assert_eq!(witness.broken(), None);
    assert_eq!((witness.outputs, witness.verdicts), (decision.outputs, decision.verdicts));
}
