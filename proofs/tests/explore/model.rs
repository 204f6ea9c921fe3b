//! The model: states are retained states, an action is what the shipped [`step`] reads in a cycle.

use std::hash::{Hash, Hasher};
use std::sync::atomic::{AtomicU64, Ordering};

use stateright::{Model, Property};
use supervisor_core::{
    Commands, Config, Decision, Flow, Inputs, Millis, Record, ResetCause, Sealed, State, StateImage, Threat, step,
};
use supervisor_perceive::Scene;
use supervisor_proofs::properties::{Cycle, Witness};

use crate::checks::Check;
use crate::coverage::Coverage;
use crate::identity::{Key, Moment, key, moment, normalised};
use crate::plant::Plant;

/// The cycle of every exploration: the longest legal one.
pub const TICK: Millis = Millis::new(50);
/// An input is held for no more cycles than this: a little more than the longest timer, scaled down.
const LONGEST_HOLD: u32 = 1300;
/// Of so many cycles one runs twice: from the state, and from its key.
const TWICE: u64 = 16;

/// What the supervisor reads in a cycle, with a name for people.
#[derive(Clone, Debug)]
pub struct Vector {
    /// Its name.
    pub name: String,
    /// Since the last cycle.
    pub elapsed: Millis,
    /// Inputs.
    pub inputs: Inputs,
    /// The road.
    pub scene: Scene,
    /// What perception makes of it.
    pub threat: Threat,
    /// What the main controller asks for.
    pub commands: Commands,
    /// It may be held while a long timer is on its way.
    pub holds: bool,
}

/// How an exploration begins.
#[derive(Clone, Copy, Debug)]
pub struct Start {
    /// Why the supervisor starts.
    pub cause: ResetCause,
    /// What was persisted.
    pub record: Option<Record>,
    /// The environment, if it cooperates.
    pub plant: Option<Plant>,
}

/// Something that may be waited for no longer than `most` cycles in a row.
#[derive(Clone, Copy)]
pub struct Promise {
    /// Its name.
    pub name: &'static str,
    /// Cycles.
    pub most: u16,
    /// Whether a cycle is one of waiting.
    pub waits: fn(&Cycle) -> bool,
}

/// One exploration: every sequence of these vectors, of any length, from these starts.
#[derive(Clone)]
pub struct Exploration {
    /// Its name.
    pub name: &'static str,
    /// Configuration, sealed.
    pub sealed: Sealed,
    /// The same.
    pub config: Config,
    /// Where it begins.
    pub starts: Vec<Start>,
    /// The alphabet.
    pub vectors: Vec<Vector>,
    /// How many ticks around an event of a timer are worth a look of their own.
    pub fine: u32,
    /// What may not be waited for any longer.
    pub promises: Vec<Promise>,
    /// What holds in every cycle.
    pub checks: Vec<Check>,
}

/// What was counted.
#[derive(Debug, Default)]
pub struct Counts {
    /// Cycles of the shipped step.
    pub cycles: AtomicU64,
    /// Transitions that led into a long timer's way, and were not followed.
    pub pruned: AtomicU64,
    /// Transitions that were held across it.
    pub held: AtomicU64,
    /// Cycles that ran twice.
    pub twice: AtomicU64,
    /// The longest wait of each promise.
    pub longest: [AtomicU64; PROMISES],
}

/// No exploration has more promises.
pub const PROMISES: usize = 3;

/// What was broken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Broken {
    /// A property.
    Check(usize),
    /// A promise.
    Promise(usize),
    /// The parts of `step` gave something else than `step`, or it left no state.
    Step,
    /// Two states of one key differ in what goes out, or in the key of the next state.
    Identity,
}

/// A node of the graph.
#[derive(Clone, Debug)]
pub struct Node {
    /// The retained state, as reached.
    pub state: State,
    /// The environment.
    pub plant: Option<Plant>,
    /// Cycles in which each promise has been waited for.
    pub waited: [u16; PROMISES],
    /// What the cycle that led here broke.
    pub broken: Option<Broken>,
    key: Key,
}

impl Hash for Node {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.key.hash(state);
        self.plant.hash(state);
        self.waited.hash(state);
        self.broken.is_some().hash(state);
    }
}

impl PartialEq for Node {
    fn eq(&self, other: &Self) -> bool {
        (self.key, self.plant, self.waited, self.broken) == (other.key, other.plant, other.waited, other.broken)
    }
}

/// One cycle as it ran.
pub struct Ran {
    /// What the supervisor read.
    pub inputs: Inputs,
    /// What it decided.
    pub decision: Decision,
    /// Where it led.
    pub next: Node,
}

/// An exploration, what was counted and what was seen.
pub struct Explorer {
    /// What is explored.
    pub of: Exploration,
    /// What was counted.
    pub counts: Counts,
    /// What was seen.
    pub coverage: Coverage,
}

impl Explorer {
    /// Nothing explored yet.
    pub fn new(of: Exploration) -> Self {
        let coverage = Coverage::new(&of.config);
        Self { of, counts: Counts::default(), coverage }
    }

    fn node(&self, state: State, plant: Option<Plant>) -> Node {
        let key = key(&normalised(&state, &self.of.config));
        Node { state, plant, waited: [0; PROMISES], broken: None, key }
    }

    /// The shipped step: what it decides, and the state it leaves.
    fn step(&self, state: &State, now: Millis, inputs: &Inputs, vector: &Vector) -> (Decision, Option<State>) {
        let mut image = StateImage::encode(state);
        let (threat, commands) = (&vector.threat, &vector.commands);
        let decision = step(&mut image, &self.of.sealed, Flow::PERCEIVED, now, inputs, threat, commands);
        (decision, image.decode())
    }

    /// One cycle from a node.
    pub fn cycle(&self, from: &Node, vector: &Vector) -> Ran {
        let config = &self.of.config;
        let count = self.counts.cycles.fetch_add(1, Ordering::Relaxed);
        let mut inputs = vector.inputs;
        if let Some(plant) = &from.plant {
            plant.sense(&mut inputs);
        }
        let now = Millis::new(from.state.clock.last.raw().wrapping_add(vector.elapsed.raw()));
        let (decision, next) = self.step(&from.state, now, &inputs, vector);
        let plant = from.plant.map(|plant| plant.obey(&decision.outputs));
        let mut node = self.node(next.unwrap_or(State::INITIAL), plant);
        // The same cycle once more, with what lies between its parts: for the properties.
        let witness = Witness::of(from.state, now, &inputs, &vector.threat, &vector.commands, config);
        let cycle = witness.cycle();
        if next != Some(witness.next)
            || (&decision.envelope, decision.outputs, decision.verdicts)
                != (cycle.envelope, witness.outputs, witness.verdicts)
        {
            node.broken = Some(Broken::Step);
        }
        let broken = self.of.checks.iter().position(|check| !check.holds(&witness, &cycle));
        node.broken = node.broken.or(broken.map(Broken::Check));
        for (index, promise) in self.of.promises.iter().enumerate() {
            let waited = if (promise.waits)(&cycle) { from.waited[index].saturating_add(1) } else { 0 };
            node.waited[index] = waited.min(promise.most.saturating_add(1));
            self.counts.longest[index].fetch_max(waited.into(), Ordering::Relaxed);
            if waited > promise.most {
                node.broken = node.broken.or(Some(Broken::Promise(index)));
            }
        }
        if count.is_multiple_of(TWICE) {
            self.counts.twice.fetch_add(1, Ordering::Relaxed);
            let twin = normalised(&from.state, config);
            let (again, next) = self.step(&twin, vector.elapsed, &inputs, vector);
            let same = again.outputs == decision.outputs
                && again.verdicts == decision.verdicts
                && again.envelope == decision.envelope
                && next.is_some_and(|next| key(&normalised(&next, config)) == node.key);
            if !same {
                node.broken = node.broken.or(Some(Broken::Identity));
            }
        }
        Ran { inputs, decision, next: node }
    }

    /// Every cycle of an action: the vector once, and on until the state is at a corner of time.
    pub fn cycles(&self, from: &Node, vector: &Vector) -> Option<Vec<Ran>> {
        let mut ran = vec![self.cycle(from, vector)];
        let mut long = false;
        for _ in 0..LONGEST_HOLD {
            let last = ran.last()?;
            if last.next.broken.is_some() {
                return Some(ran);
            }
            match moment(&last.next.state, self.of.fine, TICK, &self.of.config) {
                Moment::Corner => {
                    self.counts.held.fetch_add(u64::from(long), Ordering::Relaxed);
                    return Some(ran);
                }
                Moment::LongMidway | Moment::SettledMidway if vector.holds => long = true,
                // Once on the way it goes on, whatever begins.
                Moment::UnsettledMidway if long => {}
                Moment::LongMidway | Moment::SettledMidway | Moment::UnsettledMidway => break,
                Moment::Midway => {}
            }
            let next = self.cycle(&last.next, vector);
            ran.push(next);
        }
        self.counts.pruned.fetch_add(1, Ordering::Relaxed);
        None
    }

    /// The name of what was broken.
    pub fn name_of(&self, broken: Broken) -> &'static str {
        match broken {
            Broken::Check(index) => self.of.checks.get(index).map_or("?", |check| check.name),
            Broken::Promise(index) => self.of.promises.get(index).map_or("?", |promise| promise.name),
            Broken::Step => "step is the sum of its parts",
            Broken::Identity => "states of one key behave alike",
        }
    }
}

/// The one property of the graph.
pub const HOLDS: &str = "every property and every promise holds in every cycle";

impl Model for Explorer {
    type State = Node;
    type Action = usize;

    fn init_states(&self) -> Vec<Node> {
        let nodes = self.of.starts.iter().map(|start| self.node(State::boot(start.cause, start.record), start.plant));
        nodes.inspect(|node| self.coverage.see(&node.state, &self.of.config)).collect()
    }

    fn actions(&self, _: &Node, actions: &mut Vec<usize>) {
        actions.extend(0..self.of.vectors.len());
    }

    fn next_state(&self, from: &Node, action: usize) -> Option<Node> {
        let ran = self.cycles(from, self.of.vectors.get(action)?)?;
        let next = ran.into_iter().next_back().map(|ran| ran.next)?;
        self.coverage.see(&next.state, &self.of.config);
        Some(next)
    }

    fn properties(&self) -> Vec<Property<Self>> {
        vec![Property::always(HOLDS, |_, node: &Node| node.broken.is_none())]
    }
}
