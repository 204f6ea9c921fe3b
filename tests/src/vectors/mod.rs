//! Golden vectors: what goes in and what was decided, cycle by cycle, for whoever has the supervisor in another language.
//!
//! A vector is a start (reset cause, persisted record, default configuration) and a list of cycles: the frames that came
//! before it, each with its time, and the time of the step. [`run`] gives for each cycle the commands as they were read,
//! everything that was decided, and the frames that were sent. [`digest`](digest::digest) makes one number of a cycle;
//! two implementations whose digests agree have decided and sent the same to the bit.
//!
//! The five shipped drives and the sets of [`boundary`] are vectors; [`files`] writes them.

pub mod boundary;
pub mod columns;
pub mod digest;
pub mod files;

use supervisor::wire::{Frame, Receiver, Sender};
use supervisor::{Commands, ConfigError, Decision, Millis, Record, ResetCause, Sealed, Supervisor};

use crate::link::Stamped;
use crate::plant::CYCLE_MS;

/// What comes in before one step, and when it steps.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Read {
    /// Time of the step, in ms.
    pub now_ms: u32,
    /// The frames since the step before, with the time of each in ms.
    pub frames: Vec<(u32, Frame)>,
}

/// A start, and what comes in.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Vector {
    /// Name of its files.
    pub name: String,
    /// Why it starts.
    pub cause: ResetCause,
    /// What was persisted; `None` when it fails its CRC.
    pub record: Option<Record>,
    /// The cycles.
    pub cycles: Vec<Read>,
}

impl Vector {
    /// A drive: a step at every multiple of 10 ms, each after every frame with an earlier stamp.
    #[must_use]
    pub fn of_drive(name: &str, frames: &[Stamped], length_ms: u32) -> Self {
        let mut frames = frames.iter().peekable();
        let mut cycles = Vec::new();
        for now_ms in (CYCLE_MS..=length_ms).step_by(10) {
            let mut came = Vec::new();
            while let Some(stamped) = frames.next_if(|stamped| stamped.micros < u64::from(now_ms) * 1000) {
                came.push((stamped.millis().raw(), stamped.frame));
            }
            cycles.push(Read { now_ms, frames: came });
        }
        Self { name: name.to_owned(), cause: ResetCause::PowerOn, record: Some(Record::None), cycles }
    }
}

/// What one cycle made of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Made {
    /// The commands as they reached the vetting.
    pub commands: Commands,
    /// Everything that was decided.
    pub decision: Decision,
    /// The frames that were sent, in order.
    pub sent: Vec<Frame>,
}

/// Runs a vector through the Rust interface and gives every cycle to `each`.
///
/// # Errors
/// If the default configuration is refused, or whatever `each` gives.
pub fn run<E: From<ConfigError>>(
    vector: &Vector,
    mut each: impl FnMut(&Read, &Made) -> Result<(), E>,
) -> Result<(), E> {
    let mut supervisor = Supervisor::new(Sealed::from_default()?, vector.cause, vector.record);
    let (mut receiver, mut sender) = (Receiver::new(supervisor.config()), Sender::new());
    for read in &vector.cycles {
        for (at_ms, frame) in &read.frames {
            // A refusal shows in the commands and inputs.
            let _ = receiver.accept(Millis::new(*at_ms), frame);
        }
        let (now, mut sent) = (Millis::new(read.now_ms), Vec::new());
        let sample = receiver.sample(now);
        let decision = supervisor.step(now, sample.inputs, sample.scene, sample.commands);
        let commands = *sample.commands;
        sender.encode_outputs(now, &decision.outputs, &mut |frame| sent.push(frame));
        sender.encode_status(now, &decision.status, &mut |frame| sent.push(frame));
        each(read, &Made { commands, decision, sent })?;
    }
    Ok(())
}
