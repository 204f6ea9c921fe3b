//! A correct main controller, written from S1 to S3 and never from the supervisor's code.
//!
//! It reads the same inputs as the supervisor and answers one cycle later: what it decides on the inputs of one
//! cycle is on the link in the next.

mod cruise;
mod leave;
mod mitigation;
mod pace;
mod perception;
mod sources;
mod view;

use supervisor::{
    Auxiliaries, Body, BrakeMode, DecelMs2Q11, DriveTorque, DrivingMode, EpbState, Inputs, Millis, Origin, Outputs,
    Percent, Priority, Scene, ServiceBrake, SpeedKmhQ8, Warnings,
};

use crate::number::{nearest, to_u8, to_u16};
use cruise::Cruise;
use leave::Leave;
use mitigation::Mitigation;
pub use pace::Pace;
use sources::{BULB_CHECK_MS, ELECTRIC_MARGIN, LAMP_DECEL, LAMP_DELAY_MS, TORQUE_RISE};
use view::View;

/// The main controller.
#[derive(Clone, Debug, Default)]
pub struct Controller {
    leave: Leave,
    mitigation: Mitigation,
    cruise: Cruise,
    /// Torque asked for, in %.
    torque: f64,
    /// The cruise control, not the driver's pedal, governed it last.
    governed_by_cruise: bool,
    lamps_ms: u32,
    /// It warns of a collision, and leaves the braking to the driver.
    leaves_braking: bool,
}

impl Controller {
    /// One that has no collision mitigation of its own: it warns, and leaves the braking to the driver.
    #[must_use]
    pub fn without_mitigation() -> Self {
        Self { leaves_braking: true, ..Self::default() }
    }

    /// One cycle: what every channel is asked for, on these inputs.
    pub fn step(&mut self, now: Millis, inputs: &Inputs, scene: &Scene) -> Outputs {
        let view = View::of(inputs);
        self.leave.update(inputs, &view);
        self.mitigation.update(scene, &view, !self.cruise.steers());
        let obliged = self.mitigates() || self.leave.running;
        self.cruise.update(inputs, &view, self.leave.confirmed() && !obliged);

        let brake = self.brake(inputs, &view);
        let (drive, target_speed) = self.drive(&view, obliged || brake.total > DecelMs2Q11::ZERO);
        let bulb_check = now.raw() < BULB_CHECK_MS;
        let doubtful = view.fault || !scene.radar_known || !scene.camera_known;
        let warnings = Warnings {
            forward_collision: self.mitigation.forward,
            pedestrian: self.mitigation.pedestrian,
            seat_leave: self.leave.running,
            hazard_flashers: self.leave.running,
            fault_lamp: bulb_check || doubtful,
            ..Warnings::NEUTRAL
        };
        let body = Body { brake_lamps: self.lamps(&view, brake), low_beam: true, ..Body::NEUTRAL };
        Outputs {
            drive,
            target_speed,
            brake,
            gear: self.leave.gear(inputs, &view),
            epb: self.leave.parking_brake(inputs, &view),
            steering: self.cruise.steering(),
            contactors: self.leave.contactors(inputs),
            auxiliaries: Auxiliaries::NEUTRAL,
            warnings,
            body,
            mode: if self.cruise.active() { DrivingMode::Automated } else { DrivingMode::Manual },
            ..Outputs::NEUTRAL
        }
    }

    /// A level runs, and it brakes for it.
    fn mitigates(&self) -> bool {
        self.mitigation.running() && !self.leaves_braking
    }

    /// The greatest demand; electric first, as far as its limit goes (S2 §1), friction for the rest.
    fn brake(&self, inputs: &Inputs, view: &View) -> ServiceBrake {
        let mitigation = if self.mitigates() { self.mitigation.demand() } else { 0.0 };
        let demand = mitigation.max(self.leave.demand(view));
        if demand <= 0.0 {
            return ServiceBrake::NEUTRAL;
        }
        let limit = inputs.electric_limit.known().map_or(0.0, |limit| f64::from(limit.raw()) / 2048.0);
        let slip = !(inputs.abs.is(false) && inputs.asr.is(false) && inputs.stability.is(false));
        let electric = if slip { 0.0 } else { (limit - ELECTRIC_MARGIN).clamp(0.0, demand) };
        ServiceBrake {
            total: upwards(demand),
            electric: DecelMs2Q11::new(to_u16((electric * 256.0).floor() * 8.0)),
            mode: BrakeMode::Maximum,
            priority: Priority::Highest,
        }
    }

    /// The driver's pedal, or the cruise control; nothing against a brake.
    fn drive(&mut self, view: &View, refused: bool) -> (DriveTorque, SpeedKmhQ8) {
        let ready = view.in_gear() && view.epb == Some(EpbState::Released) && self.leave.confirmed() && !view.braking;
        let pedal = if view.pressed() { view.accelerator * 100.0 } else { 0.0 };
        let cruise = self.cruise.torque(view);
        let automated = cruise.filter(|_| !self.cruise.overridden(view.accelerator * 100.0));
        if automated.is_some() && !self.governed_by_cruise {
            // Handed over: the driver's pedal no longer carries the torque.
            self.torque = self.torque.min(pedal);
        }
        self.governed_by_cruise = automated.is_some();
        let wanted = if refused || !ready { 0.0 } else { automated.unwrap_or(pedal) };
        // S1 §2.3: no more than the drive says that it can.
        let wanted = wanted.min(view.torque_limit);
        // Per cycle of 10 ms; frames come every 50 ms.
        self.torque = wanted.min(self.torque + TORQUE_RISE / 5.0);
        let torque = Percent::new(to_u8(self.torque.floor()));
        let drive = match automated {
            Some(_) if torque > Percent::ZERO => DriveTorque { torque, active: true, origin: Origin::Adas },
            Some(_) | None => DriveTorque { torque, active: false, origin: Origin::Driver },
        };
        self.cruise.sent(if drive.origin == Origin::Adas { f64::from(drive.torque.raw()) } else { 0.0 });
        let target = if refused { None } else { cruise.and(self.cruise.target()) };
        (drive, SpeedKmhQ8::new(target.map_or(0, |kmh| to_u16(kmh * 256.0))))
    }

    /// Brake lamps: with the pedal, and with every demand from 0.7 m/s²; off a little later.
    fn lamps(&mut self, view: &View, brake: ServiceBrake) -> bool {
        let due = view.braking || f64::from(brake.total.raw()) / 2048.0 >= LAMP_DECEL;
        self.lamps_ms = if due { LAMP_DELAY_MS } else { self.lamps_ms.saturating_sub(10) };
        self.lamps_ms > 0
    }
}

/// m/s² to the resolution of S4 table 5 (1/256 m/s²), upwards.
fn upwards(decel: f64) -> DecelMs2Q11 {
    let steps = nearest((decel * 256.0).ceil()).saturating_mul(8);
    DecelMs2Q11::new(u16::try_from(steps).unwrap_or(u16::MAX))
}
