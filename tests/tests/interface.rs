//! Lost commands and verdicts (E2E-2, CMD-2, CMD-3, CMD-5).

mod common;
use common::*;

const FAST: SpeedKmhQ8 = kmh(50);

// E2E-2.

/// E2E-2a: a drive command older than 125 ms, absent or rejected, is no torque in that cycle.
#[test]
fn a_lost_drive_command_is_no_torque() {
    let mut bus = Bus::driving(FAST);
    bus.accelerator(travel(50));
    bus.ask_torque(30);
    bus.run_for(1_000);
    for (command, torque) in [
        (Command::Held(Millis::new(0), driver_torque(30)), 30),
        (Command::Held(Millis::new(125), driver_torque(30)), 30),
        (Command::Held(Millis::new(126), driver_torque(30)), 0),
        (Command::Held(Millis::new(u32::MAX), driver_torque(30)), 0),
        (Command::Absent, 0),
        (Command::Rejected(Rejection::Counter), 0),
    ] {
        let mut bus = bus.clone();
        bus.commands.drive = command;
        let decision = bus.step();
        assert_eq!(decision.outputs.drive.torque, percent(torque), "{command:?}");
        if torque == 0 {
            let reason =
                if matches!(command, Command::Rejected(_)) { Reason::CommandRejected } else { Reason::CommandLost };
            assert_verdict(&decision, Channel::DriveTorque, Kind::Block, reason);
        }
    }
}

/// E2E-2b: a lost gear command holds the gear.
#[test]
fn a_lost_gear_command_holds_the_gear() {
    let mut bus = Bus::driving(kmh(0));
    bus.inputs.selector = known(Gear::Reverse);
    for (command, gear) in [
        (Command::Held(Millis::new(250), GearRequest::Reverse), GearRequest::Reverse),
        (Command::Held(Millis::new(251), GearRequest::Reverse), GearRequest::Hold),
        (Command::Absent, GearRequest::Hold),
        (Command::Rejected(Rejection::Checksum), GearRequest::Hold),
    ] {
        bus.commands.gear = command;
        assert_eq!(bus.step().outputs.gear, gear, "{command:?}");
    }
}

/// E2E-2c, E2E-2d: a lost brake request holds for at most 500 ms, then falls by 2 m/s³ to 0, never faster.
#[test]
fn a_lost_brake_request_holds_and_then_ramps_to_zero() {
    for command in
        [Command::Absent, Command::Rejected(Rejection::Checksum), Command::Held(Millis::new(126), braking(ms2(600)))]
    {
        let mut bus = Bus::driving(FAST);
        bus.ask_brake(ms2(300));
        bus.step();
        bus.commands.brake = command;
        let mut before = ms2(300);
        for time in (0..3_000).step_by(10) {
            let total = bus.step().outputs.brake.total;
            assert!(total <= before, "{time}: never more than the last request");
            if time <= 480 {
                assert_eq!(total, ms2(300), "{time}: held");
            }
            if time > 510 {
                assert!(total < ms2(300), "{time}: at most 500 ms");
                let fallen = u32::from(before.raw() - total.raw());
                assert!(
                    (40..=41).contains(&fallen) || total.raw() == 0,
                    "{time}: 2 m/s³ are 41 bits per cycle: {fallen}"
                );
            }
            before = total;
        }
        assert_eq!(before, ms2(0), "{command:?}");
    }
}

/// E2E-2c: a request that comes back counts at once, and the 500 ms begin again with the next loss.
#[test]
fn a_brake_request_that_comes_back_counts_at_once() {
    let mut bus = Bus::driving(FAST);
    bus.ask_brake(ms2(300));
    bus.step();
    bus.commands.brake = Command::Absent;
    bus.run_for(1_000);
    bus.ask_brake(ms2(200));
    assert_passed(&bus.step(), Channel::ServiceBrake);
    bus.commands.brake = Command::Absent;
    assert_eq!(bus.run_for(480).outputs.brake.total, ms2(200));
}

/// E2E-2c, SELF-2a: with an obligation the loss changes nothing of it.
#[test]
fn a_lost_brake_request_does_not_weaken_an_obligation() {
    let mut bus = Bus::leave(FAST);
    bus.ask_brake(ms2(300));
    bus.step();
    bus.commands.brake = Command::Absent;
    bus.run_with(5_000, 10, |decision| assert!(decision.outputs.brake.total >= ms2(195)));
}

/// E2E-2e: a lost brake command warns the driver, in manual mode too, and as long as it lasts.
#[test]
fn a_lost_brake_command_warns_the_driver() {
    for mut bus in [Bus::driving(FAST), Bus::automated(FAST)] {
        let decision = bus.step();
        assert!(!decision.outputs.warnings.fault_lamp && !decision.outputs.warnings.notice_lamp);
        bus.commands.brake = Command::Held(Millis::new(126), braking(ms2(0)));
        bus.run_for(600);
        bus.run_with(5_000, 10, |decision| {
            let Warnings { fault_lamp, notice_lamp, .. } = decision.outputs.warnings;
            assert!(fault_lamp || notice_lamp);
            assert!(decision.status.faults.contains(Faults::BRAKE_COMMAND_LOST));
        });
    }
}

/// E2E-2f: a lost brake command ends the mode, at the latest when the hold is over.
#[test]
fn a_lost_brake_command_ends_the_mode() {
    let mut bus = Bus::automated(FAST);
    bus.commands.brake = Command::Absent;
    let ended = bus.time_until(10, 2_000, |decision| decision.status.mode == Mode::Manual);
    assert!(matches!(ended, Some(0..=520)), "{ended:?}");
    assert_eq!(bus.step().status.exit, ExitReason::CommandLost);
}

/// E2E-2g: a lost parking-brake command is none, unless an obligation applies it.
#[test]
fn a_lost_parking_brake_command_is_none() {
    let apply = ParkingBrake { request: EpbRequest::Apply, mode: EpbMode::Automatic };
    let mut bus = Bus::driving(kmh(0));
    for (command, request) in [
        (Command::Held(Millis::new(500), apply), EpbRequest::Apply),
        (Command::Held(Millis::new(501), apply), EpbRequest::None),
        (Command::Absent, EpbRequest::None),
        (Command::Rejected(Rejection::Form), EpbRequest::None),
    ] {
        bus.commands.epb = command;
        assert_eq!(bus.step().outputs.epb.request, request, "{command:?}");
    }
    let mut bus = Bus::leave(kmh(1));
    bus.commands.epb = Command::Absent;
    assert_eq!(bus.step().outputs.epb.request, EpbRequest::Apply);
}

/// E2E-2h: lost contactor commands hold.
#[test]
fn lost_contactor_commands_hold() {
    let open = Contactors { k4: ContactorRequest::Open, k1: ContactorRequest::Hold };
    let mut bus = Bus::parked();
    for (command, k4) in [
        (Command::Held(Millis::new(250), open), ContactorRequest::Open),
        (Command::Held(Millis::new(251), open), ContactorRequest::Hold),
        (Command::Absent, ContactorRequest::Hold),
        (Command::Rejected(Rejection::Requalifying), ContactorRequest::Hold),
    ] {
        bus.commands.contactors = command;
        assert_eq!(bus.step().outputs.contactors.k4, k4, "{command:?}");
    }
}

/// E2E-2j: a lost body command keeps wipers, beams and indicators.
#[test]
fn a_lost_body_command_keeps_its_state() {
    let body = Body { wipers: Wiper::Fast, low_beam: true, high_beam: true, indicator_left: true, ..Body::NEUTRAL };
    let mut bus = Bus::driving(FAST);
    bus.commands.body = Command::Fresh(body);
    bus.step();
    for command in
        [Command::Held(Millis::new(501), Body::NEUTRAL), Command::Absent, Command::Rejected(Rejection::Field)]
    {
        bus.commands.body = command;
        assert_eq!(bus.run_for(10_000).outputs.body, body, "{command:?}");
    }
    bus.commands.body = Command::Held(Millis::new(500), Body::NEUTRAL);
    assert_eq!(bus.step().outputs.body, Body::NEUTRAL);
}

/// CMD-3a, CMD-3b, E2E-2a to E2E-2d, E2E-2g to E2E-2i: silence on every channel: neutral everywhere, auxiliaries on, nothing moves.
#[test]
fn silence_on_every_channel_is_neutral_everywhere() {
    for mut bus in [Bus::driving(FAST), Bus::parked(), Bus::automated(FAST)] {
        bus.commands = Commands::ABSENT;
        let outputs = bus.run_for(3_000).outputs;
        let Outputs { drive, target_speed, brake, retarder, gear, epb, contactors, auxiliaries, mode, .. } = outputs;
        assert_eq!((drive, target_speed, retarder), (DriveTorque::NEUTRAL, kmh(0), Retarder::NEUTRAL));
        assert_eq!((brake.total, brake.electric), (ms2(0), ms2(0)));
        assert_eq!((gear, epb.request, contactors), (GearRequest::Hold, EpbRequest::None, Contactors::NEUTRAL));
        assert_eq!((auxiliaries, mode), (Auxiliaries::NEUTRAL, DrivingMode::Manual));
        assert!(!outputs.steering.enable && outputs.steering.weight == Percent::ZERO);
    }
}

/// CMD-2e, RULE-5a: a rejected frame has no influence but its reason, whatever was rejected for whatever cause.
#[test]
fn a_rejected_frame_has_no_influence() {
    for rejection in Rejection::ALL {
        let mut absent = Bus::automated(FAST);
        let mut rejected = absent.clone();
        absent.commands = Commands::ABSENT;
        rejected.commands = Commands {
            drive: Command::Rejected(*rejection),
            target_speed: Command::Rejected(*rejection),
            brake: Command::Rejected(*rejection),
            retarder: Command::Rejected(*rejection),
            gear: Command::Rejected(*rejection),
            epb: Command::Rejected(*rejection),
            steering: Command::Rejected(*rejection),
            contactors: Command::Rejected(*rejection),
            auxiliaries: Command::Rejected(*rejection),
            warnings: Command::Rejected(*rejection),
            body: Command::Rejected(*rejection),
            mode: Command::Rejected(*rejection),
        };
        for _ in 0..200 {
            let (first, second) = (absent.step(), rejected.step());
            assert_eq!(first.outputs, second.outputs);
            for (channel, verdict) in second.verdicts.iter() {
                assert!(!verdict.passed(), "{channel:?}");
            }
        }
        assert_verdict(&rejected.step(), Channel::Gear, Kind::Block, Reason::CommandRejected);
        assert_verdict(&absent.step(), Channel::Gear, Kind::Block, Reason::CommandLost);
    }
}

/// CMD-1e: lane, speed-limit and headway warnings pass through, also while something else is obliged.
#[test]
fn the_other_warnings_pass_through() {
    let passing = Warnings { lane_departure: true, speed_limit: true, headway: true, ..Warnings::NEUTRAL };
    let mut bus = Bus::driving(FAST);
    bus.commands.warnings = Command::Fresh(passing);
    assert_passed(&bus.step(), Channel::Warnings);
    let mut bus = Bus::leave(FAST);
    bus.commands.warnings = Command::Fresh(passing);
    let Warnings { lane_departure, speed_limit, headway, .. } = bus.step().outputs.warnings;
    assert!(lane_departure && speed_limit && headway);
}

// Verdicts.

/// CMD-5b, CMD-5c, CMD-5d, CMD-5e: a limit says value, limit and margin, and goes to the limit.
#[test]
fn a_limit_says_value_limit_and_margin() {
    let mut bus = Bus::automated(kmh(30));
    bus.inputs.drive_limit = known(percent(20));
    bus.ask_adas(50);
    bus.run_for(1_000);
    bus.commands.target_speed = Command::Fresh(kmh_q8(20_000));
    bus.commands.steering = Command::Fresh(Steering { bar_limit: BarTorque50mNm::new(150), ..STEER });
    let decision = bus.run_for(1_100);
    let expected =
        [(Channel::DriveTorque, 50, 20), (Channel::TargetSpeed, 20_000, 15_360), (Channel::Steering, 150, 100)];
    for (channel, value, limit) in expected {
        let verdict = decision.verdicts.of(channel);
        assert_eq!(
            (verdict.kind, verdict.value, verdict.limit, verdict.margin),
            (Kind::Limit, value, limit, limit - value)
        );
    }
    bus.ask_brake(ms2(500));
    let verdict = bus.step().verdicts.of(Channel::ServiceBrake);
    assert_eq!((verdict.value, verdict.limit, verdict.margin), (10_240, 7_168, 7_168 - 10_240));
    bus.ask_brake(ms2(100));
    let verdict = bus.step().verdicts.of(Channel::ServiceBrake);
    assert_eq!((verdict.kind, verdict.margin), (Kind::Pass, 7_168 - 2_048), "a pass has a margin too");
}

/// CMD-5c: a substituted priority is explained by the priority, not by a mode that was right.
#[test]
fn a_substituted_priority_is_explained() {
    let mut bus = Bus::leave(FAST);
    bus.ask_brake(ms2(300)); // mode Maximum, priority Medium
    let verdict = bus.step().verdicts.of(Channel::ServiceBrake);
    assert_eq!((verdict.kind, verdict.reason), (Kind::Substitute, Reason::BrakeMode));
    assert_ne!(verdict.value, verdict.limit, "the offending value is not its own limit: {verdict:?}");
}
