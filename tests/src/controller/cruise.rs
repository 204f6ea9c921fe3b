//! S2: the cruise control (ADAS-VLC), and a lane assistant that holds the wheel. Both end with every obligation.

use supervisor::{
    AdsState, AngleDeciDeg, BarTorque50mNm, EpsState, Inputs, Percent, RateDeciDegS, Steering, TorqueNmQ10,
};

use super::sources::{
    CRUISE_DELAY_MS, CRUISE_TORQUE, GREATEST_SPEED, OVERRIDE_LEAST, OVERRIDE_OFFSET, STEERING_MARGIN,
};
use super::view::{Held, View};
/// Torque per km/h of error, and per km/h of speed, in % (own): about what the bus of the model needs.
const GAIN: f64 = 10.0;
/// See [`GAIN`].
const FEED: f64 = 0.2;
/// Greatest weight of the lane assistant, in % (own).
const WEIGHT: u8 = 80;

/// The cruise control.
#[derive(Clone, Copy, Debug, Default)]
pub struct Cruise {
    /// Set speed in km/h while it is active.
    set: Option<f64>,
    active_for: Held,
    weight: u8,
    angle: i16,
    /// Torque it last asked for, in %; 0 while the driver's pedal governs.
    asked: f64,
    overridden: bool,
}

impl Cruise {
    /// One cycle. `allowed`: somebody sits for certain and no obligation runs.
    pub fn update(&mut self, inputs: &Inputs, view: &View, allowed: bool) {
        let healthy = matches!(inputs.ads.known(), Some(AdsState::Ready | AdsState::Active))
            && inputs.cruise_switch.is(true)
            && !view.braking;
        let pressed = inputs.driver_set.is(true);
        self.set = match (allowed && healthy, self.set, view.speed) {
            (false, _, _) | (true, None, None) => None,
            (true, Some(set), _) => Some(set),
            (true, None, Some(speed)) => pressed.then(|| speed.round().min(GREATEST_SPEED)),
        };
        self.active_for.update(self.set.is_some());

        let eps = matches!(inputs.eps.known(), Some(EpsState::Ready | EpsState::Active));
        let steer = self.granted() && eps && view.below(GREATEST_SPEED - STEERING_MARGIN);
        if self.weight == 0 {
            self.angle = inputs.steering_angle.known().map_or(0, AngleDeciDeg::raw);
        }
        // S4 6.3.3: 1 % per cycle, in and out.
        self.weight = if steer { self.weight.saturating_add(1).min(WEIGHT) } else { self.weight.saturating_sub(1) };
    }

    /// It asks for the automated mode.
    #[must_use]
    pub const fn active(&self) -> bool {
        self.set.is_some()
    }
    /// It has had the time to be granted.
    const fn granted(&self) -> bool {
        self.active_for.for_at_least(CRUISE_DELAY_MS)
    }
    /// It turns the wheel.
    #[must_use]
    pub const fn steers(&self) -> bool {
        self.weight > 0
    }
    /// Set speed in km/h, once granted.
    #[must_use]
    pub fn target(&self) -> Option<f64> {
        self.set.filter(|_| self.granted())
    }
    /// Torque it asks for, in %.
    #[must_use]
    pub fn torque(&self, view: &View) -> Option<f64> {
        let (set, speed) = (self.target()?, view.speed?);
        Some(((set - speed) * GAIN + set * FEED).clamp(0.0, CRUISE_TORQUE))
    }
    /// S2 §2 2): without positive ADAS torque the driver overrides beyond `MinTorq`; with it beyond torque + offset, not
    /// below the torque, and between the two it stays as it was.
    pub fn overridden(&mut self, pedal: f64) -> bool {
        self.overridden = if self.asked <= 0.0 {
            pedal > OVERRIDE_LEAST
        } else {
            pedal > self.asked + OVERRIDE_OFFSET || (self.overridden && pedal >= self.asked)
        };
        self.overridden
    }
    /// What went out in its name.
    pub const fn sent(&mut self, torque: f64) {
        self.asked = torque;
    }
    /// What it asks of the steering.
    #[must_use]
    pub const fn steering(&self) -> Steering {
        if self.weight == 0 {
            return Steering::NEUTRAL;
        }
        Steering {
            enable: true,
            angle: AngleDeciDeg::new(self.angle),
            rate: RateDeciDegS::new(200),
            overlay: TorqueNmQ10::ZERO,
            weight: Percent::new(self.weight),
            bar_limit: BarTorque50mNm::new(60),
        }
    }
}
