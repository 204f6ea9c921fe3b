//! Twelve minutes that touch every machine: driving, levels, automated mode, steering, faults, leave, shutdown, return.

use super::common::*;

/// Length of the script in ms.
pub const LENGTH: u32 = 720_000;
/// The script without the ten minutes: up to the parked bus in leave.
pub const ROAD: u32 = 80_000;

/// What happens at which millisecond of the script, in order.
pub const SCRIPT: &[(u32, Edit)] = &[
    (0, start),
    (3_000, into_drive),
    (3_500, press_and_release_brake),
    (4_000, roll_off),
    (5_000, |bus| drive(bus, 10, 30, 25)),
    (10_000, |bus| drive(bus, 30, 50, 45)),
    (15_000, |bus| drive(bus, 50, 0, 0)),
    (15_500, cruise),
    (16_000, |bus| bus.inputs.driver_set = known(true)),
    (16_500, |bus| bus.inputs.driver_set = known(false)),
    (17_000, |bus| bus.ask_adas(20)),
    (20_000, |bus| bus.accelerator(travel(90))),
    (22_000, |bus| bus.accelerator(travel(0))),
    (24_000, |bus| bus.commands.steering = Command::Fresh(STEER)),
    (27_000, |bus| bus.commands.steering = Command::Fresh(Steering { angle: angle(70), ..STEER })),
    (29_000, |bus| bus.inputs.driver_torque = known(hand_torque(7_000))),
    (30_000, hands_away),
    (33_000, |bus| bus.brake_pedal(travel(20))),
    (34_000, |bus| bus.brake_pedal(travel(0))),
    (36_000, |bus| bus.ahead(at(4_399))),
    (37_000, |bus| bus.ahead(at(3_600))),
    (38_000, |bus| bus.ahead(at(2_700))),
    (39_000, stand_still),
    (42_000, |bus| drive(bus, 20, 30, 25)),
    (46_000, Bus::speed_unknown),
    (50_000, |bus| bus.speed(kmh(20))),
    (52_000, |bus| bus.seat(known(Seat::Vacant), known(Seat::Occupied))),
    (53_000, Bus::occupied),
    (55_000, brake),
    (55_500, |bus| bus.commands.brake = Command::Absent),
    (58_000, |bus| bus.commands = Outputs::NEUTRAL.as_commands()),
    (60_000, Bus::perception_unknown),
    (61_000, Bus::road_clear),
    (66_000, vacate),
    (72_000, |bus| bus.speed(kmh(0))),
    (73_000, parked),
    (677_000, k4_opened),
    (679_000, Bus::loads_stopped),
    (681_000, |bus| bus.inputs.k1 = OPEN),
    (685_000, Bus::occupied),
    (690_000, |bus| bus.inputs.key = known(Key::Off)),
    (692_000, |bus| bus.inputs.key = known(Key::Start)),
    (693_000, |bus| bus.inputs.key = known(Key::On)),
    (694_000, |bus| bus.ask_contactors(ContactorRequest::Close, ContactorRequest::Close)),
    (695_000, |bus| bus.inputs.k1 = CLOSED),
    (696_000, |bus| bus.inputs.k4 = CLOSED),
    (698_000, into_drive),
    (699_000, press_and_release_brake),
    (701_000, roll_off),
    (704_000, |bus| drive(bus, 5, 20, 15)),
    (708_000, stand_still),
    (710_000, pull_brake),
];

fn start(bus: &mut Bus) {
    bus.inputs = healthy();
    bus.scene = Scene::clear();
    bus.commands = Outputs::NEUTRAL.as_commands();
}

fn into_drive(bus: &mut Bus) {
    bus.inputs.selector = known(Gear::Drive);
    bus.inputs.gear = known(Gear::Drive);
    bus.ask_gear(GearRequest::Drive);
    bus.ask_contactors(ContactorRequest::Hold, ContactorRequest::Hold);
}

fn press_and_release_brake(bus: &mut Bus) {
    bus.accelerator(travel(20));
    bus.ask_epb(EpbRequest::Release);
}

fn roll_off(bus: &mut Bus) {
    bus.inputs.epb = known(EpbState::Released);
    bus.ask_epb(EpbRequest::None);
}

fn drive(bus: &mut Bus, speed: u16, pedal: u8, torque: u8) {
    bus.road_clear();
    bus.speed(kmh(speed));
    bus.accelerator(travel(pedal));
    bus.ask_torque(torque);
}

fn cruise(bus: &mut Bus) {
    bus.inputs.cruise_switch = known(true);
    bus.inputs.ads = known(AdsState::Ready);
    bus.commands.mode = Command::Fresh(DrivingMode::Automated);
}

fn hands_away(bus: &mut Bus) {
    bus.inputs.driver_torque = known(hand_torque(0));
    bus.commands.steering = Command::Absent;
    bus.commands.mode = Command::Fresh(DrivingMode::Manual);
}

fn stand_still(bus: &mut Bus) {
    bus.road_clear();
    bus.speed(kmh(0));
    bus.accelerator(travel(0));
    bus.ask_torque(0);
}

fn brake(bus: &mut Bus) {
    bus.accelerator(travel(0));
    bus.ask_torque(0);
    bus.ask_brake(ms2(200));
}

fn vacate(bus: &mut Bus) {
    bus.speed(kmh(40));
    bus.vacant();
}

fn parked(bus: &mut Bus) {
    bus.inputs.epb = known(EpbState::Applied);
    bus.inputs.gear = known(Gear::Neutral);
    bus.inputs.executed_torque = known(percent(0));
}

fn k4_opened(bus: &mut Bus) {
    bus.loads_run();
    bus.inputs.k4 = OPEN;
}

fn pull_brake(bus: &mut Bus) {
    bus.ask_epb(EpbRequest::Apply);
    bus.inputs.epb = known(EpbState::Applied);
    bus.inputs.selector = known(Gear::Neutral);
    bus.inputs.gear = known(Gear::Neutral);
    bus.ask_gear(GearRequest::Neutral);
}
