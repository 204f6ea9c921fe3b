//! Driver out of seat: torque and brake in leave, and the two speeds (SEAT-2, SEAT-3, RULE-6, CMD-6).

mod common;
use common::*;

/// SEAT-2a: in leave no drive torque of any origin goes out, and the reason says so.
#[test]
fn in_leave_there_is_no_drive_torque() {
    for origin in Origin::ALL {
        for active in [false, true] {
            for torque in [1, 6, 50, 100, 255] {
                let mut bus = Bus::leave(kmh(30));
                bus.accelerator(travel(100));
                bus.commands.drive = Command::Fresh(DriveTorque { torque: percent(torque), active, origin: *origin });
                bus.run_with(500, 10, |decision| {
                    assert_eq!(decision.outputs.drive.torque, Percent::ZERO);
                    assert_refused(decision, Channel::DriveTorque);
                });
            }
        }
    }
    let mut bus = Bus::leave(kmh(30));
    bus.accelerator(travel(100));
    bus.ask_torque(10);
    assert_verdict(&bus.step(), Channel::DriveTorque, Kind::Limit, Reason::Leave);
}

/// SEAT-3a, SEAT-3b, SEAT-3c: every speed of 1/256 km/h: at least a₀(v), and not more than two bits beyond it.
#[test]
fn the_leave_brake_follows_table_1_at_every_speed() {
    let mut bus = Bus::leave(kmh(30));
    bus.inputs.epb = known(EpbState::Applied); // so that the table alone speaks below 2 km/h
    for raw in 0..=u16::MAX {
        bus.speed(kmh_q8(raw));
        let total = bus.step().outputs.brake.total;
        assert!(always::reaches_table_1(total, kmh_q8(raw)), "{raw}: {total:?}");
        let less = DecelMs2Q11::new(total.raw().saturating_sub(2));
        assert!(
            total.raw() < 2 || !always::reaches_table_1(less, kmh_q8(raw)),
            "{raw}: {total:?} is more than obliged"
        );
    }
}

/// SEAT-3a: the 16 points of table 1, in hundredths of a m/s².
#[test]
fn the_leave_brake_has_the_sixteen_points_of_table_1() {
    let points = [
        (2, 135),
        (4, 140),
        (6, 145),
        (8, 150),
        (10, 155),
        (15, 160),
        (20, 165),
        (25, 170),
        (30, 173),
        (35, 176),
        (40, 180),
        (45, 185),
        (50, 195),
        (55, 200),
        (60, 220),
        (61, 220),
        (255, 220),
    ];
    for (speed, hundredths) in points {
        let mut bus = Bus::leave(kmh(30));
        bus.speed(kmh(speed));
        assert_eq!(bus.step().outputs.brake.total, ms2(hundredths), "{speed} km/h");
    }
}

/// SEAT-3a, SELF-2a: a weaker request is raised, an equal or stronger one goes out (up to the cap).
#[test]
fn the_leave_brake_is_a_floor_for_the_request() {
    let floor = ms2(173); // 30 km/h
    let obliged = |total| ServiceBrake { priority: Priority::Highest, ..braking(total) };
    let mut bus = Bus::leave(kmh(30));
    bus.commands.brake = Command::Fresh(obliged(DecelMs2Q11::new(floor.raw() - 1)));
    let decision = bus.step();
    assert_eq!(decision.outputs.brake.total, floor);
    assert_verdict(&decision, Channel::ServiceBrake, Kind::Substitute, Reason::Leave);
    assert_eq!(decision.verdicts.of(Channel::ServiceBrake).margin, -1, "one bit short");
    for total in [floor, DecelMs2Q11::new(floor.raw() + 1), ms2(350)] {
        bus.commands.brake = Command::Fresh(obliged(total));
        let decision = bus.step();
        assert_eq!(decision.outputs.brake.total, total);
        assert_passed(&decision, Channel::ServiceBrake);
    }
    for lost in
        [Command::Absent, Command::Rejected(Rejection::Counter), Command::Held(Millis::new(126), braking(ms2(300)))]
    {
        let mut bus = Bus::leave(kmh(30));
        bus.commands.brake = lost;
        bus.run_with(2_000, 10, |decision| assert!(decision.outputs.brake.total >= floor, "{lost:?}"));
        assert_eq!(
            bus.step().outputs.brake.total,
            floor,
            "SELF-2a: a silent main controller is a command like any other"
        );
    }
}

/// CMD-6a, CMD-6b: the obligation carries its own mode and priority, in manual mode too.
#[test]
fn the_leave_brake_carries_its_own_mode_and_priority() {
    let mut bus = Bus::leave(kmh(30));
    for mode in BrakeMode::ALL {
        for priority in Priority::ALL {
            let total = ms2(300);
            bus.commands.brake =
                Command::Fresh(ServiceBrake { total, electric: DecelMs2Q11::ZERO, mode: *mode, priority: *priority });
            let brake = bus.step().outputs.brake;
            assert_eq!((brake.total, brake.mode, brake.priority), (total, BrakeMode::Maximum, Priority::Highest));
        }
    }
}

/// SEAT-3d: below 2 km/h 1.35 m/s² hold until the parking brake is confirmed applied.
#[test]
fn below_2_kmh_the_leave_brake_holds_until_the_parking_brake_is_confirmed() {
    for epb in [known(EpbState::Released), unknown(Cause::Stale), unknown(Cause::NotAvailable)] {
        for raw in [0, 1, 76, 77, 383, 384, 511] {
            let mut bus = Bus::leave(kmh(30));
            bus.inputs.epb = epb;
            bus.speed(kmh_q8(raw));
            bus.run_with(5_000, 50, |decision| assert_eq!(decision.outputs.brake.total, ms2(135), "{raw} {epb:?}"));
            bus.inputs.epb = known(EpbState::Applied);
            let total = bus.step().outputs.brake.total;
            assert!(total < ms2(135) && always::reaches_table_1(total, kmh_q8(raw)), "{raw}: {total:?}");
            bus.inputs.epb = epb;
            assert_eq!(bus.step().outputs.brake.total, ms2(135), "and again when it comes loose");
        }
    }
}

/// SEAT-3d: at the hold speed itself the table alone speaks, just below it the hold: told apart by a hold that is more than the table.
#[test]
fn the_hold_ends_at_its_speed() {
    let config = Config { leave_hold: ms2(250), ..Config::DEFAULT };
    let inputs = Bus::driving(kmh(30)).inputs;
    let mut bus = Bus::with_config(&config, ResetCause::PowerOn, Some(Record::None), inputs);
    bus.run_for(1_000);
    bus.vacant();
    assert!(in_leave(&bus.run_for(2_010)));
    for (raw, hundredths) in [(511, 250), (512, 135)] {
        bus.speed(kmh_q8(raw));
        assert_eq!(bus.step().outputs.brake.total, ms2(hundredths), "{raw}");
    }
}

/// SEAT-3e: unknown speed keeps the last demand, at least 1.35 m/s².
#[test]
fn with_unknown_speed_the_leave_brake_keeps_the_last_demand() {
    for (speed, hundredths) in [(kmh(60), 220), (kmh(30), 173), (kmh(2), 135), (kmh_q8(511), 135), (kmh(0), 135)] {
        let mut bus = Bus::leave(kmh(30));
        bus.speed(speed);
        bus.step();
        bus.speed_unknown();
        bus.run_with(60_000, 50, |decision| assert_eq!(decision.outputs.brake.total, ms2(hundredths), "{speed:?}"));
    }
    let mut bus = Bus::leave(kmh(0));
    bus.inputs.epb = known(EpbState::Applied);
    assert_eq!(bus.step().outputs.brake.total, DecelMs2Q11::ZERO);
    bus.speed_unknown();
    assert_eq!(bus.step().outputs.brake.total, ms2(135), "the last demand was none");
}

/// SEAT-3e, SEAT-1a: a leave that begins with unknown speed brakes with 1.35 m/s².
#[test]
fn a_leave_that_begins_without_speed_brakes() {
    let mut bus = Bus::driving(kmh(50));
    bus.speed_unknown();
    bus.vacant();
    let decision = bus.run_for(2_010);
    assert!(in_leave(&decision));
    assert_eq!(decision.outputs.brake.total, ms2(135));
}

/// RULE-6a: of two speeds that agree the lower one makes the demand.
#[test]
fn the_lower_speed_makes_the_demand() {
    let mut bus = Bus::leave(kmh(30));
    bus.speeds(kmh(50), kmh(52));
    assert_eq!(bus.step().outputs.brake.total, ms2(195));
    bus.inputs.wheel_speed = known(kmh(50));
    bus.inputs.motor_speed = known(kmh(52));
    assert_eq!(bus.step().outputs.brake.total, ms2(195), "whichever of them it is");
}

/// RULE-6c: the speeds agree within max(2 km/h, 5 %) and not a bit beyond.
#[test]
fn the_speeds_agree_within_2_kmh_or_5_percent() {
    // 5 % of the higher: 15 360 · 5 % = 768; at 10 240 both bounds are 512.
    let cases = [
        (0, 512, true),
        (0, 513, false),
        (9_727, 10_239, true),
        (9_726, 10_239, false),
        (14_592, 15_360, true),
        (14_591, 15_360, false),
        (62_259, 65_535, true),
        (62_258, 65_535, false),
    ];
    for (low, high, agree) in cases {
        for swapped in [false, true] {
            let mut bus = Bus::driving(kmh(30));
            bus.speeds(kmh_q8(low), kmh_q8(high));
            if swapped {
                (bus.inputs.wheel_speed, bus.inputs.motor_speed) = (bus.inputs.motor_speed, bus.inputs.wheel_speed);
            }
            let decision = bus.step();
            assert_eq!(!decision.status.faults.contains(Faults::SPEED_UNKNOWN), agree, "{low} {high}");
            assert_eq!(!decision.outputs.warnings.fault_lamp, agree, "{low} {high}");
        }
    }
}

/// RULE-1a, RULE-6c: either speed unknown, for any cause, makes the speed unknown.
#[test]
fn one_unknown_speed_makes_the_speed_unknown() {
    for cause in CAUSES {
        let mut bus = Bus::driving(kmh(30));
        bus.inputs.wheel_speed = unknown(*cause);
        assert!(bus.step().status.faults.contains(Faults::SPEED_UNKNOWN));
        let mut bus = Bus::driving(kmh(30));
        bus.inputs.motor_speed = unknown(*cause);
        assert!(bus.step().status.faults.contains(Faults::SPEED_UNKNOWN));
    }
}
