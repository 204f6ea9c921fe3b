//! Which faults stay, and what clears them? SELF-7, with the causes of SELF-3f, SELF-4e, SELF-5b, SELF-6b, SEAT-7h.

mod common;
use common::*;

/// A bus that stands with its parking brake applied; the fault was latched in its last cycle and has no cause any more.
struct Latched {
    name: &'static str,
    fault: Faults,
    make: Make,
}

const SAFE: [Latched; 3] = [
    Latched { name: "clock", fault: Faults::CLOCK_LATCHED, make: clock },
    Latched { name: "state", fault: Faults::STATE, make: state },
    Latched { name: "flow", fault: Faults::FLOW, make: flow },
];

const ALL: [Latched; 5] = [
    Latched { name: "clock", fault: Faults::CLOCK_LATCHED, make: clock },
    Latched { name: "state", fault: Faults::STATE, make: state },
    Latched { name: "flow", fault: Faults::FLOW, make: flow },
    Latched { name: "K4 alone", fault: Faults::CONTACTOR, make: k4_alone },
    Latched { name: "K1 alone", fault: Faults::CONTACTOR, make: k1_alone },
];

fn clock() -> Bus {
    let mut bus = Bus::parked();
    for _ in 0..3 {
        bus.step_by(51);
    }
    bus
}

fn state() -> Bus {
    let mut bus = Bus::parked().with_image(|image| image.with_flipped_bit(0, 0));
    bus.step();
    bus
}

fn flow() -> Bus {
    let mut bus = Bus::parked().with_state(|state| State { flow: Flow::START, ..state });
    bus.step_unjudged(CYCLE);
    bus
}

fn k4_alone() -> Bus {
    let mut bus = Bus::parked();
    bus.inputs.k4 = OPEN;
    bus.step();
    bus
}

fn k1_alone() -> Bus {
    let mut bus = Bus::parked();
    bus.inputs.k1 = OPEN;
    bus.step();
    bus
}

/// One cycle, not judged: some begin with a state from elsewhere.
fn cycle(bus: &mut Bus) -> Decision {
    bus.step_unjudged(CYCLE)
}

fn rest(bus: &mut Bus, span: u32) {
    for _ in 0..span / CYCLE {
        cycle(bus);
    }
}

fn key(bus: &mut Bus, key: Key) -> Faults {
    bus.inputs.key = known(key);
    cycle(bus).status.faults
}

/// 10 s without a cause, then Off and On.
fn clears(bus: &mut Bus, fault: Faults) -> bool {
    rest(bus, 10_010);
    key(bus, Key::Off);
    !key(bus, Key::On).contains(fault)
}

/// SELF-7a: each cause latches; the four of the supervisor itself are the safe state, a contactor's is not.
#[test]
fn causes() {
    for Latched { name, fault, make } in ALL {
        let mut bus = make();
        let decision = cycle(&mut bus);
        assert!(decision.status.faults.contains(fault), "{name}: it stays without its cause");
        assert_eq!(decision.status.safe_state, fault != Faults::CONTACTOR, "{name}");
        assert!(decision.outputs.warnings.fault_lamp, "{name}");
    }
    let mut bus = Bus::parked();
    bus.step_by(51);
    bus.step_by(51);
    assert!(!bus.step().status.safe_state, "SELF-3: two clock faults are not three");
}

/// SEAT-7h, SELF-7a: K4 or K1 overdue latches the contactor fault, to the cycle.
#[test]
fn overdue() {
    let contactor = |decision: &Decision| decision.status.faults.contains(Faults::CONTACTOR);
    let mut bus = Bus::parked_by_leave();
    assert!(bus.time_until(50, 700_000, opens_k4).is_some());
    let time = bus.time_until(CYCLE, 20_000, contactor);
    assert_eq!(time, Some(2_000), "2 s with the cycle of the command, and a cycle to latch");
    assert!(bus.step().status.faults.contains(Faults::K4_OVERDUE));
    bus.inputs.k4 = OPEN;
    assert!(contactor(&bus.run_for(500)), "opening late does not clear it");

    let mut bus = Bus::opening_k1();
    let time = bus.time_until(CYCLE, 20_000, contactor);
    assert_eq!(time, Some(10_000), "10 s with the cycle of the command, and a cycle to latch");
    assert!(bus.step().status.faults.contains(Faults::K1_OVERDUE));
    let decision = bus.step();
    assert!(!decision.status.safe_state);
    // The cause lasts: no clearing.
    assert!(!clears(&mut bus, Faults::CONTACTOR), "still not open");
    bus.loads_stopped();
    cycle(&mut bus);
    bus.inputs.k1 = OPEN;
    cycle(&mut bus);
    assert!(clears(&mut bus, Faults::CONTACTOR), "open at last");
}

/// SELF-7a, SELF-7b, SELF-7c: what clears each of them: 10 s, then Off, then On or Start.
#[test]
fn cleared() {
    for Latched { name, fault, make } in ALL {
        assert!(clears(&mut make(), fault), "{name}");
        let mut bus = make();
        rest(&mut bus, 10_010);
        key(&mut bus, Key::Off);
        assert!(!key(&mut bus, Key::Start).contains(fault), "{name}: Start");
        let decision = cycle(&mut bus);
        assert!(!decision.status.safe_state && !decision.status.faults.contains(fault), "{name}: and stays clear");
    }
}

/// SELF-7b: one cycle less than 10 s is not enough, for each; the key may be Off all the time.
#[test]
fn time() {
    for Latched { name, fault, make } in ALL {
        // A state that did not decode was replaced in that cycle: it is the first one without a cause.
        let early = if fault == Faults::STATE { CYCLE } else { 0 };
        for (span, expected) in [(10_000 - early, false), (10_010 - early, true)] {
            let mut bus = make();
            bus.inputs.key = known(Key::Off);
            rest(&mut bus, span);
            assert_eq!(!key(&mut bus, Key::On).contains(fault), expected, "{name} {span}");
        }
    }
}

/// SELF-7c: every other use of the key keeps it.
#[test]
fn key_cycle() {
    let wrong: [&[Key]; 5] =
        [&[], &[Key::On], &[Key::Off], &[Key::On, Key::Off], &[Key::Start, Key::On, Key::Start, Key::Off]];
    for Latched { name, fault, make } in ALL {
        for keys in wrong {
            let mut bus = make();
            rest(&mut bus, 20_000);
            for position in keys {
                key(&mut bus, *position);
            }
            assert!(cycle(&mut bus).status.faults.contains(fault), "{name} {keys:?}");
        }
        // Off before the time is over, On after it.
        let mut bus = make();
        key(&mut bus, Key::Off);
        bus.inputs.key = known(Key::On);
        rest(&mut bus, 20_000);
        assert!(cycle(&mut bus).status.faults.contains(fault), "{name}: an early Off");
        let mut bus = make();
        rest(&mut bus, 20_000);
        bus.inputs.key = unknown(Cause::Stale);
        cycle(&mut bus);
        assert!(key(&mut bus, Key::On).contains(fault), "{name}: unknown is not Off");
    }
}

/// What has to hold all the time, each lost in a way of its own.
const LOST: [Change; 6] = [
    ("SELF-7a rolling", |bus| bus.speed(ROLLING)),
    ("SELF-7a one speed rolling", |bus| bus.speeds(STANDSTILL, ROLLING)),
    ("SELF-7a speed unknown", Bus::speed_unknown),
    ("SELF-7a brake released", |bus| bus.inputs.epb = known(EpbState::Released)),
    ("SELF-7a brake unknown", |bus| bus.inputs.epb = unknown(Cause::Stale)),
    ("SELF-7b clock fault", |bus| {
        bus.step_unjudged(51);
    }),
];

/// SELF-7a, SELF-7b: each condition that is lost, for one cycle, at any time, begins the 10 s anew.
#[test]
fn conditions() {
    for Latched { name, fault, make } in ALL {
        for (lost, lose) in LOST {
            for at in [1_000, 9_990] {
                let mut bus = make();
                bus.inputs.key = known(Key::Off);
                rest(&mut bus, at);
                let kept = bus.inputs;
                lose(&mut bus);
                if bus.inputs != kept {
                    cycle(&mut bus);
                }
                bus.inputs = kept;
                rest(&mut bus, 10_000);
                assert!(key(&mut bus, Key::On).contains(fault), "{name}, {lost} after {at}");
                bus.inputs.key = known(Key::Off);
                cycle(&mut bus);
                assert!(!key(&mut bus, Key::On).contains(fault), "{name}, {lost}: then it clears");
            }
            // Between Off and On.
            let mut bus = make();
            rest(&mut bus, 10_010);
            key(&mut bus, Key::Off);
            let kept = bus.inputs;
            lose(&mut bus);
            if bus.inputs != kept {
                cycle(&mut bus);
            }
            bus.inputs = kept;
            assert!(key(&mut bus, Key::On).contains(fault), "{name}, {lost} between Off and On");
        }
    }
}

/// SELF-7a: a condition that never holds keeps it for ever.
#[test]
fn conditions_missing() {
    let steady = LOST.into_iter().take(5);
    for (lost, lose) in steady {
        for Latched { name, fault, make } in ALL {
            let mut bus = make();
            lose(&mut bus);
            assert!(!clears(&mut bus, fault), "{name}, {lost}");
        }
    }
}

/// SELF-7b: a new cause begins the 10 s anew, whichever it is, also between Off and On.
#[test]
fn new_cause() {
    for Latched { name, fault, make } in ALL {
        let mut bus = make();
        rest(&mut bus, 10_010);
        key(&mut bus, Key::Off);
        let mut bus = bus.with_state(|state| State { flow: Flow::START, ..state });
        assert!(key(&mut bus, Key::On).contains(fault.with(Faults::FLOW)), "{name}");
        rest(&mut bus, 9_000);
        key(&mut bus, Key::Off);
        assert!(key(&mut bus, Key::On).contains(fault.with(Faults::FLOW)), "{name}: no 10 s");
        rest(&mut bus, 2_000);
        key(&mut bus, Key::Off);
        assert_eq!(key(&mut bus, Key::On).and(fault.with(Faults::FLOW)), Faults::NONE, "{name}: all together");
    }
}

/// SELF-4e, SELF-7c: a configuration fault stays whatever the driver does; a restart reads it anew.
#[test]
fn configuration() {
    let latched = |state: State| {
        let latches = Latches { faults: Faults::CONFIGURATION, ..state.latches };
        State { latches, ..state }
    };
    let mut bus = Bus::parked().with_state(latched);
    for _ in 0..3 {
        assert!(!clears(&mut bus, Faults::CONFIGURATION));
        assert!(cycle(&mut bus).status.safe_state);
    }
    let mut bus = bus.reset(ResetCause::PowerOn);
    assert!(!cycle(&mut bus).status.safe_state);
    let Ok(sealed) = Sealed::from_default() else { unreachable!("the table is valid") };
    let mut bus = Bus::with_sealed(&sealed.with_flipped_digest(3), ResetCause::PowerOn, Some(Record::None), healthy());
    assert!(!clears(&mut bus, Faults::CONFIGURATION));
    assert!(cycle(&mut bus).status.safe_state);
}

/// SELF-7c, SELF-5f: in the safe state nothing moves, and after clearing it does again.
#[test]
fn safe_state_ends() {
    for Latched { name, fault, make } in SAFE {
        let mut bus = make();
        bus.ask_gear(GearRequest::Drive);
        bus.inputs.selector = known(Gear::Drive);
        let decision = cycle(&mut bus);
        assert_verdict(&decision, Channel::Gear, Kind::Block, Reason::SafeState);
        assert!(clears(&mut bus, fault), "{name}");
        bus.occupied();
        rest(&mut bus, 1_100);
        assert_eq!(cycle(&mut bus).outputs.gear, GearRequest::Drive, "{name}");
    }
}

/// SELF-7a, HV-1d: a contactor latch is not the safe state, but nothing closes until it is cleared.
#[test]
fn contactor_closes_nothing() {
    let mut bus = Bus::asking_to_close();
    bus.inputs.k4 = CLOSED;
    bus.step();
    bus.inputs.k4 = OPEN;
    bus.step();
    for step in [Act::Sit, Act::Off, Act::Start] {
        bus.act(step);
    }
    bus.run_with(5_000, CYCLE, |decision| {
        assert!(!decision.status.safe_state && !closes(decision));
        assert_verdict(decision, Channel::Contactors, Kind::Block, Reason::ContactorFault);
    });
    bus.run_for(10_010);
    bus.act(Act::Off);
    bus.act(Act::Start);
    assert!(closes(&bus.step()), "cleared by the same key cycle that restarts");
}

/// SELF-7a, SEAT-7a: the latch does not keep contactors from opening after leave.
#[test]
fn contactor_still_opens() {
    let mut bus = Bus::opening_k4();
    bus.run_for(3_000);
    let decision = bus.step();
    assert!(decision.status.faults.contains(Faults::CONTACTOR) && opens_k4(&decision));
    bus.loads_stopped();
    bus.inputs.k4 = OPEN;
    assert!(opens_k1(&bus.step()));
}
