//! The supervisor itself: determinism, endurance, feasibility (SELF-2d, SELF-3a, SELF-3b, END-1).

mod common;
use common::*;

const FAST: SpeedKmhQ8 = kmh(50);

/// SELF-3a: equal histories give equal decisions.
#[test]
fn equal_histories_give_equal_decisions() {
    let mut first = Bus::automated(FAST);
    let mut second = Bus::automated(FAST);
    for step in 0..500_u16 {
        for bus in [&mut first, &mut second] {
            bus.speed(kmh_q8(12_800_u16.saturating_sub(step * 20)));
            bus.ask_adas(u8::try_from(step % 70).unwrap_or(0));
            if step == 200 {
                bus.vacant();
            }
        }
        assert_eq!(first.step(), second.step());
    }
}

/// One drive with everything in it; what it decides, cycle by cycle.
fn whole_drive(mut bus: Bus) -> Vec<Decision> {
    let mut decisions = Vec::new();
    let mut run = |bus: &mut Bus, cycles: u32| {
        for _ in 0..cycles {
            decisions.push(bus.step());
        }
    };
    bus.accelerator(travel(40));
    bus.ask_torque(40);
    run(&mut bus, 50);
    bus.ahead(object(2_700, 1_000));
    run(&mut bus, 50);
    bus.speed(kmh(0));
    run(&mut bus, 150);
    bus.road_clear();
    bus.speed(kmh(20));
    bus.vacant();
    run(&mut bus, 250);
    bus.speed(kmh(0));
    run(&mut bus, 250);
    bus.inputs.epb = known(EpbState::Applied);
    run(&mut bus, 100);
    bus.occupied();
    run(&mut bus, 150);
    decisions
}

/// SELF-3b, END-1b: a wrap of the clock anywhere in a drive changes nothing.
#[test]
fn a_wrap_of_the_clock_changes_nothing() {
    let start = || {
        let inputs = Inputs {
            gear: known(Gear::Drive),
            selector: known(Gear::Drive),
            epb: known(EpbState::Released),
            ..healthy()
        };
        let mut bus = Bus::boot(ResetCause::PowerOn, Some(Record::None), inputs);
        bus.speed(FAST);
        bus
    };
    let expected = whole_drive(start());
    for before in [0, 1, 9, 10, 11, 505, 1_000, 5_000, 7_995, 9_000] {
        let mut bus = start();
        bus.now = 0_u32.wrapping_sub(before);
        assert_eq!(whole_drive(bus), expected, "wrap after {before} ms");
    }
}

/// END-1a: after eight hours of driving everything is as it was after seconds.
#[test]
fn eight_hours_change_nothing() {
    let fresh = Bus::driving(FAST);
    let mut old = Bus::driving(FAST);
    old.run_coarse(8 * 3_600 * 1_000);
    assert_eq!(whole_drive(old), whole_drive(fresh));
}

/// Makes an envelope contradict itself.
type Contradict = fn(&mut Envelope);

/// SELF-2d, RULE-4a: what the oracle asks of every envelope does tell: each contradiction alone is not feasible.
#[test]
fn each_contradiction_of_an_envelope_is_not_feasible() {
    let feasible = Bus::steering(kmh(10)).step().envelope;
    assert!(feasible.is_feasible());
    let refused = Err(Reason::SafeState);
    let changes: [(&str, Contradict); 14] = [
        ("brake", |envelope| envelope.brake.floor.most = DecelMs2Q11::new(envelope.brake.cap.most.raw() + 1)),
        ("angle", |envelope| envelope.steering.angle_least = angle(envelope.steering.angle_most.raw() + 1)),
        ("angle of rest below", |envelope| {
            envelope.steering.angle_neutral = angle(envelope.steering.angle_least.raw() - 1);
        }),
        ("angle of rest above", |envelope| {
            envelope.steering.angle_neutral = angle(envelope.steering.angle_most.raw() + 1);
        }),
        ("overlay of rest below", |envelope| {
            envelope.steering.overlay_neutral = TorqueNmQ10::new(envelope.steering.overlay_least.raw() - 1);
        }),
        ("overlay of rest above", |envelope| {
            envelope.steering.overlay_neutral = TorqueNmQ10::new(envelope.steering.overlay_most.raw() + 1);
        }),
        ("weight", |envelope| envelope.steering.weight_most = percent(101)),
        ("weight order", |envelope| envelope.steering.weight_most = percent(envelope.steering.weight_least.raw() - 1)),
        ("apply refused", |envelope| {
            envelope.epb = EpbBound {
                obliged: Some(Reason::EpbApply),
                apply: Err(Reason::EpbSpeed),
                release: Err(Reason::EpbApply),
            };
        }),
        ("release permitted", |envelope| {
            envelope.epb = EpbBound { obliged: Some(Reason::EpbApply), apply: Ok(()), release: Ok(()) };
        }),
        ("K4 guarded", |envelope| envelope.k4.obliged = envelope.k4.open.is_err()),
        ("K4 may close", |envelope| envelope.k4 = ContactorBound { obliged: true, open: Ok(()), close: Ok(()) }),
        ("K1 guarded", |envelope| envelope.k1.obliged = envelope.k1.open.is_err()),
        ("K1 may close", |envelope| envelope.k1 = ContactorBound { obliged: true, open: Ok(()), close: Ok(()) }),
    ];
    for (name, change) in changes {
        let mut envelope = feasible;
        change(&mut envelope);
        assert!(!envelope.is_feasible(), "{name}");
    }
    let gear = GearBound { neutral: true, to_neutral: refused, ..feasible.gear };
    assert!(!Envelope { gear, ..feasible }.is_feasible(), "gear");
    let k4 = ContactorBound { obliged: true, open: Ok(()), close: refused };
    assert!(Envelope { k4, k1: k4, ..feasible }.is_feasible(), "an obligation with its guard is feasible");
}
