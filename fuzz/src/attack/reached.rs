//! What a corpus reaches: modes, and why commands were passed, limited, substituted and blocked.

use std::collections::BTreeSet;
use std::fmt::Debug;

use crate::common::{
    Channel, Decision, DrivingMode, ExitReason, Kind, Level, Mode, Occupancy, Reason, Record, Stage, Status, Verdicts,
};

/// What was seen so far.
#[derive(Clone, Debug, Default)]
pub struct Reached {
    /// Cycles that were vetted and judged.
    pub cycles: u64,
    modes: BTreeSet<String>,
    reasons: BTreeSet<Reason>,
    verdicts: BTreeSet<(Channel, Kind, Reason)>,
}

/// A mode as it is printed.
fn named(group: &str, mode: impl Debug) -> String {
    format!("{group} {mode:?}")
}

/// Every mode there is.
fn modes() -> BTreeSet<String> {
    let occupancy = [Occupancy::NotConfirmed, Occupancy::Confirmed, Occupancy::Leave];
    let mut all: BTreeSet<String> = occupancy.iter().map(|mode| named("occupancy", mode)).collect();
    all.extend(Stage::ALL.iter().map(|mode| named("shutdown", mode)));
    all.extend(Level::ALL.iter().map(|mode| named("mitigation", mode)));
    all.extend(Mode::ALL.iter().map(|mode| named("mode", mode)));
    all.extend(ExitReason::ALL.iter().map(|mode| named("exit", mode)));
    all.extend(Record::ALL.iter().map(|mode| named("record", mode)));
    all.extend(DrivingMode::ALL.iter().map(|mode| named("mode output", mode)));
    all.extend([false, true].map(|safe| named("safe state", safe)));
    all.extend([false, true].map(|parked| named("parked by leave", parked)));
    all
}

impl Reached {
    /// Takes in one cycle.
    pub fn look(&mut self, decision: &Decision) {
        self.look_at(&decision.status, &decision.verdicts, decision.outputs.mode);
    }

    /// The same of what was kept of a cycle.
    pub fn look_at(&mut self, status: &Status, verdicts: &Verdicts, mode: DrivingMode) {
        self.cycles += 1;
        let seen = [
            named("occupancy", status.occupancy),
            named("shutdown", status.stage),
            named("mitigation", status.level),
            named("mode", status.mode),
            named("exit", status.exit),
            named("record", status.record),
            named("mode output", mode),
            named("safe state", status.safe_state),
            named("parked by leave", status.parked_by_leave),
        ];
        self.modes.extend(seen);
        for (channel, verdict) in verdicts.iter() {
            self.reasons.insert(verdict.reason);
            self.verdicts.insert((channel, verdict.kind, verdict.reason));
        }
    }

    /// How many different modes and verdicts were seen.
    #[must_use]
    pub fn size(&self) -> usize {
        self.modes.len() + self.verdicts.len()
    }

    /// The modes that were not reached.
    #[must_use]
    pub fn modes_missing(&self) -> Vec<String> {
        modes().difference(&self.modes).cloned().collect()
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
