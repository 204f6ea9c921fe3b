//! The drives that ship in `tests/drives`: S1's approach and S3's empty seat, each with both main controllers, and a
//! bus whose actuators fail.

use supervisor::{Channel, EpbSwitch, Gear, Key, Reason};

use crate::drive::Scenario;
use crate::driver::{Act, Script, after_start};
use crate::misdeed::{Deed, Misdeed};
use crate::plant::Parameters;
use crate::road::Obstacle;

/// S1 §3.2: where the driver meets the standing car. Key on, high voltage up, off to 40 km/h, cruise control; the
/// driver looks away, presses the accelerator in the first fright, then brakes.
const APPROACH: Script<'static> = after_start![
    (10_500, Act::Hold(40.0)),
    (46_000, Act::CruiseSwitch(true)),
    (47_000, Act::Set(true)),
    (47_400, Act::Set(false)),
    (47_600, Act::Accelerator(0.0)),
    (64_500, Act::Accelerator(0.5)),
    (65_300, Act::Accelerator(0.0)),
    (68_500, Act::Brake(0.5)),
];

/// The same up to the car, and then the driver does nothing at all.
const HANDS_OFF: Script<'static> = {
    let (script, _) = APPROACH.split_at(APPROACH.len() - 3);
    script
};

/// S3: the driver gets up at 40 km/h, is away for more than ten minutes, comes back and drives on.
const SEAT: Script<'static> = after_start![
    (10_500, Act::Hold(40.0)),
    (32_200, Act::Accelerator(0.0)),
    (32_500, Act::Sit(false)),
    (658_000, Act::Sit(true)),
    (663_000, Act::Brake(0.4)),
    (664_000, Act::Selector(Gear::Neutral)),
    (665_000, Act::Key(Key::Off)),
    (667_000, Act::Key(Key::On)),
    (668_000, Act::Key(Key::Start)),
    (668_500, Act::Key(Key::On)),
    (670_000, Act::Selector(Gear::Drive)),
    (674_000, Act::Brake(0.0)),
    (675_000, Act::Accelerator(0.15)),
    (677_000, Act::Hold(25.0)),
    (687_000, Act::Accelerator(0.0)),
    (687_300, Act::Brake(0.3)),
    (693_000, Act::Selector(Gear::Neutral)),
    (694_000, Act::EpbSwitch(EpbSwitch::Apply)),
    (695_500, Act::EpbSwitch(EpbSwitch::Idle)),
    (696_500, Act::Brake(0.0)),
];

/// The driver lets the accelerator go at 30 km/h, brakes, drives on, and gets up at 60 km/h: more than the retarder makes up
/// for alone.
const FAULTY: Script<'static> = after_start![
    (10_500, Act::Hold(30.0)),
    (26_000, Act::Accelerator(0.0)),
    (30_000, Act::Hold(60.0)),
    (45_700, Act::Accelerator(0.0)),
    (46_000, Act::Sit(false)),
];

const ACTUATORS: &[Misdeed] = &[
    misdeed(
        25_500,
        29_500,
        Deed::DrivePushes,
        "the drive pushes with half its torque, the accelerator is released",
        &[(Channel::ServiceBrake, Reason::ExcessTorque)],
    ),
    misdeed(
        46_000,
        62_000,
        Deed::BrakesFade,
        "the service brake gives a tenth of what it is told, the seat is empty",
        &[(Channel::Retarder, Reason::BrakeResponse), (Channel::ParkingBrake, Reason::BrakeResponse)],
    ),
    misdeed(75_000, 75_100, Deed::K4DropsOut, "the parking brake lets go by itself, the seat is empty", &[]),
];

/// Every channel, refused for a frame that does not come or does not pass its check.
const LOST: &[(Channel, Reason)] = &[
    (Channel::DriveTorque, Reason::CommandLost),
    (Channel::ServiceBrake, Reason::CommandLost),
    (Channel::Gear, Reason::CommandLost),
    (Channel::ParkingBrake, Reason::CommandLost),
    (Channel::Contactors, Reason::CommandLost),
];
const REJECTED: &[(Channel, Reason)] = &[
    (Channel::DriveTorque, Reason::CommandRejected),
    (Channel::ServiceBrake, Reason::CommandRejected),
    (Channel::Gear, Reason::CommandRejected),
    (Channel::ParkingBrake, Reason::CommandRejected),
    (Channel::Contactors, Reason::CommandRejected),
];

const fn misdeed(
    from_ms: u32,
    until_ms: u32,
    deed: Deed,
    what: &'static str,
    expected: &'static [(Channel, Reason)],
) -> Misdeed {
    Misdeed { from_ms, until_ms, deed, what, expected }
}

const ON_THE_ROAD: &[Misdeed] = &[
    misdeed(
        25_000,
        26_000,
        Deed::FullTorque,
        "full torque, the accelerator is hardly pressed",
        &[(Channel::DriveTorque, Reason::PedalMap)],
    ),
    misdeed(28_000, 29_000, Deed::ShiftsToReverse, "shifts to R at 40 km/h", &[(Channel::Gear, Reason::Selector)]),
    misdeed(
        31_000,
        32_000,
        Deed::AppliesParkingBrake,
        "applies the parking brake at 40 km/h",
        &[(Channel::ParkingBrake, Reason::EpbSpeed)],
    ),
    misdeed(
        34_000,
        34_500,
        Deed::OpensK4,
        "opens K4 while the bus rolls",
        &[(Channel::Contactors, Reason::NotStandstill)],
    ),
    misdeed(
        36_000,
        37_000,
        Deed::SwitchesAuxiliariesOff,
        "switches the power steering off while the bus rolls",
        &[(Channel::Auxiliaries, Reason::NotStandstill)],
    ),
    misdeed(39_000, 39_500, Deed::BreaksChecksums, "every frame has a wrong checksum", REJECTED),
    misdeed(41_000, 41_500, Deed::RepeatsCounters, "every frame is sent again with its old counter", REJECTED),
    misdeed(43_000, 44_000, Deed::FallsSilent, "sends nothing", LOST),
    misdeed(
        52_000,
        52_100,
        Deed::SteersAway,
        "the automatic steering jumps to 300°",
        &[(Channel::Steering, Reason::SteeringAngle)],
    ),
    misdeed(
        55_000,
        55_300,
        Deed::PhantomBraking,
        "brakes with 6 m/s² on a clear road",
        &[(Channel::ServiceBrake, Reason::PhantomBraking)],
    ),
    misdeed(
        62_900,
        74_000,
        Deed::IgnoresTheRoad,
        "ignores the car ahead: torque goes on, no brake, no warning",
        &[
            (Channel::DriveTorque, Reason::Mitigation),
            (Channel::TargetSpeed, Reason::Mitigation),
            (Channel::ServiceBrake, Reason::Mitigation),
            (Channel::Warnings, Reason::WarningObliged),
            (Channel::Body, Reason::BrakeLamps),
        ],
    ),
];

const WITHOUT_DRIVER: &[Misdeed] = &[
    misdeed(
        32_800,
        44_000,
        Deed::IgnoresTheSeat,
        "ignores the empty seat: torque goes on, no brake, no warning",
        &[
            (Channel::DriveTorque, Reason::PedalMap),
            (Channel::DriveTorque, Reason::Leave),
            (Channel::ServiceBrake, Reason::Leave),
            (Channel::Warnings, Reason::WarningObliged),
            (Channel::Body, Reason::BrakeLamps),
            (Channel::ParkingBrake, Reason::EpbApply),
            (Channel::Gear, Reason::NeutralObliged),
        ],
    ),
    misdeed(
        37_000,
        37_500,
        Deed::OpensK4,
        "opens K4 while the bus rolls without a driver",
        &[(Channel::Contactors, Reason::NotStandstill)],
    ),
    misdeed(
        60_000,
        61_000,
        Deed::ReleasesParkingBrake,
        "releases the parking brake, the seat is empty",
        &[(Channel::ParkingBrake, Reason::SeatNotOccupied)],
    ),
    misdeed(
        90_000,
        91_000,
        Deed::ShiftsToDrive,
        "shifts to D, the seat is empty",
        &[(Channel::Gear, Reason::NeutralObliged)],
    ),
    misdeed(
        120_000,
        121_000,
        Deed::FullTorque,
        "full torque, the seat is empty",
        &[(Channel::DriveTorque, Reason::Leave)],
    ),
    misdeed(300_000, 301_000, Deed::OpensK1, "opens K1, K4 is closed", &[(Channel::Contactors, Reason::K4NotOpen)]),
    misdeed(
        420_000,
        421_000,
        Deed::FallsSilent,
        "sends nothing",
        &[
            (Channel::ServiceBrake, Reason::CommandLost),
            (Channel::ParkingBrake, Reason::CommandLost),
            (Channel::Contactors, Reason::CommandLost),
            (Channel::Gear, Reason::NeutralObliged),
            (Channel::Warnings, Reason::WarningObliged),
        ],
    ),
    misdeed(
        640_000,
        650_000,
        Deed::KeepsHighVoltage,
        "keeps high voltage up after ten minutes",
        &[(Channel::Contactors, Reason::Shutdown)],
    ),
    misdeed(
        652_000,
        653_000,
        Deed::ClosesHighVoltage,
        "closes K1 and K4, the seat is empty",
        &[(Channel::Contactors, Reason::NoRestart)],
    ),
    misdeed(
        660_000,
        661_000,
        Deed::ReleasesParkingBrake,
        "releases the parking brake as soon as somebody sits",
        &[(Channel::ParkingBrake, Reason::ParkedByLeave)],
    ),
    misdeed(
        662_000,
        663_000,
        Deed::ClosesHighVoltage,
        "closes K1 and K4 without the key",
        &[(Channel::Contactors, Reason::NoRestart)],
    ),
    misdeed(
        672_000,
        673_000,
        Deed::ReleasesParkingBrake,
        "releases the parking brake before the accelerator",
        &[(Channel::ParkingBrake, Reason::ParkedByLeave)],
    ),
];

/// Where the car stands, in m: S1's time 0, 60 m before it, is at about 62 s.
const CAR_M: f64 = 555.0;

const APPROACH_CORRECT: Scenario<'static> = Scenario {
    name: "approach-correct",
    title: "A standing car ahead",
    description: "S1 §3.2: a 12 m bus at 40 km/h under cruise control, a car stands still 60 m ahead (at 62 s). The \
        driver does not brake, and presses the accelerator in the first fright. The main controller does all that \
        S1 asks for: not one intervention.",
    length_ms: 76_000,
    parameters: Parameters::DEFAULT,
    script: APPROACH,
    road: &[Obstacle::standing_car(CAR_M)],
    misdeeds: &[],
};

const SEAT_CORRECT: Scenario<'static> = Scenario {
    name: "seat-correct",
    title: "The driver leaves the seat",
    description: "S3: the driver gets up at 40 km/h. Warning, torque 0, braking by table 1, parking brake, neutral; \
        after ten minutes K4 and then K1 open. The driver comes back, turns the key off and to start, selects D and \
        presses the accelerator anew: the bus drives on. The main controller does all that S3 asks for: not one \
        intervention.",
    length_ms: 699_000,
    parameters: Parameters::DEFAULT,
    script: SEAT,
    road: &[],
    misdeeds: &[],
};

/// S1 §3.2 with another bus, and a driver who does nothing.
#[must_use]
pub const fn s1_approach(parameters: Parameters) -> Scenario<'static> {
    Scenario { parameters, script: HANDS_OFF, ..APPROACH_CORRECT }
}

/// Every drive that ships.
pub const ALL: &[Scenario<'static>] = &[
    APPROACH_CORRECT,
    Scenario {
        name: "approach-misbehaving",
        title: "A standing car ahead, ignored",
        description: "The same road and driver. The main controller misbehaves on the way and at last ignores the \
            car, with torque on. Every misdeed is refused, and the bus stops before the car.",
        misdeeds: ON_THE_ROAD,
        ..APPROACH_CORRECT
    },
    SEAT_CORRECT,
    Scenario {
        name: "seat-misbehaving",
        title: "The driver leaves the seat, ignored",
        description: "The same driver. The main controller ignores the empty seat, and then tries what must never \
            happen: to release the parking brake, to shift, to drive, to open K1 before K4, to close high voltage. \
            Every misdeed is refused; the bus is stopped, parked and shut down as S3 asks for.",
        misdeeds: WITHOUT_DRIVER,
        ..SEAT_CORRECT
    },
    Scenario {
        name: "actuators-faulty",
        title: "Actuators that do not obey",
        description: "The main controller is correct, the vehicle fails. The drive goes on pushing: torque 0, then the \
            service brake against it. The driver gets up at 60 km/h and the service brake gives next to nothing: the \
            retarder helps, then the parking brake. At last K4 drops out by itself: nothing closes again. Each is a \
            trouble code.",
        length_ms: 90_000,
        script: FAULTY,
        road: &[],
        misdeeds: ACTUATORS,
        ..SEAT_CORRECT
    },
];

/// The drive of this name.
#[must_use]
pub fn named(name: &str) -> Option<&'static Scenario<'static>> {
    ALL.iter().find(|scenario| scenario.name == name)
}
