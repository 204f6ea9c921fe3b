//! What stands or moves on the road ahead, and what radar and camera see of it.

use supervisor::{CameraObject, Class, ClosingCmS, Count, DistanceCm, Millis, OffsetCm, PixelBox, RadarObject, Scene};

use crate::number::{to_i16, to_u16};
use crate::plant::Parameters;

/// One thing on the road.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Obstacle {
    /// Where its rear is at time 0, from the front of the bus at time 0, in m.
    pub position: f64,
    /// Its speed, in m/s, away from the bus.
    pub speed: f64,
    /// Its offset from the path, in m, left positive.
    pub offset: f64,
    /// What it is.
    pub class: Class,
    /// It is on the road from this time, in ms.
    pub from_ms: u32,
    /// It is gone from this time, in ms.
    pub until_ms: u32,
}

impl Obstacle {
    /// A car that stands in the lane at this position for good.
    #[must_use]
    pub const fn standing_car(position: f64) -> Self {
        Self { position, speed: 0.0, offset: 0.0, class: Class::Object, from_ms: 0, until_ms: u32::MAX }
    }
    /// A pedestrian who steps into the lane at this position and time, and stays.
    #[must_use]
    pub const fn pedestrian(position: f64, from_ms: u32) -> Self {
        Self { position, speed: 0.0, offset: 0.3, class: Class::Pedestrian, from_ms, until_ms: u32::MAX }
    }
    /// Where its rear is.
    #[must_use]
    pub fn rear(&self, now_ms: u32) -> f64 {
        self.position + self.speed * f64::from(now_ms) / 1000.0
    }
    /// Whether it is on the road.
    #[must_use]
    pub const fn present(&self, now_ms: u32) -> bool {
        now_ms >= self.from_ms && now_ms < self.until_ms
    }
}

/// Radar and camera: each samples the road with its own period, and its objects age until the next sample.
#[derive(Clone, Debug)]
pub struct Eyes {
    scene: Scene,
    radar_at: u32,
    camera_at: u32,
    updates: Vec<u8>,
}

/// Focal length of the camera in pixels, and the width of a car and of a pedestrian in m (own).
const FOCAL_PX: f64 = 1200.0;
const CAR_M: f64 = 1.8;
const PERSON_M: f64 = 0.5;
/// Centre of the image in pixels (own).
const CENTRE_PX: (f64, f64) = (640.0, 400.0);

impl Eyes {
    /// For so many obstacles; nothing has been sampled.
    #[must_use]
    pub fn new(obstacles: usize) -> Self {
        Self { scene: Scene::clear(), radar_at: 0, camera_at: 0, updates: vec![0; obstacles] }
    }

    /// Samples the road where a period has elapsed. `front` and `speed` are those of the bus.
    pub fn sample(&mut self, now_ms: u32, road: &[Obstacle], front: f64, speed: f64, parameters: &Parameters) {
        let seen = |obstacle: &Obstacle, range: f64| {
            let gap = obstacle.rear(now_ms) - front;
            (obstacle.present(now_ms) && gap < range).then_some(gap.max(0.0))
        };
        let closing = |obstacle: &Obstacle| ClosingCmS::new(to_i16((speed - obstacle.speed) * 100.0));
        if now_ms.is_multiple_of(parameters.radar_ms) {
            self.radar_at = now_ms;
            self.scene.radar.clear();
            for (obstacle, updates) in road.iter().zip(&mut self.updates) {
                let Some(gap) = seen(obstacle, parameters.radar_range_m) else {
                    *updates = 0;
                    continue;
                };
                *updates = updates.saturating_add(1);
                let matched = seen(obstacle, parameters.camera_range_m).is_some();
                // A list that is full drops what comes last; the drives have one or two objects.
                let _ = self.scene.radar.push(RadarObject {
                    distance: DistanceCm::new(to_u16(gap * 100.0)),
                    offset: OffsetCm::new(to_i16(obstacle.offset * 100.0)),
                    closing: closing(obstacle),
                    age: Millis::ZERO,
                    updates: Count::new(*updates),
                    class: if matched { obstacle.class } else { Class::Unmatched },
                });
            }
        }
        if now_ms.is_multiple_of(parameters.camera_ms) {
            self.camera_at = now_ms;
            self.scene.camera.clear();
            for obstacle in road {
                let Some(gap) = seen(obstacle, parameters.camera_range_m) else { continue };
                let _ = self.scene.camera.push(CameraObject {
                    pixels: pixels(obstacle, gap),
                    class: obstacle.class,
                    distance: DistanceCm::new(to_u16(gap * 100.0)),
                    closing: closing(obstacle),
                    age: Millis::ZERO,
                });
            }
        }
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

/// The obstacle's box by the pinhole model.
fn pixels(obstacle: &Obstacle, gap: f64) -> PixelBox {
    let scale = FOCAL_PX / gap.max(1.0);
    let (width, height) = match obstacle.class {
        Class::Pedestrian => (PERSON_M * scale, 1.75 * scale),
        Class::Unmatched | Class::Object => (CAR_M * scale, 1.5 * scale),
    };
    let (x, y) = CENTRE_PX;
    PixelBox {
        left: to_u16(x - obstacle.offset * scale - width / 2.0),
        top: to_u16(y - height / 2.0),
        width: to_u16(width),
        height: to_u16(height),
    }
}
