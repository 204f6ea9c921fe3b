//! What the tests of the wire share: random values, a bench of one sender and one receiver, an independent check
//! field.
#![expect(dead_code, reason = "every test uses a part of it")]
#![expect(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on has failed")]

use supervisor_core::*;
use supervisor_perceive::{CameraObject, Class as ObjectClass, MAX_CAMERA, MAX_RADAR, PixelBox, RadarObject, Scene};
use supervisor_wire::{Destination, Frame, Message, Protection, Receiver, Sender, Source};

/// A small generator (xorshift): the same seed gives the same values.
#[derive(Debug)]
pub struct Random {
    state: u64,
    /// Every signal is known.
    known: bool,
}

impl Random {
    pub fn new(seed: u64) -> Self {
        Self { state: seed | 1, known: false }
    }
    /// Inputs that are all known.
    pub fn known_inputs(&mut self) -> Inputs {
        self.known = true;
        let inputs = self.inputs();
        self.known = false;
        inputs
    }
    pub fn next(&mut self) -> u64 {
        self.state ^= self.state << 13;
        self.state ^= self.state >> 7;
        self.state ^= self.state << 17;
        self.state.wrapping_mul(0x2545_F491_4F6C_DD1D)
    }
    pub fn below(&mut self, limit: u64) -> u64 {
        (self.next() >> 16) % limit
    }
    fn bool(&mut self) -> bool {
        self.below(2) == 1
    }
    fn u8(&mut self) -> u8 {
        self.next().to_le_bytes()[3]
    }
    fn u16(&mut self) -> u16 {
        u16::from_le_bytes([self.u8(), self.u8()])
    }
    fn one<T: Copy>(&mut self, all: &[T]) -> T {
        all[usize::try_from(self.below(u64::try_from(all.len()).unwrap())).unwrap()]
    }
    /// Known in three of four.
    fn signal<T>(&mut self, value: impl FnOnce(&mut Self) -> T) -> Signal<T> {
        if !self.known && self.below(4) == 0 {
            Signal::Unknown(Cause::NotAvailable)
        } else {
            Signal::Known(value(self))
        }
    }
    /// Not the raw value of "not available".
    fn word(&mut self) -> u16 {
        self.u16().min(0xFFFE)
    }
    fn signed(&mut self) -> i16 {
        self.u16().cast_signed().min(0x7FFE)
    }

    pub fn inputs(&mut self) -> Inputs {
        let pedal = |r: &mut Self| Pedal250::new(r.u8().min(250));
        Inputs {
            seat: [self.signal(|r| r.one(Seat::ALL)), self.signal(|r| r.one(Seat::ALL))],
            wheel_speed: self.signal(|r| SpeedKmhQ8::new(r.u16().min(0xFAFF))),
            motor_speed: self.signal(|r| SpeedKmhQ8::new(r.word())),
            accelerator: [self.signal(pedal), self.signal(pedal)],
            brake_pedal: [self.signal(pedal), self.signal(|r| Pedal250::new(r.u8().min(254)))],
            brake_switch: self.signal(Self::bool),
            steering_angle: self.signal(|r| AngleDeciDeg::new(r.signed())),
            driver_torque: self.signal(|r| TorqueNmQ10::new(r.signed())),
            selector: self.signal(|r| r.one(Gear::ALL)),
            gear: self.signal(|r| r.one(Gear::ALL)),
            epb: self.signal(|r| r.one(EpbState::ALL)),
            epb_switch: self.signal(|r| r.one(EpbSwitch::ALL)),
            epb_mode: self.signal(|r| r.one(EpbMode::ALL)),
            key: self.signal(|r| r.one(Key::ALL)),
            cruise_switch: self.signal(Self::bool),
            driver_set: self.signal(Self::bool),
            k1: self.signal(|r| r.one(Contact::ALL)),
            k4: self.signal(|r| r.one(Contact::ALL)),
            hv_current: self.signal(|r| CurrentDeciA::new(r.signed())),
            drive_stopped: self.signal(Self::bool),
            auxiliaries_stopped: self.signal(Self::bool),
            drive_limit: self.signal(|r| Percent::new(r.u8().min(254))),
            executed_torque: self.signal(|r| Percent::new(r.u8().min(254))),
            electric_limit: self.signal(|r| DecelMs2Q11::new(r.word())),
            friction_limit: self.signal(|r| DecelMs2Q11::new(r.word())),
            deceleration: self.signal(|r| DecelMs2Q11::new(r.word())),
            abs: self.signal(Self::bool),
            asr: self.signal(Self::bool),
            stability: self.signal(Self::bool),
            ebs_red: self.signal(Self::bool),
            ebs_amber: self.signal(Self::bool),
            xbr_status: self.signal(|r| r.one(XbrStatus::ALL)),
            eps: self.signal(|r| r.one(EpsState::ALL)),
            hands_off: self.signal(Self::bool),
            ads: self.signal(|r| r.one(AdsState::ALL)),
            electric_actual: self.signal(|r| DecelMs2Q11::new(r.word())),
            mass: self.signal(|r| Mass10Kg::new(r.word())),
            axle_pressure: [
                self.signal(|r| Pressure5KPa::new(r.u8().min(254))),
                self.signal(|r| Pressure5KPa::new(r.u8().min(254))),
            ],
            // No signals: what the receiver finds on the bus of the actuators.
            foreign: Channels::NONE,
            second_sender: false,
        }
    }

    /// Every value the frames can carry: all of the types, but for the ends of J1939's ranges.
    pub fn outputs(&mut self) -> Outputs {
        Outputs {
            drive: DriveTorque {
                torque: Percent::new(self.u8().min(125)),
                active: self.bool(),
                origin: self.one(Origin::ALL),
            },
            target_speed: SpeedKmhQ8::new(self.u16()),
            brake: ServiceBrake {
                total: DecelMs2Q11::new(self.u16().min(32_127)),
                electric: DecelMs2Q11::new(self.u16()),
                mode: self.one(BrakeMode::ALL),
                priority: self.one(Priority::ALL),
            },
            retarder: Retarder {
                torque: Percent::new(self.u8().min(125)),
                mode: self.one(RetarderMode::ALL),
                priority: self.one(Priority::ALL),
            },
            gear: self.one(GearRequest::ALL),
            epb: ParkingBrake { request: self.one(EpbRequest::ALL), mode: self.one(EpbMode::ALL) },
            steering: Steering {
                enable: self.bool(),
                angle: AngleDeciDeg::new(self.u16().cast_signed()),
                rate: RateDeciDegS::new(self.u16()),
                overlay: TorqueNmQ10::new(self.u16().cast_signed()),
                weight: Percent::new(self.u8()),
                bar_limit: BarTorque50mNm::new(self.u8()),
            },
            contactors: Contactors { k4: self.one(ContactorRequest::ALL), k1: self.one(ContactorRequest::ALL) },
            auxiliaries: Auxiliaries { air_pump: self.bool(), power_steering: self.bool(), dc_dc: self.bool() },
            warnings: Warnings {
                forward_collision: self.bool(),
                pedestrian: self.bool(),
                seat_leave: self.bool(),
                hazard_flashers: self.bool(),
                fault_lamp: self.bool(),
                notice_lamp: self.bool(),
                lane_departure: self.bool(),
                speed_limit: self.bool(),
                headway: self.bool(),
            },
            body: Body {
                wipers: self.one(Wiper::ALL),
                brake_lamps: self.bool(),
                indicator_left: self.bool(),
                indicator_right: self.bool(),
                low_beam: self.bool(),
                high_beam: self.bool(),
                horn: self.bool(),
            },
            mode: self.one(DrivingMode::ALL),
        }
    }

    /// Every value the frames can carry: a time parked is told up to 2^20 - 2 ms.
    pub fn status(&mut self) -> Status {
        let faults = u32::from(self.u16()) << 16 | u32::from(self.u16());
        Status {
            occupancy: self.one(Occupancy::ALL),
            parked_by_leave: self.bool(),
            parked_for: ms(u32::try_from(self.below((1 << 20) - 1)).unwrap()),
            stage: self.one(Stage::ALL),
            level: self.one(Level::ALL),
            mode: self.one(Mode::ALL),
            exit: self.one(ExitReason::ALL),
            safe_state: self.bool(),
            faults: Faults::from_word(faults).unwrap(),
            record: self.one(Record::ALL),
        }
    }

    pub fn radar(&mut self) -> RadarObject {
        RadarObject {
            distance: DistanceCm::new(self.u16()),
            offset: OffsetCm::new(self.u16().cast_signed()),
            closing: ClosingCmS::new(self.u16().cast_signed()),
            age: Millis::new(u32::from(self.u16().min(510))),
            updates: Count::new(self.u8()),
        }
    }
    pub fn camera(&mut self) -> CameraObject {
        CameraObject {
            pixels: PixelBox { left: self.u16(), top: self.u16(), width: self.u16(), height: self.u16() },
            class: self.one(ObjectClass::ALL),
            distance: DistanceCm::new(self.u16()),
            closing: ClosingCmS::new(self.u16().cast_signed()),
            age: Millis::new(u32::from(self.u16().min(510))),
        }
    }
    pub fn scene(&mut self) -> Scene {
        let mut scene = Scene { radar_known: self.below(4) > 0, camera_known: self.below(4) > 0, ..Scene::default() };
        for _ in 0..if scene.radar_known { self.below(u64::try_from(MAX_RADAR).unwrap() + 1) } else { 0 } {
            scene.radar.push(self.radar()).unwrap();
        }
        for _ in 0..if scene.camera_known { self.below(u64::try_from(MAX_CAMERA).unwrap() + 1) } else { 0 } {
            scene.camera.push(self.camera()).unwrap();
        }
        scene
    }
}

/// All fresh.
pub fn fresh(outputs: &Outputs) -> Commands {
    outputs.as_commands()
}

/// The default configuration, without the time to requalify.
pub fn at_once() -> Config {
    Config { requalify: Millis::ZERO, ..Config::DEFAULT }
}

pub fn ms(value: u32) -> Millis {
    Millis::new(value)
}

/// The receiver that takes this message: only the status comes from the supervisor.
pub fn receiver_of(message: Message, config: &Config) -> Receiver {
    let from_us = message.destination() == Destination::Status;
    Receiver::listening_to(if from_us { Source::Supervisor } else { Source::MainController }, config)
}

/// One sender of everything and the receiver of it.
#[derive(Debug)]
pub struct Bench {
    pub sender: Sender,
    pub receiver: Receiver,
    pub now: Millis,
}

impl Bench {
    pub fn new(config: &Config) -> Self {
        Self { sender: Sender::new(), receiver: Receiver::new(config), now: Millis::ZERO }
    }
    /// Lets time pass.
    pub fn pass(&mut self, span: u32) {
        self.now = ms(self.now.raw().wrapping_add(span));
    }
    /// Everything is sent and received that is due now.
    pub fn send(&mut self, inputs: &Inputs, scene: &Scene, commands: &Commands) {
        self.send_but(inputs, scene, commands, |_| true);
    }
    /// The same, but only what `passes`.
    pub fn send_but(
        &mut self,
        inputs: &Inputs,
        scene: &Scene,
        commands: &Commands,
        passes: impl Fn(&mut Frame) -> bool,
    ) {
        let Self { sender, receiver, now } = self;
        let mut emit = |mut frame: Frame| {
            if passes(&mut frame) {
                let _ = receiver.accept(*now, &frame);
            }
        };
        sender.encode_inputs(*now, inputs, scene, &mut emit);
        sender.encode_commands(*now, commands, &mut emit);
    }
}

/// One frame of a message as its sender sends it, with this counter.
pub fn frame(message: Message, inputs: &Inputs, outputs: &Outputs, counter: u8) -> Frame {
    let mut sender = Sender::new();
    let mut found = None;
    for time in 0..=u32::from(counter) {
        let mut emit = |frame: Frame| {
            if frame.id == message.id() {
                found = Some(frame);
            }
        };
        // More than any period: everything is due.
        sender.encode_inputs(ms(time * 1000), inputs, &Scene::clear(), &mut emit);
        sender.encode_commands(ms(time * 1000), &fresh(outputs), &mut emit);
        sender.encode_status(ms(time * 1000), &Random::new(1).status(), &mut emit);
    }
    found.unwrap()
}

/// Sets bits of a payload.
pub fn with_bits(payload: u64, start: u32, width: u32, raw: u64) -> u64 {
    let mask = ((1_u64 << width) - 1) << start;
    payload & !mask | raw << start & mask
}

pub fn bits(payload: u64, start: u32, width: u32) -> u64 {
    payload >> start & ((1_u64 << width) - 1)
}

/// Where the counter stands: start, width, number of values.
pub fn counter_place(message: Message) -> (u32, u32, u8) {
    match message.protection() {
        Protection::Profile11 => (8, 4, 15),
        Protection::Tsc1 => (56, 4, 8),
        Protection::Xbr => (56, 4, 16),
        Protection::Bare => panic!("bare"),
    }
}

/// CRC8 of SAE J1850 as AUTOSAR E2E Profile 11 starts and ends it.
static CRC: crc::Crc<u8> = crc::Crc::<u8>::new(&crc::Algorithm { init: 0, xorout: 0, ..crc::CRC_8_SAE_J1850 });

/// The frame with this counter and a right check field, computed here and not by the crate.
pub fn resealed(message: Message, frame: &Frame, counter: u8) -> Frame {
    let (start, width, _) = counter_place(message);
    let mut payload = with_bits(frame.payload(), start, width, u64::from(counter));
    let data = payload.to_le_bytes();
    let sum = frame.id.to_le_bytes().iter().chain(&data[..7]).map(|byte| u64::from(*byte)).sum::<u64>()
        + u64::from(data[7] & 0x0F);
    payload = match message.protection() {
        Protection::Profile11 => {
            let mut digest = CRC.digest();
            digest.update(&frame.id.to_le_bytes()[..2]);
            digest.update(&data[1..]);
            with_bits(payload, 0, 8, u64::from(digest.finalize()))
        }
        Protection::Tsc1 => with_bits(payload, 60, 4, ((sum >> 6 & 3) + (sum >> 3) + sum) & 7),
        Protection::Xbr => with_bits(payload, 60, 4, ((sum >> 4) + sum) & 15),
        Protection::Bare => payload,
    };
    Frame::new(frame.id, payload)
}

/// The messages with a check field.
pub fn protected() -> impl Iterator<Item = Message> {
    Message::ALL.iter().copied().filter(|message| message.protection() != Protection::Bare)
}
