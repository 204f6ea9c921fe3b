//! The boundary set: every channel asked for values at and beside its limits, every message damaged in every way, time
//! that runs as it should not; and cycles of no plan at all. Short, so that it can be kept and read.

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use supervisor::wire::{Frame, Sender};
use supervisor::{
    AdsState, AngleDeciDeg, BarTorque50mNm, BrakeMode, Channels, ClosingCmS, Contact, ContactorRequest, Count,
    CurrentDeciA, DecelMs2Q11, DistanceCm, DrivingMode, EpbMode, EpbRequest, EpbState, EpbSwitch, EpsState, Gear,
    GearRequest, Inputs, Key, Mass10Kg, Millis, OffsetCm, Origin, Outputs, Pedal250, Percent, Pressure5KPa, Priority,
    RadarObject, RateDeciDegS, Record, ResetCause, RetarderMode, Scene, Seat, Signal, SpeedKmhQ8, TorqueNmQ10, Wiper,
    XbrStatus,
};

use super::{Read, Vector};

/// Cycles until every sensor counts and the seat is confirmed: requalification 1 s, seat 1 s, and what the slowest needs.
const WARM_UP: u32 = 215;
/// Cycles after which an input that is sent every 100 ms has arrived.
const ARRIVES: u32 = 11;

/// Every set.
#[must_use]
pub fn all() -> Vec<Vector> {
    vec![driving(), slow(), leaving(), road(), frames(), clock(), random()]
}

fn kmh(value: u16) -> SpeedKmhQ8 {
    SpeedKmhQ8::new(value.saturating_mul(256))
}

/// A bus on the road with its driver, everything known, nothing wrong.
fn healthy(speed: SpeedKmhQ8) -> Inputs {
    let off = Signal::Known(false);
    Inputs {
        seat: [Signal::Known(Seat::Occupied); 2],
        wheel_speed: Signal::Known(speed),
        motor_speed: Signal::Known(speed),
        accelerator: [Signal::Known(Pedal250::ZERO); 2],
        brake_pedal: [Signal::Known(Pedal250::ZERO); 2],
        brake_switch: off,
        steering_angle: Signal::Known(AngleDeciDeg::ZERO),
        driver_torque: Signal::Known(TorqueNmQ10::ZERO),
        selector: Signal::Known(Gear::Drive),
        gear: Signal::Known(Gear::Drive),
        epb: Signal::Known(EpbState::Released),
        epb_switch: Signal::Known(EpbSwitch::Idle),
        epb_mode: Signal::Known(EpbMode::Automatic),
        key: Signal::Known(Key::On),
        cruise_switch: Signal::Known(true),
        driver_set: off,
        k1: Signal::Known(Contact::Closed),
        k4: Signal::Known(Contact::Closed),
        hv_current: Signal::Known(CurrentDeciA::new(200)),
        drive_stopped: off,
        auxiliaries_stopped: off,
        drive_limit: Signal::Known(Percent::FULL),
        executed_torque: Signal::Known(Percent::ZERO),
        electric_limit: Signal::Known(DecelMs2Q11::new(3072)),
        friction_limit: Signal::Known(DecelMs2Q11::new(14_336)),
        electric_actual: Signal::Known(DecelMs2Q11::ZERO),
        mass: Signal::Known(Mass10Kg::new(1400)),
        axle_pressure: [Signal::Known(Pressure5KPa::ZERO); 2],
        deceleration: Signal::Known(DecelMs2Q11::ZERO),
        abs: off,
        asr: off,
        stability: off,
        ebs_red: off,
        ebs_amber: off,
        xbr_status: Signal::Known(XbrStatus::Allowed),
        eps: Signal::Known(EpsState::Ready),
        hands_off: off,
        ads: Signal::Known(AdsState::Ready),
        foreign: Channels::NONE,
        second_sender: false,
    }
}

/// What happens to the frames of the main controller.
type Mangle = fn(&mut Vec<Frame>);

/// A bus, what it says, and what the main controller asks for.
struct Bus {
    vector: Vector,
    sensors: Sender,
    controller: Sender,
    now: u32,
    inputs: Inputs,
    scene: Scene,
    asked: Outputs,
}

impl Bus {
    /// Started at this time, with this persisted record.
    fn start(name: &str, now: u32, cause: ResetCause, record: Option<Record>, speed: SpeedKmhQ8) -> Self {
        let vector = Vector { name: format!("boundary-{name}"), cause, record, cycles: Vec::new() };
        let (sensors, controller) = (Sender::new(), Sender::new());
        let (inputs, scene) = (healthy(speed), Scene::clear());
        Self { vector, sensors, controller, now, inputs, scene, asked: Outputs::NEUTRAL }
    }

    /// Started by a clean key-on, and everything known.
    fn warm(name: &str, speed: SpeedKmhQ8) -> Self {
        let mut bus = Self::start(name, 0, ResetCause::PowerOn, Some(Record::None), speed);
        bus.run(WARM_UP);
        bus
    }

    /// One cycle after `elapsed` ms, its frames as `mangle` leaves them.
    fn cycle(&mut self, elapsed: u32, mangle: Mangle) {
        self.now = self.now.wrapping_add(elapsed);
        let at = self.now.wrapping_sub(elapsed.min(4));
        let (mut frames, mut commands) = (Vec::new(), Vec::new());
        let time = Millis::new(at);
        self.sensors.encode_inputs(time, &self.inputs, &self.scene, &mut |frame| frames.push(frame));
        self.controller.encode_commands(time, &self.asked.as_commands(), &mut |frame| commands.push(frame));
        mangle(&mut commands);
        frames.append(&mut commands);
        let frames = frames.into_iter().map(|frame| (at, frame)).collect();
        self.vector.cycles.push(Read { now_ms: self.now, frames });
    }

    fn run(&mut self, cycles: u32) {
        for _ in 0..cycles {
            self.cycle(10, |_| ());
        }
    }

    /// Asks for each of these in turn, two cycles long.
    fn ask<T: Copy>(&mut self, values: &[T], put: impl Fn(&mut Outputs, T)) {
        let before = self.asked;
        for value in values {
            put(&mut self.asked, *value);
            self.run(2);
        }
        self.asked = before;
        self.run(2);
    }

    fn speed(&mut self, speed: SpeedKmhQ8) {
        (self.inputs.wheel_speed, self.inputs.motor_speed) = (Signal::Known(speed), Signal::Known(speed));
        self.run(ARRIVES);
    }

    fn pedal(&mut self, travel: u8) {
        self.inputs.accelerator = [Signal::Known(Pedal250::new(travel)); 2];
        self.run(6);
    }
}

/// Torque against the pedal map, by each origin, with and without the mode; target speed; steering; mode; body; then the brakes.
fn driving() -> Vector {
    let mut bus = Bus::warm("driving", kmh(50));
    let torques = [0, 1, 4, 5, 6, 20, 49, 50, 51, 99, 100, 101, 200, 250];
    for pedal in [0, 9, 10, 11, 125, 250, 251] {
        bus.pedal(pedal);
        bus.ask(&torques, |out, torque| out.drive.torque = Percent::new(torque));
    }
    bus.pedal(0);
    // The driver sets the cruise control: from now on the mode may be asked for.
    bus.inputs.driver_set = Signal::Known(true);
    bus.run(ARRIVES);
    bus.asked.mode = DrivingMode::Automated;
    bus.run(ARRIVES);
    bus.inputs.driver_set = Signal::Known(false);
    for origin in [Origin::Adas, Origin::Epbi, Origin::Driver] {
        for active in [true, false] {
            bus.asked.drive.origin = origin;
            bus.asked.drive.active = active;
            bus.ask(&[0, 5, 6, 59, 60, 61, 100], |out, torque| out.drive.torque = Percent::new(torque));
        }
    }
    bus.asked.drive = Outputs::NEUTRAL.drive;
    let speeds = [0, 1, 12_799, 12_800, 15_359, 15_360, 15_361, u16::MAX];
    bus.ask(&speeds, |out, speed| out.target_speed = SpeedKmhQ8::new(speed));
    for angle in [0_i16, 100, 300, 301, 900, -900, 3000, 7200, 7201, i16::MIN] {
        bus.asked.steering.enable = true;
        bus.asked.steering.weight = Percent::FULL;
        bus.ask(&[0, 100, 2000, u16::MAX], |out, rate| {
            out.steering.angle = AngleDeciDeg::new(angle);
            out.steering.rate = RateDeciDegS::new(rate);
        });
    }
    let torques = [0, 5119, 5120, 5121, -5120, -5121, i16::MAX];
    bus.ask(&torques, |out, torque| out.steering.overlay = TorqueNmQ10::new(torque));
    bus.ask(&[99, 100, 101, 255], |out, limit| out.steering.bar_limit = BarTorque50mNm::new(limit));
    for torque in [6143, 6144, 6145] {
        bus.inputs.driver_torque = Signal::Known(TorqueNmQ10::new(torque));
        bus.run(32);
    }
    bus.ask(Wiper::ALL, |out, wipers| out.body.wipers = wipers);
    bus.ask(&[true, false], |out, on| {
        (out.body.horn, out.body.indicator_left, out.warnings.hazard_flashers) = (on, on, on);
    });
    bus.ask(DrivingMode::ALL, |out, mode| out.mode = mode);
    bus.asked = Outputs::NEUTRAL;
    bus.run(ARRIVES);
    braking(&mut bus);
    bus.vector
}

/// Deceleration, its electric part, mode and priority, and the retarder beside it, at the caps of both.
fn braking(bus: &mut Bus) {
    let totals = [0, 1, 1433, 1434, 7167, 7168, 7169, 12_287, 12_288, 12_289, 25_000];
    for electric in [0, 1, 3071, 3072, 3073, 12_288] {
        bus.ask(&totals, |out, total| {
            out.brake.total = DecelMs2Q11::new(total);
            out.brake.electric = DecelMs2Q11::new(electric);
            (out.brake.mode, out.brake.priority) = (BrakeMode::Maximum, Priority::Medium);
        });
    }
    for mode in BrakeMode::ALL {
        bus.ask(Priority::ALL, |out, priority| {
            (out.brake.total, out.brake.mode, out.brake.priority) = (DecelMs2Q11::new(2048), *mode, priority);
        });
    }
    for total in [0, 4096, 7168] {
        bus.asked.brake.total = DecelMs2Q11::new(total);
        bus.asked.brake.mode = BrakeMode::Maximum;
        bus.ask(&[0, 1, 50, 99, 100, 101, 125], |out, torque| {
            (out.retarder.torque, out.retarder.mode) = (Percent::new(torque), RetarderMode::Torque);
        });
    }
    for abs in [true, false] {
        bus.inputs.abs = Signal::Known(abs);
        bus.run(ARRIVES);
        bus.ask(&[0, 60], |out, torque| {
            (out.retarder.torque, out.retarder.mode) = (Percent::new(torque), RetarderMode::Torque);
        });
    }
}

/// Gear, parking brake, contactors and auxiliaries at every speed at which something begins or ends.
fn slow() -> Vector {
    let mut bus = Bus::warm("slow", kmh(20));
    // 10, 2, 1.5 and 0.3 km/h, and one bit beside each.
    for speed in [2561, 2560, 2559, 513, 512, 511, 385, 384, 383, 78, 77, 76, 0] {
        bus.speed(SpeedKmhQ8::new(speed));
        bus.ask(EpbRequest::ALL, |out, request| out.epb.request = request);
        bus.ask(GearRequest::ALL, |out, gear| out.gear = gear);
        bus.ask(ContactorRequest::ALL, |out, request| out.contactors.k4 = request);
        bus.ask(ContactorRequest::ALL, |out, request| out.contactors.k1 = request);
        bus.ask(&[false, true], |out, on| {
            (out.auxiliaries.air_pump, out.auxiliaries.power_steering, out.auxiliaries.dc_dc) = (on, on, on);
        });
    }
    for gear in [Gear::Reverse, Gear::Neutral, Gear::Park] {
        bus.inputs.selector = Signal::Known(gear);
        bus.run(ARRIVES);
        bus.ask(GearRequest::ALL, |out, gear| out.gear = gear);
    }
    bus.vector
}

/// The seat: 2 s and a cycle beside it, leave, standstill, the way back; and a boot into leave.
fn leaving() -> Vector {
    let vacant = [Signal::Known(Seat::Vacant); 2];
    let mut bus = Bus::start("leaving", 0, ResetCause::Watchdog, Some(Record::Leave), kmh(30));
    bus.run(WARM_UP);
    bus.inputs.seat = vacant;
    bus.run(200);
    bus.inputs.seat = [Signal::Known(Seat::Occupied); 2];
    bus.run(20);
    bus.inputs.seat = vacant;
    bus.run(210);
    for speed in [16, 15, 10, 8, 4, 2] {
        bus.speed(kmh(speed));
    }
    bus.speed(SpeedKmhQ8::new(383));
    bus.speed(SpeedKmhQ8::ZERO);
    bus.inputs.epb = Signal::Known(EpbState::Applied);
    bus.run(ARRIVES);
    bus.ask(EpbRequest::ALL, |out, request| out.epb.request = request);
    bus.ask(GearRequest::ALL, |out, gear| out.gear = gear);
    bus.ask(ContactorRequest::ALL, |out, request| (out.contactors.k4, out.contactors.k1) = (request, request));
    bus.inputs.seat = [Signal::Known(Seat::Occupied); 2];
    bus.run(120);
    bus.inputs.gear = Signal::Known(Gear::Drive);
    for pedal in [0, 20, 0, 20] {
        bus.pedal(pedal);
        bus.ask(EpbRequest::ALL, |out, request| out.epb.request = request);
    }
    bus.vector
}

/// An object at the time to collision of each level and of each warning, and a bit beside it.
fn road() -> Vector {
    let mut bus = Bus::warm("road", kmh(40));
    for distance in [5000, 4401, 4400, 4399, 4001, 3999, 3601, 3600, 3599, 3200, 2701, 2700, 2699, 500] {
        let object = |offset: i16, closing: i16| RadarObject {
            distance: DistanceCm::new(distance),
            offset: OffsetCm::new(offset),
            closing: ClosingCmS::new(closing),
            age: Millis::ZERO,
            updates: Count::new(20),
        };
        bus.scene.radar.clear();
        for one in [object(0, 1000), object(181, 1000), object(900, 1200), object(0, -300)] {
            // Four fit.
            let _ = bus.scene.radar.push(one);
        }
        bus.run(6);
    }
    bus.scene.radar.clear();
    bus.run(60);
    for angle in [799, 800, 801, 900, 901] {
        bus.inputs.steering_angle = Signal::Known(AngleDeciDeg::new(angle));
        bus.run(ARRIVES);
    }
    bus.inputs.steering_angle = Signal::Known(AngleDeciDeg::ZERO);
    bus.speed(SpeedKmhQ8::ZERO);
    bus.run(120);
    bus.vector
}

/// Every way in which a frame can be wrong, for every message of the main controller; silence up to each time-out.
fn frames() -> Vector {
    let ways: [Mangle; 7] = [
        Vec::clear,
        |frames| frames.iter_mut().for_each(|frame| frame.data[0] ^= 1),
        |frames| frames.iter_mut().for_each(|frame| frame.data[7] ^= 0x10),
        |frames| frames.iter_mut().for_each(|frame| frame.length = 7),
        |frames| frames.iter_mut().for_each(|frame| frame.id ^= 1),
        |frames| frames.extend_from_within(..),
        |frames| frames.reverse(),
    ];
    let mut bus = Bus::warm("frames", kmh(50));
    bus.pedal(125);
    bus.asked.drive.torque = Percent::new(30);
    bus.asked.brake.mode = BrakeMode::Maximum;
    bus.run(5);
    for way in ways {
        for cycles in [1, 13] {
            (0..cycles).for_each(|_| bus.cycle(10, way));
            bus.run(14);
        }
    }
    (0..52).for_each(|_| bus.cycle(10, Vec::clear));
    bus.run(22);
    let heard = bus.sensors.clone();
    // The sensors are silent, too; then they are back, and have to requalify.
    for _ in 0..52 {
        bus.cycle(10, |_| ());
        if let Some(read) = bus.vector.cycles.last_mut() {
            read.frames.retain(|(_, frame)| frame.id & 0xFF == 0x2A);
        }
    }
    bus.sensors = heard;
    bus.run(110);
    bus.vector
}

/// Steps of the clock at and beside its bounds, three faults in a row, and the wrap in the middle of a drive.
fn clock() -> Vector {
    let mut bus = Bus::start("clock", u32::MAX - 2600, ResetCause::Other, None, kmh(50));
    bus.run(WARM_UP);
    for elapsed in [1, 50, 10, 51, 10, 0, 10, u32::MAX, 10, 1000] {
        bus.cycle(elapsed, |_| ());
        bus.run(8);
    }
    bus.run(40);
    for elapsed in [51, 51, 51] {
        bus.cycle(elapsed, |_| ());
    }
    bus.run(20);
    bus.vector
}

/// Cycles of no plan: a few inputs and commands of any value in each, from a seed.
fn random() -> Vector {
    let mut bus = Bus::warm("random", kmh(35));
    let mut dice = ChaCha8Rng::seed_from_u64(0xB0_0D);
    for _ in 0..80 {
        change(&mut bus, &mut dice);
        bus.run(dice.random_range(1..3));
    }
    bus.vector
}

fn change(bus: &mut Bus, dice: &mut ChaCha8Rng) {
    let Bus { inputs, asked, scene, .. } = bus;
    let (byte, word): (u8, u16) = (dice.random(), dice.random());
    let signed = word.cast_signed();
    let bit = byte & 1 == 1;
    match dice.random_range(0..26) {
        0 => inputs.seat[usize::from(bit)] = Signal::Known(if byte & 2 == 0 { Seat::Vacant } else { Seat::Occupied }),
        1 => inputs.wheel_speed = Signal::Known(SpeedKmhQ8::new(word % 20_000)),
        2 => inputs.motor_speed = inputs.wheel_speed,
        3 => inputs.accelerator = [Signal::Known(Pedal250::new(byte)); 2],
        4 => inputs.accelerator[0] = Signal::Known(Pedal250::new(byte)),
        5 => inputs.brake_pedal = [Signal::Known(Pedal250::new(byte)); 2],
        6 => inputs.brake_switch = Signal::Known(bit),
        7 => inputs.steering_angle = Signal::Known(AngleDeciDeg::new(signed)),
        8 => inputs.driver_torque = Signal::Known(TorqueNmQ10::new(signed)),
        9 => inputs.epb = Signal::Known(if bit { EpbState::Applied } else { EpbState::Released }),
        10 => inputs.gear = Signal::Known(if bit { Gear::Drive } else { Gear::Reverse }),
        11 => inputs.executed_torque = Signal::Known(Percent::new(byte)),
        12 => inputs.electric_limit = Signal::Known(DecelMs2Q11::new(word)),
        13 => inputs.abs = Signal::Known(bit),
        14 => inputs.ebs_red = Signal::Known(bit),
        15 => inputs.driver_set = Signal::Known(bit),
        16 => {
            let closing = ClosingCmS::new(signed / 16);
            let (distance, offset) = (DistanceCm::new(word % 8000), OffsetCm::new(signed / 128));
            let object = RadarObject { distance, offset, closing, age: Millis::ZERO, updates: Count::new(byte) };
            scene.radar.clear();
            // One fits.
            let _ = scene.radar.push(object);
        }
        17 => scene.radar.clear(),
        18 => asked.drive.torque = Percent::new(byte),
        19 => asked.brake.total = DecelMs2Q11::new(word),
        20 => asked.brake.mode = if bit { BrakeMode::Maximum } else { BrakeMode::Off },
        21 => asked.gear = if bit { GearRequest::Drive } else { GearRequest::Neutral },
        22 => asked.epb.request = if bit { EpbRequest::Release } else { EpbRequest::Apply },
        23 => asked.steering.angle = AngleDeciDeg::new(signed),
        24 => asked.contactors.k4 = if bit { ContactorRequest::Open } else { ContactorRequest::Close },
        _ => asked.mode = if bit { DrivingMode::Automated } else { DrivingMode::Manual },
    }
}
