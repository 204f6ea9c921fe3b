//! Does the steering follow? RSP-1e, RSP-1f, RSP-1i, RSP-1j: both directions, around every bound.

mod common;
use common::*;

/// Automatic steering has been told this angle, and nothing has been compared yet; the wheel stays at 0.
fn told(target: i16) -> Bus {
    let mut bus = Bus::steering(kmh(20));
    bus.follows = false;
    ask(&mut bus, target);
    assert_eq!(bus.step().outputs.steering.angle, angle(target), "inside the envelope in one cycle");
    bus
}

fn ask(bus: &mut Bus, target: i16) {
    bus.commands.steering = Command::Fresh(Steering { angle: angle(target), ..STEER });
}

fn stands(bus: &mut Bus, measured: i16) {
    bus.inputs.steering_angle = known(angle(measured));
}

fn reported(bus: &mut Bus, fault: Faults) -> Option<u32> {
    bus.time_until(CYCLE, 3_000, |decision| decision.status.faults.contains(fault))
}

/// RSP-1i: 2° and 15 % off the target is no fault, 0.1° more is.
#[test]
fn band() {
    for sign in [1, -1] {
        assert_eq!(reported(&mut told(sign * 23), Faults::STEERING_RESPONSE), None, "2.3°: the band is 2.3°");
        assert_eq!(reported(&mut told(sign * 24), Faults::STEERING_RESPONSE), Some(200), "2.4°");
    }
}

/// RSP-1e: no response within 100 ms and the age is a fault; 0.3° is none, 0.4° is one; RSP-1f: then 500 ms.
#[test]
fn first_response_and_target() {
    for sign in [1, -1] {
        for (measured, expected) in [(0, 200), (3, 200), (4, 600)] {
            let mut bus = told(sign * 30);
            bus.step();
            stands(&mut bus, sign * measured);
            bus.step();
            let time = reported(&mut bus, Faults::STEERING_RESPONSE).map(|time| time + 20);
            assert_eq!(time, Some(expected), "{sign} × {measured}");
        }
    }
}

/// RSP-1e: the last cycle in which a response is in time.
#[test]
fn response_in_time() {
    for (cycles, expected) in [(20, false), (21, true)] {
        let mut bus = told(30);
        let mut seen = false;
        bus.run_with(cycles * CYCLE, CYCLE, |decision| {
            seen |= decision.status.faults.contains(Faults::STEERING_RESPONSE);
        });
        assert_eq!(seen, expected, "{cycles} cycles");
    }
    let mut bus = told(30);
    bus.run_for(200);
    stands(&mut bus, 20);
    assert_eq!(reported(&mut bus, Faults::STEERING_RESPONSE), None, "within the band in time");
}

/// RSP-1e, RSP-1f: a target that swings either way, followed 150 ms later, is no fault.
#[test]
fn moving_target() {
    let mut bus = Bus::steering(kmh(20));
    bus.follows = false;
    let mut line = std::collections::VecDeque::from(vec![0_i16; 15]);
    for cycle in 0..1_000_i16 {
        let phase = cycle % 200;
        let target = if phase < 100 { phase - 50 } else { 150 - phase };
        ask(&mut bus, target * 4);
        let decision = bus.step();
        let found = decision.status.faults.and(Faults::STEERING_RESPONSE.with(Faults::STEERING_OVERSHOOT));
        assert_eq!(found, Faults::NONE, "cycle {cycle}");
        line.push_back(decision.outputs.steering.angle.raw());
        stands(&mut bus, line.pop_front().unwrap_or(0));
    }
}

/// RSP-1f, RULE-1b: an unknown angle freezes nothing for long: without it automatic steering fades out (STR-2).
#[test]
fn unknown_angle() {
    let mut bus = told(30);
    bus.run_for(150);
    bus.inputs.steering_angle = unknown(Cause::Stale);
    let mut seen = false;
    let decision =
        bus.run_with(2_000, CYCLE, |decision| seen |= decision.status.faults.contains(Faults::STEERING_RESPONSE));
    assert!(!seen, "unknown is evidence for nothing");
    assert!(!decision.outputs.steering.enable, "faded out");
}

/// RSP-1k: steering that does not follow fades out as after a takeover, and must be asked for anew.
#[test]
fn ends_steering() {
    let mut bus = told(30);
    let decision = bus.run_for(210);
    assert!(decision.status.faults.contains(Faults::STEERING_RESPONSE));
    assert_eq!(decision.envelope.steering.enable, Err(Reason::SteeringResponse));
    assert_eq!(decision.outputs.steering.weight, percent(99), "it fades from there");
    assert!(decision.outputs.warnings.notice_lamp, "and the driver is told");
    let decision = bus.run_for(3_000);
    assert!(!decision.outputs.steering.enable, "asking on is not asking anew");
    stands(&mut bus, 0);
    bus.commands.steering = Command::Fresh(Steering::NEUTRAL);
    bus.step();
    ask(&mut bus, 0);
    assert!(bus.run_for(100).outputs.steering.enable, "asked for anew");
}

/// RSP-1k, STR-2h: in leave there is nobody to hand over to: reported, and steering goes on.
#[test]
fn leave_continues() {
    let mut bus = Bus::steering(kmh(20));
    bus.vacant();
    bus.run_for(2_010);
    bus.follows = false;
    ask(&mut bus, 30);
    let decision = bus.run_for(1_000);
    assert_eq!(decision.status.occupancy, Occupancy::Leave);
    assert!(decision.status.faults.contains(Faults::STEERING_RESPONSE), "reported");
    assert_eq!(decision.outputs.steering.weight, Percent::FULL, "and goes on");
}

/// RSP-1j: beyond the target by more than the band for 500 ms is an overshoot.
#[test]
fn overshoot() {
    for sign in [1, -1] {
        let mut bus = told(sign * 30);
        bus.step();
        stands(&mut bus, sign * 60);
        let time = bus.time_until(CYCLE, 3_000, |decision| decision.status.faults.contains(Faults::STEERING_OVERSHOOT));
        assert_eq!(time, Some(500), "{sign}");
        let mut bus = told(sign * 30);
        bus.step();
        stands(&mut bus, sign * 54);
        assert_eq!(reported(&mut bus, Faults::STEERING_OVERSHOOT), None, "2° and 15 % beyond");
    }
}

/// MIT-4e, RSP-1k: an angle that faulty steering made is not the driver's: level 1 goes on.
#[test]
fn astray_is_no_takeover() {
    let mut bus = Bus::steering(kmh(30));
    bus.follows = false;
    bus.ahead(at(4_399));
    assert_eq!(bus.step().status.level, Level::One);
    stands(&mut bus, 810);
    let mut seen = false;
    bus.run_with(900, CYCLE, |decision| {
        seen |= decision.envelope.steering.enable == Err(Reason::SteeringResponse);
        assert_eq!(decision.status.level, Level::One);
    });
    assert!(seen, "it did not follow");
}

/// RSP-1k, STR-2d, RULE-1c: a frame that is lost or rejected asks for nothing: steering that did not follow stays barred.
#[test]
fn a_lost_frame_asks_for_nothing() {
    for command in [Command::Absent, Command::Rejected(Rejection::Checksum)] {
        let mut bus = told(30);
        bus.run_for(300);
        bus.commands.steering = command;
        bus.step();
        ask(&mut bus, 30);
        assert_eq!(bus.step().envelope.steering.enable, Err(Reason::SteeringResponse), "{command:?}");
    }
}
