//! What a misbehaving main controller, or a failing vehicle, does, when, and what must come of it.

use std::collections::BTreeMap;

use supervisor::wire::Frame;
use supervisor::{
    AngleDeciDeg, Auxiliaries, BarTorque50mNm, Body, BrakeMode, Channel, ContactorRequest, DecelMs2Q11, DriveTorque,
    DrivingMode, EpbMode, EpbRequest, GearRequest, Origin, Outputs, ParkingBrake, Percent, Priority, RateDeciDegS,
    Reason, ServiceBrake, SpeedKmhQ8, Steering, TorqueNmQ10, Warnings,
};

use crate::bench::{Hooks, Node};
use crate::plant::Plant;

/// One way to misbehave.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Deed {
    /// Full torque in the driver's name.
    FullTorque,
    /// Ignores the road: no braking, no warning, full ADAS torque.
    IgnoresTheRoad,
    /// Brakes with 6 m/s² on a clear road.
    PhantomBraking,
    /// Ignores the empty seat: torque goes on, no braking, no warning, no lamp.
    IgnoresTheSeat,
    /// Releases the parking brake.
    ReleasesParkingBrake,
    /// Applies the parking brake.
    AppliesParkingBrake,
    /// Shifts to D.
    ShiftsToDrive,
    /// Shifts to R.
    ShiftsToReverse,
    /// Opens K1.
    OpensK1,
    /// Opens K4.
    OpensK4,
    /// Keeps K4 and K1 as they are, whatever S3 asks for.
    KeepsHighVoltage,
    /// Closes K1 and K4.
    ClosesHighVoltage,
    /// Jumps to a steering angle of 300°.
    SteersAway,
    /// Switches air pump, power steering and DC/DC off.
    SwitchesAuxiliariesOff,
    /// Sends frames whose CRC is wrong.
    BreaksChecksums,
    /// Sends the same frames again, counters and all.
    RepeatsCounters,
    /// Sends nothing.
    FallsSilent,
    /// The drive pushes with half its torque, whatever it is told.
    DrivePushes,
    /// The service brake gives next to nothing, whatever it is told.
    BrakesFade,
    /// K4 drops out by itself.
    K4DropsOut,
}

/// A deed, its time, and the verdicts it must meet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Misdeed {
    /// From this time of the drive, in ms ...
    pub from_ms: u32,
    /// ... up to this time.
    pub until_ms: u32,
    /// What it does.
    pub deed: Deed,
    /// The same in words, for people.
    pub what: &'static str,
    /// In this time each of these channels is refused for this reason.
    pub expected: &'static [(Channel, Reason)],
}

impl Misdeed {
    /// Whether it is done now.
    #[must_use]
    pub const fn active(&self, now_ms: u32) -> bool {
        now_ms >= self.from_ms && now_ms < self.until_ms
    }
}

const fn torque(percent: u8, origin: Origin) -> DriveTorque {
    DriveTorque { torque: Percent::new(percent), active: !matches!(origin, Origin::Driver), origin }
}

const fn parking(request: EpbRequest) -> ParkingBrake {
    ParkingBrake { request, mode: EpbMode::Automatic }
}

impl Deed {
    /// Whether it tampers with frames instead of values.
    #[must_use]
    pub const fn tampers(self) -> bool {
        matches!(self, Self::BreaksChecksums | Self::RepeatsCounters | Self::FallsSilent)
    }

    /// Whether it is the vehicle that fails, not the main controller that misbehaves.
    #[must_use]
    pub const fn of_the_vehicle(self) -> bool {
        matches!(self, Self::DrivePushes | Self::BrakesFade | Self::K4DropsOut)
    }

    /// What it makes of the commands; nothing where it tampers with frames.
    pub const fn corrupt(self, wanted: &mut Outputs) {
        match self {
            Self::FullTorque => wanted.drive = torque(100, Origin::Driver),
            Self::IgnoresTheRoad => {
                wanted.drive = torque(100, Origin::Adas);
                wanted.target_speed = SpeedKmhQ8::new(40 * 256);
                wanted.mode = DrivingMode::Automated;
                wanted.brake = ServiceBrake::NEUTRAL;
                wanted.warnings = Warnings::NEUTRAL;
                wanted.body = Body::NEUTRAL;
            }
            Self::PhantomBraking => {
                wanted.brake = ServiceBrake {
                    total: DecelMs2Q11::new(6 * 2048),
                    electric: DecelMs2Q11::ZERO,
                    mode: BrakeMode::Maximum,
                    priority: Priority::High,
                };
            }
            Self::IgnoresTheSeat => {
                wanted.drive = torque(60, Origin::Driver);
                wanted.brake = ServiceBrake::NEUTRAL;
                wanted.epb = ParkingBrake::NEUTRAL;
                wanted.gear = GearRequest::Hold;
                wanted.warnings = Warnings::NEUTRAL;
                wanted.body = Body::NEUTRAL;
            }
            Self::ReleasesParkingBrake => wanted.epb = parking(EpbRequest::Release),
            Self::AppliesParkingBrake => wanted.epb = parking(EpbRequest::Apply),
            Self::ShiftsToDrive => wanted.gear = GearRequest::Drive,
            Self::ShiftsToReverse => wanted.gear = GearRequest::Reverse,
            Self::OpensK1 => wanted.contactors.k1 = ContactorRequest::Open,
            Self::OpensK4 => wanted.contactors.k4 = ContactorRequest::Open,
            Self::KeepsHighVoltage => {
                (wanted.contactors.k1, wanted.contactors.k4) = (ContactorRequest::Hold, ContactorRequest::Hold);
            }
            Self::ClosesHighVoltage => {
                (wanted.contactors.k1, wanted.contactors.k4) = (ContactorRequest::Close, ContactorRequest::Close);
            }
            Self::SteersAway => {
                wanted.steering = Steering {
                    enable: true,
                    angle: AngleDeciDeg::new(3000),
                    rate: RateDeciDegS::new(8000),
                    overlay: TorqueNmQ10::ZERO,
                    weight: Percent::FULL,
                    bar_limit: BarTorque50mNm::new(100),
                };
            }
            Self::SwitchesAuxiliariesOff => {
                wanted.auxiliaries = Auxiliaries { air_pump: false, power_steering: false, dc_dc: false };
            }
            // What tampers with frames, or the vehicle does by itself, changes no value.
            Self::BreaksChecksums
            | Self::RepeatsCounters
            | Self::FallsSilent
            | Self::DrivePushes
            | Self::BrakesFade
            | Self::K4DropsOut => {}
        }
    }
}

/// The misdeeds of a drive, in the loop.
#[derive(Clone, Debug)]
pub struct Misdeeds<'a> {
    all: &'a [Misdeed],
    /// The last frame of each identifier.
    last: BTreeMap<u32, Frame>,
}

impl<'a> Misdeeds<'a> {
    /// Each at its time.
    #[must_use]
    pub const fn new(all: &'a [Misdeed]) -> Self {
        Self { all, last: BTreeMap::new() }
    }

    fn active(&self, now_ms: u32) -> impl Iterator<Item = Deed> + 'a {
        self.all.iter().filter(move |misdeed| misdeed.active(now_ms)).map(|misdeed| misdeed.deed)
    }

    /// The first one that tampers with frames.
    fn tampering(&self, now_ms: u32) -> Option<Deed> {
        self.active(now_ms).find(|deed| deed.tampers())
    }
}

impl Hooks for Misdeeds<'_> {
    fn vehicle(&mut self, now_ms: u32, plant: &mut Plant) {
        self.active(now_ms).for_each(|deed| plant.suffer(deed));
    }

    fn commands(&mut self, now_ms: u32, sent: &mut Outputs) {
        self.active(now_ms).for_each(|deed| deed.corrupt(sent));
    }

    fn silent(&mut self, now_ms: u32) -> bool {
        self.tampering(now_ms) == Some(Deed::FallsSilent)
    }

    fn frames(&mut self, now_ms: u32, node: Node, frames: &mut Vec<Frame>) {
        if node == Node::Sensors {
            return;
        }
        let tampering = self.tampering(now_ms);
        for frame in frames {
            match tampering {
                Some(Deed::BreaksChecksums) => broken(frame),
                Some(Deed::RepeatsCounters) => *frame = self.last.get(&frame.id).copied().unwrap_or(*frame),
                Some(_) | None => {}
            }
            self.last.insert(frame.id, *frame);
        }
    }
}

/// One flipped bit in the payload: no checksum of the link survives it.
fn broken(frame: &mut Frame) {
    if let Some(byte) = frame.data.get_mut(3) {
        *byte ^= 0x10;
    }
}
