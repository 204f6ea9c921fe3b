//! Randomised runs: the correct main controller in a random situation, sensors and bus disturbed.
//!
//! A run begins in full drive: the bus has been driven undisturbed up to its speed once ([`Prepared`]), and every run goes on
//! from there with its own disturbance.

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use supervisor::wire::Frame;
use supervisor::{Channel, Inputs, Level, Reason, Scene, Sealed};

use super::reaction::{Reaction, Stopwatch};
use super::situation::{Kind, Situation, situation};
use super::{Amount, Disturbance, seed_of};
use crate::bench::{Bench, Hooks};
use crate::drive::{Cycle, Scenario};
use crate::driver::{Act, Script, after_start};
use crate::judge::{Counter, Stretch};
use crate::link::Stamped;
use crate::plant::{Parameters, Plant};
use crate::road::Obstacle;
use crate::traffic::{Other, Traffic};

const AT_20: Script<'static> = after_start![(10_500, Act::Hold(20.0)),];
const AT_30: Script<'static> = after_start![(10_500, Act::Hold(30.0)),];
const AT_40: Script<'static> = after_start![(10_500, Act::Hold(40.0)),];
const CRUISES: Script<'static> = after_start![
    (10_500, Act::Hold(40.0)),
    (30_000, Act::CruiseSwitch(true)),
    (31_000, Act::Set(true)),
    (31_400, Act::Set(false)),
    (31_600, Act::Accelerator(0.0)),
];

/// How the bus drives when a run begins.
const DRIVES: [(&str, Script<'static>); 4] =
    [("20 km/h", AT_20), ("30 km/h", AT_30), ("40 km/h", AT_40), ("40 km/h, cruise control", CRUISES)];
/// When a run begins, in ms of the drive.
const START_MS: u32 = 38_000;
/// How long it is, in ms.
const LENGTH_MS: u32 = 13_000;
/// Places on the road for the others.
const PLACES: [Obstacle; 3] = [Obstacle { from_ms: u32::MAX, ..Obstacle::standing_car(0.0) }; 3];
/// A level that begins while nothing in the corridor is nearer in time than this had no cause, in s: S1's 4.4 s and what
/// noise may add.
const CAUSE_S: f64 = 5.0;

/// The bus on its way, once for each way to drive.
#[derive(Clone, Debug)]
pub struct Prepared(Vec<(&'static str, Bench<'static>)>);

impl Prepared {
    /// Drives it up to where runs begin.
    #[must_use]
    pub fn new(sealed: Sealed) -> Self {
        let parameters = Parameters { power_told: true, ..Parameters::DEFAULT };
        let drive = |(name, script): (&'static str, Script<'static>)| {
            let (title, description) = (name, name);
            let scenario = Scenario {
                name,
                title,
                description,
                length_ms: START_MS,
                parameters,
                script,
                road: &PLACES,
                misdeeds: &[],
            };
            let mut bench = Bench::configured(&scenario, sealed);
            while bench.now_ms() < START_MS {
                bench.step(&mut crate::bench::Undisturbed);
            }
            (name, bench)
        };
        Self(DRIVES.into_iter().map(drive).collect())
    }
}

/// What came of a run.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// How it drove.
    pub drive: &'static str,
    /// What it drove into.
    pub kind: Kind,
    /// Everything in which the correct main controller was still short after three cycles, and why.
    pub interventions: Vec<(Stretch, Reason)>,
    /// Levels that began without a cause.
    pub false_triggers: usize,
    /// The gap was used up.
    pub collided: bool,
    /// A level began.
    pub level: Level,
    /// How long each beginning took.
    pub reactions: Vec<Reaction>,
    /// How long the bus was busy, and was there, in µs.
    pub busy: (u64, u64),
    /// Frames that nobody read.
    pub lost: u64,
}

impl Outcome {
    /// Interventions that move the bus: all but those on the warnings.
    pub fn acting(&self) -> impl Iterator<Item = &(Stretch, Reason)> {
        self.interventions.iter().filter(|(stretch, _)| stretch.channel != Channel::Warnings)
    }
}

struct World {
    traffic: Traffic,
    acts: Vec<(u32, Act)>,
    done: usize,
    disturbance: Disturbance,
    others: Vec<Other>,
}

impl Hooks for World {
    fn vehicle(&mut self, now_ms: u32, plant: &mut Plant) {
        while let Some((_, act)) = self.acts.get(self.done).filter(|(at_ms, _)| *at_ms <= now_ms) {
            plant.act(*act);
            self.done += 1;
        }
        self.traffic.vehicle(now_ms, plant);
        self.others = self.traffic.others(plant);
        self.disturbance.vehicle(now_ms, plant);
    }

    fn inputs(&mut self, now_ms: u32, inputs: &mut Inputs, scene: &mut Scene) {
        self.disturbance.inputs(now_ms, inputs, scene);
    }

    fn carries(&mut self, now_ms: u32, frames: &[Frame]) -> Option<Vec<Stamped>> {
        self.disturbance.carries(now_ms, frames)
    }
}

/// The run of this number. `amount` is what is disturbed.
#[must_use]
pub fn run(prepared: &Prepared, amount: Amount, main_seed: u64, number: u64) -> Option<Outcome> {
    watch(prepared, amount, main_seed, number, &mut |_, _| {})
}

/// The same run, and somebody who sees each cycle and where the others are in it.
pub fn watch(
    prepared: &Prepared,
    amount: Amount,
    main_seed: u64,
    number: u64,
    see: &mut dyn FnMut(&Cycle, &[Other]),
) -> Option<Outcome> {
    let seed = seed_of(main_seed, "run", number);
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let (kind, ..) = *Kind::ALL.get(random.random_range(0..Kind::ALL.len()))?;
    let (drive, mut bench) = prepared.0.get(random.random_range(0..prepared.0.len()))?.clone();
    let periods = [[50, 40], [60, 33], [50, 66], [70, 40]];
    let amount = Amount { periods_ms: periods.get(random.random_range(0..periods.len())).copied(), ..amount };
    let Situation { actors, acts } = situation(kind, START_MS, bench.truth().speed, &mut random);
    let (traffic, disturbance, others) = (Traffic::new(actors), Disturbance::new(amount, seed), Vec::new());
    let mut world = World { traffic, acts, done: 0, disturbance, others };
    let (mut counter, mut stopwatch, mut interventions) = (Counter::default(), Stopwatch::default(), Vec::new());
    let (mut false_triggers, mut collided, mut level, mut before) = (0, false, Level::None, Level::None);
    while bench.now_ms() < START_MS.saturating_add(LENGTH_MS) {
        let cycle = bench.step(&mut world);
        see(&cycle, &world.others);
        counter.see(&cycle);
        interventions.extend(counter.new_ones());
        stopwatch.see(&cycle, world.disturbance.carried());
        collided |= cycle.truth.ahead.is_some_and(|ahead| ahead.gap <= 0.0);
        let now = cycle.answer.status.level;
        false_triggers += usize::from(now > before && !caused(&cycle));
        (before, level) = (now, level.max(now));
    }
    let (busy, lost) = world.disturbance.bus().map_or(((0, 0), 0), super::bus::Bus::figures);
    let reactions = stopwatch.found().to_vec();
    Some(Outcome { drive, kind, interventions, false_triggers, collided, level, reactions, busy, lost })
}

/// Something in the corridor is near in time.
fn caused(cycle: &Cycle) -> bool {
    cycle.truth.ahead.is_some_and(|ahead| ahead.closing > 0.0 && ahead.gap < CAUSE_S * ahead.closing)
}
