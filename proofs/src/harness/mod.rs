//! Kani harnesses. Names begin with the requirement; each ends in covers that show it is not vacuous.

mod brake;
mod cap;
mod channels;
mod clock;
mod command;
mod configured;
mod drive;
mod flow;
mod frame;
mod fusion;
mod gear;
mod high_voltage;
mod leave;
mod mitigation;
mod mode;
mod object;
mod parking;
mod qualifier;
mod recovery;
mod response;
mod road;
mod rules;
mod seat;
mod steering;
mod supervisor;
mod uninterpreted;
mod vetting;

use supervisor_core::{Commands, Config, Decided, Inputs, Millis, Outputs, Response, State, Threat, decide, record};

use crate::properties::Cycle;

/// Any cycle: the shipped `decide` on any state, time, inputs, threat, response and configuration.
struct Any {
    old: State,
    now: Millis,
    inputs: Inputs,
    threat: Threat,
    response: Response,
    commands: Commands,
    config: Config,
    decided: Decided,
    /// What `record` makes of it: any state, unless the harness records.
    next: State,
}

impl Any {
    fn new() -> Self {
        let (old, now, inputs, threat): (State, Millis, Inputs, Threat) =
            (kani::any(), kani::any(), kani::any(), kani::any());
        let (response, config): (Response, Config) = (kani::any(), kani::any());
        let decided = decide(&old, now, &inputs, &threat, &response, &config);
        let (commands, next) = (kani::any(), kani::any());
        Self { old, now, inputs, threat, response, commands, config, decided, next }
    }
    /// Records these outputs as `step` does.
    fn record(&mut self, outputs: &Outputs) {
        self.next = record(&self.decided, outputs, &self.commands, &self.config);
    }
    /// The cycle with these outputs.
    fn cycle<'a>(&'a self, outputs: &'a Outputs) -> Cycle<'a> {
        Cycle {
            old: &self.old,
            now: self.now,
            inputs: &self.inputs,
            threat: &self.threat,
            response: &self.response,
            commands: &self.commands,
            config: &self.config,
            new: &self.decided.state,
            envelope: &self.decided.envelope,
            faults: self.decided.faults,
            outputs,
            next: &self.next,
            agreed: crate::properties::facts::agreed_speeds(&self.inputs, &self.config),
        }
    }
}
