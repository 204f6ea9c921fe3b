//! Does the steering run away (HZ-08)? Measured as SG-09 gives its reason: by the way that the bus goes sideways in the FTTI.

use std::collections::VecDeque;

use crate::plant::{CYCLE_MS, Truth};

/// Steering-wheel angle to road-wheel angle (SG-09: assumed).
const RATIO: f64 = 20.0;
/// Distance of the axles in m (own: a 12 m bus).
const WHEELBASE_M: f64 = 6.0;
/// SG-09: about 0.1 m within the rate bound; half as much again is out of it, in m.
const SIDEWAYS_M: f64 = 0.15;

/// The last angles.
#[derive(Clone, Debug, Default)]
pub struct Wheel {
    angles: VecDeque<f64>,
    away: bool,
}

impl Wheel {
    /// The FTTI of SG-09, over which the way is measured, in ms.
    pub const SPAN_MS: u32 = 700;

    /// One cycle.
    pub fn see(&mut self, truth: &Truth) {
        let cycle_s = f64::from(CYCLE_MS) / 1000.0;
        self.angles.push_back(truth.angle);
        if self.angles.len() > 70 {
            self.angles.pop_front();
        }
        let first = self.angles.front().copied().unwrap_or(truth.angle);
        let (mut drift, mut way) = (0.0, 0.0);
        for angle in &self.angles {
            let road_wheel = ((angle - first) / RATIO).to_radians();
            drift += truth.speed * truth.speed / WHEELBASE_M * road_wheel * cycle_s;
            way += drift * cycle_s;
        }
        self.away = way.abs() > SIDEWAYS_M;
    }

    /// Within its span the wheel has carried the bus further sideways than a bounded one.
    #[must_use]
    pub const fn ran_away(&self) -> bool {
        self.away
    }
}
