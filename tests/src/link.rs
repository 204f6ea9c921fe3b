//! The CAN link: sensors and main controller on one side, the supervisor's receiver on the other.
//!
//! Cycle k of the supervisor is at k · 10 ms; the frames that it is the first to see carry stamps from 1 ms after
//! cycle k − 1 on, 0.1 ms apart. A replay that steps at every multiple of 10 ms, first taking every frame with an
//! earlier stamp, sees exactly what the closed loop saw: [`crate::drive::replay`].

use std::collections::BTreeMap;

use supervisor::wire::{Frame, Receiver, Sample, Sender};
use supervisor::{Commands, Config, Inputs, Millis, Scene};

use crate::misdeed::Deed;
use crate::plant::CYCLE_MS;

/// First stamp of a cycle's frames after the cycle before, and the distance between two frames, in µs.
const FIRST_US: u64 = 1000;
/// See [`FIRST_US`].
const SPACING_US: u64 = 100;

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

/// The link.
#[derive(Debug)]
pub struct Link {
    sensors: Sender,
    controller: Sender,
    receiver: Receiver,
    log: Vec<Stamped>,
    last: BTreeMap<u32, Frame>,
}

impl Link {
    /// Nothing has been sent.
    #[must_use]
    pub fn new(config: &Config) -> Self {
        Self {
            sensors: Sender::new(),
            controller: Sender::new(),
            receiver: Receiver::new(config),
            log: Vec::new(),
            last: BTreeMap::new(),
        }
    }

    /// Sends what is due before the cycle at `now_ms`, and gives what the supervisor makes of it.
    pub fn cycle(
        &mut self,
        now_ms: u32,
        (inputs, scene): (&Inputs, &Scene),
        commands: &Commands,
        tampering: Option<Deed>,
    ) -> Sample<'_> {
        let now = Millis::new(now_ms);
        let mut micros = u64::from(now_ms.saturating_sub(CYCLE_MS)) * 1000 + FIRST_US;
        let Self { sensors, controller, receiver, log, last } = self;
        let mut put = |frame: Frame| {
            let stamped = Stamped { micros, frame };
            log.push(stamped);
            micros += SPACING_US;
            // A refusal shows in the sample.
            let _ = receiver.accept(stamped.millis(), &frame);
        };
        sensors.encode_inputs(now, inputs, scene, &mut put);
        controller.encode_commands(now, commands, &mut |frame| {
            let sent = match tampering {
                Some(Deed::BreaksChecksums) => broken(frame),
                Some(Deed::RepeatsCounters) => last.get(&frame.id).copied().unwrap_or(frame),
                Some(_) | None => frame,
            };
            last.insert(frame.id, sent);
            put(sent);
        });
        receiver.sample(now)
    }

    /// Every frame that was sent.
    #[must_use]
    pub fn into_log(self) -> Vec<Stamped> {
        self.log
    }
}

/// One flipped bit in the payload: no checksum of the link survives it.
fn broken(mut frame: Frame) -> Frame {
    if let Some(byte) = frame.data.get_mut(3) {
        *byte ^= 0x10;
    }
    frame
}
