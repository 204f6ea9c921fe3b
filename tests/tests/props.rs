//! Random drives: what holds in every cycle holds for any inputs, commands, times and objects (SELF-1, SELF-2, RULE-1, RULE-3).
//!
//! A drive is a list of events; an event changes a few inputs and commands and lets some cycles pass. proptest
//! shrinks the list. Bounded: some ten thousand cycles per property.

mod common;
use common::random::*;
use common::*;
use proptest::collection::vec;
use proptest::prelude::{ProptestConfig, any, proptest};

/// One event, and the cycles after it.
fn event(bus: &mut Bus, seed: u64) {
    let mut dice = Dice::Number(seed);
    if let (Some(decision), false) = (bus.last, dice.one_in(8)) {
        obey(&decision.outputs, &mut bus.inputs);
    }
    change_bus(&mut dice, &mut bus.inputs);
    for _ in 0..=dice.below(3) {
        change_input(&mut dice, &mut bus.inputs);
    }
    for _ in 0..dice.below(3) {
        change_command(&mut dice, &mut bus.commands);
    }
    if dice.one_in(4) {
        change_scene(&mut dice, &mut bus.scene);
    }
    let cycles = dice.of(&[1, 1, 2, 5, 30, 110]);
    for _ in 0..cycles {
        let decision = bus.step_by(cycle(&mut dice));
        Bus::assert_idempotent(&decision);
    }
}

proptest! {
    #![proptest_config(ProptestConfig { max_shrink_iters: 2_000, failure_persistence: None, ..ProptestConfig::default() })]

    /// SELF-1a, SELF-2a, SELF-2c, SELF-2d, RULE-3c, SEAT-5a, SEAT-7f, SEAT-7g, CMD-3c, CMD-5a, CMD-5b: random drives from every stage keep every claim
    /// of the oracle (common/always.rs), and vetting an output again changes nothing.
    #[test]
    fn random_drives_keep_every_claim(which in 0..STARTS, events in vec(any::<u64>(), 1..60)) {
        let mut bus = start(which);
        for seed in events {
            event(&mut bus, seed);
        }
    }

    /// SELF-1a, SELF-1b: nothing but noise, every bit of it: no panic, and every claim.
    #[test]
    fn noise_keeps_every_claim(which in 0..STARTS, seeds in vec(any::<u64>(), 1..200)) {
        let mut bus = start(which);
        for seed in seeds {
            let mut dice = Dice::Number(seed);
            for _ in 0..60 {
                change_input(&mut dice, &mut bus.inputs);
                change_command(&mut dice, &mut bus.commands);
            }
            change_scene(&mut dice, &mut bus.scene);
            let elapsed = if dice.flag() { dice.word() } else { dice.word() % 60 };
            let decision = bus.step_by(elapsed);
            Bus::assert_idempotent(&decision);
        }
    }

    /// RULE-1d: inputs that become unknown end no obligation that has begun, and weaken none, in the cycle in which they do.
    #[test]
    fn unknown_inputs_weaken_no_obligation(which in 0..STARTS, events in vec(any::<u64>(), 1..30), which_unknown in any::<u64>()) {
        let mut bus = start(which);
        for seed in events {
            event(&mut bus, seed);
        }
        let before = bus.step();
        let mut dice = Dice::Number(which_unknown);
        let cause = dice.of(Cause::ALL);
        let Inputs { seat, wheel_speed, motor_speed, steering_angle, epb, key, k1, k4, deceleration, .. } = &mut bus.inputs;
        let [first, second] = seat;
        let mut lose = |signal: &mut Signal<_>| if dice.flag() { *signal = unknown(cause) };
        lose(first);
        lose(second);
        if dice.flag() { *wheel_speed = unknown(cause); }
        if dice.flag() { *motor_speed = unknown(cause); }
        if dice.flag() { *steering_angle = unknown(cause); }
        if dice.flag() { *epb = unknown(cause); }
        if dice.flag() { *key = unknown(cause); }
        if dice.flag() { *k1 = unknown(cause); }
        if dice.flag() { *k4 = unknown(cause); }
        if dice.flag() { *deceleration = unknown(cause); }
        if dice.flag() { bus.scene = Scene::default(); }
        let lost = bus.inputs.seat != [known(Seat::Occupied); 2];
        let after = bus.step();
        let (was, is) = (before.status, after.status);
        // Leave goes on, unless this very cycle confirms the seat.
        if was.occupancy == Occupancy::Leave && lost {
            assert_eq!(is.occupancy, Occupancy::Leave);
        }
        if was.parked_by_leave && !matches!(after.outputs.epb.request, EpbRequest::Release) {
            assert!(is.parked_by_leave);
        }
        assert!(was.stage == Stage::Up || is.stage != Stage::Up || is.occupancy == Occupancy::Confirmed);
        assert!(!was.safe_state || is.safe_state);
    }

    /// RULE-3a, SELF-2a: more braking asked for is never less braking out; less torque asked for is never more out.
    #[test]
    fn the_safe_direction_is_never_hindered(which in 0..STARTS, events in vec(any::<u64>(), 1..30), total in any::<u16>(), more in any::<u16>(), torque in any::<u8>(), less in any::<u8>()) {
        let mut bus = start(which);
        for seed in events {
            event(&mut bus, seed);
        }
        let ask = |total: u16, torque: u8| {
            let mut bus = bus.clone();
            bus.ask_brake(DecelMs2Q11::new(total));
            bus.ask_torque(torque);
            bus.step().outputs
        };
        let weak = ask(total, torque);
        let strong = ask(total.saturating_add(more), torque);
        assert!(strong.brake.total >= weak.brake.total);
        let light = ask(total, torque.saturating_sub(less));
        assert!(light.drive.torque <= weak.drive.torque);
        let mut warned = bus.clone();
        let all = Warnings { forward_collision: true, pedestrian: true, seat_leave: true, hazard_flashers: true, fault_lamp: true, notice_lamp: true, ..Warnings::NEUTRAL };
        warned.commands.warnings = Command::Fresh(all);
        assert_passed(&warned.step(), Channel::Warnings);
    }

    /// RULE-3d, RULE-4a: what a channel without a natural order may always ask for passes, but for an obligation: gear hold,
    /// contactors hold, mode manual, parking brake none.
    #[test]
    fn the_safe_element_passes_but_for_an_obligation(which in 0..STARTS, events in vec(any::<u64>(), 1..30)) {
        let mut bus = start(which);
        for seed in events {
            event(&mut bus, seed);
        }
        bus.ask_gear(GearRequest::Hold);
        bus.ask_contactors(ContactorRequest::Hold, ContactorRequest::Hold);
        bus.ask_epb(EpbRequest::None);
        bus.commands.mode = Command::Fresh(DrivingMode::Manual);
        let decision = bus.step();
        let but_for = [
            (Channel::Gear, vec![Reason::NeutralObliged]),
            (Channel::Contactors, vec![Reason::Shutdown]),
            (Channel::ParkingBrake, vec![
                    Reason::EpbApply,
                    Reason::SafeState,
                    Reason::DriverSwitch,
                    Reason::BrakeResponse,
                    Reason::Bypass,
                ]),
            (Channel::Mode, vec![]),
        ];
        for (channel, obligations) in but_for {
            let verdict = decision.verdicts.of(channel);
            assert!(verdict.passed() || obligations.contains(&verdict.reason), "{channel:?} {verdict:?}");
        }
    }

    /// SELF-4g, SELF-2c, SELF-2d, SEAT-5a, SEAT-7f: with any valid configuration the claims that need no number hold.
    #[test]
    fn any_valid_configuration_keeps_the_claims(config_seed in any::<u64>(), which in 0..STARTS, events in vec(any::<u64>(), 1..40)) {
        let Some(config) = random_config(&mut Dice::Number(config_seed)) else { return Ok(()) };
        let model = start(which);
        let mut bus = Bus::with_config(&config, ResetCause::PowerOn, Some(Record::None), model.inputs);
        let mut occupied = 0_u32;
        for seed in events {
            let mut dice = Dice::Number(seed);
            change_input(&mut dice, &mut bus.inputs);
            change_input(&mut dice, &mut bus.inputs);
            change_command(&mut dice, &mut bus.commands);
            if dice.one_in(4) { change_scene(&mut dice, &mut bus.scene); }
            for _ in 0..dice.of(&[1, 5, 50, 300]) {
                let decision = bus.step_unjudged(CYCLE);
                let both = bus.inputs.seat == [known(Seat::Occupied); 2];
                occupied = if both { occupied + CYCLE } else { 0 };
                assert!(decision.envelope.is_feasible());
                Bus::assert_idempotent(&decision);
                if decision.outputs.epb.request == EpbRequest::Release {
                    assert!(occupied > config.seat_confirm.raw(), "SEAT-5a");
                }
                if decision.outputs.contactors.k1 == ContactorRequest::Open {
                    assert_eq!(bus.inputs.k4, known(Contact::Open), "SEAT-7f");
                }
                if decision.status.occupancy == Occupancy::Leave || decision.status.level != Level::None {
                    assert_eq!(decision.outputs.drive.torque, Percent::ZERO, "SEAT-2a, MIT-5a");
                }
                assert!(decision.outputs.brake.total >= decision.envelope.brake.floor.most, "SELF-2a");
            }
        }
    }

    /// SELF-3b, END-1b: the same drive at another time of the clock gives the same decisions.
    #[test]
    fn the_time_of_the_clock_changes_nothing(which in 0..2_usize, offset in any::<u32>(), events in vec(any::<u64>(), 1..40)) {
        let mut first = start(which);
        let mut second = first.clone();
        first = first.reset_with(ResetCause::PowerOn, Some(Record::None));
        second = second.reset_with(ResetCause::PowerOn, Some(Record::None));
        second.now = offset;
        for seed in events {
            event(&mut first, seed);
            event(&mut second, seed);
            assert_eq!(first.last, second.last);
        }
    }
}

/// SELF-1a: the random drives are not vacuous: they reach every kind of decision that the claims speak of.
#[test]
fn random_drives_reach_every_kind_of_decision() {
    const KINDS: [(&str, Ask); 22] = [
        ("release", |decision| decision.outputs.epb.request == EpbRequest::Release),
        ("release refused", |decision| decision.verdicts.of(Channel::ParkingBrake).reason == Reason::SeatNotOccupied),
        ("apply", |decision| decision.verdicts.of(Channel::ParkingBrake).reason == Reason::EpbApply),
        ("leave", |decision| decision.status.occupancy == Occupancy::Leave),
        ("parked by leave", |decision| decision.status.parked_by_leave),
        ("not parked by leave", |decision| !decision.status.parked_by_leave),
        ("neutral obliged", |decision| decision.verdicts.of(Channel::Gear).reason == Reason::NeutralObliged),
        ("K4 opens", |decision| decision.outputs.contactors.k4 == ContactorRequest::Open),
        ("K1 opens", |decision| decision.outputs.contactors.k1 == ContactorRequest::Open),
        ("K1 closes", |decision| decision.outputs.contactors.k1 == ContactorRequest::Close),
        ("level 1", |decision| decision.status.level == Level::One),
        ("level 2", |decision| decision.status.level == Level::Two),
        ("level 3", |decision| decision.status.level == Level::Three),
        ("driver torque", |decision| {
            decision.outputs.drive.origin == Origin::Driver && decision.outputs.drive.torque > Percent::ZERO
        }),
        ("automated torque", |decision| {
            decision.outputs.drive.origin == Origin::Adas && decision.outputs.drive.torque > Percent::ZERO
        }),
        ("suspended", |decision| decision.status.mode == Mode::Suspended),
        ("steering", |decision| decision.outputs.steering.enable),
        ("safe state", |decision| decision.status.safe_state),
        ("brake capped", |decision| decision.verdicts.of(Channel::ServiceBrake).reason == Reason::PhantomBraking),
        ("retarder", |decision| decision.outputs.retarder.torque > Percent::ZERO),
        ("hill-hold", |decision| {
            decision.outputs.drive.torque > Percent::ZERO && decision.outputs.brake.total > DecelMs2Q11::ZERO
        }),
        ("auxiliaries off", |decision| decision.outputs.auxiliaries != Auxiliaries::NEUTRAL),
    ];
    let mut reached = [false; KINDS.len()];
    for seed in 0..2_000_u64 {
        let mut bus = start(usize::try_from(seed % 13).unwrap_or(0));
        for index in 0..20 {
            event(&mut bus, seed * 1_000 + index);
            for (reached, (_, is)) in reached.iter_mut().zip(KINDS) {
                *reached |= bus.last.is_some_and(|decision| is(&decision));
            }
        }
        if reached.iter().all(|reached| *reached) {
            return;
        }
    }
    let missing: Vec<_> =
        KINDS.iter().zip(reached).filter(|(_, reached)| !reached).map(|((name, _), _)| name).collect();
    assert!(missing.is_empty(), "{missing:?}");
}

/// The default with some values moved inside their ranges; `None` where a relation breaks.
fn random_config(dice: &mut Dice<'_>) -> Option<Config> {
    let mut words = Vec::new();
    Config::DEFAULT.write(&mut |word| words.push(word));
    for _ in 0..=dice.below(12) {
        let mut index = dice.below(words.len());
        words[index] = LIMITS.iter().find_map(|limit| {
            if index < limit.count {
                let width = u64::try_from(limit.greatest - limit.least).ok()? + 1;
                let value = limit.least + i64::try_from(dice.next() % width).ok()?;
                return u32::try_from(value).ok();
            }
            index -= limit.count;
            None
        })?;
    }
    let mut source = words.into_iter();
    Config::read(&mut || source.next()).filter(Config::is_valid)
}
