//! One fault in the loop: from when, for how long, and everything about it that is drawn at random.

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use supervisor::wire::Frame;
use supervisor::{Inputs, Outputs, Scene, Status, Supervisor};

use super::commands::{Commands, cycles};
use super::frames::Frames;
use super::inputs::Sensors;
use super::kind::{Failing, Kind};
use super::own::Itself;
use crate::bench::{Hooks, Node};
use crate::misdeed::Deed;
use crate::plant::Plant;

#[derive(Clone, Debug)]
enum Part {
    Commands(Commands),
    Frames(Frames),
    Inputs(Box<Sensors>),
    Vehicle(Failing),
    Supervisor(Itself),
}

/// One fault.
#[derive(Clone, Debug)]
pub struct Injector {
    from_ms: u32,
    lasts_ms: u32,
    part: Part,
    random: ChaCha8Rng,
}

impl Injector {
    /// This fault, from this time on, for so long; the seed decides the rest.
    #[must_use]
    pub fn new(kind: Kind, from_ms: u32, lasts_ms: u32, seed: u64) -> Self {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let part = match kind {
            Kind::Commands(kind) => Part::Commands(Commands::new(kind, cycles(random.random_range(400..=900)))),
            Kind::Frames(kind) => Part::Frames(Frames::new(kind, random.random_range(300..=800))),
            Kind::Inputs(kind) => Part::Inputs(Box::new(Sensors::new(kind, random.random()))),
            Kind::Vehicle(kind) => Part::Vehicle(kind),
            Kind::Supervisor(kind) => {
                Part::Supervisor(Itself::new(kind, from_ms, lasts_ms, random.random_range(1000..=60_000)))
            }
        };
        Self { from_ms, lasts_ms, part, random }
    }

    /// How long it has been active, in ms; `None` if it is not.
    fn active(&self, now_ms: u32) -> Option<u32> {
        now_ms.checked_sub(self.from_ms).filter(|elapsed| *elapsed < self.lasts_ms)
    }
}

impl Hooks for Injector {
    fn vehicle(&mut self, now_ms: u32, plant: &mut Plant) {
        if let (Part::Vehicle(kind), Some(_)) = (&self.part, self.active(now_ms)) {
            plant.suffer(match kind {
                Failing::DrivePushes => Deed::DrivePushes,
                Failing::BrakesFade => Deed::BrakesFade,
                Failing::K4Drops => Deed::K4DropsOut,
            });
        }
    }

    fn commands(&mut self, now_ms: u32, sent: &mut Outputs) {
        let Some(elapsed) = self.active(now_ms) else { return };
        match &mut self.part {
            Part::Commands(commands) => commands.corrupt(sent, elapsed, self.lasts_ms),
            Part::Frames(frames) => frames.corrupt(sent),
            Part::Inputs(_) | Part::Vehicle(_) | Part::Supervisor(_) => {}
        }
    }

    fn silent(&mut self, now_ms: u32) -> bool {
        matches!(&self.part, Part::Commands(commands) if commands.silent()) && self.active(now_ms).is_some()
    }

    fn inputs(&mut self, now_ms: u32, inputs: &mut Inputs, scene: &mut Scene) {
        let Some(elapsed) = self.active(now_ms) else { return };
        if let Part::Inputs(sensors) = &mut self.part {
            sensors.corrupt(inputs, scene, elapsed);
        }
    }

    fn frames(&mut self, now_ms: u32, node: Node, frames: &mut Vec<Frame>) {
        let active = self.active(now_ms).is_some();
        let Part::Frames(part) = &mut self.part else { return };
        if active {
            part.mangle(now_ms, node, frames, &mut self.random);
        } else {
            part.watch(node, frames);
        }
    }

    fn runs(&mut self, now_ms: u32) -> bool {
        match &self.part {
            Part::Supervisor(own) => own.runs(now_ms),
            Part::Commands(_) | Part::Frames(_) | Part::Inputs(_) | Part::Vehicle(_) => true,
        }
    }

    fn clock(&mut self, now_ms: u32) -> u32 {
        match &self.part {
            Part::Supervisor(own) => own.clock(now_ms, &mut self.random),
            Part::Commands(_) | Part::Frames(_) | Part::Inputs(_) | Part::Vehicle(_) => now_ms,
        }
    }

    fn replace(&mut self, now_ms: u32, supervisor: &Supervisor, last: Option<&Status>) -> Option<(Supervisor, bool)> {
        match &mut self.part {
            Part::Supervisor(own) => own.replace(now_ms, supervisor, last, &mut self.random),
            Part::Commands(_) | Part::Frames(_) | Part::Inputs(_) | Part::Vehicle(_) => None,
        }
    }

    fn unsupervised(&mut self, now_ms: u32, sent: &Outputs) -> Outputs {
        let active = self.active(now_ms).is_some();
        match &mut self.part {
            Part::Frames(frames) if active => frames.unsupervised(now_ms, sent, &mut self.random),
            Part::Frames(frames) => {
                frames.took(now_ms, sent);
                *sent
            }
            Part::Commands(_) | Part::Inputs(_) | Part::Vehicle(_) | Part::Supervisor(_) => *sent,
        }
    }
}
