//! What the tests of the report share: a decision to change, and a receiver of DM1 that knows nothing of the sender.
#![allow(dead_code, reason = "each test file uses its part")]

use supervisor_core::{
    Commands, ConfigError, Decision, Faults, Flow, Inputs, Millis, Outputs, Record, ResetCause, Sealed, State,
    StateImage, Threat, step,
};
use supervisor_report::{BodyFaults, DEBOUNCE, FaultReport, HEAL};

/// The outcome of a test.
pub type Outcome = Result<(), ConfigError>;

/// A decision of the shipped step, with its faults taken out and its outputs asking for nothing.
pub fn quiet() -> Result<Decision, ConfigError> {
    let mut image = StateImage::encode(&State::boot(ResetCause::PowerOn, Some(Record::None)));
    let sealed = Sealed::from_default()?;
    let mut decision =
        step(&mut image, &sealed, Flow::PERCEIVED, Millis::new(0), &Inputs::NEVER, &Threat::UNKNOWN, &Commands::ABSENT);
    (decision.status.faults, decision.outputs) = (Faults::NONE, Outputs::NEUTRAL);
    Ok(decision)
}

/// The same decision with these faults.
pub fn with(decision: &Decision, faults: Faults) -> Decision {
    let mut decision = *decision;
    decision.status.faults = faults;
    decision
}

/// The shipped report, long after power-on.
pub fn settled() -> FaultReport {
    FaultReport::new(Millis::ZERO, DEBOUNCE, HEAL)
}

/// Observes a decision every 10 ms from `from` (included) to `to` (excluded).
pub fn observe(report: &mut FaultReport, decision: &Decision, from: u32, to: u32) {
    for now in (from..to).step_by(10) {
        report.observe(Millis::new(now), decision, BodyFaults::NONE);
    }
}
