//! Debounced faults: what is active, what was, and how often.

use supervisor_core::{Decision, Faults, Millis, Timer};

use crate::body::BodyFaults;
use crate::clock::Clock;
use crate::code::{Lamp, Source, TroubleCode};
use crate::table::{CODES, TROUBLE_CODES};

/// After power-on no debounce begins before this (own). Every link first has to be heard and to requalify; without the
/// wait each start of the bus would leave a code for every input. The fault lamp, which the core lights, does not wait.
pub const SETTLE: Millis = Millis::new(3000);
/// A fault is reported once it has lasted this long (own, TM-80). Only the report waits; the reaction never does.
pub const DEBOUNCE: Millis = Millis::new(500);
/// A code is active until its fault has stayed away for this long (own, TM-81): one loose contact is one occurrence.
pub const HEAL: Millis = Millis::new(10_000);

/// Greatest occurrence count of J1939-73; 127 would mean "not available".
const MOST: u8 = 126;

/// What there is to know of one code.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Entry {
    /// How long the fault has been there while the code is not active, or away while it is.
    timer: Timer,
    active: bool,
    occurrences: u8,
}

impl Entry {
    const NEW: Self = Self { timer: Timer::STOPPED, active: false, occurrences: 0 };

    fn observe(&mut self, present: bool, debounce: Millis, heal: Millis, elapsed: Millis) {
        self.timer = self.timer.run_while(present != self.active, elapsed);
        if self.timer.reached(if self.active { heal } else { debounce }) {
            self.timer = Timer::STOPPED;
            self.active = !self.active;
            if self.active {
                self.occurrences = self.occurrences.saturating_add(1).min(MOST);
            }
        }
    }
}

/// A code that is, or was, active.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Trouble {
    /// Its row of the table.
    pub code: &'static TroubleCode,
    /// How often it has become active: 1 to 126, saturating.
    pub occurrences: u8,
    /// The fault is there in this cycle; an active code without it waits to heal.
    pub present: bool,
}

/// The lamps of DM1 that the active codes light together.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Lamps {
    /// Red stop lamp.
    pub red_stop: bool,
    /// Amber warning lamp.
    pub amber_warning: bool,
}

/// Reports a fault once it has lasted, until it has stayed away, and counts how often it has come.
///
/// Since power-on: who wants counts over the life of the bus stores them. It is bounded, deterministic, and does not
/// care for a wrap of the clock.
#[derive(Clone, Copy, Debug)]
pub struct FaultReport {
    clock: Clock,
    /// Since power-on.
    up: Timer,
    settle: Millis,
    debounce: Millis,
    heal: Millis,
    /// In the order of the table.
    entries: [Entry; CODES],
}

impl Default for FaultReport {
    fn default() -> Self {
        Self::new(SETTLE, DEBOUNCE, HEAL)
    }
}

impl FaultReport {
    /// Reports what has lasted for at least `debounce`, until it has been away for at least `heal`. Whatever is there
    /// in the first `settle` begins to last after it.
    #[must_use]
    pub const fn new(settle: Millis, debounce: Millis, heal: Millis) -> Self {
        Self { clock: Clock::NEW, up: Timer::STOPPED, settle, debounce, heal, entries: [Entry::NEW; CODES] }
    }

    /// RULE-5b, RPT-1c: takes a cycle. `body` comes from [`BodyMonitor`](crate::BodyMonitor), or is [`BodyFaults::NONE`]; it has lasted
    /// its second already and is not debounced again.
    pub fn observe(&mut self, now: Millis, decision: &Decision, body: BodyFaults) {
        let elapsed = self.clock.elapsed(now);
        self.up = self.up.run(elapsed);
        let settled = self.up.reached(self.settle);
        for (entry, code) in self.entries.iter_mut().zip(TROUBLE_CODES) {
            let (present, debounce) = match code.source {
                Source::Core(fault) => (decision.status.faults.contains(fault), self.debounce),
                Source::Body(part) => (body.contains(part), Millis::ZERO),
            };
            entry.observe(present && settled, debounce, self.heal, elapsed);
        }
    }

    /// The codes that are active, in the order of the table.
    pub fn active(&self) -> impl Iterator<Item = Trouble> {
        self.troubles(|entry| entry.active)
    }

    /// The codes that were active and have healed, in the order of the table.
    pub fn previously_active(&self) -> impl Iterator<Item = Trouble> {
        self.troubles(|entry| !entry.active && entry.occurrences > 0)
    }

    /// The core's faults that are reported now.
    #[must_use]
    pub fn faults(&self) -> Faults {
        self.active().fold(Faults::NONE, |faults, trouble| match trouble.code.source {
            Source::Core(fault) => faults.with(fault),
            Source::Body(_) => faults,
        })
    }

    /// The lamps that the active codes light.
    #[must_use]
    pub fn lamps(&self) -> Lamps {
        self.active().fold(Lamps::default(), |lamps, trouble| match trouble.code.lamp {
            Lamp::None => lamps,
            Lamp::AmberWarning => Lamps { amber_warning: true, ..lamps },
            Lamp::RedStop => Lamps { red_stop: true, ..lamps },
        })
    }

    fn troubles(&self, which: fn(&Entry) -> bool) -> impl Iterator<Item = Trouble> {
        let entries = self.entries.iter().zip(TROUBLE_CODES).filter(move |(entry, _)| which(entry));
        entries.map(|(entry, code)| Trouble {
            code,
            occurrences: entry.occurrences,
            // The timer of an active code runs while its fault is away.
            present: entry.active && !entry.timer.is_running(),
        })
    }
}
