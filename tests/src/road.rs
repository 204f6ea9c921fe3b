//! What stands or moves on the road ahead, and where it stands in the image of the camera.

use supervisor::{Class, PixelBox};

use crate::number::to_u16;

/// What a thing on the road truly is: neither sensor measures its size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Body {
    /// What the camera takes it for.
    pub class: Class,
    /// Width in m.
    pub width: f64,
    /// Height in m.
    pub height: f64,
}

impl Body {
    /// A car.
    pub const CAR: Self = Self { class: Class::Object, width: 1.8, height: 1.5 };
    /// A city bus.
    pub const BUS: Self = Self { class: Class::Object, width: 2.55, height: 3.2 };
    /// A pedestrian.
    pub const PEDESTRIAN: Self = Self { class: Class::Pedestrian, width: 0.5, height: 1.7 };
    /// A cyclist from behind; to a camera one of those on the road who are not in a car.
    pub const CYCLIST: Self = Self { class: Class::Pedestrian, width: 0.6, height: 1.75 };
}

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
    pub body: Body,
    /// It is on the road from this time, in ms.
    pub from_ms: u32,
    /// It is gone from this time, in ms.
    pub until_ms: u32,
}

impl Obstacle {
    /// A car that stands in the lane at this position for good.
    #[must_use]
    pub const fn standing_car(position: f64) -> Self {
        Self { position, speed: 0.0, offset: 0.0, body: Body::CAR, from_ms: 0, until_ms: u32::MAX }
    }
    /// A pedestrian who steps into the lane at this position and time, and stays.
    #[must_use]
    pub const fn pedestrian(position: f64, from_ms: u32) -> Self {
        Self { position, speed: 0.0, offset: 0.3, body: Body::PEDESTRIAN, from_ms, until_ms: u32::MAX }
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

/// The forward camera as it is built in, in metres, degrees and pixels: said here a second time, in other units and
/// other arithmetic than the supervisor's calibration, which the bus must fit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Above the road.
    pub height: f64,
    /// Behind the radar, which sits at the front of the bus.
    pub behind: f64,
    /// Turned to the left, in degrees.
    pub yaw: f64,
    /// Turned downwards, in degrees.
    pub pitch: f64,
}

/// Focal length, size and centre of the image, in pixels (own: 720p, 56° wide).
const FOCAL_PX: f64 = 1200.0;
const IMAGE_PX: (f64, f64) = (1280.0, 720.0);
const CENTRE_PX: (f64, f64) = (640.0, 360.0);

impl Camera {
    /// As the supervisor's default configuration believes it to be.
    pub const STRAIGHT: Self = Self { height: 1.7, behind: 0.5, yaw: 0.0, pitch: 0.0 };

    /// Where a point stands in the image, in pixels; `None` behind the camera. `ahead` counts from the radar, `left`
    /// from the axis of the bus, `up` from the road, all in m.
    fn point(&self, ahead: f64, left: f64, up: f64) -> Option<(f64, f64)> {
        let (sin_yaw, cos_yaw) = self.yaw.to_radians().sin_cos();
        let (sin_pitch, cos_pitch) = self.pitch.to_radians().sin_cos();
        let (ahead, up) = (ahead + self.behind, up - self.height);
        // Turned about the vertical, then about the axis across.
        let (ahead, left) = (ahead * cos_yaw + left * sin_yaw, left * cos_yaw - ahead * sin_yaw);
        let (ahead, up) = (ahead * cos_pitch - up * sin_pitch, up * cos_pitch + ahead * sin_pitch);
        let (column, row) = CENTRE_PX;
        (ahead > 0.1).then(|| (column - FOCAL_PX * left / ahead, row - FOCAL_PX * up / ahead))
    }

    /// The box around a body at this gap and offset, by its four corners, in whole pixels inside the image; `None` if
    /// nothing of it is there.
    #[must_use]
    pub fn pixels(&self, body: &Body, gap: f64, offset: f64) -> Option<PixelBox> {
        let half = body.width / 2.0;
        let corners = [(half, 0.0), (-half, 0.0), (half, body.height), (-half, body.height)];
        let mut edges = [f64::MAX, f64::MIN, f64::MAX, f64::MIN];
        for (across, up) in corners {
            let (column, row) = self.point(gap, offset + across, up)?;
            let [left, right, top, bottom] = edges;
            edges = [left.min(column), right.max(column), top.min(row), bottom.max(row)];
        }
        let (columns, rows) = IMAGE_PX;
        let [left, right, top, bottom] = edges;
        let [left, right] = [left, right].map(|edge| to_u16(edge.clamp(0.0, columns)));
        let [top, bottom] = [top, bottom].map(|edge| to_u16(edge.clamp(0.0, rows)));
        let (width, height) = (right.checked_sub(left)?, bottom.checked_sub(top)?);
        (width > 0 && height > 0).then_some(PixelBox { left, top, width, height })
    }
}
