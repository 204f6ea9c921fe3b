//! The matrix of *unknown* (CMD-4): every cell, on random drives.
//!
//! Each cycle is decided twice from the same retained state, once with a group taken away. A channel whose cell says
//! *unaffected* must come out the same every time; every other cell but *persists* must be seen to make a difference.

use std::collections::BTreeSet;

use supervisor::{
    AdsState, AngleDeciDeg, Channel, Channels, Closing, Command, Commands, Contact, ContactorRequest, Contactors,
    CurrentDeciA, DecelMs2Q11, Decision, DriveTorque, DrivingMode, EpbMode, EpbRequest, EpbState, EpbSwitch, EpsState,
    Flow, Gear, GearRequest, Group, Inputs, Key, Level, Mass10Kg, Meaning, Millis, Origin, Outputs, ParkingBrake,
    Pedal250, Percent, Pressure5KPa, Record, ResetCause, Retarder, RetarderMode, Sealed, Seat, Signal, SpeedKmhQ8,
    State, StateImage, Steering, Threat, TorqueNmQ10, meaning, step,
};

/// A small deterministic generator (xorshift).
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }
    fn below(&mut self, bound: u64) -> u64 {
        self.next() % bound
    }
    fn pick<T: Copy>(&mut self, choices: &[T]) -> T {
        let index = usize::try_from(self.below(u64::try_from(choices.len()).unwrap_or(1))).unwrap_or(0);
        choices[index]
    }
}

/// A driver who drives: everything known, nothing wrong.
fn healthy() -> Inputs {
    let known = Signal::Known;
    Inputs {
        seat: [known_seat(Seat::Occupied); 2],
        wheel_speed: Signal::Known(SpeedKmhQ8::new(30 * 256)),
        motor_speed: Signal::Known(SpeedKmhQ8::new(30 * 256)),
        accelerator: [Signal::Known(Pedal250::new(100)); 2],
        brake_pedal: [Signal::Known(Pedal250::ZERO); 2],
        brake_switch: known(false),
        steering_angle: Signal::Known(AngleDeciDeg::ZERO),
        driver_torque: Signal::Known(TorqueNmQ10::ZERO),
        selector: Signal::Known(Gear::Drive),
        gear: Signal::Known(Gear::Drive),
        epb: Signal::Known(EpbState::Released),
        epb_switch: Signal::Known(EpbSwitch::Idle),
        epb_mode: Signal::Known(EpbMode::Automatic),
        key: Signal::Known(Key::On),
        cruise_switch: known(true),
        driver_set: known(false),
        k1: Signal::Known(Contact::Closed),
        k4: Signal::Known(Contact::Closed),
        hv_current: Signal::Known(CurrentDeciA::ZERO),
        drive_stopped: known(true),
        auxiliaries_stopped: known(true),
        drive_limit: Signal::Known(Percent::FULL),
        executed_torque: Signal::Known(Percent::ZERO),
        electric_limit: Signal::Known(DecelMs2Q11::new(2048)),
        friction_limit: Signal::Known(DecelMs2Q11::new(12288)),
        electric_actual: Signal::Known(DecelMs2Q11::ZERO),
        mass: Signal::Known(Mass10Kg::new(1_500)),
        axle_pressure: [Signal::Known(Pressure5KPa::ZERO); 2],
        deceleration: Signal::Known(DecelMs2Q11::ZERO),
        abs: known(false),
        asr: known(false),
        stability: known(false),
        ebs_red: known(false),
        ebs_amber: known(false),
        xbr_status: Signal::NEVER,
        eps: Signal::Known(EpsState::Ready),
        hands_off: known(false),
        ads: Signal::Known(AdsState::Ready),
        foreign: Channels::NONE,
        second_sender: false,
    }
}

const fn known_seat(seat: Seat) -> Signal<Seat> {
    Signal::Known(seat)
}

/// Changes one thing of the world, mostly back to healthy.
fn stir(random: &mut Random, inputs: &mut Inputs, threat: &mut Threat) {
    let speed = |raw| Signal::Known(SpeedKmhQ8::new(raw));
    match random.below(22) {
        0 => inputs.seat = [known_seat(random.pick(Seat::ALL)); 2],
        1 | 2 => {
            let raw = random.pick(&[0, 0, 0, 300, 2000, 7680, 12800]);
            (inputs.wheel_speed, inputs.motor_speed) = (speed(raw), speed(raw));
        }
        3 => inputs.accelerator = [Signal::Known(Pedal250::new(random.pick(&[0, 100, 250]))); 2],
        4 => {
            let travel = random.pick(&[0, 0, 0, 60, 200]);
            inputs.brake_pedal = [Signal::Known(Pedal250::new(travel)); 2];
            inputs.brake_switch = Signal::Known(travel > 0);
        }
        5 => inputs.steering_angle = Signal::Known(AngleDeciDeg::new(random.pick(&[0, 0, 100, 850, 1200]))),
        6 => inputs.driver_torque = Signal::Known(TorqueNmQ10::new(random.pick(&[0, 0, 0, 7000]))),
        7 => {
            let gear = random.pick(&[Gear::Drive, Gear::Drive, Gear::Drive, Gear::Neutral, Gear::Reverse]);
            (inputs.gear, inputs.selector) =
                (Signal::Known(gear), Signal::Known(random.pick(&[gear, Gear::Drive, Gear::Reverse])));
        }
        8 => inputs.epb = Signal::Known(random.pick(EpbState::ALL)),
        9 => inputs.epb_switch = Signal::Known(random.pick(EpbSwitch::ALL)),
        10 => inputs.key = Signal::Known(random.pick(Key::ALL)),
        11 => inputs.driver_set = Signal::Known(random.below(2) == 0),
        12 => {
            let contacts =
                [(Contact::Closed, Contact::Closed), (Contact::Open, Contact::Open), (Contact::Closed, Contact::Open)];
            let (k1, k4) = random.pick(&contacts);
            (inputs.k1, inputs.k4) = (Signal::Known(k1), Signal::Known(k4));
        }
        13 => inputs.deceleration = Signal::Known(DecelMs2Q11::new(random.pick(&[0, 0, 4000]))),
        14 => inputs.abs = Signal::Known(random.below(3) == 0),
        15 => *threat = Threat::CLEAR,
        16 => {
            let level = random.pick(Level::ALL);
            *threat = Threat {
                level,
                closing: Closing::Yes,
                required: DecelMs2Q11::new(3000),
                mitigable: true,
                ..Threat::CLEAR
            };
        }
        17 => inputs.executed_torque = Signal::Known(Percent::new(random.pick(&[0, 0, 30]))),
        _ => {
            let seat = inputs.seat;
            *inputs = Inputs { driver_set: inputs.driver_set, ..healthy() };
            inputs.seat = seat;
        }
    }
}

fn commands(random: &mut Random) -> Commands {
    let mut out = Outputs::NEUTRAL;
    let origin = random.pick(&[Origin::Driver, Origin::Driver, Origin::Adas]);
    out.drive = DriveTorque { torque: Percent::new(random.pick(&[0, 20, 100])), active: true, origin };
    out.target_speed = SpeedKmhQ8::new(7680);
    out.brake.total = DecelMs2Q11::new(random.pick(&[0, 0, 1000, 12000]));
    out.brake.electric = out.brake.total;
    out.retarder =
        Retarder { torque: Percent::new(random.pick(&[0, 100])), mode: RetarderMode::Torque, ..Retarder::NEUTRAL };
    out.gear = random.pick(&[
        GearRequest::Hold,
        GearRequest::Drive,
        GearRequest::Reverse,
        GearRequest::Park,
        GearRequest::Neutral,
    ]);
    out.epb = ParkingBrake { request: random.pick(EpbRequest::ALL), mode: EpbMode::Automatic };
    let weight = Percent::new(random.pick(&[100, 100, 40]));
    out.steering =
        Steering { enable: true, weight, angle: AngleDeciDeg::new(random.pick(&[0, 300])), ..Steering::NEUTRAL };
    out.contactors = Contactors { k4: random.pick(ContactorRequest::ALL), k1: random.pick(ContactorRequest::ALL) };
    out.auxiliaries.air_pump = false;
    out.mode =
        random.pick(&[DrivingMode::Automated, DrivingMode::Automated, DrivingMode::Automated, DrivingMode::Manual]);
    let mut commands = out.as_commands();
    if random.below(8) == 0 {
        commands.brake = Command::Absent;
    }
    commands
}

/// Whether a channel came out different.
fn differs(channel: Channel, first: &Decision, second: &Decision) -> bool {
    let (one, two) = (&first.outputs, &second.outputs);
    match channel {
        Channel::DriveTorque => one.drive != two.drive,
        Channel::TargetSpeed => one.target_speed != two.target_speed,
        Channel::ServiceBrake => one.brake != two.brake,
        Channel::Retarder => one.retarder != two.retarder,
        Channel::Gear => one.gear != two.gear,
        Channel::ParkingBrake => one.epb != two.epb,
        Channel::Steering => one.steering != two.steering,
        Channel::Contactors => one.contactors != two.contactors,
        Channel::Auxiliaries => one.auxiliaries != two.auxiliaries,
        Channel::Warnings => one.warnings != two.warnings,
        Channel::Body => one.body != two.body,
        Channel::Mode => one.mode != two.mode,
    }
}

/// CMD-4a, CMD-4b: every cell says what happens.
#[test]
fn the_matrix_of_unknown_says_what_happens() -> Result<(), supervisor::ConfigError> {
    let sealed = Sealed::from_default()?;
    let mut random = Random(0x5EED_1234_ABCD_0001);
    let mut seen = BTreeSet::new();
    for run in 0..240_usize {
        let record = Record::ALL[run % Record::ALL.len()];
        let mut image = StateImage::encode(&State::boot(ResetCause::PowerOn, Some(record)));
        let (mut inputs, mut threat) = (healthy(), Threat::CLEAR);
        if record != Record::None {
            (inputs.wheel_speed, inputs.motor_speed) =
                (Signal::Known(SpeedKmhQ8::ZERO), Signal::Known(SpeedKmhQ8::ZERO));
            inputs.epb = Signal::Known(EpbState::Applied);
        }
        for cycle in 0..600_u32 {
            if cycle > 150 && random.below(12) == 0 {
                stir(&mut random, &mut inputs, &mut threat);
            }
            if cycle == 120 {
                inputs.driver_set = Signal::Known(true);
            }
            let commands = commands(&mut random);
            let now = Millis::new(cycle * 10);
            let decide = |inputs: &Inputs, threat: &Threat| {
                let mut copy = image;
                step(&mut copy, &sealed, Flow::PERCEIVED, now, inputs, threat, &commands)
            };
            let whole = decide(&inputs, &threat);
            for group in Group::ALL {
                let lost = if *group == Group::Perception { Threat::UNKNOWN } else { threat };
                let without = decide(&inputs.without(*group), &lost);
                for channel in Channel::ALL.iter().filter(|channel| differs(**channel, &whole, &without)) {
                    seen.insert((*group, *channel));
                }
            }
            let _ = step(&mut image, &sealed, Flow::PERCEIVED, now, &inputs, &threat, &commands);
        }
    }
    let mut wrong = Vec::new();
    for group in Group::ALL {
        for channel in Channel::ALL {
            let cell = meaning(*group, *channel);
            let seen = seen.contains(&(*group, *channel));
            // What persists changes only in the very cycle in which something would begin or end: rare, not demanded.
            if (cell == Meaning::Unaffected && seen)
                || (!matches!(cell, Meaning::Unaffected | Meaning::Persists) && !seen)
            {
                wrong.push(format!("{group:?} × {channel:?}: the table says {cell:?}, a difference was seen: {seen}"));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    Ok(())
}
