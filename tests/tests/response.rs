//! Do the actuators follow? RSP-1: every bound in time and value, one bit and one cycle around it.

mod common;
use common::*;

/// 2 m/s² in bits: 5 % is 204.8, 85 % is 3481.6, 95 % is 3891.2.
const TWO: u16 = 4_096;

/// When the fault is first reported, from the first cycle that can compare; `None` within 5 s.
fn reported(bus: &mut Bus, fault: Faults) -> Option<u32> {
    bus.time_until(CYCLE, 5_000, |decision| decision.status.faults.contains(fault))
}

/// Driving; the brake has been told this, and nothing has been compared yet.
fn told(speed: SpeedKmhQ8, total: u16) -> Bus {
    let mut bus = Bus::driving(speed);
    bus.ask_brake(DecelMs2Q11::new(total));
    assert_eq!(bus.step().outputs.brake.total.raw(), total, "the demand passes");
    bus
}

fn gives(bus: &mut Bus, measured: u16) {
    bus.inputs.deceleration = known(DecelMs2Q11::new(measured));
}

/// [`told`] 2 m/s², and given all of it.
fn followed() -> Bus {
    let mut bus = told(kmh(50), TWO);
    gives(&mut bus, TWO);
    bus.run_for(100);
    bus
}

/// [`told`] 2 m/s², compared once at 0, and from the next cycle on this is given.
fn responding(measured: u16) -> Bus {
    let mut bus = told(kmh(50), TWO);
    bus.step();
    gives(&mut bus, measured);
    bus
}

/// RSP-1g: no response at all: 1000 ms from the command, and 100 ms for the age of the feedback.
#[test]
fn brake_outer() {
    for measured in [0, 204, 3_891] {
        let mut bus = told(kmh(50), TWO);
        gives(&mut bus, measured);
        assert_eq!(reported(&mut bus, Faults::BRAKE_RESPONSE), Some(1_100), "{measured}, from the beginning");
    }
    assert_eq!(reported(&mut responding(204), Faults::BRAKE_RESPONSE), Some(1_090), "below 5 % of the way");
}

/// RSP-1b: from the first response, 5 % of the way, 700 ms and the age.
#[test]
fn brake_inner() {
    for measured in [205, 3_481, 3_482, 3_891] {
        assert_eq!(reported(&mut responding(measured), Faults::BRAKE_RESPONSE), Some(800), "{measured}");
    }
    assert_eq!(reported(&mut responding(3_892), Faults::BRAKE_RESPONSE), None, "95 % is reached");
}

/// RSP-1b: the last cycle in which 95 % is in time, and the first one in which it is not; what was found stays for as
/// long as the demand.
#[test]
fn brake_last_moment() {
    for (late, expected) in [(800, false), (810, true)] {
        let mut bus = responding(205);
        let mut seen = false;
        bus.run_with(late, CYCLE, |decision| seen |= decision.status.faults.contains(Faults::BRAKE_RESPONSE));
        assert_eq!(seen, expected, "{late}");
        gives(&mut bus, 3_892);
        assert_eq!(bus.run_for(3_000).status.faults.contains(Faults::BRAKE_RESPONSE), expected, "{late}");
        bus.ask_brake(ms2(0));
        bus.step();
        assert!(!bus.step().status.faults.contains(Faults::BRAKE_RESPONSE), "withdrawn");
    }
}

/// RSP-1g: a response that comes late does not lengthen the 1000 ms.
#[test]
fn brake_late_response() {
    let mut bus = told(kmh(50), TWO);
    bus.run_for(900);
    gives(&mut bus, 2_000);
    assert_eq!(reported(&mut bus, Faults::BRAKE_RESPONSE), Some(200));
}

/// A level has just begun, it was compared once at 0, and from the next cycle on this is given.
fn mitigating(level: Level, measured: u16) -> Bus {
    let mut bus = Bus::mitigating(level);
    bus.step();
    gives(&mut bus, measured);
    bus
}

/// RSP-1c: in level 3 500 ms from the first response (5 % of 5 m/s² are 512), still 1000 ms from the command.
#[test]
fn brake_emergency() {
    for (measured, expected) in [(511, Some(1_090)), (512, Some(600)), (9_727, Some(600)), (9_728, None)] {
        let mut bus = mitigating(Level::Three, measured);
        assert_eq!(reported(&mut bus, Faults::BRAKE_RESPONSE), expected, "{measured}");
    }
    let mut bus = mitigating(Level::Two, 300);
    assert_eq!(reported(&mut bus, Faults::BRAKE_RESPONSE), Some(800), "RSP-1b: level 2 is no emergency");
}

/// RSP-1c: the shorter time of level 3 begins with level 3, not with the level before it.
#[test]
fn brake_becomes_emergency() {
    let mut bus = mitigating(Level::Two, 1_000);
    bus.run_with(700, CYCLE, |decision| assert!(!decision.status.faults.contains(Faults::BRAKE_RESPONSE)));
    bus.ahead(at(2_700));
    let decision = bus.step();
    assert_eq!(decision.status.level, Level::Three);
    bus.step();
    gives(&mut bus, 2_000);
    assert_eq!(reported(&mut bus, Faults::BRAKE_RESPONSE), Some(600));
}

/// RSP-1i: once it follows, 15 % below is no fault; one bit more is, and then only 95 % is enough.
#[test]
fn brake_steady_error() {
    let mut bus = followed();
    gives(&mut bus, 3_482);
    assert_eq!(reported(&mut bus, Faults::BRAKE_RESPONSE), None, "within 15 %");
    gives(&mut bus, 3_481);
    assert_eq!(reported(&mut bus, Faults::BRAKE_RESPONSE), Some(1_100));
    for (measured, expected) in [(3_891, Some(800)), (3_892, None)] {
        let mut bus = followed();
        gives(&mut bus, 3_481);
        bus.step();
        gives(&mut bus, measured);
        assert_eq!(reported(&mut bus, Faults::BRAKE_RESPONSE), expected, "{measured}");
    }
}

/// RSP-1g: a target that rises is measured anew from there; one that is withdrawn ends the comparison.
#[test]
fn brake_moving_target() {
    // A brake that lags 500 ms behind a demand that rises by 1 m/s² per second.
    let mut bus = told(kmh(50), 1_024);
    let mut line = std::collections::VecDeque::from(vec![0_u16; 50]);
    for target in (1_024..7_000).step_by(20) {
        bus.ask_brake(DecelMs2Q11::new(target));
        let decision = bus.step();
        assert!(!decision.status.faults.contains(Faults::BRAKE_RESPONSE), "RSP-1: a ramp at {target}");
        line.push_back(decision.outputs.brake.total.raw());
        gives(&mut bus, line.pop_front().unwrap_or(0));
    }
    let mut bus = told(kmh(50), TWO);
    bus.run_for(1_100);
    bus.ask_brake(ms2(0));
    assert!(bus.step().status.faults.contains(Faults::BRAKE_RESPONSE), "compared with what went out before");
    assert!(!bus.step().status.faults.contains(Faults::BRAKE_RESPONSE), "withdrawn");
    bus.ask_brake(DecelMs2Q11::new(TWO));
    bus.step();
    assert_eq!(reported(&mut bus, Faults::BRAKE_RESPONSE), Some(1_100), "and its time begins anew");
}

/// RSP-1g: compared from 5 km/h (either speed) and from 0.5 m/s² on.
#[test]
fn brake_compared_from() {
    for (speed, total, expected) in [
        (kmh(5), TWO, Some(1_100)),
        (bit_below(kmh(5)), TWO, None),
        (kmh(50), 1_024, Some(1_100)),
        (kmh(50), 1_023, None),
    ] {
        let mut bus = told(speed, total);
        assert_eq!(reported(&mut bus, Faults::BRAKE_RESPONSE), expected, "{speed:?} {total}");
    }
    let mut bus = told(kmh(5), TWO);
    bus.speeds(bit_below(kmh(5)), kmh(5));
    assert_eq!(reported(&mut bus, Faults::BRAKE_RESPONSE), Some(1_100), "only surely below it is not compared");
}

/// RSP-1b, MIT-6c: a deceleration beyond 10 m/s² is not plausible, and evidence for nothing: it neither follows nor fails.
#[test]
fn brake_implausible() {
    let mut bus = told(kmh(50), TWO);
    gives(&mut bus, 20_481);
    assert_eq!(reported(&mut bus, Faults::BRAKE_RESPONSE.with(Faults::BRAKE_OVERSHOOT)), None);
    gives(&mut bus, 0);
    assert_eq!(reported(&mut bus, Faults::BRAKE_RESPONSE), Some(1_100));
    let mut bus = followed();
    gives(&mut bus, 20_481);
    assert_eq!(reported(&mut bus, Faults::BRAKE_OVERSHOOT), None);
    gives(&mut bus, 20_480);
    assert_eq!(reported(&mut bus, Faults::BRAKE_OVERSHOOT), Some(500));
}

/// RSP-1l: ABS at work is never a response fault, and what was found ends with it. Unknown ABS hides nothing.
#[test]
fn brake_antilock() {
    let mut bus = told(kmh(50), TWO);
    bus.inputs.abs = known(true);
    assert_eq!(reported(&mut bus, Faults::BRAKE_RESPONSE), None);
    let mut bus = told(kmh(50), TWO);
    bus.run_for(1_500);
    bus.inputs.abs = known(true);
    assert!(!bus.step().status.faults.contains(Faults::BRAKE_RESPONSE));
    bus.inputs.abs = known(false);
    assert_eq!(reported(&mut bus, Faults::BRAKE_RESPONSE), Some(1_100), "anew after ABS");
    let mut bus = told(kmh(50), TWO);
    bus.inputs.abs = unknown(Cause::Stale);
    assert_eq!(reported(&mut bus, Faults::BRAKE_RESPONSE), Some(1_100));
}

/// RSP-1g, RULE-1d: unknown feedback is evidence for neither: the time stands still, and what was found stays.
#[test]
fn brake_unknown_freezes() {
    let losses: [Edit; 2] =
        [|bus| bus.inputs.deceleration = unknown(Cause::Stale), |bus| bus.inputs.wheel_speed = STALE];
    for lose in losses {
        let mut bus = told(kmh(50), TWO);
        bus.run_for(500);
        let kept = bus.inputs;
        lose(&mut bus);
        assert_eq!(reported(&mut bus, Faults::BRAKE_RESPONSE), None, "nothing new while unknown");
        bus.inputs = kept;
        assert_eq!(reported(&mut bus, Faults::BRAKE_RESPONSE), Some(600), "500 ms had run");
        lose(&mut bus);
        let decision = bus.run_for(3_000);
        assert!(decision.status.faults.contains(Faults::BRAKE_RESPONSE), "what was found stays");
    }
}

/// RSP-1m: EBS red is reported at once, unknown is not red.
#[test]
fn ebs_red() {
    let mut bus = Bus::driving(kmh(50));
    bus.inputs.ebs_red = unknown(Cause::Stale);
    assert!(!bus.step().status.faults.contains(Faults::EBS_RED));
    bus.inputs.ebs_red = known(true);
    assert!(bus.step().status.faults.contains(Faults::EBS_RED));
    bus.inputs.ebs_red = known(false);
    assert!(!bus.step().status.faults.contains(Faults::EBS_RED));
}

/// VLC-2f: both limits together one bit below the total go to RSP-1; equal, or friction unknown, do not.
#[test]
fn limits_below_total() {
    for (friction, electric, expected) in [(3_000, 1_096, None), (3_000, 1_095, Some(0)), (2_999, 1_096, Some(0))] {
        let mut bus = followed();
        bus.inputs.friction_limit = known(DecelMs2Q11::new(friction));
        bus.inputs.electric_limit = known(DecelMs2Q11::new(electric));
        assert_eq!(reported(&mut bus, Faults::BRAKE_RESPONSE), expected, "{friction} {electric}");
    }
    let mut bus = followed();
    bus.inputs.friction_limit = known(DecelMs2Q11::new(TWO - 1));
    bus.inputs.electric_limit = unknown(Cause::Stale);
    assert_eq!(reported(&mut bus, Faults::BRAKE_RESPONSE), Some(0), "an unknown electric limit gives nothing");
    let mut bus = followed();
    bus.inputs.friction_limit = unknown(Cause::Stale);
    bus.inputs.electric_limit = known(ms2(0));
    assert_eq!(reported(&mut bus, Faults::BRAKE_RESPONSE), None);
}

/// RSP-1j: more than the target, 15 % (614) and the drag (2048) for 500 ms is an overshoot.
#[test]
fn brake_overshoot() {
    let mut bus = followed();
    gives(&mut bus, 6_758);
    assert_eq!(reported(&mut bus, Faults::BRAKE_OVERSHOOT), None);
    gives(&mut bus, 6_759);
    assert_eq!(reported(&mut bus, Faults::BRAKE_OVERSHOOT), Some(500));
    let excuses: [Change; 3] = [
        ("the driver brakes himself", |bus| bus.inputs.brake_switch = known(true)),
        ("the driver may brake himself", |bus| bus.inputs.brake_switch = unknown(Cause::Stale)),
        ("ABS at work", |bus| bus.inputs.abs = known(true)),
    ];
    for (name, excuse) in excuses {
        let mut bus = followed();
        gives(&mut bus, 6_759);
        excuse(&mut bus);
        assert_eq!(reported(&mut bus, Faults::BRAKE_OVERSHOOT), None, "{name}");
    }
}

/// The driver's torque has been 40 % for a while, and the drive gave it.
fn pulling() -> Bus {
    let mut bus = Bus::driving(kmh(30));
    bus.accelerator(travel(40));
    bus.ask_torque(40);
    let decision = bus.run_for(500);
    assert_eq!(decision.outputs.drive.torque, percent(40));
    bus.follows = false;
    bus
}

fn executes(bus: &mut Bus, torque: u8) {
    bus.inputs.executed_torque = known(percent(torque));
}

/// RSP-1a, RSP-1f: a drive that does not answer is reported 500 ms and the age after the first torque to compare.
#[test]
fn drive_silent() {
    let mut bus = Bus::driving(kmh(30));
    bus.follows = false;
    bus.accelerator(travel(40));
    bus.ask_torque(6);
    assert!(bus.time_until(CYCLE, 200, |decision| decision.outputs.drive.torque == percent(6)).is_some());
    assert_eq!(reported(&mut bus, Faults::DRIVE_RESPONSE), Some(600));
    let mut bus = Bus::driving(kmh(30));
    bus.follows = false;
    bus.accelerator(travel(40));
    bus.ask_torque(5);
    assert_eq!(reported(&mut bus, Faults::DRIVE_RESPONSE), None, "below the idle torque it need not answer");
}

/// RSP-1i: 34 of 40 % is 15 % below, 33 is more; 38 is 95 %, 37 is not.
#[test]
fn drive_steady_error() {
    let mut bus = pulling();
    executes(&mut bus, 34);
    assert_eq!(reported(&mut bus, Faults::DRIVE_RESPONSE), None);
    executes(&mut bus, 33);
    assert_eq!(reported(&mut bus, Faults::DRIVE_RESPONSE), Some(600));
    executes(&mut bus, 37);
    assert!(bus.step().status.faults.contains(Faults::DRIVE_RESPONSE));
    executes(&mut bus, 38);
    assert!(!bus.step().status.faults.contains(Faults::DRIVE_RESPONSE));
}

/// RSP-1a: ramps with a lag of 300 ms, unknown feedback, and slip control are no fault.
#[test]
fn drive_excuses() {
    let mut bus = Bus::driving(kmh(30));
    bus.follows = false;
    bus.accelerator(travel(100));
    bus.ask_torque(100);
    let mut line = std::collections::VecDeque::from(vec![0_u8; 30]);
    for cycle in 0..200 {
        if cycle == 100 {
            bus.ask_torque(0);
        }
        let decision = bus.step();
        let found = decision.status.faults.and(Faults::DRIVE_RESPONSE.with(Faults::EXCESS_TORQUE));
        assert_eq!(found, Faults::NONE, "RSP-1, TRQ-7: a lag of 300 ms, cycle {cycle}");
        line.push_back(decision.outputs.drive.torque.raw());
        executes(&mut bus, line.pop_front().unwrap_or(0));
    }
    let mut bus = pulling();
    executes(&mut bus, 0);
    bus.run_for(400);
    bus.inputs.executed_torque = unknown(Cause::Stale);
    assert_eq!(reported(&mut bus, Faults::DRIVE_RESPONSE), None, "nothing new while unknown");
    executes(&mut bus, 0);
    assert_eq!(reported(&mut bus, Faults::DRIVE_RESPONSE), Some(200), "400 ms had run");
    let mut bus = pulling();
    executes(&mut bus, 0);
    bus.inputs.asr = known(true);
    assert_eq!(reported(&mut bus, Faults::DRIVE_RESPONSE), None, "slip control takes torque away");
}

/// RSP-1n: while ASR is active or unknown the torque does not rise, and may fall.
#[test]
fn slip_control() {
    for asr in [known(true), unknown(Cause::Stale)] {
        let mut bus = pulling();
        bus.inputs.asr = asr;
        bus.accelerator(travel(80));
        bus.ask_torque(80);
        bus.run_with(500, CYCLE, |decision| assert_eq!(decision.outputs.drive.torque, percent(40)));
        assert_verdict(&bus.step(), Channel::DriveTorque, Kind::Limit, Reason::SlipControl);
        bus.ask_torque(30);
        assert_eq!(bus.step().outputs.drive.torque, percent(30));
        bus.ask_torque(31);
        assert_eq!(bus.step().outputs.drive.torque, percent(30));
        bus.inputs.asr = known(false);
        assert_eq!(bus.step().outputs.drive.torque, percent(31));
    }
}

/// Parked; D has been asked for, and nothing has been compared yet.
fn shifting() -> Bus {
    let mut bus = Bus::parked();
    bus.inputs.selector = known(Gear::Drive);
    bus.ask_gear(GearRequest::Drive);
    assert_eq!(bus.step().outputs.gear, GearRequest::Drive);
    bus
}

/// RSP-1d: a gear that is not confirmed is reported after 800 ms and the age, and no longer once it is.
#[test]
fn gear_late() {
    let mut bus = shifting();
    assert_eq!(reported(&mut bus, Faults::GEAR_RESPONSE), Some(900));
    bus.inputs.gear = known(Gear::Drive);
    let decision = bus.step();
    assert!(!decision.status.faults.contains(Faults::GEAR_RESPONSE));
    assert!(!decision.status.faults.contains(Faults::BYPASS), "asked for, though late");
    let mut bus = shifting();
    bus.run_for(890);
    bus.inputs.gear = known(Gear::Drive);
    assert_eq!(reported(&mut bus, Faults::GEAR_RESPONSE), None, "in time");
}

/// RSP-1d: asked once, not all the time: the wait is the same.
#[test]
fn gear_asked_once() {
    let mut bus = shifting();
    bus.ask_gear(GearRequest::Hold);
    assert_eq!(reported(&mut bus, Faults::GEAR_RESPONSE), Some(900));
}

/// RSP-1d, SELF-10a: a gearbox on its way from R to D is seen in N; asked once, it has still been asked for D.
#[test]
fn gear_on_its_way() {
    let make = || {
        let mut bus = Bus::parked();
        bus.engage(known(Gear::Reverse));
        bus.run_for(100);
        bus.inputs.selector = known(Gear::Drive);
        bus.ask_gear(GearRequest::Drive);
        assert_eq!(bus.step().outputs.gear, GearRequest::Drive);
        bus.ask_gear(GearRequest::Hold);
        bus.inputs.gear = known(Gear::Neutral);
        bus
    };
    assert_eq!(reported(&mut make(), Faults::GEAR_RESPONSE), Some(900), "stuck half-way");
    let mut bus = make();
    bus.run_for(300);
    bus.inputs.gear = known(Gear::Drive);
    assert_eq!(reported(&mut bus, Faults::BYPASS), None, "D was asked for");
}

/// RSP-1b: the first response to a demand that grows is a response to its growth: 5 % of the step, not of the whole.
#[test]
fn brake_step_from_a_level() {
    let mut bus = told(kmh(50), 2_048);
    gives(&mut bus, 2_048);
    bus.run_for(100);
    bus.ask_brake(DecelMs2Q11::new(5_120));
    bus.step();
    // 300 ms of dead time, then 600 ms until it is there: inside both bounds.
    let mut seen = false;
    bus.run_with(300, CYCLE, |decision| seen |= decision.status.faults.contains(Faults::BRAKE_RESPONSE));
    gives(&mut bus, 3_000);
    bus.run_with(600, CYCLE, |decision| seen |= decision.status.faults.contains(Faults::BRAKE_RESPONSE));
    assert!(!seen, "from its first response, 700 ms");
}

/// RSP-1g, RULE-6c: speeds that disagree are an unknown speed: what was found stays.
#[test]
fn brake_speeds_disagree() {
    let mut bus = told(kmh(50), TWO);
    bus.run_for(1_500);
    bus.inputs.wheel_speed = known(kmh(0));
    assert!(bus.run_for(1_000).status.faults.contains(Faults::BRAKE_RESPONSE));
}

/// RSP-1l: limits below the total are no response fault while ABS is at work, either.
#[test]
fn limits_and_antilock() {
    let mut bus = followed();
    bus.inputs.friction_limit = known(ms2(0));
    bus.inputs.electric_limit = known(ms2(0));
    bus.inputs.abs = known(true);
    assert_eq!(reported(&mut bus, Faults::BRAKE_RESPONSE), None);
}

/// VLC-2f: the retarder is no part of what friction and electric brake must give.
#[test]
fn limits_beside_the_retarder() {
    let mut bus = followed();
    bus.inputs.friction_limit = known(DecelMs2Q11::new(TWO));
    bus.inputs.electric_limit = known(ms2(0));
    bus.commands.retarder =
        Command::Fresh(Retarder { torque: percent(50), mode: RetarderMode::Torque, priority: Priority::Low });
    gives(&mut bus, TWO + 1_550);
    assert_eq!(reported(&mut bus, Faults::BRAKE_RESPONSE), None);
}

/// RSP-1d, RULE-1d: a gear that is unknown now and then stops the time, but does not begin it anew.
#[test]
fn gear_unknown_now_and_then() {
    let mut bus = shifting();
    for _ in 0..3 {
        bus.run_with(300, CYCLE, |decision| assert!(!decision.status.faults.contains(Faults::GEAR_RESPONSE)));
        let kept = bus.inputs.gear;
        bus.inputs.gear = unknown(Cause::NotAvailable);
        bus.run_with(300, CYCLE, |decision| assert!(!decision.status.faults.contains(Faults::GEAR_RESPONSE)));
        bus.inputs.gear = kept;
    }
    assert!(bus.step().status.faults.contains(Faults::GEAR_RESPONSE), "900 ms of known gears");
}
