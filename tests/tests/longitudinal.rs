//! Who controls speed, and how a brake demand is split: VLC-1, VLC-2, VLC-3.

mod common;
use common::*;

/// A bus in the automated mode at this speed.
type Automated = fn(SpeedKmhQ8) -> Bus;
/// ADAS-VLC and EPBi-VLC, with the sender that each is configured for.
const MODES: [(Automated, Origin); 2] = [(Bus::automated, Origin::Adas), (Bus::automated_by_epbi, Origin::Epbi)];

fn drive(bus: &mut Bus, origin: Origin, torque: u8) {
    bus.commands.drive = Command::Fresh(DriveTorque { torque: percent(torque), active: true, origin });
}

fn brake(bus: &mut Bus, total: DecelMs2Q11, electric: DecelMs2Q11) {
    bus.commands.brake = Command::Fresh(ServiceBrake { electric, ..braking(total) });
}

/// VLC-1a, VLC-1c: in each mode the configured sender gets its torque, up to our bound, and the brake its deceleration.
#[test]
fn the_configured_sender() {
    for (make, origin) in MODES {
        let mut bus = make(kmh(30));
        drive(&mut bus, origin, 30);
        let decision = bus.run_for(500);
        assert_eq!((decision.outputs.drive.torque, decision.outputs.drive.origin), (percent(30), origin));
        assert_passed(&decision, Channel::DriveTorque);
        drive(&mut bus, origin, 61);
        let decision = bus.run_for(500);
        assert_eq!(decision.outputs.drive.torque, percent(60), "{origin:?}: vetted");
        drive(&mut bus, origin, 0);
        bus.ask_brake(ms2(200));
        let decision = bus.step();
        assert_eq!(decision.outputs.brake.total, ms2(200), "{origin:?}");
        bus.ask_brake(ms2(400));
        assert_eq!(bus.step().outputs.brake.total, ms2(350), "{origin:?}: vetted");
    }
}

/// VLC-1d: the sender of the mode that is not configured gets no torque, whatever it asks for; in no state.
#[test]
fn the_other_sender() {
    for (make, configured) in MODES {
        let origin = if configured == Origin::Adas { Origin::Epbi } else { Origin::Adas };
        for torque in [1, 6, 7, 30, 60, 100] {
            let mut bus = make(kmh(30));
            drive(&mut bus, origin, torque);
            bus.run_with(1_000, CYCLE, |decision| {
                assert_eq!(decision.outputs.drive, DriveTorque::NEUTRAL, "{origin:?} {torque}");
            });
            assert_verdict(&bus.step(), Channel::DriveTorque, Kind::Block, Reason::NotConfigured);
        }
        // Behind the pedal of a driver who overrides, either.
        let mut bus = make(kmh(30));
        bus.accelerator(travel(60));
        drive(&mut bus, origin, 30);
        bus.run_with(1_000, CYCLE, |decision| assert_eq!(decision.outputs.drive.torque, Percent::ZERO));
    }
}

/// VLC-1a, VLC-1c: the driver's torque does not depend on the mode that is configured.
#[test]
fn the_driver() {
    for mode in [0, 1] {
        let config = Config { longitudinal_mode: Count::new(mode), ..Config::DEFAULT };
        let mut bus = Bus::driving_with(&config, kmh(30));
        bus.accelerator(travel(40));
        bus.ask_torque(40);
        assert_eq!(bus.run_for(500).outputs.drive.torque, percent(40), "{mode}");
    }
}

/// VLC-1e: of the controller's request and the obligation the greater one goes out, in both modes.
#[test]
fn the_strongest_brake() {
    for (make, _) in MODES {
        for (asked, expected) in [(0, 250), (249, 250), (250, 250), (251, 251), (600, 600)] {
            let mut bus = make(kmh(50));
            // Below 3.2 s, where nothing but the greatest brake caps the request (PHB-1b).
            bus.ahead(at(3_100));
            bus.ask_brake(ms2(asked));
            let decision = bus.step();
            assert_eq!(decision.status.level, Level::Two);
            assert_eq!(decision.outputs.brake.total, ms2(expected), "{asked}");
        }
    }
}

/// Level 2, nothing asked for by the controller: 2.5 m/s² of our own.
fn own_demand(limit: DecelMs2Q11) -> Bus {
    let mut bus = Bus::driving(kmh(50));
    bus.inputs.electric_limit = known(limit);
    bus.ahead(at(3_600));
    bus
}

/// VLC-1b, VLC-2a: what we ask for ourselves is electric up to the limit; friction fills the rest.
#[test]
fn electric_first() {
    for (limit, electric) in [(0, 0), (1, 1), (200, 200), (249, 249), (250, 250), (251, 250), (600, 250)] {
        let decision = own_demand(ms2(limit)).step();
        assert_eq!(decision.outputs.brake.total, ms2(250), "{limit}");
        assert_eq!(decision.outputs.brake.electric, ms2(electric), "{limit}");
    }
    let mut bus = Bus::leave(kmh(50));
    bus.inputs.electric_limit = known(ms2(100));
    let decision = bus.step();
    assert_eq!((decision.outputs.brake.total, decision.outputs.brake.electric), (ms2(195), ms2(100)), "leave");
}

/// VLC-2c: one bit below, at and above the limit; the total stays.
#[test]
fn electric_limit() {
    let limit = ms2(150);
    for (bits, kept) in [(-1, true), (0, true), (1, false)] {
        let electric = DecelMs2Q11::new(limit.raw().saturating_add_signed(bits));
        let mut bus = Bus::driving(kmh(50));
        bus.inputs.electric_limit = known(limit);
        brake(&mut bus, ms2(300), electric);
        let decision = bus.step();
        assert_eq!(decision.outputs.brake.electric, electric.min(limit));
        assert_eq!(decision.outputs.brake.total, ms2(300), "VLC-2e: friction fills up");
        if kept {
            assert_passed(&decision, Channel::ServiceBrake);
        } else {
            assert_verdict(&decision, Channel::ServiceBrake, Kind::Limit, Reason::ElectricLimit);
        }
    }
}

/// No electric part: slip control at work or unknown, or a value of the split unknown.
const NO_ELECTRIC: [Change; 12] = [
    ("VLC-2b ABS", |bus| bus.inputs.abs = known(true)),
    ("VLC-2b ASR", |bus| bus.inputs.asr = known(true)),
    ("VLC-2b stability", |bus| bus.inputs.stability = known(true)),
    ("VLC-2b ABS unknown", |bus| bus.inputs.abs = unknown(Cause::Stale)),
    ("VLC-2b ASR unknown", |bus| bus.inputs.asr = unknown(Cause::Stale)),
    ("VLC-2b stability unknown", |bus| bus.inputs.stability = unknown(Cause::Stale)),
    ("VLC-2d limit unknown", |bus| bus.inputs.electric_limit = unknown(Cause::Stale)),
    ("VLC-3a mass unknown", |bus| bus.inputs.mass = unknown(Cause::Stale)),
    ("VLC-3a electric part unknown", |bus| bus.inputs.electric_actual = unknown(Cause::Stale)),
    ("VLC-3a front unknown", |bus| bus.inputs.axle_pressure[0] = unknown(Cause::Stale)),
    ("VLC-3a rear unknown", |bus| bus.inputs.axle_pressure[1] = unknown(Cause::Stale)),
    ("VLC-2c limit 0", |bus| bus.inputs.electric_limit = known(ms2(0))),
];

/// VLC-2b, VLC-2d, VLC-2e, VLC-3a: no electric part, the same total, whoever asks; unknown is no fault of the values.
#[test]
fn no_electric_part() {
    for (name, change) in NO_ELECTRIC {
        let mut bus = Bus::driving(kmh(50));
        change(&mut bus);
        brake(&mut bus, ms2(300), ms2(100));
        let decision = bus.step();
        assert_eq!(decision.outputs.brake.electric, ms2(0), "{name}");
        assert_eq!(decision.outputs.brake.total, ms2(300), "{name}");
        assert!(!decision.status.faults.contains(Faults::SPLIT_IMPLAUSIBLE), "{name}");
        let mut bus = own_demand(ms2(200));
        change(&mut bus);
        let decision = bus.step();
        assert_eq!((decision.outputs.brake.total, decision.outputs.brake.electric), (ms2(250), ms2(0)), "{name}");
    }
}

/// VLC-3a: each value around its bounds; an implausible one is reported, and there is no electric part.
#[test]
fn implausible_values() {
    type Set = fn(&mut Bus, u16);
    let mass: Set = |bus, raw| bus.inputs.mass = known(Mass10Kg::new(raw));
    let front: Set = |bus, raw| bus.inputs.axle_pressure[0] = known(Pressure5KPa::new(u8::try_from(raw).unwrap_or(0)));
    let rear: Set = |bus, raw| bus.inputs.axle_pressure[1] = known(Pressure5KPa::new(u8::try_from(raw).unwrap_or(0)));
    let actual: Set = |bus, raw| bus.inputs.electric_actual = known(DecelMs2Q11::new(raw));
    let rows: [(&str, Set, &[u16], &[u16]); 4] = [
        ("mass, 6 to 20 t", mass, &[600, 601, 1_999, 2_000], &[0, 599, 2_001, u16::MAX]),
        ("front axle, 1100 kPa", front, &[0, 1, 219, 220], &[221, 255]),
        ("rear axle, 1100 kPa", rear, &[0, 1, 219, 220], &[221, 255]),
        // The limit is 2 m/s² (4096); it may be exceeded by 0.5 (1024).
        ("electric part", actual, &[0, 4_096, 5_120], &[5_121, u16::MAX]),
    ];
    for (name, set, plausible, implausible) in rows {
        for (values, good) in [(plausible, true), (implausible, false)] {
            for value in values {
                let mut bus = Bus::driving(kmh(50));
                set(&mut bus, *value);
                brake(&mut bus, ms2(300), ms2(100));
                let decision = bus.step();
                assert_eq!(decision.outputs.brake.electric, ms2(if good { 100 } else { 0 }), "{name} {value}");
                assert_eq!(decision.outputs.brake.total, ms2(300), "{name} {value}");
                let reported = decision.status.faults.contains(Faults::SPLIT_IMPLAUSIBLE);
                assert_eq!(reported, !good, "{name} {value}");
                assert_eq!(decision.outputs.warnings.fault_lamp, !good, "{name} {value}");
            }
        }
    }
    // One bad value is enough beside an unknown one; an actual part can not be judged without its limit.
    let mut bus = Bus::driving(kmh(50));
    bus.inputs.mass = known(Mass10Kg::new(0));
    bus.inputs.axle_pressure = [unknown(Cause::Stale); 2];
    assert!(bus.step().status.faults.contains(Faults::SPLIT_IMPLAUSIBLE));
    let mut bus = Bus::driving(kmh(50));
    bus.inputs.electric_actual = known(ms2(600));
    bus.inputs.electric_limit = unknown(Cause::Stale);
    assert!(!bus.step().status.faults.contains(Faults::SPLIT_IMPLAUSIBLE));
}

/// VLC-2g: while the electric limit fades to nothing and back, the total stays, in every cycle, whoever asks.
#[test]
fn no_dip() {
    for own in [false, true] {
        let mut bus = own_demand(ms2(200));
        if !own {
            bus.road_clear();
            brake(&mut bus, ms2(250), ms2(200));
        }
        let mut before = 4_096;
        for limit in (0..=4_096).rev().step_by(41).chain((0..=4_096).step_by(37)) {
            bus.inputs.electric_limit = known(DecelMs2Q11::new(limit));
            bus.inputs.electric_actual = known(DecelMs2Q11::new(before));
            let decision = bus.step();
            assert_eq!(decision.outputs.brake.total, ms2(250), "{limit}");
            assert_eq!(decision.outputs.brake.electric.raw(), limit, "{limit}");
            before = limit;
        }
        // At once, and with ABS.
        let losses: [Edit; 3] = [
            |bus| bus.inputs.electric_limit = known(ms2(0)),
            |bus| bus.inputs.electric_limit = unknown(Cause::Stale),
            |bus| bus.inputs.abs = known(true),
        ];
        for lose in losses {
            let mut bus = bus.clone();
            bus.inputs.electric_actual = known(ms2(0));
            lose(&mut bus);
            let decision = bus.step();
            assert_eq!((decision.outputs.brake.total, decision.outputs.brake.electric), (ms2(250), ms2(0)));
        }
    }
}

/// VLC-2e: no limit of a part reduces the total, neither friction's nor both.
#[test]
fn limits_never_reduce_the_total() {
    for friction in [known(ms2(0)), known(ms2(100)), unknown(Cause::Stale)] {
        for electric in [known(ms2(0)), known(ms2(50)), unknown(Cause::Stale)] {
            let mut bus = own_demand(ms2(0));
            bus.inputs.friction_limit = friction;
            bus.inputs.electric_limit = electric;
            bus.run_with(3_000, CYCLE, |decision| assert!(decision.outputs.brake.total >= ms2(250)));
        }
    }
}

/// VLC-2e: a total that the cap lowers takes its electric part with it.
#[test]
fn the_cap_and_the_electric_part() {
    let mut bus = Bus::driving(kmh(50));
    bus.inputs.electric_limit = known(ms2(600));
    brake(&mut bus, ms2(500), ms2(400));
    let decision = bus.step();
    assert_eq!((decision.outputs.brake.total, decision.outputs.brake.electric), (ms2(350), ms2(350)));
}
