//! Do the actuators follow, and nobody else's commands? (RSP-1, TRQ-7, SELF-10, VLC-2f)
//!
//! The monitors keep what went out and compare it with what comes back. They decide nothing: their [`Response`] says
//! what was found, and the decision core calls the next stronger means. Unknown feedback is evidence for neither:
//! what was confirmed stays, nothing new is.

use supervisor_terms::kernel;
use supervisor_terms::word::retained;
use supervisor_terms::{
    AngleDeciDeg, Channels, Config, Contact, ContactorRequest, DecelMs2Q11, Deviation, EpbRequest, EpbState, EpsState,
    Faults, Gear, GearRequest, Inputs, Millis, Outputs, Percent, Response, Timer,
};

use crate::clock::Ticks;
use crate::evidence::{Evidence, percent};
use crate::follow::Follow;
use crate::moves::Moves;
use crate::steered::SteeredAngle;

retained! {
    /// What went out, and how well it was followed.
    Monitors {
        /// The service brake.
        brake: Follow = Follow::INITIAL,
        /// How long it has fallen short.
        short: Timer = Timer::STOPPED,
        /// It fell short of this demand: the next stronger means helps until the demand ends.
        helps: bool = false,
        /// How long they have given too much.
        brake_over: Timer = Timer::STOPPED,
        /// Drive torque, too little.
        drive: Follow = Follow::INITIAL,
        /// Drive torque, too much: since when.
        excess: Timer = Timer::STOPPED,
        /// The greatest torque told since then.
        told: Percent = Percent::ZERO,
        /// The drive was found to disobey: it is told 0, and no more is allowed to it.
        disobeys: bool = false,
        /// The steering angle.
        steering: SteeredAngle = SteeredAngle::INITIAL,
        /// The power steering steers though no output lets it.
        steers: Timer = Timer::STOPPED,
        /// Gear asked for and not confirmed.
        gear: Timer = Timer::STOPPED,
        /// The gearbox.
        gearbox: Moves<Gear> = Moves::INITIAL,
        /// The parking brake.
        epb: Moves<EpbState> = Moves::INITIAL,
        /// It was released though no output released it, and has not been applied since.
        loose: bool = false,
        /// K4.
        k4: Moves<Contact> = Moves::INITIAL,
        /// K1.
        k1: Moves<Contact> = Moves::INITIAL,
        /// Since a bypass was last seen.
        bypass: Timer = Timer::STOPPED,
        /// Last output: service brake.
        service: DecelMs2Q11 = DecelMs2Q11::ZERO,
        /// Last output: service brake and retarder together.
        total: DecelMs2Q11 = DecelMs2Q11::ZERO,
        /// Last output: in level 3.
        emergency: bool = false,
        /// Last output: drive torque.
        torque: Percent = Percent::ZERO,
        /// Last output: steering angle.
        angle: AngleDeciDeg = AngleDeciDeg::ZERO,
        /// Last output: weight of the steering.
        weight: Percent = Percent::ZERO,
    }
}

/// What `percent` of a value is.
fn share(value: u16, percent: Percent) -> u16 {
    kernel::share_down(value, percent.raw())
}

/// A timer that stays as it is while its condition is not known.
fn known_run(timer: Timer, condition: Option<bool>, elapsed: Millis) -> Timer {
    condition.map_or(timer, |condition| timer.run_while(condition, elapsed))
}

/// A time of S4's tables, with the dead time and the age of the feedback.
fn allowed(time: Millis, config: &Config) -> Millis {
    Millis::new(time.raw().saturating_add(config.response_age.raw()))
}

impl Monitors {
    /// RSP-1d, RSP-1e, SELF-10a, SELF-10b: compares the feedback of this cycle with the last output.
    #[must_use]
    pub fn advance(self, evidence: &Evidence, inputs: &Inputs, ticks: Ticks, config: &Config) -> (Self, Response) {
        let (gearbox, gear_alone) = self.gearbox.advance(inputs.gear.known());
        let (epb, epb_alone) = self.epb.advance(inputs.epb.known());
        let (k4, k4_alone) = self.k4.advance(inputs.k4.known());
        let (k1, k1_alone) = self.k1.advance(inputs.k1.known());
        // A gearbox on its way to what was asked for may pass other gears; one that falls to neutral does not drive.
        let gear_alone = gear_alone
            && self.gearbox.asked.is_none()
            && matches!(inputs.gear.known(), Some(Gear::Drive | Gear::Reverse));
        let steers_alone = inputs.eps.is(EpsState::Active) && self.weight == Percent::ZERO;
        let next = Self {
            gearbox,
            epb,
            k4,
            k1,
            gear: known_run(self.gear, inputs.gear.known().map(|_| gearbox.asked.is_some()), ticks.safety),
            loose: (self.loose || (epb_alone && inputs.epb.is(EpbState::Released)))
                && !inputs.epb.is(EpbState::Applied),
            steers: known_run(self.steers, inputs.eps.known().map(|_| steers_alone), ticks.safety),
            ..self
        };
        let next = next.with_brake(evidence, inputs, ticks.safety, config).with_drive(inputs, ticks.safety, config);
        let next = next.with_steering(inputs, ticks.safety, config);

        let [_, steering_outer] = config.response_steering.0;
        let steering_outer = allowed(steering_outer, config);
        let contactor = k4_alone || k1_alone;
        let steers = next.steers.reached(steering_outer);
        let alone = gear_alone || contactor || next.loose || steers || inputs.foreign != Channels::NONE;
        let seen = alone || inputs.second_sender;
        let since = if seen { Timer::STOPPED.run(ticks.safety) } else { next.bypass };
        let running = since.is_running() && !since.reached(config.bypass_hold);
        let bypass = if seen || !running { since } else { since.run(ticks.permission) };
        let next = Self { bypass, ..next };
        let response = next.response(inputs, config);
        let faults = response
            .faults
            .when(alone, Faults::BYPASS)
            .when(inputs.second_sender, Faults::SECOND_SENDER)
            .when(contactor, Faults::CONTACTOR);
        (next, Response { bypass: running, faults, ..response })
    }

    /// RSP-1b, RSP-1c, RSP-1g, RSP-1i, RSP-1j, RSP-1l: deceleration against the last output, while the bus rolls and ABS
    /// is not at work. What the retarder gives counts as help, not as a demand.
    fn with_brake(self, evidence: &Evidence, inputs: &Inputs, elapsed: Millis, config: &Config) -> Self {
        let stands = evidence.surely_below(config.response_speed);
        let compared = self.service >= config.response_decel && !stands && !inputs.abs.is(true);
        let target = if compared { self.service.raw() } else { 0 };
        let measured = inputs.deceleration.known().filter(|measured| *measured <= config.decel_plausible);
        let measured = measured.filter(|_| evidence.speed.is_some()).map(DecelMs2Q11::raw);
        let brake = self.brake.advance(target, measured, config.response_error.raw(), elapsed);
        let total = self.total.raw();
        let most = total.saturating_add(share(total, config.response_error)).saturating_add(config.response_drag.raw());
        let over = measured.map(|measured| compared && inputs.brake_switch.is(false) && measured > most);
        // VLC-2f: or the limits of both parts do not reach it.
        let unable = inputs
            .friction_limit
            .known()
            .is_some_and(|friction| friction.raw().saturating_add(evidence.electric.raw()) < target);
        let next = Self { brake, brake_over: known_run(self.brake_over, over, elapsed), ..self };
        let short = next.falls_short(config);
        Self { short: self.short.run_while(short, elapsed), helps: compared && (self.helps || short || unable), ..next }
    }

    /// RSP-1b, RSP-1c, RSP-1g: the service brake has not followed in time.
    fn falls_short(&self, config: &Config) -> bool {
        let [ordinary, emergency, outer] = config.response_brake.0;
        let inner = if self.emergency { emergency } else { ordinary };
        self.brake.fails(allowed(inner, config), allowed(outer, config))
    }

    /// RSP-1a, f, TRQ-7a: executed torque against the last output.
    fn with_drive(self, inputs: &Inputs, elapsed: Millis, config: &Config) -> Self {
        let executed = percent(inputs.executed_torque);
        // Below the idle torque the drive need not answer (S4 table 2); slip control may take torque away.
        let compared = self.torque >= config.idle_torque && !inputs.asr.is(true);
        let target = if compared { u16::from(self.torque.raw()) } else { 0 };
        let measured = executed.map(|torque| u16::from(torque.raw()));
        let drive = self.drive.advance(target, measured, config.response_error.raw(), elapsed);
        let next = Self { drive, ..self };
        let Some(measured) = measured else { return next };
        // A torque that is let go takes its time: it is held against the greatest told since it was too much.
        let told = if self.excess.is_running() { self.told.max(self.torque) } else { self.torque };
        let base = if self.disobeys { 0 } else { u16::from(told.raw()) };
        let most = base
            .saturating_add(share(base, config.response_error))
            .saturating_add(u16::from(config.torque_excess.raw()));
        let excess = self.excess.run_while(measured > most, elapsed);
        let disobeys = measured > most && (self.disobeys || excess.reached(allowed(config.response_drive, config)));
        Self { excess, told, disobeys, ..next }
    }

    /// RSP-1e, f: the measured angle against the last output, while automatic steering has its full weight.
    fn with_steering(self, inputs: &Inputs, elapsed: Millis, config: &Config) -> Self {
        if self.weight < Percent::FULL {
            return Self { steering: SteeredAngle::INITIAL, ..self };
        }
        let band = config.response_angle.raw().unsigned_abs();
        let band = band.saturating_add(share(self.angle.raw().unsigned_abs(), config.response_error));
        let steering = self.steering.advance(self.angle, inputs.steering_angle.known(), band, elapsed);
        Self { steering, ..self }
    }

    /// What was found.
    fn response(&self, inputs: &Inputs, config: &Config) -> Response {
        let short = self.falls_short(config);
        let red = inputs.ebs_red.is(true);
        // RSP-1m: EBS red calls the next means at once, and the one after it as soon as a shortfall is confirmed; level 3
        // has no time to try one after the other: there, what is within the error that S4 allows is left to the retarder (R-af).
        let due = red || self.emergency || self.short.reached(config.response_retarder);
        let enough = self.emergency && !self.brake.far;
        let brake = if short && due && !enough {
            Deviation::Persistent
        } else if short || self.helps || red {
            Deviation::Confirmed
        } else {
            Deviation::None
        };
        let drive = allowed(config.response_drive, config);
        let persistent = Millis::new(drive.raw().saturating_add(config.response_drive.raw()));
        let torque = match (self.disobeys, self.excess.reached(persistent)) {
            (false, _) => Deviation::None,
            (true, false) => Deviation::Confirmed,
            (true, true) => Deviation::Persistent,
        };
        let [first, outer] = config.response_steering.0;
        let steering = self.steering.fails(allowed(first, config), allowed(outer, config));
        let faults = Faults::NONE
            .when(short || self.helps, Faults::BRAKE_RESPONSE)
            .when(red, Faults::EBS_RED)
            .when(self.brake_over.reached(config.response_overshoot), Faults::BRAKE_OVERSHOOT)
            .when(self.drive.fails(drive, drive), Faults::DRIVE_RESPONSE)
            .when(self.disobeys, Faults::EXCESS_TORQUE)
            .when(self.gear.reached(allowed(config.response_gear, config)), Faults::GEAR_RESPONSE)
            .when(steering, Faults::STEERING_RESPONSE)
            .when(self.steering.over.reached(config.response_overshoot), Faults::STEERING_OVERSHOOT);
        Response { brake, torque, steering, parking: self.loose, bypass: false, faults }
    }

    /// After vetting: what went out. `total` is service brake and retarder together, `emergency` says level 3: its
    /// shorter time begins with it.
    #[must_use]
    pub fn record(self, outputs: &Outputs, total: DecelMs2Q11, emergency: bool) -> Self {
        let gear = match outputs.gear {
            GearRequest::Hold => None,
            GearRequest::Drive => Some(Gear::Drive),
            GearRequest::Reverse => Some(Gear::Reverse),
            GearRequest::Neutral => Some(Gear::Neutral),
            GearRequest::Park => Some(Gear::Park),
        };
        let epb = match outputs.epb.request {
            EpbRequest::None => None,
            EpbRequest::Apply => Some(EpbState::Applied),
            EpbRequest::Release => Some(EpbState::Released),
        };
        let contact = |request| match request {
            ContactorRequest::Hold => None,
            ContactorRequest::Open => Some(Contact::Open),
            ContactorRequest::Close => Some(Contact::Closed),
        };
        Self {
            gearbox: self.gearbox.record(gear),
            epb: self.epb.record(epb),
            loose: self.loose && epb != Some(EpbState::Released),
            k4: self.k4.record(contact(outputs.contactors.k4)),
            k1: self.k1.record(contact(outputs.contactors.k1)),
            brake: if emergency && !self.emergency && !self.helps { self.brake.restarted() } else { self.brake },
            service: outputs.brake.total,
            total,
            emergency,
            torque: outputs.drive.torque,
            angle: outputs.steering.angle,
            weight: if outputs.steering.enable { outputs.steering.weight } else { Percent::ZERO },
            ..self
        }
    }
}
