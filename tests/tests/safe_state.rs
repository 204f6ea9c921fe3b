//! The supervisor itself: retained state and safe state (SELF-5, RULE-4).

mod common;
use common::*;

const FAST: SpeedKmhQ8 = kmh(50);

/// Situations with something to lose.
fn situations() -> Vec<(&'static str, Bus)> {
    let mut mitigating = Bus::driving(FAST);
    mitigating.ahead(object(2_700, 1_000));
    mitigating.step();
    vec![
        ("driving", Bus::driving(FAST)),
        ("mitigating", mitigating),
        ("steering", Bus::steering(kmh(10))),
        ("leave", Bus::leave(FAST)),
        ("parked by leave", Bus::parked_by_leave()),
        ("opening K4", Bus::opening_k4()),
        ("down", Bus::down()),
    ]
}

/// SELF-5a, SELF-5b: every flipped bit of every retained word is the safe state in the next cycle, and stays it.
#[test]
fn every_flipped_bit_is_the_safe_state() {
    for (name, bus) in situations() {
        for index in 0..Bus::image_words() {
            for bit in 0..32 {
                let mut flipped = bus.with_image(|image| image.with_flipped_bit(index, bit));
                let decision = flipped.step_unjudged(CYCLE);
                assert!(decision.status.safe_state, "{name} word {index} bit {bit}");
                assert!(decision.status.faults.contains(Faults::STATE));
                assert_eq!(decision.outputs.drive.torque, Percent::ZERO);
                assert!(flipped.step_unjudged(CYCLE).status.safe_state, "latched");
            }
        }
    }
}

/// SELF-5a: two bits that hide each other in a word and its complement decode to something or to the safe state.
#[test]
fn a_word_and_its_complement_flipped_together_never_panic() {
    let bus = Bus::driving(FAST);
    for index in 0..STATE_WORDS {
        for bit in 0..32 {
            let mut flipped =
                bus.with_image(|image| image.with_flipped_bit(index, bit).with_flipped_bit(index + STATE_WORDS, bit));
            let decision = flipped.step_unjudged(CYCLE);
            assert!(decision.envelope.is_feasible());
        }
    }
}

/// SELF-5a: the same bit in two words: what one flip does to the check, the other does not undo.
#[test]
fn two_flips_do_not_hide_each_other() {
    let image = StateImage::encode(&State::INITIAL);
    for index in 0..STATE_WORDS {
        for other in (0..2 * STATE_WORDS).filter(|other| other % STATE_WORDS != index) {
            let flipped = image.with_flipped_bit(index, 7).with_flipped_bit(other, 7);
            assert!(!flipped.intact(), "{index} and {other}");
        }
    }
}

/// SELF-5a: a flip changes the one bit, set or not, and a second one brings it back; behind the digest there is none.
#[test]
fn a_flip_is_its_own_way_back() {
    let image = StateImage::encode(&State::boot(ResetCause::PowerOn, None));
    for index in 0..=2 * STATE_WORDS {
        for bit in 0..32 {
            let flipped = image.with_flipped_bit(index, bit);
            assert_ne!(flipped, image, "word {index} bit {bit}");
            assert_eq!(flipped.with_flipped_bit(index, bit), image, "word {index} bit {bit}");
            assert_eq!(flipped.intact(), index == 2 * STATE_WORDS, "the digest is asked only where the copies differ");
        }
    }
    assert_eq!(image.with_flipped_bit(2 * STATE_WORDS + 1, 0), image);
}

/// SELF-5c: memory that was cleared is no state: neither of its copies is called whole.
#[test]
fn cleared_memory_is_no_state() {
    let state = State::INITIAL;
    let mut words = Vec::new();
    state.write(&mut |word| words.push(word));
    let digest = words.iter().fold(u32::MAX, |digest, word| digest.rotate_left(5) ^ word);
    let complements: Vec<u32> = words.iter().map(|word| !word).collect();
    let all = words.into_iter().chain(complements).chain([digest]);
    let set = all
        .enumerate()
        .flat_map(|(index, word)| (0..32).filter(move |bit| word >> bit & 1 == 1).map(move |bit| (index, bit)));
    let cleared = set.fold(StateImage::encode(&state), |image, (index, bit)| image.with_flipped_bit(index, bit));
    let text = format!("{cleared:?}");
    assert!(!text.contains(|digit: char| ('1'..='9').contains(&digit)), "nothing is left: {text}");
    assert_eq!((cleared.decode::<State>(), cleared.recover::<State>()), (None, None));
}

/// SELF-5b: the safe state stays, whatever is read or asked for afterwards, over a key cycle too (SELF-7 clears it).
#[test]
fn the_safe_state_is_latched() {
    let mut bus = safe(&Bus::parked());
    for key in [Key::Off, Key::On, Key::Start, Key::On] {
        bus.inputs.key = known(key);
        assert!(bus.run_for(2_000).status.safe_state);
    }
}

/// The same bus in the safe state.
fn safe(bus: &Bus) -> Bus {
    let mut bus = bus.with_image(|image| image.with_flipped_bit(0, 0));
    assert!(bus.step().status.safe_state);
    bus
}

/// SELF-5c, SELF-5f, SELF-5h: no torque, gear and contactors hold, flashers on, mode manual, whatever is asked for.
#[test]
fn in_the_safe_state_nothing_moves() {
    for (name, bus) in situations() {
        let mut bus = safe(&bus);
        bus.accelerator(travel(100));
        bus.ask_torque(50);
        bus.commands.mode = Command::Fresh(DrivingMode::Automated);
        bus.commands.target_speed = Command::Fresh(kmh(60));
        for gear in GearRequest::ALL {
            bus.ask_gear(*gear);
            bus.ask_contactors(ContactorRequest::Open, ContactorRequest::Close);
            let Outputs { drive, gear, contactors, mode, warnings, target_speed, .. } = bus.step().outputs;
            assert_eq!(drive.torque, Percent::ZERO, "{name}");
            assert_eq!((gear, contactors), (GearRequest::Hold, Contactors::NEUTRAL), "{name}");
            assert_eq!((mode, target_speed), (DrivingMode::Manual, kmh(0)), "{name}");
            assert!(warnings.hazard_flashers && warnings.fault_lamp, "{name}");
        }
        bus.ask_gear(GearRequest::Drive);
        assert_verdict(&bus.step(), Channel::Gear, Kind::Block, Reason::SafeState);
    }
}

/// SELF-5d: the brake is the greatest of valid request ≤ 6, a₀(v) if vacant, 1.35 below 2 km/h.
#[test]
fn in_the_safe_state_the_brake_is_the_greatest_demand() {
    let vacant = [known(Seat::Vacant); 2];
    let occupied = [known(Seat::Occupied); 2];
    let blank = [known(Seat::Vacant), unknown(Cause::Stale)];
    // Seat, speed, request, expected; hundredths of a m/s².
    let cases = [
        (occupied, FAST, 0, 0),
        (occupied, FAST, 300, 300),
        (occupied, FAST, 600, 600),
        (occupied, FAST, 601, 600),
        (occupied, FAST, 3_000, 600),
        (occupied, kmh(2), 0, 0),
        (occupied, kmh_q8(511), 0, 135),
        (occupied, kmh(0), 0, 135),
        (occupied, kmh(0), 200, 200),
        (vacant, FAST, 0, 195),
        (vacant, FAST, 100, 195),
        (vacant, FAST, 400, 400),
        (vacant, kmh(2), 0, 135),
        (vacant, kmh(0), 0, 135),
        (blank, FAST, 0, 0),
        (blank, kmh(1), 0, 135),
    ];
    for (seat, speed, request, expected) in cases {
        let mut bus = safe(&Bus::driving(FAST));
        bus.inputs.seat = seat;
        bus.speed(speed);
        bus.ask_brake(ms2(request));
        let total = bus.step().outputs.brake.total;
        assert_eq!(total, ms2(expected), "{seat:?} {speed:?} {request}");
    }
    // An invalid request counts for nothing.
    for command in
        [Command::Absent, Command::Rejected(Rejection::Checksum), Command::Held(Millis::new(126), braking(ms2(500)))]
    {
        let mut bus = safe(&Bus::driving(FAST));
        bus.commands.brake = command;
        assert_eq!(bus.run_for(1_000).outputs.brake.total, ms2(0), "{command:?}");
    }
}

/// SELF-5d, SELF-3f: obligations persist in the safe state: leave and levels that run on an intact state.
#[test]
fn obligations_persist_in_the_safe_state() {
    let stop_clock = |bus: &mut Bus| {
        bus.step_by(0);
        bus.step_by(0);
        assert!(bus.step_by(0).status.safe_state);
    };
    let mut bus = Bus::leave(FAST);
    stop_clock(&mut bus);
    bus.inputs.seat = [unknown(Cause::Stale); 2];
    assert_eq!(bus.run_for(1_000).outputs.brake.total, ms2(195), "leave");
    let mut bus = Bus::driving(FAST);
    bus.ahead(object(2_700, 1_000));
    bus.step();
    stop_clock(&mut bus);
    bus.road_clear();
    assert_eq!(bus.run_for(1_000).outputs.brake.total, ms2(500), "level 3");
    let mut bus = safe(&Bus::driving(FAST));
    bus.ahead(object(2_700, 1_000));
    assert_eq!(bus.step().outputs.brake.total, ms2(500), "and new ones begin");
    bus.road_clear();
    let mut bus = safe(&Bus::driving(FAST));
    bus.vacant();
    assert!(bus.run_for(2_010).outputs.warnings.seat_leave);
}

/// SELF-5e: the parking brake is applied below 1.5 km/h, else none; a release never, an apply above never.
#[test]
fn in_the_safe_state_the_parking_brake_is_applied_below_1_5_kmh() {
    for (speed, request) in [
        (Some(kmh(0)), EpbRequest::Apply),
        (Some(bit_below(KMH_1_5)), EpbRequest::Apply),
        (Some(KMH_1_5), EpbRequest::None),
        (Some(FAST), EpbRequest::None),
        (None, EpbRequest::None),
    ] {
        for asked in EpbRequest::ALL {
            let mut bus = safe(&Bus::driving(FAST));
            match speed {
                Some(speed) => bus.speed(speed),
                None => bus.speed_unknown(),
            }
            bus.ask_epb(*asked);
            assert_eq!(bus.run_for(1_500).outputs.epb.request, request, "{speed:?} {asked:?}");
        }
    }
}

/// SELF-5d, SELF-5e, RULE-1d: a hold that has begun below 2 km/h is not cancelled by losing the speed.
#[test]
fn in_the_safe_state_a_lost_speed_cancels_no_hold() {
    let mut bus = safe(&Bus::driving(FAST));
    bus.speed(kmh(0));
    let decision = bus.step();
    assert_eq!((decision.outputs.brake.total, decision.outputs.epb.request), (ms2(135), EpbRequest::Apply));
    bus.speed_unknown();
    bus.run_with(10_000, 10, |decision| {
        assert!(
            decision.outputs.brake.total >= ms2(135),
            "the parking brake is not confirmed, the bus would roll away"
        );
    });
    bus.speed(FAST);
    assert_eq!(bus.step().outputs.brake.total, ms2(0), "a known speed decides anew");
}

/// SELF-5g, STR-2f: in the safe state automatic steering fades out, and the angle does not jump.
#[test]
fn in_the_safe_state_steering_fades_out() {
    let mut bus = Bus::steering(kmh(10));
    for _ in 0..3 {
        bus.step_by(0);
    }
    let mut weight = bus.last.map_or(0, |decision| decision.outputs.steering.weight.raw());
    assert!(weight >= 97);
    for _ in 0..110 {
        let out = bus.step().outputs.steering;
        assert!(out.weight.raw() <= weight && weight - out.weight.raw() <= 1);
        assert_eq!(out.angle, angle(0));
        weight = out.weight.raw();
    }
    assert_eq!(weight, 0);
}

/// RULE-4a, SELF-2d: the inputs of nothing at all, in every situation: every channel has a legal command.
#[test]
fn with_nothing_known_every_channel_has_a_legal_command() {
    for (_, mut bus) in situations() {
        bus.inputs = Inputs::NEVER;
        bus.scene = Scene::default();
        // The oracle checks feasibility in every cycle.
        bus.run_for(30_000);
        Bus::assert_idempotent(&bus.step());
    }
}
