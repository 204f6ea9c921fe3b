//! How long from an object to a deceleration (RXN-1), and where the time goes.
//!
//! Measured at every beginning of a level in a run with a busy bus:
//! - *bus*: from the moment at which the sensor has the last frame of its newest list, until the bus has carried it;
//! - *wait*: from there to the cycle of the supervisor that reads it;
//! - *supervisor*: from that cycle to the one in whose outputs the deceleration goes out. It answers in the cycle that reads,
//!   so this is 0 ms by the clock of the model; what a step takes on a machine is counted by `supervise cost`.
//!
//! A level may also begin between two lists, since objects age: the newest list is then the one that it began on.

use supervisor::wire::Message;
use supervisor::{DecelMs2Q11, Level};

use super::bus::Carried;
use crate::drive::Cycle;

/// The parts of one reaction, in µs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Reaction {
    /// On the bus.
    pub bus: u64,
    /// Until the next cycle.
    pub wait: u64,
    /// In the supervisor.
    pub supervisor: u64,
}

/// Looks at every cycle of a run.
#[derive(Clone, Debug)]
pub struct Stopwatch {
    newest: Option<Carried>,
    level: Level,
    /// A level has begun and nothing has gone out for it: since when, and how far it had come.
    open: Option<(u64, Reaction)>,
    found: Vec<Reaction>,
}

impl Default for Stopwatch {
    fn default() -> Self {
        Self { newest: None, level: Level::None, open: None, found: Vec::new() }
    }
}

impl Stopwatch {
    /// One cycle, and what was carried for it.
    pub fn see(&mut self, cycle: &Cycle, carried: &[Carried]) {
        let of_radar = [Message::RadarPosition.id(), Message::RadarMotion.id()];
        let newest = carried.iter().rev().find(|carried| of_radar.contains(&carried.stamped.frame.id));
        self.newest = newest.copied().or(self.newest);
        let now = u64::from(cycle.now_ms) * 1000;
        let level = cycle.answer.status.level;
        if level > self.level
            && let Some(Carried { released, stamped }) = self.newest
        {
            let bus = stamped.micros.saturating_sub(released);
            let wait = now.saturating_sub(stamped.micros);
            self.open = Some((now, Reaction { bus, wait, supervisor: 0 }));
        }
        self.level = level;
        let outputs = &cycle.answer.outputs;
        if outputs.brake.total > DecelMs2Q11::ZERO
            && let Some((since, reaction)) = self.open.take()
        {
            self.found.push(Reaction { supervisor: now.saturating_sub(since), ..reaction });
        }
    }

    /// Every reaction.
    #[must_use]
    pub fn found(&self) -> &[Reaction] {
        &self.found
    }
}
