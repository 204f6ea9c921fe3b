//! High voltage: the ordinary key-off, and auxiliaries (HV-1, AUX-1).

mod common;
use common::*;

/// The driver sits, the bus stands, the key is off.
fn key_off() -> Bus {
    let mut bus = Bus::parked();
    bus.inputs.key = known(Key::Off);
    bus.run_for(1_000);
    bus
}

/// HV-1a: at standstill and without torque K4 opens as it is asked for; each missing guard holds it.
#[test]
fn an_ordinary_k4_opens_at_standstill_without_torque() {
    let mut bus = key_off();
    bus.ask_contactors(ContactorRequest::Open, ContactorRequest::Hold);
    assert_passed(&bus.step(), Channel::Contactors);
    for (name, lose) in K4_GUARDS {
        if name.starts_with("SEAT-7c") {
            continue; // the parking brake is a guard of the shutdown after leave
        }
        let mut bus = key_off();
        bus.ask_contactors(ContactorRequest::Open, ContactorRequest::Hold);
        lose(&mut bus);
        assert_refused(&bus.step(), Channel::Contactors);
        assert!(opens_nothing(&bus.step()), "{name}");
    }
}

/// HV-1a, SEAT-7d: no drive torque is at most the configured 1 %, to the per cent.
#[test]
fn no_drive_torque_is_at_most_the_configured_bound() {
    let bound = Config::DEFAULT.stopped_torque.raw();
    for (torque, passes) in [(0, true), (bound, true), (bound + 1, false), (100, false), (255, false)] {
        let mut bus = key_off();
        bus.inputs.executed_torque = known(percent(torque));
        bus.ask_contactors(ContactorRequest::Open, ContactorRequest::Hold);
        assert_eq!(bus.step().verdicts.of(Channel::Contactors).passed(), passes, "{torque}");
    }
}

/// HV-1a, SEAT-7d, RULE-3e: K4 does not open in a cycle that lets torque out.
#[test]
fn an_ordinary_k4_does_not_open_in_a_cycle_with_torque() {
    let mut bus = Bus::driving(kmh(0));
    bus.accelerator(travel(50));
    bus.ask_torque(1);
    bus.ask_contactors(ContactorRequest::Open, ContactorRequest::Hold);
    let decision = bus.step();
    assert!(!(opens_k4(&decision) && decision.outputs.drive.torque > Percent::ZERO));
    assert_verdict(&decision, Channel::Contactors, Kind::Block, Reason::LoadsNotStopped);
}

/// HV-1b: an ordinary K1 needs K4 confirmed open and the loads stopped.
#[test]
fn an_ordinary_k1_opens_after_k4_and_the_loads() {
    let mut bus = key_off();
    bus.loads_stopped();
    bus.ask_contactors(ContactorRequest::Hold, ContactorRequest::Open);
    for k4 in [CLOSED, MISSING] {
        bus.inputs.k4 = k4;
        assert_verdict(&bus.step(), Channel::Contactors, Kind::Block, Reason::K4NotOpen);
    }
    bus.inputs.k4 = OPEN;
    assert_passed(&bus.step(), Channel::Contactors);
    bus.loads_run();
    assert_verdict(&bus.step(), Channel::Contactors, Kind::Block, Reason::LoadsNotStopped);
    bus.loads_stopped();
    for rolling in [ROLLING, kmh(50)] {
        bus.speed(rolling);
        assert_verdict(&bus.step(), Channel::Contactors, Kind::Block, Reason::NotStandstill);
    }
    bus.speed_unknown();
    assert_verdict(&bus.step(), Channel::Contactors, Kind::Block, Reason::NotStandstill);
}

/// HV-1b, SEAT-7f: both at once: K4 opens, K1 waits for its confirmation.
#[test]
fn both_asked_for_at_once_open_one_after_the_other() {
    let mut bus = key_off();
    bus.loads_stopped();
    bus.ask_contactors(ContactorRequest::Open, ContactorRequest::Open);
    let decision = bus.step();
    assert!(opens_k4(&decision) && !opens_k1(&decision));
    bus.inputs.k4 = OPEN;
    assert_passed(&bus.step(), Channel::Contactors);
}

/// HV-1c: while rolling, or with unknown speed, nothing opens, in no situation and whatever is asked for.
#[test]
fn nothing_opens_while_rolling() {
    let situations =
        [Bus::driving(kmh(50)), Bus::automated(kmh(30)), Bus::leave(kmh(30)), Bus::opening_k4(), Bus::opening_k1()];
    for situation in situations {
        for speed in [Some(ROLLING), Some(KMH_1_5), Some(kmh(80)), None] {
            let mut bus = situation.clone();
            match speed {
                Some(speed) => bus.speed(speed),
                None => bus.speed_unknown(),
            }
            bus.loads_stopped();
            bus.inputs.k4 = OPEN;
            bus.ask_contactors(ContactorRequest::Open, ContactorRequest::Open);
            bus.run_with(1_000, 10, |decision| assert!(opens_nothing(decision), "{speed:?}"));
        }
    }
}

/// HV-1d: a contactor that drops out does not close again by itself, nor on request without the driver's keys.
#[test]
fn nothing_closes_by_itself() {
    for (k4, k1) in [(OPEN, CLOSED), (OPEN, OPEN), (CLOSED, OPEN), (MISSING, MISSING)] {
        let mut bus = Bus::parked();
        (bus.inputs.k4, bus.inputs.k1) = (k4, k1);
        bus.run_with(5_000, 50, |decision| assert_eq!(decision.outputs.contactors, Contactors::NEUTRAL));
    }
    let mut bus = Bus::driving(kmh(30)).reset(ResetCause::Watchdog);
    bus.run_for(3_000);
    (bus.inputs.k4, bus.inputs.k1) = (OPEN, OPEN);
    for (k4, k1) in [
        (ContactorRequest::Hold, ContactorRequest::Close),
        (ContactorRequest::Close, ContactorRequest::Hold),
        (ContactorRequest::Close, ContactorRequest::Close),
    ] {
        bus.ask_contactors(k4, k1);
        // Both have moved by themselves: a contactor fault is latched on top.
        assert_verdict(&bus.step(), Channel::Contactors, Kind::Block, Reason::ContactorFault);
        assert_eq!(bus.step().outputs.contactors, Contactors::NEUTRAL);
    }
}

/// AUX-1a, AUX-1b, AUX-1c: each auxiliary stays on while rolling or with unknown speed, and may go off at standstill.
#[test]
fn auxiliaries_stay_on_while_rolling() {
    let off: [Auxiliaries; 4] = [
        Auxiliaries { air_pump: false, ..Auxiliaries::NEUTRAL },
        Auxiliaries { power_steering: false, ..Auxiliaries::NEUTRAL },
        Auxiliaries { dc_dc: false, ..Auxiliaries::NEUTRAL },
        Auxiliaries { air_pump: false, power_steering: false, dc_dc: false },
    ];
    for request in off {
        for (speed, passes) in [
            (Some(kmh(0)), true),
            (Some(STANDSTILL), true),
            (Some(ROLLING), false),
            (Some(kmh(50)), false),
            (None, false),
        ] {
            let mut bus = Bus::driving(kmh(0));
            match speed {
                Some(speed) => bus.speed(speed),
                None => bus.speed_unknown(),
            }
            bus.commands.auxiliaries = Command::Fresh(request);
            let decision = bus.step();
            assert_eq!(decision.outputs.auxiliaries == request, passes, "{request:?} {speed:?}");
            if !passes {
                assert_eq!(decision.outputs.auxiliaries, Auxiliaries::NEUTRAL);
                assert_verdict(&decision, Channel::Auxiliaries, Kind::Limit, Reason::NotStandstill);
            }
        }
        let mut bus = Bus::driving(kmh(0));
        bus.speeds(kmh(0), ROLLING);
        bus.commands.auxiliaries = Command::Fresh(request);
        assert_refused(&bus.step(), Channel::Auxiliaries);
    }
    let mut bus = Bus::parked();
    bus.commands.auxiliaries = Command::Absent;
    assert_eq!(bus.step().outputs.auxiliaries, Auxiliaries::NEUTRAL, "silence keeps them on");
}
