//! Random events: which input, command or object changes, and to what.

use super::*;
use std::sync::OnceLock;

/// Where random events come from: one number (splitmix64), so that a number is an event; or the bytes of a fuzzer, each
/// choice the next of them, so that a byte is a choice.
pub enum Dice<'a> {
    Number(u64),
    Bytes(&'a [u8]),
}

impl Dice<'_> {
    /// The next `count` bytes as a number; zeros where the bytes are used up.
    fn take(&mut self, count: usize) -> u64 {
        match self {
            Self::Number(number) => {
                *number = number.wrapping_add(0x9E37_79B9_7F4A_7C15);
                let mut mixed = *number;
                mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
                mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
                mixed ^ (mixed >> 31)
            }
            Self::Bytes(bytes) => {
                let (taken, rest) = bytes.split_at(count.min(bytes.len()));
                *bytes = rest;
                taken.iter().rev().fold(0, |number, byte| number << 8 | u64::from(*byte))
            }
        }
    }
    /// No byte is left. A number never ends.
    pub fn is_used_up(&self) -> bool {
        matches!(self, Self::Bytes([]))
    }
    pub fn next(&mut self) -> u64 {
        self.take(8)
    }
    pub fn below(&mut self, count: usize) -> usize {
        usize::try_from(self.take(1 + count / 256) % u64::try_from(count).unwrap_or(1)).unwrap_or(0)
    }
    pub fn one_in(&mut self, count: usize) -> bool {
        self.below(count) == 0
    }
    pub fn flag(&mut self) -> bool {
        self.one_in(2)
    }
    pub fn of<T: Copy>(&mut self, all: &[T]) -> T {
        all[self.below(all.len())]
    }
    pub fn byte(&mut self) -> u8 {
        let [byte, ..] = self.take(1).to_le_bytes();
        byte
    }
    pub fn half(&mut self) -> u16 {
        let [low, high, ..] = self.take(2).to_le_bytes();
        u16::from_le_bytes([low, high])
    }
    pub fn signed(&mut self) -> i16 {
        self.half().cast_signed()
    }
    pub fn word(&mut self) -> u32 {
        let [a, b, c, d, ..] = self.take(4).to_le_bytes();
        u32::from_le_bytes([a, b, c, d])
    }
    /// A value that is mostly known.
    pub fn signal<T: Copy>(&mut self, value: T) -> Signal<T> {
        if self.one_in(6) { unknown(self.of(Cause::ALL)) } else { known(value) }
    }
    pub fn maybe<T: Copy>(&mut self, make: fn(&mut Self) -> T) -> Signal<T> {
        let value = make(self);
        self.signal(value)
    }
    pub fn signal_of<T: Copy>(&mut self, all: &[T]) -> Signal<T> {
        let value = self.of(all);
        self.signal(value)
    }
    /// Every bit pattern, near the thresholds more often.
    pub fn speed(&mut self) -> SpeedKmhQ8 {
        let near = [0, 1, 76, 77, 383, 384, 511, 512, 2_559, 2_560, 7_680, 12_800, 15_360, 15_361];
        kmh_q8(if self.one_in(4) { self.half() } else { self.of(&near) })
    }
    pub fn pedal(&mut self) -> Pedal250 {
        let near = [0, 10, 11, 20, 21, 100, 250];
        Pedal250::new(if self.one_in(4) { self.byte() } else { self.of(&near) })
    }
    pub fn decel(&mut self) -> DecelMs2Q11 {
        let near = [0, 1, 1_433, 2_048, 2_765, 5_120, 7_168, 7_169, 10_240, 12_288, 12_289];
        DecelMs2Q11::new(if self.one_in(3) { self.half() } else { self.of(&near) })
    }
    pub fn angle(&mut self) -> AngleDeciDeg {
        let near = [0, 599, 600, -700, 801, 901, -7_200, 7_201];
        angle(if self.one_in(3) { self.signed() } else { self.of(&near) })
    }
    pub fn percent(&mut self) -> Percent {
        percent(if self.one_in(4) { self.byte() } else { self.of(&[0, 1, 5, 6, 20, 60, 100]) })
    }
    pub fn command<T>(&mut self, value: T) -> Command<T> {
        match self.below(10) {
            0 => Command::Absent,
            1 => Command::Rejected(self.of(Rejection::ALL)),
            2 => Command::Held(Millis::new(self.word()), value),
            3 => Command::Held(Millis::new(self.word() % 600), value),
            _ => Command::Fresh(value),
        }
    }
}

/// Changes one input.
pub fn change_input(dice: &mut Dice<'_>, inputs: &mut Inputs) {
    if dice.flag() {
        change_driver(dice, inputs);
    } else {
        change_vehicle(dice, inputs);
    }
}

/// Seat, pedals, steering wheel, switches, key.
fn change_driver(dice: &mut Dice<'_>, inputs: &mut Inputs) {
    let any = &[false, true];
    match dice.below(18) {
        0 => inputs.seat = [dice.signal_of(Seat::ALL), dice.signal_of(Seat::ALL)],
        1 => inputs.seat = [known(Seat::Vacant); 2],
        2 => inputs.seat = [known(Seat::Occupied); 2],
        3 => inputs.accelerator = [dice.maybe(Dice::pedal), dice.maybe(Dice::pedal)],
        4 | 5 => inputs.accelerator = [known(dice.pedal()); 2],
        6 => inputs.brake_pedal = [dice.maybe(Dice::pedal), dice.maybe(Dice::pedal)],
        7 => inputs.brake_switch = dice.signal_of(any),
        8 | 9 => {
            inputs.brake_pedal = [known(Pedal250::ZERO); 2];
            inputs.brake_switch = known(false);
        }
        10 => inputs.steering_angle = dice.maybe(Dice::angle),
        11 => inputs.driver_torque = dice.maybe(|dice| hand_torque(dice.signed())),
        12 => inputs.selector = dice.signal_of(Gear::ALL),
        13 => inputs.epb_switch = dice.signal_of(EpbSwitch::ALL),
        14 => inputs.key = dice.signal_of(Key::ALL),
        15 => inputs.cruise_switch = dice.signal_of(&[false, true, true]),
        16 => inputs.driver_set = dice.signal_of(any),
        _ => inputs.hands_off = dice.signal_of(any),
    }
}

/// What the vehicle reports.
fn change_vehicle(dice: &mut Dice<'_>, inputs: &mut Inputs) {
    let any = &[false, true];
    match dice.below(18) {
        0 => inputs.wheel_speed = dice.maybe(Dice::speed),
        1 => inputs.motor_speed = dice.maybe(Dice::speed),
        2..=4 => {
            let speed = known(dice.speed());
            (inputs.wheel_speed, inputs.motor_speed) = (speed, speed);
        }
        5 => inputs.gear = dice.signal_of(Gear::ALL),
        6 => inputs.epb = dice.signal_of(EpbState::ALL),
        7 => inputs.epb_mode = dice.signal_of(EpbMode::ALL),
        8 => inputs.k1 = dice.signal_of(Contact::ALL),
        9 => inputs.k4 = dice.signal_of(Contact::ALL),
        10 => {
            inputs.drive_stopped = dice.signal_of(any);
            inputs.auxiliaries_stopped = dice.signal_of(any);
            inputs.hv_current = dice.maybe(|dice| CurrentDeciA::new(dice.signed()));
        }
        11 => {
            inputs.drive_stopped = known(true);
            inputs.auxiliaries_stopped = known(true);
            inputs.hv_current = known(CurrentDeciA::new(dice.signed() % 25));
        }
        12 => inputs.drive_limit = dice.maybe(Dice::percent),
        13 => inputs.executed_torque = dice.maybe(Dice::percent),
        14 => {
            inputs.electric_limit = dice.maybe(Dice::decel);
            inputs.friction_limit = dice.maybe(Dice::decel);
        }
        15 => inputs.deceleration = dice.maybe(Dice::decel),
        16 => {
            inputs.abs = dice.signal_of(any);
            inputs.asr = dice.signal_of(any);
            inputs.stability = dice.signal_of(any);
            inputs.ebs_red = dice.signal_of(any);
            inputs.ebs_amber = dice.signal_of(any);
            inputs.xbr_status = dice.signal_of(XbrStatus::ALL);
        }
        _ => {
            inputs.eps = dice.signal_of(EpsState::ALL);
            inputs.ads = dice.signal_of(AdsState::ALL);
        }
    }
}

/// Changes one command.
pub fn change_command(dice: &mut Dice<'_>, commands: &mut Commands) {
    match dice.below(12) {
        0 => {
            let value = DriveTorque { torque: dice.percent(), active: dice.flag(), origin: dice.of(Origin::ALL) };
            commands.drive = dice.command(value);
        }
        1 => {
            let speed = dice.speed();
            commands.target_speed = dice.command(speed);
        }
        2 => {
            let value = ServiceBrake {
                total: dice.decel(),
                electric: dice.decel(),
                mode: dice.of(BrakeMode::ALL),
                priority: dice.of(Priority::ALL),
            };
            commands.brake = dice.command(value);
        }
        3 => {
            let value =
                Retarder { torque: dice.percent(), mode: dice.of(RetarderMode::ALL), priority: dice.of(Priority::ALL) };
            commands.retarder = dice.command(value);
        }
        4 => {
            let gear = dice.of(GearRequest::ALL);
            commands.gear = dice.command(gear);
        }
        5 => {
            let value = ParkingBrake { request: dice.of(EpbRequest::ALL), mode: dice.of(EpbMode::ALL) };
            commands.epb = dice.command(value);
        }
        6 => {
            let value = Steering {
                enable: dice.flag(),
                angle: dice.angle(),
                rate: RateDeciDegS::new(dice.half()),
                overlay: hand_torque(dice.signed()),
                weight: dice.percent(),
                bar_limit: BarTorque50mNm::new(dice.byte()),
            };
            commands.steering = dice.command(value);
        }
        7 => {
            let value = Contactors { k4: dice.of(ContactorRequest::ALL), k1: dice.of(ContactorRequest::ALL) };
            commands.contactors = dice.command(value);
        }
        8 => {
            let value = Auxiliaries { air_pump: dice.flag(), power_steering: dice.flag(), dc_dc: dice.flag() };
            commands.auxiliaries = dice.command(value);
        }
        9 => {
            let value = Warnings {
                forward_collision: dice.flag(),
                pedestrian: dice.flag(),
                seat_leave: dice.flag(),
                hazard_flashers: dice.flag(),
                fault_lamp: dice.flag(),
                notice_lamp: dice.flag(),
                lane_departure: dice.flag(),
                speed_limit: dice.flag(),
                headway: dice.flag(),
            };
            commands.warnings = dice.command(value);
        }
        10 => {
            let value = Body {
                wipers: dice.of(Wiper::ALL),
                brake_lamps: dice.flag(),
                indicator_left: dice.flag(),
                indicator_right: dice.flag(),
                low_beam: dice.flag(),
                high_beam: dice.flag(),
                horn: dice.flag(),
            };
            commands.body = dice.command(value);
        }
        _ => {
            let mode = dice.of(DrivingMode::ALL);
            commands.mode = dice.command(mode);
        }
    }
}

/// Another road: mostly clear or one object near a threshold, sometimes full lists of anything.
pub fn change_scene(dice: &mut Dice<'_>, scene: &mut Scene) {
    *scene = Scene { radar_known: !dice.one_in(6), camera_known: !dice.one_in(6), ..Scene::clear() };
    let objects = if dice.one_in(8) { MAX_RADAR } else { dice.below(3) };
    for _ in 0..objects {
        let wild = dice.one_in(3);
        let object = RadarObject {
            distance: DistanceCm::new(if wild { dice.half() } else { dice.of(&[0, 100, 2_700, 3_600, 4_399, 5_000]) }),
            offset: OffsetCm::new(if wild { dice.signed() } else { dice.of(&[0, 180, -181, 199]) }),
            closing: ClosingCmS::new(if wild { dice.signed() } else { dice.of(&[1_000, 500, 0, -100]) }),
            age: Millis::new(if dice.one_in(8) { dice.word() } else { 50 }),
            updates: Count::new(dice.byte()),
        };
        assert!(scene.radar.push(object).is_ok());
        if let Some(picture) = picture_of(&object, &body_of(dice.of(Class::ALL))).filter(|_| dice.flag()) {
            // A full list leaves it out.
            scene.camera.push(picture).unwrap_or(());
        }
    }
    if dice.one_in(4) {
        let camera =
            CameraObject { class: dice.of(Class::ALL), ..camera_object(dice.half() % 6_000, dice.signed() % 2_000) };
        scene.camera.push(camera).unwrap_or(());
    }
}

/// Contactors and gearbox do as they were told.
pub fn obey(outputs: &Outputs, inputs: &mut Inputs) {
    for (request, contact) in [(outputs.contactors.k1, &mut inputs.k1), (outputs.contactors.k4, &mut inputs.k4)] {
        match request {
            ContactorRequest::Hold => {}
            ContactorRequest::Open => *contact = OPEN,
            ContactorRequest::Close => *contact = CLOSED,
        }
    }
    match outputs.gear {
        GearRequest::Hold => {}
        GearRequest::Drive => inputs.gear = known(Gear::Drive),
        GearRequest::Reverse => inputs.gear = known(Gear::Reverse),
        GearRequest::Neutral => inputs.gear = known(Gear::Neutral),
        GearRequest::Park => inputs.gear = known(Gear::Park),
    }
}

/// What the bus shows beside our own frames, and what the brake system splits by.
pub fn change_bus(dice: &mut Dice<'_>, inputs: &mut Inputs) {
    inputs.foreign = if dice.one_in(20) { Channels::NONE.with(dice.of(Channel::ALL)) } else { Channels::NONE };
    inputs.second_sender = dice.one_in(40);
    if dice.one_in(10) {
        inputs.mass = dice.maybe(|dice| Mass10Kg::new(dice.half()));
        inputs.axle_pressure = [dice.maybe(|dice| Pressure5KPa::new(dice.byte())), inputs.axle_pressure[1]];
        inputs.electric_actual = dice.maybe(|dice| DecelMs2Q11::new(dice.half()));
    }
}

/// The time to the next cycle: mostly 10 ms, sometimes any legal one, seldom anything.
pub fn cycle(dice: &mut Dice<'_>) -> u32 {
    match dice.below(40) {
        0 => dice.of(&[0, 51, 60, 1_000, u32::MAX, u32::MAX - 9]),
        1..=4 => 1 + dice.word() % 50,
        _ => CYCLE,
    }
}

/// Slow against the service brake, the driver wants to move off.
pub fn hill() -> Bus {
    let mut bus = Bus::driving(kmh(1));
    bus.accelerator(travel(50));
    bus.ask_brake(ms2(100));
    bus.ask_torque(2);
    bus
}

/// How many places random drives begin at.
pub const STARTS: usize = 14;

/// Where random drives begin; made once.
pub fn start(which: usize) -> Bus {
    static MADE: OnceLock<Vec<Bus>> = OnceLock::new();
    let made = MADE.get_or_init(|| {
        vec![
            Bus::boot(ResetCause::Other, None, Inputs::NEVER),
            Bus::boot(ResetCause::PowerOn, Some(Record::None), healthy()),
            Bus::parked(),
            Bus::driving(kmh(0)),
            Bus::driving(kmh(50)),
            Bus::automated(kmh(30)),
            Bus::steering(kmh(10)),
            Bus::leave(kmh(30)),
            Bus::parked_by_leave(),
            Bus::opening_k4(),
            Bus::opening_k1(),
            Bus::down(),
            hill(),
            Bus::automated_by_epbi(kmh(30)),
        ]
    });
    made[which % STARTS].clone()
}
