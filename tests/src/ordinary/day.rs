//! A piece of a day in the loop, and what came of it.

use std::collections::{BTreeMap, VecDeque};

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use supervisor::{Level, Reason, Sealed};

use super::human::{Human, Intent, Style};
use super::route::{Piece, Plan, Step, plan};
use crate::bench::{Bench, Hooks};
use crate::bend::{Bend, road_at, wheel};
use crate::controller::Controller;
use crate::disturb::seed_of;
use crate::drive::{Cycle, Scenario};
use crate::driver::{Act, Script, after_start};
use crate::judge::{Counter, Stretch};
use crate::plant::{CYCLE_MS, Parameters, Plant};
use crate::road::Obstacle;

const START: Script<'static> = after_start![(10_050, Act::Brake(0.3)),];
/// The day begins when the bus is ready, in ms.
const READY_MS: u32 = 10_500;
/// Places on the road: who is ahead, and what stands there, of this piece and of the one before.
const LEAD: usize = 0;
/// See [`LEAD`].
const STANDING: [usize; 2] = [1, 6];
/// See [`LEAD`].
const PLACES: [Obstacle; 11] = [Obstacle { from_ms: u32::MAX, ..Obstacle::standing_car(0.0) }; 11];
/// A day that takes longer than this for each m has got stuck, in ms.
const SLOWEST_MS: u32 = 700;
/// A stop bay: the other bus is in front from so far on, and the own bus has swung in at so much less, in m.
const BAY: [f64; 2] = [25.0, 10.0];

/// Something that disturbed the driver.
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    /// What the supervisor did.
    pub stretch: Stretch,
    /// Why.
    pub reason: Reason,
    /// In which piece of the day.
    pub piece: Piece,
    /// Speed in m/s when it began.
    pub speed: f64,
    /// Gap and closing speed of what was ahead in the lane.
    pub ahead: Option<(f64, f64)>,
    /// Deceleration of the bus in m/s² when it began.
    pub deceleration: f64,
}

/// What came of a day.
#[derive(Clone, Debug, Default)]
pub struct Day {
    /// The way, in m.
    pub metres: f64,
    /// How long it took, in ms.
    pub took_ms: u32,
    /// How often the bus came to rest.
    pub stops: usize,
    /// How often each piece came.
    pub pieces: BTreeMap<Piece, usize>,
    /// Every intervention.
    pub cases: Vec<Case>,
    /// How often a level began, by the highest that it reached.
    pub levels: BTreeMap<Level, usize>,
    /// How often the forward-collision or pedestrian warning came on.
    pub warnings: usize,
    /// Stops in which the driver needed more than 2 m/s²: not so ordinary.
    pub hard: usize,
    /// The driver ran into something: the model of the driver is wrong there.
    pub collisions: usize,
}

/// The day in the loop: the road ahead, and the driver.
struct Route {
    random: ChaCha8Rng,
    human: Human,
    parameters: Parameters,
    piece: Piece,
    plan: Plan,
    /// Where the piece began, in m.
    from: f64,
    /// How long the bus has stood where it was to stop, in ms.
    stood_ms: u32,
    served: bool,
    steps: VecDeque<Step>,
    step_ms: u32,
    lead: (f64, f64),
    leads: bool,
    half: usize,
    bends: Vec<Bend>,
    begun: bool,
    count: BTreeMap<Piece, usize>,
}

impl Route {
    fn new(seed: u64, parameters: Parameters) -> Self {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let human = Human::new(Style::drawn(&mut random));
        Self {
            random,
            human,
            parameters,
            piece: Piece::Free,
            plan: Plan::default(),
            from: 0.0,
            stood_ms: 0,
            served: true,
            steps: VecDeque::new(),
            step_ms: 0,
            lead: (0.0, 0.0),
            leads: false,
            half: 0,
            bends: Vec::new(),
            begun: false,
            count: BTreeMap::new(),
        }
    }

    /// The next piece of the day.
    fn next(&mut self, plant: &mut Plant) {
        let truth = plant.truth();
        self.piece = if self.begun { Piece::drawn(&mut self.random) } else { Piece::Free };
        self.begun = true;
        self.human.style.another_stop(&mut self.random);
        self.plan = plan(self.piece, truth.speed, self.human.style.lateral, &mut self.random);
        *self.count.entry(self.piece).or_default() += 1;
        (self.from, self.stood_ms, self.served) = (truth.position, 0, self.plan.stop.is_none());
        plant.take_away(LEAD);
        self.leads = false;
        if let Some((what, speed, steps)) = &self.plan.lead {
            plant.bring(LEAD, what.body, what.gap, *speed, what.offset);
            self.lead = (*speed, what.offset);
            (self.steps, self.step_ms, self.leads) = (steps.iter().copied().collect(), 0, true);
        }
        self.half = 1 - self.half;
        let first = STANDING.get(self.half).copied().unwrap_or(1);
        for (number, standing) in (first..).zip(&self.plan.standing) {
            plant.bring(number, standing.body, standing.gap, 0.0, standing.offset);
        }
        self.bends.retain(|bend| bend.until > truth.position - 50.0);
        if let Some(bend) = self.plan.bend {
            let (from, until) = (bend.from + self.from, bend.until + self.from);
            self.bends.push(Bend { from, until, ..bend });
        }
        plant.bend(self.bends.clone());
    }

    /// One cycle of who is ahead.
    fn lead_on(&mut self, plant: &mut Plant) {
        if !self.leads {
            return;
        }
        let (speed, offset) = self.lead;
        if self.piece == Piece::Bay {
            let [far, near] = BAY;
            let gap = plant.gap_to(LEAD).unwrap_or(0.0);
            let swung = 3.2 * ((gap - near) / (far - near)).clamp(0.0, 1.0);
            // A bus that goes back to the lane does not meet it again.
            self.lead = (0.0, if self.served { 3.2 } else { swung.min(offset) });
        } else if self.yields(plant) {
            self.steps.pop_front();
        } else if let Some(step) = self.steps.front().copied() {
            let towards = |value: f64, goal: f64, by: f64| value + (goal - value).clamp(-by / 100.0, by / 100.0);
            let (side, by) = step.offset;
            self.lead = (towards(speed, step.speed, step.by), towards(offset, side, by));
            self.step_ms += CYCLE_MS;
            if self.step_ms >= step.for_ms {
                self.step_ms = 0;
                self.steps.pop_front();
            }
        } else {
            self.leads = false;
            plant.take_away(LEAD);
            return;
        }
        plant.drive(LEAD, self.lead.0, self.lead.1);
    }

    /// Somebody waits to cross, and the bus is about to stop for them.
    fn yields(&self, plant: &Plant) -> bool {
        let waits = self.piece == Piece::Crossing && self.steps.len() == 2;
        waits && plant.truth().speed < 3.0 && plant.gap_to(LEAD).is_some_and(|gap| gap < 15.0)
    }

    /// What the driver has in mind.
    fn intent(&self, position: f64) -> Intent {
        let way = position - self.from;
        let stop_in = self.plan.stop.filter(|_| !self.served).map(|(at, _)| at - way);
        let bend = self.bends.iter().find(|bend| bend.until > position);
        let slow = self.plan.bend_speed.max(2.0);
        let in_bend = bend.is_some_and(|bend| bend.from <= position);
        let slow_down = bend.filter(|_| !in_bend).map(|bend| (slow, bend.from - position));
        let speed = if in_bend { slow.min(self.plan.speed) } else { self.plan.speed };
        Intent { speed, stop_in, slow_down }
    }
}

impl Hooks for Route {
    fn vehicle(&mut self, now_ms: u32, plant: &mut Plant) {
        if now_ms < READY_MS {
            return;
        }
        let truth = plant.truth();
        let way = truth.position - self.from;
        if let Some((at, dwell_ms)) = self.plan.stop.filter(|_| !self.served)
            && truth.speed < 0.05
            && (at - way).abs() < 3.0
        {
            self.stood_ms += CYCLE_MS;
            self.served = self.stood_ms >= dwell_ms;
        }
        // Who is ahead is followed until gone or far away.
        let near =
            self.leads && self.piece != Piece::Bay && plant.gap_to(LEAD).is_some_and(|gap| gap < 120.0 && gap > -15.0);
        if !self.begun || (way >= self.plan.length && self.served && !near) {
            self.next(plant);
        }
        self.lead_on(plant);
        let place = truth.position - 2.6 + truth.speed * 0.3;
        plant.act(Act::Wheel(wheel(road_at(&self.bends, place))));
        let intent = self.intent(truth.position);
        let parameters = self.parameters;
        self.human.drive(plant, &intent, &parameters);
    }
}

/// Drives this way in m. The same seed gives the same day.
#[must_use]
pub fn day(sealed: Sealed, main_seed: u64, number: u64, metres: f64) -> Day {
    let parameters = Parameters { power_told: true, ..Parameters::DEFAULT };
    let (name, title, description) = ("ordinary", "An ordinary day", "");
    let scenario = Scenario {
        name,
        title,
        description,
        length_ms: u32::MAX,
        parameters,
        script: START,
        road: &PLACES,
        misdeeds: &[],
    };
    let mut bench = Bench::configured(&scenario, sealed).driven_by(Controller::without_mitigation());
    let mut route = Route::new(seed_of(main_seed, "day", number), parameters);
    let mut seen = Looker::default();
    let longest =
        SLOWEST_MS.saturating_mul(u32::try_from(crate::number::nearest(metres)).unwrap_or(0)).saturating_add(READY_MS);
    while bench.truth().position < metres && bench.now_ms() < longest {
        let cycle = bench.step(&mut route);
        if cycle.now_ms > READY_MS {
            seen.see(&cycle, route.piece);
        }
    }
    let mut day = seen.day;
    (day.metres, day.took_ms, day.pieces) = (bench.truth().position, bench.now_ms(), route.count);
    day
}

/// Looks at every cycle.
#[derive(Default)]
struct Looker {
    counter: Counter,
    day: Day,
    before: Option<Cycle>,
    /// The highest level since the last without one.
    level: Option<Level>,
    needed: f64,
}

impl Looker {
    fn see(&mut self, cycle: &Cycle, piece: Piece) {
        self.counter.see(cycle);
        for (stretch, reason) in self.counter.new_ones() {
            let ahead = cycle.truth.ahead.map(|ahead| (ahead.gap, ahead.closing));
            let deceleration = -cycle.truth.acceleration;
            self.day.cases.push(Case { stretch, reason, piece, speed: cycle.truth.speed, ahead, deceleration });
        }
        let level = cycle.answer.status.level;
        if level == Level::None {
            if let Some(highest) = self.level.take() {
                *self.day.levels.entry(highest).or_default() += 1;
            }
        } else {
            self.level = self.level.max(Some(level));
        }
        let warns = |cycle: &Cycle| {
            let warnings = cycle.answer.outputs.warnings;
            warnings.forward_collision || warnings.pedestrian
        };
        let hit = |cycle: &Cycle| cycle.truth.ahead.is_some_and(|ahead| ahead.gap <= 0.0);
        if let Some(before) = &self.before {
            self.day.warnings += usize::from(warns(cycle) && !warns(before));
            self.day.collisions += usize::from(hit(cycle) && !hit(before));
            if cycle.truth.speed <= 0.0 && before.truth.speed > 0.0 {
                self.day.stops += 1;
                self.day.hard += usize::from(self.needed > 2.0);
                self.needed = 0.0;
            }
        }
        self.needed = self.needed.max(cycle.truth.hands.brake * 6.0);
        self.before = Some(*cycle);
    }
}
