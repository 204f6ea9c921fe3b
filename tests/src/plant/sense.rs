//! What the sensors of the bus say, as the supervisor reads it.

use supervisor::{
    AdsState, AngleDeciDeg, Cause, Channels, Contact, CurrentDeciA, DecelMs2Q11, EpbMode, EpsState, Inputs, Mass10Kg,
    Pedal250, Percent, Pressure5KPa, Scene, Seat, Signal, SpeedKmhQ8, TorqueNmQ10, XbrStatus,
};

use super::Plant;
use crate::number::{to_i16, to_u8, to_u16};

/// The motor's gear ratio reads the speed a little low (own: 0.2 %).
const MOTOR_SPEED: f64 = 0.998;
/// A pedal beyond this closes its switch.
const SWITCH: f64 = 0.02;

impl Plant<'_> {
    /// Everything that is read independently of the main controller.
    #[must_use]
    pub fn sense(&self) -> (Inputs, Scene) {
        let speed = self.speed.abs() * 3.6 * 256.0;
        let pedal = |share: f64| Signal::Known(Pedal250::new(to_u8(share * 250.0)));
        let contact = |closed: bool| Signal::Known(if closed { Contact::Closed } else { Contact::Open });
        let decel = |value: f64| Signal::Known(DecelMs2Q11::new(to_u16(value * 2048.0)));
        let seat = |taken: bool| Signal::Known(if taken { Seat::Occupied } else { Seat::Vacant });
        let driver = &self.driver;
        let powered = self.k1.position() && self.k4.position();
        let inputs = Inputs {
            seat: driver.seat(self.now_ms).map(seat),
            wheel_speed: Signal::Known(SpeedKmhQ8::new(to_u16(speed))),
            motor_speed: Signal::Known(SpeedKmhQ8::new(to_u16(speed * MOTOR_SPEED))),
            accelerator: [pedal(driver.accelerator); 2],
            brake_pedal: [pedal(driver.brake); 2],
            brake_switch: Signal::Known(driver.brake > SWITCH),
            steering_angle: Signal::Known(AngleDeciDeg::new(to_i16(self.angle * 10.0))),
            driver_torque: Signal::Known(TorqueNmQ10::ZERO),
            selector: Signal::Known(driver.selector),
            gear: Signal::Known(self.gear.position()),
            epb: if self.epb.moving() {
                Signal::Unknown(Cause::NotAvailable)
            } else {
                Signal::Known(self.epb.position())
            },
            epb_switch: Signal::Known(driver.epb_switch),
            epb_mode: Signal::Known(EpbMode::Automatic),
            key: Signal::Known(driver.key),
            cruise_switch: Signal::Known(driver.cruise),
            driver_set: Signal::Known(driver.set),
            k1: contact(self.k1.position()),
            k4: contact(self.k4.position()),
            hv_current: Signal::Known(CurrentDeciA::new(to_i16(self.current.value() * 10.0))),
            drive_stopped: Signal::Known(self.unpowered_ms >= self.parameters.drive_stop_ms),
            auxiliaries_stopped: Signal::Known(self.unpowered_ms >= self.parameters.auxiliaries_stop_ms),
            drive_limit: Signal::Known(if powered { self.torque_left() } else { Percent::ZERO }),
            executed_torque: Signal::Known(Percent::new(to_u8(self.drive.value() * 100.0))),
            electric_limit: decel(self.electric_limit()),
            friction_limit: decel(self.parameters.friction_decel),
            electric_actual: decel(self.electric.value()),
            mass: Signal::Known(Mass10Kg::new(to_u16(self.parameters.mass_kg / 10.0))),
            // Pressure that goes with the friction force: 800 kPa with all of it.
            axle_pressure: [Signal::Known(Pressure5KPa::new(to_u8(
                self.friction.value() / self.parameters.friction_decel * 160.0,
            ))); 2],
            deceleration: decel(self.measured_deceleration.value().max(0.0)),
            abs: Signal::Known(self.slips_ms > 0),
            asr: Signal::Known(false),
            stability: Signal::Known(false),
            ebs_red: Signal::Known(false),
            ebs_amber: Signal::Known(false),
            xbr_status: Signal::Known(XbrStatus::Allowed),
            eps: Signal::Known(if self.steers { EpsState::Active } else { EpsState::Ready }),
            hands_off: Signal::Known(!driver.seat(self.now_ms)[0]),
            ads: Signal::Known(if self.automated { AdsState::Active } else { AdsState::Ready }),
            foreign: Channels::NONE,
            second_sender: false,
        };
        (inputs, self.eyes.scene(self.now_ms))
    }
    /// What the drive says of the torque that its power leaves.
    fn torque_left(&self) -> Percent {
        if self.parameters.power_told {
            Percent::new(to_u8((self.ceiling().min(1.0) * 100.0).floor()))
        } else {
            Percent::FULL
        }
    }
}
