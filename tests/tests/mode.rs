//! Mode and body (MODE-1, BODY-1).

mod common;
use common::*;

const FAST: SpeedKmhQ8 = kmh(50);

/// MODE-1b, MODE-1c, MODE-1e, MODE-1f: what ends the mode, in the cycle, and the reason that is reported.
#[test]
fn the_mode_ends_with_its_reason() {
    let ends: [(&str, Edit, ExitReason); 18] = [
        ("brake pedal", |bus| bus.brake_pedal(travel(10)), ExitReason::BrakePedal),
        ("brake pedal unknown", |bus| bus.inputs.brake_switch = unknown(Cause::Stale), ExitReason::BrakePedal),
        ("switch off", |bus| bus.inputs.cruise_switch = known(false), ExitReason::Switch),
        ("switch unknown", |bus| bus.inputs.cruise_switch = unknown(Cause::Stale), ExitReason::Switch),
        ("ADS standby", |bus| bus.inputs.ads = known(AdsState::Standby), ExitReason::AdsState),
        ("ADS failed", |bus| bus.inputs.ads = known(AdsState::Failed), ExitReason::AdsState),
        ("ADS unknown", |bus| bus.inputs.ads = unknown(Cause::EndToEnd), ExitReason::AdsState),
        ("radar", |bus| bus.scene.radar_known = false, ExitReason::InputLost),
        ("camera", |bus| bus.scene.camera_known = false, ExitReason::InputLost),
        ("wheel speed", |bus| bus.inputs.wheel_speed = unknown(Cause::Stale), ExitReason::InputLost),
        ("motor speed", |bus| bus.inputs.motor_speed = unknown(Cause::Stale), ExitReason::InputLost),
        ("speeds disagree", |bus| bus.speeds(kmh(40), kmh(50)), ExitReason::InputLost),
        ("accelerator", |bus| bus.inputs.accelerator[1] = unknown(Cause::Stale), ExitReason::InputLost),
        ("accelerator disagrees", |bus| bus.inputs.accelerator[1] = known(travel_bits(14)), ExitReason::InputLost),
        ("accelerator impossible", |bus| bus.inputs.accelerator = [known(travel_bits(251)); 2], ExitReason::InputLost),
        ("asked for", |bus| bus.commands.mode = Command::Fresh(DrivingMode::Manual), ExitReason::Requested),
        (
            "two at once",
            |bus| {
                bus.brake_pedal(travel(10));
                bus.inputs.cruise_switch = known(false);
            },
            ExitReason::BrakePedal,
        ),
        ("all of it", |bus| bus.inputs = Inputs::NEVER, ExitReason::BrakePedal),
    ];
    for (name, end, reason) in ends {
        let mut bus = Bus::automated(FAST);
        assert_eq!(bus.step().status.exit, ExitReason::None);
        end(&mut bus);
        let decision = bus.step();
        assert_eq!((decision.status.mode, decision.status.exit), (Mode::Manual, reason), "{name}");
        assert_eq!(decision.outputs.mode, DrivingMode::Manual, "{name}");
        // What the driver did not do himself is shown.
        if matches!(reason, ExitReason::AdsState | ExitReason::InputLost) {
            assert!(decision.outputs.warnings.notice_lamp, "{name}: shown");
        }
    }
    let mut bus = Bus::automated(FAST);
    bus.vacant();
    bus.run_for(2_010);
    assert_eq!(bus.step().status.exit, ExitReason::Leave);
    let mut bus = Bus::automated(FAST);
    assert_eq!(bus.step_by(51).status.exit, ExitReason::Fault);
}

/// MODE-1b, MODE-1c: the mode does not begin while anything that would end it holds.
#[test]
fn the_mode_does_not_begin_with_anything_missing() {
    let missing: [Change; 9] = [
        ("nothing", |_| {}),
        ("brake pedal", |bus| bus.brake_pedal(travel(10))),
        ("switch", |bus| bus.inputs.cruise_switch = known(false)),
        ("ADS", |bus| bus.inputs.ads = known(AdsState::Standby)),
        ("perception", Bus::perception_unknown),
        ("speed", Bus::speed_unknown),
        ("accelerator", |bus| bus.inputs.accelerator[0] = unknown(Cause::Stale)),
        ("seat", |bus| bus.inputs.seat[0] = known(Seat::Vacant)),
        ("mitigation", |bus| bus.ahead(object(4_399, 1_000))),
    ];
    for (name, lose) in missing {
        let mut bus = Bus::driving(FAST);
        bus.inputs.cruise_switch = known(true);
        bus.inputs.ads = known(AdsState::Ready);
        bus.step();
        lose(&mut bus);
        bus.inputs.driver_set = known(true);
        bus.commands.mode = Command::Fresh(DrivingMode::Automated);
        let decision = bus.step();
        assert_eq!(decision.verdicts.of(Channel::Mode).passed(), name == "nothing", "{name}");
    }
}

/// MODE-1d: an override suspends the mode and does not end it (see also drive.rs).
#[test]
fn an_override_does_not_end_the_mode() {
    let mut bus = Bus::automated(FAST);
    bus.accelerator(travel(50));
    bus.run_with(10_000, 50, |decision| {
        assert_ne!(decision.status.mode, Mode::Manual);
        assert_eq!(decision.status.exit, ExitReason::None);
    });
}

/// RULE-3a: manual, the safe direction, passes always.
#[test]
fn manual_passes_always() {
    for mut bus in [Bus::driving(FAST), Bus::automated(FAST), Bus::leave(FAST), Bus::parked_by_leave()] {
        bus.commands.mode = Command::Fresh(DrivingMode::Manual);
        assert_passed(&bus.step(), Channel::Mode);
    }
}

// Body.

/// BODY-1a: brake lamps from 0.7 m/s² of the total, service brake and retarder together.
#[test]
fn brake_lamps_go_on_from_0_7() {
    for (total, retarder, lamps) in
        [(70, 0, true), (69, 0, false), (0, 0, false), (50, 14, true), (50, 10, false), (0, 47, true), (350, 0, true)]
    {
        let mut bus = Bus::driving(FAST);
        bus.ask_brake(ms2(total));
        bus.commands.retarder =
            Command::Fresh(Retarder { torque: percent(retarder), mode: RetarderMode::Torque, priority: Priority::Low });
        let decision = bus.step();
        assert_eq!(decision.outputs.body.brake_lamps, lamps, "{total} {retarder}");
        if lamps {
            assert_verdict(&decision, Channel::Body, Kind::Substitute, Reason::BrakeLamps);
        }
    }
}

/// BODY-1b: with every obligation, however small.
#[test]
fn brake_lamps_go_on_with_every_obligation() {
    let mut bus = Bus::leave(kmh(1));
    bus.inputs.epb = known(EpbState::Applied);
    for raw in [1, 10, 76] {
        bus.speed(kmh_q8(raw));
        let decision = bus.step();
        assert!(decision.outputs.brake.total > ms2(0) && decision.outputs.body.brake_lamps, "{raw}");
    }
}

/// BODY-1c: they go off 0.3 s after the last reason; and stay on as long as the main controller wants them.
#[test]
fn brake_lamps_go_off_0_3_s_later() {
    let mut bus = Bus::driving(FAST);
    bus.ask_brake(ms2(100));
    bus.run_for(1_000);
    bus.ask_brake(ms2(0));
    let off = bus.time_until(10, 2_000, |decision| !decision.outputs.body.brake_lamps);
    assert_eq!(off, Some(300), "0.3 s after the last cycle with a reason has ended");
    bus.commands.body = Command::Fresh(Body { brake_lamps: true, ..Body::NEUTRAL });
    bus.run_with(5_000, 50, |decision| {
        assert!(decision.outputs.body.brake_lamps);
        assert_passed(decision, Channel::Body);
    });
}
