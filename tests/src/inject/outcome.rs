//! The verdict on one run.

use supervisor::Faults;

use super::baseline::Said;
use super::harm::{Ftti, Goal, Harm};
use crate::judge::GRACE_CYCLES;
use crate::plant::CYCLE_MS;

/// What came of a fault.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Outcome {
    /// No goal is violated, with the supervisor or without it.
    Harmless,
    /// Without the supervisor a goal is violated; it reacted in time, and none is.
    Averted,
    /// A goal is violated; the supervisor reported a fault in time.
    Reported,
    /// The supervisor reacted, but later than the FTTI.
    Late,
    /// A goal is violated, and nothing was reported; or nothing happened that could have averted it.
    Missed,
}

/// The verdict on one run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Verdict {
    /// What came of the fault.
    pub outcome: Outcome,
    /// The goal whose time runs out first.
    pub goal: Option<Goal>,
    /// From the moment from which its FTTI counts to the reaction, in ms; 0 if it came before.
    pub detection_ms: Option<u32>,
}

/// When the supervisor first reacted, in ms.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Reaction {
    /// It refused, substituted or reported.
    pub any_ms: Option<u32>,
    /// It reported a fault, or actuators no longer listen to it.
    pub report_ms: Option<u32>,
    /// What it reported, as the bits of its faults; none: they no longer listen.
    pub faults: u32,
}

/// Looks for the reaction, cycle by cycle.
#[derive(Clone, Debug, Default)]
pub struct Listener {
    /// For each channel, since how many cycles it is refused where it passes without the fault.
    refused: [usize; 16],
    brief_ms: Option<u32>,
    reaction: Reaction,
}

impl Listener {
    /// What it says, and what it says in the same cycle without the fault.
    pub fn hear(&mut self, now_ms: u32, said: &Said, usual: Option<&Said>) {
        let usual = usual.copied().unwrap_or(Said { refused: 0, faults: 0, safe_state: false, heard: true });
        let report = said.faults & !usual.faults != 0 || said.safe_state != usual.safe_state || !said.heard;
        if report {
            if self.reaction.report_ms.is_none() {
                self.reaction.faults = said.faults & !usual.faults;
            }
            self.reaction.report_ms.get_or_insert(now_ms);
            self.reaction.any_ms.get_or_insert(now_ms);
        }
        let unusual = said.refused & !usual.refused;
        if unusual != 0 {
            self.brief_ms.get_or_insert(now_ms);
        }
        for (number, cycles) in (0_u32..).zip(&mut self.refused) {
            *cycles = if unusual & 1_u16.rotate_left(number) == 0 { 0 } else { cycles.saturating_add(1) };
            // As for interventions: shorter ones may be the controller's own lag.
            if *cycles == GRACE_CYCLES + 1 {
                let ago = u32::try_from(GRACE_CYCLES).unwrap_or(0).saturating_mul(CYCLE_MS);
                let began = now_ms.saturating_sub(ago);
                let any = self.reaction.any_ms.get_or_insert(began);
                *any = began.min(*any);
            }
        }
    }

    /// The reaction. Where none lasted, the first brief refusal.
    #[must_use]
    pub fn reaction(&self) -> Reaction {
        Reaction { any_ms: self.reaction.any_ms.or(self.brief_ms), ..self.reaction }
    }
}

/// `without` and `with` are the goals that are violated without and with the supervisor. `begins` is given for a fault
/// that endangers SG-13 by being there: its time.
#[must_use]
pub fn verdict(without: &[Harm], with: &[Harm], begins: Option<u32>, reaction: Reaction, ftti: &Ftti) -> Verdict {
    let itself = begins.map(|from_ms| Harm { goal: Goal::OF_THE_SUPERVISOR, from_ms });
    let allowed = |harm: &Harm| ftti.get(&harm.goal).copied().unwrap_or(0);
    let all = without.iter().chain(with).chain(&itself);
    let Some(first) = all.min_by_key(|harm| harm.from_ms.saturating_add(allowed(harm))) else {
        return Verdict { outcome: Outcome::Harmless, goal: None, detection_ms: None };
    };
    let after = |at: Option<u32>| at.map(|at| at.saturating_sub(first.from_ms));
    let (detection_ms, report_ms) = (after(reaction.any_ms), after(reaction.report_ms));
    let in_time = |after: Option<u32>| after.is_some_and(|after| after <= allowed(first));
    let outcome = if with.is_empty() {
        match detection_ms {
            Some(_) if in_time(detection_ms) => Outcome::Averted,
            Some(_) => Outcome::Late,
            None => Outcome::Missed,
        }
    } else {
        match report_ms {
            Some(_) if in_time(report_ms) => Outcome::Reported,
            Some(_) => Outcome::Late,
            None => Outcome::Missed,
        }
    };
    Verdict { outcome, goal: Some(first.goal), detection_ms: if with.is_empty() { detection_ms } else { report_ms } }
}

/// Hints are no reports.
const _: () = assert!(Faults::HINTS.bits() != 0);
