//! S1 §3.1.2: warnings and the three levels of collision mitigation.

use supervisor::Scene;

use super::perception::{Sight, look};
use super::sources::{
    CORRIDOR_CM, FORWARD, LEVEL_ANGLE, LEVEL_DECEL, LEVEL_EXIT_ANGLE, LEVEL_GONE_MS, LEVEL_LEAST_SPEED, LEVEL_REST_MS,
    LEVEL_TTC_MS, PEDESTRIAN,
};
use super::view::{Held, View};

/// The levels that run, and the warnings.
#[derive(Clone, Copy, Debug, Default)]
pub struct Mitigation {
    latches: [bool; 3],
    gone: Held,
    rest: Held,
    /// Forward-collision warning.
    pub forward: bool,
    /// Pedestrian-collision warning.
    pub pedestrian: bool,
}

/// T < `limit`, in whole numbers: distance in cm, closing speed in cm/s, limit in ms.
fn earlier(object: &Sight, limit: i64) -> bool {
    object.closing > 0 && object.distance * 1000 < limit * object.closing
}

/// T ≤ `limit`.
fn earlier_or_at(object: &Sight, limit: i64) -> bool {
    object.closing > 0 && object.distance * 1000 <= limit * object.closing
}

impl Mitigation {
    /// One cycle. `by_driver` says whether the driver steers.
    pub fn update(&mut self, scene: &Scene, view: &View, by_driver: bool) {
        let objects = look(scene);
        let known = scene.radar_known && scene.camera_known;
        let ahead = || objects.iter().filter(|object| object.offset <= CORRIDOR_CM && object.certain);
        self.gone.update(known && !ahead().any(|object| object.closing > 0));
        self.rest.update(view.stands);

        let [one, two, three] = LEVEL_TTC_MS;
        let due = [
            ahead().any(|object| earlier(object, one)),
            ahead().any(|object| earlier_or_at(object, two)),
            ahead().any(|object| earlier_or_at(object, three)),
        ];
        let fast = view.speed.is_some_and(|speed| speed >= LEVEL_LEAST_SPEED);
        let over = self.rest.for_at_least(LEVEL_REST_MS);
        let gone = self.gone.for_at_least(LEVEL_GONE_MS);
        // Level 3 ends by neither the road nor the driver's steering: no exit angle.
        let exits = [Some(LEVEL_EXIT_ANGLE[0]), Some(LEVEL_EXIT_ANGLE[1]), None];
        for (((latch, due), least), exit) in self.latches.iter_mut().zip(due).zip(LEVEL_ANGLE).zip(exits) {
            let enters = due && fast && view.angle.is_some_and(|angle| angle < least);
            let steered = |limit| gone || (by_driver && view.angle.is_some_and(|angle| angle > limit));
            let leaves = over || exit.is_some_and(steered);
            *latch = enters || (*latch && !leaves);
        }

        let warn = |on: bool, pedestrian: bool, (begin, end, offset): (i64, i64, u16)| {
            let of_kind = |object: &&Sight| object.certain && object.pedestrian == pedestrian && object.offset < offset;
            let begins = objects.iter().filter(of_kind).any(|object| earlier(object, begin));
            let holds = !known || objects.iter().filter(of_kind).any(|object| earlier_or_at(object, end));
            begins || (on && holds)
        };
        self.forward = warn(self.forward, false, FORWARD);
        self.pedestrian = warn(self.pedestrian, true, PEDESTRIAN);
    }

    /// Any level runs: the accelerator has no effect.
    #[must_use]
    pub fn running(&self) -> bool {
        self.latches.contains(&true)
    }

    /// The deceleration asked for, in m/s².
    #[must_use]
    pub fn demand(&self) -> f64 {
        self.latches.iter().zip(LEVEL_DECEL).filter(|(on, _)| **on).map(|(_, decel)| decel).fold(0.0, f64::max)
    }
}
