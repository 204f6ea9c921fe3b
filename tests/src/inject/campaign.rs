//! Fault × scenario, from a seed: the same seed gives the same runs, on any machine and in any order.

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use supervisor::{Status, Verdict as Vetted, Verdicts};

use super::baseline::{Baseline, Said};
use super::harm::{Ftti, Goal, Harm, Watch};
use super::injector::Injector;
use super::kind::{Kind, When};
use super::outcome::{Listener, Outcome, Reaction, Verdict, verdict};
use crate::bench::{Bench, Obeys};
use crate::drive::{Answer, Cycle};
use crate::plant::CYCLE_MS;

/// How long a run goes on after its fault, and a fault without end lasts at least, in ms.
const AFTER_MS: u32 = 15_000;

/// A fault, as far as a run needs it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault {
    /// Its id.
    pub id: String,
    /// What is done.
    pub kind: Kind,
    /// When it may begin.
    pub when: When,
    /// Least and greatest duration in ms; none: to the end of the run.
    pub lasts_ms: Option<(u32, u32)>,
    /// The goals that it endangers.
    pub goals: Vec<Goal>,
    /// It endangers SG-13 by being there.
    pub by_itself: bool,
}

/// Who protects the bus.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Guard {
    /// The supervisor.
    Supervisor,
    /// One that passes everything and says nothing: shows that a campaign can fail.
    Blind,
}

/// One run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Run {
    /// When the fault began, in ms of the drive.
    pub from_ms: u32,
    /// For how long, in ms.
    pub lasts_ms: u32,
    /// Violated without the supervisor.
    pub without: Vec<Harm>,
    /// Violated with it.
    pub with: Vec<Harm>,
    /// Its reaction.
    pub reaction: Reaction,
    /// The verdict.
    pub verdict: Verdict,
}

/// All runs of one fault in one scenario.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Cell {
    /// The runs.
    pub runs: Vec<Run>,
}

impl Cell {
    /// How many runs came to this.
    #[must_use]
    pub fn count(&self, outcome: Outcome) -> usize {
        self.runs.iter().filter(|run| run.verdict.outcome == outcome).count()
    }
}

/// The seed of one run: FNV-1a over everything that names it.
fn seed(seed: u64, fault: &str, scenario: &str, run: u32) -> u64 {
    let words = [&seed.to_le_bytes()[..], fault.as_bytes(), b"/", scenario.as_bytes(), &run.to_le_bytes()];
    let fold = |hash: u64, byte: &u8| (hash ^ u64::from(*byte)).wrapping_mul(0x0000_0100_0000_01B3);
    words.into_iter().flatten().fold(0xCBF2_9CE4_8422_2325, fold)
}

/// This many runs of a fault in a drive, each at another time; none if it does not apply.
#[must_use]
pub fn cell(baseline: &Baseline, fault: &Fault, ftti: &Ftti, main_seed: u64, runs: u32, guard: Guard) -> Cell {
    let times = baseline.times(fault.when);
    let one = |number| {
        let drawn = seed(main_seed, &fault.id, baseline.scenario.name, number);
        run(baseline, fault, ftti, &times, drawn, guard)
    };
    Cell { runs: (0..runs).filter_map(one).collect() }
}

fn run(baseline: &Baseline, fault: &Fault, ftti: &Ftti, times: &[u32], drawn: u64, guard: Guard) -> Option<Run> {
    let mut random = ChaCha8Rng::seed_from_u64(drawn);
    if times.is_empty() {
        return None;
    }
    let from_ms = *times.get(random.random_range(0..times.len()))?;
    let longest = fault.goals.iter().filter_map(|goal| ftti.get(goal)).max().copied().unwrap_or(0);
    let (lasts_ms, after_ms) = match fault.lasts_ms {
        Some((least, most)) => (random.random_range(least..=most.max(least)).next_multiple_of(CYCLE_MS), AFTER_MS),
        None => (longest.saturating_add(AFTER_MS), 0),
    };
    let until_ms = from_ms.saturating_add(lasts_ms.max(longest)).saturating_add(after_ms);
    let until_ms = until_ms.min(baseline.scenario.length_ms);
    let injector = Injector::new(fault.kind, from_ms, lasts_ms, drawn);

    let (bench, watch) = baseline.before(from_ms)?;
    let mut start = Start { bench, watch, injector };
    while start.bench.now_ms().saturating_add(CYCLE_MS) < from_ms {
        let cycle = start.bench.step(&mut start.injector);
        start.watch.see(&cycle);
    }
    start.watch.forget(from_ms);

    let (without, _) = start.clone().go_on(Obeys::Controller, until_ms, baseline, Guard::Blind);
    let obeys = match guard {
        Guard::Supervisor => Obeys::Supervisor,
        Guard::Blind => Obeys::Controller,
    };
    let (with, reaction) = start.go_on(obeys, until_ms, baseline, guard);
    let begins = fault.by_itself.then_some(from_ms);
    let verdict = verdict(&without, &with, begins, reaction, ftti);
    Some(Run { from_ms, lasts_ms, without, with, reaction, verdict })
}

/// Where both ways part.
#[derive(Clone)]
struct Start {
    bench: Bench<'static>,
    watch: Watch,
    injector: Injector,
}

impl Start {
    fn go_on(mut self, obeys: Obeys, until_ms: u32, baseline: &Baseline, guard: Guard) -> (Vec<Harm>, Reaction) {
        self.bench = self.bench.obeying(obeys);
        let mut listener = Listener::default();
        while self.bench.now_ms() < until_ms {
            let cycle = self.bench.step(&mut self.injector);
            self.watch.see(&cycle);
            let usual = baseline.said_at(cycle.now_ms);
            let said = match guard {
                Guard::Supervisor => Said::from(&cycle),
                Guard::Blind => Said::from(&blind(&cycle)),
            };
            listener.hear(cycle.now_ms, &said, usual.as_ref());
        }
        (self.watch.harms().to_vec(), listener.reaction())
    }
}

/// The same cycle by one that passes everything and says nothing.
fn blind(cycle: &Cycle) -> Cycle {
    let status = Status { safe_state: false, faults: supervisor::Faults::NONE, ..cycle.answer.status };
    let verdicts = Verdicts::new([Vetted::PASS; 12]);
    Cycle { answer: Answer { verdicts, status, ..cycle.answer }, heard: true, ..*cycle }
}
