//! Events, trouble codes, and what lamps and wipers say of themselves.

use supervisor::report::{BodyFeedback, Event, Trouble, What};
use supervisor::word::Word;
use supervisor::{Cause, Signal, Verdict};

use crate::codes::SupervisorEventKind;

/// What lamps and wipers say of themselves: 1 on, 0 off, a `SupervisorWiper` for the wipers; every other number is
/// unknown. What has never been known is not watched.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SupervisorBodyFeedback {
    /// Wipers.
    pub wipers: u8,
    /// Brake lamps.
    pub brake_lamps: u8,
    /// Left indicator: switched on, or the phase of its flashing.
    pub indicator_left: u8,
    /// Right indicator, the same.
    pub indicator_right: u8,
    /// Low beam.
    pub low_beam: u8,
    /// High beam.
    pub high_beam: u8,
}

impl SupervisorBodyFeedback {
    pub(crate) fn feedback(self) -> BodyFeedback {
        BodyFeedback {
            wipers: signal(self.wipers),
            brake_lamps: signal(self.brake_lamps),
            indicator_left: signal(self.indicator_left),
            indicator_right: signal(self.indicator_right),
            low_beam: signal(self.low_beam),
            high_beam: signal(self.high_beam),
        }
    }
}

fn signal<T: Word>(code: u8) -> Signal<T> {
    T::from_word(u32::from(code)).map_or(Signal::Unknown(Cause::NotAvailable), Signal::Known)
}

/// One change, with its time.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SupervisorEvent {
    /// Time of the step, in ms.
    pub time_ms: u32,
    /// Of a verdict: the value.
    pub value: i32,
    /// Of a verdict: the limit.
    pub limit: i32,
    /// Of a verdict: the margin.
    pub margin: i32,
    /// Of everything else: what it is now.
    pub code: u32,
    /// What changed, a `SupervisorEventKind`.
    pub what: u8,
    /// Of a verdict: the channel, a `SupervisorChannel`.
    pub channel: u8,
    /// Of a verdict: a `SupervisorKind`.
    pub kind: u8,
    /// Of a verdict: a `SupervisorReason`.
    pub reason: u8,
}

impl SupervisorEvent {
    pub(crate) fn of(event: &Event) -> Self {
        let Event { time, what } = *event;
        let status = |what: SupervisorEventKind, code: u32| Self {
            time_ms: time.raw(),
            value: 0,
            limit: 0,
            margin: 0,
            code,
            what: number(what),
            channel: 0,
            kind: 0,
            reason: 0,
        };
        match what {
            What::Verdict(channel, Verdict { kind, reason, value, limit, margin }) => Self {
                value,
                limit,
                margin,
                channel: channel.code(),
                kind: kind.code(),
                reason: reason.code(),
                ..status(SupervisorEventKind::Verdict, 0)
            },
            What::Occupancy(occupancy) => status(SupervisorEventKind::Occupancy, u32::from(occupancy.code())),
            What::ParkedByLeave(parked) => status(SupervisorEventKind::ParkedByLeave, u32::from(parked)),
            What::Stage(stage) => status(SupervisorEventKind::Stage, u32::from(stage.code())),
            What::Level(level) => status(SupervisorEventKind::Level, u32::from(level.code())),
            What::Mode(mode) => status(SupervisorEventKind::Mode, u32::from(mode.code())),
            What::SafeState(safe) => status(SupervisorEventKind::SafeState, u32::from(safe)),
            What::Faults(faults) => status(SupervisorEventKind::Faults, faults.bits()),
        }
    }
}

fn number(what: SupervisorEventKind) -> u8 {
    #[expect(clippy::as_conversions, reason = "the number of a variant without fields: no other way leads to it")]
    let number = what as u8;
    number
}

/// A trouble code that is active.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SupervisorTrouble {
    /// Suspect parameter number of J1939, 19 bits.
    pub spn: u32,
    /// Failure mode identifier, a `SupervisorFmi`.
    pub fmi: u8,
    /// The lamp that it lights, a `SupervisorLamp`.
    pub lamp: u8,
    /// What does not work, a `SupervisorSystem`.
    pub system: u8,
    /// Why, as one number: 1 + bit of the fault, or 64 + part of the body.
    pub ads_code: u8,
    /// How often it has become active, 1 to 126.
    pub occurrences: u8,
    /// The fault is there in this cycle: 1, or 0 while the code waits to heal.
    pub present: u8,
    /// Given as 0.
    pub reserved: [u8; 2],
}

impl SupervisorTrouble {
    pub(crate) fn of(trouble: Trouble) -> Self {
        let code = trouble.code;
        Self {
            spn: code.spn.raw(),
            fmi: code.fmi.code(),
            lamp: code.lamp.code(),
            system: code.system.code(),
            ads_code: code.ads_code(),
            occurrences: trouble.occurrences,
            present: u8::from(trouble.present),
            reserved: [0; 2],
        }
    }
}
