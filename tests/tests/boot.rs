//! Boot, and resets at every stage (SELF-9).

mod common;
use common::*;

// Boot.

/// Every cause with every record, and whether that is a clean key-on.
fn boots() -> Vec<(ResetCause, Option<Record>, bool)> {
    let records = [None, Some(Record::None), Some(Record::Leave), Some(Record::HighVoltageDown)];
    ResetCause::ALL
        .iter()
        .flat_map(|cause| {
            records.map(|record| (*cause, record, *cause == ResetCause::PowerOn && record == Some(Record::None)))
        })
        .collect()
}

/// SELF-9b, SELF-9c, SELF-9e: only a clean key-on with the seat occupied lets a Start edge close.
#[test]
fn only_a_clean_key_on_counts_as_off_seen() {
    for (cause, record, clean) in boots() {
        let mut inputs = healthy();
        (inputs.k1, inputs.k4) = (OPEN, OPEN);
        let mut bus = Bus::boot(cause, record, inputs);
        bus.ask_contactors(ContactorRequest::Close, ContactorRequest::Close);
        bus.run_with(3_000, 10, |decision| {
            assert!(!closes(decision), "{cause:?} {record:?}: nothing closes by itself");
        });
        bus.act(Act::Start);
        // A power-on after a shutdown by leave can be read both ways: the driver's key has taken the power away.
        if cause != ResetCause::PowerOn || record != Some(Record::HighVoltageDown) {
            assert_eq!(closes(&bus.step()), clean, "{cause:?} {record:?}");
        }
        // After a proper order every boot closes.
        bus.act(Act::Off);
        bus.act(Act::Start);
        assert!(closes(&bus.step()), "{cause:?} {record:?}");
    }
}

/// SELF-9b: "with the seat occupied": a key-on with an empty or unknown seat does not count.
#[test]
fn a_key_on_with_an_empty_seat_does_not_count_as_off_seen() {
    for seat in [known(Seat::Vacant), unknown(Cause::NeverReceived)] {
        let mut inputs = healthy();
        (inputs.k1, inputs.k4) = (OPEN, OPEN);
        inputs.seat = [seat, seat];
        let mut bus = Bus::boot(ResetCause::PowerOn, Some(Record::None), inputs);
        bus.ask_contactors(ContactorRequest::Close, ContactorRequest::Close);
        bus.run_for(5_000);
        bus.act(Act::Sit);
        bus.act(Act::Start);
        assert!(!closes(&bus.step()), "{seat:?}");
    }
}

/// SELF-9d: brake applied and seat not occupied is parked by leave, after every boot, at the latest after a few seconds.
#[test]
fn a_boot_with_the_brake_applied_and_the_seat_not_occupied_is_parked_by_leave() {
    let (vacant, occupied, blank) = (known(Seat::Vacant), known(Seat::Occupied), unknown(Cause::NeverReceived));
    for (cause, record, _) in boots() {
        for seat in [[vacant, vacant], [vacant, blank], [blank, blank], [occupied, vacant], [blank, occupied]] {
            let mut bus = Bus::boot(cause, record, Inputs { seat, ..healthy() });
            assert!(bus.run_for(5_000).status.parked_by_leave, "{cause:?} {record:?} {seat:?}");
            // And so bound to the whole chain of SEAT-5.
            bus.driver_returns();
            bus.ask_epb(EpbRequest::Release);
            assert_verdict(&bus.step(), Channel::ParkingBrake, Kind::Block, Reason::ParkedByLeave);
        }
    }
}

/// SELF-9d: with the seat occupied no boot but that of a record of leave is parked by leave.
#[test]
fn a_boot_with_the_driver_on_the_seat_is_not_parked_by_leave() {
    for (cause, record, _) in boots() {
        let mut bus = Bus::boot(cause, record, healthy());
        let recorded = matches!(record, Some(Record::Leave | Record::HighVoltageDown));
        assert_eq!(bus.run_for(5_000).status.parked_by_leave, recorded, "{cause:?} {record:?}");
    }
}

/// SELF-9d: with the brake released a boot is not parked by leave; an empty seat is a leave after 2 s.
#[test]
fn a_boot_with_the_brake_released_is_not_parked_by_leave() {
    for cause in ResetCause::ALL {
        let seat = [known(Seat::Vacant); 2];
        let mut bus =
            Bus::boot(*cause, Some(Record::None), Inputs { seat, epb: known(EpbState::Released), ..healthy() });
        bus.speed(kmh(30));
        let leave = bus.time_until(10, 5_000, |decision| decision.status.occupancy == Occupancy::Leave);
        assert_eq!(leave, Some(2_000));
        assert!(!bus.step().status.parked_by_leave);
    }
}

/// SELF-9d: a brake that is known only later is judged then.
#[test]
fn a_brake_that_is_known_late_is_judged_then() {
    for cause in ResetCause::ALL {
        let inputs = Inputs { seat: [known(Seat::Vacant); 2], epb: unknown(Cause::NeverReceived), ..healthy() };
        let mut bus = Bus::boot(*cause, Some(Record::None), inputs);
        assert!(!bus.run_for(10_000).status.parked_by_leave);
        bus.inputs.epb = known(EpbState::Applied);
        assert!(bus.run_for(100).status.parked_by_leave);
    }
}

/// SELF-9a, SELF-9d: before anything is known nothing is permitted that needs evidence.
#[test]
fn a_boot_without_any_input_permits_nothing() {
    for (cause, record, _) in boots() {
        let mut bus = Bus::boot(cause, record, Inputs::NEVER);
        bus.ask_torque(10);
        bus.ask_gear(GearRequest::Drive);
        bus.ask_epb(EpbRequest::Release);
        bus.ask_contactors(ContactorRequest::Close, ContactorRequest::Open);
        bus.commands.mode = Command::Fresh(DrivingMode::Automated);
        bus.commands.steering = Command::Fresh(STEER);
        bus.commands.target_speed = Command::Fresh(kmh(30));
        let outputs = bus.run_for(10_000).outputs;
        assert_eq!(outputs.drive, DriveTorque::NEUTRAL);
        assert_eq!(outputs.gear, GearRequest::Hold);
        assert_ne!(outputs.epb.request, EpbRequest::Release);
        assert_eq!(outputs.contactors, Contactors::NEUTRAL);
        assert_eq!((outputs.mode, outputs.target_speed), (DrivingMode::Manual, kmh(0)));
        assert!(!outputs.steering.enable);
    }
}

// Resets at every stage.

/// SELF-9a, SEAT-1h, SEAT-3a: a reset in leave goes on in leave, in its first cycle, with every cause.
#[test]
fn a_reset_in_leave_goes_on_in_leave() {
    for cause in ResetCause::ALL {
        for speed in [kmh(60), kmh(30), kmh(1)] {
            let mut before = Bus::leave(speed);
            before.accelerator(travel(100));
            before.ask_torque(50);
            let mut bus = before.reset(*cause);
            let expected = before.step().outputs;
            let decision = bus.step();
            assert_eq!(decision.status.occupancy, Occupancy::Leave);
            assert_eq!(decision.outputs.brake, expected.brake);
            assert_eq!(decision.outputs.epb, expected.epb);
            assert_eq!(decision.outputs.drive.torque, Percent::ZERO);
            assert!(decision.outputs.warnings.seat_leave && decision.outputs.warnings.hazard_flashers);
            bus.driver_returns();
        }
    }
}

/// SELF-9a, SELF-9d, SEAT-4e: a reset while parked by leave stays parked by leave, in gear, brake and release.
#[test]
fn a_reset_while_parked_by_leave_stays_parked_by_leave() {
    for cause in ResetCause::ALL {
        let mut bus = Bus::parked_by_leave().reset(*cause);
        let decision = bus.run_for(3_000);
        assert!(decision.status.parked_by_leave);
        assert_eq!(decision.outputs.gear, GearRequest::Neutral);
        bus.inputs.epb = known(EpbState::Released);
        assert_eq!(bus.step().outputs.epb.request, EpbRequest::Apply, "SEAT-11d");
        bus.inputs.epb = known(EpbState::Applied);
        bus.driver_returns();
        bus.ask_epb(EpbRequest::Release);
        assert_verdict(&bus.step(), Channel::ParkingBrake, Kind::Block, Reason::ParkedByLeave);
    }
}

/// SELF-9a, SEAT-7a: a reset during the 10 min: they start again, and K4 opens.
#[test]
fn a_reset_during_the_ten_minutes_starts_them_again() {
    for cause in ResetCause::ALL {
        let mut bus = Bus::parked_by_leave();
        bus.run_coarse(300_000);
        let mut bus = bus.reset(*cause);
        let decision = bus.run_coarse(601_000);
        assert_eq!(decision.outputs.contactors.k4, ContactorRequest::Open, "{cause:?}");
    }
}

/// SELF-9a, SEAT-7k: a reset after K4 was commanded: the shutdown is committed and goes on to K1 open.
#[test]
fn a_reset_while_k4_opens_goes_on_to_k1_open() {
    for cause in ResetCause::ALL {
        let mut bus = Bus::opening_k4().reset(*cause);
        assert_eq!(bus.run_for(1_000).outputs.contactors.k4, ContactorRequest::Open, "{cause:?}");
        bus.inputs.k4 = OPEN;
        bus.loads_stopped();
        assert_eq!(bus.run_for(100).outputs.contactors.k1, ContactorRequest::Open, "{cause:?}");
        bus.inputs.k1 = OPEN;
        bus.run_for(100);
        assert_eq!(bus.step().outputs.contactors, Contactors::NEUTRAL);
    }
}

/// SELF-9a, SEAT-7j: a reset while K1 is owed: it is still owed.
#[test]
fn a_reset_while_k1_is_owed_still_owes_it() {
    for cause in ResetCause::ALL {
        let mut bus = Bus::opening_k1().reset(*cause);
        bus.run_with(5_000, 10, |decision| assert_ne!(decision.outputs.contactors.k1, ContactorRequest::Open));
        bus.loads_stopped();
        assert_eq!(bus.run_for(100).outputs.contactors.k1, ContactorRequest::Open, "{cause:?}");
    }
}

/// SELF-9a, SELF-9c, SEAT-8a: a reset after the shutdown closes nothing without the whole order.
#[test]
fn a_reset_after_the_shutdown_closes_nothing() {
    for cause in [ResetCause::Watchdog, ResetCause::Other] {
        let mut bus = Bus::asking_to_close().reset(cause);
        bus.run_with(3_000, 10, |decision| assert!(!closes(decision)));
        bus.act(Act::Sit);
        bus.act(Act::Start);
        assert!(!closes(&bus.step()), "no Off seen");
        bus.act(Act::Off);
        bus.act(Act::Start);
        assert!(closes(&bus.step()));
    }
}

/// SELF-9a, SEAT-8a: a reset in the middle of the driver's order starts the order again.
#[test]
fn a_reset_in_the_middle_of_the_order_starts_it_again() {
    let mut bus = Bus::asking_to_close();
    bus.act(Act::Sit);
    bus.act(Act::Off);
    let mut bus = bus.reset(ResetCause::Watchdog);
    bus.inputs.key = known(Key::On);
    bus.run_for(3_000);
    bus.act(Act::Start);
    assert!(!closes(&bus.step()));
    // And after it was complete.
    let mut bus = Bus::restarted().reset(ResetCause::Watchdog);
    assert!(!closes(&bus.run_for(3_000)), "Start is no edge");
}

/// SELF-9a: a reset while driving with the driver seated asks for nothing: no brake, no leave, and torque comes back.
#[test]
fn a_reset_while_driving_asks_for_nothing() {
    for cause in ResetCause::ALL {
        let mut bus = Bus::driving(kmh(50));
        bus.accelerator(travel(50));
        let mut bus = bus.reset(*cause);
        bus.run_with(5_000, 10, |decision| {
            assert_eq!(decision.outputs.brake.total, DecelMs2Q11::ZERO);
            assert_eq!(decision.outputs.epb.request, EpbRequest::None);
            assert_ne!(decision.status.occupancy, Occupancy::Leave);
        });
        bus.ask_torque(2);
        assert_passed(&bus.step(), Channel::DriveTorque);
    }
}

/// SELF-9a: what is to be persisted, stage by stage.
#[test]
fn the_record_says_the_stage() {
    let stages: [(fn() -> Bus, Record); 8] = [
        (Bus::parked, Record::None),
        (|| Bus::driving(kmh(50)), Record::None),
        (|| Bus::leave(kmh(50)), Record::Leave),
        (Bus::parked_by_leave, Record::Leave),
        (Bus::opening_k4, Record::HighVoltageDown),
        (Bus::opening_k1, Record::HighVoltageDown),
        (Bus::down, Record::HighVoltageDown),
        (Bus::restarted, Record::Leave), // parked by leave until the release
    ];
    for (stage, expected) in stages {
        assert_eq!(stage().step().status.record, expected);
    }
}
