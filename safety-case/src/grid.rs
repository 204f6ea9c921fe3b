//! When to step: every 10 ms of log time, and what happens when the log's clock leaps.
//!
//! - A step at time *g* comes after every frame stamped up to *g*.
//! - Gaps between frames are stepped through: a silent bus is what the time-outs are for.
//! - A stamp earlier than the one before, by less than a cycle, is a logger's disorder: the frame counts for the
//!   next step, and the supervisor's clock does not notice.
//! - Earlier by a cycle or more, or ahead by more than [`AHEAD`], is a clock that was set. The cycle in progress is
//!   closed, and the next step comes at the new time: the supervisor gets it as it is, so SELF-3 shows as a clock
//!   fault, and, if it happens three times in a row, as the safe state.
//!
//! The axis on which everything is shown goes on by 10 ms per step: it is the log's own time until the first leap,
//! and never runs backwards. Logs stamped since 1970 are shown from 0.

use crate::cycle::CYCLE;

/// A gap longer than this, an hour, is a clock that was set: stepping through it would show nothing.
pub const AHEAD: u64 = 3_600_000_000;
/// A log that begins within this, a day, is shown with its own time.
const OWN_TIME: u64 = 86_400_000_000;

/// What the stamp of a frame means for the clock.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stamp {
    /// It goes on.
    Onward,
    /// Earlier than the one before by less than a cycle.
    OutOfOrder,
    /// The clock went back.
    Backwards,
    /// The clock leapt ahead.
    Ahead,
}

impl Stamp {
    /// Whether the supervisor's clock leaps with it.
    #[must_use]
    pub const fn leaps(self) -> bool {
        matches!(self, Self::Backwards | Self::Ahead)
    }
}

/// A step that is due.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Step {
    /// Time of the log, for the supervisor.
    pub clock: u64,
    /// Time on the axis.
    pub at: u64,
}

/// The grid of steps. All times in microseconds.
#[derive(Clone, Copy, Debug, Default)]
pub struct Grid {
    /// The next step, on the log's clock; `None` before the first frame.
    next: Option<u64>,
    /// The latest stamp.
    latest: u64,
    /// The next step, on the axis.
    axis: u64,
}

fn aligned(stamp: u64) -> u64 {
    stamp.checked_next_multiple_of(CYCLE).unwrap_or(stamp)
}

impl Grid {
    /// Judges the stamp of the next frame. After [`Stamp::leaps`], take [`close`](Self::close) and then
    /// [`leap`](Self::leap) before [`due`](Self::due).
    #[must_use]
    pub fn judge(&self, stamp: u64) -> Stamp {
        match self.next {
            Some(_) if self.latest.saturating_sub(stamp) >= CYCLE => Stamp::Backwards,
            Some(_) if stamp < self.latest => Stamp::OutOfOrder,
            Some(_) if stamp - self.latest > AHEAD => Stamp::Ahead,
            None | Some(_) => Stamp::Onward,
        }
    }

    /// The step of the cycle in progress.
    pub fn close(&mut self) -> Option<Step> {
        let clock = self.next?;
        let step = Step { clock, at: self.axis };
        self.next = Some(clock.saturating_add(CYCLE));
        self.axis = self.axis.saturating_add(CYCLE);
        Some(step)
    }

    /// Goes on at this stamp.
    pub fn leap(&mut self, stamp: u64) {
        self.next = Some(aligned(stamp));
        self.latest = stamp;
    }

    /// The next step that is due before a frame with this stamp.
    pub fn due(&mut self, stamp: u64) -> Option<Step> {
        match self.next {
            None => {
                self.leap(stamp);
                self.axis = if stamp < OWN_TIME { aligned(stamp) } else { 0 };
                None
            }
            Some(next) if next < stamp => self.close(),
            Some(_) => None,
        }
    }

    /// When the frame with this stamp is received, on the supervisor's clock: never before the one before.
    pub fn received(&mut self, stamp: u64) -> u64 {
        self.latest = self.latest.max(stamp);
        self.latest
    }

    /// Where the axis stands.
    #[must_use]
    pub const fn axis(&self) -> u64 {
        self.axis
    }
}

#[cfg(test)]
mod tests {
    use super::{AHEAD, Grid, Stamp};

    /// Feeds the stamps: what each means, and the clock of every step.
    fn run(stamps: &[u64]) -> (Vec<Stamp>, Vec<u64>, Vec<u64>) {
        let (mut grid, mut kinds, mut clocks, mut axis) = (Grid::default(), Vec::new(), Vec::new(), Vec::new());
        for stamp in stamps {
            let kind = grid.judge(*stamp);
            kinds.push(kind);
            if kind.leaps() {
                let step = grid.close();
                clocks.extend(step.map(|step| step.clock));
                axis.extend(step.map(|step| step.at));
                grid.leap(*stamp);
            }
            while let Some(step) = grid.due(*stamp) {
                clocks.push(step.clock);
                axis.push(step.at);
            }
            grid.received(*stamp);
        }
        let step = grid.close();
        clocks.extend(step.map(|step| step.clock));
        axis.extend(step.map(|step| step.at));
        (kinds, clocks, axis)
    }

    #[test]
    fn steps_every_ten_milliseconds_after_the_frames_up_to_then() {
        let (_, clocks, axis) = run(&[22_500, 30_000, 30_001, 61_000]);
        assert_eq!(clocks, [30_000, 40_000, 50_000, 60_000, 70_000]);
        assert_eq!(axis, clocks);
    }

    #[test]
    fn a_log_since_1970_is_shown_from_zero() {
        let (_, clocks, axis) = run(&[1_700_000_000_000_000, 1_700_000_000_015_000]);
        assert_eq!(clocks, [1_700_000_000_000_000, 1_700_000_000_010_000, 1_700_000_000_020_000]);
        assert_eq!(axis, [0, 10_000, 20_000]);
    }

    #[test]
    fn disorder_within_a_cycle_is_no_clock_fault() {
        let (kinds, clocks, _) = run(&[100_000, 100_100, 100_050, 110_500, 109_900, 120_500]);
        assert_eq!(kinds.iter().filter(|kind| **kind == Stamp::OutOfOrder).count(), 2);
        assert_eq!(clocks, [100_000, 110_000, 120_000, 130_000]);
    }

    #[test]
    fn a_clock_that_goes_back_gives_one_step_with_its_time() {
        let (kinds, clocks, axis) = run(&[500_000, 505_000, 200_000, 215_000]);
        assert_eq!(kinds, [Stamp::Onward, Stamp::Onward, Stamp::Backwards, Stamp::Onward]);
        assert_eq!(clocks, [500_000, 510_000, 200_000, 210_000, 220_000]);
        assert_eq!(axis, [500_000, 510_000, 520_000, 530_000, 540_000], "the axis goes on");
    }

    #[test]
    fn a_clock_that_leaps_ahead_is_not_stepped_through() {
        let (kinds, clocks, _) = run(&[0, 5_000, 5_001 + AHEAD]);
        assert_eq!(kinds.last(), Some(&Stamp::Ahead));
        assert_eq!(clocks.len(), 3);
        let (kinds, clocks, _) = run(&[0, AHEAD]);
        assert_eq!(kinds.last(), Some(&Stamp::Onward));
        assert_eq!(clocks.len(), 360_001);
    }

    #[test]
    fn no_stamp_is_too_great() {
        let (kinds, clocks, _) = run(&[0, u64::MAX, u64::MAX - 1, u64::MAX]);
        assert_eq!(kinds.iter().filter(|kind| kind.leaps()).count(), 1);
        assert!(clocks.len() < 10);
    }
}
