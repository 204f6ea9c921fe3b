//! What a day brings, piece by piece: stops, queues, cars ahead that brake or turn off, narrow streets, bends, cut-ins.
//! Every number is drawn from a seed; ranges are own, for a city with 30 to 50 km/h.

use rand::Rng;
use rand_chacha::ChaCha8Rng;

use crate::bend::Bend;
use crate::disturb::between;
use crate::number::kmh;
use crate::road::Body;

/// A piece of the day.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Piece {
    /// A free road.
    Free,
    /// A stop without anything ahead.
    Stop,
    /// A bay in which another bus stands already.
    Bay,
    /// A queue at a red light, that creeps and then goes.
    Queue,
    /// A car ahead that is now faster, now slower, and stops once.
    Behind,
    /// A car ahead that brakes and turns off.
    TurnsOff,
    /// Cars parked on both sides of a narrow street.
    Narrow,
    /// A bend with cars parked in it and behind it.
    Bend,
    /// A car that cuts in.
    CutIn,
    /// A pedestrian crosses far enough ahead; the driver waits.
    Crossing,
}

impl Piece {
    /// Every one, with its name and how often it comes.
    pub const ALL: [(Self, &'static str, u32); 10] = [
        (Self::Free, "free road", 2),
        (Self::Stop, "stop", 4),
        (Self::Bay, "stop bay behind a bus", 2),
        (Self::Queue, "queue", 4),
        (Self::Behind, "behind a car", 3),
        (Self::TurnsOff, "the car ahead turns off", 2),
        (Self::Narrow, "narrow street", 2),
        (Self::Bend, "bend past parked cars", 4),
        (Self::CutIn, "cut-in", 2),
        (Self::Crossing, "pedestrian crosses", 2),
    ];

    /// Its name.
    #[must_use]
    pub fn name(self) -> &'static str {
        Self::ALL.iter().find(|(piece, ..)| *piece == self).map_or("", |(_, name, _)| name)
    }

    /// The next one.
    pub fn drawn(random: &mut ChaCha8Rng) -> Self {
        let all: u32 = Self::ALL.iter().map(|(.., weight)| weight).sum();
        let mut rest = random.random_range(0..all);
        for (piece, _, weight) in Self::ALL {
            match rest.checked_sub(weight) {
                Some(less) => rest = less,
                None => return piece,
            }
        }
        Self::Free
    }
}

/// What the one ahead does next.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    /// Towards this speed in m/s ...
    pub speed: f64,
    /// ... by so much in m/s² ...
    pub by: f64,
    /// ... and this offset in m, by so much in m/s ...
    pub offset: (f64, f64),
    /// ... for so long in ms.
    pub for_ms: u32,
}

/// Something that stands beside or on the road.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Standing {
    /// What.
    pub body: Body,
    /// How far ahead, in m.
    pub gap: f64,
    /// Its offset in m.
    pub offset: f64,
}

/// Who is ahead: what and where, speed in m/s, and what it does.
pub type Lead = (Standing, f64, Vec<Step>);

/// Everything about one piece.
#[derive(Clone, Debug, Default)]
pub struct Plan {
    /// How long it is, in m.
    pub length: f64,
    /// The speed that is driven, in m/s.
    pub speed: f64,
    /// Where the bus is to stop, in m from its begin, and for how long in ms.
    pub stop: Option<(f64, u32)>,
    /// Who is ahead.
    pub lead: Option<Lead>,
    /// What stands there.
    pub standing: Vec<Standing>,
    /// Its bend, from its begin.
    pub bend: Option<Bend>,
    /// The speed in it, in m/s.
    pub bend_speed: f64,
}

fn step(speed: f64, by: f64, for_ms: u32) -> Step {
    Step { speed, by, offset: (0.0, 10.0), for_ms }
}

/// Milliseconds between two times in s.
fn wait(random: &mut ChaCha8Rng, least: u32, most: u32) -> u32 {
    random.random_range(least * 1000..=most * 1000)
}

/// A car ahead, so far away and so fast, and what it does.
fn car(gap: f64, speed: f64, steps: Vec<Step>) -> Lead {
    (Standing { body: Body::CAR, gap, offset: 0.0 }, speed, steps)
}

/// Drives off for good.
fn away() -> Step {
    step(kmh(60.0), 1.5, 20_000)
}

/// Left or right.
fn side(random: &mut ChaCha8Rng) -> f64 {
    if random.random_bool(0.5) { -1.0 } else { 1.0 }
}

/// Draws one for a bus that drives so fast (in m/s) when it begins, and a driver who likes so much lateral acceleration.
pub fn plan(piece: Piece, now: f64, lateral: f64, random: &mut ChaCha8Rng) -> Plan {
    let speed = kmh(between(random, [28.0, 48.0]));
    let free = Plan { length: between(random, [80.0, 250.0]), speed, ..Plan::default() };
    match piece {
        Piece::Free => free,
        Piece::Stop => {
            let at = between(random, [120.0, 300.0]);
            Plan { length: at + 30.0, stop: Some((at, wait(random, 4, 12))), ..free }
        }
        Piece::Bay => bay(free, random),
        Piece::Queue => queue(free, random),
        Piece::Behind => behind(free, now, random),
        Piece::TurnsOff => turns_off(free, now, random),
        Piece::Narrow => narrow(free, random),
        Piece::Bend => bend(free, lateral, random),
        Piece::CutIn => cut_in(free, now, random),
        Piece::Crossing => crossing(free, random),
    }
}

fn bay(free: Plan, random: &mut ChaCha8Rng) -> Plan {
    let (at, rest) = (between(random, [130.0, 250.0]), between(random, [1.5, 4.0]));
    // It comes in front while the own bus swings in.
    let bus = Standing { body: Body::BUS, gap: at + rest, offset: 3.2 };
    let dwell = wait(random, 5, 12);
    let steps = vec![Step { speed: 0.0, by: 1.0, offset: (3.2, 1.0), for_ms: u32::MAX }];
    Plan { length: at + 10.0, stop: Some((at, dwell)), lead: Some((bus, 0.0, steps)), ..free }
}

fn queue(free: Plan, random: &mut ChaCha8Rng) -> Plan {
    let gap = between(random, [110.0, 220.0]);
    let mut steps = vec![step(0.0, 2.0, wait(random, 25, 35))];
    for _ in 0..random.random_range(0..4_u8) {
        let creep = kmh(between(random, [5.0, 12.0]));
        steps.push(step(creep, 1.0, wait(random, 2, 4)));
        steps.push(step(0.0, between(random, [0.8, 2.0]), wait(random, 4, 9)));
    }
    steps.push(away());
    Plan { length: gap + 60.0, lead: Some(car(gap, 0.0, steps)), ..free }
}

fn behind(free: Plan, now: f64, random: &mut ChaCha8Rng) -> Plan {
    let gap = now * between(random, [1.6, 2.6]) + 6.0;
    let mut steps = vec![step(now.max(kmh(20.0)), 1.0, 4000)];
    for _ in 0..random.random_range(2..6_u8) {
        let (speed, by) = (kmh(between(random, [15.0, 50.0])), between(random, [0.4, 1.5]));
        steps.push(step(speed, by, wait(random, 4, 10)));
    }
    steps.push(step(0.0, between(random, [0.8, 2.0]), wait(random, 10, 20)));
    steps.push(away());
    Plan { length: 500.0, lead: Some(car(gap, now.max(kmh(10.0)), steps)), ..free }
}

fn turns_off(free: Plan, now: f64, random: &mut ChaCha8Rng) -> Plan {
    let gap = now * between(random, [1.6, 2.4]) + 6.0;
    let slow = kmh(between(random, [10.0, 18.0]));
    let aside = if random.random_bool(0.7) { -6.0 } else { 6.0 };
    let turns = Step { speed: slow, by: 1.0, offset: (aside, between(random, [1.0, 2.0])), for_ms: 6000 };
    let brakes = step(slow, between(random, [1.0, 2.0]), wait(random, 4, 6));
    let steps = vec![step(now.max(kmh(20.0)), 1.0, 4000), brakes, turns];
    Plan { length: 300.0, lead: Some(car(gap, now.max(kmh(10.0)), steps)), ..free }
}

fn narrow(free: Plan, random: &mut ChaCha8Rng) -> Plan {
    let mut standing = Vec::new();
    for number in 0..5_u8 {
        let gap = 50.0 + f64::from(number) * between(random, [6.0, 14.0]);
        let beside = if number % 2 == 0 { -1.0 } else { 1.0 };
        standing.push(Standing { body: Body::CAR, gap, offset: beside * between(random, [2.5, 3.2]) });
    }
    Plan { length: 160.0, speed: kmh(between(random, [20.0, 32.0])), standing, ..free }
}

fn bend(free: Plan, lateral: f64, random: &mut ChaCha8Rng) -> Plan {
    let (radius, side) = (between(random, [14.0, 80.0]), side(random));
    let from = between(random, [70.0, 120.0]);
    let until = from + radius * between(random, [0.5, 1.57]);
    let mut standing = Vec::new();
    for number in 0..5_u8 {
        let gap = from + f64::from(number) * between(random, [5.0, 12.0]);
        // More often on the outer side, where they are straight ahead before the bus turns in.
        let beside = if number % 3 == 2 { side } else { -side };
        standing.push(Standing { body: Body::CAR, gap, offset: beside * between(random, [2.6, 3.6]) });
    }
    let bend = Some(Bend { from, until, curvature: side / radius });
    let bend_speed = (lateral * radius).sqrt().min(free.speed);
    Plan { length: until + 40.0, standing, bend, bend_speed, ..free }
}

fn cut_in(free: Plan, now: f64, random: &mut ChaCha8Rng) -> Plan {
    let speed = (now + kmh(between(random, [-3.0, 10.0]))).max(kmh(15.0));
    let aside = 3.3 * side(random);
    let what = Standing { body: Body::CAR, gap: between(random, [10.0, 25.0]), offset: aside };
    let beside = Step { speed, by: 1.0, offset: (aside, 1.0), for_ms: 1500 };
    let comes = Step { speed, by: 1.0, offset: (0.0, between(random, [0.7, 1.4])), for_ms: 6000 };
    let steps = vec![beside, comes, step(kmh(between(random, [30.0, 50.0])), 1.0, 8000), away()];
    Plan { length: 300.0, lead: Some((what, speed, steps)), ..free }
}

fn crossing(free: Plan, random: &mut ChaCha8Rng) -> Plan {
    let (at, aside) = (between(random, [110.0, 180.0]), 4.5 * side(random));
    let walker = Standing { body: Body::PEDESTRIAN, gap: at + between(random, [2.0, 4.0]), offset: aside };
    let waits = Step { speed: 0.0, by: 1.0, offset: (aside, 1.0), for_ms: u32::MAX };
    let walks = Step { speed: 0.0, by: 1.0, offset: (-aside, 1.3), for_ms: 7500 };
    // The driver has seen that somebody wants to cross, and stops; who walks has seen the bus slow down.
    let stop = Some((at, wait(random, 7, 10)));
    Plan { length: at + 30.0, stop, lead: Some((walker, 0.0, vec![waits, walks])), ..free }
}
