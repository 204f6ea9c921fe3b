//! What one cycle shows, in the words of the requirements: time that counts, speeds that agree, timers.
//!
//! The properties are stated over these, never over what `decide` computed in between.

use supervisor_core::{
    Command, Config, Contact, Deviation, EpbState, EpbSwitch, Faults, Inputs, Key, Millis, Pedal250, Seat, SpeedKmhQ8,
    Timer, kernel,
};

use super::Cycle;

/// The new timer is the old one of a condition that holds: 0 in its first cycle, then the time that counts is added;
/// it saturates and never wraps.
pub(crate) fn runs(old: Timer, new: Timer, passed: Millis) -> bool {
    let elapsed = if old.is_running() { old.elapsed().raw().saturating_add(passed.raw()).min(u32::MAX - 1) } else { 0 };
    new.is_running() && new.elapsed() == Millis::new(elapsed)
}

/// The same while the condition holds; stopped at once when it does not.
pub(crate) fn runs_while(condition: bool, old: Timer, new: Timer, passed: Millis) -> bool {
    if condition { runs(old, new, passed) } else { new == Timer::STOPPED }
}

/// The condition of this timer has held for at least `span`.
pub(crate) fn has_run(timer: Timer, span: Millis) -> bool {
    timer.is_running() && timer.elapsed() >= span
}

/// The value of a command that may be used: in this cycle, or held within its time-out.
pub(crate) fn asked<T>(command: Command<T>, timeout: Millis) -> Option<T> {
    match command {
        Command::Fresh(value) => Some(value),
        Command::Held(age, value) => (age <= timeout).then_some(value),
        Command::Absent | Command::Rejected(_) => None,
    }
}

/// RULE-6c: both speeds, the lower first, where they agree: within the absolute or the relative bound.
pub(crate) fn agreed_speeds(inputs: &Inputs, config: &Config) -> Option<(SpeedKmhQ8, SpeedKmhQ8)> {
    let (wheel, motor) = (inputs.wheel_speed.known()?, inputs.motor_speed.known()?);
    let (low, high) = (wheel.min(motor), wheel.max(motor));
    let difference = high.raw().abs_diff(low.raw());
    let agree = difference <= config.speed_agree.raw()
        || kernel::within_percent(difference, config.speed_agree_percent.raw(), high.raw());
    agree.then_some((low, high))
}

impl Cycle<'_> {
    /// Time since the last cycle, over a wrap.
    pub(crate) fn passed(&self) -> Millis {
        Millis::new(self.now.raw().wrapping_sub(self.old.clock.last.raw()))
    }
    /// SELF-3c: the time since the last cycle is not that of a cycle. The first cycle has none before it.
    pub(crate) fn clock_fault(&self) -> bool {
        let passed = self.passed();
        self.old.clock.started && (passed < self.config.cycle_least || passed > self.config.cycle_greatest)
    }
    /// SELF-3d: what permission timers count: nothing in the first cycle and in one with a clock fault.
    pub(crate) fn permitting(&self) -> Millis {
        if self.old.clock.started && !self.clock_fault() { self.passed() } else { Millis::ZERO }
    }
    /// SELF-3e: what safety timers count: the nominal time in those cycles.
    pub(crate) fn obliging(&self) -> Millis {
        if self.old.clock.started && !self.clock_fault() { self.passed() } else { self.config.cycle_nominal }
    }

    /// RULE-6c: both speeds, the lower first, where they agree.
    pub(crate) const fn known_speeds(&self) -> Option<(SpeedKmhQ8, SpeedKmhQ8)> {
        self.agreed
    }
    /// Known, and the lower of the two below `limit` (RULE-6a).
    pub(crate) fn lower_below(&self, limit: SpeedKmhQ8) -> bool {
        self.known_speeds().is_some_and(|(low, _)| low < limit)
    }
    /// Known, and the lower of the two at least `limit`.
    pub(crate) fn lower_at_least(&self, limit: SpeedKmhQ8) -> bool {
        self.known_speeds().is_some_and(|(low, _)| low >= limit)
    }
    /// Known, and the higher of the two below `limit` (RULE-6b).
    pub(crate) fn higher_below(&self, limit: SpeedKmhQ8) -> bool {
        self.known_speeds().is_some_and(|(_, high)| high < limit)
    }
    /// Known below the standstill speed, by the higher of the two.
    pub(crate) fn stands(&self) -> bool {
        self.higher_below(self.config.standstill_speed)
    }

    /// Both seat sensors known vacant.
    pub(crate) fn vacant(&self) -> bool {
        self.inputs.seat.iter().all(|sensor| sensor.is(Seat::Vacant))
    }
    /// A seat sensor known occupied.
    pub(crate) fn partly_occupied(&self) -> bool {
        self.inputs.seat.iter().any(|sensor| sensor.is(Seat::Occupied))
    }
    /// SEAT-0a: confirmed occupied, after this cycle.
    pub(crate) fn confirmed(&self) -> bool {
        has_run(self.new.seat.occupied, self.config.seat_confirm)
    }
    /// E2E-1d: the lower of both accelerator tracks, where both are in range and agree.
    pub(crate) fn accelerator(&self) -> Option<Pedal250> {
        let full = Pedal250::new(250);
        let [first, second] = self.inputs.accelerator.map(|track| track.known().filter(|travel| *travel <= full));
        let (first, second) = (first?, second?);
        (first.raw().abs_diff(second.raw()) <= self.config.pedal_agree.raw()).then_some(first.min(second))
    }
    /// The key is on or at Start.
    pub(crate) fn key_on(&self) -> bool {
        self.inputs.key.is(Key::On) || self.inputs.key.is(Key::Start)
    }
    /// The driver's own parking-brake switch.
    pub(crate) fn switched(&self, position: EpbSwitch) -> bool {
        self.inputs.epb_switch.is(position)
    }
    /// SELF-5: the safe state, after this cycle.
    pub(crate) fn safe_state(&self) -> bool {
        self.new.is_safe_state()
    }
    /// A fault is reported exactly when it is there, or latched, or reported by the monitors.
    pub(crate) fn reports(&self, fault: Faults, there: bool) -> bool {
        let besides = self.new.latches.faults.with(self.response.faults);
        self.faults.contains(fault) == (there || besides.contains(fault))
    }

    /// SEAT-0b: powered on and (the parking brake known released or the lower speed known at least 1.5 km/h).
    pub(crate) fn not_parked(&self) -> bool {
        let powered = self.key_on() || self.inputs.k1.is(Contact::Closed);
        powered && (self.inputs.epb.is(EpbState::Released) || self.lower_at_least(self.config.epb_speed))
    }
    /// Leave, or parked by leave with nobody confirmed: the parking brake is kept applied.
    pub(crate) fn parking_kept(&self) -> bool {
        self.new.seat.leave || (self.new.parking.by_leave && !self.confirmed())
    }
    /// SEAT-3f: speed unknown during leave for 20 s.
    pub(crate) fn speedless(&self) -> bool {
        has_run(self.new.parking.speedless, self.config.epb_speedless)
    }
    /// Kept, slow enough by the lower speed, and not confirmed applied: apply is owed.
    pub(crate) fn apply_owed(&self) -> bool {
        let slow = self.lower_below(self.config.epb_speed) || self.speedless();
        self.parking_kept() && slow && !self.inputs.epb.is(EpbState::Applied)
    }
    /// EPB-1b, EPB-1c: the brakes still fall short of leave or level 3, and ABS is known not at work.
    pub(crate) fn parking_helps(&self) -> bool {
        self.response.brake == Deviation::Persistent
            && (self.new.seat.leave || self.new.mitigation.three)
            && self.inputs.abs.is(false)
    }
    /// The brake pedal is known pressed: by its switch, or by a track in range beyond where it counts as pressed.
    pub(crate) fn brake_pressed(&self) -> bool {
        let beyond = |travel: Pedal250| travel > self.config.pedal_pressed && travel <= Pedal250::new(250);
        let tracks = self.inputs.brake_pedal.iter().any(|track| track.known().is_some_and(beyond));
        self.inputs.brake_switch.is(true) || tracks
    }
}
