//! What a corpus reaches: modes, and why commands were passed, limited, substituted and blocked.

use std::collections::BTreeSet;

use crate::common::{
    Channel, Decision, DrivingMode, ExitReason, Kind, Level, Mode, Occupancy, Reason, Record, Stage, Status, Verdicts,
};

/// A mode that was reached. Kept as a value, not as text: this is looked at in every cycle that is fuzzed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Place {
    Occupancy(Occupancy),
    Shutdown(Stage),
    Mitigation(Level),
    Mode(Mode),
    Exit(ExitReason),
    Record(Record),
    ModeOutput(DrivingMode),
    SafeState(bool),
    ParkedByLeave(bool),
}

/// A verdict without its numbers.
type Given = (Channel, Kind, Reason);

/// What was seen so far.
#[derive(Clone, Debug, Default)]
pub struct Reached {
    /// Cycles that were vetted and judged.
    pub cycles: u64,
    only_cycles: bool,
    modes: BTreeSet<Place>,
    reasons: BTreeSet<Reason>,
    verdicts: BTreeSet<Given>,
    /// Where the cycle before was: what stays reaches nothing new.
    last: Option<([Place; 9], Vec<Given>)>,
}

/// Every mode there is.
fn modes() -> BTreeSet<Place> {
    fn all<T: Copy>(values: &[T], place: fn(T) -> Place) -> impl Iterator<Item = Place> {
        values.iter().map(move |value| place(*value))
    }
    let both = [false, true];
    all(Occupancy::ALL, Place::Occupancy)
        .chain(all(Stage::ALL, Place::Shutdown))
        .chain(all(Level::ALL, Place::Mitigation))
        .chain(all(Mode::ALL, Place::Mode))
        .chain(all(ExitReason::ALL, Place::Exit))
        .chain(all(Record::ALL, Place::Record))
        .chain(all(DrivingMode::ALL, Place::ModeOutput))
        .chain(all(&both, Place::SafeState))
        .chain(all(&both, Place::ParkedByLeave))
        .collect()
}

impl Reached {
    /// Counts cycles, and keeps nothing of them, as a fuzzer wants it: sets that grow would give it edges that are none of the
    /// supervisor's.
    #[must_use]
    pub fn only_cycles() -> Self {
        Self { only_cycles: true, ..Self::default() }
    }

    /// Takes in one cycle.
    pub fn look(&mut self, decision: &Decision) {
        self.look_at(&decision.status, &decision.verdicts, decision.outputs.mode);
    }

    /// The same of what was kept of a cycle.
    pub fn look_at(&mut self, status: &Status, verdicts: &Verdicts, mode: DrivingMode) {
        self.cycles += 1;
        if self.only_cycles {
            return;
        }
        let places = [
            Place::Occupancy(status.occupancy),
            Place::Shutdown(status.stage),
            Place::Mitigation(status.level),
            Place::Mode(status.mode),
            Place::Exit(status.exit),
            Place::Record(status.record),
            Place::ModeOutput(mode),
            Place::SafeState(status.safe_state),
            Place::ParkedByLeave(status.parked_by_leave),
        ];
        let given = || verdicts.iter().map(|(channel, verdict)| (channel, verdict.kind, verdict.reason));
        if self.last.as_ref().is_some_and(|(before, said)| *before == places && given().eq(said.iter().copied())) {
            return;
        }
        self.modes.extend(places);
        self.reasons.extend(given().map(|(_, _, reason)| reason));
        self.verdicts.extend(given());
        self.last = Some((places, given().collect()));
    }

    /// How many different modes and verdicts were seen.
    #[must_use]
    pub fn size(&self) -> usize {
        self.modes.len() + self.verdicts.len()
    }

    /// The modes that were not reached.
    #[must_use]
    pub fn modes_missing(&self) -> Vec<String> {
        modes().difference(&self.modes).map(|place| format!("{place:?}")).collect()
    }

    /// The reason codes that no verdict gave.
    #[must_use]
    pub fn reasons_missing(&self) -> Vec<Reason> {
        Reason::ALL.iter().filter(|reason| !self.reasons.contains(reason)).copied().collect()
    }

    /// How much was reached, for people.
    #[must_use]
    pub fn report(&self) -> String {
        let missing = |count: usize, all: usize, names: String| {
            let rest = if names.is_empty() { String::new() } else { format!("; missing: {names}") };
            format!("{count} of {all}{rest}")
        };
        let (modes_missing, reasons_missing) = (self.modes_missing(), self.reasons_missing());
        let all = modes().len();
        let reasons = reasons_missing.iter().map(|reason| format!("{reason:?}")).collect::<Vec<_>>().join(", ");
        format!(
            "{} cycles\nmodes: {}\nreason codes: {}\nverdicts (channel, kind, reason): {}",
            self.cycles,
            missing(all - modes_missing.len(), all, modes_missing.join(", ")),
            missing(Reason::ALL.len() - reasons_missing.len(), Reason::ALL.len(), reasons),
            self.verdicts.len(),
        )
    }
}
