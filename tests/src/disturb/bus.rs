//! A CAN bus that is busy: frames wait for it, by their priority, and some get lost.
//!
//! Frames are released when their sender has them, and a random jitter later; the bus carries one after the other, of those
//! that wait the one with the least identifier, and never stops one that it carries (ISO 11898-1). What other nodes send is
//! filled up to the load that is asked for, at random times, as often with a higher priority than anything of ours as with
//! a lower one. A frame that is carried later than its cycle is read in a later one.

use std::collections::BTreeMap;

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use supervisor::wire::Frame;

use crate::link::Stamped;
use crate::plant::CYCLE_MS;

/// How busy it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Traffic {
    /// Share of the time in which the bus carries a frame, ours and others'.
    pub load: f64,
    /// A sender is late by up to so much, in µs.
    pub jitter_us: u32,
    /// With this probability a frame of ours is carried and read by nobody.
    pub lost: f64,
}

impl Traffic {
    /// S1 §3.2: 70 % load. Jitter and loss are own.
    pub const SEVENTY_PERCENT: Self = Self { load: 0.7, jitter_us: 3000, lost: 0.0005 };
}

/// One frame with 29 bits of identifier and 8 bytes at 500 kbit/s (J1939-14), with 14 stuff bits and the pause, in µs:
/// 131 bits at least, 160 at most.
const FRAME_US: u64 = 290;
/// The same as a real number.
const FRAME: f64 = 290.0;
/// First release of a cycle's frames after the cycle before, and the distance between two, in µs.
const FIRST_US: u64 = 500;
/// See [`FIRST_US`].
const SPACING_US: u64 = 100;
/// One cycle in µs.
const CYCLE_US: u64 = 10_000;
/// Identifiers of other nodes: before and behind all of ours.
const OTHERS: [u32; 2] = [0x0400_0000, 0x1C00_0000];

/// Waits for the bus.
#[derive(Clone, Debug)]
struct Waiting {
    released: u64,
    id: u32,
    number: u64,
    /// None: of another node.
    frame: Option<Frame>,
}

/// A frame on its way, in µs of the drive.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Carried {
    /// When its sender had it.
    pub released: u64,
    /// When it had been carried, and what.
    pub stamped: Stamped,
}

/// The bus.
#[derive(Clone, Debug)]
pub struct Bus {
    traffic: Traffic,
    random: ChaCha8Rng,
    waiting: Vec<Waiting>,
    late: Vec<Carried>,
    free_at: u64,
    number: u64,
    /// What others still have to send for the load, in µs.
    owed: f64,
    released: BTreeMap<u32, u64>,
    /// Time for which it was busy, and for which it was there, in µs.
    busy: (u64, u64),
    lost: u64,
}

impl Bus {
    /// At rest; the same seed gives the same traffic.
    #[must_use]
    pub fn new(traffic: Traffic, seed: u64) -> Self {
        Self {
            traffic,
            random: ChaCha8Rng::seed_from_u64(seed),
            waiting: Vec::new(),
            late: Vec::new(),
            free_at: 0,
            number: 0,
            owed: 0.0,
            released: BTreeMap::new(),
            busy: (0, 0),
            lost: 0,
        }
    }

    /// Time for which it was busy and for which it was there, in µs; frames of ours that nobody read.
    #[must_use]
    pub const fn figures(&self) -> ((u64, u64), u64) {
        (self.busy, self.lost)
    }

    /// Takes the frames of the cycle at `now_ms`, and gives what it has carried before it, in order.
    pub fn carry(&mut self, now_ms: u32, frames: &[Frame]) -> Vec<Carried> {
        let start = u64::from(now_ms.saturating_sub(CYCLE_MS)) * 1000;
        let end = start + CYCLE_US;
        self.free_at = self.free_at.max(start);
        self.release(start, frames);
        let mut carried = std::mem::take(&mut self.late);
        while let Some(begin) = self.waiting.iter().map(|waiting| waiting.released).min().map(|at| at.max(self.free_at))
        {
            if begin >= end {
                break;
            }
            let next = (0..self.waiting.len())
                .filter_map(|place| self.waiting.get(place).map(|waiting| (place, waiting)))
                .filter(|(_, waiting)| waiting.released <= begin)
                .min_by_key(|(_, waiting)| (waiting.id, waiting.number))
                .map(|(place, _)| place);
            let Some(place) = next else { break };
            let Waiting { released, frame, .. } = self.waiting.swap_remove(place);
            let done = begin + FRAME_US;
            self.free_at = done;
            self.busy.0 += FRAME_US;
            let Some(frame) = frame else { continue };
            if self.random.random_bool(self.traffic.lost) {
                self.lost += 1;
                continue;
            }
            // A replay takes what is stamped at a cycle for it; here it is read in the next.
            let micros = if done.is_multiple_of(CYCLE_US) { done + 1 } else { done };
            let found = Carried { released, stamped: Stamped { micros, frame } };
            if done < end { carried.push(found) } else { self.late.push(found) }
        }
        self.busy.1 += CYCLE_US;
        carried
    }

    fn release(&mut self, start: u64, frames: &[Frame]) {
        let mut wait = start + FIRST_US;
        for frame in frames {
            let released = wait + u64::from(self.random.random_range(0..=self.traffic.jitter_us));
            wait += SPACING_US;
            // One sender sends its message in order.
            let last = self.released.entry(frame.id).or_default();
            *last = released.max(*last);
            let released = *last;
            self.wait(released, frame.id, Some(*frame));
            self.owed -= FRAME;
        }
        self.owed = (self.owed + self.traffic.load * 10_000.0).max(-100_000.0);
        while self.owed > 0.0 {
            let released = start + self.random.random_range(0..CYCLE_US);
            let id = if self.random.random_bool(0.5) { OTHERS[0] } else { OTHERS[1] };
            self.wait(released, id, None);
            self.owed -= FRAME;
        }
    }

    fn wait(&mut self, released: u64, id: u32, frame: Option<Frame>) {
        self.number += 1;
        self.waiting.push(Waiting { released, id, number: self.number, frame });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frame(id: u32, value: u64) -> Frame {
        Frame::new(id, value)
    }

    #[test]
    fn the_load_is_what_is_asked_for_and_nothing_overtakes_its_own_message() {
        let mut bus = Bus::new(Traffic { lost: 0.0, ..Traffic::SEVENTY_PERCENT }, 7);
        let mut read = Vec::new();
        for cycle in 1..=1000_u32 {
            let sent = [frame(0x0CFF_1021, u64::from(cycle)), frame(0x18FE_F100, u64::from(cycle))];
            read.extend(bus.carry(cycle * 10, &sent));
        }
        let ((busy, there), lost) = bus.figures();
        assert!(busy * 100 / there >= 68 && busy * 100 / there <= 72 && lost == 0, "{busy} of {there}");
        assert!(read.is_sorted_by_key(|carried| carried.stamped.micros), "in order");
        for id in [0x0CFF_1021, 0x18FE_F100] {
            let of_it = read.iter().filter(|carried| carried.stamped.frame.id == id);
            let values: Vec<u64> = of_it.map(|carried| carried.stamped.frame.payload()).collect();
            assert!(values.len() > 990 && values.is_sorted(), "{id:X}");
        }
        assert!(read.iter().any(|carried| carried.stamped.micros > carried.released + 1000), "some wait");
    }

    #[test]
    fn what_is_lost_is_counted_and_the_same_seed_loses_the_same() {
        let run = |seed| {
            let mut bus = Bus::new(Traffic { lost: 0.1, ..Traffic::SEVENTY_PERCENT }, seed);
            let read: Vec<Carried> =
                (1..=500_u32).flat_map(|cycle| bus.carry(cycle * 10, &[frame(0x0CFF_1021, 1)])).collect();
            (read, bus.figures().1)
        };
        let (read, lost) = run(3);
        assert!(lost > 20 && lost < 100 && read.len() < 480, "{lost}");
        assert_eq!(run(3), (read, lost));
        assert_ne!(run(4).0, run(3).0);
    }
}
