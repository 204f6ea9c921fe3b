//! High voltage: the shutdown after leave (SEAT-7, SEAT-9b, SEAT-11).

mod common;
use common::*;

/// Stopped in leave, apply commanded, parking brake not confirmed yet.
fn applying() -> Bus {
    let mut bus = Bus::leave(kmh(1));
    bus.speed(kmh(0));
    bus.inputs.gear = known(Gear::Neutral);
    bus.step();
    bus
}

/// Runs `bus` without a K4 command for nearly the 10 minutes, then to the millisecond: when it comes, from now on.
fn minutes_until_k4(bus: &mut Bus) -> Option<u32> {
    let coarse = 599_000;
    bus.run_with(coarse, 50, |decision| assert!(opens_nothing(decision), "too early"));
    // The first of the fine steps comes 1 ms after the last coarse one, which was 598 950 ms after the first.
    bus.time_until(1, 3_000, opens_k4).map(|time| time + coarse - 50 + 1)
}

// The 10 minutes.

/// SEAT-7a, SEAT-11a: K4 opens exactly 10 min after the confirmed apply, to the millisecond.
#[test]
fn k4_opens_ten_minutes_after_the_confirmed_apply() {
    let mut bus = applying();
    bus.run_coarse(120_000); // the brake takes its time: that does not count
    bus.inputs.epb = known(EpbState::Applied);
    assert_eq!(minutes_until_k4(&mut bus), Some(600_000));
    let decision = bus.step();
    assert_eq!(decision.outputs.contactors, Contactors { k4: ContactorRequest::Open, k1: ContactorRequest::Hold });
    assert_verdict(&decision, Channel::Contactors, Kind::Substitute, Reason::Shutdown);
    assert_eq!(decision.status.record, Record::HighVoltageDown);
}

/// SEAT-7a: the same whatever the main controller asks of the contactors, and when it is silent.
#[test]
fn k4_opens_whatever_is_asked_for() {
    for command in [
        Command::Fresh(Contactors { k4: ContactorRequest::Close, k1: ContactorRequest::Close }),
        Command::Absent,
        Command::Rejected(Rejection::Checksum),
    ] {
        let mut bus = Bus::parked_by_leave();
        bus.run_coarse(590_000);
        bus.commands.contactors = command;
        let decision = bus.run_coarse(15_000);
        assert_eq!(decision.outputs.contactors, Contactors { k4: ContactorRequest::Open, k1: ContactorRequest::Hold });
    }
}

/// SEAT-7a: without parked-by-leave an empty, parked bus keeps its high voltage.
#[test]
fn an_ordinary_parked_bus_keeps_its_high_voltage() {
    let mut bus = Bus::parked();
    bus.vacant();
    bus.run_with(1_300_000, 50, |decision| assert!(opens_nothing(decision)));
}

/// SEAT-7a: with high voltage already off nothing is commanded; unknown is not off.
#[test]
fn high_voltage_that_is_off_is_not_shut_down_again() {
    for (k4, k1, shut_down) in [
        (OPEN, OPEN, false),
        (CLOSED, OPEN, true),
        (CLOSED, CLOSED, true),
        (MISSING, OPEN, true),
        (MISSING, MISSING, true),
        (OPEN, CLOSED, true),
        (OPEN, MISSING, true),
    ] {
        let mut bus = Bus::parked_by_leave();
        (bus.inputs.k4, bus.inputs.k1) = (k4, k1);
        bus.loads_stopped();
        let decision = bus.run_coarse(600_500);
        assert_eq!(!opens_nothing(&decision), shut_down, "{k4:?} {k1:?}");
        assert_eq!(opens_k1(&decision), k4 == OPEN && shut_down, "{k4:?} {k1:?}");
    }
}

/// SEAT-9b: the confirmed return sets the 10 min to 0, a second before they are over.
#[test]
fn the_return_sets_the_ten_minutes_to_zero() {
    let mut bus = Bus::parked_by_leave();
    bus.run_coarse(598_000);
    assert_eq!(bus.driver_returns().status.parked_for, Millis::ZERO);
    bus.run_with(700_000, 50, |decision| assert!(opens_nothing(decision)));
    bus.vacant();
    assert_eq!(minutes_until_k4(&mut bus), Some(600_000), "SEAT-9d: from the beginning");
}

/// SEAT-9b: somebody on the seat for less than the second does not count as a return.
#[test]
fn a_seat_that_is_not_confirmed_does_not_set_the_ten_minutes_to_zero() {
    let mut bus = Bus::parked_by_leave();
    bus.run_coarse(590_000);
    bus.occupied();
    bus.run_for(900);
    bus.vacant();
    let decision = bus.run_coarse(12_000);
    assert!(opens_k4(&decision));
}

/// SEAT-7a: time with somebody on the seat is not time with a vacant seat, confirmed or not.
#[test]
fn time_with_somebody_on_the_seat_does_not_count() {
    let mut bus = Bus::parked_by_leave();
    let before = bus.run_coarse(60_000).status.parked_for;
    bus.occupied();
    assert_eq!(bus.run_for(900).status.parked_for, before);
    bus.vacant();
    assert_eq!(bus.run_for(100).status.parked_for, Millis::new(before.raw() + 100));
}

/// SEAT-11b: an unknown parking brake freezes the 10 min, for as long as it lasts.
#[test]
fn an_unknown_parking_brake_freezes_the_ten_minutes() {
    let mut bus = Bus::parked_by_leave();
    bus.run_coarse(300_000);
    bus.inputs.epb = unknown(Cause::Stale);
    bus.run_with(900_000, 50, |decision| assert!(opens_nothing(decision)));
    bus.inputs.epb = known(EpbState::Applied);
    bus.run_with(299_000, 50, |decision| assert!(opens_nothing(decision)));
    assert!(opens_k4(&bus.run_coarse(1_500)));
}

/// SEAT-11c: a brake known released sets the 10 min to 0.
#[test]
fn a_released_parking_brake_sets_the_ten_minutes_to_zero() {
    let mut bus = Bus::parked_by_leave();
    bus.run_coarse(599_000);
    bus.inputs.epb = known(EpbState::Released);
    assert_eq!(bus.step_by(1).status.parked_for, Millis::ZERO);
    bus.inputs.epb = known(EpbState::Applied);
    assert_eq!(minutes_until_k4(&mut bus), Some(600_000));
}

/// SEAT-11e: an unknown seat lets the 10 min go on.
#[test]
fn an_unknown_seat_lets_the_ten_minutes_go_on() {
    for pair in [[unknown(Cause::Stale); 2], [known(Seat::Vacant), unknown(Cause::EndToEnd)]] {
        let mut bus = Bus::parked_by_leave();
        bus.run_coarse(1_000);
        bus.inputs.seat = pair;
        bus.run_coarse(598_000);
        bus.vacant();
        assert!(opens_k4(&bus.run_coarse(1_500)), "{pair:?}");
    }
}

/// SEAT-11f, END-1b: the counter saturates: at its end it neither wraps nor forgets.
#[test]
fn the_ten_minutes_saturate() {
    let mut bus = Bus::parked_by_leave();
    bus.inputs.executed_torque = unknown(Cause::Stale); // a guard keeps K4 waiting
    let bus = bus.with_state(|state| {
        let Some(parked) = Timer::from_word(u32::MAX - 5) else { unreachable!("any word is a timer") };
        State { high_voltage: HighVoltage { parked, ..state.high_voltage }, ..state }
    });
    let mut bus = bus;
    bus.run_with(10_000, 50, |decision| assert!(decision.status.parked_for >= Millis::new(u32::MAX - 6)));
    bus.inputs.executed_torque = known(Percent::ZERO);
    assert!(opens_k4(&bus.step()));
}

/// SEAT-7a, SEAT-10a: the 10 min are over and a guard comes back while somebody sits: nothing begins.
#[test]
fn the_shutdown_does_not_begin_with_somebody_on_the_seat() {
    let (vacant, occupied) = (known(Seat::Vacant), known(Seat::Occupied));
    for pair in [[occupied, occupied], [occupied, vacant], [vacant, occupied], [occupied, unknown(Cause::Stale)]] {
        let mut bus = Bus::parked_by_leave();
        bus.inputs.executed_torque = unknown(Cause::Stale);
        bus.run_with(605_000, 50, |decision| assert!(opens_nothing(decision)));
        bus.inputs.seat = pair;
        bus.step();
        bus.inputs.executed_torque = known(Percent::ZERO);
        bus.run_with(500, 10, |decision| assert!(opens_nothing(decision), "{pair:?}"));
        assert_eq!(bus.step().status.record, Record::Leave, "{pair:?}: not committed");
    }
}

// The guards of K4.

/// SEAT-7b, SEAT-7c, SEAT-7d, RULE-4b: a missing guard makes the shutdown wait, and it comes when the guard is back.
#[test]
fn a_missing_guard_makes_the_shutdown_wait() {
    for (name, lose) in K4_GUARDS {
        let mut bus = Bus::parked_by_leave();
        bus.run_coarse(599_000);
        let healthy = bus.inputs;
        lose(&mut bus);
        bus.run_with(10_000, 50, |decision| assert!(opens_nothing(decision), "{name}"));
        bus.inputs = healthy;
        assert!(opens_k4(&bus.run_coarse(1_500)), "{name}: it waits, it is not forgotten");
    }
}

/// SEAT-7b, SEAT-7c, SEAT-7d, SEAT-7k, RULE-4b: a guard lost after the commit makes K4 wait too; it stays owed.
#[test]
fn a_guard_lost_after_the_commit_makes_k4_wait() {
    let released: Change = ("SEAT-7c brake released", |bus| bus.inputs.epb = known(EpbState::Released));
    for (name, lose) in K4_GUARDS.into_iter().chain([released]) {
        let mut bus = Bus::opening_k4();
        let healthy = bus.inputs;
        lose(&mut bus);
        bus.run_with(1_000, 10, |decision| assert!(!opens_k4(decision), "{name}"));
        bus.inputs = healthy;
        assert!(opens_k4(&bus.step()), "{name}: committed");
    }
}

/// SEAT-7b: standstill is below 0.3 km/h, by the higher speed.
#[test]
fn standstill_is_below_0_3_kmh_by_the_higher_speed() {
    for (low, high, expected) in [(STANDSTILL, STANDSTILL, true), (kmh(0), STANDSTILL, true), (kmh(0), ROLLING, false)]
    {
        let mut bus = Bus::opening_k4();
        bus.speeds(low, high);
        assert_eq!(opens_k4(&bus.step()), expected, "{low:?} {high:?}");
    }
}

// K1.

/// SEAT-7e: with K4 confirmed open and the loads stopped K1 opens in that cycle; K4 stays commanded.
#[test]
fn k1_opens_when_k4_is_open_and_the_loads_have_stopped() {
    let mut bus = Bus::opening_k1();
    bus.run_with(1_000, 10, |decision| assert!(!opens_k1(decision) && opens_k4(decision)));
    bus.loads_stopped();
    assert!(opens_k1(&bus.step()));
    // Loads that have stopped before K4 is confirmed: K1 opens in the cycle of the confirmation, not earlier.
    let mut bus = Bus::opening_k4();
    bus.loads_stopped();
    bus.run_with(1_000, 10, |decision| assert!(!opens_k1(decision)));
    bus.inputs.k4 = OPEN;
    assert!(opens_k1(&bus.step()));
}

/// SEAT-7f: never before K4 is confirmed open; unknown is not open, and open must stay open.
#[test]
fn k1_never_opens_before_k4_is_confirmed_open() {
    let mut feedback = vec![CLOSED];
    feedback.extend(CAUSES.iter().map(|cause| unknown(*cause)));
    for k4 in feedback {
        for mut bus in [Bus::opening_k4(), Bus::opening_k1()] {
            bus.loads_stopped();
            bus.inputs.k4 = k4;
            bus.ask_contactors(ContactorRequest::Open, ContactorRequest::Open);
            bus.run_with(60_000, 50, |decision| assert!(!opens_k1(decision), "{k4:?}"));
            bus.inputs.k4 = OPEN;
            assert!(opens_k1(&bus.step()), "RULE-4b: still owed");
        }
    }
}

/// SEAT-7g: each load not confirmed stopped, each unknown, and each bit of current beyond the bound keeps K1 closed.
#[test]
fn k1_never_opens_under_load() {
    const fn current(deci: i16) -> Signal<CurrentDeciA> {
        known(CurrentDeciA::new(deci))
    }
    let changes: [Change; 11] = [
        ("drive runs", |bus| bus.inputs.drive_stopped = known(false)),
        ("drive unknown", |bus| bus.inputs.drive_stopped = unknown(Cause::Stale)),
        ("auxiliaries run", |bus| bus.inputs.auxiliaries_stopped = known(false)),
        ("auxiliaries unknown", |bus| bus.inputs.auxiliaries_stopped = unknown(Cause::EndToEnd)),
        ("2.1 A", |bus| bus.inputs.hv_current = current(21)),
        ("-2.1 A", |bus| bus.inputs.hv_current = current(-21)),
        ("least current", |bus| bus.inputs.hv_current = current(i16::MIN)),
        ("greatest current", |bus| bus.inputs.hv_current = current(i16::MAX)),
        ("current unknown", |bus| bus.inputs.hv_current = unknown(Cause::NotAvailable)),
        ("rolling", |bus| bus.speed(ROLLING)),
        ("speed unknown", Bus::speed_unknown),
    ];
    for (name, change) in changes {
        let mut bus = Bus::opening_k1();
        bus.loads_stopped();
        change(&mut bus);
        bus.ask_contactors(ContactorRequest::Hold, ContactorRequest::Open);
        bus.run_with(15_000, 50, |decision| assert!(!opens_k1(decision), "{name}"));
        bus.speed(kmh(0));
        bus.loads_stopped();
        assert!(opens_k1(&bus.step()), "{name}: still owed");
    }
    for bound in [20, -20, 0] {
        let mut bus = Bus::opening_k1();
        bus.loads_stopped();
        bus.inputs.hv_current = current(bound);
        assert!(opens_k1(&bus.step()), "{bound}");
    }
}

// Deadlines.

/// SEAT-7h, SEAT-7i, SEAT-7j: K4 not confirmed in 2 s: reported; K4 stays commanded, K1 stays owed.
#[test]
fn k4_that_is_not_confirmed_in_time_is_reported_and_stays_commanded() {
    for k4 in [CLOSED, MISSING] {
        let mut bus = Bus::parked_by_leave();
        bus.inputs.k4 = k4;
        bus.loads_stopped();
        bus.run_coarse(599_000);
        assert!(bus.time_until(1, 3_000, opens_k4).is_some());
        let overdue = |decision: &Decision| decision.status.faults.contains(Faults::K4_OVERDUE);
        // The step of the command itself was the first of the wait.
        assert_eq!(bus.time_until(1, 5_000, overdue), Some(1_999));
        bus.run_with(60_000, 50, |decision| {
            assert!(overdue(decision) && decision.outputs.warnings.fault_lamp);
            assert!(opens_k4(decision) && !opens_k1(decision));
        });
        bus.inputs.k4 = OPEN;
        assert!(opens_k1(&bus.step()), "SEAT-7j");
        assert!(!bus.step().status.faults.contains(Faults::K4_OVERDUE));
    }
}

/// SEAT-7h, SEAT-7i, SEAT-7j: loads that do not stop in time are reported; K4 stays commanded, K1 stays owed.
#[test]
fn loads_that_do_not_stop_in_time_are_reported() {
    let mut bus = Bus::opening_k1();
    let overdue = |decision: &Decision| decision.status.faults.contains(Faults::K1_OVERDUE);
    assert_eq!(bus.time_until(10, 20_000, overdue), Some(9_990));
    bus.run_with(60_000, 50, |decision| assert!(overdue(decision) && opens_k4(decision) && !opens_k1(decision)));
    bus.loads_stopped();
    assert!(opens_k1(&bus.step()));
}

/// SEAT-7h, SEAT-7j: K1 that does not confirm is reported within its deadline and stays commanded.
#[test]
fn k1_that_is_not_confirmed_in_time_is_reported_and_stays_commanded() {
    for k1 in [CLOSED, MISSING] {
        let mut bus = Bus::opening_k1();
        bus.loads_stopped();
        bus.inputs.k1 = k1;
        let overdue = |decision: &Decision| decision.status.faults.contains(Faults::K1_OVERDUE);
        assert!(bus.time_until(10, 10_000, overdue).is_some());
        bus.run_with(60_000, 50, |decision| assert!(overdue(decision) && opens_k1(decision)));
        bus.inputs.k1 = OPEN;
        bus.step();
        assert!(!overdue(&bus.step()));
    }
}

/// SEAT-7e, SEAT-7h: once both are confirmed open nothing is commanded any more and nothing is overdue.
#[test]
fn a_finished_shutdown_rests() {
    let mut bus = Bus::down();
    bus.run_with(700_000, 50, |decision| {
        assert_eq!(decision.outputs.contactors, Contactors::NEUTRAL);
        assert_eq!(decision.status.stage, Stage::Down);
        assert_eq!(decision.status.record, Record::HighVoltageDown);
    });
    assert_eq!(bus.step().status.faults, Faults::NONE);
}

/// SEAT-7a, SEAT-8a: high voltage that comes back after a complete shutdown, or is not known to be off, is opened again.
#[test]
fn what_closes_by_itself_is_opened_again() {
    for (k4, k1) in [(CLOSED, CLOSED), (CLOSED, OPEN), (OPEN, CLOSED), (MISSING, OPEN)] {
        let mut bus = Bus::down();
        (bus.inputs.k4, bus.inputs.k1) = (k4, k1);
        let decision = bus.step();
        assert_eq!(decision.status.stage, Stage::OpeningK4);
        assert!(opens_k4(&decision) && !opens_k1(&decision), "{k4:?} {k1:?}");
        bus.inputs.k4 = OPEN;
        assert!(opens_k1(&bus.step()));
        bus.inputs.k1 = OPEN;
        assert_eq!(bus.step().status.stage, Stage::Down);
        assert_eq!(bus.step().outputs.contactors, Contactors::NEUTRAL);
    }
}

/// SEAT-7c, SEAT-7d: the guards of the first time hold the second time, too.
#[test]
fn what_closes_by_itself_waits_for_the_guards() {
    let losses: [fn(&mut Bus); 3] = [
        |bus| bus.inputs.epb = unknown(Cause::Stale),
        |bus| bus.inputs.executed_torque = known(percent(20)),
        |bus| bus.occupied(),
    ];
    for lose in losses {
        let mut bus = Bus::down();
        lose(&mut bus);
        (bus.inputs.k4, bus.inputs.k1) = (CLOSED, CLOSED);
        let decision = bus.step();
        assert!(!opens_k4(&decision) && decision.status.stage == Stage::Down);
    }
}

// The commit.

/// SEAT-7k: the driver returns after the commit: the sequence runs on to K1 open, and nothing closes before.
#[test]
fn the_return_of_the_driver_does_not_stop_a_committed_shutdown() {
    let mut bus = Bus::opening_k4();
    bus.driver_returns();
    bus.ask_contactors(ContactorRequest::Close, ContactorRequest::Close);
    for key in [Key::Off, Key::Start, Key::On] {
        bus.inputs.key = known(key);
        let decision = bus.run_for(200);
        assert_eq!(decision.outputs.contactors, Contactors { k4: ContactorRequest::Open, k1: ContactorRequest::Hold });
    }
    bus.inputs.k4 = OPEN;
    bus.loads_stopped();
    assert!(opens_k1(&bus.step()));
    bus.inputs.k1 = OPEN;
    bus.ask_contactors(ContactorRequest::Hold, ContactorRequest::Hold);
    bus.run_for(1_000);
    assert_eq!(bus.step().outputs.contactors, Contactors::NEUTRAL);
}

/// SEAT-7k, SEAT-7d: during a committed shutdown no torque goes out, driver confirmed or not.
#[test]
fn during_a_committed_shutdown_there_is_no_torque() {
    for mut bus in [Bus::opening_k4(), Bus::opening_k1(), Bus::down()] {
        bus.driver_returns();
        bus.inputs.selector = known(Gear::Drive);
        bus.inputs.gear = known(Gear::Drive);
        // The gearbox has moved by itself: first that bypass is over.
        bus.run_for(2_100);
        bus.accelerator(travel(50));
        bus.ask_torque(1);
        assert_verdict(&bus.step(), Channel::DriveTorque, Kind::Limit, Reason::Shutdown);
    }
}
