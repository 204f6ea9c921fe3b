//! The CAN link: sensors and main controller on one side, the supervisor's receiver on the other.
//!
//! Cycle k of the supervisor is at k · 10 ms; the frames that it is the first to see carry stamps from 1 ms after
//! cycle k − 1 on, 0.1 ms apart. A replay that steps at every multiple of 10 ms, first taking every frame with an
//! earlier stamp, sees exactly what the closed loop saw: [`crate::drive::replay`].

use supervisor::wire::{Frame, Receiver, Sample, Sender};
use supervisor::{Commands, Config, Inputs, Millis, Scene};

use crate::bench::{Hooks, Node};
use crate::plant::CYCLE_MS;

/// First stamp of a cycle's frames after the cycle before, and the distance between two frames, in µs.
const FIRST_US: u64 = 1000;
/// See [`FIRST_US`].
const SPACING_US: u64 = 100;
/// However many there are: none is later than this after the first one of its cycle.
const LATEST_US: u64 = 8900;

/// A frame with its time stamp.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stamped {
    /// Microseconds of the drive.
    pub micros: u64,
    /// The frame.
    pub frame: Frame,
}

impl Stamped {
    /// Its time in milliseconds, as the receiver takes it.
    #[must_use]
    pub fn millis(&self) -> Millis {
        Millis::new(u32::try_from(self.micros / 1000).unwrap_or(u32::MAX))
    }
}

/// The supervisor's clock in one cycle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Clocked {
    /// The true time of the cycle, in ms.
    pub true_ms: u32,
    /// What the clock shows, in ms; may wrap.
    pub shown_ms: u32,
}

impl Clocked {
    /// What the clock showed when a frame with this true time came.
    const fn shown(self, at: Millis) -> Millis {
        Millis::new(self.shown_ms.wrapping_sub(self.true_ms.wrapping_sub(at.raw())))
    }
}

/// The link.
#[derive(Clone, Debug)]
pub struct Link {
    sensors: Sender,
    controller: Sender,
    /// The supervisor's.
    receiver: Receiver,
    /// The main controller's.
    other: Receiver,
    log: Option<Vec<Stamped>>,
}

impl Link {
    /// Nothing has been sent.
    #[must_use]
    pub fn new(config: &Config) -> Self {
        Self {
            sensors: Sender::new(),
            controller: Sender::new(),
            receiver: Receiver::new(config),
            other: Receiver::new(config),
            log: None,
        }
    }

    /// Keeps every frame from now on.
    pub fn keep_log(&mut self) {
        self.log.get_or_insert_default();
    }

    /// The supervisor was started anew: its receiver knows nothing.
    pub fn start_anew(&mut self, config: &Config) {
        self.receiver = Receiver::new(config);
    }

    /// What is on the link before the cycle at `now_ms`.
    pub fn frames(
        &mut self,
        now_ms: u32,
        (inputs, scene): (&Inputs, &Scene),
        commands: &Commands,
        hooks: &mut impl Hooks,
    ) -> Vec<Stamped> {
        let now = Millis::new(now_ms);
        let (mut sensors, mut controller) = (Vec::new(), Vec::new());
        self.sensors.encode_inputs(now, inputs, scene, &mut |frame| sensors.push(frame));
        self.controller.encode_commands(now, commands, &mut |frame| controller.push(frame));
        hooks.frames(now_ms, Node::Sensors, &mut sensors);
        hooks.frames(now_ms, Node::Controller, &mut controller);
        sensors.append(&mut controller);
        let frames = hooks.carries(now_ms, &sensors).unwrap_or_else(|| at_once(now_ms, &sensors));
        if let Some(log) = &mut self.log {
            log.extend_from_slice(&frames);
        }
        frames
    }

    /// What the supervisor makes of these frames.
    pub fn supervisor_reads(&mut self, clock: Clocked, frames: &[Stamped]) -> Sample<'_> {
        for stamped in frames {
            // A refusal shows in the sample.
            let _ = self.receiver.accept(clock.shown(stamped.millis()), &stamped.frame);
        }
        self.receiver.sample(Millis::new(clock.shown_ms))
    }

    /// What the main controller makes of these frames.
    pub fn controller_reads(&mut self, now_ms: u32, frames: &[Stamped]) -> Sample<'_> {
        for stamped in frames {
            let _ = self.other.accept(stamped.millis(), &stamped.frame);
        }
        self.other.sample(Millis::new(now_ms))
    }

    /// Every frame that was kept.
    #[must_use]
    pub fn into_log(self) -> Vec<Stamped> {
        self.log.unwrap_or_default()
    }
}

/// A bus that carries everything at once.
fn at_once(now_ms: u32, frames: &[Frame]) -> Vec<Stamped> {
    let first = u64::from(now_ms.saturating_sub(CYCLE_MS)) * 1000 + FIRST_US;
    let stamps = (0..).map(|number: u64| first + (number * SPACING_US).min(LATEST_US));
    frames.iter().zip(stamps).map(|(frame, micros)| Stamped { micros, frame: *frame }).collect()
}
