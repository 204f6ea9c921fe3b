//! An ordinary driver: sees late, plans to stop with a comfortable deceleration, presses pedals.
//!
//! Sources of the form: stopping with constant deceleration (kinematics), following with a time gap (as in Gipps 1981 and in
//! Treiber's Intelligent Driver Model), a reaction time of half a second. The numbers are the and own.

use std::collections::VecDeque;

use rand_chacha::ChaCha8Rng;

use crate::disturb::between;
use crate::driver::Act;
use crate::plant::{Parameters, Plant, Truth};

/// How somebody drives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Style {
    /// Acceleration from a stop, in m/s².
    pub acceleration: f64,
    /// Deceleration for a stop, in m/s².
    pub deceleration: f64,
    /// Gap to come to rest with, in m.
    pub rest_gap: f64,
    /// Time gap to a car ahead, in s.
    pub time_gap: f64,
    /// Reaction time in cycles of 10 ms.
    pub reaction: usize,
    /// How wrong the feel for the pedals is, as a factor.
    pub feel: f64,
    /// Lateral acceleration in bends, in m/s².
    pub lateral: f64,
}

impl Style {
    /// One of many.
    pub fn drawn(random: &mut ChaCha8Rng) -> Self {
        let mut draw = |range| between(random, range);
        Self {
            acceleration: draw([0.6, 1.0]),
            deceleration: draw([0.5, 1.5]),
            rest_gap: draw([1.0, 4.0]),
            time_gap: draw([1.2, 2.2]),
            reaction: usize::try_from(crate::number::nearest(draw([30.0, 70.0]))).unwrap_or(50),
            feel: draw([0.9, 1.1]),
            lateral: draw([0.8, 1.5]),
        }
    }

    /// The next stop is another one.
    pub fn another_stop(&mut self, random: &mut ChaCha8Rng) {
        self.deceleration = between(random, [0.5, 1.5]);
        self.rest_gap = between(random, [1.0, 4.0]);
    }
}

/// What the driver has in mind.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Intent {
    /// Speed to drive, in m/s.
    pub speed: f64,
    /// Way to where the bus is to stand, in m.
    pub stop_in: Option<f64>,
    /// A slower speed in m/s that is due after this way in m.
    pub slow_down: Option<(f64, f64)>,
}

#[derive(Clone, Copy, Debug)]
struct Seen {
    /// Gap and speed of what is ahead.
    ahead: Option<(f64, f64)>,
}

/// The driver.
#[derive(Clone, Debug)]
pub struct Human {
    /// How this one drives.
    pub style: Style,
    seen: VecDeque<Seen>,
    /// Speed of what is ahead when it was last looked at, and how it changes, in m/s and m/s².
    last: Option<f64>,
    slows: f64,
    /// Brakes for a stop, or for what is ahead.
    braking: bool,
    cycles: u32,
    /// The foot is on: positive the accelerator, negative the brake, as shares.
    foot: f64,
}

/// The driver decides every so many cycles.
const DECIDES: u32 = 10;
/// Deceleration of the full brake pedal of the model, in m/s².
const PEDAL: f64 = 6.0;
/// Nobody brakes harder than this on an ordinary day; needing more, the day is not ordinary, in m/s².
const HARDEST: f64 = 2.5;

impl Human {
    /// Sits and looks.
    #[must_use]
    pub const fn new(style: Style) -> Self {
        Self { style, seen: VecDeque::new(), last: None, slows: 0.0, braking: false, cycles: 0, foot: -0.3 }
    }

    /// One cycle of 10 ms: looks, and moves the feet when it is time.
    pub fn drive(&mut self, plant: &mut Plant, intent: &Intent, parameters: &Parameters) {
        let truth = plant.truth();
        let ahead = truth.ahead.map(|ahead| (ahead.gap, truth.speed - ahead.closing));
        self.seen.push_back(Seen { ahead });
        let seen =
            if self.seen.len() > self.style.reaction { self.seen.pop_front() } else { self.seen.front().copied() };
        self.cycles = self.cycles.wrapping_add(1);
        if !self.cycles.is_multiple_of(DECIDES) {
            return;
        }
        let wanted = self.wanted(&truth, seen.and_then(|seen| seen.ahead), intent);
        self.press(plant, &truth, wanted, parameters);
    }

    /// The acceleration that the driver wants, in m/s².
    fn wanted(&mut self, truth: &Truth, ahead: Option<(f64, f64)>, intent: &Intent) -> f64 {
        let (speed, style) = (truth.speed, self.style);
        let change = ahead.zip(self.last).map_or(0.0, |((_, now), before)| (before - now) * 10.0);
        self.slows += (change - self.slows) * 0.3;
        self.last = ahead.map(|(_, speed)| speed);
        // Nobody runs up to a stop faster than it can be reached gently.
        let gentle = intent.stop_in.map_or(intent.speed, |way| intent.speed.min((1.2 * way.max(0.0)).sqrt()));
        let free = ((gentle - speed) * 0.5).clamp(-0.7, style.acceleration);
        if speed < 1.0 && intent.stop_in.is_some_and(|way| way < 0.6) {
            return -0.5;
        }

        // What each thing ahead needs, if it were braked for evenly from here.
        let mut needed = 0.0_f64;
        if let Some(way) = intent.stop_in {
            needed = needed.max(speed * speed / (2.0 * way.max(0.2)));
        }
        if let Some((slower, way)) = intent.slow_down {
            needed = needed.max((speed * speed - slower * slower) / (2.0 * way.max(0.5)));
        }
        let mut follow = free;
        if let Some((gap, theirs)) = ahead {
            // What is seen is a reaction time old; a driver reckons with the own approach since then.
            let since = f64::from(u32::try_from(style.reaction).unwrap_or(50)) / 100.0;
            let room = gap - (speed - theirs).max(0.0) * since - style.rest_gap;
            let stops = if self.slows > 0.3 { theirs * theirs / (2.0 * self.slows) } else { 0.0 };
            if theirs < 0.5 || self.slows > 0.3 {
                needed = needed.max(speed * speed / (2.0 * (room + stops).max(0.2)));
            }
            let keeps = room - theirs * style.time_gap;
            if speed > theirs && theirs >= 0.5 {
                let closing = speed - theirs;
                needed = needed.max(closing * closing / (2.0 * keeps.max(0.5)));
            }
            follow = (keeps * 0.08 + (theirs - speed) * 0.5).clamp(-0.8, free.max(-0.8));
            // Who stands close enough stays.
            if theirs < 0.3 && (room < 0.5 || (speed < 0.05 && room < 3.0)) {
                follow = -0.5;
            }
        }
        // Begins when the comfortable deceleration is needed, and sees it through.
        let begins = needed >= style.deceleration * 0.9;
        let goes_on = self.braking && needed > 0.25;
        self.braking = begins || goes_on;
        // Nobody brakes hard at the very end.
        let hardest = if speed < 2.0 { style.deceleration.max(1.0) } else { HARDEST };
        if self.braking { -needed.min(hardest) } else { free.min(follow) }
    }

    /// From an acceleration to the pedals.
    fn press(&mut self, plant: &mut Plant, truth: &Truth, wanted: f64, parameters: &Parameters) {
        let p = parameters;
        let drag = 9.81 * p.rolling + p.drag * truth.speed * truth.speed / p.mass_kg;
        let stands = truth.speed < 0.3 && wanted <= 0.0;
        let foot = if stands {
            -0.25
        } else if wanted > -drag {
            let force = (wanted * p.rotating + drag) * p.mass_kg * self.style.feel;
            (force / p.full_force_n).clamp(0.0, 0.95)
        } else {
            ((wanted + drag) / PEDAL * self.style.feel).max(-1.0)
        };
        // A foot that is where it should be is not moved.
        if (foot - self.foot).abs() > 0.004 || (foot >= 0.0) != (self.foot >= 0.0) {
            self.foot = foot;
            plant.act(Act::Accelerator(foot.max(0.0)));
            plant.act(Act::Brake((-foot).max(0.0)));
        }
    }
}
