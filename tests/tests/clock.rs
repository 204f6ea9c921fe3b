//! The supervisor itself: the clock and its faults (SELF-3c to SELF-3h).

mod common;
use common::*;

const FAST: SpeedKmhQ8 = kmh(50);

fn is_clock_fault(decision: &Decision) -> bool {
    decision.status.faults.contains(Faults::CLOCK)
}

/// SELF-3c: 1 to 50 ms are a cycle; 0, 51 and everything beyond, also backwards, are a reported fault.
#[test]
fn a_cycle_lasts_1_to_50_ms() {
    for (elapsed, fault) in [
        (1, false),
        (2, false),
        (10, false),
        (49, false),
        (50, false),
        (0, true),
        (51, true),
        (1_000, true),
        (u32::MAX / 2, true),
        (0_u32.wrapping_sub(1), true),
        (0_u32.wrapping_sub(10), true),
    ] {
        let mut bus = Bus::driving(FAST);
        let decision = bus.step_by(elapsed);
        assert_eq!(is_clock_fault(&decision), fault, "{elapsed}");
        assert_eq!(decision.outputs.warnings.fault_lamp, fault, "{elapsed}");
        assert!(!is_clock_fault(&bus.step()), "the next good cycle is none");
    }
}

/// SELF-3c: the first cycle after a boot has nothing to be compared with, at any time of the clock.
#[test]
fn the_first_cycle_is_no_fault_at_any_time() {
    for now in [0, 1, 50, 1_000_000, u32::MAX - 5, u32::MAX] {
        let mut bus = Bus::boot(ResetCause::PowerOn, Some(Record::None), healthy());
        bus.now = now;
        assert!(!is_clock_fault(&bus.step()), "{now}");
    }
}

/// SELF-3d: in a cycle with a clock fault permissions gain no time: a jump does not confirm the seat.
#[test]
fn a_clock_fault_gives_permissions_no_time() {
    for jump in [0, 51, 5_000, u32::MAX] {
        let mut bus = Bus::driving(FAST);
        bus.vacant();
        bus.step();
        bus.occupied();
        bus.run_for(1_000); // 990 ms since the first sample
        assert_eq!(bus.step_by(jump).status.occupancy, Occupancy::NotConfirmed, "{jump}");
        assert_eq!(bus.step_by(9).status.occupancy, Occupancy::NotConfirmed, "{jump}");
        assert_eq!(bus.step_by(1).status.occupancy, Occupancy::Confirmed, "{jump}: the last millisecond was missing");
    }
}

/// SELF-3d: the 10 min gain no time.
#[test]
fn a_clock_fault_gives_the_ten_minutes_no_time() {
    for jump in [0, 51, 600_000, u32::MAX] {
        let mut bus = Bus::parked_by_leave();
        let before = bus.run_coarse(60_000).status.parked_for;
        assert_eq!(bus.step_by(jump).status.parked_for, before, "{jump}");
        assert_eq!(bus.step_by(10).status.parked_for, Millis::new(before.raw() + 10), "{jump}");
    }
}

/// SELF-3d, MIT-4d, MIT-4h: nor does an obligation end sooner.
#[test]
fn a_clock_fault_ends_no_obligation_sooner() {
    let mut bus = Bus::driving(FAST);
    bus.ahead(object(4_399, 1_000));
    bus.step();
    bus.road_clear();
    bus.step();
    assert_eq!(bus.step_by(600).status.level, Level::One);
    assert_eq!(bus.time_until(10, 2_000, |decision| decision.status.level == Level::None), Some(490));
    let mut bus = Bus::driving(FAST);
    bus.ahead(object(2_700, 1_000));
    bus.step();
    bus.speed(kmh(0));
    bus.step();
    assert_eq!(bus.step_by(1_500).status.level, Level::Three);
    assert_eq!(bus.time_until(10, 2_000, |decision| decision.status.level == Level::None), Some(990));
}

/// SELF-3d, TRQ-5b, STR-1c: nothing rises or moves in a cycle with a clock fault.
#[test]
fn in_a_clock_fault_nothing_rises() {
    let mut bus = Bus::driving(FAST);
    bus.accelerator(travel(50));
    bus.ask_torque(50);
    bus.run_for(100);
    let before = bus.step().outputs.drive.torque;
    for jump in [0, 51] {
        assert!(bus.step_by(jump).outputs.drive.torque <= before, "{jump}");
    }
    let mut bus = Bus::steering(kmh(10));
    bus.commands.steering = Command::Fresh(Steering { angle: angle(400), ..STEER });
    let before = bus.step().outputs.steering.angle;
    assert_eq!(bus.step_by(200).outputs.steering.angle, before);
}

/// SELF-3e: safety timers get the nominal 10 ms: a clock that stands every other cycle does not delay a leave.
#[test]
fn a_clock_fault_gives_safety_timers_10_ms() {
    for jump in [0, 51, 100_000] {
        let mut bus = Bus::driving(FAST);
        bus.vacant();
        bus.step();
        let mut cycles = 0;
        loop {
            // Never three faults in a row.
            let fault = cycles % 2 == 0;
            let decision = bus.step_by(if fault { jump } else { 10 });
            cycles += 1;
            if decision.status.occupancy == Occupancy::Leave {
                break;
            }
            assert!(cycles <= 200, "{jump}: 200 cycles of 10 ms");
        }
        assert_eq!(cycles, 200, "{jump}");
    }
}

/// Cycles until `reached`, every other one a clock fault (never three in a row); the first one is good.
fn faulty_cycles_until(bus: &mut Bus, reached: Ask) -> Option<u32> {
    (0..8_000).find(|count| reached(&bus.step_by(if count % 2 == 1 { 0 } else { 10 })))
}

/// SELF-3e: everything that leads to an obligation, ends a permission or makes a report gets its 10 ms in every cycle.
#[test]
fn every_safety_timer_runs_through_clock_faults() {
    let timers: [(&str, Make, Ask, u32); 8] = [
        (
            "SEAT-1a",
            || {
                let mut bus = Bus::driving(FAST);
                bus.vacant();
                bus
            },
            in_leave,
            2_000,
        ),
        (
            "SEAT-3f",
            || {
                let mut bus = Bus::leave(FAST);
                bus.speed_unknown();
                bus
            },
            applies,
            20_000,
        ),
        (
            "SEAT-4c",
            || {
                let mut bus = Bus::leave(FAST);
                bus.speed(kmh(1));
                bus
            },
            |decision| decision.status.faults.contains(Faults::EPB_UNCONFIRMED),
            2_000,
        ),
        (
            "SEAT-7h K4",
            || {
                let mut bus = Bus::opening_k4();
                bus.inputs.k4 = OPEN;
                bus.loads_run();
                bus.step();
                bus
            },
            |decision| decision.status.faults.contains(Faults::K1_OVERDUE),
            9_990,
        ),
        (
            "E2E-2c",
            || {
                let mut bus = Bus::driving(FAST);
                bus.ask_brake(ms2(300));
                bus.step();
                bus.commands.brake = Command::Absent;
                bus
            },
            |decision| decision.outputs.brake.total < ms2(300),
            500,
        ),
        (
            "STR-2a",
            || {
                let mut bus = Bus::steering(kmh(10));
                bus.inputs.driver_torque = known(hand_torque(7_000));
                bus
            },
            |decision| decision.status.faults.contains(Faults::TAKEOVER),
            300,
        ),
        (
            "TRQ-6b",
            || {
                let mut bus = Bus::driving(kmh(1));
                bus.accelerator(travel(50));
                bus.ask_brake(ms2(100));
                bus.ask_torque(2);
                bus.step();
                bus
            },
            |decision| decision.outputs.drive.torque == Percent::ZERO,
            980,
        ),
        (
            "SEAT-3f again",
            || {
                let mut bus = Bus::leave(FAST);
                bus.inputs.wheel_speed = STALE;
                bus
            },
            applies,
            20_000,
        ),
    ];
    for (name, bus, reached, span) in timers {
        let cycles = faulty_cycles_until(&mut bus(), reached);
        // One cycle either way belongs to the count of the first sample.
        assert!(cycles.is_some_and(|cycles| (cycles * 10).abs_diff(span) <= 20), "{name}: {cycles:?} cycles");
    }
}

/// SELF-3d: everything that leads to a permission or ends an obligation gets nothing in a cycle with a clock fault.
#[test]
fn every_permission_timer_stands_in_clock_faults() {
    let ended: Ask = |decision| decision.status.level == Level::None;
    let timers: [(&str, Make, Ask, u32); 6] = [
        (
            "SEAT-0a",
            || {
                let mut bus = Bus::driving(FAST);
                bus.vacant();
                bus.step();
                bus.occupied();
                bus
            },
            |decision| decision.status.occupancy == Occupancy::Confirmed,
            1_000,
        ),
        (
            "SEAT-9a",
            || {
                let mut bus = Bus::leave(FAST);
                bus.occupied();
                bus
            },
            |decision| !in_leave(decision),
            1_000,
        ),
        (
            "MIT-4d",
            || {
                let mut bus = Bus::mitigating(Level::One);
                bus.road_clear();
                bus
            },
            ended,
            500,
        ),
        (
            "MIT-4h",
            || {
                let mut bus = Bus::mitigating(Level::Three);
                bus.speed(kmh(0));
                bus
            },
            ended,
            1_000,
        ),
        (
            "MIT-7b",
            || {
                let mut bus = Bus::mitigating(Level::Three);
                bus.speed_unknown();
                bus
            },
            |decision| decision.outputs.brake.total < ms2(500),
            10_000,
        ),
        (
            "BODY-1c",
            || {
                let mut bus = Bus::driving(FAST);
                bus.ask_brake(ms2(100));
                bus.step();
                bus.ask_brake(ms2(0));
                bus
            },
            |decision| !decision.outputs.body.brake_lamps,
            300,
        ),
    ];
    for (name, bus, reached, span) in timers {
        let mut bus = bus();
        if name == "MIT-7b" {
            bus.road_clear();
        }
        let cycles = faulty_cycles_until(&mut bus, reached);
        assert!(cycles.is_some_and(|cycles| (cycles * 5).abs_diff(span) <= 20), "{name}: {cycles:?} cycles");
    }
}

/// SELF-3f: obligations stay in a cycle with a clock fault.
#[test]
fn in_a_clock_fault_obligations_stay() {
    for jump in [0, 51, u32::MAX] {
        let mut bus = Bus::leave(FAST);
        let decision = bus.step_by(jump);
        assert_eq!((decision.status.occupancy, decision.outputs.brake.total), (Occupancy::Leave, ms2(195)));
        let mut bus = Bus::leave(kmh(1));
        assert_eq!(bus.step_by(jump).outputs.epb.request, EpbRequest::Apply);
        let mut bus = Bus::driving(FAST);
        bus.ahead(object(2_700, 1_000));
        assert_eq!(bus.step_by(jump).outputs.brake.total, ms2(500), "and begin");
        assert_eq!(bus.step_by(jump).outputs.brake.total, ms2(500));
        let mut bus = Bus::opening_k4();
        assert_eq!(bus.step_by(jump).outputs.contactors.k4, ContactorRequest::Open);
        let mut bus = Bus::parked_by_leave();
        assert_eq!(bus.step_by(jump).outputs.gear, GearRequest::Neutral);
    }
}

/// SELF-3g: one clock fault ends the mode; it does not come back by itself.
#[test]
fn a_clock_fault_ends_the_mode() {
    for jump in [0, 51] {
        let mut bus = Bus::automated(FAST);
        bus.ask_adas(10);
        bus.run_for(500);
        let decision = bus.step_by(jump);
        assert_eq!((decision.status.mode, decision.status.exit), (Mode::Manual, ExitReason::Fault));
        assert_eq!((decision.outputs.mode, decision.outputs.drive.torque), (DrivingMode::Manual, Percent::ZERO));
        assert_eq!(bus.run_for(1_000).status.mode, Mode::Manual);
    }
}

/// SELF-3h: three faults in a row are the safe state, latched; two, and one good cycle between, are not.
#[test]
fn three_clock_faults_in_a_row_are_the_safe_state() {
    for jump in [0, 51, u32::MAX] {
        let mut bus = Bus::driving(FAST);
        for _ in 0..5 {
            bus.step_by(jump);
            assert!(!bus.step_by(jump).status.safe_state);
            assert!(!bus.step().status.safe_state);
        }
        bus.step_by(jump);
        bus.step_by(jump);
        let decision = bus.step_by(jump);
        assert!(decision.status.safe_state && decision.status.faults.contains(Faults::CLOCK_LATCHED), "{jump}");
        bus.run_with(60_000, 50, |decision| assert!(decision.status.safe_state, "latched"));
    }
}
