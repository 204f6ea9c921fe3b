//! The timeline for people: what happened, when, for how long, and why. In bounded memory.

use std::collections::{BTreeMap, BinaryHeap};

use supervisor::{Cause, Channel, Kind, Reason};

use crate::lanes::{Group, LANES, Lane, Tone, cause, channel, verdict};
use crate::number::seconds;
use crate::physical::sentence;
use crate::runs::{Run, Sink};

/// The same thing again within this is one entry: half a second.
const AGAIN: u64 = 500_000;
/// Lanes that begin, and end, this close together may be told together: 0.15 s.
const TOGETHER: u64 = 150_000;

/// One line.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Entry {
    /// Beginning, in microseconds on the axis.
    pub from: u64,
    /// End.
    pub to: u64,
    /// In the order of the lanes.
    lane: usize,
    /// Which channel or state.
    pub what: String,
    /// What happened to it, and why.
    pub text: String,
    /// How often, in short succession.
    pub times: u64,
    /// A verdict that is no pass.
    pub act: bool,
    /// What several of its kind are called; empty if they stay apart.
    crowd: &'static str,
}

impl Entry {
    /// "12.34–12.91".
    #[must_use]
    pub fn time(&self) -> String {
        format!("{:.2}–{:.2}", seconds(self.from), seconds(self.to))
    }
}

/// Keeps the entries that begin first, and counts the rest.
#[derive(Debug)]
pub struct Timeline {
    most: usize,
    kept: BinaryHeap<Entry>,
    left_out: u64,
    /// By lane and code: the last entry, which may still grow.
    growing: BTreeMap<(usize, u16), (Entry, i64)>,
}

impl Timeline {
    /// A timeline of at most so many entries.
    #[must_use]
    pub fn new(most: usize) -> Self {
        Self { most, kept: BinaryHeap::new(), left_out: 0, growing: BTreeMap::new() }
    }

    /// An event without a lane.
    pub fn event(&mut self, at: u64, what: &str, text: String) {
        self.span(at, at, what, text);
    }

    /// Something without a lane that lasted.
    pub fn span(&mut self, from: u64, to: u64, what: &str, text: String) {
        self.keep(Entry { from, to, lane: 0, what: what.to_owned(), text, times: 1, act: false, crowd: "" });
    }

    fn keep(&mut self, entry: Entry) {
        self.kept.push(entry);
        if self.kept.len() > self.most {
            self.kept.pop();
            self.left_out += 1;
        }
    }

    /// The entries in the order of their beginnings, and how many did not find room.
    #[must_use]
    pub fn finish(mut self) -> (Vec<Entry>, u64) {
        for (_, (entry, _)) in std::mem::take(&mut self.growing) {
            self.keep(entry);
        }
        (gathered(self.kept.into_sorted_vec()), self.left_out)
    }
}

impl Sink for Timeline {
    fn ended(&mut self, run: &Run) {
        let Some((text, margin)) = told(run) else { return };
        let Some(lane) = LANES.get(run.lane) else { return };
        let key = (run.lane, run.code);
        if let Some((entry, worst)) = self.growing.get_mut(&key)
            && run.from.saturating_sub(entry.to) <= AGAIN
        {
            (entry.to, entry.times) = (run.to, entry.times + 1);
            if margin < *worst {
                (entry.text, *worst) = (text, margin);
            }
            return;
        }
        let act = lane.group == Group::Verdict;
        let what = lane.title.clone();
        let crowd = crowd(lane, run.code);
        let entry = Entry { from: run.from, to: run.to, lane: run.lane, what, text, times: 1, act, crowd };
        if let Some((ended, _)) = self.growing.insert(key, (entry, margin)) {
            self.keep(ended);
        }
    }
}

/// What several lanes with this code are called.
fn crowd(lane: &Lane, code: u16) -> &'static str {
    match lane.group {
        Group::Verdict if matches!(verdict(code).1, Reason::CommandLost | Reason::CommandRejected) => "channels",
        Group::Input | Group::Actuator if cause(code).is_some() => "inputs",
        Group::Input if lane.key.starts_with("seat") => "seat sensors",
        Group::Input => "sensors",
        Group::Fault => "faults",
        Group::Verdict | Group::State | Group::Actuator | Group::Warning => "",
    }
}

/// What there is to say of a run, and its margin; nothing of what is as it should be.
fn told(run: &Run) -> Option<(String, i64)> {
    let lane = LANES.get(run.lane)?;
    let text = || Some((lane.says(run.code).into_owned(), 0));
    match lane.group {
        Group::Verdict => act(channel(run.lane)?, run),
        Group::State => match (lane.key.as_str(), run.code) {
            ("occupancy", _) => text(),
            (_, 0) => None,
            _ => text(),
        },
        Group::Actuator => match (lane.tone)(run.code) {
            _ if lane.key.ends_with("_asked") => None,
            Tone::Alarm | Tone::Caution | Tone::Refusal => text(),
            Tone::Good | Tone::Note if cause(run.code).is_none() => text(),
            Tone::Idle | Tone::Void | Tone::Good | Tone::Note => None,
        },
        // Its episodes are told one by one.
        Group::Fault if lane.key == "dm1" => None,
        Group::Warning | Group::Fault => {
            (run.code != 0).then(|| (if lane.group == Group::Fault { "fault" } else { "on" }.to_owned(), 0))
        }
        Group::Input => match cause(run.code) {
            Some(Cause::Stale | Cause::EndToEnd | Cause::OutOfRange | Cause::Requalifying) => text(),
            None if lane.key == "seat_a" || lane.key == "seat_b" => text(),
            None if matches!(lane.key.as_str(), "radar" | "camera") && run.code == 0 => text(),
            Some(Cause::NeverReceived | Cause::NotAvailable) | None => None,
        },
    }
}

fn act(channel: Channel, run: &Run) -> Option<(String, i64)> {
    let detail = run.detail.as_ref().filter(|detail| detail.worst.kind != Kind::Pass)?;
    Some((sentence(channel, detail), i64::from(detail.worst.margin)))
}

/// Several lanes that say the same at about the same time are one entry: "385.66–387.55  9 inputs  stale".
fn gathered(entries: Vec<Entry>) -> Vec<Entry> {
    let near = |a: u64, b: u64| a.abs_diff(b) <= TOGETHER;
    let mut found: Vec<(Entry, Vec<String>)> = Vec::new();
    for entry in entries {
        let common = found.iter_mut().rev().take_while(|(first, _)| near(first.from, entry.from)).find(|(first, _)| {
            !entry.crowd.is_empty()
                && (first.crowd, &first.text) == (entry.crowd, &entry.text)
                && near(first.to, entry.to)
        });
        if let Some((first, names)) = common {
            first.to = first.to.max(entry.to);
            names.push(entry.what);
        } else {
            let name = entry.what.clone();
            found.push((entry, vec![name]));
        }
    }
    let one = |(mut entry, names): (Entry, Vec<String>)| {
        if let [_, _, ..] = names.as_slice() {
            entry.what = format!("{} {}", names.len(), entry.crowd);
            entry.text = format!("{}: {}", entry.text, names.join(", "));
        }
        entry
    };
    found.into_iter().map(one).collect()
}

#[cfg(test)]
mod tests {
    use super::{Entry, Timeline};
    use crate::lanes::LANES;
    use crate::runs::{Run, Sink};

    fn run(key: &str, code: u16, from: u64, to: u64) -> Run {
        let lane = LANES.iter().position(|lane| lane.key == key).unwrap_or(usize::MAX);
        Run { lane, code, from, to, cycles: (to - from) / 10_000, detail: None }
    }

    fn entries(runs: &[Run], most: usize) -> (Vec<Entry>, u64) {
        let mut timeline = Timeline::new(most);
        for run in runs {
            timeline.ended(run);
        }
        timeline.finish()
    }

    #[test]
    fn flicker_is_one_entry() {
        let runs: Vec<Run> = (0..10).map(|index| run("level", 1, index * 100_000, index * 100_000 + 50_000)).collect();
        let (entries, left_out) = entries(&runs, 100);
        assert_eq!((entries.len(), left_out), (1, 0));
        assert!(entries.first().is_some_and(|entry| entry.times == 10 && entry.time() == "0.00–0.95"));
    }

    #[test]
    fn the_first_are_kept_and_the_rest_counted() {
        let mut runs: Vec<Run> = (0..10)
            .map(|index| run("level", 1, 1_000_000 + index * 1_000_000, 1_000_001 + index * 1_000_000))
            .collect();
        // What began first may end last.
        runs.push(run("safe_state", 1, 0, 99_000_000));
        let (entries, left_out) = entries(&runs, 3);
        assert_eq!(left_out, 8);
        assert!(entries.iter().map(|entry| entry.from).eq([0, 1_000_000, 2_000_000]));
    }

    #[test]
    fn lanes_that_say_the_same_are_told_together() {
        let stale = 1000 + u16::from(supervisor::Cause::Stale.code());
        let runs = [("wheel_speed", 0), ("motor_speed", 50_000), ("gear_confirmed", 100_000), ("key", 5_000_000)];
        let runs = runs.map(|(key, from)| run(key, stale, from, from + 1_000_000));
        let (entries, _) = entries(&runs, 9);
        let texts: Vec<&str> = entries.iter().map(|entry| entry.text.as_str()).collect();
        assert_eq!(
            texts,
            ["stale: no frame in time: wheel speed, motor speed, gear confirmed", "stale: no frame in time"]
        );
        assert_eq!(entries.first().map(|entry| (entry.what.as_str(), entry.to)), Some(("3 inputs", 1_100_000)));
    }

    #[test]
    fn what_is_as_it_should_be_is_not_told() {
        assert_eq!(entries(&[run("level", 0, 0, 1), run("wheel_speed", 0, 0, 1), run("clock", 0, 0, 1)], 9).0, []);
    }
}
