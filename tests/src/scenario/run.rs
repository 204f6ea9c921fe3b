//! A scene in the closed loop, with the correct main controller.

use supervisor::wire::Frame;
use supervisor::{ConfigError, Inputs, Scene as Lists};

use super::Scene;
use super::criteria::Row;
use super::happens::{Happened, happened};
use crate::bench::{Bench, Hooks};
use crate::disturb::{Disturbance, seed_of};
use crate::drive::{Cycle, Scenario};
use crate::link::Stamped;
use crate::plant::{CYCLE_MS, Plant};
use crate::traffic::Traffic;

/// The world around a bus: the others, the slope, and what is disturbed.
#[derive(Clone, Debug)]
struct World {
    traffic: Traffic,
    slope: (u32, f64),
    disturbance: Option<Disturbance>,
}

impl Hooks for World {
    fn vehicle(&mut self, now_ms: u32, plant: &mut Plant) {
        let (from_ms, slope) = self.slope;
        if slope.abs() > 0.0 && now_ms >= from_ms {
            plant.tilt(slope);
        }
        self.traffic.vehicle(now_ms, plant);
        if let Some(disturbance) = &mut self.disturbance {
            disturbance.vehicle(now_ms, plant);
        }
    }

    fn inputs(&mut self, now_ms: u32, inputs: &mut Inputs, scene: &mut Lists) {
        if let Some(disturbance) = &mut self.disturbance {
            disturbance.inputs(now_ms, inputs, scene);
        }
    }

    fn carries(&mut self, now_ms: u32, frames: &[Frame]) -> Option<Vec<Stamped>> {
        self.disturbance.as_mut().and_then(|disturbance| disturbance.carries(now_ms, frames))
    }
}

/// What came of a scene.
#[derive(Clone, Debug)]
pub struct Ran {
    /// Every cycle.
    pub cycles: Vec<Cycle>,
    /// Every frame that the supervisor read.
    pub frames: Vec<Stamped>,
    /// What happened.
    pub events: Vec<Happened>,
    /// What was demanded, and whether it was so.
    pub rows: Vec<Row>,
}

/// Drives it. The seed counts where something is disturbed.
///
/// # Errors
/// If the default configuration is refused.
pub fn run(scene: &Scene, seed: u64) -> Result<Ran, ConfigError> {
    let traffic = Traffic::new(scene.actors.clone());
    let places = traffic.places();
    let scenario = Scenario {
        name: &scene.name,
        title: &scene.title,
        description: &scene.description,
        length_ms: scene.length_ms,
        parameters: scene.parameters,
        script: &scene.acts,
        road: &places,
        misdeeds: &[],
    };
    let seed = seed_of(seed, &scene.full_name(), 0);
    let disturbance = scene.disturbed.map(|amount| Disturbance::new(amount, seed));
    let mut world = World { traffic, slope: scene.slope, disturbance };
    let mut bench = Bench::new(&scenario)?.with_log();
    let cycles: Vec<Cycle> = (CYCLE_MS..=scene.length_ms).step_by(10).map(|_| bench.step(&mut world)).collect();
    let events = happened(&cycles);
    let rows = scene.expected.judge(&cycles, &events);
    Ok(Ran { cycles, frames: bench.into_log(), events, rows })
}
