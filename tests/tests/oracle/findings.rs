//! What the oracle found, each in the drive that shows it: two where the supervisor was wrong, and the readings in which the letter
//! of one row gives way to another (`readings.toml`).

use super::read::braking_out;
use super::starts::beginning;
use super::trace::Recorder;
use crate::common::*;

/// The comfort cap, 3.5 m/s².
const COMFORT: i64 = 7_168;

fn outputs(drive: &mut Recorder) -> Outputs {
    drive.step();
    drive.trace.cycles.last().map_or(Outputs::NEUTRAL, |cycle| cycle.outputs)
}

/// PHB-1a, PHB-1b: level 1 with its object at 5 s is no emergency: it permitted 6 m/s² before.
#[test]
fn a_level_below_three_keeps_the_comfort_cap() {
    let mut drive = beginning(4);
    drive.bus.ahead(at(4_399));
    assert_eq!(outputs(&mut drive).brake.total, ms2(100), "level 1 has begun");
    drive.bus.ahead(at(5_000));
    drive.run(1_000, 10);
    drive.bus.ask_brake(ms2(500));
    assert!(braking_out(&outputs(&mut drive)) <= COMFORT, "PHB-1a");
}

/// PHB-1a, PHB-1b: nor is an object at 4.0 s while the driver steers by 65 degrees and no level runs.
#[test]
fn an_object_beyond_the_emergency_keeps_the_comfort_cap() {
    let mut drive = beginning(4);
    drive.bus.inputs.steering_angle = known(angle(650));
    drive.bus.ahead(at(4_000));
    drive.bus.ask_brake(ms2(500));
    assert!(braking_out(&outputs(&mut drive)) <= COMFORT, "PHB-1a");
}

/// PHB-1b, MIT-6d, R-aa: what was an emergency permits 6 m/s² until nothing closes for 0.5 s.
#[test]
fn an_emergency_permits_until_nothing_closes() {
    let mut drive = beginning(4);
    drive.bus.inputs.steering_angle = known(angle(850));
    drive.bus.ahead(at(3_200));
    drive.run(100, 10);
    drive.bus.ahead(object(1_500, 100));
    drive.run(1_000, 10);
    drive.bus.ask_brake(ms2(500));
    assert_eq!(outputs(&mut drive).brake.total, ms2(500), "it still closes");
    drive.bus.ahead(object(1_500, 0));
    drive.run(600, 10);
    drive.bus.ask_brake(ms2(500));
    assert!(braking_out(&outputs(&mut drive)) <= COMFORT, "PHB-1a");
}

/// E2E-2d, E2E-2e, E2E-2f, R-ab: a lost brake command warns in the next cycle, and ends the mode when its hold of 500 ms is over.
#[test]
fn a_lost_brake_command_warns_and_then_ends_the_mode() {
    let mut drive = beginning(6);
    drive.bus.ask_adas(20);
    drive.run(200, 10);
    drive.bus.commands.brake = Command::Absent;
    let first = outputs(&mut drive);
    assert!(!first.warnings.fault_lamp && first.mode == DrivingMode::Automated, "held");
    assert!(outputs(&mut drive).warnings.fault_lamp, "E2E-2e");
    drive.run(480, 10);
    assert_eq!(outputs(&mut drive).mode, DrivingMode::Automated, "held for 500 ms");
    drive.run(20, 10);
    let last = outputs(&mut drive);
    assert_eq!((last.mode, last.drive.torque), (DrivingMode::Manual, Percent::ZERO), "E2E-2f, TRQ-2b");
}

/// GEAR-1c, RULE-3a, R-ac: with unknown speed no driving gear is engaged; N takes the drive away and passes.
#[test]
fn unknown_speed_lets_the_drive_be_taken_away() {
    let mut drive = beginning(4);
    drive.bus.speed_unknown();
    drive.bus.ask_gear(GearRequest::Reverse);
    assert_eq!(outputs(&mut drive).gear, GearRequest::Hold, "GEAR-1c");
    drive.bus.ask_gear(GearRequest::Neutral);
    assert_eq!(outputs(&mut drive).gear, GearRequest::Neutral, "RULE-3a");
}

/// SEAT-7b, SEAT-7i, R-ad: with the speed unknown nothing asks a contactor to move: K4, commanded open before, holds.
#[test]
fn k4_that_was_commanded_open_holds_without_a_speed() {
    let mut drive = beginning(12);
    assert_eq!(outputs(&mut drive).contactors.k4, ContactorRequest::Open);
    drive.bus.speed_unknown();
    assert_eq!(outputs(&mut drive).contactors.k4, ContactorRequest::Hold, "SEAT-7b, RULE-4b");
}

/// SEAT-0b, R-ae: a bus that rolls without its driver is left, whatever the key says.
#[test]
fn the_key_does_not_take_the_protection_away() {
    let mut drive = beginning(4);
    drive.bus.inputs.key = known(Key::Off);
    drive.bus.vacant();
    drive.run(2_500, 10);
    assert!(outputs(&mut drive).warnings.seat_leave, "SEAT-0b");
}
