//! The main controller's own fusion: by bearing and by distance, in floating point, as another team would write it.
//!
//! Deliberately not what the supervisor does: two implementations that share no line agree on what stands ahead.

use supervisor::{CameraObject, Class, RadarObject, Scene};

use super::sources::CERTAIN_UPDATES;

/// Pixels of the focal length and of the column straight ahead; metres from camera to radar.
const FOCAL_PX: f64 = 1200.0;
const CENTRE_PX: f64 = 640.0;
const BEHIND_M: f64 = 0.5;
/// A box may miss the bearing of the radar by so many of its widths, and its distance by this share (own).
const MISS_WIDTHS: f64 = 0.75;
const MISS_SHARE: f64 = 0.3;

/// What stands ahead, as it is now.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sight {
    /// Distance in cm.
    pub distance: i64,
    /// Closing speed in cm/s.
    pub closing: i64,
    /// Magnitude of the offset in cm.
    pub offset: u16,
    /// The camera sees it too, or the radar has seen it often.
    pub certain: bool,
    /// The camera says that it is a pedestrian.
    pub pedestrian: bool,
}

/// The distance in m at a time that was `ago` ms ago.
fn metres(distance: u16, closing: i16, age: u32, ago: u32) -> f64 {
    (f64::from(distance) - f64::from(closing) * (f64::from(age) - f64::from(ago)) / 1000.0) / 100.0
}

fn same(radar: &RadarObject, camera: &CameraObject) -> bool {
    let then = camera.age.raw();
    let distance = metres(radar.distance.raw(), radar.closing.raw(), radar.age.raw(), then);
    let estimate = metres(camera.distance.raw(), camera.closing.raw(), then, then);
    let column = CENTRE_PX - FOCAL_PX * f64::from(radar.offset.raw()) / 100.0 / (distance + BEHIND_M).max(0.5);
    let (left, width) = (f64::from(camera.pixels.left), f64::from(camera.pixels.width));
    let miss = (column - left - width / 2.0).abs();
    miss <= MISS_WIDTHS * width && (distance - estimate).abs() <= MISS_SHARE * estimate.max(2.0)
}

/// Every radar object, with what the camera knows of it.
#[must_use]
pub fn look(scene: &Scene) -> Vec<Sight> {
    let radar: &[RadarObject] = if scene.radar_known { &scene.radar } else { &[] };
    let camera: &[CameraObject] = if scene.camera_known { &scene.camera } else { &[] };
    let sight = |object: &RadarObject| {
        let (closing, age) = (i64::from(object.closing.raw()), i64::from(object.age.raw()));
        let partner = camera.iter().find(|seen| same(object, seen));
        Sight {
            distance: (i64::from(object.distance.raw()) * 1000 - closing * age).div_euclid(1000).max(0),
            closing,
            offset: object.offset.raw().unsigned_abs(),
            certain: partner.is_some() || object.updates.raw() >= CERTAIN_UPDATES,
            pedestrian: partner.is_some_and(|seen| seen.class == Class::Pedestrian),
        }
    };
    radar.iter().map(sight).collect()
}
