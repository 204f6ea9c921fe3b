//! Driver out of seat: confirmed occupied, leave, return, unclear sensors (SEAT-0, SEAT-1, SEAT-9, SEAT-10).

mod common;
use common::random::*;
use common::*;

const VACANT: Signal<Seat> = known(Seat::Vacant);
const OCCUPIED: Signal<Seat> = known(Seat::Occupied);
const BLANK: Signal<Seat> = unknown(Cause::Stale);

/// Every pair of sensor values that is neither both occupied nor both vacant.
fn unclear() -> Vec<[Signal<Seat>; 2]> {
    let mut pairs = vec![[VACANT, OCCUPIED], [OCCUPIED, VACANT]];
    for cause in CAUSES.iter().map(|cause| unknown(*cause)) {
        pairs.extend([[cause, cause], [cause, VACANT], [VACANT, cause], [cause, OCCUPIED], [OCCUPIED, cause]]);
    }
    pairs
}

/// SEAT-0a: confirmed occupied after exactly 1 s, to the millisecond.
#[test]
fn the_seat_is_confirmed_after_one_second_and_not_a_millisecond_before() {
    let mut bus = Bus::driving(kmh(30));
    bus.vacant();
    assert_eq!(bus.step().status.occupancy, Occupancy::NotConfirmed);
    bus.occupied();
    let time = bus.time_until(1, 2_000, |decision| decision.status.occupancy == Occupancy::Confirmed);
    assert_eq!(time, Some(1_000));
}

/// SEAT-0a: anything but both known occupied ends the confirmation at once, and the second starts again.
#[test]
fn anything_else_ends_the_confirmation_at_once() {
    for pair in unclear().into_iter().chain([[VACANT, VACANT]]) {
        let mut bus = Bus::driving(kmh(30));
        bus.inputs.seat = pair;
        assert_eq!(bus.step_by(1).status.occupancy, Occupancy::NotConfirmed, "{pair:?}");
        bus.occupied();
        let time = bus.time_until(1, 2_000, |decision| decision.status.occupancy == Occupancy::Confirmed);
        assert_eq!(time, Some(1_000), "{pair:?}");
    }
}

/// SEAT-0b, SEAT-1a: leave needs power and (brake known not applied or speed known ≥ 1.5 km/h).
#[test]
fn leave_begins_only_when_the_bus_is_not_parked() {
    let moving = KMH_1_5;
    let slow = bit_below(KMH_1_5);
    let applied = known(EpbState::Applied);
    let released = known(EpbState::Released);
    let blank = unknown(Cause::Stale);
    // Parking brake, speed (None: unknown), leave.
    let cases = [
        (released, Some(kmh(0)), true),
        (released, Some(moving), true),
        (released, None, true),
        (applied, Some(slow), false),
        (applied, Some(moving), true),
        (applied, Some(kmh(30)), true),
        (applied, None, false),
        (blank, Some(slow), false),
        (blank, Some(moving), true),
        (blank, None, false),
    ];
    for (epb, speed, expected) in cases {
        let mut bus = Bus::parked();
        bus.inputs.epb = epb;
        match speed {
            Some(speed) => bus.speed(speed),
            None => bus.speed_unknown(),
        }
        bus.vacant();
        let decision = bus.run_for(2_500);
        assert_eq!(in_leave(&decision), expected, "{epb:?} {speed:?}");
    }
}

/// SEAT-0b: without power (key off, battery contactor open) no leave begins.
#[test]
fn without_power_no_leave_begins() {
    let mut bus = Bus::driving(kmh(30));
    bus.inputs.key = known(Key::Off);
    bus.inputs.k1 = known(Contact::Open);
    bus.vacant();
    assert!(!in_leave(&bus.run_for(5_000)));
    bus.inputs.key = known(Key::On);
    bus.inputs.k1 = known(Contact::Closed);
    assert!(in_leave(&bus.step()), "SEAT-1g: the 2 s ran all the time");
}

/// SEAT-0b, RULE-6a: "moving" is judged by the lower speed.
#[test]
fn moving_is_judged_by_the_lower_speed() {
    for (low, expected) in [(KMH_1_5, true), (bit_below(KMH_1_5), false)] {
        let mut bus = Bus::parked();
        bus.speeds(low, kmh_q8(low.raw() + 500));
        bus.vacant();
        assert_eq!(in_leave(&bus.run_for(2_500)), expected, "{low:?}");
    }
}

/// SEAT-1a: leave begins after exactly 2 s of both sensors vacant, to the millisecond.
#[test]
fn leave_begins_after_two_seconds_and_not_a_millisecond_before() {
    let mut bus = Bus::driving(kmh(30));
    bus.vacant();
    assert_eq!(bus.time_until(1, 3_000, in_leave), Some(2_000));
}

/// SEAT-1a: the same in cycles of 10 and 50 ms.
#[test]
fn leave_begins_after_two_seconds_in_any_cycle() {
    for cycle in [2, 10, 50] {
        let mut bus = Bus::driving(kmh(30));
        bus.vacant();
        assert_eq!(bus.time_until(cycle, 3_000, in_leave), Some(2_000), "cycle {cycle}");
    }
}

/// SEAT-1a, SEAT-10a: one vacant sensor, unknown sensors, disagreeing sensors never begin a leave.
#[test]
fn nothing_but_both_sensors_vacant_begins_a_leave() {
    for pair in unclear() {
        let mut bus = Bus::driving(kmh(30));
        bus.inputs.seat = pair;
        bus.run_with(10_000, 50, |decision| {
            assert!(!in_leave(decision), "{pair:?}");
            assert_eq!(decision.outputs.brake.total, DecelMs2Q11::ZERO, "{pair:?}: no obligation");
        });
    }
}

/// SEAT-1e: one sensor known occupied for one millisecond starts the 2 s again.
#[test]
fn one_occupied_sensor_resets_the_two_seconds() {
    for pair in [[OCCUPIED, VACANT], [VACANT, OCCUPIED], [OCCUPIED, OCCUPIED], [OCCUPIED, BLANK], [BLANK, OCCUPIED]] {
        let mut bus = Bus::driving(kmh(30));
        bus.vacant();
        assert!(!in_leave(&bus.run_for(1_990)));
        bus.inputs.seat = pair;
        bus.step_by(1);
        bus.vacant();
        assert_eq!(bus.time_until(1, 3_000, in_leave), Some(2_000), "{pair:?}");
    }
}

/// SEAT-1f: an unknown sensor freezes the 2 s: they go on afterwards from where they were.
#[test]
fn an_unknown_sensor_freezes_the_two_seconds() {
    for pair in [[BLANK, BLANK], [BLANK, VACANT], [VACANT, BLANK]] {
        for gap in [10, 100, 490] {
            let mut bus = Bus::driving(kmh(30));
            bus.vacant();
            bus.run_for(1_510); // 1.5 s since the first vacant sample
            bus.inputs.seat = pair;
            assert!(!in_leave(&bus.run_for(gap)), "unknown begins nothing");
            bus.vacant();
            let time = bus.time_until(10, 3_000, in_leave);
            // The 0.5 s that are missing; one cycle either way belongs to the change between the two.
            assert!(matches!(time, Some(480..=510)), "{pair:?} after {gap} ms: {time:?}");
        }
    }
}

/// SEAT-1f: unknown for longer than 500 ms starts the 2 s again.
#[test]
fn a_long_unknown_sensor_resets_the_two_seconds() {
    for pair in [[BLANK, BLANK], [BLANK, VACANT], [VACANT, BLANK]] {
        let mut bus = Bus::driving(kmh(30));
        bus.vacant();
        bus.run_for(1_990);
        bus.inputs.seat = pair;
        assert!(!in_leave(&bus.run_for(510)));
        bus.vacant();
        assert_eq!(bus.time_until(1, 3_000, in_leave), Some(2_000), "{pair:?}");
    }
}

/// SEAT-1f, RULE-1b: while a sensor is unknown no leave begins, however close the 2 s were.
#[test]
fn a_leave_does_not_begin_in_an_unknown_cycle() {
    let mut bus = Bus::driving(kmh(30));
    bus.vacant();
    bus.run_for(2_000); // 1 990 ms since the first sample
    bus.seat(VACANT, BLANK);
    bus.run_with(3_000, 10, |decision| assert!(!in_leave(decision)));
}

/// SEAT-1g: the 2 s run while parked: the brake released over an empty seat is a leave at once.
#[test]
fn the_two_seconds_run_while_parked() {
    let mut bus = Bus::parked();
    bus.vacant();
    bus.run_with(5_000, 10, |decision| assert!(!in_leave(decision)));
    bus.inputs.epb = known(EpbState::Released);
    assert!(in_leave(&bus.step()));

    let mut bus = Bus::parked();
    bus.vacant();
    bus.run_for(1_010);
    bus.inputs.epb = known(EpbState::Released);
    let time = bus.time_until(10, 3_000, in_leave);
    assert_eq!(time, Some(990), "2 s in total, 1 010 ms of them up to this sample");
}

/// SEAT-1h: a begun leave survives everything but the confirmed seat.
#[test]
fn a_begun_leave_ends_by_nothing_but_the_confirmed_seat() {
    let changes: [Change; 9] = [
        ("standing", |bus| bus.speed(kmh(0))),
        ("speed unknown", Bus::speed_unknown),
        ("brake applied", |bus| bus.inputs.epb = known(EpbState::Applied)),
        ("key off", |bus| bus.inputs.key = known(Key::Off)),
        ("no power", |bus| {
            bus.inputs.key = known(Key::Off);
            bus.inputs.k1 = known(Contact::Open);
        }),
        ("sensors unknown", |bus| bus.seat(BLANK, BLANK)),
        ("sensors disagree", |bus| bus.seat(VACANT, OCCUPIED)),
        ("one occupied, one unknown", |bus| bus.seat(BLANK, OCCUPIED)),
        ("nothing received", |bus| bus.inputs = Inputs::NEVER),
    ];
    for (name, change) in changes {
        let mut bus = Bus::leave(kmh(30));
        change(&mut bus);
        bus.run_with(30_000, 50, |decision| assert!(in_leave(decision), "{name}"));
    }
}

/// SEAT-1h, SEAT-9a: the leave ends after exactly 1 s of the driver on the seat, not a millisecond before.
#[test]
fn a_leave_ends_after_one_second_of_the_driver_on_the_seat() {
    let mut bus = Bus::leave(kmh(30));
    bus.occupied();
    assert_eq!(bus.time_until(1, 3_000, |decision| !in_leave(decision)), Some(1_000));
    let mut bus = Bus::leave(kmh(30));
    for _ in 0..20 {
        bus.occupied();
        assert!(in_leave(&bus.run_for(1_000)), "990 ms since the first sample");
        bus.seat(OCCUPIED, VACANT);
        assert!(in_leave(&bus.step()));
    }
}

/// SEAT-1b, SEAT-1c, SEAT-1d: warning and flashers go out whatever the main controller asks for.
#[test]
fn leave_warns_whatever_is_asked_for() {
    let on =
        Warnings { seat_leave: true, hazard_flashers: true, fault_lamp: true, notice_lamp: true, ..Warnings::NEUTRAL };
    let requests = [
        Command::Fresh(Warnings::NEUTRAL),
        Command::Fresh(on),
        Command::Held(Millis::new(500), Warnings::NEUTRAL),
        Command::Held(Millis::new(501), Warnings::NEUTRAL),
        Command::Absent,
        Command::Rejected(Rejection::Checksum),
    ];
    for request in requests {
        let mut bus = Bus::leave(kmh(30));
        bus.commands.warnings = request;
        let decision = bus.step();
        assert!(decision.outputs.warnings.seat_leave && decision.outputs.warnings.hazard_flashers, "{request:?}");
        if request == Command::Fresh(on) {
            assert_passed(&decision, Channel::Warnings);
        } else {
            assert_refused(&decision, Channel::Warnings);
        }
    }
}

/// SEAT-1d, BODY-1d: in leave the hazard flashers override the indicators.
#[test]
fn in_leave_the_hazard_flashers_override_the_indicators() {
    let mut bus = Bus::leave(kmh(30));
    for (left, right) in [(true, false), (false, true), (true, true)] {
        let body = Body { indicator_left: left, indicator_right: right, brake_lamps: true, ..Body::NEUTRAL };
        bus.commands.body = Command::Fresh(body);
        let decision = bus.step();
        assert!(!decision.outputs.body.indicator_left && !decision.outputs.body.indicator_right);
        assert_verdict(&decision, Channel::Body, Kind::Limit, Reason::HazardFlashers);
    }
}

/// SEAT-9a: the confirmed return ends warning, torque limit and brake.
#[test]
fn the_return_of_the_driver_ends_warning_torque_limit_and_brake() {
    let mut bus = Bus::leave(kmh(30));
    let decision = bus.driver_returns();
    let Outputs { warnings, brake, body, .. } = decision.outputs;
    assert!(!warnings.seat_leave && !warnings.hazard_flashers);
    assert_eq!(brake.total, DecelMs2Q11::ZERO);
    assert!(body.brake_lamps, "BODY-1c: for another 0.3 s");
    bus.run_for(320);
    bus.accelerator(travel(50));
    bus.ask_torque(2);
    let decision = bus.step();
    assert_passed(&decision, Channel::DriveTorque);
    assert_eq!(decision.outputs.body, Body::NEUTRAL);
}

/// TRQ-5e: after leave torque needs the accelerator seen released, after the leave.
#[test]
fn after_leave_the_accelerator_must_be_seen_released() {
    let mut bus = Bus::leave(kmh(30));
    bus.accelerator(travel(50));
    bus.driver_returns();
    bus.ask_torque(1);
    bus.run_with(5_000, 50, |decision| {
        assert_verdict(decision, Channel::DriveTorque, Kind::Limit, Reason::ReleaseNeeded);
    });
    bus.inputs.accelerator = [unknown(Cause::Stale), known(Pedal250::ZERO)];
    assert_refused(&bus.step(), Channel::DriveTorque);
    bus.accelerator(travel(50));
    assert_refused(&bus.step(), Channel::DriveTorque);
    bus.accelerator(travel(0));
    bus.step();
    bus.accelerator(travel(50));
    assert_passed(&bus.step(), Channel::DriveTorque);
}

/// SEAT-9d: a second leave does all of it again: 2 s, warning, torque, brake.
#[test]
fn a_second_leave_does_all_of_it_again() {
    let mut bus = Bus::leave(kmh(30));
    bus.driver_returns();
    for _ in 0..3 {
        bus.vacant();
        assert_eq!(bus.time_until(10, 3_000, in_leave), Some(2_000));
        let decision = bus.step();
        assert_eq!(decision.outputs.brake.total, ms2(173));
        assert!(decision.outputs.warnings.seat_leave);
        bus.accelerator(travel(50));
        bus.ask_torque(5);
        assert_eq!(bus.step().outputs.drive.torque, Percent::ZERO);
        bus.accelerator(travel(0));
        bus.driver_returns();
    }
}

/// SEAT-10a: unclear sensors during a leave neither end it nor begin another.
#[test]
fn unclear_sensors_keep_a_begun_leave() {
    for pair in unclear() {
        let mut bus = Bus::leave(kmh(30));
        bus.inputs.seat = pair;
        let decision = bus.run_for(5_000);
        assert!(in_leave(&decision) && decision.outputs.brake.total == ms2(173), "{pair:?}");
    }
}

/// SEAT-10b: unclear sensors refuse everything that needs an occupied seat.
#[test]
fn unclear_sensors_refuse_what_needs_an_occupied_seat() {
    for pair in unclear() {
        // Parked: release of the parking brake, a driving gear, torque.
        let mut bus = Bus::parked();
        bus.inputs.seat = pair;
        bus.inputs.selector = known(Gear::Drive);
        bus.ask_epb(EpbRequest::Release);
        bus.ask_gear(GearRequest::Drive);
        let decision = bus.step();
        assert_verdict(&decision, Channel::ParkingBrake, Kind::Block, Reason::SeatNotOccupied);
        assert_verdict(&decision, Channel::Gear, Kind::Block, Reason::SeatNotOccupied);
        // Standing in D, brake released: torque.
        let mut bus = Bus::driving(kmh(0));
        bus.inputs.seat = pair;
        bus.accelerator(travel(50));
        bus.ask_torque(1);
        assert_verdict(&bus.step(), Channel::DriveTorque, Kind::Limit, Reason::SeatNotOccupied);
        // Driving: the automated mode.
        let mut bus = Bus::driving(kmh(30));
        bus.inputs.cruise_switch = known(true);
        bus.inputs.ads = known(AdsState::Ready);
        bus.step();
        bus.inputs.seat = pair;
        bus.inputs.driver_set = known(true);
        bus.commands.mode = Command::Fresh(DrivingMode::Automated);
        assert_verdict(&bus.step(), Channel::Mode, Kind::Block, Reason::ModeNotGranted);
    }
}

/// SEAT-10c: unclear sensors are reported, by fault and lamp, in the cycle; clear ones are not.
#[test]
fn unclear_sensors_are_reported() {
    for pair in unclear() {
        let mut bus = Bus::driving(kmh(30));
        bus.inputs.seat = pair;
        let decision = bus.step();
        let faults = decision.status.faults;
        assert!(faults.contains(Faults::SEAT_DISAGREE) || faults.contains(Faults::SEAT_UNKNOWN), "{pair:?}");
        assert!(decision.outputs.warnings.fault_lamp, "{pair:?}");
    }
    let mut bus = Bus::driving(kmh(30));
    assert_eq!(bus.step().status.faults, Faults::NONE);
    bus.vacant();
    assert_eq!(bus.step().status.faults, Faults::NONE, "an empty seat is no fault");
}

/// CMD-7b: only the two sensors confirm the seat. Whoever drives from afar, whatever every other input and every command
/// says, an empty or unclear seat is not occupied and nothing is released.
#[test]
fn nobody_but_the_sensors_confirms_the_seat() {
    let pairs: Vec<[Signal<Seat>; 2]> = unclear().into_iter().chain([[VACANT, VACANT]]).collect();
    for which in 0..STARTS {
        let mut dice = Dice::Number(0x7b + u64::try_from(which).unwrap_or(0));
        let mut bus = start(which);
        for _ in 0..300 {
            for _ in 0..20 {
                change_input(&mut dice, &mut bus.inputs);
                change_command(&mut dice, &mut bus.commands);
            }
            bus.inputs.ads = known(AdsState::Active);
            bus.inputs.seat = dice.of(&pairs);
            bus.ask_epb(EpbRequest::Release);
            let decision = bus.step();
            assert_ne!(decision.status.occupancy, Occupancy::Confirmed, "{:?}", bus.inputs);
            assert_ne!(decision.outputs.epb.request, EpbRequest::Release, "{:?}", bus.inputs);
        }
    }
}
