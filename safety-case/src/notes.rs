//! What was odd in the logs: counted, and the first few of each kind named with file and line.

use std::collections::BTreeMap;
use std::path::PathBuf;

use serde::Serialize;

use crate::candump::{Malformed, Skipped};
use crate::road::Refused;

/// How many places of each kind are kept.
const PLACES: usize = 3;
/// How many different identifiers are kept; there may be 2²⁹.
const IDENTIFIERS: usize = 1024;

/// A line of a log.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Place {
    /// Which log, counted from 0.
    pub file: usize,
    /// Which line, counted from 1; 0 speaks of the file as a whole.
    pub line: u64,
}

/// A kind of oddity. None of them ends the replay.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Oddity {
    /// Not a line of candump.
    Malformed(Malformed),
    /// The file breaks off: truncated or damaged compression, a read error.
    Broken,
    /// A frame that carries no data for us.
    Skipped(Skipped),
    /// A frame of a bus that was not asked for.
    OtherBus,
    /// Frames missing by the counter of the next one, few enough to be tolerated.
    Lost,
    /// A time stamp earlier than the one before, by less than a cycle.
    OutOfOrder,
    /// A time stamp earlier than the one before, by a cycle or more: the clock went back (SELF-3).
    Backwards,
    /// A time stamp far ahead: the clock was set (SELF-3).
    Ahead,
}

impl Oddity {
    /// For people.
    #[must_use]
    pub fn text(&self) -> String {
        match self {
            Self::Malformed(why) => format!("lines not understood: {}", why.text()),
            Self::Broken => "logs that break off".to_owned(),
            Self::Skipped(kind) => format!("skipped: {}", kind.text()),
            Self::OtherBus => "skipped: frames of another bus".to_owned(),
            Self::Lost => "frames missing by the counter of the next, tolerated".to_owned(),
            Self::OutOfOrder => "time stamps out of order by less than a cycle (counted for the next cycle)".to_owned(),
            Self::Backwards => "time stamps that run backwards (clock fault, SELF-3)".to_owned(),
            Self::Ahead => "time stamps that leap ahead by more than an hour (clock fault, SELF-3)".to_owned(),
        }
    }
}

/// One kind of oddity, or one unknown identifier.
#[derive(Clone, Debug, Default)]
struct Note {
    count: u64,
    places: Vec<(Place, String)>,
}

impl Note {
    fn begin(place: Place) -> Self {
        Self { count: 1, places: vec![(place, String::new())] }
    }
    fn add(&mut self, place: Place, detail: impl FnOnce() -> String) {
        self.count += 1;
        if self.places.len() < PLACES {
            self.places.push((place, detail()));
        }
    }
}

/// Everything odd, in bounded memory.
#[derive(Debug, Default)]
pub struct Notes {
    files: Vec<PathBuf>,
    kinds: BTreeMap<Oddity, Note>,
    refused: Vec<(Refused, Note)>,
    unknown: std::collections::HashMap<(bool, u32), Note>,
    /// Frames whose identifier found no more room.
    beyond: u64,
}

/// One line of the report.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct NoteLine {
    /// What.
    pub what: String,
    /// How often.
    pub count: u64,
    /// The first places, `file:line` and what stood there.
    pub first: Vec<String>,
}

impl Notes {
    /// Nothing odd yet in these logs.
    #[must_use]
    pub fn new(files: Vec<PathBuf>) -> Self {
        Self { files, ..Self::default() }
    }

    /// Counts one; `detail` is made only for the first few.
    pub fn add(&mut self, kind: Oddity, place: Place, detail: impl FnOnce() -> String) {
        self.kinds.entry(kind).or_default().add(place, detail);
    }

    /// Counts a frame that was refused.
    pub fn refuse(&mut self, why: Refused, place: Place) {
        // Few different ones: a list is as fast as a map.
        match self.refused.iter_mut().find(|(known, _)| *known == why) {
            Some((_, note)) => note.add(place, String::new),
            None => self.refused.push((why, Note::begin(place))),
        }
    }

    /// Counts a frame whose identifier means nothing to us.
    pub fn unknown(&mut self, extended: bool, id: u32, place: Place) {
        let room = self.unknown.len() < IDENTIFIERS;
        match self.unknown.entry((extended, id)) {
            std::collections::hash_map::Entry::Occupied(note) => note.into_mut().add(place, String::new),
            std::collections::hash_map::Entry::Vacant(slot) if room => {
                slot.insert(Note::begin(place));
            }
            std::collections::hash_map::Entry::Vacant(_) => self.beyond += 1,
        }
    }

    /// How many of this kind.
    #[must_use]
    pub fn count(&self, kind: &Oddity) -> u64 {
        self.kinds.get(kind).map_or(0, |note| note.count)
    }

    /// How many lines were not understood.
    #[must_use]
    pub fn malformed(&self) -> u64 {
        self.kinds.iter().filter(|(kind, _)| matches!(kind, Oddity::Malformed(_))).map(|(_, note)| note.count).sum()
    }

    /// How many frames were refused.
    #[must_use]
    pub fn refused(&self) -> u64 {
        self.refused.iter().map(|(_, note)| note.count).sum()
    }

    /// How many frames had an unknown identifier.
    #[must_use]
    pub fn unknown_frames(&self) -> u64 {
        self.unknown.values().map(|note| note.count).sum::<u64>() + self.beyond
    }

    /// A place, for people.
    #[must_use]
    pub fn place(&self, place: Place) -> String {
        let file = self.files.get(place.file).map_or_else(|| "?".to_owned(), |file| file.display().to_string());
        if place.line == 0 { file } else { format!("{file}:{}", place.line) }
    }

    /// Everything, one line per kind; unknown identifiers last, the most frequent first.
    #[must_use]
    pub fn lines(&self) -> Vec<NoteLine> {
        let line = |what, note: &Note| NoteLine {
            what,
            count: note.count,
            first: note
                .places
                .iter()
                .map(|(place, detail)| {
                    let place = self.place(*place);
                    if detail.is_empty() { place } else { format!("{place}: {detail}") }
                })
                .collect(),
        };
        let mut lines: Vec<NoteLine> = self.kinds.iter().map(|(kind, note)| line(kind.text(), note)).collect();
        let mut refused: Vec<_> = self.refused.iter().collect();
        refused.sort_by_key(|(_, note)| std::cmp::Reverse(note.count));
        lines.extend(refused.into_iter().map(|(why, note)| line(format!("refused: {why}"), note)));
        let mut unknown: Vec<_> = self.unknown.iter().collect();
        unknown.sort_by_key(|(id, note)| (std::cmp::Reverse(note.count), **id));
        lines.extend(unknown.into_iter().map(|((extended, id), note)| {
            let id = if *extended { format!("{id:08X}") } else { format!("{id:03X}") };
            line(format!("unknown identifier {id}"), note)
        }));
        if self.beyond > 0 {
            let what = format!("more unknown identifiers than {IDENTIFIERS}");
            lines.push(NoteLine { what, count: self.beyond, first: Vec::new() });
        }
        lines
    }
}

#[cfg(test)]
mod tests {
    use super::{Notes, Oddity, Place};

    #[test]
    fn keeps_the_first_places_and_counts_the_rest() {
        let mut notes = Notes::new(vec!["a.log".into()]);
        for line in 1..=9 {
            notes.add(Oddity::OtherBus, Place { file: 0, line }, || format!("can{line}"));
        }
        let lines = notes.lines();
        assert_eq!(lines.len(), 1);
        assert_eq!(lines.first().map(|line| line.count), Some(9));
        let first = lines.into_iter().next().map(|line| line.first).unwrap_or_default();
        assert_eq!(first, ["a.log:1: can1", "a.log:2: can2", "a.log:3: can3"]);
    }

    #[test]
    fn memory_is_bounded_for_any_number_of_identifiers() {
        let mut notes = Notes::new(Vec::new());
        for id in 0..5000 {
            notes.unknown(true, id, Place::default());
        }
        assert_eq!(notes.unknown_frames(), 5000);
        assert_eq!(notes.lines().len(), super::IDENTIFIERS + 1);
    }
}
