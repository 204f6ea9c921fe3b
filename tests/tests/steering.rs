//! Automatic steering (STR-1, STR-2, E2E-2i).

mod common;
use common::*;

const SLOW: SpeedKmhQ8 = kmh(10);

/// Asks for `target` and lets the wheel follow what goes out, until it stands.
fn steer_to(bus: &mut Bus, target: i16) -> AngleDeciDeg {
    bus.commands.steering = Command::Fresh(Steering { angle: angle(target), ..STEER });
    let mut last = bus.step().outputs.steering.angle;
    for _ in 0..20_000 {
        bus.inputs.steering_angle = known(last);
        let next = bus.step().outputs.steering.angle;
        if next == last {
            return last;
        }
        last = next;
    }
    unreachable!("the angle comes to rest")
}

/// E2E-2i, STR-2d: lost steering commands fade out; the angle does not move.
#[test]
fn lost_steering_commands_fade_out() {
    for command in [Command::Absent, Command::Rejected(Rejection::Checksum), Command::Held(Millis::new(126), STEER)] {
        let mut bus = Bus::steering(SLOW);
        bus.commands.steering = command;
        fades_out(&mut bus);
    }
}

/// Weight falls by 1 % per cycle (100 %/s), the angle stays, then steering is disabled.
fn fades_out(bus: &mut Bus) {
    let mut before = 100;
    for _ in 0..100 {
        let Steering { enable, angle: target, weight, overlay, .. } = bus.step().outputs.steering;
        assert!(weight.raw() < before && before - weight.raw() <= 1, "{before} {weight:?}");
        assert_eq!((target, overlay), (angle(0), TorqueNmQ10::ZERO));
        assert_eq!(enable, weight > Percent::ZERO);
        before = weight.raw();
    }
    assert_eq!(before, 0);
}

/// STR-1a, STR-1b: the angle stays within the bound of the speed, and within ±720°.
#[test]
fn the_angle_stays_within_the_bound_of_the_speed() {
    let Row(bounds) = Config::DEFAULT.steering_angle;
    // Each row of the table at its edges; automatic steering ends at 60 km/h.
    for (speed, row) in [
        (kmh(0), 0),
        (kmh(10), 0),
        (kmh_q8(2_561), 1),
        (kmh(20), 1),
        (kmh_q8(5_121), 2),
        (kmh(30), 2),
        (kmh_q8(7_681), 3),
        (kmh(40), 3),
        (kmh_q8(10_241), 4),
        (kmh(60), 4),
    ] {
        let bound = bounds[row].raw();
        for sign in [1, -1] {
            let mut bus = Bus::steering(SLOW);
            bus.speed(speed);
            assert_eq!(steer_to(&mut bus, i16::MAX * sign), angle(bound * sign), "{speed:?}");
            assert_verdict(&bus.step(), Channel::Steering, Kind::Limit, Reason::SteeringAngle);
            assert_eq!(steer_to(&mut bus, bound * sign), angle(bound * sign));
            assert_passed(&bus.step(), Channel::Steering);
        }
    }
    assert!(bounds.iter().all(|bound| *bound <= angle(7_200)), "STR-1a");
}

/// STR-1b, RULE-6b: the higher of the two speeds chooses the bound.
#[test]
fn the_higher_speed_chooses_the_steering_bound() {
    let mut bus = Bus::steering(SLOW);
    bus.speeds(kmh(10), kmh_q8(2_561));
    assert_eq!(steer_to(&mut bus, 7_200), Config::DEFAULT.steering_angle.0[1]);
}

/// STR-1c, CMD-3f: the angle moves by no more than the rate of the speed allows, counted from our last output.
#[test]
fn the_angle_moves_no_faster_than_the_rate() {
    let Row(rates) = Config::DEFAULT.steering_rate;
    for (speed, row) in [(kmh(5), 0), (kmh(15), 1), (kmh(25), 2), (kmh(35), 3), (kmh(60), 4)] {
        for cycle in [1, 10, 50] {
            let mut bus = Bus::steering(SLOW);
            bus.speed(speed);
            bus.commands.steering = Command::Fresh(Steering { angle: angle(400), ..STEER });
            let span = 500;
            let mut moved = 0;
            let mut before = 0;
            for step in 1..=span / cycle {
                let now = i64::from(bus.step_by(cycle).outputs.steering.angle.raw());
                moved += now - before;
                before = now;
                let allowed = i64::from(rates[row].raw()) * i64::from(step * cycle) / 1_000;
                assert!(moved <= allowed, "{speed:?} {cycle}: {moved} of {allowed}");
            }
            let allowed = i64::from(rates[row].raw()) * i64::from(span) / 1_000;
            assert!(moved >= allowed.min(400) - 5, "{speed:?} {cycle}: {moved} of {allowed}: it must get there");
        }
        let mut bus = Bus::steering(SLOW);
        bus.speed(speed);
        for (rate, passes) in [(rates[row].raw(), true), (rates[row].raw() + 1, false), (u16::MAX, false)] {
            bus.commands.steering = Command::Fresh(Steering { rate: RateDeciDegS::new(rate), ..STEER });
            let decision = bus.step();
            assert_eq!(decision.verdicts.of(Channel::Steering).passed(), passes);
            if !passes {
                assert_verdict(&decision, Channel::Steering, Kind::Limit, Reason::SteeringRate);
                assert_eq!(decision.outputs.steering.rate, rates[row]);
            }
        }
    }
}

/// STR-1d: the target goes no further from the measured angle than 45°.
#[test]
fn the_target_stays_near_the_measured_angle() {
    for (measured, target, expected) in
        [(0, 7_200, 450), (0, 450, 450), (0, -7_200, -450), (100, 7_200, 550), (-100, -7_200, -550)]
    {
        let mut bus = Bus::steering(SLOW);
        // The wheel is held: the target waits for it, and that is no fault yet.
        bus.follows = false;
        bus.inputs.steering_angle = known(angle(measured));
        bus.commands.steering = Command::Fresh(Steering { angle: angle(target), ..STEER });
        assert_eq!(bus.run_for(180).outputs.steering.angle, angle(expected), "{measured} {target}");
    }
}

/// STR-1e: overlay torque up to 5 Nm, both ways, below the takeover torque.
#[test]
fn the_overlay_torque_has_our_own_bound() {
    for (overlay, granted) in
        [(5_120, 5_120), (5_121, 5_120), (i16::MAX, 5_120), (-5_120, -5_120), (-5_121, -5_120), (i16::MIN, -5_120)]
    {
        let mut bus = Bus::steering(SLOW);
        bus.commands.steering = Command::Fresh(Steering { overlay: hand_torque(overlay), ..STEER });
        let decision = bus.run_for(2_000);
        assert_eq!(decision.outputs.steering.overlay, hand_torque(granted), "{overlay}");
        if overlay != granted {
            assert_verdict(&decision, Channel::Steering, Kind::Limit, Reason::SteeringOverlay);
        }
    }
    assert!(Config::DEFAULT.steering_overlay < Config::DEFAULT.takeover_torque);
}

/// STR-1f: the bar-torque limit may narrow the authority, never widen it.
#[test]
fn the_bar_torque_limit_does_not_widen_the_authority() {
    let mut bus = Bus::steering(SLOW);
    for (bar, granted) in [(0, 0), (100, 100), (101, 100), (255, 100)] {
        bus.commands.steering = Command::Fresh(Steering { bar_limit: BarTorque50mNm::new(bar), ..STEER });
        let decision = bus.step();
        assert_eq!(decision.outputs.steering.bar_limit, BarTorque50mNm::new(granted));
        if bar != granted {
            assert_verdict(&decision, Channel::Steering, Kind::Limit, Reason::BarTorque);
        }
    }
}

/// STR-1g: with unknown speed the bounds are those of the highest speed.
#[test]
fn with_unknown_speed_the_steering_bounds_are_the_narrowest() {
    let mut bus = Bus::steering(SLOW);
    bus.speed_unknown();
    let bound = bus.step().envelope.steering;
    assert_eq!(bound.rate, Config::DEFAULT.steering_rate.0[6]);
    assert!(bound.angle_most <= Config::DEFAULT.steering_angle.0[6]);
}

/// STR-2a: more than 6 Nm of the driver for exactly 300 ms end automatic steering; a break starts them again.
#[test]
fn the_driver_takes_over_after_300_ms() {
    let ended = |decision: &Decision| decision.verdicts.of(Channel::Steering).reason == Reason::Takeover;
    for sign in [1, -1] {
        let mut bus = Bus::steering(SLOW);
        bus.inputs.driver_torque = known(hand_torque(6_144 * sign));
        assert_eq!(bus.time_until(10, 5_000, ended), None, "6 Nm exactly do not take over");
        bus.inputs.driver_torque = known(hand_torque(6_145 * sign));
        assert_eq!(bus.time_until(1, 5_000, ended), Some(300));
        let mut bus = Bus::steering(SLOW);
        for _ in 0..10 {
            bus.inputs.driver_torque = known(hand_torque(6_145 * sign));
            assert!(!ended(&bus.run_for(290)));
            bus.inputs.driver_torque = known(hand_torque(6_144 * sign));
            assert!(!ended(&bus.step()));
        }
    }
    let mut bus = Bus::steering(SLOW);
    bus.inputs.driver_torque = known(hand_torque(i16::MIN));
    assert_eq!(bus.time_until(10, 5_000, ended), Some(300));
}

/// STR-2a, MODE-1e: after a takeover steering fades out, the mode ends, and nothing comes back unasked.
#[test]
fn after_a_takeover_nothing_comes_back_unasked() {
    let mut bus = Bus::steering(SLOW);
    bus.inputs.driver_torque = known(hand_torque(7_000));
    bus.run_for(300);
    assert_eq!(bus.step().status.exit, ExitReason::Takeover);
    bus.inputs.driver_torque = known(hand_torque(0));
    let outputs = bus.run_for(5_000).outputs;
    assert!(!outputs.steering.enable && outputs.steering.weight == Percent::ZERO);
    assert_eq!(outputs.mode, DrivingMode::Manual);
}

/// STR-2b, S4 6.3.2, 6.3.9: every end of automatic steering that the machine did not ask for is shown to the driver.
#[test]
fn every_end_of_automatic_steering_is_shown() {
    let ends: [Change; 9] = [
        ("takeover", |bus| bus.inputs.driver_torque = known(hand_torque(7_000))),
        ("derated", |bus| bus.inputs.eps = known(EpsState::Derated)),
        ("failed", |bus| bus.inputs.eps = known(EpsState::Failed)),
        ("power steering unknown", |bus| bus.inputs.eps = unknown(Cause::Stale)),
        ("too fast", |bus| bus.speed(kmh_q8(15_361))),
        ("speed unknown", Bus::speed_unknown),
        ("angle unknown", |bus| bus.inputs.steering_angle = unknown(Cause::Stale)),
        ("driver torque unknown", |bus| bus.inputs.driver_torque = unknown(Cause::Stale)),
        ("command lost", |bus| bus.commands.steering = Command::Absent),
    ];
    for (name, end) in ends {
        let mut bus = Bus::steering(SLOW);
        let Warnings { fault_lamp, notice_lamp, .. } = bus.step().outputs.warnings;
        assert!(!fault_lamp && !notice_lamp);
        end(&mut bus);
        let decision = bus.run_for(500);
        let Warnings { fault_lamp, notice_lamp, .. } = decision.outputs.warnings;
        assert!(decision.outputs.steering.weight < Percent::FULL, "{name}: it ends");
        assert!(fault_lamp || notice_lamp, "{name}: and the driver is told");
    }
}

/// STR-2b: what has not acted has not ended: a silent steering channel lights no lamp in manual mode.
#[test]
fn a_silent_steering_channel_lights_no_lamp() {
    for mut bus in [Bus::driving(SLOW), Bus::parked()] {
        bus.commands.steering = Command::Absent;
        bus.run_with(2_000, 10, |decision| {
            let Warnings { fault_lamp, notice_lamp, .. } = decision.outputs.warnings;
            assert!(!fault_lamp && !notice_lamp);
        });
    }
}

/// STR-2c, STR-2d: weight fades in and out by 1 % per 10 ms, in any legal cycle.
#[test]
fn the_weight_fades_in_and_out() {
    for cycle in [1, 10, 50] {
        let mut bus = Bus::automated(SLOW);
        bus.commands.steering = Command::Fresh(STEER);
        let mut time = 0;
        while time < 2_000 {
            let weight = u32::from(bus.step_by(cycle).outputs.steering.weight.raw());
            time += cycle;
            assert!(weight * 10 <= time + 9, "{cycle}: {weight} % after {time} ms");
        }
        assert_eq!(bus.step().outputs.steering.weight, Percent::FULL);
        bus.commands.steering = Command::Fresh(Steering { enable: false, ..STEER });
        let mut time = 0;
        while time < 2_000 {
            let weight = u32::from(bus.step_by(cycle).outputs.steering.weight.raw());
            time += cycle;
            assert!((100 - weight) * 10 <= time + 9, "{cycle}: {weight} % after {time} ms");
        }
        assert_eq!(bus.step().outputs.steering.weight, Percent::ZERO);
    }
}

/// STR-2c, STR-2d: the overlay torque fades in, and does not jump when steering ends.
#[test]
fn the_overlay_torque_fades_in_and_out() {
    let mut bus = Bus::automated(SLOW);
    bus.commands.steering = Command::Fresh(Steering { overlay: hand_torque(5_120), ..STEER });
    let mut before = 0;
    for _ in 0..200 {
        let overlay = bus.step().outputs.steering.overlay.raw();
        assert!(overlay >= before && overlay - before <= 52, "1 % of 5 Nm: {before} {overlay}");
        before = overlay;
    }
    assert_eq!(before, 5_120);
    bus.inputs.eps = known(EpsState::Failed);
    for _ in 0..200 {
        let overlay = bus.step().outputs.steering.overlay.raw();
        assert!(overlay <= before && before - overlay <= 52, "{before} {overlay}");
        before = overlay;
    }
    assert_eq!(before, 0);
}

/// STR-2c, STR-2f: the overlay torque does not jump from one side to the other either.
#[test]
fn the_overlay_torque_does_not_jump_through_zero() {
    let mut bus = Bus::steering(SLOW);
    for target in [5_120, -5_120, 0] {
        bus.commands.steering = Command::Fresh(Steering { overlay: hand_torque(target), ..STEER });
        let mut before = bus.last.map_or(0, |decision| decision.outputs.steering.overlay.raw());
        for _ in 0..300 {
            let overlay = bus.step().outputs.steering.overlay.raw();
            assert!(overlay.abs_diff(before) <= 52, "{before} {overlay}");
            before = overlay;
        }
        assert_eq!(before, target);
    }
}

/// STR-2e: automatic steering up to 60 km/h, by the higher speed; beyond it ends, and cannot begin.
#[test]
fn automatic_steering_has_a_speed_range() {
    for (low, high, continues) in
        [(kmh(60), kmh(60), true), (kmh(60), kmh_q8(15_361), false), (kmh(61), kmh(61), false)]
    {
        let mut bus = Bus::steering(SLOW);
        bus.speeds(low, high);
        assert_eq!(bus.step().outputs.steering.weight == Percent::FULL, continues, "{low:?} {high:?}");
        let mut bus = Bus::automated(SLOW);
        bus.speeds(low, high);
        bus.commands.steering = Command::Fresh(STEER);
        let decision = bus.run_for(100);
        assert_eq!(decision.outputs.steering.weight > Percent::ZERO, continues);
        if !continues {
            assert_verdict(&decision, Channel::Steering, Kind::Block, Reason::SteeringSpeed);
        }
    }
}

/// STR-2f: whatever fails while it steers, the angle does not jump.
#[test]
fn on_a_fault_the_angle_does_not_jump() {
    let faults: [Change; 10] = [
        ("power steering", |bus| bus.inputs.eps = known(EpsState::Failed)),
        ("power steering unknown", |bus| bus.inputs.eps = unknown(Cause::Stale)),
        ("angle unknown", |bus| bus.inputs.steering_angle = unknown(Cause::Stale)),
        ("angle elsewhere", |bus| bus.inputs.steering_angle = known(angle(-7_200))),
        ("speed unknown", Bus::speed_unknown),
        ("high speed", |bus| bus.speed(kmh(100))),
        ("command lost", |bus| bus.commands.steering = Command::Absent),
        ("wild command", |bus| {
            bus.commands.steering = Command::Fresh(Steering { angle: angle(i16::MIN), ..STEER });
        }),
        ("not enabled", |bus| {
            bus.commands.steering = Command::Fresh(Steering { enable: false, angle: angle(i16::MAX), ..STEER });
        }),
        ("nothing known", |bus| bus.inputs = Inputs::NEVER),
    ];
    for (name, fault) in faults {
        let mut bus = Bus::steering(SLOW);
        assert_eq!(steer_to(&mut bus, 1_000), angle(1_000));
        fault(&mut bus);
        let mut before = 1_000;
        for _ in 0..300 {
            let out = bus.step().outputs.steering;
            if out.weight == Percent::ZERO {
                break; // nothing acts any more
            }
            assert!(out.angle.raw().abs_diff(before) <= 40, "{name}: {before} {:?}", out.angle);
            before = out.angle.raw();
        }
    }
}

/// STR-2g: no automatic steering with a derated, failed or unknown power steering: neither going on nor beginning.
#[test]
fn automatic_steering_needs_a_healthy_power_steering() {
    let mut states = vec![(known(EpsState::Ready), true), (known(EpsState::Active), true)];
    states.extend([(known(EpsState::Derated), false), (known(EpsState::Failed), false)]);
    states.extend(CAUSES.iter().map(|cause| (unknown(*cause), false)));
    for (state, permitted) in states {
        let mut bus = Bus::steering(SLOW);
        bus.inputs.eps = state;
        assert_eq!(bus.step().outputs.steering.weight == Percent::FULL, permitted, "{state:?}");
        let mut bus = Bus::automated(SLOW);
        bus.inputs.eps = state;
        bus.commands.steering = Command::Fresh(STEER);
        assert_eq!(bus.run_for(100).outputs.steering.weight > Percent::ZERO, permitted, "{state:?}");
    }
}

/// RULE-1c: automatic steering needs a known angle and a known driver torque.
#[test]
fn automatic_steering_needs_its_sensors() {
    let losses: [fn(&mut Bus); 4] = [
        |bus| bus.inputs.steering_angle = unknown(Cause::EndToEnd),
        |bus| bus.inputs.steering_angle = known(angle(7_201)),
        |bus| bus.inputs.steering_angle = known(angle(i16::MIN)),
        |bus| bus.inputs.driver_torque = unknown(Cause::Stale),
    ];
    for lose in losses {
        let mut bus = Bus::automated(SLOW);
        lose(&mut bus);
        bus.commands.steering = Command::Fresh(STEER);
        let outputs = bus.run_for(100).outputs;
        assert!(!outputs.steering.enable && outputs.steering.weight == Percent::ZERO);
    }
}

/// STR-2h: in leave automatic steering continues, inside its envelope.
#[test]
fn in_leave_automatic_steering_continues() {
    let mut bus = Bus::steering(SLOW);
    bus.vacant();
    let decision = bus.run_for(2_010);
    assert_eq!(decision.status.occupancy, Occupancy::Leave);
    bus.run_with(5_000, 10, |decision| {
        assert!(decision.outputs.steering.enable);
        assert_eq!(decision.outputs.steering.weight, Percent::FULL);
        assert_passed(decision, Channel::Steering);
    });
    bus.commands.steering = Command::Fresh(Steering { bar_limit: BarTorque50mNm::new(255), ..STEER });
    assert_refused(&bus.step(), Channel::Steering);
}

/// MODE-1a: without the automated mode automatic steering does not begin.
#[test]
fn without_the_mode_automatic_steering_does_not_begin() {
    for mut bus in [Bus::driving(SLOW), Bus::leave(SLOW)] {
        bus.commands.steering = Command::Fresh(STEER);
        let decision = bus.run_for(500);
        assert!(!decision.outputs.steering.enable);
        assert_refused(&decision, Channel::Steering);
    }
}
