//! Kani harnesses. Names begin with the requirement; each ends in covers that show it is not vacuous.

mod cycle;
mod kernel;
mod vetting;

use supervisor_core::{Config, Decided, Inputs, Millis, Outputs, State, Threat, decide};

use crate::properties::Cycle;

/// Any cycle: the shipped `decide` on any state, time, inputs, threat and configuration.
struct Any {
    old: State,
    now: Millis,
    inputs: Inputs,
    decided: Decided,
    config: Config,
}

impl Any {
    fn new() -> Self {
        let (old, now, inputs, threat): (State, Millis, Inputs, Threat) =
            (kani::any(), kani::any(), kani::any(), kani::any());
        let config: Config = kani::any();
        let decided = decide(&old, now, &inputs, &threat, &config);
        Self { old, now, inputs, decided, config }
    }
    /// The cycle with these outputs.
    fn cycle<'a>(&'a self, outputs: &'a Outputs) -> Cycle<'a> {
        Cycle {
            old: &self.old,
            new: &self.decided.state,
            now: self.now,
            inputs: &self.inputs,
            envelope: &self.decided.envelope,
            outputs,
            config: &self.config,
        }
    }
}
