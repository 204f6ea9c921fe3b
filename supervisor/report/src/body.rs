//! Do lamps and wipers follow? Reported, and nothing more (RSP-1h, S4 6.4.1).

use supervisor_core::word::codes;
use supervisor_core::{Body, Decision, Millis, Signal, Timer, Wiper};

use crate::clock::Clock;

/// A lamp or wiper follows in less than this (S4 6.4.1, TM-78).
pub const FOLLOW: Millis = Millis::new(1000);

codes! {
    /// What of the body is watched. The codes are stable.
    BodyPart {
        /// Wipers (S4 BCR 1).
        Wipers = 0,
        /// Brake lamps (S4 BCR 4).
        BrakeLamps = 1,
        /// Left indicator (S4 BCR 2).
        IndicatorLeft = 2,
        /// Right indicator (S4 BCR 3).
        IndicatorRight = 3,
        /// Low beam (S4 BCR 6).
        LowBeam = 4,
        /// High beam (S4 BCR 5).
        HighBeam = 5,
        /// The feedback itself (S4 6.4.2, 6.4.3): it was there, and is missing.
        Feedback = 6,
    }
}

impl BodyPart {
    /// Its name in the code.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Wipers => "WIPERS",
            Self::BrakeLamps => "BRAKE_LAMPS",
            Self::IndicatorLeft => "INDICATOR_LEFT",
            Self::IndicatorRight => "INDICATOR_RIGHT",
            Self::LowBeam => "LOW_BEAM",
            Self::HighBeam => "HIGH_BEAM",
            Self::Feedback => "BODY_FEEDBACK",
        }
    }
    const fn bit(self) -> u8 {
        1_u8.wrapping_shl(match self {
            Self::Wipers => 0,
            Self::BrakeLamps => 1,
            Self::IndicatorLeft => 2,
            Self::IndicatorRight => 3,
            Self::LowBeam => 4,
            Self::HighBeam => 5,
            Self::Feedback => 6,
        })
    }
}

/// What the body says of itself (S4 BCR), as the integrator reads it. Unknown is allowed, also for ever.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(kani, derive(kani::Arbitrary))]
pub struct BodyFeedback {
    /// Wipers.
    pub wipers: Signal<Wiper>,
    /// Brake lamps.
    pub brake_lamps: Signal<bool>,
    /// Left indicator: switched on, or the phase of its flashing.
    pub indicator_left: Signal<bool>,
    /// Right indicator, the same.
    pub indicator_right: Signal<bool>,
    /// Low beam.
    pub low_beam: Signal<bool>,
    /// High beam.
    pub high_beam: Signal<bool>,
}

impl BodyFeedback {
    /// Nothing received yet: nothing is watched.
    pub const NEVER: Self = Self {
        wipers: Signal::NEVER,
        brake_lamps: Signal::NEVER,
        indicator_left: Signal::NEVER,
        indicator_right: Signal::NEVER,
        low_beam: Signal::NEVER,
        high_beam: Signal::NEVER,
    };
}

/// Which parts do not follow. Never part of the core's faults: nothing acts on it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct BodyFaults(u8);

impl BodyFaults {
    /// None.
    pub const NONE: Self = Self(0);

    /// Whether this part does not follow.
    #[must_use]
    pub const fn contains(self, part: BodyPart) -> bool {
        self.0 & part.bit() != 0
    }
    /// This set with another part where `condition` holds.
    #[must_use]
    pub const fn when(self, condition: bool, part: BodyPart) -> Self {
        if condition { Self(self.0 | part.bit()) } else { self }
    }
}

/// One part: how long it has not been what was asked for.
#[derive(Clone, Copy, Debug)]
struct Follow {
    late: Timer,
    /// It has been known once: from then on it is missed.
    seen: bool,
    unknown: bool,
}

impl Follow {
    const NEW: Self = Self { late: Timer::STOPPED, seen: false, unknown: true };

    /// `changed`: something else is asked for than in the last cycle, so the time begins anew. While the part is
    /// unknown the time stands still: unknown is no evidence that it follows, nor that it does not.
    fn watch<T: Copy + PartialEq>(&mut self, asked: T, changed: bool, feedback: Signal<T>, elapsed: Millis) {
        if changed {
            self.late = Timer::STOPPED;
        }
        match feedback.known() {
            None => self.unknown = true,
            Some(now) => {
                (self.seen, self.unknown) = (true, false);
                self.late = self.late.run_while(now != asked, elapsed);
            }
        }
    }

    const fn is_late(self) -> bool {
        self.late.reached(FOLLOW)
    }
    const fn is_missed(self) -> bool {
        self.seen && self.unknown
    }
}

/// Compares what went out to lamps and wipers with what they say of themselves.
///
/// An indicator that flashes meets the request in every period, whether its switch or its phase is fed back. What has
/// never been fed back is not watched: not every bus can.
#[derive(Clone, Copy, Debug)]
pub struct BodyMonitor {
    clock: Clock,
    last: Body,
    wipers: Follow,
    brake_lamps: Follow,
    indicator_left: Follow,
    indicator_right: Follow,
    low_beam: Follow,
    high_beam: Follow,
    missing: Timer,
}

impl Default for BodyMonitor {
    fn default() -> Self {
        Self::new()
    }
}

impl BodyMonitor {
    /// Nothing seen yet.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            clock: Clock::NEW,
            last: Body::NEUTRAL,
            wipers: Follow::NEW,
            brake_lamps: Follow::NEW,
            indicator_left: Follow::NEW,
            indicator_right: Follow::NEW,
            low_beam: Follow::NEW,
            high_beam: Follow::NEW,
            missing: Timer::STOPPED,
        }
    }

    /// Takes a cycle; gives what has not followed for [`FOLLOW`] (RSP-1h). Call it once a cycle.
    pub fn observe(&mut self, now: Millis, decision: &Decision, feedback: &BodyFeedback) -> BodyFaults {
        let elapsed = self.clock.elapsed(now);
        let asked = asked(decision);
        let last = core::mem::replace(&mut self.last, asked);
        macro_rules! watch {
            ($($part:ident),*) => {
                $(self.$part.watch(asked.$part, asked.$part != last.$part, feedback.$part, elapsed);)*
            };
        }
        watch!(wipers, brake_lamps, indicator_left, indicator_right, low_beam, high_beam);
        let missed = self.wipers.is_missed()
            || self.brake_lamps.is_missed()
            || self.indicator_left.is_missed()
            || self.indicator_right.is_missed()
            || self.low_beam.is_missed()
            || self.high_beam.is_missed();
        self.missing = self.missing.run_while(missed, elapsed);
        BodyFaults::NONE
            .when(self.wipers.is_late(), BodyPart::Wipers)
            .when(self.brake_lamps.is_late(), BodyPart::BrakeLamps)
            .when(self.indicator_left.is_late(), BodyPart::IndicatorLeft)
            .when(self.indicator_right.is_late(), BodyPart::IndicatorRight)
            .when(self.low_beam.is_late(), BodyPart::LowBeam)
            .when(self.high_beam.is_late(), BodyPart::HighBeam)
            .when(self.missing.reached(FOLLOW), BodyPart::Feedback)
    }
}

/// What lamps and wipers have to show: hazard flashers are both indicators (BODY-1).
fn asked(decision: &Decision) -> Body {
    let (body, hazard) = (decision.outputs.body, decision.outputs.warnings.hazard_flashers);
    Body { indicator_left: body.indicator_left || hazard, indicator_right: body.indicator_right || hazard, ..body }
}
