//! What a scenario does to the bus and its road beside the script: it brings things, moves them, bends the road.

use super::Plant;
use crate::bend::Bend;
use crate::driver::Act;
use crate::road::{Body, Obstacle};
use crate::sensing::Noise;

impl Plant<'_> {
    /// Time of the model, in ms: that of the last cycle.
    #[must_use]
    pub const fn now_ms(&self) -> u32 {
        self.now_ms
    }

    /// The driver does this now.
    pub fn act(&mut self, act: Act) {
        self.driver.act(act, self.now_ms);
    }

    /// The road bends so.
    pub fn bend(&mut self, bends: Vec<Bend>) {
        self.bends = bends;
    }

    /// From here on the road has this slope.
    pub const fn tilt(&mut self, slope: f64) {
        self.parameters.slope = slope;
    }

    /// From now on the bus has these periods of radar and camera, in ms.
    pub const fn look_every(&mut self, radar_ms: u32, camera_ms: u32) {
        (self.parameters.radar_ms, self.parameters.camera_ms) = (radar_ms, camera_ms);
    }

    /// Radar and camera are disturbed from now on; the same seed gives the same disturbance.
    pub fn disturb(&mut self, noise: Noise, seed: u64) {
        self.eyes.disturb(noise, seed);
    }

    /// A thing of the road appears so far ahead of the bus (its rear, in m), with this speed in m/s and this offset in m.
    /// There is a place for each that was on the road at the start, and for one more.
    pub fn bring(&mut self, number: usize, body: Body, gap: f64, speed: f64, offset: f64) {
        let position = self.position + gap - speed * f64::from(self.now_ms) / 1000.0;
        let obstacle = Obstacle { position, speed, offset, body, from_ms: self.now_ms, until_ms: u32::MAX };
        match self.road.get_mut(number) {
            Some(place) => *place = obstacle,
            None => self.road.push(obstacle),
        }
        self.eyes.lose(number);
    }

    /// A thing of the road goes on from where it is with this speed in m/s and this offset in m.
    pub fn drive(&mut self, number: usize, speed: f64, offset: f64) {
        let now_ms = self.now_ms;
        if let Some(obstacle) = self.road.get_mut(number) {
            let rear = obstacle.rear(now_ms);
            obstacle.position = rear - speed * f64::from(now_ms) / 1000.0;
            (obstacle.speed, obstacle.offset) = (speed, offset);
        }
    }

    /// A thing of the road is gone.
    pub fn take_away(&mut self, number: usize) {
        if let Some(obstacle) = self.road.get_mut(number) {
            obstacle.until_ms = self.now_ms;
        }
    }

    /// How far a thing of the road is ahead of the bus (its rear), in m; `None` if it is not there.
    #[must_use]
    pub fn gap_to(&self, number: usize) -> Option<f64> {
        let obstacle = self.road.get(number).filter(|obstacle| obstacle.present(self.now_ms))?;
        Some(obstacle.rear(self.now_ms) - self.position)
    }
}
