//! What is recorded of a drive, and how a drive is shown to people.

use crate::common::named::{self, Named};
use crate::common::*;
use std::fmt::Write;

/// One cycle: what the supervisor was given, and what it gave.
#[derive(Clone, Debug)]
pub struct Cycle {
    pub now: u32,
    pub inputs: Inputs,
    pub radar: Vec<RadarObject>,
    pub camera: Vec<CameraObject>,
    pub radar_known: bool,
    pub camera_known: bool,
    pub commands: Commands,
    pub outputs: Outputs,
    /// What the supervisor says of the cycle: for reports of what a drive reaches. No claim reads it.
    pub said: (Status, Verdicts),
}

/// Every cycle since the reset.
#[derive(Clone, Debug)]
pub struct Trace {
    /// The reset was a power-on, with a valid and empty record.
    pub clean: bool,
    pub cycles: Vec<Cycle>,
}

/// A bus whose every step since the reset is recorded.
#[derive(Clone, Debug)]
pub struct Recorder {
    pub bus: Bus,
    pub trace: Trace,
}

impl Cycle {
    /// Both sensors deliver.
    pub fn sensors_known(&self) -> bool {
        self.radar_known && self.camera_known
    }
}

impl Recorder {
    /// After a reset.
    pub fn boot(cause: ResetCause, record: Option<Record>, inputs: Inputs) -> Self {
        let clean = cause == ResetCause::PowerOn && record == Some(Record::None);
        Self { bus: Bus::boot(cause, record, inputs), trace: Trace { clean, cycles: Vec::new() } }
    }
    /// One cycle after this many milliseconds.
    pub fn step_by(&mut self, elapsed: u32) {
        let Scene { radar, camera, .. } = &self.bus.scene;
        let (radar, camera) = (radar.iter().copied().collect(), camera.iter().copied().collect());
        let Scene { radar_known, camera_known, .. } = self.bus.scene;
        let (inputs, commands) = (self.bus.inputs, self.bus.commands);
        let decision = self.bus.step_unjudged(elapsed);
        self.trace.cycles.push(Cycle {
            now: self.bus.now,
            inputs,
            radar,
            camera,
            radar_known,
            camera_known,
            commands,
            outputs: decision.outputs,
            said: (decision.status, decision.verdicts),
        });
    }
    /// One cycle.
    pub fn step(&mut self) {
        self.step_by(CYCLE);
    }
    /// Cycles of `cycle` for `span`.
    pub fn run(&mut self, span: u32, cycle: u32) {
        for _ in 0..span / cycle {
            self.step_by(cycle);
        }
    }
}

/// What the cycle reads: the inputs, and what the sensors see.
fn reads(cycle: &Cycle) -> Named {
    let Cycle { radar, camera, radar_known, camera_known, .. } = cycle;
    let mut all = named::inputs(&cycle.inputs);
    all.push(("radar", format!("{radar:?}, known: {radar_known}")));
    all.push(("camera", format!("{camera:?}, known: {camera_known}")));
    all
}

/// The drive up to a cycle, readable: one line for each field that changes, with the time since the reset in ms and the step.
pub fn told(trace: &Trace, from: usize, until: usize) -> String {
    let mut text = String::new();
    let mut last: [Named; 3] = [Vec::new(), Vec::new(), Vec::new()];
    let mut time = 0_u32;
    for (at, cycle) in trace.cycles.iter().enumerate().take(until + 1) {
        let step = if at == 0 { 0 } else { cycle.now.wrapping_sub(trace.cycles[at - 1].now) };
        time = time.wrapping_add(step);
        if at + 1 < from {
            continue;
        }
        let now = [reads(cycle), named::commands(&cycle.commands), named::outputs(&cycle.outputs)];
        for ((group, now), last) in ["reads", "is asked", "GIVES"].iter().zip(&now).zip(&last) {
            for (index, (name, value)) in now.iter().enumerate() {
                if last.get(index).is_none_or(|(_, before)| before != value) {
                    // Writing to a string does not fail.
                    let _ignored = writeln!(text, "{time:>8} ms (+{step}) #{at} {group} {name} = {value}");
                }
            }
        }
        last = now;
    }
    text
}
