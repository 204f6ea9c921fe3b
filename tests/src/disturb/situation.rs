//! What a randomised run drives into: one of a few everyday and dangerous situations, with numbers from a seed.

use rand_chacha::ChaCha8Rng;

use super::between;
use crate::driver::Act;
use crate::number::kmh;
use crate::road::Body;
use crate::traffic::{Actor, Move, Place, Way};

/// What stands or happens ahead.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    /// Nothing.
    Clear,
    /// Cars are parked beside the lane.
    Beside,
    /// A car drives ahead, as fast or faster.
    Following,
    /// A car stands in the lane, the driver brakes in time.
    Stopping,
    /// A car stands in the lane, the driver does nothing.
    Standing,
    /// A car drives ahead, slower.
    Slower,
    /// The car ahead brakes to a standstill.
    Braking,
    /// A pedestrian steps out.
    Pedestrian,
    /// A car cuts in.
    CutIn,
    /// The driver gets up.
    Leave,
}

impl Kind {
    /// Every one, with its name and whether it endangers nobody: a level that begins in such a one is a false trigger.
    pub const ALL: [(Self, &'static str, bool); 10] = [
        (Self::Clear, "clear road", true),
        (Self::Beside, "parked cars beside the lane", true),
        (Self::Following, "behind a car that is as fast", true),
        (Self::Stopping, "the driver brakes for a standing car", false),
        (Self::Standing, "a standing car, no driver", false),
        (Self::Slower, "a slower car", false),
        (Self::Braking, "the car ahead brakes", false),
        (Self::Pedestrian, "a pedestrian steps out", false),
        (Self::CutIn, "a car cuts in", false),
        (Self::Leave, "the driver gets up", true),
    ];

    /// Its name.
    #[must_use]
    pub fn name(self) -> &'static str {
        Self::ALL.iter().find(|(kind, ..)| *kind == self).map_or("", |(_, name, _)| name)
    }
}

/// A situation: the others, and what the driver does.
#[derive(Clone, Debug, Default)]
pub struct Situation {
    /// The others.
    pub actors: Vec<Actor>,
    /// What the driver does, in order of time.
    pub acts: Vec<(u32, Act)>,
}

/// What happens begins so long after the begin of a run, in ms.
const BEGINS_MS: u32 = 1000;

fn car(from_ms: u32, gap: f64, speed: f64, offset: f64, moves: Vec<Move>) -> Actor {
    Actor { body: Body::CAR, place: Place::Gap(gap), from_ms, until_ms: u32::MAX, speed, offset, moves }
}

/// Numbers of this kind for a bus that drives so fast (in m/s) from this time on. Ranges are own.
#[must_use]
pub fn situation(kind: Kind, start_ms: u32, speed: f64, random: &mut ChaCha8Rng) -> Situation {
    let begins = start_ms.saturating_add(BEGINS_MS);
    let after = |ms: u32| begins.saturating_add(ms);
    let mut draw = |range: [f64; 2]| between(random, range);
    let mut found = Situation::default();
    match kind {
        Kind::Clear => {}
        Kind::Beside => {
            let side = if draw([0.0, 1.0]) < 0.5 { -1.0 } else { 1.0 };
            let gap = draw([30.0, 70.0]);
            for place in [0.0, 8.0, 16.0] {
                found.actors.push(car(begins, gap + place, 0.0, side * draw([2.5, 4.0]), Vec::new()));
            }
        }
        Kind::Following => {
            let faster = draw([0.0, 3.0]);
            found.actors.push(car(
                begins,
                speed * draw([1.5, 3.0]) + 3.0,
                speed + faster,
                draw([-0.5, 0.5]),
                Vec::new(),
            ));
        }
        Kind::Stopping => {
            let (decel, rest) = (draw([0.8, 1.5]), draw([1.5, 5.0]));
            let gap = speed * speed / (2.0 * decel) + rest + speed * 0.6;
            found.actors.push(car(begins, gap, 0.0, draw([-0.4, 0.4]), Vec::new()));
            found.acts = vec![(begins, Act::Accelerator(0.0)), (after(100), Act::Brake((decel - 0.08) / 6.0))];
        }
        Kind::Standing => found.actors.push(car(begins, speed * draw([5.0, 7.0]), 0.0, draw([-0.5, 0.5]), Vec::new())),
        Kind::Slower => {
            let slower = speed * draw([0.2, 0.7]);
            found.actors.push(car(
                begins,
                (speed - slower) * draw([5.0, 7.0]) + 3.0,
                slower,
                draw([-0.5, 0.5]),
                Vec::new(),
            ));
        }
        Kind::Braking => {
            let (decel, gap) = (draw([1.5, 4.0]), speed * draw([1.8, 3.0]) + 3.0);
            let moves = vec![Move { at_ms: after(2000), way: Way::Speed(0.0, decel) }];
            found.actors.push(car(begins, gap, speed, draw([-0.5, 0.5]), moves));
        }
        Kind::Pedestrian => found.actors.push(Actor {
            body: Body::PEDESTRIAN,
            offset: draw([-0.8, 0.8]),
            ..car(begins, speed * draw([2.2, 4.0]), 0.0, 0.0, Vec::new())
        }),
        Kind::CutIn => {
            let (slower, side) = (draw([0.0, 5.0]), if draw([0.0, 1.0]) < 0.5 { -3.3 } else { 3.3 });
            let moves = vec![Move { at_ms: after(500), way: Way::Offset(0.0, draw([0.8, 1.6])) }];
            found.actors.push(car(begins, draw([12.0, 30.0]), (speed - slower).max(kmh(5.0)), side, moves));
        }
        Kind::Leave => found.acts = vec![(begins, Act::Accelerator(0.0)), (after(300), Act::Sit(false))],
    }
    found
}
