//! May automatic steering act, and how far? (S4 6.3; STR-1, STR-2)
//!
//! The target moves from our last output by no more than the rate allows, towards the window that speed and the
//! measured angle permit: on a fault it never jumps. Weight and overlay torque fade in and out.

use crate::envelope::{Permission, SteeringBound};
use supervisor_observe::Evidence;
use supervisor_observe::Ticks;

use supervisor_terms::kernel;
use supervisor_terms::word::{permit, retained};
use supervisor_terms::{
    AngleDeciDeg, Config, EpsState, Inputs, Mode, Outputs, Percent, RateDeciDegS, Reason, Rest, SpeedKmhQ8, Timer,
    TorqueNmQ10,
};

retained! {
    /// The steering machine.
    SteeringState {
        /// Last output weight; above 0 automatic steering acts.
        weight: Percent = Percent::ZERO,
        /// Last output angle; the measured one while nothing acts.
        angle: AngleDeciDeg = AngleDeciDeg::ZERO,
        /// Rest of the reachable angle, below 0.1°.
        angle_rest: Rest = Rest::ZERO,
        /// Rest of the fading weight, below 1 %.
        fade_rest: Rest = Rest::ZERO,
        /// Last output overlay torque.
        overlay: TorqueNmQ10 = TorqueNmQ10::ZERO,
        /// The driver's torque is beyond the takeover torque.
        takeover: Timer = Timer::STOPPED,
        /// Taken over: automatic steering must be asked for anew.
        barred: bool = false,
        /// It did not follow: it must be asked for anew, too (RSP-1).
        astray: bool = false,
        /// It acts without a usable command: it fades out.
        lost: bool = false,
    }
}

/// The row of the speed tables: up to 10, 20, 30, 40, 60, 80 km/h, and above.
fn row(speed: SpeedKmhQ8) -> usize {
    match speed.raw() {
        0..=2560 => 0,
        2561..=5120 => 1,
        5121..=7680 => 2,
        7681..=10240 => 3,
        10241..=15360 => 4,
        15361..=20480 => 5,
        20481.. => 6,
    }
}

/// The rate table at a speed; unknown speed: the bounds of the highest.
fn rate(evidence: &Evidence, config: &Config) -> RateDeciDegS {
    let row = evidence.speed.map_or(6, |speed| row(speed.high));
    config.steering_rate.0.get(row).copied().unwrap_or_default()
}

impl SteeringState {
    /// Automatic steering acts on the wheel.
    pub(crate) fn acts(&self) -> bool {
        self.weight > Percent::ZERO
    }

    /// STR-2: the driver has taken over.
    pub(crate) const fn taken_over(&self, config: &Config) -> bool {
        self.takeover.reached(config.takeover_time)
    }

    /// `astray` says that the steering does not follow (RSP-1).
    pub(crate) fn advance(
        self,
        astray: bool,
        evidence: &Evidence,
        inputs: &Inputs,
        ticks: Ticks,
        config: &Config,
    ) -> Self {
        let limit = config.takeover_torque.raw().unsigned_abs();
        let strong = inputs.driver_torque.known().is_some_and(|torque| torque.raw().unsigned_abs() > limit);
        let takeover = self.takeover.run_while(strong, ticks.safety);
        let angle = if self.acts() { self.angle } else { evidence.steering_angle.unwrap_or(self.angle) };

        let barred = self.barred || takeover.reached(config.takeover_time);
        let astray = self.astray || astray;
        Self { angle, takeover, barred, astray, ..self }
    }

    /// After vetting. `asked` says whether a usable command asked for automatic steering; `None`: no usable command.
    pub(crate) fn record(
        self,
        outputs: &Outputs,
        bound: &SteeringBound,
        asked: Option<bool>,
        ticks: Ticks,
        config: &Config,
    ) -> Self {
        let (_, angle_rest) = self.angle_rest.portion(bound.rate.raw(), ticks.permission);
        let (_, fade_rest) = self.fade_rest.portion(config.steering_fade.raw(), ticks.permission);
        Self {
            angle_rest,
            fade_rest,
            weight: outputs.steering.weight,
            angle: outputs.steering.angle,
            overlay: outputs.steering.overlay,
            // A lost command is no evidence that it is asked for anew.
            barred: self.barred && asked != Some(false),
            astray: self.astray && asked != Some(false),
            lost: asked.is_none() && outputs.steering.weight > Percent::ZERO,
            ..self
        }
    }

    fn permission(
        &self,
        mode: Mode,
        safe_state: bool,
        evidence: &Evidence,
        inputs: &Inputs,
        config: &Config,
    ) -> Permission {
        let in_range = evidence.speed.is_some_and(|speed| {
            speed.low >= config.steering_speed_least && speed.high <= config.steering_speed_greatest
        });
        let granted = self.acts() || mode != Mode::Manual;
        // SELF-5g: not permitted means that it fades out.
        permit!(!safe_state => Reason::SafeState, !self.barred => Reason::Takeover, !self.astray => Reason::SteeringResponse, matches!(inputs.eps.known(), Some(EpsState::Ready | EpsState::Active)) => Reason::PowerSteering, (evidence.steering_angle.is_some() && inputs.driver_torque.known().is_some()) => Reason::SteeringRefused, in_range => Reason::SteeringSpeed, (granted && !inputs.cruise_switch.is(false)) => Reason::SteeringRefused)
    }

    pub(crate) fn bound(
        &self,
        mode: Mode,
        safe_state: bool,
        evidence: &Evidence,
        inputs: &Inputs,
        ticks: Ticks,
        config: &Config,
    ) -> SteeringBound {
        let enable = self.permission(mode, safe_state, evidence, inputs, config);
        // Unknown speed: the bounds of the highest speed.
        let row = evidence.speed.map_or(6, |speed| row(speed.high));
        let limit = config.steering_angle.0.get(row).map_or(0, |angle| angle.raw());
        let rate = rate(evidence, config);

        // STR-1, CMD-3f: the window of speed and measured angle, then what the rate can reach of it: no jump, ever.
        let measured = evidence.steering_angle.unwrap_or(self.angle).raw();
        let deviation = config.steering_deviation.raw().max(0);
        let window = |edge: i16| edge.max(limit.saturating_neg()).min(limit);
        let (reach, _) = self.angle_rest.portion(rate.raw(), ticks.permission);
        let reach = i16::try_from(reach).unwrap_or(i16::MAX);
        let (from, to) = (self.angle.raw().saturating_sub(reach), self.angle.raw().saturating_add(reach));
        let least = window(measured.saturating_sub(deviation)).max(from).min(to);
        let most = window(measured.saturating_add(deviation)).max(from).min(to);

        let share =
            |ticks| u8::try_from(self.fade_rest.portion(config.steering_fade.raw(), ticks).0).unwrap_or(u8::MAX);
        let (fade_in, fade_out) = (share(ticks.permission), share(ticks.safety));
        let weight = self.weight.raw().min(100);
        let (overlay_least, overlay_most, overlay_neutral) = self.overlay(fade_in, fade_out, config);
        SteeringBound {
            enable,
            angle_least: AngleDeciDeg::new(least),
            angle_most: AngleDeciDeg::new(most),
            // Where it is, as far as the window allows: asking for nothing is inside the envelope, too.
            angle_neutral: AngleDeciDeg::new(self.angle.raw().max(least).min(most)),
            range: config.steering_range,
            rate,
            overlay_least,
            overlay_most,
            overlay_neutral,
            weight_least: Percent::new(weight.saturating_sub(fade_out)),
            weight_most: Percent::new(weight.saturating_add(fade_in).min(100)),
            bar: config.steering_bar,
        }
    }

    /// STR-2: the window of the overlay torque around the last one, and the last one faded towards zero.
    fn overlay(&self, fade_in: u8, fade_out: u8, config: &Config) -> (TorqueNmQ10, TorqueNmQ10, TorqueNmQ10) {
        let full = config.steering_overlay.raw().max(0);
        let step = |share| i16::try_from(kernel::share_down(full.unsigned_abs(), share)).unwrap_or(i16::MAX);
        let before = self.overlay.raw().max(full.saturating_neg()).min(full);
        let (down, up) = if before > 0 { (step(fade_out), step(fade_in)) } else { (step(fade_in), step(fade_out)) };
        let least = before.saturating_sub(down).max(full.saturating_neg());
        let most = before.saturating_add(if before == 0 { down } else { up }).min(full);
        (TorqueNmQ10::new(least), TorqueNmQ10::new(most), TorqueNmQ10::new(least.max(most.min(0))))
    }
}
