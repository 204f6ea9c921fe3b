//! What came of a run, from the truth of the bus alone: which safety goal is violated, since when?
//!
//! A goal is *endangered* in a cycle if the condition of its hazard holds there (`hazards.toml`, and `ftti_from` of the
//! goal); it is *violated* when that lasts longer than its FTTI. What the supervisor says is not looked at. What can not be
//! undone (an arc, a collision, a jump of the wheel) counts as lasting.

use std::collections::BTreeMap;

use supervisor::{Class, ContactorRequest, EpbRequest, EpbState, EpbSwitch, Gear};

use super::parked::Parked;
use super::wheel::Wheel;
use crate::drive::Cycle;
use crate::number::kmh;
use crate::plant::{CYCLE_MS, Truth};

/// A safety goal of `goals.toml`: `SG-01` is 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Goal(pub u8);

impl Goal {
    /// The one that a fault of the supervisor itself endangers by being there.
    pub const OF_THE_SUPERVISOR: Self = Self(13);
}

/// Every goal with its FTTI in ms.
pub type Ftti = BTreeMap<Goal, u32>;

/// A goal is violated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Harm {
    /// Which.
    pub goal: Goal,
    /// Since when its condition held, in ms: the FTTI counts from here.
    pub from_ms: u32,
}

/// Torque beyond what the driver allows counts from this share (the map's tolerance of 5 %, and as much for the lag).
const TORQUE_TOLERANCE: f64 = 0.1;
/// What the driver's feet allowed so long ago still counts: lags of pedal, link and drive, in ms.
const TORQUE_MEMORY_MS: u32 = 300;
/// Greatest torque of a granted cruise control, as a share (S2; the bound of the mode).
const CRUISE_SHARE: f64 = 0.65;
/// S3 §2.1: an empty seat is leave after this time, in ms.
const LEAVE_MS: u32 = 2000;
/// S3 table 1: the least of a moving bus, and what it falls short by at most (S4: 15 %), in m/s².
const LEAVE_DECEL: f64 = 1.35 * 0.85;
/// A brake that falls short for so long in leave may be helped by the parking brake (RSP-1: 700 ms to respond), in ms.
const SHORTFALL_MS: u32 = 700;
/// PHB-1's cap in m/s² and 5 % for the build-up of a brake.
const COMFORT_DECEL: f64 = 3.5 * 1.05;
/// S1 §3.1.2: time to collision in s and deceleration in m/s² of the three levels, the most severe first.
const LEVELS: [(f64, f64); 3] = [(2.7, 5.0), (3.6, 2.5), (4.4, 1.0)];
/// Ahead of the bus nothing up to here: the road is clear, in m.
const CLEAR_M: f64 = 100.0;

/// Looks at the cycles of a run one after the other.
#[derive(Clone, Debug)]
pub struct Watch {
    ftti: Ftti,
    since: BTreeMap<Goal, u32>,
    harms: Vec<Harm>,
    empty_ms: u32,
    /// What the driver allowed: torque as a share, and how long it still counts.
    allowed: (f64, u32),
    cruise: bool,
    braked_ms: u32,
    parked: Parked,
    wheel: Wheel,
    /// How long the brake of this leave has fallen short, at most, in ms.
    short_ms: u32,
    longest_short_ms: u32,
    collided: bool,
    wrong_gear: bool,
    arc: bool,
    /// What is judged begins here, in ms.
    start_ms: u32,
    before: Option<Truth>,
}

impl Watch {
    /// Nothing seen yet.
    #[must_use]
    pub fn new(ftti: Ftti) -> Self {
        Self {
            ftti,
            since: BTreeMap::new(),
            harms: Vec::new(),
            empty_ms: 0,
            allowed: (0.0, 0),
            cruise: false,
            braked_ms: 0,
            parked: Parked::default(),
            wheel: Wheel::default(),
            short_ms: 0,
            longest_short_ms: 0,
            collided: false,
            wrong_gear: false,
            arc: false,
            start_ms: 0,
            before: None,
        }
    }

    /// The goals that are violated, each with the begin of the first time.
    #[must_use]
    pub fn harms(&self) -> &[Harm] {
        &self.harms
    }

    /// Forgets what was violated and what holds, for a run that goes on from this time; what the driver did is kept.
    pub fn forget(&mut self, start_ms: u32) {
        self.start_ms = start_ms;
        self.since.clear();
        self.harms.clear();
        (self.collided, self.wrong_gear, self.arc) = (false, false, false);
    }

    /// One cycle.
    pub fn see(&mut self, cycle: &Cycle) {
        let truth = &cycle.truth;
        self.empty_ms = if truth.seat == [false; 2] { self.empty_ms.saturating_add(CYCLE_MS) } else { 0 };
        self.driver(truth);
        self.parked.see(truth, self.empty_ms > 0);
        self.wheel.see(truth);
        self.last(truth);
        self.shortfall(truth);
        let endangered = [
            (Goal(1), self.torque(truth)),
            (Goal(2), self.no_brake(truth)),
            (Goal(3), self.collided || missing(truth)),
            (Goal(4), phantom(truth)),
            (Goal(5), self.rolls_away(cycle)),
            (Goal(6), self.parked.live(truth)),
            (Goal(7), self.arc || wrong_contactor(cycle)),
            (Goal(8), powerless(cycle)),
            (Goal(9), self.wheel.ran_away()),
            (Goal(10), self.wrong_gear || self.against_selector(truth)),
            (Goal(11), self.parking_at_speed(cycle)),
            (Goal(12), self.dark(cycle)),
        ];
        for (goal, holds) in endangered {
            self.note(goal, holds, cycle.now_ms);
        }
        self.before = Some(*truth);
    }

    fn note(&mut self, goal: Goal, holds: bool, now_ms: u32) {
        if !holds {
            self.since.remove(&goal);
            return;
        }
        let mut from_ms = *self.since.entry(goal).or_insert(now_ms);
        let ftti = self.ftti.get(&goal).copied().unwrap_or(0);
        // The way of the wheel is measured over its whole FTTI already.
        let over = goal == Goal(9) || now_ms.saturating_sub(from_ms) > ftti;
        if goal == Goal(9) {
            from_ms = from_ms.saturating_sub(Wheel::SPAN_MS).max(self.start_ms);
        }
        if over && !self.harms.iter().any(|harm| harm.goal == goal) {
            self.harms.push(Harm { goal, from_ms });
        }
    }

    /// What the driver's feet and switches allow.
    fn driver(&mut self, truth: &Truth) {
        let hands = &truth.hands;
        let pressed = hands.brake > 0.05;
        self.braked_ms = if pressed { self.braked_ms.saturating_add(CYCLE_MS) } else { 0 };
        self.cruise = hands.cruise && !pressed && self.empty_ms == 0 && (self.cruise || hands.set);
        let now = if pressed { 0.0 } else { hands.accelerator.max(if self.cruise { CRUISE_SHARE } else { 0.0 }) };
        let (kept, left) = self.allowed;
        self.allowed =
            if now >= kept || left == 0 { (now, TORQUE_MEMORY_MS) } else { (kept, left.saturating_sub(CYCLE_MS)) };
    }

    /// What can not be undone.
    fn last(&mut self, truth: &Truth) {
        let speed = truth.speed.abs();
        self.collided |= truth.ahead.is_some_and(|ahead| ahead.gap <= 0.0) && speed > kmh(1.0);
        let against = match truth.gear {
            Gear::Park => true,
            Gear::Reverse => truth.speed > 0.0,
            Gear::Drive => truth.speed < 0.0,
            Gear::Neutral => false,
        };
        self.wrong_gear |= against && speed > kmh(2.0);
        if let Some(before) = &self.before {
            let [k1_was, k4_was] = before.closed;
            let [k1, k4] = truth.closed;
            let k1_opens = k1_was && !k1 && (k4 || before.current.abs() > 5.0);
            let k4_opens = k4_was && !k4 && before.torque > 0.02;
            let k4_closes_first = !k4_was && k4 && !k1;
            self.arc |= k1_opens || k4_opens || k4_closes_first;
        }
    }

    /// HZ-01: more torque than the driver or a granted mode allows; none in leave.
    fn torque(&self, truth: &Truth) -> bool {
        let (allowed, _) = self.allowed;
        let allowed = if self.empty_ms > LEAVE_MS || self.braked_ms > TORQUE_MEMORY_MS { 0.0 } else { allowed };
        truth.torque > allowed + TORQUE_TOLERANCE
    }

    /// HZ-02b: the bus rolls without its driver, and is not braked.
    fn no_brake(&self, truth: &Truth) -> bool {
        self.empty_ms > LEAVE_MS && truth.speed.abs() > kmh(2.0) && truth.braking < LEAVE_DECEL
    }

    /// For how long the brake has fallen short in this leave.
    fn shortfall(&mut self, truth: &Truth) {
        self.short_ms = if self.no_brake(truth) { self.short_ms.saturating_add(CYCLE_MS) } else { 0 };
        self.longest_short_ms = if self.empty_ms == 0 { 0 } else { self.longest_short_ms.max(self.short_ms) };
    }

    /// HZ-04: nobody sits and nothing holds the bus; or its parking brake is let go.
    fn rolls_away(&self, cycle: &Cycle) -> bool {
        let truth = &cycle.truth;
        let held = truth.epb == Some(EpbState::Applied) || truth.braking > 1.0;
        let released =
            self.parked.let_go() || (self.empty_ms > 0 && cycle.answer.outputs.epb.request == EpbRequest::Release);
        released || (self.empty_ms > LEAVE_MS && truth.speed.abs() < kmh(2.0) && !held)
    }

    /// HZ-09a: the drive works in a direction that the driver has not selected.
    fn against_selector(&self, truth: &Truth) -> bool {
        let driving = matches!(truth.gear, Gear::Drive | Gear::Reverse);
        driving && truth.gear != truth.hands.selector && truth.torque > 0.03 && self.empty_ms == 0
    }

    /// HZ-10: the parking brake acts, or is told to, while the bus drives; not by the driver's switch, and not after the
    /// service brake fell short in leave.
    fn parking_at_speed(&self, cycle: &Cycle) -> bool {
        let truth = &cycle.truth;
        let told = cycle.answer.outputs.epb.request == EpbRequest::Apply || truth.epb != Some(EpbState::Released);
        let by_driver = truth.hands.epb_switch == EpbSwitch::Apply;
        told && !by_driver && truth.speed.abs() > kmh(3.0) && self.longest_short_ms < SHORTFALL_MS
    }

    /// HZ-11: braking without lamps; leave without warning; an obstacle near without warning.
    fn dark(&self, cycle: &Cycle) -> bool {
        let (truth, outputs) = (&cycle.truth, &cycle.answer.outputs);
        let moves = truth.speed.abs() > kmh(2.0);
        let brakes = outputs.brake.total.raw() >= 2048 && !outputs.body.brake_lamps && moves;
        let parked = truth.epb == Some(EpbState::Applied) && !moves;
        let leaves = self.empty_ms > LEAVE_MS && !parked;
        let silent = leaves && !(outputs.warnings.seat_leave && outputs.warnings.hazard_flashers);
        let near = truth.speed > kmh(10.0)
            && truth.ahead.is_some_and(|ahead| {
                let warned = match ahead.class {
                    Class::Pedestrian => outputs.warnings.pedestrian,
                    Class::Object | Class::Unclassified => outputs.warnings.forward_collision,
                };
                ahead.closing > 0.0 && ahead.gap < 4.0 * ahead.closing && !warned
            });
        brakes || silent || near
    }
}

/// HZ-02c: an obstacle is within the time to collision of a level, and the bus brakes less than that level, and less than
/// it takes to stop before it.
fn missing(truth: &Truth) -> bool {
    let Some(ahead) = truth.ahead.filter(|ahead| ahead.closing > 0.0 && truth.speed > kmh(10.0)) else {
        return false;
    };
    let level = LEVELS.iter().find(|(time, _)| ahead.gap < time * ahead.closing).map_or(0.0, |(_, decel)| *decel);
    let enough = ahead.closing * ahead.closing / (2.0 * (ahead.gap - 1.0).max(0.1));
    truth.braking < 0.85 * level.min(enough)
}

/// HZ-03: the bus brakes harder than standing passengers bear, the road is clear and the driver has not asked for it.
fn phantom(truth: &Truth) -> bool {
    let clear = truth.ahead.is_none_or(|ahead| ahead.gap > CLEAR_M || ahead.closing <= 0.0);
    let by_driver = truth.hands.brake * 6.0;
    clear && truth.braking > COMFORT_DECEL.max(by_driver + 0.3) && truth.speed.abs() > kmh(3.0)
}

/// HZ-06: K1 goes, or is told to go, before K4.
fn wrong_contactor(cycle: &Cycle) -> bool {
    let [k1, k4] = cycle.truth.closed;
    k4 && (!k1 || cycle.answer.outputs.contactors.k1 == ContactorRequest::Open)
}

/// HZ-05: high voltage or an auxiliary goes while the bus rolls.
fn powerless(cycle: &Cycle) -> bool {
    let auxiliaries = cycle.answer.outputs.auxiliaries;
    let off = !(auxiliaries.air_pump && auxiliaries.power_steering && auxiliaries.dc_dc);
    cycle.truth.speed.abs() > kmh(3.0) && (cycle.truth.closed != [true; 2] || off)
}
