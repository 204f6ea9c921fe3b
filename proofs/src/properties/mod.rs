//! The properties: each safety requirement once, as a plain function over one cycle, named by its id. `true` means that
//! the requirement holds. Kani calls them on any cycle, proptest, the explorer and cargo-fuzz on those they reach.

pub(crate) mod facts;
mod known;
mod reading;

pub mod auxiliaries;
pub mod body;
pub mod boot;
pub mod brake;
pub mod cap;
pub mod clock;
pub mod command;
pub mod configuration;
pub mod drive;
pub mod flow;
pub mod follow;
pub mod frame;
pub mod fusion;
pub mod gear;
pub mod high_voltage;
pub mod leave;
pub mod mitigation;
pub mod mode;
pub mod object;
pub mod parking;
pub mod qualifier;
pub mod recovery;
pub mod response;
pub mod retarder;
pub mod rules;
pub mod seat;
pub mod split;
pub mod steering;
pub mod supervisor;
pub mod vetting;
pub mod warnings;

use supervisor_core::{
    Commands, Config, Decided, Envelope, EpbRequest, Evidence, Faults, Inputs, Millis, Outputs, Percent, Response,
    Seat, SpeedKmhQ8, State, Threat, Verdicts, decide, record, vet,
};

/// One cycle, seen from outside.
#[derive(Clone, Copy, Debug)]
pub struct Cycle<'a> {
    /// State before.
    pub old: &'a State,
    /// Time given to the step.
    pub now: Millis,
    /// Inputs.
    pub inputs: &'a Inputs,
    /// What perception says.
    pub threat: &'a Threat,
    /// Whether the actuators follow.
    pub response: &'a Response,
    /// What the main controller asks for.
    pub commands: &'a Commands,
    /// Configuration.
    pub config: &'a Config,
    /// State after `decide`.
    pub new: &'a State,
    /// Envelope.
    pub envelope: &'a Envelope,
    /// The faults of the cycle.
    pub faults: Faults,
    /// Outputs.
    pub outputs: &'a Outputs,
    /// State after `record`: what the next cycle begins with.
    pub next: &'a State,
    /// RULE-6c: both speeds where they agree, the lower first. Read once for every property.
    pub agreed: Option<(SpeedKmhQ8, SpeedKmhQ8)>,
}

/// A property by its name.
#[derive(Clone, Copy, Debug)]
pub struct Property {
    /// As in the source; begins with the requirement.
    pub name: &'static str,
    /// Whether it holds.
    pub holds: fn(&Cycle<'_>) -> bool,
}

/// Lists properties under their own names.
macro_rules! all {
    ($($name:ident),* $(,)?) => { &[$($crate::properties::Property { name: stringify!($name), holds: $name }),*] };
}
pub(crate) use all;

/// Every property of a cycle, file by file.
pub const ALL: &[&[Property]] = &[
    seat::ALL,
    parking::ALL,
    high_voltage::ALL,
    gear::ALL,
    mitigation::ALL,
    leave::ALL,
    brake::ALL,
    cap::ALL,
    split::ALL,
    retarder::ALL,
    warnings::ALL,
    body::ALL,
    drive::ALL,
    mode::ALL,
    steering::ALL,
    supervisor::ALL,
    clock::ALL,
    auxiliaries::ALL,
    rules::ALL,
];

/// `a` ⇒ `b`.
pub(crate) const fn implies(a: bool, b: bool) -> bool {
    !a || b
}

pub(crate) fn sits(inputs: &Inputs) -> bool {
    inputs.seat.iter().all(|sensor| sensor.is(Seat::Occupied))
}

impl Cycle<'_> {
    /// Both speeds where both are known, the lower first; whether they agree is another question.
    pub(crate) fn speeds(&self) -> Option<(u16, u16)> {
        let (wheel, motor) = (self.inputs.wheel_speed.known()?, self.inputs.motor_speed.known()?);
        Some((wheel.raw().min(motor.raw()), wheel.raw().max(motor.raw())))
    }
    /// Both speeds known below the standstill speed.
    pub(crate) fn standstill(&self) -> bool {
        self.speeds().is_some_and(|(_, high)| high < self.config.standstill_speed.raw())
    }
    /// Standstill, and the speeds agree.
    pub(crate) fn agreed_standstill(&self) -> bool {
        self.standstill()
            && self.speeds().is_some_and(|(low, high)| high.saturating_sub(low) <= self.config.speed_agree.raw())
    }
    pub(crate) fn loads_stopped(&self) -> bool {
        let bound = self.config.stopped_current.raw().unsigned_abs();
        self.inputs.drive_stopped.is(true)
            && self.inputs.auxiliaries_stopped.is(true)
            && self.inputs.hv_current.known().is_some_and(|current| current.raw().unsigned_abs() <= bound)
    }
    pub(crate) fn torque_stopped(&self) -> bool {
        self.inputs
            .executed_torque
            .known()
            .is_some_and(|torque| torque <= self.config.stopped_torque && torque <= Percent::FULL)
    }
    pub(crate) fn releases(&self) -> bool {
        self.outputs.epb.request == EpbRequest::Release
    }
}

/// A cycle that really ran, for tests and fuzzers: as [`step`](supervisor_core::step) does it, with everything in between kept.
#[derive(Clone, Copy, Debug)]
pub struct Witness {
    old: State,
    now: Millis,
    inputs: Inputs,
    threat: Threat,
    response: Response,
    commands: Commands,
    config: Config,
    decided: Decided,
    /// Outputs.
    pub outputs: Outputs,
    /// Verdicts.
    pub verdicts: Verdicts,
    /// State after `record`.
    pub next: State,
}

impl Witness {
    /// Runs one cycle from `old`, decoded.
    #[must_use]
    pub fn of(old: State, now: Millis, inputs: &Inputs, threat: &Threat, commands: &Commands, config: &Config) -> Self {
        let (_, ticks) = old.clock.advance(now, config);
        let (monitors, response) = old.monitors.advance(&Evidence::gather(inputs, config), inputs, ticks, config);
        let decided = decide(&State { monitors, ..old }, now, inputs, threat, &response, config);
        let (outputs, verdicts) = vet(&decided.envelope, commands);
        let next = record(&decided, &outputs, commands, config);
        Self {
            old,
            now,
            inputs: *inputs,
            threat: *threat,
            response,
            commands: *commands,
            config: *config,
            decided,
            outputs,
            verdicts,
            next,
        }
    }

    /// What the properties look at.
    #[must_use]
    pub fn cycle(&self) -> Cycle<'_> {
        Cycle {
            old: &self.old,
            now: self.now,
            inputs: &self.inputs,
            threat: &self.threat,
            response: &self.response,
            commands: &self.commands,
            config: &self.config,
            new: &self.decided.state,
            envelope: &self.decided.envelope,
            faults: self.decided.faults,
            outputs: &self.outputs,
            next: &self.next,
            agreed: facts::agreed_speeds(&self.inputs, &self.config),
        }
    }

    /// The name of the first property that does not hold.
    #[must_use]
    pub fn broken(&self) -> Option<&'static str> {
        let cycle = self.cycle();
        ALL.iter().copied().flatten().find(|property| !(property.holds)(&cycle)).map(|property| property.name)
    }
}
