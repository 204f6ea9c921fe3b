//! Parking brake and neutral around leave: apply and gear (SEAT-3f, SEAT-4, SEAT-6, EPB-1).

mod common;
use common::*;

const APPLIED: Signal<EpbState> = known(EpbState::Applied);
const RELEASED: Signal<EpbState> = known(EpbState::Released);

// Apply.

/// SEAT-3f: after exactly 20 s of unknown speed in leave the parking brake is applied.
#[test]
fn after_20_s_without_speed_in_leave_the_parking_brake_is_applied() {
    let mut bus = Bus::leave(kmh(50));
    bus.speed_unknown();
    assert_eq!(bus.time_until(1, 30_000, applies), Some(20_000));
    let decision = bus.step();
    assert!(decision.status.parked_by_leave);
    assert_verdict(&decision, Channel::ParkingBrake, Kind::Substitute, Reason::EpbApply);
}

/// SEAT-3f: one known speed starts the 20 s again, and a known speed above 1.5 km/h ends the apply (EPB-1a).
#[test]
fn a_known_speed_starts_the_20_s_again() {
    let mut bus = Bus::leave(kmh(50));
    bus.speed_unknown();
    bus.run_for(19_990);
    bus.speed(kmh(50));
    bus.step();
    bus.speed_unknown();
    assert_eq!(bus.time_until(10, 30_000, applies), Some(20_000));
    bus.speed(KMH_1_5);
    assert!(!applies(&bus.step()));
}

/// SEAT-4a, SEAT-4d: in leave the brake is applied below 1.5 km/h, by the lower speed, and not at 1.5.
#[test]
fn in_leave_below_1_5_kmh_the_parking_brake_is_applied() {
    let mut bus = Bus::leave(kmh(30));
    bus.speed(KMH_1_5);
    assert!(!applies(&bus.run_for(1_000)));
    assert!(!bus.step().status.parked_by_leave);
    bus.speed(bit_below(KMH_1_5));
    let decision = bus.step();
    assert!(applies(&decision) && decision.status.parked_by_leave, "SEAT-4d: sets the latch");
    assert_verdict(&decision, Channel::ParkingBrake, Kind::Substitute, Reason::EpbApply);

    let mut bus = Bus::leave(kmh(30));
    bus.speeds(bit_below(KMH_1_5), kmh_q8(890));
    assert!(applies(&bus.step()), "RULE-6a: obligations use the lower speed");
}

/// SEAT-4a, CMD-6a: the apply goes out whatever is asked for, in its own mode.
#[test]
fn the_apply_goes_out_whatever_is_asked_for() {
    let request = |request, mode| Command::Fresh(ParkingBrake { request, mode });
    let requests = [
        request(EpbRequest::None, EpbMode::Manual),
        request(EpbRequest::None, EpbMode::Automatic),
        request(EpbRequest::Release, EpbMode::Automatic),
        request(EpbRequest::Apply, EpbMode::Manual),
        request(EpbRequest::Apply, EpbMode::Automatic),
        Command::Absent,
        Command::Rejected(Rejection::Form),
    ];
    for command in requests {
        let mut bus = Bus::leave(kmh(1));
        bus.commands.epb = command;
        let decision = bus.step();
        assert!(applies(&decision), "{command:?}");
        assert_eq!(
            decision.verdicts.of(Channel::ParkingBrake).passed(),
            command == request(EpbRequest::Apply, EpbMode::Automatic)
        );
    }
}

/// SEAT-4a: not in leave, not below 1.5 km/h: no apply of our own.
#[test]
fn without_leave_the_supervisor_applies_nothing() {
    for speed in [kmh(0), STANDSTILL, bit_below(KMH_1_5), KMH_1_5, kmh(50)] {
        let mut bus = Bus::driving(speed);
        bus.run_with(1_000, 10, |decision| {
            assert_eq!(decision.outputs.epb, ParkingBrake { mode: EpbMode::Manual, request: EpbRequest::None });
        });
    }
}

/// SEAT-4b: the apply is repeated until confirmed, and ends in the cycle of the confirmation.
#[test]
fn the_apply_is_repeated_until_confirmed() {
    for feedback in [RELEASED, unknown(Cause::Stale), unknown(Cause::NotAvailable)] {
        let mut bus = Bus::leave(kmh(1));
        bus.inputs.epb = feedback;
        bus.run_with(30_000, 50, |decision| assert!(applies(decision)));
        bus.inputs.epb = APPLIED;
        assert!(!applies(&bus.step()));
    }
}

/// SEAT-4c: not confirmed for 2 s: reported, from then on, until confirmed.
#[test]
fn an_apply_not_confirmed_in_2_s_is_reported() {
    let mut bus = Bus::leave(kmh(30));
    bus.speed(kmh(1));
    let overdue = |decision: &Decision| decision.status.faults.contains(Faults::EPB_UNCONFIRMED);
    assert_eq!(bus.time_until(1, 5_000, overdue), Some(2_000));
    bus.run_with(5_000, 50, |decision| assert!(overdue(decision) && decision.outputs.warnings.fault_lamp));
    bus.inputs.epb = APPLIED;
    assert!(!overdue(&bus.step()));
}

/// SEAT-4c: with the parking brake not confirmed, the service brake holds the bus: 1.35 m/s², for as long as it takes.
#[test]
fn with_the_parking_brake_not_confirmed_the_service_brake_holds() {
    for feedback in [RELEASED, unknown(Cause::Stale)] {
        let mut bus = Bus::leave(kmh(1));
        bus.inputs.epb = feedback;
        bus.speed(kmh(0));
        bus.commands.brake = Command::Absent;
        bus.run_with(60_000, 50, |decision| assert_eq!(decision.outputs.brake.total, ms2(135)));
    }
}

/// SEAT-4c: with the parking brake not confirmed in 2 s the gear is held: P stays, and nothing is engaged.
#[test]
fn with_the_parking_brake_not_confirmed_the_gear_is_held() {
    for gear in [Gear::Park, Gear::Drive, Gear::Neutral] {
        for request in GearRequest::ALL {
            let mut bus = Bus::leave(kmh(1));
            bus.speed(kmh(0));
            bus.inputs.gear = known(gear);
            bus.run_for(2_100);
            bus.ask_gear(*request);
            let decision = bus.step();
            assert!(decision.status.faults.contains(Faults::EPB_UNCONFIRMED));
            assert_eq!(decision.outputs.gear, GearRequest::Hold, "{gear:?} {request:?}");
        }
    }
}

/// SEAT-4e: the latch outlives the driver's return, key cycles, driving off; a legal release alone clears it.
#[test]
fn only_a_legal_release_clears_parked_by_leave() {
    let mut bus = Bus::parked_by_leave();
    bus.driver_returns();
    for key in [Key::Off, Key::On, Key::Start, Key::On] {
        bus.inputs.key = known(key);
        assert!(bus.run_for(500).status.parked_by_leave);
    }
    bus.inputs.epb = RELEASED;
    assert!(bus.run_for(500).status.parked_by_leave, "a brake that came loose is no legal release");
    bus.inputs.epb = APPLIED;
    bus.ask_epb(EpbRequest::Release);
    assert!(bus.run_for(500).status.parked_by_leave, "refused");
    let mut bus = Bus::ready_to_release();
    assert!(bus.step().status.parked_by_leave);
    bus.ask_epb(EpbRequest::Release);
    let decision = bus.step();
    assert!(released(&decision) && !decision.status.parked_by_leave);
}

// SEAT-6.

/// SEAT-6a: parked by leave, brake confirmed, seat not confirmed ⇒ neutral, whatever is asked for.
#[test]
fn parked_by_leave_the_gear_is_neutral() {
    let mut requests: Vec<_> = GearRequest::ALL.iter().map(|request| Command::Fresh(*request)).collect();
    requests.extend([Command::Absent, Command::Rejected(Rejection::Field)]);
    for request in requests {
        for seat in [known(Seat::Vacant), unknown(Cause::Stale), known(Seat::Occupied)] {
            let mut bus = Bus::parked_by_leave();
            bus.inputs.seat = [seat, seat];
            bus.inputs.selector = known(Gear::Drive);
            bus.commands.gear = request;
            let decision = bus.step();
            assert_eq!(decision.outputs.gear, GearRequest::Neutral, "{request:?} {seat:?}");
            assert_eq!(decision.verdicts.of(Channel::Gear).passed(), request == Command::Fresh(GearRequest::Neutral));
        }
    }
}

/// SEAT-6a: before the brake is confirmed nothing asks for neutral; after the confirmed return neither.
#[test]
fn neutral_is_obliged_from_confirmed_brake_to_confirmed_seat() {
    let mut bus = Bus::leave(kmh(1));
    bus.speed(kmh(0));
    bus.step();
    assert_ne!(bus.step().outputs.gear, GearRequest::Neutral, "not before the brake is confirmed");
    bus.inputs.epb = APPLIED;
    assert_eq!(bus.step().outputs.gear, GearRequest::Neutral);
    bus.occupied();
    let free = bus.time_until(1, 3_000, |decision| decision.outputs.gear != GearRequest::Neutral);
    assert_eq!(free, Some(1_000));
    bus.inputs.selector = known(Gear::Drive);
    bus.ask_gear(GearRequest::Drive);
    assert_passed(&bus.step(), Channel::Gear);
}

/// SEAT-9c: the return alone releases neither brake nor gear.
#[test]
fn the_return_alone_releases_neither_brake_nor_gear() {
    let mut bus = Bus::parked_by_leave();
    bus.occupied();
    bus.run_with(60_000, 50, |decision| {
        assert_eq!(decision.outputs.epb.request, EpbRequest::None);
        assert!(matches!(decision.outputs.gear, GearRequest::Hold | GearRequest::Neutral));
        assert_eq!(decision.outputs.contactors, Contactors::NEUTRAL);
    });
}

/// SEAT-6b: without a confirmed driver no torque below 1.5 km/h, or with the parking brake applied.
#[test]
fn without_a_confirmed_driver_there_is_no_torque_when_slow_or_parked() {
    let half = [known(Seat::Occupied), unknown(Cause::Stale)];
    for (speed, epb, permitted) in [
        (KMH_1_5, RELEASED, true),
        (kmh(30), RELEASED, true),
        (bit_below(KMH_1_5), RELEASED, false),
        (kmh(0), RELEASED, false),
        (kmh(30), APPLIED, false),
        (KMH_1_5, APPLIED, false),
    ] {
        let mut bus = Bus::driving(speed);
        bus.inputs.epb = epb;
        bus.inputs.seat = half;
        bus.accelerator(travel(50));
        bus.ask_torque(2);
        let decision = bus.step();
        assert_eq!(decision.outputs.drive.torque > Percent::ZERO, permitted, "{speed:?} {epb:?}");
        if !permitted {
            assert_verdict(&decision, Channel::DriveTorque, Kind::Limit, Reason::SeatNotOccupied);
        }
    }
}

/// SEAT-6c: without a confirmed driver nothing but neutral is engaged below 1.5 km/h, or with the brake applied.
#[test]
fn without_a_confirmed_driver_nothing_but_neutral_is_engaged() {
    let half = [known(Seat::Occupied), known(Seat::Vacant)];
    for (request, selector) in
        [(GearRequest::Drive, Gear::Drive), (GearRequest::Reverse, Gear::Reverse), (GearRequest::Park, Gear::Park)]
    {
        for (speed, epb) in [(kmh(0), APPLIED), (kmh(0), RELEASED), (STANDSTILL, RELEASED)] {
            let mut bus = Bus::parked();
            bus.speed(speed);
            bus.inputs.epb = epb;
            bus.inputs.seat = half;
            bus.inputs.selector = known(selector);
            bus.ask_gear(request);
            let decision = bus.step();
            assert_eq!(decision.outputs.gear, GearRequest::Hold, "{request:?} {speed:?} {epb:?}");
            assert_verdict(&decision, Channel::Gear, Kind::Block, Reason::SeatNotOccupied);
            bus.ask_gear(GearRequest::Neutral);
            assert_passed(&bus.step(), Channel::Gear);
        }
    }
}

// EPB-1.

/// EPB-1a: the main controller's apply passes below 1.5 km/h only, by the higher speed, known.
#[test]
fn an_apply_passes_below_1_5_kmh_only() {
    for (low, high, passes) in [
        (kmh(0), kmh(0), true),
        (kmh(0), bit_below(KMH_1_5), true),
        (kmh(0), KMH_1_5, false),
        (KMH_1_5, KMH_1_5, false),
        (kmh(50), kmh(50), false),
    ] {
        let mut bus = Bus::driving(kmh(0));
        bus.speeds(low, high);
        bus.ask_epb(EpbRequest::Apply);
        let decision = bus.step();
        assert_eq!(decision.verdicts.of(Channel::ParkingBrake).passed(), passes, "{low:?} {high:?}");
        if !passes {
            assert_eq!(decision.outputs.epb.request, EpbRequest::None);
            assert_verdict(&decision, Channel::ParkingBrake, Kind::Block, Reason::EpbSpeed);
        }
    }
    let mut bus = Bus::driving(kmh(0));
    bus.speed_unknown();
    bus.ask_epb(EpbRequest::Apply);
    assert_verdict(&bus.step(), Channel::ParkingBrake, Kind::Block, Reason::EpbSpeed);
}

/// EPB-1a: the driver's own switch applies at any speed; unknown, it applies nothing.
#[test]
fn the_drivers_switch_applies_at_any_speed() {
    for speed in [kmh(0), KMH_1_5, kmh(60), kmh_q8(u16::MAX)] {
        let mut bus = Bus::driving(speed);
        bus.inputs.epb_switch = known(EpbSwitch::Apply);
        assert!(applies(&bus.step()));
        for cause in CAUSES {
            bus.inputs.epb_switch = unknown(*cause);
            assert!(!applies(&bus.step()));
        }
    }
}

/// EPB-1a: in leave and in level 3 above 1.5 km/h nothing applies by itself.
#[test]
fn in_leave_and_level_3_above_1_5_kmh_nothing_applies() {
    let mut bus = Bus::leave(kmh(30));
    bus.ask_epb(EpbRequest::Apply);
    assert_verdict(&bus.step(), Channel::ParkingBrake, Kind::Block, Reason::EpbSpeed);
    let mut bus = Bus::driving(kmh(30));
    bus.ahead(object(2_000, 800));
    bus.step();
    bus.ask_epb(EpbRequest::Apply);
    let decision = bus.step();
    assert_eq!(decision.status.level, Level::Three);
    assert_verdict(&decision, Channel::ParkingBrake, Kind::Block, Reason::EpbSpeed);
}

/// EPB-1c: with ABS at work, or unknown, a brake that does not brake applies nothing above 1.5 km/h.
#[test]
fn with_abs_at_work_a_brake_shortfall_applies_nothing() {
    for abs in [known(true), unknown(Cause::Stale)] {
        let mut bus = Bus::leave(kmh(30));
        bus.inputs.abs = abs;
        bus.inputs.deceleration = known(ms2(0));
        bus.run_with(15_000, 50, |decision| assert!(!applies(decision), "{abs:?}"));
    }
}

/// SEAT-11d: a brake that comes loose while parked by leave is applied again, also where the seat is unknown.
#[test]
fn a_brake_that_comes_loose_is_applied_again() {
    for seat in [known(Seat::Vacant), unknown(Cause::Stale), known(Seat::Occupied)] {
        let mut bus = Bus::parked_by_leave();
        bus.inputs.seat = [seat, seat];
        bus.inputs.epb = RELEASED;
        bus.run_with(500, 10, |decision| assert!(applies(decision), "{seat:?}"));
        bus.inputs.epb = APPLIED;
        assert!(!applies(&bus.step()));
    }
    let mut bus = Bus::parked_by_leave();
    bus.driver_returns();
    bus.inputs.epb = RELEASED;
    assert!(!applies(&bus.step()), "the confirmed driver is in charge");
    bus.vacant();
    assert!(applies(&bus.step()), "and no longer when he is gone");
}
