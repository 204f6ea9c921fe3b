//! Kani harnesses. Names begin with the requirement; each ends in covers that show it is not vacuous.

mod configured;
mod cycle;
mod kernel;
mod vetting;

use supervisor_core::{Config, Decided, Inputs, Millis, Outputs, Response, State, Threat, decide};

use crate::properties::Cycle;

/// Any cycle: the shipped `decide` on any state, time, inputs, threat, response and configuration.
struct Any {
    old: State,
    now: Millis,
    inputs: Inputs,
    response: Response,
    decided: Decided,
    config: Config,
}

impl Any {
    fn new() -> Self {
        let (old, now, inputs, threat): (State, Millis, Inputs, Threat) =
            (kani::any(), kani::any(), kani::any(), kani::any());
        let (response, config): (Response, Config) = (kani::any(), kani::any());
        let decided = decide(&old, now, &inputs, &threat, &response, &config);
        Self { old, now, inputs, response, decided, config }
    }
    /// The cycle with these outputs.
    fn cycle<'a>(&'a self, outputs: &'a Outputs) -> Cycle<'a> {
        Cycle {
            old: &self.old,
            new: &self.decided.state,
            now: self.now,
            inputs: &self.inputs,
            response: &self.response,
            envelope: &self.decided.envelope,
            outputs,
            config: &self.config,
        }
    }
}
