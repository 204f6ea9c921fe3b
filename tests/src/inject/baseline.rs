//! A correct drive without a fault: what faults are compared with, and where they may begin.

use supervisor::{Channel, ConfigError, EpbState, Faults};

use super::harm::{Ftti, Harm, Watch};
use super::kind::When;
use crate::bench::{Bench, Undisturbed};
use crate::drive::{Answer, Cycle, Scenario};
use crate::judge::{Stretch, interventions};
use crate::number::kmh;
use crate::plant::{CYCLE_MS, Truth};

/// A bench is kept every so many cycles.
const EVERY: usize = 500;
/// A run begins at least so long before its fault, in ms: the injector sees the link as it was.
const AHEAD_MS: u32 = 500;
/// No fault begins earlier: the link starts, in ms ...
const FIRST_MS: u32 = 1000;
/// ... or later than this before the end of the drive, in ms.
const LAST_MS: u32 = 3000;
/// "Soon": how long before the driver gets up, in ms.
const BEFORE_MS: u32 = 3000;
/// "Nearly ten minutes", in ms.
const NEARLY_MS: u32 = 590_000;

/// What the supervisor said in one cycle, in short.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Said {
    /// The channels that it did not pass, one bit each.
    pub refused: u16,
    /// Its faults.
    pub faults: u32,
    /// It is in the safe state.
    pub safe_state: bool,
    /// The actuators hear it.
    pub heard: bool,
}

impl From<&Cycle> for Said {
    fn from(cycle: &Cycle) -> Self {
        let Answer { verdicts, status, .. } = &cycle.answer;
        let bit = |channel: Channel| 1_u16.rotate_left(u32::from(channel.code()));
        let refused =
            verdicts.iter().filter(|(_, verdict)| !verdict.passed()).fold(0, |all, (channel, _)| all | bit(channel));
        let faults = status.faults.without(Faults::HINTS).bits();
        Self { refused, faults, safe_state: status.safe_state, heard: cycle.heard }
    }
}

/// A correct drive as it was driven.
#[derive(Clone, Debug)]
pub struct Baseline {
    /// The drive.
    pub scenario: Scenario<'static>,
    /// What the supervisor said, cycle by cycle.
    pub said: Vec<Said>,
    /// What it should not have done.
    pub interventions: Vec<Stretch>,
    /// Goals that are violated without any fault.
    pub harms: Vec<Harm>,
    /// For each cycle the kinds of fault that may begin, one bit each.
    may: Vec<u16>,
    kept: Vec<(Bench<'static>, Watch)>,
}

impl Baseline {
    /// Drives it.
    ///
    /// # Errors
    /// If the default configuration is refused.
    pub fn drive(scenario: &Scenario<'static>, ftti: &Ftti) -> Result<Self, ConfigError> {
        let (mut bench, mut watch) = (Bench::new(scenario)?, Watch::new(ftti.clone()));
        let (mut cycles, mut kept) = (Vec::new(), vec![(bench.clone(), watch.clone())]);
        for _ in (CYCLE_MS..=scenario.length_ms).step_by(10) {
            let cycle = bench.step(&mut Undisturbed);
            watch.see(&cycle);
            cycles.push(cycle);
            if cycles.len().is_multiple_of(EVERY) {
                kept.push((bench.clone(), watch.clone()));
            }
        }
        Ok(Self {
            scenario: *scenario,
            said: cycles.iter().map(Said::from).collect(),
            interventions: interventions(&cycles),
            harms: watch.harms().to_vec(),
            may: may(&cycles),
            kept,
        })
    }

    /// The times in ms at which such a fault may begin.
    #[must_use]
    pub fn times(&self, when: When) -> Vec<u32> {
        let last = self.scenario.length_ms.saturating_sub(LAST_MS);
        let times = (CYCLE_MS..).step_by(10).zip(&self.may);
        let fits = |(at, may): &(u32, &u16)| **may & bit(when) != 0 && (FIRST_MS..=last).contains(at);
        times.filter(fits).map(|(at, _)| at).collect()
    }

    /// The drive shortly before this time.
    #[must_use]
    pub fn before(&self, at_ms: u32) -> Option<(Bench<'static>, Watch)> {
        let early = |(bench, _): &&(Bench, Watch)| bench.now_ms().saturating_add(AHEAD_MS) < at_ms;
        self.kept.iter().rev().find(early).or(self.kept.first()).cloned()
    }

    /// What the supervisor said at this time.
    #[must_use]
    pub fn said_at(&self, now_ms: u32) -> Option<Said> {
        let number = usize::try_from(now_ms / CYCLE_MS).ok()?.checked_sub(1)?;
        self.said.get(number).copied()
    }
}

const fn bit(when: When) -> u16 {
    match when {
        When::Any => 1,
        When::Driving => 1 << 1,
        When::Torque => 1 << 2,
        When::Coasting => 1 << 3,
        When::Braking => 1 << 4,
        When::Standing => 1 << 5,
        When::Clear => 1 << 6,
        When::Closing => 1 << 7,
        When::BeforeLeave => 1 << 8,
        When::Leaving => 1 << 9,
        When::Empty => 1 << 10,
        When::Parked => 1 << 11,
        When::Powered => 1 << 12,
        When::TenMinutes => 1 << 13,
        When::Dark => 1 << 14,
    }
}

/// What holds in each cycle.
fn may(cycles: &[Cycle]) -> Vec<u16> {
    let mut parked_ms = 0_u32;
    let mut may: Vec<u16> = Vec::new();
    for cycle in cycles {
        let applied = empty(&cycle.truth) && cycle.truth.epb == Some(EpbState::Applied);
        parked_ms = if applied { parked_ms.saturating_add(CYCLE_MS) } else { 0 };
        let holds = When::NAMES.iter().filter(|(when, _)| holds(*when, &cycle.truth, parked_ms));
        may.push(holds.fold(0, |all, (when, _)| all | bit(*when)));
    }
    let mut left_ms = 0_u32;
    for (may, cycle) in may.iter_mut().zip(cycles).rev() {
        left_ms = if empty(&cycle.truth) { BEFORE_MS } else { left_ms.saturating_sub(CYCLE_MS) };
        if left_ms > 0 && !empty(&cycle.truth) {
            *may |= bit(When::BeforeLeave);
        }
    }
    may
}

fn empty(truth: &Truth) -> bool {
    truth.seat == [false; 2]
}

fn holds(when: When, truth: &Truth, parked_ms: u32) -> bool {
    let (empty, hands) = (empty(truth), &truth.hands);
    let driving = !empty && truth.speed > kmh(10.0);
    let near = |ahead: crate::plant::Ahead| ahead.closing > 0.0 && ahead.gap < 7.0 * ahead.closing;
    let powered = truth.closed == [true; 2];
    match when {
        When::Any => true,
        When::Driving => driving,
        When::Torque => driving && hands.accelerator > 0.1,
        When::Coasting => driving && hands.accelerator < 0.02 && hands.brake < 0.02 && !hands.cruise,
        When::Braking => driving && hands.brake > 0.1,
        When::Standing => !empty && truth.speed.abs() < 0.01 && powered,
        When::Clear => !empty && truth.speed > kmh(20.0) && truth.ahead.is_none_or(|ahead| ahead.gap > 250.0),
        When::Closing => truth.speed > kmh(10.0) && truth.ahead.is_some_and(near),
        When::Leaving => empty && truth.speed > kmh(5.0),
        When::Empty => empty,
        When::Parked => parked_ms > 0,
        When::Powered => powered,
        When::TenMinutes => parked_ms > NEARLY_MS && powered,
        When::Dark => empty && truth.closed == [false; 2],
        // Looked at afterwards: it depends on what comes.
        When::BeforeLeave => false,
    }
}
