//! Everything between the world and the supervisor that is not as it should be, and no fault: sensors measure with noise
//! and miss things, the bus is busy and loses frames.
//!
//! [`bus`]: the CAN bus; [`crate::sensing`]: radar and camera; [`Disturbance`]: both in the loop; [`reaction`]: how long from
//! an object to a deceleration; [`mod@run`], [`situation`]: randomised runs with a correct main controller.

pub mod bus;
pub mod reaction;
pub mod run;
pub mod situation;

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use supervisor::wire::Frame;
use supervisor::{AngleDeciDeg, DecelMs2Q11, Inputs, Scene, Signal, SpeedKmhQ8};

use crate::bench::Hooks;
use crate::link::Stamped;
use crate::number::{to_i16, to_u16};
use crate::plant::Plant;
use crate::sensing::{Noise, normal};
use bus::{Bus, Carried, Traffic};

/// How much is disturbed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Amount {
    /// Radar and camera.
    pub noise: Option<Noise>,
    /// The bus.
    pub traffic: Option<Traffic>,
    /// Standard deviation of both speeds in km/h, of the steering angle in degrees, of the deceleration in m/s².
    pub inputs: [f64; 3],
    /// Periods of radar and camera in ms, if not those of the bus.
    pub periods_ms: Option<[u32; 2]>,
}

impl Amount {
    /// What the campaign runs with (S1 §3.2 names the load alone; the rest is own).
    pub const TYPICAL: Self = Self {
        noise: Some(Noise::TYPICAL),
        traffic: Some(Traffic::SEVENTY_PERCENT),
        inputs: [0.1, 0.3, 0.05],
        periods_ms: None,
    };
}

/// A disturbance in the loop, from the first cycle that it sees.
#[derive(Clone, Debug)]
pub struct Disturbance {
    amount: Amount,
    seed: u64,
    begun: bool,
    bus: Option<Bus>,
    random: ChaCha8Rng,
    /// What was carried for the cycle in progress.
    carried: Vec<Carried>,
}

impl Disturbance {
    /// The same seed gives the same disturbance.
    #[must_use]
    pub fn new(amount: Amount, seed: u64) -> Self {
        Self {
            amount,
            seed,
            begun: false,
            bus: amount.traffic.map(|traffic| Bus::new(traffic, seed.wrapping_add(1))),
            random: ChaCha8Rng::seed_from_u64(seed.wrapping_add(2)),
            carried: Vec::new(),
        }
    }

    /// What was carried for the last cycle.
    #[must_use]
    pub fn carried(&self) -> &[Carried] {
        &self.carried
    }

    /// The bus, if it is disturbed.
    #[must_use]
    pub const fn bus(&self) -> Option<&Bus> {
        self.bus.as_ref()
    }
}

impl Hooks for Disturbance {
    fn vehicle(&mut self, _now_ms: u32, plant: &mut Plant) {
        if !self.begun {
            self.begun = true;
            if let Some(noise) = self.amount.noise {
                plant.disturb(noise, self.seed);
            }
            if let Some([radar_ms, camera_ms]) = self.amount.periods_ms {
                plant.look_every(radar_ms, camera_ms);
            }
        }
    }

    fn inputs(&mut self, _now_ms: u32, inputs: &mut Inputs, _scene: &mut Scene) {
        let [speed, angle, decel] = self.amount.inputs;
        let mut off = |size: f64| size * normal(&mut self.random);
        for signal in [&mut inputs.wheel_speed, &mut inputs.motor_speed] {
            // Wheels that stand give no pulses.
            if let Some(known) = signal.known().filter(|known| *known > SpeedKmhQ8::ZERO) {
                let noisy = f64::from(known.raw()) + off(speed) * 256.0;
                *signal = Signal::Known(SpeedKmhQ8::new(to_u16(noisy)));
            }
        }
        if let Some(known) = inputs.steering_angle.known() {
            let noisy = f64::from(known.raw()) + off(angle) * 10.0;
            inputs.steering_angle = Signal::Known(AngleDeciDeg::new(to_i16(noisy)));
        }
        if let Some(known) = inputs.deceleration.known() {
            let noisy = f64::from(known.raw()) + off(decel) * 2048.0;
            inputs.deceleration = Signal::Known(DecelMs2Q11::new(to_u16(noisy)));
        }
    }

    fn carries(&mut self, now_ms: u32, frames: &[Frame]) -> Option<Vec<Stamped>> {
        let bus = self.bus.as_mut()?;
        self.carried = bus.carry(now_ms, frames);
        Some(self.carried.iter().map(|carried| carried.stamped).collect())
    }
}

/// A seed for one of many runs: FNV-1a over everything that names it.
#[must_use]
pub fn seed_of(main: u64, name: &str, number: u64) -> u64 {
    let words = [&main.to_le_bytes()[..], name.as_bytes(), b"/", &number.to_le_bytes()];
    let fold = |hash: u64, byte: &u8| (hash ^ u64::from(*byte)).wrapping_mul(0x0000_0100_0000_01B3);
    words.into_iter().flatten().fold(0xCBF2_9CE4_8422_2325, fold)
}

/// A uniform number between two.
pub(crate) fn between(random: &mut impl Rng, [least, most]: [f64; 2]) -> f64 {
    least + (most - least) * random.random::<f64>()
}
