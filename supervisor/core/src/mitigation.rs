//! Collision mitigation: three independent latches and two warnings (S1 §3.1.2; MIT-1 to MIT-7, FCW-1, PCW-1).
//!
//! A begun level holds while its object closes; the driver's steering ends levels 1 and 2, nothing but
//! standstill ends level 3 (readings c, d).

use supervisor_observe::Ticks;
use supervisor_observe::{BrakePedal, Evidence};

use supervisor_terms::word::retained;
use supervisor_terms::{Alert, AngleDeciDeg, Closing, Config, DecelMs2Q11, EpbState, Inputs, Level, Threat, Timer};

retained! {
    /// The mitigation machine.
    Mitigation {
        /// Latch of level 1.
        one: bool = false,
        /// Latch of level 2.
        two: bool = false,
        /// Latch of level 3.
        three: bool = false,
        /// Nothing has been closing.
        gone: Timer = Timer::STOPPED,
        /// Continuous standstill.
        standstill: Timer = Timer::STOPPED,
        /// Speed unknown while a latch is set.
        speedless: Timer = Timer::STOPPED,
        /// A level ended for lack of speed: hold until the parking brake is applied or the driver brakes (MIT-7).
        hold: bool = false,
        /// An emergency was seen and its object is not known to be gone: braking stays permitted though nothing is
        /// obliged (MIT-6, PHB-1).
        permitted: bool = false,
        /// Forward-collision warning.
        forward: bool = false,
        /// Pedestrian-collision warning.
        pedestrian: bool = false,
    }
}

/// Whether the driver's steering counts in this cycle (MIT-7).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Steered {
    /// Automatic steering turns the wheel.
    pub automatic: bool,
    /// The driver has taken over.
    pub takeover: bool,
}

impl Mitigation {
    /// Any latch set.
    #[must_use]
    pub const fn running(&self) -> bool {
        self.one || self.two || self.three
    }

    /// The highest level set.
    #[must_use]
    pub const fn level(&self) -> Level {
        match (self.three, self.two, self.one) {
            (true, _, _) => Level::Three,
            (false, true, _) => Level::Two,
            (false, false, true) => Level::One,
            (false, false, false) => Level::None,
        }
    }

    /// MIT-4: the demand is the greatest of the set latches.
    pub(crate) fn demand(&self, config: &Config) -> DecelMs2Q11 {
        let [one, two, three] = config.level_decel.0;
        let of = |set: bool, decel: DecelMs2Q11| if set { decel } else { DecelMs2Q11::ZERO };
        of(self.one, one).max(of(self.two, two)).max(of(self.three, three))
    }

    pub(crate) fn advance(
        self,
        threat: &Threat,
        steered: Steered,
        evidence: &Evidence,
        inputs: &Inputs,
        ticks: Ticks,
        config: &Config,
    ) -> Self {
        let angle = evidence.steering_angle.map(|angle| angle.raw().unsigned_abs());
        let [enter_one, enter_two, enter_three] = config.level_angle.0;
        let [exit_one, exit_two] = config.level_exit_angle.0;

        // MIT-6b, c, e: nothing new is obliged when slow, while the bus already brakes enough, or where little is enough. All
        // need evidence.
        let slow = evidence.obliged_below(config.level_least_speed);
        let braking = inputs
            .deceleration
            .known()
            .is_some_and(|measured| measured >= threat.required && measured <= config.decel_plausible);
        let open = !slow && !braking && threat.required >= config.level_least_required;
        // MIT-7: unknown angle, no new entry.
        let enter = |level, limit: AngleDeciDeg| {
            open && threat.level >= level && angle.is_some_and(|angle| angle < limit.raw().unsigned_abs())
        };

        let gone = self.gone.run_while(threat.closing == Closing::No, ticks.permission);
        let standstill = self.standstill.run_while(evidence.standstill, ticks.permission);
        let speedless = self.speedless.run_while(self.running() && evidence.speed.is_none(), ticks.permission);
        let over = standstill.reached(config.level_standstill) || speedless.reached(config.level_speedless);
        // MIT-4: the driver's steering ends levels 1 and 2; in automatic steering only after a takeover.
        let by_driver = !steered.automatic || steered.takeover;
        let leaves = |limit: AngleDeciDeg| {
            over || gone.reached(config.level_gone)
                || (by_driver && angle.is_some_and(|angle| angle > limit.raw().unsigned_abs()))
        };

        let danger = threat.emergency || threat.level == Level::Three;
        let braked = matches!(evidence.brake_pedal, BrakePedal::Pressed(_)) || inputs.epb.is(EpbState::Applied);
        Self {
            one: enter(Level::One, enter_one) || (self.one && !leaves(exit_one)),
            two: enter(Level::Two, enter_two) || (self.two && !leaves(exit_two)),
            three: enter(Level::Three, enter_three) || (self.three && !over),
            gone,
            standstill,
            speedless,
            hold: (self.hold || speedless.reached(config.level_speedless)) && !braked,
            permitted: danger || (self.permitted && !over && !gone.reached(config.level_gone)),
            forward: alert(self.forward, threat.forward),
            pedestrian: alert(self.pedestrian, threat.pedestrian),
        }
    }
}

const fn alert(on: bool, says: Alert) -> bool {
    match says {
        Alert::On => true,
        Alert::Off => false,
        Alert::Keep => on,
    }
}
