//! The summary of a replay: how many frames and cycles, which verdicts, which interventions.

use std::collections::BTreeMap;
use std::fmt::Write;

use serde::Serialize;
use supervisor::{Channel, Reason};

use crate::lanes::{LANES, channel, verdict};
use crate::number::{grouped, seconds};
use crate::road::snake;
use crate::runs::{Run, Sink};
use crate::stretches::Stretch;
use crate::words;

/// How often a channel got a verdict for a reason.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Count {
    /// The channel.
    pub channel: String,
    /// `pass`, `limit`, `substitute`, `block`.
    pub kind: String,
    /// The reason's name.
    pub reason: String,
    /// The requirement behind it.
    pub requirement: &'static str,
    /// The reason in a sentence.
    pub sentence: &'static str,
    /// How many cycles.
    pub cycles: u64,
    /// How many times it began.
    pub times: u64,
    /// The longest stretch in seconds.
    pub longest_s: f64,
}

/// The longest intervention.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Longest {
    /// The channel.
    pub channel: String,
    /// When it began, in seconds on the axis.
    pub from_s: f64,
    /// When it ended.
    pub to_s: f64,
    /// Kind, numbers and reason in words.
    pub text: String,
}

/// Counted while the replay goes on.
#[derive(Debug, Default)]
pub struct Summary {
    verdicts: BTreeMap<(usize, u16), (u64, u64, u64)>,
    interventions: u64,
    brief: u64,
    longest: Option<(u64, Longest)>,
    commanded: bool,
}

impl Sink for Summary {
    fn ended(&mut self, run: &Run) {
        if channel(run.lane).is_none() {
            return;
        }
        let (cycles, times, longest) = self.verdicts.entry((run.lane, run.code)).or_default();
        *cycles += run.cycles;
        *times += 1;
        *longest = run.cycles.max(*longest);
        self.commanded |= run.detail.as_ref().is_some_and(|detail| detail.commanded);
    }
}

impl Summary {
    /// A stretch without a pass has ended.
    pub fn stretch(&mut self, stretch: &Stretch) {
        if !stretch.intervenes() {
            self.brief += 1;
            return;
        }
        self.interventions += 1;
        if self.longest.as_ref().is_none_or(|(cycles, _)| stretch.cycles > *cycles) {
            let longest = Longest {
                channel: words::channel(stretch.channel).to_owned(),
                from_s: seconds(stretch.from),
                to_s: seconds(stretch.to),
                text: stretch.text().to_owned(),
            };
            self.longest = Some((stretch.cycles, longest));
        }
    }

    /// Stretches of more than three cycles without a pass.
    #[must_use]
    pub const fn interventions(&self) -> u64 {
        self.interventions
    }

    /// Stretches of up to three cycles without a pass.
    #[must_use]
    pub const fn brief(&self) -> u64 {
        self.brief
    }

    /// Whether any channel was ever asked for anything.
    #[must_use]
    pub const fn commanded(&self) -> bool {
        self.commanded
    }

    /// The longest intervention.
    #[must_use]
    pub fn longest(&self) -> Option<&Longest> {
        self.longest.as_ref().map(|(_, longest)| longest)
    }

    /// Channel by channel, kind by kind, reason by reason.
    #[must_use]
    pub fn counts(&self) -> Vec<Count> {
        let count = |(&(lane, code), &(cycles, times, longest)): (&(usize, u16), &(u64, u64, u64))| {
            let channel = channel(lane)?;
            let (kind, reason) = verdict(code);
            let (sentence, requirement) = (words::reason(reason).0, words::requirement(channel, reason));
            Some(Count {
                channel: snake(&channel),
                kind: snake(&kind),
                reason: format!("{reason:?}"),
                requirement,
                sentence,
                cycles,
                times,
                longest_s: seconds(longest * crate::cycle::CYCLE),
            })
        };
        self.verdicts.iter().filter_map(count).collect()
    }

    /// Cycles of a channel by kind: pass, limit, substitute, block, and apart from these block for want of a command.
    #[must_use]
    pub fn by_kind(&self, wanted: Channel) -> [u64; 5] {
        let mut cycles = [0; 5];
        for ((lane, code), (count, ..)) in &self.verdicts {
            if channel(*lane) == Some(wanted) {
                let (kind, reason) = verdict(*code);
                let column = if reason == Reason::CommandLost { 4 } else { usize::from(kind.code()) };
                if let Some(slot) = cycles.get_mut(column) {
                    *slot += count;
                }
            }
        }
        cycles
    }

    /// The table of verdicts, in text.
    #[must_use]
    pub fn table(&self) -> String {
        let mut text = format!(
            "{:<14}{:>12}{:>12}{:>12}{:>12}{:>12}\n",
            "cycles", "pass", "limit", "substitute", "block", "no command"
        );
        for (index, wanted) in Channel::ALL.iter().enumerate() {
            let title = LANES.get(index).map_or("", |lane| lane.title.as_str());
            let _ = write!(text, "{title:<14}");
            for count in self.by_kind(*wanted) {
                let count = if count == 0 { "·".to_owned() } else { grouped(count) };
                let _ = write!(text, "{count:>12}");
            }
            text.push('\n');
        }
        text
    }
}
