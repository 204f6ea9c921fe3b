//! Where the supervisor does not do what a row says by the letter, and another row or rule speaks for it. The claims follow the
//! wider reading; each test here demands the letter, fails today, and waits for a decision (`readings.toml`).

use crate::common::*;
use crate::read::braking_out;
use crate::starts::beginning;
use crate::trace::Recorder;

fn outputs(drive: &mut Recorder) -> Outputs {
    drive.step();
    drive.trace.cycles.last().map_or(Outputs::NEUTRAL, |cycle| cycle.outputs)
}

/// PHB-1b names level 3, T <= 3.2 s, the second opinion and unknown perception; level 1 with its object at 5 s is none of these.
#[test]
#[ignore = "finding: level 1 or 2 permits 6 m/s² too"]
fn a_level_below_three_keeps_the_comfort_cap() {
    let mut drive = beginning(4);
    drive.bus.ahead(at(4_399));
    assert_eq!(outputs(&mut drive).brake.total, ms2(100), "level 1 has begun");
    drive.bus.ahead(at(5_000));
    drive.run(1_000, 10);
    drive.bus.ask_brake(ms2(500));
    assert!(braking_out(&outputs(&mut drive)) <= 7_168, "PHB-1a");
}

/// PHB-1b: the same object has been at 15 s for a while: the cap of 6 m/s² stays as long as anything closes.
#[test]
#[ignore = "finding: 6 m/s² stay permitted while anything closes"]
fn an_emergency_that_is_over_leaves_the_comfort_cap() {
    let mut drive = beginning(4);
    drive.bus.inputs.steering_angle = known(angle(850));
    drive.bus.ahead(at(3_200));
    drive.run(100, 10);
    drive.bus.ahead(object(1_500, 100));
    drive.run(1_000, 10);
    drive.bus.ask_brake(ms2(500));
    assert!(braking_out(&outputs(&mut drive)) <= 7_168, "PHB-1a");
}

/// PHB-1b: an object at 4.0 s is none of these either; no level runs, the driver steers by 65 degrees.
#[test]
#[ignore = "finding: an obstacle below 4.4 s permits 6 m/s², level or not"]
fn an_object_beyond_the_emergency_keeps_the_comfort_cap() {
    let mut drive = beginning(4);
    drive.bus.inputs.steering_angle = known(angle(650));
    drive.bus.ahead(at(4_000));
    drive.bus.ask_brake(ms2(500));
    assert!(braking_out(&outputs(&mut drive)) <= 7_168, "PHB-1a");
}

/// E2E-2f, MODE-1e: "a time-out of BKS ends the automated and the longitudinal mode"; it ends 500 ms later, with the hold.
#[test]
#[ignore = "finding: mode and automated torque go on for 500 ms"]
fn a_lost_brake_command_ends_the_mode() {
    let mut drive = beginning(6);
    drive.bus.ask_adas(20);
    drive.run(200, 10);
    drive.bus.commands.brake = Command::Absent;
    let outputs = outputs(&mut drive);
    assert_eq!((outputs.mode, outputs.drive.torque), (DrivingMode::Manual, Percent::ZERO), "E2E-2f, TRQ-2b");
}

/// E2E-2e: "a time-out of BKS warns the driver": one cycle late.
#[test]
#[ignore = "finding: the warning comes one cycle after the command is lost"]
fn a_lost_brake_command_warns_at_once() {
    let mut drive = beginning(4);
    drive.bus.commands.brake = Command::Absent;
    assert!(outputs(&mut drive).warnings.fault_lamp, "E2E-2e");
}

/// GEAR-1c: "while the speed is unknown, the gear is held"; N that is asked for passes (RULE-3a).
#[test]
#[ignore = "finding: N passes with unknown speed"]
fn unknown_speed_holds_the_gear() {
    let mut drive = beginning(4);
    drive.bus.speed_unknown();
    drive.bus.ask_gear(GearRequest::Neutral);
    assert_eq!(outputs(&mut drive).gear, GearRequest::Hold, "GEAR-1c");
}

/// HV-1c, reason: "a contactor that is already commanded open stays so"; with the speed unknown K4 goes to hold (SEAT-7b, RULE-4b).
#[test]
#[ignore = "finding: an unknown speed withdraws the opening of K4"]
fn k4_that_is_commanded_open_stays_so() {
    let mut drive = beginning(12);
    assert_eq!(outputs(&mut drive).contactors.k4, ContactorRequest::Open);
    drive.bus.speed_unknown();
    assert_eq!(outputs(&mut drive).contactors.k4, ContactorRequest::Open, "SEAT-7i");
}

/// SEAT-0b: "powered on" is nowhere said; with the key off, rolling, contactors closed, leave begins.
#[test]
#[ignore = "finding: no reading says what powered on is"]
fn key_off_is_not_powered_on() {
    let mut drive = beginning(4);
    drive.bus.inputs.key = known(Key::Off);
    drive.bus.vacant();
    drive.run(2_500, 10);
    assert!(!outputs(&mut drive).warnings.seat_leave, "SEAT-0b by the key");
}
