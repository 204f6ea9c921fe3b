//! Kani harnesses. Names begin with the requirement; each ends in covers that show it is not vacuous.

mod cycle;
mod kernel;
mod vetting;

use supervisor_core::{Commands, Config, Decided, Inputs, Millis, Outputs, State, Threat, decide, vet};

use crate::properties::Cycle;

/// Any cycle of the shipped decide and vet.
struct Any {
    old: State,
    now: Millis,
    inputs: Inputs,
    decided: Decided,
    outputs: Outputs,
    commands: Commands,
    config: Config,
}

impl Any {
    fn new() -> Self {
        let (old, now, inputs, threat): (State, Millis, Inputs, Threat) =
            (kani::any(), kani::any(), kani::any(), kani::any());
        let (commands, config): (Commands, Config) = (kani::any(), kani::any());
        let decided = decide(&old, now, &inputs, &threat, &config);
        let (outputs, _) = vet(&decided.envelope, &commands);
        Self { old, now, inputs, decided, outputs, commands, config }
    }
    fn cycle(&self) -> Cycle<'_> {
        Cycle {
            old: &self.old,
            new: &self.decided.state,
            now: self.now,
            inputs: &self.inputs,
            envelope: &self.decided.envelope,
            outputs: &self.outputs,
            config: &self.config,
        }
    }
}
