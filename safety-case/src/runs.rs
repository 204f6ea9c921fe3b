//! Runs: how long each lane kept its code.
//!
//! Everything that is shown over time is made of runs: the timeline, the JSON, the lanes of the page, the summary.

use supervisor::{Command, Commands, Outputs, Verdict};

use crate::cycle::{CYCLE, Cycle};
use crate::lanes::{CHANNELS, COUNT, snapshot};

/// A verdict while it lasted, at its worst.
#[derive(Clone, Copy, Debug)]
pub struct Detail {
    /// The verdict with the smallest margin.
    pub worst: Verdict,
    /// What was asked for then.
    pub asked: Commands,
    /// What went out then.
    pub given: Outputs,
    /// The channel had had a usable command before, or has one now.
    pub commanded: bool,
    /// It had one then.
    pub usable: bool,
}

/// A lane that kept its code.
#[derive(Clone, Debug)]
pub struct Run {
    /// Index into [`LANES`](crate::lanes::LANES).
    pub lane: usize,
    /// What it kept.
    pub code: u16,
    /// Beginning, in microseconds on the axis.
    pub from: u64,
    /// End: where the next run begins.
    pub to: u64,
    /// How many cycles.
    pub cycles: u64,
    /// For verdicts.
    pub detail: Option<Box<Detail>>,
}

/// Something that takes runs when they have ended, in the order in which they end.
pub trait Sink {
    /// A run has ended.
    fn ended(&mut self, run: &Run);
}

/// Follows every lane.
#[derive(Debug)]
pub struct Tracker {
    open: Vec<Run>,
    codes: [u16; COUNT],
    commanded: [bool; CHANNELS],
    /// End of the last cycle.
    now: u64,
}

impl Default for Tracker {
    fn default() -> Self {
        Self { open: Vec::new(), codes: [0; COUNT], commanded: [false; CHANNELS], now: 0 }
    }
}

impl Tracker {
    /// Takes a cycle; runs that it ends go to `sink`.
    pub fn cycle(&mut self, cycle: &Cycle<'_>, sink: &mut impl Sink) {
        let codes = snapshot(cycle);
        let first = self.open.is_empty();
        if first {
            self.open = codes.iter().enumerate().map(|(lane, code)| begin(lane, *code, cycle.at)).collect();
        } else if codes != self.codes {
            for ((run, code), lane) in self.open.iter_mut().zip(codes).zip(0..) {
                if run.code != code {
                    run.to = cycle.at;
                    run.cycles = cycles(run);
                    sink.ended(run);
                    *run = begin(lane, code, cycle.at);
                }
            }
        }
        self.codes = codes;
        self.now = cycle.at.saturating_add(CYCLE);
        self.verdicts(cycle);
    }

    /// Keeps the worst of each verdict; how long a run is follows from its ends.
    fn verdicts(&mut self, cycle: &Cycle<'_>) {
        let usable = usable(cycle.commands);
        let each = cycle.decision.verdicts.iter().zip(&mut self.open).zip(self.commanded.iter_mut().zip(usable));
        for (((_, verdict), run), (commanded, usable)) in each {
            *commanded |= usable;
            match &mut run.detail {
                Some(detail) if verdict.margin >= detail.worst.margin => {}
                Some(detail) => {
                    (detail.worst, detail.asked, detail.given) = (verdict, *cycle.commands, cycle.decision.outputs);
                    detail.usable = usable;
                }
                none @ None => {
                    let (asked, given) = (*cycle.commands, cycle.decision.outputs);
                    *none = Some(Box::new(Detail { worst: verdict, asked, given, commanded: *commanded, usable }));
                }
            }
        }
    }

    /// Ends every run.
    pub fn finish(&mut self, sink: &mut impl Sink) {
        for mut run in self.open.drain(..) {
            run.to = self.now;
            run.cycles = cycles(&run);
            sink.ended(&run);
        }
    }
}

fn begin(lane: usize, code: u16, from: u64) -> Run {
    Run { lane, code, from, to: from, cycles: 0, detail: None }
}

fn cycles(run: &Run) -> u64 {
    run.to.saturating_sub(run.from) / CYCLE
}

/// Which channels have a command that may be used, in the order of the channels.
fn usable(commands: &Commands) -> [bool; CHANNELS] {
    fn has<T>(command: &Command<T>) -> bool {
        matches!(command, Command::Fresh(_) | Command::Held(..))
    }
    [
        has(&commands.drive),
        has(&commands.target_speed),
        has(&commands.brake),
        has(&commands.retarder),
        has(&commands.gear),
        has(&commands.epb),
        has(&commands.steering),
        has(&commands.contactors),
        has(&commands.auxiliaries),
        has(&commands.warnings),
        has(&commands.body),
        has(&commands.mode),
    ]
}
