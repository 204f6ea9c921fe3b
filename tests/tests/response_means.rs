//! The next stronger means: what an actuator that does not follow calls (RSP-1k, RSP-1m, EPB-1b, EPB-1c, TRQ-7).

mod common;
use common::*;

/// Leave at 50 km/h; the brakes give nothing: 1.95 m/s² is demanded, the cap leaves the whole retarder.
fn unbraked_leave() -> Bus {
    let mut bus = Bus::driving(kmh(50));
    bus.vacant();
    let begun = bus.time_until(CYCLE, 3_000, in_leave);
    assert_eq!(begun, Some(2_000));
    bus
}

/// Level 3 at 50 km/h has just begun, 5 m/s² is demanded; the brakes give nothing: the cap leaves 66 %.
fn unbraked_level_three() -> Bus {
    Bus::mitigating(Level::Three)
}

/// Each with the retarder torque that the cap leaves.
const UNBRAKED: [(Make, u8); 2] = [(unbraked_leave, 100), (unbraked_level_three, 66)];

fn helps(decision: &Decision) -> bool {
    decision.outputs.retarder.torque > Percent::ZERO
}

fn full(torque: u8) -> Retarder {
    Retarder { torque: percent(torque), mode: RetarderMode::Torque, priority: Priority::Highest }
}

/// RSP-1k, RSP-1g: a confirmed shortfall of leave calls the retarder, all that the cap leaves; then, 500 ms later,
/// EPB-1b: the parking brake, above 1.5 km/h.
#[test]
fn retarder_then_parking_brake() {
    let mut bus = unbraked_leave();
    let mut before = bus.step();
    for _ in 0..109 {
        before = bus.step();
    }
    assert!(!helps(&before), "1090 ms");
    let decision = bus.step();
    assert_eq!(decision.outputs.retarder, full(100));
    assert_verdict(&decision, Channel::Retarder, Kind::Substitute, Reason::BrakeResponse);
    assert_eq!(decision.outputs.epb.request, EpbRequest::None);
    assert_eq!(bus.time_until(CYCLE, 5_000, applies), Some(490), "500 ms after it was confirmed");
    let decision = bus.step();
    assert_verdict(&decision, Channel::ParkingBrake, Kind::Substitute, Reason::BrakeResponse);
    assert!(decision.status.faults.contains(Faults::BRAKE_RESPONSE) && helps(&decision), "and both stay");
}

/// RSP-1k, EPB-1b: level 3 has no time to try one after the other: both at once.
#[test]
fn both_in_level_three() {
    let mut bus = unbraked_level_three();
    bus.run_with(1_100, CYCLE, |decision| assert!(!helps(decision) && !applies(decision)));
    let decision = bus.step();
    assert_eq!(decision.outputs.retarder, full(66));
    assert_verdict(&decision, Channel::ParkingBrake, Kind::Substitute, Reason::BrakeResponse);
    assert!(applies(&decision));
}

/// EPB-1b, RSP-1k, R-af: in level 3, brakes that give 85 % of 5 m/s², less than the 95 % that they should, are helped by
/// the retarder and not by the parking brake; with one bit less by both.
#[test]
fn nearly_enough_is_left_to_the_retarder() {
    for (measured, parks) in [(8_704, false), (8_703, true)] {
        let mut bus = unbraked_level_three();
        bus.inputs.deceleration = known(DecelMs2Q11::new(measured));
        assert!(bus.time_until(CYCLE, 2_000, helps).is_some(), "{measured}");
        assert_eq!(bus.time_until(CYCLE, 2_000, applies).is_some(), parks, "{measured}");
    }
}

/// EPB-1b, R-af: in leave it is not: 1.85 m/s² of 1.95, one bit less than 95 %, calls the parking brake 500 ms after the
/// retarder; with that bit neither is called.
#[test]
fn nearly_enough_is_not_enough_in_leave() {
    let enough = ms2(195).raw() - ms2(195).raw() / 20;
    for (measured, parks) in [(enough, None), (enough - 1, Some(490))] {
        let mut bus = unbraked_leave();
        bus.inputs.deceleration = known(DecelMs2Q11::new(measured));
        assert_eq!(bus.time_until(CYCLE, 2_000, helps).is_some(), parks.is_some(), "{measured}");
        assert_eq!(bus.time_until(CYCLE, 2_000, applies), parks, "{measured}");
    }
}

/// EPB-1b, RSP-1k: a parking brake that makes up for the brakes is not released again while level 3 runs.
#[test]
fn the_parking_brake_stays() {
    let mut bus = unbraked_level_three();
    assert!(bus.time_until(CYCLE, 2_000, applies).is_some());
    bus.inputs.epb = known(EpbState::Applied);
    bus.inputs.deceleration = known(ms2(500));
    bus.ask_epb(EpbRequest::Release);
    bus.run_with(1_000, CYCLE, |decision| assert!(!released(decision)));
}

/// RSP-1k: the main controller can not take the retarder away, nor release the parking brake.
#[test]
fn obliged_against_the_controller() {
    let mut bus = unbraked_leave();
    bus.commands.retarder = Command::Fresh(Retarder::NEUTRAL);
    bus.ask_epb(EpbRequest::Release);
    let decision = bus.run_for(2_000);
    assert_eq!(decision.outputs.retarder, full(100));
    assert!(applies(&decision));
    bus.commands = Commands::ABSENT;
    let decision = bus.run_for(1_000);
    assert_eq!(decision.outputs.retarder, full(100), "nor by silence");
    assert!(applies(&decision));
}

/// EPB-1b: levels 1 and 2 and comfort braking do not call the parking brake; comfort braking does not call the
/// retarder either.
#[test]
fn weaker_demands() {
    for level in [Level::One, Level::Two] {
        let mut bus = Bus::mitigating(level);
        let mut applied = false;
        let decision = bus.run_with(5_000, CYCLE, |decision| applied |= applies(decision));
        assert!(decision.outputs.retarder.torque > Percent::ZERO && !applied, "{level:?}");
    }
    let mut bus = Bus::driving(kmh(50));
    bus.ask_brake(ms2(200));
    let mut called = false;
    let decision = bus.run_with(5_000, CYCLE, |decision| called |= applies(decision) || helps(decision));
    assert!(decision.status.faults.contains(Faults::BRAKE_RESPONSE) && !called, "reported only");
    assert!(decision.outputs.warnings.fault_lamp);
}

/// RSP-1l, EPB-1c, RET-1b: with ABS at work or unknown neither the retarder nor the parking brake is called.
#[test]
fn antilock() {
    for abs in [known(true), unknown(Cause::Stale)] {
        for (make, _) in UNBRAKED {
            let mut bus = make();
            bus.inputs.abs = abs;
            bus.run_with(5_000, CYCLE, |decision| {
                assert!(!helps(decision) && !applies(decision), "{abs:?} from the beginning");
            });
            let mut bus = make();
            bus.inputs.abs = known(false);
            bus.run_for(3_000);
            bus.inputs.abs = abs;
            bus.run_with(5_000, CYCLE, |decision| {
                assert!(!helps(decision) && !applies(decision), "{abs:?} after both were called");
            });
        }
    }
}

/// EPB-1b, SELF-5e: in the safe state the parking brake is not applied above 1.5 km/h.
#[test]
fn safe_state() {
    let mut bus = unbraked_level_three();
    bus.run_for(3_000);
    assert!(applies(&bus.step()));
    for _ in 0..4 {
        bus.step_by(60);
    }
    let decision = bus.step();
    assert!(decision.status.safe_state);
    assert_eq!(decision.outputs.epb.request, EpbRequest::None);
    assert!(helps(&decision), "the retarder stays: the obligation persists");
}

/// RSP-1m: EBS red calls the retarder in the same cycle, and the parking brake with the first confirmed shortfall.
#[test]
fn ebs_red() {
    for (make, torque) in UNBRAKED {
        let mut bus = make();
        bus.inputs.ebs_red = known(true);
        assert_eq!(bus.step().outputs.retarder, full(torque));
        assert_eq!(bus.time_until(CYCLE, 5_000, applies), Some(1_090), "1100 ms after the command");
        let mut bus = make();
        bus.inputs.ebs_red = unknown(Cause::Stale);
        assert!(!helps(&bus.step()), "unknown is not red");
    }
    let mut bus = Bus::driving(kmh(50));
    bus.inputs.ebs_red = known(true);
    bus.ask_brake(ms2(200));
    bus.run_with(3_000, CYCLE, |decision| assert!(!helps(decision) && !applies(decision), "nothing is obliged"));
}

/// RSP-1k: the retarder that fills up the demand stays for as long as the demand does.
#[test]
fn retarder_stays() {
    let mut bus = unbraked_level_three();
    // Brakes that give 4 m/s² of 5, and a retarder that gives what it is told.
    let mut without = 0;
    for cycle in 0..500 {
        let decision = bus.step();
        let retarder = u16::from(decision.outputs.retarder.torque.raw()) * 31;
        bus.inputs.deceleration = known(DecelMs2Q11::new(8_192 + retarder));
        without += u32::from(cycle > 150 && !helps(&decision));
    }
    assert_eq!(without, 0, "cycles without the retarder after 1.5 s");
}

/// EPB-1b: limits below the total are no confirmed shortfall: a bus that brakes as told does not get its parking brake.
#[test]
fn limits_do_not_apply() {
    let mut bus = unbraked_leave();
    bus.inputs.friction_limit = known(ms2(100));
    bus.inputs.electric_limit = known(ms2(0));
    let mut applied = false;
    for _ in 0..300 {
        let decision = bus.step();
        applied |= applies(&decision);
        bus.inputs.deceleration = known(ms2(350));
    }
    assert!(!applied);
}

/// VLC-2f, RSP-1k: limits below an obliged total call the retarder at once.
#[test]
fn limits_call_the_retarder() {
    let mut bus = unbraked_leave();
    bus.inputs.deceleration = known(ms2(250));
    assert!(!helps(&bus.step()));
    bus.inputs.friction_limit = known(ms2(100));
    bus.inputs.electric_limit = known(ms2(0));
    assert!(helps(&bus.step()));
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

fn excess(decision: &Decision) -> bool {
    decision.status.faults.contains(Faults::EXCESS_TORQUE)
}

/// TRQ-7a: more than the output, 15 % and 5 % for longer than the response time; TRQ-7b: torque 0 in that cycle.
#[test]
fn excess_is_found() {
    for (torque, least) in [(0_u8, 6_u8), (40, 52)] {
        let mut bus = pulling();
        if torque == 0 {
            bus.ask_torque(0);
            bus.step();
        }
        executes(&mut bus, least - 1);
        assert_eq!(bus.time_until(CYCLE, 3_000, excess), None, "{torque}");
        executes(&mut bus, least);
        bus.run_with(600, CYCLE, |decision| {
            assert!(!excess(decision) && decision.outputs.drive.torque == percent(torque), "before its time");
        });
        let decision = bus.step();
        assert!(excess(&decision) && decision.outputs.drive.torque == Percent::ZERO, "{torque}");
        if torque > 0 {
            assert_verdict(&decision, Channel::DriveTorque, Kind::Limit, Reason::ExcessTorque);
        }
    }
}

/// TRQ-7a: a peak that ends in time, and unknown or implausible feedback, are none.
#[test]
fn excess_is_not_found() {
    let mut bus = pulling();
    for _ in 0..10 {
        executes(&mut bus, 80);
        bus.run_with(590, CYCLE, |decision| assert!(!excess(decision)));
        executes(&mut bus, 40);
        bus.step();
    }
    for lost in [unknown(Cause::Stale), known(percent(101))] {
        let mut bus = pulling();
        bus.inputs.executed_torque = lost;
        assert_eq!(bus.time_until(CYCLE, 3_000, excess), None);
    }
}

/// TRQ-7b: the torque stays 0 until the drive obeys and the accelerator has been released.
#[test]
fn excess_ends() {
    let mut bus = pulling();
    executes(&mut bus, 80);
    bus.run_for(700);
    executes(&mut bus, 6);
    let decision = bus.run_for(1_000);
    assert!(excess(&decision) && decision.outputs.drive.torque == Percent::ZERO, "told 0, it gives 6 %");
    executes(&mut bus, 5);
    let decision = bus.run_for(1_000);
    assert!(!excess(&decision), "it obeys");
    assert_verdict(&decision, Channel::DriveTorque, Kind::Limit, Reason::ReleaseNeeded);
    executes(&mut bus, 0);
    bus.accelerator(travel(0));
    bus.step();
    bus.accelerator(travel(40));
    bus.step();
    assert!(bus.step().outputs.drive.torque > Percent::ZERO, "released and pressed anew");
}

/// TRQ-7b: as long again, and the brakes hold against it with 1.35 m/s²; no sooner.
#[test]
fn excess_persists() {
    let mut bus = pulling();
    executes(&mut bus, 80);
    let braked = |decision: &Decision| decision.outputs.brake.total > DecelMs2Q11::ZERO;
    assert_eq!(bus.time_until(CYCLE, 5_000, braked), Some(1_100));
    let decision = bus.step();
    assert_eq!(decision.outputs.brake.total, ms2(135));
    assert_verdict(&decision, Channel::ServiceBrake, Kind::Substitute, Reason::ExcessTorque);
    executes(&mut bus, 0);
    assert!(!braked(&bus.step()), "it ends with the excess");
}

/// TRQ-7b, MODE-1e: an automated mode ends.
#[test]
fn excess_ends_the_mode() {
    let mut bus = Bus::automated(kmh(30));
    bus.follows = false;
    executes(&mut bus, 30);
    assert_eq!(bus.time_until(CYCLE, 3_000, excess), Some(600));
    let status = bus.step().status;
    assert_eq!((status.mode, status.exit), (Mode::Manual, ExitReason::Bypass));
}
