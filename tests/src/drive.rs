//! A drive in closed loop, [`crate::bench`]. And the open loop: the log of a drive through the same receiver and
//! supervisor.

use supervisor::wire::Receiver;
use supervisor::{
    Config, ConfigError, Decision, Millis, Outputs, Record, ResetCause, Sealed, Status, Supervisor, Verdicts,
};

use crate::bench::{Bench, Obeys};
use crate::driver::Script;
use crate::link::Stamped;
use crate::misdeed::{Misdeed, Misdeeds};
use crate::plant::{CYCLE_MS, Parameters, Truth};
use crate::road::Obstacle;

/// A drive: who does what, where.
#[derive(Clone, Copy, Debug)]
pub struct Scenario<'a> {
    /// File name without extension.
    pub name: &'a str,
    /// One line for people.
    pub title: &'a str,
    /// What happens.
    pub description: &'a str,
    /// Length in ms.
    pub length_ms: u32,
    /// The bus.
    pub parameters: Parameters,
    /// The driver.
    pub script: Script<'a>,
    /// What stands or moves ahead.
    pub road: &'a [Obstacle],
    /// What the main controller does wrong; nothing, and it is the correct one.
    pub misdeeds: &'a [Misdeed],
}

/// What the supervisor answered in one cycle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Answer {
    /// What went out to the bus.
    pub outputs: Outputs,
    /// Why.
    pub verdicts: Verdicts,
    /// Where the supervisor stood.
    pub status: Status,
}

impl From<Decision> for Answer {
    fn from(decision: Decision) -> Self {
        Self { outputs: decision.outputs, verdicts: decision.verdicts, status: decision.status }
    }
}

/// One cycle of a drive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cycle {
    /// Time of the drive, in ms.
    pub now_ms: u32,
    /// What was true when the supervisor decided.
    pub truth: Truth,
    /// What it decided.
    pub answer: Answer,
    /// The actuators hear the supervisor; else they have gone to their safe reaction.
    pub heard: bool,
}

/// A drive that was driven.
#[derive(Clone, Debug)]
pub struct Driven {
    /// Every cycle.
    pub cycles: Vec<Cycle>,
    /// Every frame of sensors and main controller.
    pub frames: Vec<Stamped>,
}

/// The supervisor of a log: default configuration, clean key-on.
fn supervisor() -> Result<Supervisor, ConfigError> {
    Ok(Supervisor::new(Sealed::from_default()?, ResetCause::PowerOn, Some(Record::None)))
}

/// Drives it: the bus obeys the supervisor.
///
/// # Errors
/// If the default configuration is refused.
pub fn run(scenario: &Scenario) -> Result<Driven, ConfigError> {
    closed_loop(scenario, Obeys::Supervisor)
}

/// Drives it without protection: the bus obeys the main controller, the supervisor only watches. Shows what the
/// misdeeds would have done.
///
/// # Errors
/// If the default configuration is refused.
pub fn run_unprotected(scenario: &Scenario) -> Result<Driven, ConfigError> {
    closed_loop(scenario, Obeys::Controller)
}

fn closed_loop(scenario: &Scenario, obeys: Obeys) -> Result<Driven, ConfigError> {
    let mut bench = Bench::new(scenario)?.obeying(obeys).with_log();
    let mut misdeeds = Misdeeds::new(scenario.misdeeds);
    let cycles = (CYCLE_MS..=scenario.length_ms).step_by(10).map(|_| bench.step(&mut misdeeds)).collect();
    Ok(Driven { cycles, frames: bench.into_log() })
}

/// The supervisor's answers to a log: a step at every multiple of 10 ms up to `length_ms`, each after every frame
/// with an earlier stamp.
///
/// # Errors
/// If the default configuration is refused.
pub fn replay(frames: &[Stamped], length_ms: u32) -> Result<Vec<Answer>, ConfigError> {
    let mut supervisor = supervisor()?;
    let mut receiver = Receiver::new(&Config::DEFAULT);
    let mut frames = frames.iter().peekable();
    let mut answers = Vec::new();
    for now_ms in (CYCLE_MS..=length_ms).step_by(10) {
        while let Some(stamped) = frames.next_if(|stamped| stamped.micros < u64::from(now_ms) * 1000) {
            let _ = receiver.accept(stamped.millis(), &stamped.frame);
        }
        let now = Millis::new(now_ms);
        let sample = receiver.sample(now);
        answers.push(supervisor.step(now, sample.inputs, sample.scene, sample.commands).into());
    }
    Ok(answers)
}
