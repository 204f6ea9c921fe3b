//! **May the parking brake be released?** (SEAT-5, EPB-1d)

mod common;
use common::*;

/// SEAT-5a, SEAT-5e: without a confirmed seat a release becomes none, whoever asks, in every stage.
#[test]
fn without_a_confirmed_seat_a_release_becomes_none() {
    let stages: [(&str, Make); 8] = [
        ("parked", Bus::parked),
        ("standing", || Bus::driving(kmh(0))),
        ("driving", || Bus::driving(kmh(50))),
        ("automated", || Bus::automated(kmh(30))),
        ("parked by leave", Bus::parked_by_leave),
        ("opening K4", Bus::opening_k4),
        ("opening K1", Bus::opening_k1),
        ("ready", Bus::ready_to_release),
    ];
    let (vacant, occupied) = (known(Seat::Vacant), known(Seat::Occupied));
    let mut seats = vec![[vacant, vacant], [vacant, occupied], [occupied, vacant]];
    for cause in CAUSES.iter().map(|cause| unknown(*cause)) {
        seats.extend([[cause, cause], [occupied, cause], [cause, occupied], [vacant, cause]]);
    }
    for (name, stage) in stages {
        let start = stage();
        for seat in &seats {
            for switch in EpbSwitch::ALL {
                let mut bus = start.clone();
                bus.inputs.seat = *seat;
                bus.inputs.epb_switch = known(*switch);
                bus.commands.epb =
                    Command::Fresh(ParkingBrake { request: EpbRequest::Release, mode: EpbMode::Automatic });
                bus.run_with(100, 10, |decision| {
                    assert!(!released(decision), "{name} {seat:?} {switch:?}");
                    assert_refused(decision, Channel::ParkingBrake);
                });
            }
        }
    }
    let mut bus = Bus::parked();
    bus.vacant();
    bus.ask_epb(EpbRequest::Release);
    let decision = bus.step();
    assert_eq!(decision.outputs.epb.request, EpbRequest::None, "SEAT-5e");
    assert_verdict(&decision, Channel::ParkingBrake, Kind::Block, Reason::SeatNotOccupied);
}

/// SEAT-5a: a release waits for the whole second of both sensors occupied, to the millisecond.
#[test]
fn a_release_waits_for_the_confirmed_seat_to_the_millisecond() {
    let mut bus = Bus::parked();
    bus.ask_epb(EpbRequest::Release);
    bus.vacant();
    bus.step();
    bus.occupied();
    assert_eq!(bus.time_until(1, 2_000, released), Some(1_000));
    bus.seat(known(Seat::Occupied), unknown(Cause::EndToEnd));
    assert!(!released(&bus.step_by(1)), "and is lost at once");
}

/// SEAT-5a: the driver's own release switch is no evidence for the seat, and originates nothing.
#[test]
fn the_release_switch_is_no_evidence() {
    let mut bus = Bus::parked();
    bus.inputs.epb_switch = known(EpbSwitch::Release);
    bus.run_with(1_000, 10, |decision| assert_eq!(decision.outputs.epb.request, EpbRequest::None));
    bus.vacant();
    bus.run_with(10_000, 10, |decision| assert_eq!(decision.outputs.epb.request, EpbRequest::None));
    assert!(released_after_asking(&mut Bus::parked()));
}

fn released_after_asking(bus: &mut Bus) -> bool {
    bus.ask_epb(EpbRequest::Release);
    released(&bus.step())
}

/// SELF-11d, SEAT-5a: outside of parked-by-leave the confirmed seat is enough.
#[test]
fn an_ordinary_release_needs_the_confirmed_seat_alone() {
    let mut bus = Bus::parked();
    bus.inputs.k1 = unknown(Cause::Stale);
    bus.inputs.k4 = known(Contact::Open);
    bus.inputs.accelerator = [unknown(Cause::Stale); 2];
    assert!(released_after_asking(&mut bus));
    assert_passed(&bus.step(), Channel::ParkingBrake);
}

/// SEAT-5b, SEAT-5c, SEAT-5d: after parked-by-leave the complete chain releases, in the cycle it is asked for.
#[test]
fn after_parked_by_leave_the_complete_chain_releases() {
    let mut bus = Bus::ready_to_release();
    bus.ask_epb(EpbRequest::Release);
    let decision = bus.step();
    assert!(released(&decision));
    assert_passed(&decision, Channel::ParkingBrake);
}

/// SEAT-5b: K1 and K4 must both be confirmed closed at the release.
#[test]
fn after_parked_by_leave_a_release_needs_both_contactors_closed() {
    for feedback in [known(Contact::Open), unknown(Cause::Stale), unknown(Cause::NeverReceived)] {
        for which in [0, 1] {
            let mut bus = Bus::ready_to_release();
            *(if which == 0 { &mut bus.inputs.k1 } else { &mut bus.inputs.k4 }) = feedback;
            bus.ask_epb(EpbRequest::Release);
            assert_verdict(&bus.step(), Channel::ParkingBrake, Kind::Block, Reason::ParkedByLeave);
            *(if which == 0 { &mut bus.inputs.k1 } else { &mut bus.inputs.k4 }) = known(Contact::Closed);
            assert!(!released(&bus.step()), "the accelerator must be pressed after that");
            bus.accelerator(travel(0));
            bus.step();
            bus.accelerator(travel(20));
            assert!(released(&bus.step()));
        }
    }
}

/// SEAT-5c: a confirmed gear other than neutral.
#[test]
fn after_parked_by_leave_a_release_needs_a_confirmed_gear() {
    for (gear, legal) in [
        (known(Gear::Neutral), false),
        (unknown(Cause::Stale), false),
        (known(Gear::Drive), true),
        (known(Gear::Reverse), true),
        (known(Gear::Park), true),
    ] {
        let mut bus = Bus::ready_to_release();
        bus.inputs.gear = gear;
        bus.ask_epb(EpbRequest::Release);
        assert_eq!(released(&bus.step()), legal, "{gear:?}");
    }
}

/// SEAT-5d: pressed all the time, or pressed before the rest was ready, is not pressed anew.
#[test]
fn the_accelerator_must_be_pressed_anew() {
    // Held down since before the driver was confirmed.
    let mut bus = Bus::parked_by_leave();
    bus.inputs.gear = known(Gear::Drive);
    bus.accelerator(travel(20));
    bus.ask_epb(EpbRequest::Release);
    bus.driver_returns();
    bus.run_with(5_000, 50, |decision| assert!(!released(decision)));
    // Never pressed.
    let mut bus = Bus::returned();
    bus.ask_epb(EpbRequest::Release);
    bus.run_with(5_000, 50, |decision| assert!(!released(decision)));
    // Released before the gear was confirmed, pressed after.
    let mut bus = Bus::parked_by_leave();
    bus.driver_returns();
    bus.accelerator(travel(20));
    bus.step();
    bus.inputs.gear = known(Gear::Drive);
    bus.ask_epb(EpbRequest::Release);
    assert!(!released(&bus.run_for(1_000)), "pressed before the gear was confirmed");
    bus.accelerator(travel(0));
    assert!(!released(&bus.run_for(1_000)), "released only");
    bus.accelerator(travel(20));
    assert!(released(&bus.step()));
}

/// SEAT-5d: an unknown accelerator, or tracks that disagree, is neither released nor pressed.
#[test]
fn an_unknown_accelerator_is_not_pressed_anew() {
    let tracks = [
        [unknown(Cause::Stale), known(travel(20))],
        [known(travel(20)), unknown(Cause::EndToEnd)],
        [known(travel_bits(0)), known(travel_bits(14))],
        [known(travel_bits(251)), known(travel_bits(251))],
        [known(travel_bits(255)), known(travel_bits(255))],
    ];
    for pair in tracks {
        let mut bus = Bus::returned();
        bus.inputs.accelerator = pair;
        bus.ask_epb(EpbRequest::Release);
        bus.run_with(1_000, 10, |decision| assert!(!released(decision), "{pair:?}"));
        // Nor does it count as "released" before the press.
        let mut bus = Bus::parked_by_leave();
        bus.inputs.gear = known(Gear::Drive);
        bus.accelerator(travel(20));
        bus.driver_returns();
        bus.inputs.accelerator = pair;
        bus.run_for(1_000);
        bus.accelerator(travel(20));
        bus.ask_epb(EpbRequest::Release);
        assert!(!released(&bus.run_for(1_000)), "{pair:?}");
    }
}

/// SEAT-5d: a seat that is lost for one cycle starts the whole chain again.
#[test]
fn a_seat_lost_for_one_cycle_starts_the_chain_again() {
    for seat in [known(Seat::Vacant), unknown(Cause::Stale)] {
        let mut bus = Bus::ready_to_release();
        bus.seat(known(Seat::Occupied), seat);
        bus.step();
        bus.occupied();
        bus.ask_epb(EpbRequest::Release);
        assert!(!released(&bus.run_for(5_000)), "confirmed again, accelerator still pressed from before");
        bus.accelerator(travel(0));
        bus.step();
        bus.accelerator(travel(20));
        assert!(released(&bus.step()));
    }
}

/// EPB-1d, SEAT-5e: the driver's apply switch refuses a release and applies.
#[test]
fn the_apply_switch_wins_over_a_release() {
    for mut bus in [Bus::parked(), Bus::ready_to_release()] {
        bus.inputs.epb_switch = known(EpbSwitch::Apply);
        bus.ask_epb(EpbRequest::Release);
        let decision = bus.step();
        assert!(applies(&decision));
        assert_verdict(&decision, Channel::ParkingBrake, Kind::Substitute, Reason::DriverSwitch);
    }
}

/// EPB-1d: the driver's legal release switch wins over the main controller's apply.
#[test]
fn the_release_switch_wins_over_an_apply_where_a_release_is_legal() {
    let mut bus = Bus::parked();
    bus.inputs.epb_switch = known(EpbSwitch::Release);
    bus.ask_epb(EpbRequest::Apply);
    assert_ne!(bus.step().outputs.epb.request, EpbRequest::Apply, "S4 6.2.11: the driver's switch first");
    // Without a confirmed seat SEAT-5 stands above the switch: the apply goes out.
    bus.vacant();
    assert_eq!(bus.step().outputs.epb.request, EpbRequest::Apply);
}
