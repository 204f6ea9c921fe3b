//! High voltage again after leave (SEAT-8, SEAT-9d).

mod common;
use common::*;

/// SEAT-8a: of all orders of the three steps, with On between or not, only seat → Off → Start closes.
#[test]
fn only_seat_then_off_then_start_closes() {
    use Act::{Off, On, Sit, Start};
    let orders: [(&[Act], bool); 14] = [
        (&[Sit, Off, Start], true),
        (&[Sit, Off, On, Start], true),
        (&[Sit, On, Off, On, Start], true),
        (&[Off, Sit, Start], true), // the key is still Off when the seat is confirmed
        (&[Off, On, Sit, Start], false),
        (&[Sit, Start, Off], false),
        (&[Off, Start, Sit], false),
        (&[Start, Sit, Off], false),
        (&[Start, Off, Sit], false),
        (&[Sit, Start], false),
        (&[Sit, On, Start], false),
        (&[Off, Start], false),
        (&[Sit, Off], false),
        (&[Sit, Off, On], false),
    ];
    for (order, expected) in orders {
        let mut bus = Bus::asking_to_close();
        let Some((last, before)) = order.split_last() else { unreachable!("an order has steps") };
        for step in before {
            bus.act(*step);
            assert!(!closes(&bus.step()), "{order:?}: before its end");
        }
        bus.act(*last);
        assert_eq!(closes(&bus.step()), expected, "{order:?}");
    }
}

/// SEAT-8a: Start must be an edge: held through, it is none; and an unknown key is neither Off nor Start.
#[test]
fn start_must_be_an_edge() {
    let mut bus = Bus::asking_to_close();
    bus.inputs.key = known(Key::Start);
    bus.act(Act::Sit);
    assert!(!closes(&bus.run_for(1_000)), "held since before");
    for cause in CAUSES {
        let mut bus = Bus::asking_to_close();
        bus.act(Act::Sit);
        bus.inputs.key = unknown(*cause);
        bus.run_for(500);
        bus.act(Act::Start);
        assert!(!closes(&bus.step()), "unknown is not Off");
        let mut bus = Bus::asking_to_close();
        bus.act(Act::Sit);
        bus.act(Act::Off);
        bus.inputs.key = unknown(*cause);
        assert!(!closes(&bus.run_for(500)), "unknown is not Start");
    }
}

/// SEAT-8a: the key counts only after the seat is confirmed, to the millisecond.
#[test]
fn a_key_before_the_seat_is_confirmed_does_not_count() {
    let mut bus = Bus::asking_to_close();
    bus.occupied();
    bus.run_for(990); // 980 ms since the first sample
    bus.act(Act::Off);
    bus.act(Act::On);
    bus.run_for(500);
    bus.act(Act::Start);
    assert!(!closes(&bus.run_for(500)));
}

/// SEAT-8b: a seat that is vacant for one cycle between any two steps starts the order again.
#[test]
fn a_vacant_seat_between_starts_the_order_again() {
    use Act::{Off, Sit, Start};
    for cut in 1..=2 {
        let mut bus = Bus::asking_to_close();
        for (index, step) in [Sit, Off, Start].into_iter().enumerate() {
            if index == cut {
                bus.vacant();
                bus.step();
                bus.inputs.key = if cut == 2 { known(Key::Off) } else { bus.inputs.key };
                bus.inputs.key = known(Key::On);
                bus.act(Sit);
                if cut == 1 {
                    // Only the seat had been done: confirmed again, the rest may follow.
                    bus.act(Off);
                    bus.act(Start);
                    assert!(closes(&bus.step()));
                    break;
                }
            }
            bus.act(step);
        }
        assert_eq!(closes(&bus.step()), cut == 1, "vacant before step {cut}");
    }
    // And after the last one, before anything has closed.
    let mut bus = Bus::restarted();
    assert!(closes(&bus.step()));
    bus.vacant();
    assert!(!closes(&bus.step()), "closing needs the driver in its own cycle");
    bus.occupied();
    assert!(!closes(&bus.run_for(3_000)), "and the keys again");
}

/// SEAT-8a: in the cycle of a closing command both seat sensors are known occupied.
#[test]
fn closing_needs_the_driver_in_its_own_cycle() {
    for seat in [known(Seat::Vacant), unknown(Cause::Stale), unknown(Cause::EndToEnd)] {
        for first in [false, true] {
            let mut bus = Bus::restarted();
            bus.inputs.seat[usize::from(first)] = seat;
            assert!(!closes(&bus.step_by(1)), "{seat:?}");
            assert_verdict(&bus.step_by(1), Channel::Contactors, Kind::Block, Reason::NoRestart);
        }
    }
}

/// SEAT-8c: K1 closes first; K4 only with K1 confirmed closed; then nothing more is to close. CMD-3b: the pair is limited
/// while one of the two moves, blocked when neither does.
#[test]
fn k1_closes_before_k4() {
    let mut bus = Bus::restarted();
    let k1_only = Contactors { k4: ContactorRequest::Hold, k1: ContactorRequest::Close };
    bus.run_with(1_000, 10, |decision| assert_eq!(decision.outputs.contactors, k1_only));
    assert_verdict(&bus.step(), Channel::Contactors, Kind::Limit, Reason::K1NotClosed);
    bus.ask_contactors(ContactorRequest::Close, ContactorRequest::Hold);
    assert_verdict(&bus.step(), Channel::Contactors, Kind::Block, Reason::K1NotClosed);
    for k1 in [unknown(Cause::Stale), OPEN] {
        bus.inputs.k1 = k1;
        assert_eq!(bus.step().outputs.contactors.k4, ContactorRequest::Hold);
    }
    bus.inputs.k1 = CLOSED;
    bus.ask_contactors(ContactorRequest::Close, ContactorRequest::Hold);
    assert_passed(&bus.step(), Channel::Contactors);
    bus.inputs.k4 = CLOSED;
    bus.step();
    bus.inputs.k4 = OPEN;
    assert!(!closes(&bus.run_for(1_000)), "HV-1d: used up: what drops out later does not close again");
}

/// HV-1d, SEAT-9c: the supervisor itself closes nothing.
#[test]
fn the_supervisor_itself_closes_nothing() {
    let mut bus = Bus::restarted();
    for command in [Command::Absent, Command::Rejected(Rejection::Counter), Command::Fresh(Contactors::NEUTRAL)] {
        bus.commands.contactors = command;
        bus.run_with(2_000, 10, |decision| assert!(!closes(decision)));
    }
}

/// SEAT-8c, SEAT-5b to SEAT-5d, SEAT-6b: the whole way back: seat, keys, K1, K4, gear, accelerator, release, torque.
#[test]
fn the_whole_way_back_leads_to_driving() {
    let mut bus = Bus::restarted();
    bus.step();
    bus.inputs.k1 = CLOSED;
    bus.ask_contactors(ContactorRequest::Close, ContactorRequest::Hold);
    bus.step();
    bus.inputs.k4 = CLOSED;
    bus.ask_contactors(ContactorRequest::Hold, ContactorRequest::Hold);
    bus.inputs.key = known(Key::On);
    bus.inputs.selector = known(Gear::Drive);
    bus.ask_gear(GearRequest::Drive);
    assert_passed(&bus.step(), Channel::Gear);
    bus.inputs.gear = known(Gear::Drive);
    bus.step();
    bus.accelerator(travel(20));
    bus.ask_epb(EpbRequest::Release);
    assert_passed(&bus.step(), Channel::ParkingBrake);
    bus.ask_epb(EpbRequest::None);
    bus.inputs.epb = known(EpbState::Released);
    bus.accelerator(travel(0));
    bus.step();
    bus.accelerator(travel(20));
    bus.ask_torque(2);
    let decision = bus.step();
    assert_passed(&decision, Channel::DriveTorque);
    assert_eq!((decision.status.stage, decision.status.record), (Stage::Up, Record::None));
    assert!(!decision.status.parked_by_leave);
}

/// SEAT-9d: and then a second leave does all of it again, to K1 open.
#[test]
fn a_second_leave_shuts_down_again() {
    let mut bus = Bus::restarted();
    bus.step();
    bus.inputs.k1 = CLOSED;
    bus.ask_contactors(ContactorRequest::Close, ContactorRequest::Hold);
    bus.step();
    bus.inputs.k4 = CLOSED;
    bus.ask_contactors(ContactorRequest::Hold, ContactorRequest::Hold);
    bus.run_for(100);
    bus.inputs.selector = known(Gear::Drive);
    bus.inputs.gear = known(Gear::Drive);
    bus.step();
    bus.accelerator(travel(20));
    bus.ask_epb(EpbRequest::Release);
    bus.step();
    bus.ask_epb(EpbRequest::None);
    bus.accelerator(travel(0));
    bus.inputs.epb = known(EpbState::Released);
    bus.run_for(100);
    bus.vacant();
    let decision = bus.run_for(2_010);
    assert_eq!(decision.status.occupancy, Occupancy::Leave);
    assert_eq!(decision.outputs.epb.request, EpbRequest::Apply);
    bus.inputs.epb = known(EpbState::Applied);
    bus.run_coarse(599_000);
    assert_eq!(bus.step().outputs.contactors, Contactors::NEUTRAL);
    let decision = bus.run_coarse(1_500);
    assert_eq!(decision.outputs.contactors.k4, ContactorRequest::Open);
    bus.inputs.k4 = OPEN;
    assert_eq!(bus.step().outputs.contactors.k1, ContactorRequest::Open);
}
