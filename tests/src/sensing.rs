//! What radar and camera see of the road: each samples it with its own period; and how that may be disturbed.

use std::collections::VecDeque;

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use supervisor::{CameraObject, ClosingCmS, Count, DistanceCm, Millis, OffsetCm, RadarObject, Scene};

use crate::bend::Pose;
use crate::number::{to_i16, to_u16};
use crate::plant::Parameters;
use crate::road::{Camera, Obstacle};

/// How well one sensor measures. Deviations are standard deviations of each sample, independent of the one before.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Precision {
    /// Of the distance, in m.
    pub distance: f64,
    /// Of the offset, in m.
    pub offset: f64,
    /// Of the closing speed, in m/s.
    pub closing: f64,
    /// With this probability an object is missing in a sample.
    pub missing: f64,
    /// So long after the sample its list is there, in ms; its objects have that age.
    pub latency_ms: u32,
}

/// How both sensors are disturbed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Noise {
    /// The radar.
    pub radar: Precision,
    /// The camera; its box is that of the wrong distance and offset.
    pub camera: Precision,
}

impl Noise {
    /// Of the size of what data sheets of automotive sensors promise (own).
    pub const TYPICAL: Self = Self {
        radar: Precision { distance: 0.15, offset: 0.15, closing: 0.1, missing: 0.02, latency_ms: 20 },
        camera: Precision { distance: 0.8, offset: 0.1, closing: 0.5, missing: 0.05, latency_ms: 60 },
    };
}

/// About normal, mean 0, deviation 1: the sum of twelve uniform numbers. No logarithm, so every machine agrees.
pub fn normal(random: &mut impl Rng) -> f64 {
    (0..12).map(|_| random.random::<f64>()).sum::<f64>() - 6.0
}

/// Half of the width of the bus, in m: further aside nothing is hit.
const BESIDE_M: f64 = 1.275;

/// One object as it is measured.
#[derive(Clone, Copy, Debug)]
struct Measured {
    gap: f64,
    offset: f64,
    closing: f64,
}

#[derive(Clone, Debug)]
struct Disturbed {
    noise: Noise,
    random: ChaCha8Rng,
}

impl Disturbed {
    /// `None` if the object is missing.
    fn measure(&mut self, precision: Precision, truth: Measured) -> Option<Measured> {
        let random = &mut self.random;
        // Drawn whether it is missing or not: one object does not shift the numbers of the next.
        let [gap, offset, closing] =
            [precision.distance, precision.offset, precision.closing].map(|size| size * normal(random));
        let missing = random.random_bool(precision.missing);
        let measured = Measured {
            gap: (truth.gap + gap).max(0.0),
            offset: truth.offset + offset,
            closing: truth.closing + closing,
        };
        (!missing).then_some(measured)
    }
}

/// Radar and camera: each samples the road with its own period, and its objects age until the next list.
#[derive(Clone, Debug)]
pub struct Eyes {
    scene: Scene,
    radar_at: u32,
    camera_at: u32,
    updates: Vec<u8>,
    disturbed: Option<Disturbed>,
    /// Lists on their way: when they are there, and of which sample. The scene holds that of one sensor alone.
    radar_late: VecDeque<(u32, u32, Scene)>,
    camera_late: VecDeque<(u32, u32, Scene)>,
}

impl Eyes {
    /// For so many obstacles; nothing has been sampled.
    #[must_use]
    pub fn new(obstacles: usize) -> Self {
        Self {
            scene: Scene::clear(),
            radar_at: 0,
            camera_at: 0,
            updates: vec![0; obstacles],
            disturbed: None,
            radar_late: VecDeque::new(),
            camera_late: VecDeque::new(),
        }
    }

    /// From now on what is sampled is disturbed so.
    pub fn disturb(&mut self, noise: Noise, seed: u64) {
        self.disturbed = Some(Disturbed { noise, random: ChaCha8Rng::seed_from_u64(seed) });
    }

    /// What the radar has known of this obstacle is another one's.
    pub fn lose(&mut self, number: usize) {
        if let Some(updates) = self.updates.get_mut(number) {
            *updates = 0;
        }
    }

    /// Samples the road where a period has elapsed.
    pub fn sample(&mut self, now_ms: u32, road: &[Obstacle], pose: &Pose<'_>, parameters: &Parameters) {
        if now_ms.is_multiple_of(parameters.radar_ms) {
            self.sample_radar(now_ms, road, pose, parameters.radar_range_m);
        }
        if now_ms.is_multiple_of(parameters.camera_ms) {
            self.sample_camera(now_ms, road, pose, parameters.camera_range_m);
        }
        if let Some((at, list)) = due(&mut self.radar_late, now_ms) {
            (self.scene.radar, self.radar_at) = (list.radar, at);
        }
        if let Some((at, list)) = due(&mut self.camera_late, now_ms) {
            (self.scene.camera, self.camera_at) = (list.camera, at);
        }
    }

    fn sample_radar(&mut self, now_ms: u32, road: &[Obstacle], pose: &Pose<'_>, range: f64) {
        let mut list = Scene::clear();
        self.updates.resize(road.len(), 0);
        for (obstacle, updates) in road.iter().zip(&mut self.updates) {
            let truth = seen(now_ms, obstacle, pose, range);
            let measured = truth.and_then(|truth| match &mut self.disturbed {
                Some(disturbed) => disturbed.measure(disturbed.noise.radar, truth),
                None => Some(truth),
            });
            let Some(Measured { gap, offset, closing }) = measured else {
                *updates = 0;
                continue;
            };
            *updates = updates.saturating_add(1);
            // A list that is full drops what comes last.
            let _ = list.radar.push(RadarObject {
                distance: DistanceCm::new(to_u16(gap * 100.0)),
                offset: OffsetCm::new(to_i16(offset * 100.0)),
                closing: ClosingCmS::new(to_i16(closing * 100.0)),
                age: Millis::ZERO,
                updates: Count::new(*updates),
            });
        }
        let latency_ms = self.disturbed.as_ref().map_or(0, |disturbed| disturbed.noise.radar.latency_ms);
        self.radar_late.push_back((now_ms.saturating_add(latency_ms), now_ms, list));
    }

    fn sample_camera(&mut self, now_ms: u32, road: &[Obstacle], pose: &Pose<'_>, range: f64) {
        let mut list = Scene::clear();
        for obstacle in road {
            let truth = seen(now_ms, obstacle, pose, range);
            let measured = truth.and_then(|truth| match &mut self.disturbed {
                Some(disturbed) => disturbed.measure(disturbed.noise.camera, truth),
                None => Some(truth),
            });
            let Some(Measured { gap, offset, closing }) = measured else { continue };
            let Some(pixels) = Camera::STRAIGHT.pixels(&obstacle.body, gap, offset) else { continue };
            let _ = list.camera.push(CameraObject {
                pixels,
                class: obstacle.body.class,
                distance: DistanceCm::new(to_u16(gap * 100.0)),
                closing: ClosingCmS::new(to_i16(closing * 100.0)),
                age: Millis::ZERO,
            });
        }
        let latency_ms = self.disturbed.as_ref().map_or(0, |disturbed| disturbed.noise.camera.latency_ms);
        self.camera_late.push_back((now_ms.saturating_add(latency_ms), now_ms, list));
    }

    /// The lists as they stand, with their ages.
    #[must_use]
    pub fn scene(&self, now_ms: u32) -> Scene {
        let mut scene = self.scene.clone();
        for object in &mut scene.radar {
            object.age = Millis::new(now_ms.saturating_sub(self.radar_at));
        }
        for object in &mut scene.camera {
            object.age = Millis::new(now_ms.saturating_sub(self.camera_at));
        }
        scene
    }
}

/// The last list that is there, and when it was sampled.
fn due(late: &mut VecDeque<(u32, u32, Scene)>, now_ms: u32) -> Option<(u32, Scene)> {
    let mut last = None;
    while late.front().is_some_and(|(due, ..)| *due <= now_ms) {
        last = late.pop_front().map(|(_, at, list)| (at, list));
    }
    last
}

/// What is truly there, if it is in sight.
fn seen(now_ms: u32, obstacle: &Obstacle, pose: &Pose<'_>, range: f64) -> Option<Measured> {
    let gap = obstacle.rear(now_ms) - pose.front;
    let (offset, closing) = (obstacle.offset + pose.road_beside_path(gap), pose.speed - obstacle.speed);
    // What stands beside the bus is out of sight; what was hit is not.
    let passed = gap < 0.0 && obstacle.offset.abs() > BESIDE_M + obstacle.body.width / 2.0;
    let sight = obstacle.present(now_ms) && gap < range && !passed;
    sight.then_some(Measured { gap: gap.max(0.0), offset, closing })
}
