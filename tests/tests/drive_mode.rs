//! Drive torque of ADAS and `EPBi`, and the driver against them (TRQ-2 to TRQ-4).

mod common;
use common::*;

const FAST: SpeedKmhQ8 = kmh(50);

/// The torque that a request gets in the long run: the ramp has run out.
fn settled(bus: &mut Bus, torque: u8) -> Decision {
    bus.ask_torque(torque);
    bus.run_for(1_000)
}

/// ADAS drives with this torque in the automated mode.
fn cruising(torque: u8) -> Bus {
    let mut bus = Bus::automated(FAST);
    bus.ask_adas(torque);
    assert_eq!(bus.run_for(1_000).outputs.drive.torque, percent(torque));
    bus
}

// TRQ-2.

/// TRQ-2a: ADAS and `EPBi` torque counts only with its active flag.
#[test]
fn automated_torque_counts_only_with_its_active_flag() {
    for origin in [Origin::Adas, Origin::Epbi] {
        for active in [false, true] {
            let by_epbi = origin == Origin::Epbi;
            let mut bus = if by_epbi { Bus::automated_by_epbi(FAST) } else { Bus::automated(FAST) };
            bus.commands.drive = Command::Fresh(DriveTorque { torque: percent(10), active, origin });
            let decision = bus.run_for(1_000);
            assert_eq!(decision.outputs.drive.torque > Percent::ZERO, active, "{origin:?}");
            if active {
                assert_passed(&decision, Channel::DriveTorque);
            } else {
                assert_verdict(&decision, Channel::DriveTorque, Kind::Block, Reason::NotActive);
                assert_eq!(decision.outputs.drive, DriveTorque::NEUTRAL, "CMD-3b");
            }
        }
    }
}

/// TRQ-2a, SELF-2b: an active ADAS that asks for no torque passes: coasting is no intervention.
#[test]
fn an_active_adas_without_torque_passes() {
    for torque in [0, 1, 5, 60] {
        let mut bus = cruising(10);
        bus.ask_adas(torque);
        let decision = bus.run_for(1_000);
        assert_passed(&decision, Channel::DriveTorque);
        assert!(decision.outputs.drive.active);
    }
}

/// TRQ-2b, MODE-1a, CMD-7a: without driver evidence no ADAS torque, whatever the frame claims.
#[test]
fn without_driver_evidence_there_is_no_automated_torque() {
    let steps: [Change; 6] = [
        ("no switch", |bus| bus.inputs.driver_set = known(true)),
        ("no set", |bus| bus.inputs.cruise_switch = known(true)),
        ("switch unknown", |bus| {
            bus.inputs.driver_set = known(true);
            bus.inputs.cruise_switch = unknown(Cause::Stale);
        }),
        ("set unknown", |bus| {
            bus.inputs.driver_set = unknown(Cause::Stale);
            bus.inputs.cruise_switch = known(true);
        }),
        ("seat not confirmed", |bus| {
            bus.inputs.driver_set = known(true);
            bus.inputs.cruise_switch = known(true);
            bus.inputs.seat[0] = unknown(Cause::Stale);
        }),
        ("ADS not ready", |bus| {
            bus.inputs.driver_set = known(true);
            bus.inputs.cruise_switch = known(true);
            bus.inputs.ads = known(AdsState::Standby);
        }),
    ];
    for (name, prepare) in steps {
        let mut bus = Bus::driving(FAST);
        bus.inputs.ads = known(AdsState::Active);
        bus.step();
        prepare(&mut bus);
        bus.commands.mode = Command::Fresh(DrivingMode::Automated);
        bus.ask_adas(10);
        let decision = bus.run_for(1_000);
        assert_eq!(decision.outputs.drive, DriveTorque::NEUTRAL, "{name}");
        assert_verdict(&decision, Channel::DriveTorque, Kind::Block, Reason::ModeNotGranted);
        assert_verdict(&decision, Channel::Mode, Kind::Block, Reason::ModeNotGranted);
    }
}

/// TRQ-2b, SELF-2a: the whole output vector: no automated torque beside a mode that goes out as manual.
#[test]
fn there_is_no_automated_torque_in_the_cycle_that_ends_the_mode() {
    for command in [
        Command::Fresh(DrivingMode::Manual),
        Command::Absent,
        Command::Rejected(Rejection::Form),
        Command::Held(Millis::new(501), DrivingMode::Automated),
    ] {
        let mut bus = cruising(10);
        bus.commands.mode = command;
        let outputs = bus.step().outputs;
        assert_eq!((outputs.mode, outputs.drive.torque), (DrivingMode::Manual, Percent::ZERO), "{command:?}");
    }
}

/// TRQ-2c: with perception unknown no ADAS torque, in that cycle.
#[test]
fn with_perception_unknown_there_is_no_automated_torque() {
    let mut bus = cruising(10);
    bus.perception_unknown();
    let decision = bus.step();
    assert_eq!(decision.outputs.drive.torque, Percent::ZERO);
    assert_refused(&decision, Channel::DriveTorque);
}

/// TRQ-2d: while an obligation runs no ADAS torque.
#[test]
fn while_an_obligation_runs_there_is_no_automated_torque() {
    let mut bus = cruising(10);
    bus.ahead(object(4_399, 1_000));
    assert_verdict(&bus.step(), Channel::DriveTorque, Kind::Block, Reason::Mitigation);
    let mut bus = cruising(10);
    bus.vacant();
    assert_verdict(&bus.run_for(2_010), Channel::DriveTorque, Kind::Block, Reason::Leave);
}

/// TRQ-2e: our own acceleration bound, 60 %.
#[test]
fn automated_torque_has_our_own_bound() {
    let mut bus = Bus::automated(FAST);
    for (torque, granted) in [(60, 60), (61, 60), (100, 60), (255, 60)] {
        bus.ask_adas(torque);
        let decision = bus.run_for(1_000);
        assert_eq!(decision.outputs.drive.torque, percent(granted));
        if torque > 60 {
            assert_verdict(&decision, Channel::DriveTorque, Kind::Limit, Reason::AccelerationBound);
        }
    }
}

// TRQ-3.

/// TRQ-3a, TRQ-3b, TRQ-3c: the brake pedal, pressed or unknown, ends torque, comfort braking and mode at once.
#[test]
fn the_brake_pedal_ends_all_of_the_automated_control() {
    let presses: [Change; 5] = [
        ("pressed", |bus| bus.brake_pedal(travel(10))),
        ("switch", |bus| bus.inputs.brake_switch = known(true)),
        ("switch unknown", |bus| bus.inputs.brake_switch = unknown(Cause::Stale)),
        ("tracks unknown", |bus| bus.inputs.brake_pedal = [unknown(Cause::Stale); 2]),
        ("tracks disagree", |bus| bus.inputs.brake_pedal = [known(travel_bits(0)), known(travel_bits(14))]),
    ];
    for (name, press) in presses {
        let mut bus = cruising(10);
        press(&mut bus);
        let decision = bus.step();
        assert_eq!(decision.outputs.drive.torque, Percent::ZERO, "{name}");
        assert_eq!((decision.status.mode, decision.status.exit), (Mode::Manual, ExitReason::BrakePedal), "{name}");
        assert_eq!(decision.outputs.mode, DrivingMode::Manual);
    }
    let mut bus = Bus::automated(FAST);
    bus.ask_brake(ms2(300));
    assert_passed(&bus.step(), Channel::ServiceBrake);
    bus.inputs.brake_switch = unknown(Cause::Stale);
    let decision = bus.step();
    assert!(decision.outputs.brake.total <= ms2(100), "TRQ-3b: but for the drag");
    assert_verdict(&decision, Channel::ServiceBrake, Kind::Limit, Reason::BrakePedal);
}

/// TRQ-3b: mitigation is not comfort braking: with an object within 6 s a request passes with the pedal pressed.
#[test]
fn mitigation_is_not_ended_by_the_brake_pedal() {
    let mut bus = Bus::automated(FAST);
    bus.ahead(object(5_900, 1_000));
    bus.brake_pedal(travel(10));
    bus.ask_brake(ms2(300));
    assert_passed(&bus.step(), Channel::ServiceBrake);
}

/// TRQ-3c: the mode needs new driver evidence: a "set" that was there all the time is none.
#[test]
fn the_mode_needs_new_driver_evidence() {
    let ends: [(&str, Edit, Edit); 4] = [
        ("brake pedal", |bus| bus.brake_pedal(travel(10)), |bus| bus.brake_pedal(travel(0))),
        (
            "pedal unknown",
            |bus| bus.inputs.brake_switch = unknown(Cause::Stale),
            |bus| bus.inputs.brake_switch = known(false),
        ),
        ("perception", Bus::perception_unknown, Bus::road_clear),
        ("ADS", |bus| bus.inputs.ads = known(AdsState::Failed), |bus| bus.inputs.ads = known(AdsState::Ready)),
    ];
    for (name, begin, end) in ends {
        let mut bus = cruising(10);
        bus.inputs.driver_set = known(true); // held, stuck, or a status instead of a button
        bus.step();
        begin(&mut bus);
        assert_eq!(bus.step().status.mode, Mode::Manual, "{name}");
        end(&mut bus);
        bus.run_with(2_000, 10, |decision| {
            assert_eq!(decision.status.mode, Mode::Manual, "{name}");
            assert_eq!(decision.outputs.drive.torque, Percent::ZERO, "{name}");
        });
        bus.inputs.driver_set = known(false);
        bus.step();
        bus.inputs.driver_set = known(true);
        bus.step();
        assert_eq!(bus.step().status.mode, Mode::Automated, "{name}: set anew");
    }
}

/// TRQ-3c, MODE-1a: a "set" that has been there since boot is no new evidence either.
#[test]
fn a_set_that_has_been_there_since_boot_is_no_evidence() {
    let mut bus = Bus::driving(FAST);
    bus.inputs.cruise_switch = known(true);
    bus.inputs.ads = known(AdsState::Ready);
    bus.inputs.driver_set = known(true);
    let mut bus = bus.reset(ResetCause::PowerOn);
    bus.commands.mode = Command::Fresh(DrivingMode::Automated);
    bus.run_with(5_000, 50, |decision| assert_eq!(decision.outputs.mode, DrivingMode::Manual));
    bus.inputs.driver_set = known(false);
    bus.step();
    bus.inputs.driver_set = known(true);
    assert_passed(&bus.step(), Channel::Mode);
}

// TRQ-4.

/// TRQ-4a: without ADAS torque an accelerator beyond 8 % overrides, to the bit.
#[test]
fn without_adas_torque_the_accelerator_overrides_beyond_min_torq() {
    for (bits, mode) in [(0, Mode::Automated), (20, Mode::Automated), (21, Mode::Suspended), (250, Mode::Suspended)] {
        let mut bus = Bus::automated(FAST);
        bus.accelerator(travel_bits(bits));
        bus.step();
        assert_eq!(bus.step().status.mode, mode, "{bits}");
    }
}

/// TRQ-4b, TRQ-4d: with ADAS torque the pedal overrides beyond torque + 10 %, to the bit; below that the last decision stays.
#[test]
fn with_adas_torque_the_accelerator_overrides_beyond_torque_and_offset() {
    // 30 % torque: 40 % pedal = 100 bits.
    for (bits, mode) in [(75, Mode::Automated), (100, Mode::Automated), (101, Mode::Suspended)] {
        let mut bus = cruising(30);
        bus.accelerator(travel_bits(bits));
        assert_eq!(bus.run_for(100).status.mode, mode, "{bits}");
    }
}

/// TRQ-4a, TRQ-2a: torque without its active flag, and the driver's own, is no ADAS torque: the least override torque decides.
#[test]
fn torque_that_does_not_count_does_not_raise_the_override() {
    for (active, origin) in [(false, Origin::Adas), (false, Origin::Epbi), (true, Origin::Driver)] {
        let mut bus = Bus::automated(FAST);
        bus.commands.drive = Command::Fresh(DriveTorque { torque: percent(50), active, origin });
        bus.run_for(100);
        bus.accelerator(travel_bits(21));
        bus.step();
        assert_eq!(bus.step().status.mode, Mode::Suspended, "{origin:?} {active}");
    }
    // What ADAS asks for counts up to our own bound: it cannot lock the driver out.
    let mut bus = Bus::automated(FAST);
    bus.ask_adas(100);
    bus.run_for(1_000);
    bus.accelerator(travel(72)); // 60 + 10 < 72
    assert_eq!(bus.run_for(50).status.mode, Mode::Suspended);
}

/// TRQ-4c, TRQ-4d: an override ends below the torque that ADAS asks for, and stays between.
#[test]
fn an_override_ends_below_the_adas_torque() {
    let mut bus = cruising(30);
    bus.accelerator(travel_bits(101));
    assert_eq!(bus.run_for(100).status.mode, Mode::Suspended);
    for (bits, mode) in [(100, Mode::Suspended), (75, Mode::Suspended), (74, Mode::Automated)] {
        bus.accelerator(travel_bits(bits));
        assert_eq!(bus.run_for(100).status.mode, mode, "{bits} bits of 0.4 % against 30 %");
    }
}

/// TRQ-4e, TRQ-4f, TRQ-4g, MODE-1d: an override suspends: the pedal governs, comfort braking is 0, the mode comes back.
#[test]
fn an_override_suspends_the_mode() {
    let mut bus = cruising(30);
    bus.accelerator(travel(60));
    bus.run_for(100);
    bus.ask_adas(30);
    let decision = bus.step();
    assert_eq!(decision.outputs.mode, DrivingMode::Automated, "suspended, not ended");
    assert!(decision.outputs.drive.torque <= percent(65), "TRQ-4f: whoever asks, the pedal is the bound");
    bus.ask_brake(ms2(100));
    let decision = bus.step();
    assert_eq!(decision.outputs.brake.total, ms2(0));
    assert_verdict(&decision, Channel::ServiceBrake, Kind::Limit, Reason::DriverOverride);
    bus.ask_brake(ms2(0));
    let decision = settled(&mut bus, 60);
    assert_passed(&decision, Channel::DriveTorque);
    bus.accelerator(travel(0));
    bus.ask_adas(30);
    bus.run_for(50);
    assert_eq!(bus.step().status.mode, Mode::Automated);
}

/// TRQ-4f, TRQ-1a: while overridden no torque of any origin goes beyond the accelerator.
#[test]
fn while_overridden_the_accelerator_is_the_bound_for_everybody() {
    for bits in [21, 50, 100, 150] {
        let mut bus = Bus::automated(FAST);
        bus.accelerator(travel_bits(bits));
        for torque in 0..=100 {
            bus.ask_adas(torque);
            let decision = bus.run_for(50);
            if decision.status.mode == Mode::Suspended {
                let mapped = u8::try_from(u16::from(bits) * 2 / 5).unwrap_or(0);
                assert!(decision.outputs.drive.torque <= percent(mapped + 5), "{bits} {torque}");
            }
        }
    }
}

/// TRQ-4g, RULE-3b: while overridden, mitigation stays permitted.
#[test]
fn while_overridden_mitigation_stays_permitted() {
    let mut bus = cruising(30);
    bus.accelerator(travel(60));
    bus.run_for(100);
    bus.ahead(object(5_900, 1_000));
    bus.ask_brake(ms2(300));
    assert_passed(&bus.step(), Channel::ServiceBrake);
}

/// TRQ-4h, R-f: neither a level nor leave is overridden.
#[test]
fn neither_a_level_nor_leave_is_overridden() {
    let mut bus = cruising(10);
    bus.ahead(object(2_700, 1_000));
    bus.step();
    bus.accelerator(travel(100));
    let decision = bus.run_for(500);
    assert_eq!(decision.outputs.brake.total, ms2(500));
    assert_ne!(decision.status.mode, Mode::Suspended);
    let mut bus = Bus::leave(FAST);
    bus.accelerator(travel(100));
    assert_eq!(bus.run_for(500).outputs.brake.total, ms2(195));
}

/// MODE-1b, TRQ-1b: an unknown accelerator keeps no override: the mode ends and no torque goes out.
#[test]
fn an_unknown_accelerator_ends_the_mode() {
    let mut bus = cruising(10);
    bus.inputs.accelerator[0] = unknown(Cause::Stale);
    let decision = bus.step();
    assert_eq!((decision.status.mode, decision.status.exit), (Mode::Manual, ExitReason::InputLost));
    assert_eq!(decision.outputs.drive.torque, Percent::ZERO);
}
