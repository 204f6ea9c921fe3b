//! The event record.

use heapless::Deque;
use supervisor_core::{Channel, Decision, Faults, Level, Millis, Mode, Occupancy, Stage, Verdict, Verdicts};

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

/// The last `N` changes. When it is full the oldest goes, and is counted.
#[derive(Clone, Debug)]
pub struct EventRecord<const N: usize> {
    events: Deque<Event, N>,
    dropped: u32,
    last: Option<(Verdicts, supervisor_core::Status)>,
}

impl<const N: usize> Default for EventRecord<N> {
    fn default() -> Self {
        Self::new()
    }
}

impl<const N: usize> EventRecord<N> {
    /// Empty.
    #[must_use]
    pub const fn new() -> Self {
        Self { events: Deque::new(), dropped: 0, last: None }
    }

    /// Notes what changed since the last decision. The first decision notes everything but passes.
    pub fn observe(&mut self, time: Millis, decision: &Decision) {
        let last = self.last.replace((decision.verdicts, decision.status));
        for (channel, verdict) in decision.verdicts.iter() {
            let before = last.map_or(Verdict::PASS, |(verdicts, _)| verdicts.of(channel));
            if (before.kind, before.reason) != (verdict.kind, verdict.reason) {
                self.push(time, What::Verdict(channel, verdict));
            }
        }
        let status = decision.status;
        let before = last.map(|(_, status)| status);
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

    /// From the oldest to the newest.
    pub fn iter(&self) -> impl Iterator<Item = &Event> {
        self.events.iter()
    }

    /// How many events were dropped, saturating.
    #[must_use]
    pub const fn dropped(&self) -> u32 {
        self.dropped
    }

    fn push(&mut self, time: Millis, what: What) {
        if self.events.is_full() {
            self.events.pop_front();
            self.dropped = self.dropped.saturating_add(1);
        }
        // Room was made; a record of length 0 keeps nothing.
        if self.events.push_back(Event { time, what }).is_err() {
            self.dropped = self.dropped.saturating_add(1);
        }
    }
}
