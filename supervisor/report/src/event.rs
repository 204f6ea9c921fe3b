//! The event record.

use supervisor_core::{
    Channel, Decision, Faults, Inputs, Level, Millis, Mode, Occupancy, Stage, Status, Verdict, Verdicts,
};

use crate::ring::Ring;
use crate::snapshot::Snapshot;

/// What changed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum What {
    /// The verdict of a channel: its kind or its reason. Carries value, limit and margin.
    Verdict(Channel, Verdict),
    /// The seat.
    Occupancy(Occupancy),
    /// Parked by leave began or ended.
    ParkedByLeave(bool),
    /// Stage of the shutdown of high voltage.
    Stage(Stage),
    /// Mitigation level.
    Level(Level),
    /// Longitudinal mode.
    Mode(Mode),
    /// Safe state.
    SafeState(bool),
    /// The set of faults.
    Faults(Faults),
}

/// One change, with its time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Event {
    /// Time of the cycle, as given to the step.
    pub time: Millis,
    /// What changed.
    pub what: What,
}

/// The last `N` changes, and the last `S` snapshots of either kind: of what is grave (safe state, leave, a rising
/// level), and of channels that stopped passing. A channel that flickers never pushes out what is grave. When a ring
/// is full its oldest goes, and is counted. `N` and `S` are at least 1.
///
/// # Bytes
/// At most 24 for each of `N` and 2 × 192 for each of `S`, and about 300 (a test measures it).
#[derive(Clone, Debug)]
pub struct EventRecord<const N: usize, const S: usize> {
    events: Ring<Event, N>,
    grave: Ring<Snapshot, S>,
    refused: Ring<Snapshot, S>,
    last: Option<(Verdicts, Status)>,
}

impl<const N: usize, const S: usize> Default for EventRecord<N, S> {
    fn default() -> Self {
        Self::new()
    }
}

impl<const N: usize, const S: usize> EventRecord<N, S> {
    /// Empty.
    #[must_use]
    pub const fn new() -> Self {
        Self { events: Ring::new(), grave: Ring::new(), refused: Ring::new(), last: None }
    }

    /// Notes what changed since the last decision. The first decision notes everything but passes. `inputs` are those
    /// of the same cycle; without them a snapshot says only what was decided.
    pub fn observe(&mut self, time: Millis, decision: &Decision, inputs: Option<&Inputs>) {
        let last = self.last.replace((decision.verdicts, decision.status));
        let mut stopped = None;
        for (channel, verdict) in decision.verdicts.iter() {
            let before = last.map_or(Verdict::PASS, |(verdicts, _)| verdicts.of(channel));
            if (before.kind, before.reason) != (verdict.kind, verdict.reason) {
                self.push(time, What::Verdict(channel, verdict));
            }
            if before.passed() && !verdict.passed() && stopped.is_none() {
                stopped = Some(What::Verdict(channel, verdict));
            }
        }
        let before = last.map(|(_, status)| status);
        self.status(time, before, decision.status);
        if let Some(cause) = grave(before, decision.status) {
            self.grave.push(Snapshot::of(time, cause, decision, inputs));
        } else if let Some(cause) = stopped {
            self.refused.push(Snapshot::of(time, cause, decision, inputs));
        }
    }

    fn status(&mut self, time: Millis, before: Option<Status>, status: Status) {
        let mut note = |changed: bool, what| {
            if changed {
                self.push(time, what);
            }
        };
        note(before.map(|status| status.occupancy) != Some(status.occupancy), What::Occupancy(status.occupancy));
        let parked = before.is_some_and(|status| status.parked_by_leave);
        note(parked != status.parked_by_leave, What::ParkedByLeave(status.parked_by_leave));
        note(before.map_or(Stage::Up, |status| status.stage) != status.stage, What::Stage(status.stage));
        note(before.map_or(Level::None, |status| status.level) != status.level, What::Level(status.level));
        note(before.map_or(Mode::Manual, |status| status.mode) != status.mode, What::Mode(status.mode));
        note(before.is_some_and(|status| status.safe_state) != status.safe_state, What::SafeState(status.safe_state));
        note(before.map_or(Faults::NONE, |status| status.faults) != status.faults, What::Faults(status.faults));
    }

    /// The changes, from the oldest to the newest.
    pub fn iter(&self) -> impl Iterator<Item = &Event> {
        self.events.iter()
    }

    /// The snapshots: grave ones, then those of channels that stopped passing; each from the oldest to the newest.
    pub fn snapshots(&self) -> impl Iterator<Item = &Snapshot> {
        self.grave.iter().chain(self.refused.iter())
    }

    /// How many changes were dropped, saturating.
    #[must_use]
    pub const fn dropped(&self) -> u32 {
        self.events.dropped()
    }

    /// How many snapshots were dropped, saturating.
    #[must_use]
    pub const fn snapshots_dropped(&self) -> u32 {
        self.grave.dropped().saturating_add(self.refused.dropped())
    }

    fn push(&mut self, time: Millis, what: What) {
        self.events.push(Event { time, what });
    }
}

/// The gravest thing that began in this cycle.
fn grave(before: Option<Status>, status: Status) -> Option<What> {
    if status.safe_state && !before.is_some_and(|status| status.safe_state) {
        Some(What::SafeState(true))
    } else if status.occupancy == Occupancy::Leave && before.map(|status| status.occupancy) != Some(Occupancy::Leave) {
        Some(What::Occupancy(Occupancy::Leave))
    } else if status.level > before.map_or(Level::None, |status| status.level) {
        Some(What::Level(status.level))
    } else {
        None
    }
}
