//! The bars of a lane in bounded memory, without ever dropping a verdict.
//!
//! Long stretches stay as they are. Where stretches are so many and so short that they could not be told apart on
//! the screen, neighbours are gathered into one bar, which takes the colour of the gravest and names them all.

use std::fmt::Write;

use crate::cycle::CYCLE;
use crate::lanes::{Lane, Tone, channel, verdict};
use crate::number::{grouped, seconds};
use crate::physical::facts;
use crate::runs::Run;
use supervisor::Kind;

/// How many bars a lane has at most.
pub const BARS: usize = 1000;

/// What a bar gathers of one code.
#[derive(Clone, Debug)]
struct Part {
    code: u16,
    runs: u64,
    cycles: u64,
    /// The numbers of the worst verdict, and its margin.
    numbers: String,
    margin: i32,
}

/// One bar.
#[derive(Clone, Debug)]
pub struct Bar {
    /// Beginning in microseconds.
    pub from: u64,
    /// End.
    pub to: u64,
    parts: Vec<Part>,
}

/// How grave a tone is: the graver wins the colour.
const fn gravity(tone: Tone) -> u8 {
    match tone {
        Tone::Idle => 0,
        Tone::Void => 1,
        Tone::Good => 2,
        Tone::Note => 3,
        Tone::Caution => 4,
        Tone::Refusal => 5,
        Tone::Alarm => 6,
    }
}

impl Bar {
    fn of(run: &Run) -> Self {
        let detail = run.detail.as_ref().filter(|_| verdict(run.code).0 != Kind::Pass);
        let channel = channel(run.lane);
        let (numbers, margin) = match (detail, channel) {
            (Some(detail), Some(channel)) => (facts(channel, detail), detail.worst.margin),
            _ => (String::new(), 0),
        };
        let part = Part { code: run.code, runs: 1, cycles: run.cycles, numbers, margin };
        Self { from: run.from, to: run.to, parts: vec![part] }
    }

    fn gather(&mut self, later: Self) {
        self.to = later.to;
        for part in later.parts {
            match self.parts.iter_mut().find(|known| known.code == part.code) {
                None => self.parts.push(part),
                Some(known) => {
                    known.runs += part.runs;
                    known.cycles += part.cycles;
                    if part.margin < known.margin {
                        (known.margin, known.numbers) = (part.margin, part.numbers);
                    }
                }
            }
        }
    }

    /// The gravest tone in it.
    #[must_use]
    pub fn tone(&self, lane: &Lane) -> Tone {
        self.parts.iter().map(|part| (lane.tone)(part.code)).max_by_key(|tone| gravity(*tone)).unwrap_or(Tone::Idle)
    }

    /// What stands in it, if it is of one kind.
    #[must_use]
    pub fn label(&self, lane: &Lane) -> String {
        match self.parts.as_slice() {
            [only] => lane.label(only.code).into_owned(),
            _ => String::new(),
        }
    }

    /// What it says on hover.
    #[must_use]
    pub fn hover(&self, lane: &Lane) -> String {
        let mut text = format!("<b>{}</b>  {:.2}–{:.2} s", lane.title, seconds(self.from), seconds(self.to));
        let mut parts: Vec<&Part> = self.parts.iter().collect();
        parts.sort_by_key(|part| std::cmp::Reverse((gravity((lane.tone)(part.code)), part.cycles)));
        for part in parts {
            text.push_str("<br>");
            text.push_str(&lane.says(part.code));
            if !part.numbers.is_empty() {
                text.push_str("<br>");
                text.push_str(&part.numbers);
            }
            if self.parts.len() > 1 {
                let _ = write!(text, "<br><i>{} cycles in {} stretches</i>", grouped(part.cycles), grouped(part.runs));
            }
        }
        text
    }
}

/// The bars of one lane.
#[derive(Clone, Debug, Default)]
pub struct Bars {
    bars: Vec<Bar>,
    /// Neighbours that together are no longer than this are gathered.
    grain: u64,
}

impl Bars {
    /// Takes the next stretch.
    pub fn push(&mut self, run: &Run) {
        self.bars.push(Bar::of(run));
        if self.bars.len() >= 2 * BARS {
            self.gather();
        }
    }

    /// Gathers at the present grain, and at twice that as often as it takes.
    fn gather(&mut self) {
        loop {
            let mut gathered: Vec<Bar> = Vec::with_capacity(2 * BARS);
            for bar in self.bars.drain(..) {
                match gathered.last_mut() {
                    Some(last) if bar.to.saturating_sub(last.from) <= self.grain => last.gather(bar),
                    _ => gathered.push(bar),
                }
            }
            self.bars = gathered;
            if self.bars.len() <= BARS {
                break;
            }
            self.grain = self.grain.saturating_mul(2).max(2 * CYCLE);
        }
    }

    /// All of them, at most [`BARS`].
    #[must_use]
    pub fn finish(mut self) -> Vec<Bar> {
        if self.bars.len() > BARS {
            self.gather();
        }
        self.bars
    }
}

#[cfg(test)]
mod tests {
    use super::{BARS, Bars};
    use crate::lanes::{LANES, Tone};
    use crate::runs::Run;
    use supervisor::{Kind, Reason};

    fn run(kind: Kind, reason: Reason, from: u64, cycles: u64) -> Run {
        let code = u16::from_le_bytes([reason.code(), kind.code()]);
        Run { lane: 2, code, from, to: from + cycles * 10_000, cycles, detail: None }
    }

    #[test]
    fn no_verdict_is_dropped_however_many_there_are() {
        let mut bars = Bars::default();
        let mut at = 0;
        let mut push = |kind, reason, cycles| {
            let run = run(kind, reason, at, cycles);
            at = run.to;
            bars.push(&run);
        };
        // A single substitution of one cycle in the middle of 200 000 flickering limits, and one long block.
        for index in 0..200_000_u64 {
            push(Kind::Pass, Reason::Within, 1 + index % 3);
            push(Kind::Limit, Reason::TorqueRamp, 1);
            if index == 77_777 {
                push(Kind::Substitute, Reason::Mitigation, 1);
            }
        }
        push(Kind::Block, Reason::ParkedByLeave, 100_000);
        let bars = bars.finish();
        assert!(bars.len() <= BARS);
        assert!(bars.windows(2).all(|pair| pair[0].to == pair[1].from), "the lane has no hole");
        let cycles = |kind: Kind| {
            let parts = bars.iter().flat_map(|bar| &bar.parts);
            parts.filter(|part| super::verdict(part.code).0 == kind).map(|part| part.cycles).sum::<u64>()
        };
        assert_eq!((cycles(Kind::Substitute), cycles(Kind::Limit), cycles(Kind::Block)), (1, 200_000, 100_000));
        let lane = &LANES[2];
        let red: Vec<_> = bars.iter().filter(|bar| bar.tone(lane) == Tone::Alarm).collect();
        assert_eq!(red.len(), 1, "the gravest gives the colour");
        assert!(red[0].hover(lane).contains("SUBSTITUTE: a collision-mitigation level runs [MIT-1..4]"));
        assert_eq!(bars.last().map(|bar| (bar.parts.len(), bar.to - bar.from)), Some((1, 1_000_000_000)));
    }
}
