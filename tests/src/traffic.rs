//! Others on the road: they come at their time, change speed and lane, and go.

use crate::bench::Hooks;
use crate::plant::{CYCLE_MS, Plant};
use crate::road::{Body, Obstacle};

/// Where somebody appears.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Place {
    /// So far from where the front of the bus was at time 0, in m.
    At(f64),
    /// So far ahead of the bus, in m.
    Gap(f64),
}

/// Something that somebody does from a time on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Move {
    /// When, in ms.
    pub at_ms: u32,
    /// What.
    pub way: Way,
}

/// A change of speed or lane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Way {
    /// Towards this speed in m/s, by so much in m/s².
    Speed(f64, f64),
    /// Towards this offset in m, by so much in m/s.
    Offset(f64, f64),
}

/// One of the others.
#[derive(Clone, Debug, PartialEq)]
pub struct Actor {
    /// What it is.
    pub body: Body,
    /// Where its rear appears.
    pub place: Place,
    /// When, in ms.
    pub from_ms: u32,
    /// When it is gone, in ms.
    pub until_ms: u32,
    /// Its speed at first, in m/s.
    pub speed: f64,
    /// Its offset at first, in m, left positive.
    pub offset: f64,
    /// What it does, in order of time.
    pub moves: Vec<Move>,
}

/// One of them as it drives.
#[derive(Clone, Copy, Debug)]
struct Driving {
    there: bool,
    speed: f64,
    offset: f64,
    /// Where to, and how fast.
    to_speed: (f64, f64),
    to_offset: (f64, f64),
    done: usize,
}

/// All of them, in the loop.
#[derive(Clone, Debug)]
pub struct Traffic {
    actors: Vec<Actor>,
    driving: Vec<Driving>,
}

impl Traffic {
    /// Nobody is there yet.
    #[must_use]
    pub fn new(actors: Vec<Actor>) -> Self {
        let waits = |actor: &Actor| Driving {
            there: false,
            speed: actor.speed,
            offset: actor.offset,
            to_speed: (actor.speed, 0.0),
            to_offset: (actor.offset, 0.0),
            done: 0,
        };
        Self { driving: actors.iter().map(waits).collect(), actors }
    }

    /// The places on the road that they need, empty at first.
    #[must_use]
    pub fn places(&self) -> Vec<Obstacle> {
        let empty = |actor: &Actor| Obstacle { body: actor.body, from_ms: u32::MAX, ..Obstacle::standing_car(0.0) };
        self.actors.iter().map(empty).collect()
    }

    /// Those who are there, as they truly are.
    #[must_use]
    pub fn others(&self, plant: &Plant) -> Vec<Other> {
        let all = self.actors.iter().zip(&self.driving).enumerate();
        all.filter_map(|(number, (actor, driving))| {
            Some(Other { gap: plant.gap_to(number)?, offset: driving.offset, width: actor.body.width })
        })
        .collect()
    }
}

/// One of the others, as it truly is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Other {
    /// How far its rear is ahead of the bus, in m.
    pub gap: f64,
    /// Its middle from that of the bus, in m, left positive.
    pub offset: f64,
    /// How wide it is, in m.
    pub width: f64,
}

/// One cycle towards a goal.
fn towards(value: f64, (goal, rate): (f64, f64)) -> f64 {
    let step = rate.abs() * f64::from(CYCLE_MS) / 1000.0;
    value + (goal - value).clamp(-step, step)
}

impl Hooks for Traffic {
    fn vehicle(&mut self, _now_ms: u32, plant: &mut Plant) {
        // The cycle at hand begins where the model has stopped.
        let now_ms = plant.now_ms();
        for (number, (actor, driving)) in self.actors.iter().zip(&mut self.driving).enumerate() {
            if now_ms < actor.from_ms || now_ms >= actor.until_ms {
                if std::mem::take(&mut driving.there) {
                    plant.take_away(number);
                }
                continue;
            }
            if !driving.there {
                driving.there = true;
                let gap = match actor.place {
                    Place::Gap(gap) => gap,
                    Place::At(place) => place - plant.truth().position,
                };
                plant.bring(number, actor.body, gap, driving.speed, driving.offset);
            }
            while let Some(next) = actor.moves.get(driving.done).filter(|next| next.at_ms <= now_ms) {
                match next.way {
                    Way::Speed(goal, rate) => driving.to_speed = (goal, rate),
                    Way::Offset(goal, rate) => driving.to_offset = (goal, rate),
                }
                driving.done += 1;
            }
            let speed = towards(driving.speed, driving.to_speed);
            let offset = towards(driving.offset, driving.to_offset);
            if speed.to_bits() != driving.speed.to_bits() || offset.to_bits() != driving.offset.to_bits() {
                (driving.speed, driving.offset) = (speed, offset);
                plant.drive(number, speed, offset);
            }
        }
    }
}
