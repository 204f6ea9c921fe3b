//! Drive torque: the driver's pedal, limits and gradient, brake and gear (TRQ-1, TRQ-5, TRQ-6).

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

// TRQ-1.

/// TRQ-1a, SELF-11a: torque up to the pedal map (linear: per cent pedal = per cent torque) passes at every travel.
#[test]
fn torque_up_to_the_pedal_map_passes_at_every_travel() {
    for bits in 0..=250_u8 {
        let mapped = u8::try_from(u16::from(bits) * 2 / 5).unwrap_or(0); // 0.4 % per bit
        let mut bus = Bus::driving(FAST);
        bus.accelerator(travel_bits(bits));
        let decision = settled(&mut bus, mapped);
        assert_eq!(decision.outputs.drive.torque, percent(mapped), "{bits}");
        assert_passed(&decision, Channel::DriveTorque);
    }
}

/// TRQ-1a: never more than the map and the 5 % tolerance; the limit is the nearest value and says why.
#[test]
fn torque_beyond_map_and_tolerance_is_limited() {
    for bits in 0..=250_u8 {
        let mapped = u8::try_from(u16::from(bits) * 2 / 5).unwrap_or(0);
        let mut bus = Bus::driving(FAST);
        bus.accelerator(travel_bits(bits));
        let decision = settled(&mut bus, 100);
        assert!(decision.outputs.drive.torque <= percent(mapped.saturating_add(5).min(100)), "{bits}");
        if mapped <= 94 {
            assert_verdict(&decision, Channel::DriveTorque, Kind::Limit, Reason::PedalMap);
        }
    }
    let mut bus = Bus::driving(FAST);
    bus.accelerator(travel(0));
    for torque in 1..=255 {
        assert_eq!(settled(&mut bus, torque).outputs.drive.torque, Percent::ZERO, "no pedal, no torque");
    }
}

/// TRQ-1b: an unknown track, tracks that disagree by more than 5 %, or an impossible travel: no torque.
#[test]
fn an_unknown_accelerator_gives_no_torque() {
    let mut tracks: Vec<[Signal<Pedal250>; 2]> = vec![
        [known(travel_bits(100)), known(travel_bits(114))],
        [known(travel_bits(114)), known(travel_bits(100))],
        [known(travel_bits(251)), known(travel_bits(251))],
        [known(travel_bits(254)), known(travel_bits(254))],
        [known(travel_bits(255)), known(travel_bits(250))],
    ];
    for cause in CAUSES {
        tracks.push([unknown(*cause), known(travel_bits(100))]);
        tracks.push([known(travel_bits(100)), unknown(*cause)]);
    }
    for pair in tracks {
        let mut bus = Bus::driving(FAST);
        bus.inputs.accelerator = pair;
        bus.ask_torque(1);
        let decision = bus.step();
        assert_eq!(decision.outputs.drive.torque, Percent::ZERO, "{pair:?}");
        assert_verdict(&decision, Channel::DriveTorque, Kind::Limit, Reason::AcceleratorUnknown);
        assert!(decision.status.faults.contains(Faults::ACCELERATOR_UNKNOWN));
    }
}

/// TRQ-1a, E2E-1d: tracks that agree within 5 % count with the lower one.
#[test]
fn tracks_that_agree_count_with_the_lower_one() {
    for pair in [[100, 113], [113, 100], [100, 112]] {
        let mut bus = Bus::driving(FAST);
        bus.inputs.accelerator = pair.map(|bits| known(travel_bits(bits)));
        let decision = settled(&mut bus, 100);
        assert!((40..=45).contains(&decision.outputs.drive.torque.raw()), "{pair:?}");
    }
}

/// TRQ-1c: an accelerator at its configured threshold (4 %) is not pressed, one bit beyond it is.
#[test]
fn an_accelerator_is_pressed_beyond_its_threshold() {
    let threshold = Config::DEFAULT.pedal_pressed.raw();
    for (bits, passes) in [(threshold, true), (threshold + 1, false)] {
        let mut bus = Bus::driving(FAST);
        bus.accelerator(travel_bits(bits));
        bus.brake_pedal(travel(20));
        bus.ask_torque(1);
        assert_eq!(bus.step().verdicts.of(Channel::DriveTorque).passed(), passes, "{bits}");
    }
}

/// TRQ-1c: both pedals pressed: no torque; so with the brake pedal unknown.
#[test]
fn both_pedals_give_no_torque() {
    let presses: [Change; 6] = [
        ("pressed", |bus| bus.brake_pedal(travel(10))),
        ("switch only", |bus| bus.inputs.brake_switch = known(true)),
        ("one track only", |bus| bus.inputs.brake_pedal[0] = known(travel(20))),
        ("switch unknown", |bus| bus.inputs.brake_switch = unknown(Cause::Stale)),
        ("track unknown", |bus| bus.inputs.brake_pedal[1] = unknown(Cause::Stale)),
        ("track impossible", |bus| bus.inputs.brake_pedal[1] = known(travel_bits(251))),
    ];
    for (name, press) in presses {
        let mut bus = Bus::driving(FAST);
        bus.accelerator(travel(50));
        press(&mut bus);
        bus.ask_torque(1);
        let decision = bus.step();
        assert_eq!(decision.outputs.drive.torque, Percent::ZERO, "{name}");
        assert_verdict(&decision, Channel::DriveTorque, Kind::Limit, Reason::BothPedals);
    }
}

// TRQ-5.

/// TRQ-5a: torque up to the electric limit; unknown or impossible: none.
#[test]
fn torque_stays_below_the_electric_limit() {
    for (limit, most) in [
        (known(percent(0)), 0),
        (known(percent(30)), 30),
        (known(percent(100)), 100),
        (known(percent(101)), 0),
        (unknown(Cause::Stale), 0),
        (unknown(Cause::NotAvailable), 0),
    ] {
        let mut bus = Bus::driving(FAST);
        bus.inputs.drive_limit = limit;
        bus.accelerator(travel(100));
        let decision = settled(&mut bus, 100);
        assert_eq!(decision.outputs.drive.torque, percent(most), "{limit:?}");
        if most < 100 {
            assert_verdict(&decision, Channel::DriveTorque, Kind::Limit, Reason::DriveLimit);
        }
    }
    let mut bus = cruising(30);
    bus.inputs.drive_limit = known(percent(20));
    assert_eq!(bus.step().outputs.drive.torque, percent(20), "at once, and for every origin");
}

/// TRQ-5b, TRQ-5c: rises follow the gradient (200 %/s) from our last output, falls are never limited.
#[test]
fn rises_follow_the_gradient_and_falls_are_free() {
    let mut bus = Bus::driving(FAST);
    bus.accelerator(travel(100));
    bus.ask_torque(100);
    for expected in [2, 4, 6, 8] {
        let decision = bus.step();
        assert_eq!(decision.outputs.drive.torque, percent(expected));
        assert_verdict(&decision, Channel::DriveTorque, Kind::Limit, Reason::TorqueRamp);
    }
    bus.run_for(1_000);
    for torque in [99, 50, 0] {
        bus.ask_torque(torque);
        let decision = bus.step();
        assert_eq!(decision.outputs.drive.torque, percent(torque));
        assert_passed(&decision, Channel::DriveTorque);
    }
    bus.ask_torque(100);
    assert_eq!(bus.step().outputs.drive.torque, percent(2), "from our last output");
}

/// TRQ-5b: in every legal cycle the torque rises as the gradient says, neither faster nor never.
#[test]
fn in_every_legal_cycle_the_torque_rises_as_the_gradient_says() {
    for cycle in [1, 2, 3, 4, 5, 7, 10, 13, 25, 50] {
        let mut bus = Bus::driving(FAST);
        bus.accelerator(travel(100));
        bus.ask_torque(100);
        let span = 350 / cycle * cycle;
        let torque = u32::from(bus.run_with(span, cycle, |_| {}).outputs.drive.torque.raw());
        assert!(torque * 1_000 <= 200 * span, "{cycle} ms: {torque} % in {span} ms");
        assert!(torque >= 50, "{cycle} ms: {torque} % of 70 in {span} ms");
    }
}

/// TRQ-5d: after an obligation torque rises from 0 with the gradient.
#[test]
fn after_an_obligation_torque_rises_from_zero() {
    let mut bus = Bus::driving(FAST);
    bus.accelerator(travel(50));
    settled(&mut bus, 50);
    bus.ahead(object(4_399, 1_000));
    bus.step();
    bus.road_clear();
    let ended = bus.time_until(10, 1_000, |decision| decision.status.level == Level::None);
    assert_eq!(ended, Some(500));
    let first = bus.last.map_or(0, |decision| decision.outputs.drive.torque.raw());
    assert!(first <= 2);
    assert!(bus.step().outputs.drive.torque <= percent(first + 2));
}

/// TRQ-5f, TRQ-5g: `EPBi` torque below the idle torque (6 %) is none; ADAS and driver torque of 1 to 5 % passes.
#[test]
fn epbi_torque_below_idle_is_none() {
    for (torque, passes) in [(1, false), (5, false), (6, true), (7, true)] {
        let mut bus = Bus::automated_by_epbi(FAST);
        bus.commands.drive =
            Command::Fresh(DriveTorque { torque: percent(torque), active: true, origin: Origin::Epbi });
        let decision = bus.run_for(1_000);
        assert_eq!(decision.outputs.drive.torque > Percent::ZERO, passes, "{torque}");
        if !passes {
            assert_verdict(&decision, Channel::DriveTorque, Kind::Block, Reason::IdleTorque);
        }
        let mut bus = Bus::automated(FAST);
        bus.ask_adas(torque);
        assert_passed(&bus.run_for(1_000), Channel::DriveTorque);
        let mut bus = Bus::driving(FAST);
        bus.accelerator(travel(20));
        assert_passed(&settled(&mut bus, torque), Channel::DriveTorque);
    }
}

/// TRQ-5b, RSP-1n: slip control at work lets torque stay or fall, never rise.
#[test]
fn with_slip_control_at_work_torque_does_not_rise() {
    let mut bus = Bus::driving(FAST);
    bus.accelerator(travel(100));
    settled(&mut bus, 30);
    bus.inputs.asr = known(true);
    bus.ask_torque(50);
    assert_eq!(bus.run_for(500).outputs.drive.torque, percent(30));
    assert_verdict(&bus.step(), Channel::DriveTorque, Kind::Limit, Reason::SlipControl);
    bus.ask_torque(20);
    assert_passed(&bus.step(), Channel::DriveTorque);
    bus.ask_torque(30);
    assert_eq!(bus.step().outputs.drive.torque, percent(20));
}

// TRQ-6.

/// TRQ-6a: with a brake demand no torque, above 2 km/h; the retarder is a brake demand too.
#[test]
fn with_a_brake_demand_there_is_no_torque() {
    for speed in [kmh(2), FAST] {
        let mut bus = Bus::driving(speed);
        bus.accelerator(travel(50));
        bus.ask_brake(DecelMs2Q11::new(1));
        bus.ask_torque(2);
        assert_verdict(&bus.step(), Channel::DriveTorque, Kind::Limit, Reason::BrakeDemand);
        let mut bus = Bus::driving(speed);
        bus.accelerator(travel(50));
        bus.commands.retarder =
            Command::Fresh(Retarder { torque: percent(1), mode: RetarderMode::Torque, priority: Priority::Low });
        bus.ask_torque(2);
        assert_verdict(&bus.step(), Channel::DriveTorque, Kind::Limit, Reason::BrakeDemand);
    }
}

/// On a hill below 2 km/h: the service brake holds, the driver presses the accelerator.
fn hill(speed: SpeedKmhQ8) -> Bus {
    let mut bus = Bus::driving(speed);
    bus.accelerator(travel(50));
    bus.ask_brake(ms2(100));
    bus
}

/// TRQ-6b: hill-hold: below 2 km/h driver torque goes against the brake, for at most 1 s.
#[test]
fn hill_hold_lasts_one_second() {
    let mut bus = hill(kmh_q8(511));
    bus.ask_torque(2);
    assert_passed(&bus.step(), Channel::DriveTorque);
    let mut lasted = 0;
    while bus.step().outputs.drive.torque > Percent::ZERO {
        lasted += CYCLE;
        assert!(lasted <= 1_000, "TRQ-6b: at most 1 s");
    }
    // From the first output to the last, and the cycle for which the last one stands.
    assert!((900..=990).contains(&lasted), "out at 0 and still at {lasted} ms");
    bus.run_with(5_000, 10, |decision| assert_eq!(decision.outputs.drive.torque, Percent::ZERO, "once"));
}

/// TRQ-6b: the second counts from the torque, not from the brake: a bus that has stood on its brake moves off.
#[test]
fn hill_hold_counts_from_the_torque() {
    let mut bus = hill(kmh(0));
    bus.run_for(10_000);
    bus.ask_torque(2);
    bus.run_with(900, 10, |decision| assert_passed(decision, Channel::DriveTorque));
    assert_eq!(bus.run_for(500).outputs.drive.torque, Percent::ZERO);
    // The brake let go in between gives another second.
    bus.ask_brake(ms2(0));
    bus.step();
    bus.ask_brake(ms2(100));
    assert_passed(&bus.step(), Channel::DriveTorque);
}

/// TRQ-6b: against the retarder alone it lasts no longer.
#[test]
fn hill_hold_against_the_retarder_lasts_no_longer() {
    let mut bus = Bus::driving(kmh(1));
    bus.accelerator(travel(50));
    bus.commands.retarder =
        Command::Fresh(Retarder { torque: percent(50), mode: RetarderMode::Torque, priority: Priority::Low });
    bus.ask_torque(2);
    bus.run_for(1_020);
    bus.run_with(5_000, 10, |decision| assert_eq!(decision.outputs.drive.torque, Percent::ZERO));
}

/// TRQ-6b: hill-hold needs the driver, slow, confirmed: each missing condition refuses it.
#[test]
fn hill_hold_needs_the_driver_and_a_slow_bus() {
    let changes: [Change; 5] = [
        ("2 km/h", |bus| bus.speed(kmh(2))),
        ("one speed at 2 km/h", |bus| bus.speeds(kmh(1), kmh(2))),
        ("speed unknown", Bus::speed_unknown),
        ("seat", |bus| bus.inputs.seat[0] = unknown(Cause::Stale)),
        ("vacant", Bus::vacant),
    ];
    for (name, change) in changes {
        let mut bus = hill(kmh(1));
        change(&mut bus);
        bus.ask_torque(2);
        assert_eq!(bus.step().outputs.drive.torque, Percent::ZERO, "{name}");
    }
    let mut bus = Bus::automated(kmh(1));
    bus.ask_brake(ms2(100));
    bus.ask_adas(2);
    assert_eq!(bus.run_for(100).outputs.drive.torque, Percent::ZERO, "driver origin only");
}

/// TRQ-6c: torque only in a confirmed driving gear.
#[test]
fn torque_needs_a_confirmed_driving_gear() {
    for (gear, passes) in [
        (known(Gear::Drive), true),
        (known(Gear::Reverse), true),
        (known(Gear::Neutral), false),
        (known(Gear::Park), false),
        (unknown(Cause::Stale), false),
        (unknown(Cause::NeverReceived), false),
    ] {
        let mut bus = Bus::driving(kmh(0));
        bus.engage(gear);
        bus.accelerator(travel(50));
        bus.ask_torque(2);
        let decision = bus.step();
        assert_eq!(decision.verdicts.of(Channel::DriveTorque).passed(), passes, "{gear:?}");
        if !passes {
            assert_verdict(&decision, Channel::DriveTorque, Kind::Limit, Reason::GearDirection);
        }
    }
}

/// TRQ-6c, RULE-3e: no torque in a cycle that commands another gear than the confirmed one.
#[test]
fn no_torque_while_the_gear_changes() {
    for (request, selector, passes) in [
        (GearRequest::Hold, Gear::Drive, true),
        (GearRequest::Drive, Gear::Drive, true),
        (GearRequest::Reverse, Gear::Reverse, false),
        (GearRequest::Neutral, Gear::Neutral, false),
        (GearRequest::Park, Gear::Park, false),
    ] {
        let mut bus = Bus::driving(kmh(0));
        bus.inputs.selector = known(selector);
        bus.accelerator(travel(50));
        bus.ask_gear(request);
        bus.ask_torque(2);
        let decision = bus.step();
        assert_passed(&decision, Channel::Gear);
        assert_eq!(decision.verdicts.of(Channel::DriveTorque).passed(), passes, "{request:?}");
    }
}
