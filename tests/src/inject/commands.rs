//! What a failing main controller asks for.

use std::collections::VecDeque;

use supervisor::{
    AngleDeciDeg, Auxiliaries, BarTorque50mNm, Body, BrakeMode, ContactorRequest, Contactors, DecelMs2Q11, DriveTorque,
    DrivingMode, EpbMode, EpbRequest, GearRequest, Origin, Outputs, ParkingBrake, Percent, Priority, RateDeciDegS,
    Retarder, RetarderMode, ServiceBrake, SpeedKmhQ8, Steering, TorqueNmQ10, Warnings,
};

use super::kind::Wrong;
use crate::number::{to_i16, to_u8, to_u16};
use crate::plant::CYCLE_MS;

/// Longest queue of old commands, in cycles.
const LONGEST: usize = 200;

/// A failing main controller.
#[derive(Clone, Debug)]
pub struct Commands {
    kind: Wrong,
    /// How old late commands are, in cycles.
    delay: usize,
    old: VecDeque<Outputs>,
}

fn torque(share: f64, origin: Origin) -> DriveTorque {
    DriveTorque { torque: percent(share), active: origin != Origin::Driver, origin }
}

fn percent(share: f64) -> Percent {
    Percent::new(to_u8(share.clamp(0.0, 1.0) * 100.0))
}

fn brake(decel: f64) -> ServiceBrake {
    let total = DecelMs2Q11::new(to_u16(decel * 2048.0));
    ServiceBrake { total, electric: DecelMs2Q11::ZERO, mode: BrakeMode::Maximum, priority: Priority::High }
}

fn parking(request: EpbRequest) -> ParkingBrake {
    ParkingBrake { request, mode: EpbMode::Automatic }
}

fn steering(degrees: f64, rate: u16) -> Steering {
    Steering {
        enable: true,
        angle: AngleDeciDeg::new(to_i16(degrees * 10.0)),
        rate: RateDeciDegS::new(rate),
        overlay: TorqueNmQ10::ZERO,
        weight: Percent::FULL,
        bar_limit: BarTorque50mNm::new(100),
    }
}

/// Whether a signal that changes every `half` ms is in its first half.
const fn first_half(elapsed_ms: u32, half: u32) -> bool {
    (elapsed_ms / half).is_multiple_of(2)
}

impl Commands {
    /// `delay` is how old late commands are, in cycles.
    #[must_use]
    pub fn new(kind: Wrong, delay: usize) -> Self {
        Self { kind, delay: delay.min(LONGEST), old: VecDeque::new() }
    }

    /// Whether nothing is sent.
    #[must_use]
    pub const fn silent(&self) -> bool {
        matches!(self.kind, Wrong::Silent)
    }

    /// What it makes of right commands, so long after it began, in a fault that lasts so long.
    pub fn corrupt(&mut self, sent: &mut Outputs, elapsed_ms: u32, lasts_ms: u32) {
        self.old.push_back(*sent);
        let second = elapsed_ms > 500 || elapsed_ms > lasts_ms / 2;
        let later = if second { ContactorRequest::Close } else { ContactorRequest::Hold };
        let seconds = f64::from(elapsed_ms) / 1000.0;
        match self.kind {
            // What an actuator without time-out would go on with.
            Wrong::Stuck | Wrong::Silent => *sent = self.first(sent),
            Wrong::Late => *sent = self.late(sent),
            Wrong::FullTorque => sent.drive = torque(1.0, Origin::Driver),
            Wrong::AdasTorque => {
                (sent.drive, sent.mode) = (torque(1.0, Origin::Adas), DrivingMode::Automated);
            }
            Wrong::TorqueDrifts => {
                let now = f64::from(sent.drive.torque.raw()) / 100.0;
                sent.drive.torque = percent(now + 0.1 * seconds);
            }
            Wrong::TorqueOscillates => {
                sent.drive = torque(if first_half(elapsed_ms, 100) { 1.0 } else { 0.0 }, Origin::Driver);
            }
            Wrong::TorqueWrongUnit => sent.drive.torque = percent(f64::from(sent.drive.torque.raw()) * 0.04),
            Wrong::ChannelsSwapped => {
                let (was, brakes) = (f64::from(sent.drive.torque.raw()), f64::from(sent.brake.total.raw()) / 2048.0);
                sent.drive = torque(brakes / 6.0, Origin::Driver);
                sent.brake = brake(was * 0.06);
            }
            Wrong::TorqueWhileBraking => sent.drive = torque(0.5, Origin::Driver),
            Wrong::IgnoresSeat => {
                sent.drive = torque(0.6, Origin::Driver);
                (sent.brake, sent.epb, sent.gear) = (ServiceBrake::NEUTRAL, ParkingBrake::NEUTRAL, GearRequest::Hold);
                (sent.warnings, sent.body) = (Warnings::NEUTRAL, Body::NEUTRAL);
            }
            Wrong::IgnoresRoad => {
                (sent.drive, sent.brake) = (torque(0.6, Origin::Adas), ServiceBrake::NEUTRAL);
                (sent.warnings, sent.body) = (Warnings::NEUTRAL, Body::NEUTRAL);
            }
            Wrong::NoBrake => sent.brake = ServiceBrake::NEUTRAL,
            Wrong::WeakBrake => {
                sent.brake.total = DecelMs2Q11::new(sent.brake.total.raw() / 3);
                sent.brake.electric = DecelMs2Q11::new(sent.brake.electric.raw() / 3);
            }
            Wrong::PhantomBraking => sent.brake = brake(6.0),
            Wrong::BrakeOscillates => sent.brake = brake(if first_half(elapsed_ms, 400) { 6.0 } else { 0.0 }),
            Wrong::RetarderOnTop => {
                sent.brake = brake(3.5);
                sent.retarder =
                    Retarder { torque: Percent::FULL, mode: RetarderMode::Torque, priority: Priority::High };
            }
            Wrong::ReleasesEpb => sent.epb = parking(EpbRequest::Release),
            Wrong::AppliesEpb => sent.epb = parking(EpbRequest::Apply),
            Wrong::DrivesOff => {
                (sent.epb, sent.gear) = (parking(EpbRequest::Release), GearRequest::Drive);
                (sent.drive, sent.brake) = (torque(0.6, Origin::Driver), ServiceBrake::NEUTRAL);
            }
            Wrong::ShiftsToReverse => sent.gear = GearRequest::Reverse,
            Wrong::ShiftsToPark => sent.gear = GearRequest::Park,
            Wrong::WrongDirection => {
                if elapsed_ms < 1500 || sent.gear == GearRequest::Drive {
                    sent.gear = GearRequest::Reverse;
                }
            }
            Wrong::OpensK1 => sent.contactors.k1 = ContactorRequest::Open,
            Wrong::OpensK4 => sent.contactors.k4 = ContactorRequest::Open,
            Wrong::OpensBoth => {
                sent.contactors = Contactors { k4: ContactorRequest::Open, k1: ContactorRequest::Open };
            }
            Wrong::KeepsHighVoltage => sent.contactors = Contactors::NEUTRAL,
            Wrong::ClosesK4 => sent.contactors = Contactors { k4: ContactorRequest::Close, k1: later },
            Wrong::ClosesHighVoltage => sent.contactors = Contactors { k4: later, k1: ContactorRequest::Close },
            Wrong::SteeringStep => sent.steering = steering(300.0, 8000),
            Wrong::SteeringOscillates => {
                sent.steering = steering(if first_half(elapsed_ms, 300) { 200.0 } else { -200.0 }, 8000);
            }
            Wrong::SteeringCreeps => sent.steering = steering(15.0 * seconds, 150),
            Wrong::AuxiliariesOff => {
                sent.auxiliaries = Auxiliaries { air_pump: false, power_steering: false, dc_dc: false };
            }
            Wrong::LampsOff => (sent.warnings, sent.body) = (Warnings::NEUTRAL, Body::NEUTRAL),
            Wrong::WrongMode => sent.mode = DrivingMode::Automated,
            Wrong::TargetSpeedJumps => sent.target_speed = SpeedKmhQ8::new(200 * 256),
        }
    }

    /// What was right when it began.
    fn first(&mut self, sent: &Outputs) -> Outputs {
        self.old.truncate(1);
        self.old.front().copied().unwrap_or(*sent)
    }

    fn late(&mut self, sent: &Outputs) -> Outputs {
        let late = self.old.front().copied().unwrap_or(*sent);
        if self.old.len() > self.delay {
            self.old.pop_front();
        }
        late
    }
}

/// A delay between two times, in cycles.
#[must_use]
pub fn cycles(ms: u32) -> usize {
    usize::try_from(ms / CYCLE_MS).unwrap_or(0)
}
