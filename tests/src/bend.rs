//! Bends of the road, and where a thing beside it seems to be for a bus that has not turned in yet.
//!
//! A radar gives the offset of an object from the path that the bus would take as it steers now. Where the road bends ahead
//! and the wheel is still straight, what stands beside the road lies in that path.

/// Steering-wheel angle to road-wheel angle (SG-09: assumed).
const RATIO: f64 = 20.0;
/// Distance of the axles in m (own: a 12 m bus).
const WHEELBASE_M: f64 = 6.0;

/// A part of the road with one curvature.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bend {
    /// Where it begins, on the way of the bus, in m.
    pub from: f64,
    /// Where it ends, in m.
    pub until: f64,
    /// Curvature in 1/m, left positive.
    pub curvature: f64,
}

/// Where the bus is and how it moves.
#[derive(Clone, Copy, Debug)]
pub struct Pose<'a> {
    /// Its front, in m.
    pub front: f64,
    /// Its speed, in m/s.
    pub speed: f64,
    /// The curvature of its path as it steers now, in 1/m.
    pub curvature: f64,
    /// The bends of its road; none: a straight road, on which the path is the road, however the wheel stands.
    pub bends: &'a [Bend],
}

/// The curvature in 1/m that goes with a steering-wheel angle in degrees; small angles.
#[must_use]
pub fn curvature(angle: f64) -> f64 {
    (angle / RATIO).to_radians() / WHEELBASE_M
}

/// The steering-wheel angle in degrees that goes with a curvature in 1/m.
#[must_use]
pub fn wheel(curvature: f64) -> f64 {
    (curvature * WHEELBASE_M).to_degrees() * RATIO
}

/// The curvature of the road at this place.
#[must_use]
pub fn road_at(bends: &[Bend], place: f64) -> f64 {
    bends.iter().find(|bend| (bend.from..bend.until).contains(&place)).map_or(0.0, |bend| bend.curvature)
}

impl Pose<'_> {
    /// How far the road lies to the left of the path, so far ahead, in m.
    #[must_use]
    pub fn road_beside_path(&self, ahead: f64) -> f64 {
        if self.bends.is_empty() {
            return 0.0;
        }
        let ahead = ahead.max(0.0);
        let bent = |bend: &Bend| {
            let rest = |place: f64| ahead - (place - self.front).clamp(0.0, ahead);
            bend.curvature * (rest(bend.from) * rest(bend.from) - rest(bend.until) * rest(bend.until)) / 2.0
        };
        self.bends.iter().map(bent).sum::<f64>() - self.curvature * ahead * ahead / 2.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bus_that_follows_its_bend_sees_the_road_straight() {
        let bends = [Bend { from: 0.0, until: 1000.0, curvature: 0.02 }];
        let pose = |curvature| Pose { front: 10.0, speed: 5.0, curvature, bends: &bends };
        assert!(pose(0.02).road_beside_path(30.0).abs() < 1e-9);
        // Still straight: 30 m ahead the road is 0.02 · 30² / 2 = 9 m to the left.
        assert!((pose(0.0).road_beside_path(30.0) - 9.0).abs() < 1e-9);
        assert!((curvature(wheel(0.02)) - 0.02).abs() < 1e-12);
        let ahead = Pose { front: -20.0, ..pose(0.0) };
        assert!((ahead.road_beside_path(30.0) - 1.0).abs() < 1e-9, "a bend that begins 20 m ahead");
    }
}
