//! The values of every channel: what goes out, and what a command asks for.

use supervisor::word::Word;
use supervisor::{
    AngleDeciDeg, Auxiliaries, BarTorque50mNm, Body, Contactors, DecelMs2Q11, DriveTorque, DrivingMode, GearRequest,
    Outputs, ParkingBrake, Percent, RateDeciDegS, Retarder, ServiceBrake, SpeedKmhQ8, Steering, TorqueNmQ10, Warnings,
};

/// One value for every field of every channel. What is on or off is 1 or 0; what has codes says of which table.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SupervisorOutputs {
    /// Target speed, 1/256 km/h.
    pub target_speed: u16,
    /// Service brake: total deceleration, 1/2048 m/s².
    pub brake_total: u16,
    /// Service brake: the electric part of it, 1/2048 m/s².
    pub brake_electric: u16,
    /// Steering: target angle, 0.1°, left positive.
    pub steering_angle: i16,
    /// Steering: greatest rate, 0.1°/s.
    pub steering_rate: u16,
    /// Steering: overlay torque, 1/1024 Nm.
    pub steering_overlay: i16,
    /// Drive torque in the direction of the gear, %.
    pub drive_torque: u8,
    /// Drive torque: the sender's active flag.
    pub drive_active: u8,
    /// Drive torque: a `SupervisorOrigin`.
    pub drive_origin: u8,
    /// Service brake: a `SupervisorBrakeMode`.
    pub brake_mode: u8,
    /// Service brake: a `SupervisorPriority`.
    pub brake_priority: u8,
    /// Retarder: braking torque, %.
    pub retarder_torque: u8,
    /// Retarder: a `SupervisorRetarderMode`.
    pub retarder_mode: u8,
    /// Retarder: a `SupervisorPriority`.
    pub retarder_priority: u8,
    /// A `SupervisorGearRequest`.
    pub gear: u8,
    /// Parking brake: a `SupervisorEpbRequest`.
    pub epb_request: u8,
    /// Parking brake: a `SupervisorEpbMode`.
    pub epb_mode: u8,
    /// Steering: automatic steering enabled.
    pub steering_enable: u8,
    /// Steering: weight of the angle controller's torque, %.
    pub steering_weight: u8,
    /// Steering: limit of the overlaid bar torque, 0.05 Nm.
    pub steering_bar_limit: u8,
    /// Contactor K4 (drive and auxiliary front end): a `SupervisorContactorRequest`.
    pub k4: u8,
    /// Contactor K1 (battery main circuit): a `SupervisorContactorRequest`.
    pub k1: u8,
    /// Air pump.
    pub air_pump: u8,
    /// Power steering.
    pub power_steering: u8,
    /// DC/DC converter.
    pub dc_dc: u8,
    /// Forward-collision warning.
    pub forward_collision: u8,
    /// Pedestrian-collision warning.
    pub pedestrian: u8,
    /// Seat-leave warning.
    pub seat_leave: u8,
    /// Hazard flashers.
    pub hazard_flashers: u8,
    /// Fault lamp.
    pub fault_lamp: u8,
    /// Notice lamp.
    pub notice_lamp: u8,
    /// Lane-departure warning.
    pub lane_departure: u8,
    /// Speed-limit warning.
    pub speed_limit: u8,
    /// Headway warning.
    pub headway: u8,
    /// A `SupervisorWiper`.
    pub wipers: u8,
    /// Brake lamps.
    pub brake_lamps: u8,
    /// Left indicator.
    pub indicator_left: u8,
    /// Right indicator.
    pub indicator_right: u8,
    /// Low beam.
    pub low_beam: u8,
    /// High beam.
    pub high_beam: u8,
    /// Horn.
    pub horn: u8,
    /// A `SupervisorDrivingMode`.
    pub mode: u8,
}

/// A code, or a 0 or 1, as a value; `None` for every other number (CMD-1c).
fn value<T: Word>(code: u8) -> Option<T> {
    T::from_word(u32::from(code))
}

impl SupervisorOutputs {
    /// What goes out.
    pub(crate) fn of(outputs: &Outputs) -> Self {
        let Outputs {
            drive,
            target_speed,
            brake,
            retarder,
            gear,
            epb,
            steering,
            contactors,
            auxiliaries,
            warnings,
            body,
            mode,
        } = outputs;
        Self {
            target_speed: target_speed.raw(),
            brake_total: brake.total.raw(),
            brake_electric: brake.electric.raw(),
            steering_angle: steering.angle.raw(),
            steering_rate: steering.rate.raw(),
            steering_overlay: steering.overlay.raw(),
            drive_torque: drive.torque.raw(),
            drive_active: u8::from(drive.active),
            drive_origin: drive.origin.code(),
            brake_mode: brake.mode.code(),
            brake_priority: brake.priority.code(),
            retarder_torque: retarder.torque.raw(),
            retarder_mode: retarder.mode.code(),
            retarder_priority: retarder.priority.code(),
            gear: gear.code(),
            epb_request: epb.request.code(),
            epb_mode: epb.mode.code(),
            steering_enable: u8::from(steering.enable),
            steering_weight: steering.weight.raw(),
            steering_bar_limit: steering.bar_limit.raw(),
            k4: contactors.k4.code(),
            k1: contactors.k1.code(),
            air_pump: u8::from(auxiliaries.air_pump),
            power_steering: u8::from(auxiliaries.power_steering),
            dc_dc: u8::from(auxiliaries.dc_dc),
            forward_collision: u8::from(warnings.forward_collision),
            pedestrian: u8::from(warnings.pedestrian),
            seat_leave: u8::from(warnings.seat_leave),
            hazard_flashers: u8::from(warnings.hazard_flashers),
            fault_lamp: u8::from(warnings.fault_lamp),
            notice_lamp: u8::from(warnings.notice_lamp),
            lane_departure: u8::from(warnings.lane_departure),
            speed_limit: u8::from(warnings.speed_limit),
            headway: u8::from(warnings.headway),
            wipers: body.wipers.code(),
            brake_lamps: u8::from(body.brake_lamps),
            indicator_left: u8::from(body.indicator_left),
            indicator_right: u8::from(body.indicator_right),
            low_beam: u8::from(body.low_beam),
            high_beam: u8::from(body.high_beam),
            horn: u8::from(body.horn),
            mode: mode.code(),
        }
    }

    pub(crate) fn drive(&self) -> Option<DriveTorque> {
        Some(DriveTorque {
            torque: Percent::new(self.drive_torque),
            active: value(self.drive_active)?,
            origin: value(self.drive_origin)?,
        })
    }
    pub(crate) fn target_speed(&self) -> SpeedKmhQ8 {
        SpeedKmhQ8::new(self.target_speed)
    }
    pub(crate) fn brake(&self) -> Option<ServiceBrake> {
        Some(ServiceBrake {
            total: DecelMs2Q11::new(self.brake_total),
            electric: DecelMs2Q11::new(self.brake_electric),
            mode: value(self.brake_mode)?,
            priority: value(self.brake_priority)?,
        })
    }
    pub(crate) fn retarder(&self) -> Option<Retarder> {
        Some(Retarder {
            torque: Percent::new(self.retarder_torque),
            mode: value(self.retarder_mode)?,
            priority: value(self.retarder_priority)?,
        })
    }
    pub(crate) fn gear(&self) -> Option<GearRequest> {
        value(self.gear)
    }
    pub(crate) fn epb(&self) -> Option<ParkingBrake> {
        Some(ParkingBrake { request: value(self.epb_request)?, mode: value(self.epb_mode)? })
    }
    pub(crate) fn steering(&self) -> Option<Steering> {
        Some(Steering {
            enable: value(self.steering_enable)?,
            angle: AngleDeciDeg::new(self.steering_angle),
            rate: RateDeciDegS::new(self.steering_rate),
            overlay: TorqueNmQ10::new(self.steering_overlay),
            weight: Percent::new(self.steering_weight),
            bar_limit: BarTorque50mNm::new(self.steering_bar_limit),
        })
    }
    pub(crate) fn contactors(&self) -> Option<Contactors> {
        Some(Contactors { k4: value(self.k4)?, k1: value(self.k1)? })
    }
    pub(crate) fn auxiliaries(&self) -> Option<Auxiliaries> {
        Some(Auxiliaries {
            air_pump: value(self.air_pump)?,
            power_steering: value(self.power_steering)?,
            dc_dc: value(self.dc_dc)?,
        })
    }
    pub(crate) fn warnings(&self) -> Option<Warnings> {
        Some(Warnings {
            forward_collision: value(self.forward_collision)?,
            pedestrian: value(self.pedestrian)?,
            seat_leave: value(self.seat_leave)?,
            hazard_flashers: value(self.hazard_flashers)?,
            fault_lamp: value(self.fault_lamp)?,
            notice_lamp: value(self.notice_lamp)?,
            lane_departure: value(self.lane_departure)?,
            speed_limit: value(self.speed_limit)?,
            headway: value(self.headway)?,
        })
    }
    pub(crate) fn body(&self) -> Option<Body> {
        Some(Body {
            wipers: value(self.wipers)?,
            brake_lamps: value(self.brake_lamps)?,
            indicator_left: value(self.indicator_left)?,
            indicator_right: value(self.indicator_right)?,
            low_beam: value(self.low_beam)?,
            high_beam: value(self.high_beam)?,
            horn: value(self.horn)?,
        })
    }
    pub(crate) fn mode(&self) -> Option<DrivingMode> {
        value(self.mode)
    }
}
