//! The modes that a flipped bit may meet: every value of every machine, with something to lose.

use super::common::*;

/// A mode by name.
pub type Named = (&'static str, Bus);

const FAST: SpeedKmhQ8 = kmh(50);

/// Every mode.
pub fn modes() -> Vec<Named> {
    let mut all = seat();
    all.extend(road());
    all.extend(drive());
    all.extend(steering());
    all.extend(safe());
    all
}

/// Boot, seat, parking brake, high voltage.
fn seat() -> Vec<Named> {
    let stepped = |mut bus: Bus| {
        bus.step();
        bus
    };
    let mut not_confirmed = Bus::driving(FAST);
    not_confirmed.seat(known(Seat::Vacant), known(Seat::Occupied));
    not_confirmed.run_for(500);
    vec![
        ("boot pending, nothing known", stepped(Bus::boot(ResetCause::Other, None, Inputs::NEVER))),
        ("boot pending, clean key-on", stepped(Bus::boot(ResetCause::PowerOn, Some(Record::None), healthy()))),
        ("seat confirmed, parked", Bus::parked()),
        ("seat confirmed, standing in D", Bus::driving(kmh(0))),
        ("seat not confirmed, driving", not_confirmed),
        ("leave, rolling", Bus::leave(FAST)),
        ("parked by leave, stage up", Bus::parked_by_leave()),
        ("parked by leave, driver back", Bus::returned()),
        ("parked by leave, release legal", Bus::ready_to_release()),
        ("stage opening K4", Bus::opening_k4()),
        ("stage opening K1", Bus::opening_k1()),
        ("stage down", Bus::down()),
        ("stage down, restarted", Bus::restarted()),
    ]
}

/// Mitigation: every level, its object seen and gone, and the hold after a lost speed.
fn road() -> Vec<Named> {
    let gone = |level| {
        let mut bus = Bus::mitigating(level);
        bus.road_clear();
        bus.run_for(200);
        bus
    };
    let mut held = Bus::mitigating(Level::Three);
    held.speed_unknown();
    held.run_for(11_000);
    vec![
        ("level 0", Bus::mitigating(Level::None)),
        ("level 1", Bus::mitigating(Level::One)),
        ("level 2", Bus::mitigating(Level::Two)),
        ("level 3", Bus::mitigating(Level::Three)),
        ("level 1, object gone", gone(Level::One)),
        ("level 3, object gone", gone(Level::Three)),
        ("hold after a lost speed", held),
    ]
}

/// Mode and torque.
fn drive() -> Vec<Named> {
    let mut automated = Bus::automated(FAST);
    automated.ask_adas(20);
    automated.run_for(500);
    let mut suspended = automated.clone();
    suspended.accelerator(travel(90));
    let decision = suspended.run_for(100);
    assert_eq!(decision.status.mode, Mode::Suspended);
    let mut manual = Bus::driving(FAST);
    manual.accelerator(travel(50));
    manual.ask_torque(40);
    manual.run_for(500);
    let mut lost = Bus::driving(FAST);
    lost.ask_brake(ms2(200));
    lost.run_for(100);
    lost.commands.brake = Command::Absent;
    lost.run_for(600);
    vec![
        ("manual, torque 40 %", manual),
        ("automated, torque 20 %", automated),
        ("suspended", suspended),
        ("hill-hold", random::hill()),
        ("brake request lost, ramp", lost),
    ]
}

/// Steering: acting, and fading in and out.
fn steering() -> Vec<Named> {
    let acting = Bus::steering(kmh(10));
    let mut fading_out = acting.clone();
    fading_out.commands.steering = Command::Absent;
    fading_out.run_for(300);
    let mut fading_in = Bus::automated(kmh(10));
    fading_in.commands.steering = Command::Fresh(STEER);
    fading_in.run_for(300);
    let mut taken = acting.clone();
    taken.inputs.driver_torque = known(hand_torque(7_000));
    taken.run_for(400);
    vec![
        ("steering acts", acting),
        ("steering fades in", fading_in),
        ("steering fades out", fading_out),
        ("steering taken over", taken),
    ]
}

/// The safe state that another fault has latched: a flip must still be seen as one.
fn safe() -> Vec<Named> {
    let by_clock = |mut bus: Bus| {
        for _ in 0..3 {
            bus.step_by(0);
        }
        assert!(bus.step().status.safe_state);
        bus
    };
    vec![
        ("safe state, driving", by_clock(Bus::driving(FAST))),
        ("safe state, standing", by_clock(Bus::driving(kmh(0)))),
        ("safe state, leave", by_clock(Bus::leave(FAST))),
    ]
}
