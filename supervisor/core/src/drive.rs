//! Who drives, and how much torque is permitted? (S2; TRQ-1 to TRQ-6, SPD-1, MODE-1)

use crate::envelope::{Bound, Permission, TorqueBound};
use supervisor_observe::Ticks;
use supervisor_observe::{BrakePedal, Evidence, percent};

use supervisor_terms::kernel;
use supervisor_terms::word::{permit, retained};
use supervisor_terms::{
    AdsState, Config, Count, DecelMs2Q11, DriveTorque, DrivingMode, EpbState, ExitReason, Gear, Inputs, Level, Millis,
    Mode, Origin, Outputs, Pedal250, Percent, PercentPerS, Reason, Rest, SpeedKmhQ8, Threat, Timer,
};

retained! {
    /// The drive machine.
    Drive {
        /// The mode.
        mode: Mode = Mode::Manual,
        /// Why the last automated mode ended.
        exit: ExitReason = ExitReason::None,
        /// Time since the last automated mode ended for a reason that the driver did not give.
        notice: Timer = Timer::STOPPED,
        /// Last output torque.
        torque: Percent = Percent::ZERO,
        /// Last torque that ADAS or EPBi asked for, up to our bound: the driver's accelerator is compared with it.
        automated: Percent = Percent::ZERO,
        /// Rest of the rising torque, below 1 %.
        rest: Rest = Rest::ZERO,
        /// The driver's "set" was seen off since the mode last ended: setting it is new evidence.
        armed: bool = false,
        /// After leave: the accelerator must be seen released (TRQ-5).
        release_needed: bool = false,
        /// Torque against the brake (TRQ-6); runs until the brake demand ends.
        hill: Timer = Timer::STOPPED,
    }
}

/// What the drive bounds depend on beside the inputs.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Obligations {
    /// A mitigation latch or its hold.
    pub mitigation: bool,
    /// Leave.
    pub leave: bool,
    /// Safe state.
    pub safe_state: bool,
    /// Clock fault in this cycle.
    pub clock_fault: bool,
    /// High voltage is being, or was, shut down after leave.
    pub shutdown: bool,
    /// The seat is confirmed occupied.
    pub confirmed: bool,
    /// The driver has taken over the steering.
    pub takeover: bool,
    /// The brake command has been lost for longer than it is held.
    pub brake_lost: bool,
    /// Somebody else commands an actuator (SELF-10).
    pub bypass: bool,
    /// The drive gives more than it was told (TRQ-7).
    pub excess: bool,
}

impl Obligations {
    // SELF-10c, TRQ-7b: among them a bypass and a drive that does not obey.
    const fn reason(self) -> Option<Reason> {
        if self.safe_state {
            Some(Reason::SafeState)
        } else if self.leave {
            Some(Reason::Leave)
        } else if self.mitigation {
            Some(Reason::Mitigation)
        } else if self.excess {
            Some(Reason::ExcessTorque)
        } else if self.bypass {
            Some(Reason::Bypass)
        } else {
            None
        }
    }
}

impl Drive {
    /// MODE-1: a mode that ended by itself is noticed for a while.
    pub(crate) const fn notices(&self, config: &Config) -> bool {
        self.notice.is_running() && !self.notice.reached(config.notice_time)
    }

    pub(crate) fn advance(
        self,
        must: Obligations,
        threat: &Threat,
        evidence: &Evidence,
        inputs: &Inputs,
        ticks: Ticks,
        config: &Config,
    ) -> Self {
        let released = evidence.accelerator.is_some_and(|travel| travel <= config.pedal_pressed);
        let release_needed = must.leave || must.excess || (self.release_needed && !released);
        let (mode, exit) = match (self.mode, exit_reason(must, threat, evidence, inputs)) {
            (Mode::Manual, _) => (Mode::Manual, self.exit),
            (Mode::Automated | Mode::Suspended, Some(reason)) => (Mode::Manual, reason),
            (Mode::Automated | Mode::Suspended, None) => {
                let over = self.overridden(evidence, config);
                (if over { Mode::Suspended } else { Mode::Automated }, self.exit)
            }
        };
        let manual = mode == Mode::Manual;
        // Mitigation tells the driver by its own warnings.
        let given = matches!(exit, ExitReason::None | ExitReason::Requested | ExitReason::BrakePedal)
            || matches!(exit, ExitReason::Switch | ExitReason::Mitigation);
        let notice = self.notice.run_while(manual && !given, ticks.permission);
        let armed = manual && (inputs.driver_set.is(false) || (self.armed && self.mode == Mode::Manual));
        Self { mode, exit, notice, armed, release_needed, ..self }
    }

    /// TRQ-4: whether the driver's accelerator overrides.
    fn overridden(&self, evidence: &Evidence, config: &Config) -> bool {
        let before = self.mode == Mode::Suspended;
        let Some(travel) = evidence.accelerator else { return before };
        if self.automated == Percent::ZERO {
            return travel > config.override_least;
        }
        // Pedal in 0.4 %, torque in 1 %: both in 0.2 %.
        let pedal = u16::from(travel.raw()).saturating_mul(2);
        let torque = u16::from(self.automated.raw());
        let offset = u16::from(config.override_offset.raw());
        if pedal > torque.saturating_add(offset).saturating_mul(5) {
            true
        } else if pedal < torque.saturating_mul(5) {
            false
        } else {
            before
        }
    }

    /// After vetting: what went out.
    ///
    /// `braking` is the total of service brake and retarder, `asked` a usable drive command, `mode_lost` says that no
    /// usable command named the mode.
    pub(crate) fn record(
        self,
        outputs: &Outputs,
        braking: DecelMs2Q11,
        asked: Option<DriveTorque>,
        mode_lost: bool,
        ticks: Ticks,
        config: &Config,
    ) -> Self {
        let against = outputs.drive.torque > Percent::ZERO && braking > DecelMs2Q11::ZERO;
        let counts = braking > DecelMs2Q11::ZERO && (against || self.hill.is_running());
        let hill = self.hill.run_while(counts, ticks.safety);
        let (mode, exit) = match (self.mode, outputs.mode) {
            (Mode::Manual, DrivingMode::Automated) => (Mode::Automated, ExitReason::None),
            (Mode::Automated | Mode::Suspended, DrivingMode::Manual) => {
                (Mode::Manual, if mode_lost { ExitReason::CommandLost } else { ExitReason::Requested })
            }
            (mode, _) => (mode, self.exit),
        };
        let automated = asked
            .filter(|drive| drive.origin != Origin::Driver && drive.active)
            .map_or(Percent::ZERO, |drive| drive.torque.min(config.automated_torque));
        let armed = self.armed && mode == Mode::Manual;
        let (_, rest) = self.rest.portion(config.torque_ramp.raw(), ticks.permission);
        Self { mode, exit, torque: outputs.drive.torque, automated, rest, armed, hill, ..self }
    }

    /// MODE-1: the automated mode may begin (from manual) or go on.
    pub(crate) fn permission(
        &self,
        must: Obligations,
        threat: &Threat,
        evidence: &Evidence,
        inputs: &Inputs,
    ) -> Permission {
        let healthy = exit_reason(must, threat, evidence, inputs).is_none();
        let running = self.mode != Mode::Manual;
        let evidence_of_driver = self.armed && inputs.driver_set.is(true) && must.confirmed;
        permit!(!must.clock_fault => Reason::ClockFault, (must.reason().is_none() || running) => must.reason().unwrap_or(Reason::Within), (healthy && (running || evidence_of_driver)) => Reason::ModeNotGranted)
    }

    /// The torque bounds of this cycle.
    pub(crate) fn bound(
        &self,
        must: Obligations,
        granted: Permission,
        threat: &Threat,
        evidence: &Evidence,
        inputs: &Inputs,
        ticks: Ticks,
        config: &Config,
    ) -> TorqueBound {
        let mut common = Bound { most: Percent::FULL, reason: Reason::DriveLimit };
        // SEAT-2a, MIT-5a, SELF-5c: no torque against an obligation.
        let mut refuse = |condition, reason| common.lower_if(condition, Percent::ZERO, reason);
        if let Some(reason) = must.reason() {
            refuse(true, reason);
        }
        refuse(self.release_needed, Reason::ReleaseNeeded);
        refuse(must.shutdown, Reason::Shutdown);
        // SEAT-6b: without a confirmed driver no torque when slow, parked, or neither known.
        let moving = evidence.surely_at_least(config.epb_speed) && inputs.epb.is(EpbState::Released);
        refuse(!must.confirmed && !moving, Reason::SeatNotOccupied);
        // TRQ-6: only in a confirmed direction.
        refuse(!matches!(inputs.gear.known(), Some(Gear::Drive | Gear::Reverse)), Reason::GearDirection);
        // TRQ-5: electric limit; unknown ⇒ none.
        common.lower(percent(inputs.drive_limit).unwrap_or(Percent::ZERO), Reason::DriveLimit);
        // RSP-1n: slip control at work (or unknown): no rise.
        common.lower_if(!inputs.asr.is(false), self.torque, Reason::SlipControl);

        // TRQ-5: rises are limited, falls never.
        let ramped = self.ramped(config.torque_ramp, ticks.permission);
        let mut driver = common;
        driver.lower(ramped, Reason::TorqueRamp);
        match evidence.accelerator {
            None => driver.lower(Percent::ZERO, Reason::AcceleratorUnknown),
            Some(travel) => driver.lower(pedal_map(travel, config), Reason::PedalMap),
        }
        let both = evidence.brake_pedal != BrakePedal::Released && evidence.accelerator_pressed;
        driver.lower_if(both, Percent::ZERO, Reason::BothPedals);

        let mut automated = common;
        automated.lower_if(evidence.brake_pedal != BrakePedal::Released, Percent::ZERO, Reason::BrakePedal);
        // TRQ-4: the pedal governs, whoever asks.
        automated.lower_if(self.mode == Mode::Suspended, driver.most, Reason::DriverOverride);
        automated.lower_if(self.mode == Mode::Manual || granted.is_err(), Percent::ZERO, Reason::ModeNotGranted);
        automated.lower_if(!threat.known, Percent::ZERO, Reason::PerceptionUnknown);
        // Rule 1: no automated torque towards an obstacle, at whatever speed; MIT-6's gates only end obligations.
        automated.lower_if(threat.level != Level::None, Percent::ZERO, Reason::ObstacleAhead);
        automated.lower(config.automated_torque, Reason::AccelerationBound);
        // VLC-1a, VLC-1c, VLC-1d: the longitudinal mode that is not configured may not command.
        let by_epbi = config.longitudinal_mode != Count::ZERO;

        let tired = self.hill.due(config.hill_hold, ticks.safety);
        let hill_hold = must.confirmed && evidence.surely_below(config.hill_hold_speed) && !tired;
        let mut epbi = automated;
        epbi.lower(ramped.max(config.idle_torque), Reason::TorqueRamp);
        epbi.lower_if(!by_epbi, Percent::ZERO, Reason::NotConfigured);
        automated.lower(ramped, Reason::TorqueRamp);
        automated.lower_if(by_epbi, Percent::ZERO, Reason::NotConfigured);
        TorqueBound { driver, automated, epbi, idle: config.idle_torque, hill_hold }
    }

    /// TRQ-5, CMD-3f: the last output plus what the gradient allows in this cycle.
    fn ramped(&self, ramp: PercentPerS, elapsed: Millis) -> Percent {
        let (rise, _) = self.rest.portion(ramp.raw(), elapsed);
        Percent::new(self.torque.raw().saturating_add(u8::try_from(rise).unwrap_or(u8::MAX)).min(100))
    }

    /// SPD-1: the limit, and nothing while an obligation runs or the mode is manual.
    pub(crate) fn target_speed(
        &self,
        must: Obligations,
        granted: Permission,
        threat: &Threat,
        config: &Config,
    ) -> Bound<SpeedKmhQ8> {
        let mut bound = Bound { most: config.speed_limit, reason: Reason::SpeedLimit };
        if let Some(reason) = must.reason() {
            bound.lower(SpeedKmhQ8::ZERO, reason);
        }
        bound.lower_if(self.mode == Mode::Manual || granted.is_err(), SpeedKmhQ8::ZERO, Reason::ModeNotGranted);
        bound.lower_if(threat.level != Level::None, SpeedKmhQ8::ZERO, Reason::ObstacleAhead);
        bound
    }
}

/// TRQ-1: the map of accelerator to torque, linear between its points, plus its tolerance.
///
/// The tolerance begins where the pedal counts as pressed.
fn pedal_map(travel: Pedal250, config: &Config) -> Percent {
    /// The points lie 10 % = 25 × 0.4 % apart.
    const STEP: u8 = 25;
    let index = usize::from(travel.raw() / STEP);
    let point =
        |index: usize| config.pedal_map.0.get(index).or(config.pedal_map.0.last()).map_or(0, |torque| torque.raw());
    let torque = kernel::between_down(point(index), point(index.saturating_add(1)), travel.raw() % STEP, STEP);
    let tolerance = if travel > config.pedal_pressed { config.pedal_tolerance.raw() } else { 0 };
    Percent::new(torque.saturating_add(tolerance).min(100))
}

/// MODE-1: the first reason for which the automated mode may not go on.
fn exit_reason(must: Obligations, threat: &Threat, evidence: &Evidence, inputs: &Inputs) -> Option<ExitReason> {
    let permission = permit!(
        !(must.safe_state || must.clock_fault) => ExitReason::Fault,
        !must.leave => ExitReason::Leave,
        !must.mitigation => ExitReason::Mitigation,
        !(must.bypass || must.excess) => ExitReason::Bypass,
        (evidence.brake_pedal == BrakePedal::Released) => ExitReason::BrakePedal,
        !must.takeover => ExitReason::Takeover,
        inputs.cruise_switch.is(true) => ExitReason::Switch,
        matches!(inputs.ads.known(), Some(AdsState::Ready | AdsState::Active)) => ExitReason::AdsState,
        !must.brake_lost => ExitReason::CommandLost,
        (threat.known && evidence.speed.is_some() && evidence.accelerator.is_some()) => ExitReason::InputLost,
    );
    permission.err()
}
