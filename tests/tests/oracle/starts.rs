//! Where drives begin, recorded from the reset on, and what can happen in them.

use super::trace::Recorder;
use crate::common::random::*;
use crate::common::*;
use std::sync::OnceLock;

/// How many starts there are.
pub const BEGINNINGS: usize = 15;
/// The first of those with ten minutes of past: used less often.
pub const LONG: usize = 11;

fn driving(speed: SpeedKmhQ8) -> Recorder {
    let inputs =
        Inputs { gear: known(Gear::Drive), selector: known(Gear::Drive), epb: known(EpbState::Released), ..healthy() };
    let mut drive = Recorder::boot(ResetCause::PowerOn, Some(Record::None), inputs);
    drive.bus.speed(speed);
    drive.run(3_000, 10);
    drive
}

fn automated(speed: SpeedKmhQ8) -> Recorder {
    let mut drive = driving(speed);
    drive.bus.inputs.cruise_switch = known(true);
    drive.bus.inputs.ads = known(AdsState::Ready);
    drive.step();
    drive.bus.inputs.driver_set = known(true);
    drive.bus.commands.mode = Command::Fresh(DrivingMode::Automated);
    drive.step();
    drive.bus.inputs.driver_set = known(false);
    drive.step();
    drive
}

fn leave(speed: SpeedKmhQ8) -> Recorder {
    let mut drive = driving(speed);
    drive.bus.vacant();
    drive.run(2_050, 10);
    drive
}

fn parked_by_leave() -> Recorder {
    let mut drive = leave(kmh(5));
    drive.bus.speed(kmh(0));
    drive.step();
    drive.bus.inputs.epb = known(EpbState::Applied);
    drive.step();
    drive.bus.inputs.gear = known(Gear::Neutral);
    drive.bus.inputs.executed_torque = known(percent(0));
    drive.step();
    drive
}

fn nearly_due() -> Recorder {
    let mut drive = parked_by_leave();
    drive.run(599_800, 50);
    drive
}

fn opening_k4() -> Recorder {
    let mut drive = nearly_due();
    drive.run(400, 50);
    drive
}

fn opening_k1() -> Recorder {
    let mut drive = opening_k4();
    drive.bus.loads_run();
    drive.bus.inputs.k4 = OPEN;
    drive.step();
    drive
}

fn down() -> Recorder {
    let mut drive = opening_k1();
    drive.bus.loads_stopped();
    drive.step();
    drive.bus.inputs.k1 = OPEN;
    drive.run(100, 10);
    drive
}

/// The start of a drive; made once.
pub fn beginning(which: usize) -> Recorder {
    static MADE: OnceLock<Vec<Recorder>> = OnceLock::new();
    let made = MADE.get_or_init(|| {
        let mut parked = Recorder::boot(ResetCause::PowerOn, Some(Record::None), healthy());
        let booted = parked.clone();
        parked.run(3_000, 10);
        let mut hill = driving(kmh(1));
        hill.bus.accelerator(travel(50));
        hill.bus.ask_brake(ms2(100));
        hill.bus.ask_torque(2);
        let mut going = driving(kmh(20));
        going.bus.accelerator(travel(60));
        going.bus.ask_torque(40);
        let mut assisted = automated(kmh(40));
        assisted.bus.ask_adas(30);
        vec![
            Recorder::boot(ResetCause::Other, None, Inputs::NEVER),
            booted,
            parked,
            driving(kmh(0)),
            driving(kmh(50)),
            assisted,
            automated(kmh(30)),
            leave(kmh(30)),
            parked_by_leave(),
            hill,
            going,
            nearly_due(),
            opening_k4(),
            opening_k1(),
            down(),
        ]
    });
    made[which % BEGINNINGS].clone()
}

/// Cycles of random length.
fn cycles(drive: &mut Recorder, dice: &mut Dice<'_>, count: usize) {
    for _ in 0..count {
        drive.step_by(cycle(dice));
    }
}

/// The parking brake does as it was told, mostly.
fn park(drive: &mut Recorder) {
    let Some(outputs) = drive.trace.cycles.last().map(|cycle| cycle.outputs) else { return };
    match outputs.epb.request {
        EpbRequest::None => {}
        EpbRequest::Apply => drive.bus.inputs.epb = known(EpbState::Applied),
        EpbRequest::Release => drive.bus.inputs.epb = known(EpbState::Released),
    }
}

/// One event, and the cycles after it.
pub fn event(drive: &mut Recorder, dice: &mut Dice<'_>) {
    if let Some(decision) = drive.bus.last.filter(|_| !dice.one_in(8)) {
        obey(&decision.outputs, &mut drive.bus.inputs);
    }
    if !dice.one_in(4) {
        park(drive);
    }
    match dice.below(22) {
        0..=10 => anything(drive, dice),
        11 => {
            drive.bus.vacant();
            cycles(drive, dice, 203);
        }
        12 | 13 => {
            drive.bus.occupied();
            cycles(drive, dice, 103);
        }
        14 => {
            let rolling = dice.of(&[0, 300, 500, 600, 2_560, 7_680, 12_800]);
            drive.bus.speed(kmh_q8(rolling));
            let count = dice.of(&[1, 10, 120, 230]);
            cycles(drive, dice, count);
        }
        15 => approach(drive, dice),
        16 => back_to_the_wheel(drive, dice),
        17 => restart(drive, dice),
        18 => throttle(drive, dice),
        19 => pedals(drive, dice),
        20 => emergency(drive, dice),
        _ => {
            // The speed is lost, sometimes for long.
            drive.bus.speed_unknown();
            let span = dice.of(&[100, 100, 100, 400, 11_000, 21_000]);
            drive.run(span, 50);
            drive.bus.inputs.motor_speed = drive.bus.inputs.wheel_speed;
            drive.step();
        }
    }
}

/// Any inputs, commands and objects.
fn anything(drive: &mut Recorder, dice: &mut Dice<'_>) {
    change_bus(dice, &mut drive.bus.inputs);
    for _ in 0..=dice.below(3) {
        change_input(dice, &mut drive.bus.inputs);
    }
    for _ in 0..dice.below(3) {
        change_command(dice, &mut drive.bus.commands);
    }
    if dice.one_in(4) {
        change_scene(dice, &mut drive.bus.scene);
    }
    let count = dice.of(&[1, 1, 2, 5, 30, 60]);
    cycles(drive, dice, count);
}

/// An object near a threshold, at speed; or it goes again.
fn approach(drive: &mut Recorder, dice: &mut Dice<'_>) {
    if dice.one_in(3) {
        drive.bus.road_clear();
        cycles(drive, dice, 60);
        return;
    }
    let speed = dice.of(&[2_559, 2_560, 7_680, 12_800]);
    drive.bus.speed(kmh_q8(speed));
    drive.bus.inputs.deceleration = known(dice.of(&[DecelMs2Q11::ZERO, ms2(50), ms2(200)]));
    drive.bus.inputs.steering_angle = known(angle(dice.of(&[0, 0, 599, 600, 699, 700, 799, 800, -599])));
    let time = dice.of(&[2_699, 2_700, 2_701, 3_200, 3_599, 3_600, 3_601, 4_399, 4_400, 5_000]);
    drive.bus.ahead(RadarObject { updates: Count::new(dice.of(&[2, 3, 50])), ..at(time) });
    let count = dice.of(&[1, 5, 40]);
    cycles(drive, dice, count);
    if dice.flag() {
        drive.bus.ahead(object(1_500, dice.of(&[0, -100, 100])));
        let count = dice.of(&[10, 49, 51]);
        cycles(drive, dice, count);
    }
}

/// The driver returns, takes a gear, presses the accelerator anew and asks for a release; sometimes a step is missing.
fn back_to_the_wheel(drive: &mut Recorder, dice: &mut Dice<'_>) {
    drive.bus.occupied();
    drive.bus.speed(kmh(0));
    drive.bus.inputs.epb_switch = known(EpbSwitch::Idle);
    drive.bus.accelerator(Pedal250::ZERO);
    cycles(drive, dice, 100);
    let gear = dice.of(&[Gear::Drive, Gear::Drive, Gear::Reverse, Gear::Neutral]);
    (drive.bus.inputs.selector, drive.bus.inputs.gear) = (known(gear), known(gear));
    if dice.flag() {
        (drive.bus.inputs.k1, drive.bus.inputs.k4) = (CLOSED, CLOSED);
    }
    cycles(drive, dice, 5);
    if !dice.one_in(3) {
        drive.bus.accelerator(travel(20));
        drive.step();
    }
    drive.bus.ask_epb(EpbRequest::Release);
    drive.step();
    park(drive);
    cycles(drive, dice, 2);
    drive.bus.ask_epb(EpbRequest::None);
}

/// The key goes off and to start, and closing is asked for; sometimes a step is missing.
fn restart(drive: &mut Recorder, dice: &mut Dice<'_>) {
    if dice.flag() {
        drive.bus.occupied();
        cycles(drive, dice, 101);
    }
    for key in [Key::Off, Key::On, Key::Start] {
        if !dice.one_in(5) {
            drive.bus.inputs.key = known(key);
            drive.step();
        }
    }
    drive.bus.ask_contactors(ContactorRequest::Close, ContactorRequest::Close);
    for _ in 0..3 {
        drive.step();
        if let Some(decision) = drive.bus.last {
            obey(&decision.outputs, &mut drive.bus.inputs);
        }
    }
    drive.bus.ask_contactors(ContactorRequest::Hold, ContactorRequest::Hold);
    drive.step();
}

/// Sound pedals, gear and limits, and a driver's torque, or that of the assistance.
fn throttle(drive: &mut Recorder, dice: &mut Dice<'_>) {
    let accelerator = dice.pedal();
    let inputs = &mut drive.bus.inputs;
    (inputs.selector, inputs.gear) = (known(Gear::Drive), known(Gear::Drive));
    (inputs.brake_pedal, inputs.brake_switch) = ([known(Pedal250::ZERO); 2], known(false));
    (inputs.abs, inputs.asr, inputs.stability) = (known(false), known(false), known(false));
    inputs.drive_limit = known(Percent::FULL);
    drive.bus.accelerator(accelerator);
    drive.bus.ask_brake(DecelMs2Q11::ZERO);
    let torque = dice.of(&[0, 1, 5, 20, 60, 100]);
    if dice.one_in(3) {
        drive.bus.inputs.cruise_switch = known(true);
        drive.bus.inputs.ads = known(AdsState::Ready);
        drive.bus.inputs.driver_set = known(true);
        drive.bus.commands.mode = Command::Fresh(DrivingMode::Automated);
        drive.bus.ask_adas(torque);
        drive.step();
        drive.bus.inputs.driver_set = known(false);
    } else {
        drive.bus.ask_torque(torque);
    }
    let count = dice.of(&[2, 20, 60]);
    cycles(drive, dice, count);
}

/// The driver presses one pedal, both, or the brake against a request; sometimes P is asked for.
fn pedals(drive: &mut Recorder, dice: &mut Dice<'_>) {
    let brake = dice.of(&[0, 20, 60]);
    drive.bus.brake_pedal(travel(brake));
    let accelerator = dice.of(&[0, 50]);
    drive.bus.accelerator(travel(accelerator));
    drive.bus.ask_torque(20);
    let asked = dice.decel();
    drive.bus.ask_brake(asked);
    if dice.flag() {
        drive.bus.inputs.selector = known(Gear::Park);
        drive.bus.ask_gear(GearRequest::Park);
    }
    let count = dice.of(&[1, 10, 60]);
    cycles(drive, dice, count);
    drive.bus.brake_pedal(Pedal250::ZERO);
    drive.bus.ask_gear(GearRequest::Hold);
    drive.bus.ask_brake(DecelMs2Q11::ZERO);
    drive.step();
}

/// Pedals released, a sensor lost or an object near, and a strong request for the brake, alone.
fn emergency(drive: &mut Recorder, dice: &mut Dice<'_>) {
    drive.bus.brake_pedal(Pedal250::ZERO);
    drive.bus.accelerator(Pedal250::ZERO);
    drive.bus.commands.retarder = Command::Fresh(Retarder::NEUTRAL);
    drive.bus.road_clear();
    match dice.below(3) {
        0 => drive.bus.perception_unknown(),
        1 => {
            let time = dice.of(&[3_199, 3_200, 3_201]);
            drive.bus.ahead(RadarObject { updates: Count::new(1), ..at(time) });
        }
        _ => {}
    }
    let asked = dice.of(&[7_168, 7_169, 12_288, 12_289]);
    drive.bus.ask_brake(DecelMs2Q11::new(asked));
    let count = dice.of(&[1, 10]);
    cycles(drive, dice, count);
    drive.bus.road_clear();
    if dice.flag() {
        // The frame is lost for a while.
        drive.bus.ask_brake(ms2(200));
        drive.step();
        drive.bus.commands.brake = Command::Absent;
        cycles(drive, dice, 120);
    }
    drive.bus.ask_brake(DecelMs2Q11::ZERO);
    drive.step();
}
