//! Interventions: stretches in which a channel's command did not pass.
//!
//! Spec §9 counts one only when the controller is still short after three cycles: the supervisor decides on the
//! inputs of the very cycle, a controller that reads the same frames answers in the next one at the earliest. A
//! stretch counts once, whatever its reasons. A channel that nobody has commanded yet is no stretch, nor are lamps
//! that nobody has commanded: nothing was asked for, and while the link starts, nothing can be. But an obligation to
//! brake, for example, is an intervention however silent the controller is.

use std::collections::BTreeSet;

use supervisor::{Channel, Kind, Reason};

use crate::lanes::{CHANNELS, channel, verdict};
use crate::physical::sentence;
use crate::runs::Run;

/// A controller that is short for no more cycles than this was not intervened against.
pub const BRIEF: u64 = 3;

/// A stretch without a pass.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Stretch {
    /// The channel.
    pub channel: Channel,
    /// Beginning, in microseconds on the axis.
    pub from: u64,
    /// End.
    pub to: u64,
    /// How many cycles.
    pub cycles: u64,
    /// Every reason in it.
    pub reasons: BTreeSet<Reason>,
    /// Its longest verdict in words, and how long that was.
    text: (u64, String),
}

impl Stretch {
    /// Whether it is an intervention.
    #[must_use]
    pub const fn intervenes(&self) -> bool {
        self.cycles > BRIEF
    }
    /// Its longest verdict in words.
    #[must_use]
    pub fn text(&self) -> &str {
        &self.text.1
    }
}

/// Joins the verdicts of each channel to stretches.
#[derive(Debug, Default)]
pub struct Stretches {
    open: [Option<Stretch>; CHANNELS],
}

impl Stretches {
    /// Takes a run that has ended; gives the stretch that ended before it.
    pub fn ended(&mut self, run: &Run) -> Option<Stretch> {
        let channel = channel(run.lane)?;
        let open = self.open.get_mut(run.lane)?;
        let (kind, reason) = verdict(run.code);
        let commanded = run.detail.as_ref().is_some_and(|detail| detail.commanded);
        let lamps = matches!(channel, Channel::Warnings | Channel::Body);
        let silent = !commanded && (lamps || matches!(reason, Reason::CommandLost | Reason::CommandRejected));
        if kind == Kind::Pass || silent {
            return open.take();
        }
        let stretch = open.get_or_insert_with(|| Stretch {
            channel,
            from: run.from,
            to: run.to,
            cycles: 0,
            reasons: BTreeSet::new(),
            text: (0, String::new()),
        });
        stretch.to = run.to;
        stretch.cycles += run.cycles;
        stretch.reasons.insert(reason);
        if run.cycles > stretch.text.0 {
            let text = run.detail.as_ref().map(|detail| sentence(channel, detail)).unwrap_or_default();
            stretch.text = (run.cycles, text.split_whitespace().collect::<Vec<_>>().join(" "));
        }
        None
    }

    /// The stretches that the log cut off.
    pub fn finish(self) -> impl Iterator<Item = Stretch> {
        self.open.into_iter().flatten()
    }
}

#[cfg(test)]
mod tests {
    use super::{Stretch, Stretches};
    use crate::runs::{Detail, Run};
    use supervisor::{Commands, Kind, Outputs, Reason, Verdict};

    fn stretches(runs: &[(Kind, Reason, u64, bool)]) -> Vec<(u64, u64, usize)> {
        let (mut stretches, mut found, mut at) = (Stretches::default(), Vec::<Stretch>::new(), 0);
        for (kind, reason, cycles, commanded) in runs {
            let (worst, asked, given) = (Verdict::PASS, Commands::ABSENT, Outputs::NEUTRAL);
            let detail = Some(Box::new(Detail { worst, asked, given, commanded: *commanded, usable: *commanded }));
            let code = u16::from_le_bytes([reason.code(), kind.code()]);
            let run = Run { lane: 0, code, from: at, to: at + cycles * 10_000, cycles: *cycles, detail };
            at = run.to;
            found.extend(stretches.ended(&run));
        }
        found.extend(stretches.finish());
        found
            .iter()
            .filter(|stretch| stretch.intervenes())
            .map(|each| (each.from, each.cycles, each.reasons.len()))
            .collect()
    }

    #[test]
    fn three_cycles_are_no_intervention_four_are() {
        let pass = (Kind::Pass, Reason::Within, 10, true);
        let limit = |cycles| (Kind::Limit, Reason::TorqueRamp, cycles, true);
        assert_eq!(stretches(&[pass, limit(3), pass]), []);
        assert_eq!(stretches(&[pass, limit(4), pass]), [(100_000, 4, 1)]);
        assert_eq!(stretches(&[pass, limit(4)]), [(100_000, 4, 1)], "also at the end of the log");
    }

    #[test]
    fn a_stretch_counts_once_whatever_its_reasons() {
        let pass = (Kind::Pass, Reason::Within, 10, true);
        let runs =
            [pass, (Kind::Limit, Reason::TorqueRamp, 2, true), (Kind::Block, Reason::BrakeDemand, 2, true), pass];
        assert_eq!(stretches(&runs), [(100_000, 4, 2)]);
    }

    #[test]
    fn a_channel_that_nobody_has_commanded_is_not_intervened_against() {
        let lost = |commanded| (Kind::Block, Reason::CommandLost, 10_000, commanded);
        assert_eq!(stretches(&[lost(false)]), []);
        assert_eq!(stretches(&[lost(true)]), [(0, 10_000, 1)]);
        let obliged = (Kind::Substitute, Reason::Mitigation, 4, false);
        assert_eq!(stretches(&[lost(false), obliged]), [(100_000_000, 4, 1)], "but an obligation is one");
    }
}
