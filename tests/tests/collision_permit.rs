//! Collision: second opinion, caps and warnings (MIT-8, PHB-1, FCW-1, PCW-1).

mod common;
use common::*;

// Second opinion.

/// MIT-8b, MIT-8c: severe by the second opinion and no level by T: reported, permits, obliges nothing.
#[test]
fn a_disagreement_is_reported_and_obliges_nothing() {
    // 40 m/s at 200 m: T = 5 s, needed 1600/398 = 4.0 m/s².
    let (mut bus, decision) = Bus::approaching(object(20_000, 4_000));
    assert!(decision.status.faults.contains(Faults::TTC_DISAGREEMENT));
    assert_eq!((decision.status.level, decision.outputs.brake.total), (Level::None, ms2(0)));
    bus.ask_brake(ms2(600));
    assert_passed(&bus.step(), Channel::ServiceBrake);
    // Level 3 by T and next to nothing needed: 1.8 m/s at 4.5 m: T = 2.5 s, 0.46 m/s².
    let (_, decision) = Bus::approaching(object(450, 180));
    assert!(decision.status.faults.contains(Faults::TTC_DISAGREEMENT));
    assert_eq!(decision.status.level, Level::Three, "T obliges");
    let (_, decision) = Bus::approaching(at(2_700));
    assert!(!decision.status.faults.contains(Faults::TTC_DISAGREEMENT), "10 m/s at 27 m: both say severe enough");
}

/// MIT-8b: level 3 by T, and just what level 1 brakes with is needed: no disagreement; a centimetre farther it is less, and one.
#[test]
fn the_least_that_a_level_needs_is_exact() {
    // 2 m/s, 1 m is to be left: 4/(2 · 2.00) = 1.00 m/s² at 3.00 m, T = 1.5 s.
    for (distance, disagrees) in [(300, false), (301, true)] {
        let (_, decision) = Bus::approaching(object(distance, 200));
        assert_eq!(decision.status.level, Level::Three);
        assert_eq!(decision.status.faults.contains(Faults::TTC_DISAGREEMENT), disagrees, "{distance}");
    }
}

/// MIT-8b: where both opinions agree, near or far, severe or not, nothing is reported.
#[test]
fn where_both_opinions_agree_nothing_is_reported() {
    for object in
        [object(20_000, 100), at(10_000), at(5_000), at(4_000), at(3_000), at(2_700), at(1_000), object(5_000, -500)]
    {
        let (_, decision) = Bus::approaching(object);
        assert!(!decision.status.faults.contains(Faults::TTC_DISAGREEMENT), "{object:?}");
    }
}

/// MIT-8d: the more severe of both decides what is permitted: T alone, the second opinion alone, neither.
#[test]
fn the_more_severe_opinion_permits() {
    // 1.8 m/s at 4.5 m: T = 2.5 s, 0.46 m/s² needed; 40 m/s at 200 m: T = 5 s, 4.0 m/s²; 10 m/s at 50 m: 5 s, 1.0 m/s².
    for (object, passes) in [(object(450, 180), true), (object(20_000, 4_000), true), (object(5_000, 1_000), false)] {
        let mut bus = Bus::driving(kmh(9)); // so that nothing is obliged
        bus.ahead(object);
        bus.ask_brake(ms2(600));
        assert_eq!(bus.step().verdicts.of(Channel::ServiceBrake).passed(), passes, "{object:?}");
    }
}

/// MIT-8a: a gap of 0 is most severe for what is permitted, closing or not.
#[test]
fn a_gap_of_zero_permits_everything() {
    for closing in [1, 0, -1] {
        let mut bus = Bus::driving(kmh(9)); // so that nothing is obliged
        bus.ahead(object(0, closing));
        bus.ask_brake(ms2(600));
        assert_passed(&bus.step(), Channel::ServiceBrake);
    }
}

// Caps.

/// PHB-1a: on a known and clear road 3.5 m/s² pass, and not a bit more.
#[test]
fn on_a_clear_road_the_total_is_capped_at_3_5() {
    for speed in [kmh(1), kmh(50)] {
        let mut bus = Bus::driving(speed);
        bus.ask_brake(ms2(350));
        assert_passed(&bus.step(), Channel::ServiceBrake);
        for more in [DecelMs2Q11::new(ms2(350).raw() + 1), ms2(600), DecelMs2Q11::new(u16::MAX)] {
            bus.ask_brake(more);
            let decision = bus.step();
            assert_eq!(decision.outputs.brake.total, ms2(350), "CMD-5e: the nearest value");
            assert_verdict(&decision, Channel::ServiceBrake, Kind::Limit, Reason::PhantomBraking);
        }
    }
}

/// PHB-1a, R-ag: a bus that is known to stand throws nobody: 6 m/s² pass; from 0.3 km/h of the faster speed on, or with
/// one unknown, 3.5 again.
#[test]
fn at_standstill_the_full_cap_is_free() {
    let standstill = Config::DEFAULT.standstill_speed;
    for (low, high, limit) in [
        (kmh(0), kmh(0), 600),
        (kmh(0), bit_below(standstill), 600),
        (kmh(0), standstill, 350),
        (standstill, standstill, 350),
    ] {
        let mut bus = Bus::driving(kmh(50));
        bus.speeds(low, high);
        bus.ask_brake(ms2(1_000));
        let decision = bus.step();
        assert_eq!(decision.outputs.brake.total, ms2(limit), "{low:?} {high:?}");
    }
    for cause in CAUSES {
        let mut bus = Bus::driving(kmh(0));
        bus.inputs.motor_speed = unknown(*cause);
        bus.ask_brake(ms2(600));
        assert_eq!(bus.step().outputs.brake.total, ms2(350), "unknown is no evidence of standstill");
    }
}

/// PHB-1a, RET-1a: service brake and retarder together; the retarder takes what is left.
#[test]
fn the_retarder_counts_in_the_cap() {
    let mut bus = Bus::driving(kmh(50));
    for (brake, retarder, passes) in [
        (195, 100, true),
        (350, 0, true),
        (350, 1, false),
        (250, 66, true),
        (250, 68, false),
        (0, 100, true),
        (201, 100, false),
    ] {
        bus.ask_brake(ms2(brake));
        bus.commands.retarder =
            Command::Fresh(Retarder { torque: percent(retarder), mode: RetarderMode::Torque, priority: Priority::Low });
        let decision = bus.step();
        assert_eq!(decision.verdicts.of(Channel::Retarder).passed(), passes, "{brake} {retarder}");
        assert_passed(&decision, Channel::ServiceBrake);
        // 100 % are 1.5 m/s² (at least).
        let total = u32::from(decision.outputs.brake.total.raw()) * 100
            + u32::from(decision.outputs.retarder.torque.raw()) * 3_072;
        assert!(total <= 716_800, "{brake} {retarder}");
    }
}

/// PHB-1a: the electric part lies inside the total and is no way round the cap.
#[test]
fn the_electric_part_is_no_way_round_the_cap() {
    let mut bus = Bus::driving(kmh(50));
    bus.inputs.electric_limit = known(ms2(600));
    bus.commands.brake = Command::Fresh(ServiceBrake { electric: ms2(600), ..braking(ms2(100)) });
    let brake = bus.step().outputs.brake;
    assert!(brake.electric <= brake.total && brake.total <= ms2(350), "{brake:?}");
}

/// PHB-1b: an object of any single sensor with T ≤ 3.2 s raises the cap to 6 m/s², to the centimetre.
#[test]
fn a_near_object_of_any_sensor_raises_the_cap() {
    for (milliseconds, raised) in [(3_200, true), (3_201, false), (0, true)] {
        // Below 10 km/h, so that nothing is obliged.
        let once = RadarObject { updates: Count::new(1), ..at(milliseconds) };
        let mut by_radar = Bus::driving(kmh(9));
        by_radar.ahead(once);
        let mut by_camera = Bus::driving(kmh(9));
        assert!(by_camera.scene.camera.push(camera_object(milliseconds, TEN)).is_ok());
        for mut bus in [by_radar, by_camera] {
            bus.ask_brake(ms2(600));
            assert_eq!(bus.step().verdicts.of(Channel::ServiceBrake).passed(), raised, "{milliseconds}");
            bus.ask_brake(DecelMs2Q11::new(ms2(600).raw() + 1));
            let decision = bus.step();
            assert_refused(&decision, Channel::ServiceBrake);
            assert_eq!(decision.outputs.brake.total, if raised { ms2(600) } else { ms2(350) });
        }
    }
}

/// PHB-1b, FUS-3d: "any" object: one beside the corridor (a pedestrian about to cross) permits too.
#[test]
fn a_near_object_beside_the_corridor_raises_the_cap() {
    let mut bus = Bus::driving(kmh(50));
    bus.ahead_matched(RadarObject { offset: OffsetCm::new(190), ..at(2_000) }, Class::Pedestrian);
    bus.ask_brake(ms2(600));
    let decision = bus.step();
    assert_eq!(decision.status.level, Level::None);
    assert_passed(&decision, Channel::ServiceBrake);
}

/// PHB-1b, RULE-3b: with perception unknown there is no evidence for the comfort cap.
#[test]
fn unknown_perception_raises_the_cap() {
    for (radar_known, camera_known) in [(false, true), (true, false), (false, false)] {
        let mut bus = Bus::driving(kmh(50));
        bus.scene = Scene { radar_known, camera_known, ..Scene::clear() };
        bus.ask_brake(ms2(600));
        assert_passed(&bus.step(), Channel::ServiceBrake);
    }
    let mut bus = Bus::driving(kmh(50));
    bus.ahead(RadarObject { age: Millis::new(251), ..object(60_000, -10) });
    bus.ask_brake(ms2(600));
    assert_passed(&bus.step(), Channel::ServiceBrake);
}

/// PHB-1b: latch 3 raises the cap, also when its object has vanished.
#[test]
fn latch_3_raises_the_cap() {
    let mut bus = Bus::mitigating(Level::Three);
    bus.road_clear();
    bus.run_for(1_000);
    bus.commands.brake = Command::Fresh(ServiceBrake { priority: Priority::Highest, ..braking(ms2(600)) });
    assert_passed(&bus.step(), Channel::ServiceBrake);
}

/// PHB-1c: the driver's pedal is not capped: what it asks for passes on a clear road.
#[test]
fn the_drivers_pedal_is_not_capped() {
    for per_cent in [20, 50, 60, 80, 100] {
        let mut bus = Bus::driving(kmh(50));
        bus.brake_pedal(travel(per_cent));
        bus.ask_brake(ms2(u16::from(per_cent) * 6));
        assert_passed(&bus.step(), Channel::ServiceBrake);
    }
}

/// PHB-1c: a pedal that is known pressed and not known how far may ask for everything.
#[test]
fn a_pedal_pressed_to_an_unknown_travel_is_not_capped() {
    for tracks in [[unknown(Cause::Stale); 2], [known(travel_bits(251)); 2]] {
        let mut bus = Bus::driving(kmh(50));
        bus.inputs.brake_switch = known(true);
        bus.inputs.brake_pedal = tracks;
        bus.ask_brake(ms2(600));
        assert_passed(&bus.step(), Channel::ServiceBrake);
    }
}

/// PHB-1c: of two tracks that disagree the deeper one counts: braking is the safe direction.
#[test]
fn of_two_brake_tracks_the_deeper_one_counts() {
    for tracks in [[20, 80], [80, 20]] {
        let mut bus = Bus::driving(kmh(50));
        bus.inputs.brake_switch = known(true);
        bus.inputs.brake_pedal = tracks.map(|per_cent| known(travel(per_cent)));
        bus.ask_brake(ms2(480));
        assert_passed(&bus.step(), Channel::ServiceBrake);
    }
}

/// PHB-1d, RULE-3b: no cap lowers an obligation: level 3 on a road that is clear again.
#[test]
fn no_cap_lowers_an_obligation() {
    let mut bus = Bus::mitigating(Level::Three);
    bus.road_clear();
    bus.run_with(3_000, 10, |decision| assert_eq!(decision.outputs.brake.total, ms2(500)));
    bus.accelerator(travel(100));
    bus.brake_pedal(travel(20));
    assert_eq!(bus.step().outputs.brake.total, ms2(500));
}

// Warnings.

/// On, then off: the class, its offset bound in cm, its times in ms, and which output it is.
struct Alarm {
    class: Class,
    other: Class,
    offset: i16,
    on: u16,
    of: fn(&Decision) -> bool,
}

const ALARMS: [Alarm; 2] = [
    Alarm {
        class: Class::Object,
        other: Class::Pedestrian,
        offset: 180,
        on: 4_000,
        of: |decision| decision.outputs.warnings.forward_collision,
    },
    Alarm {
        class: Class::Pedestrian,
        other: Class::Object,
        offset: 200,
        on: 4_200,
        of: |decision| decision.outputs.warnings.pedestrian,
    },
];

/// FCW-1a, PCW-1a: on below its time and its lateral offset, each to the last unit, in the corridor or not.
#[test]
fn a_warning_goes_on_below_its_time_and_offset() {
    for Alarm { class, other, offset, on, of } in ALARMS {
        for (time, lateral, expected) in [
            (on - 1, 0, true),
            (on, 0, false),
            (on - 1, offset - 1, true),
            (on - 1, 1 - offset, true),
            (on - 1, offset, false),
            (on - 1, -offset, false),
            (on - 1, i16::MIN, false),
            (0, 0, true),
        ] {
            let object = RadarObject { offset: OffsetCm::new(lateral), ..at(time) };
            assert_eq!(of(&Bus::approaching_matched(object, class).1), expected, "{class:?} {time} {lateral}");
            assert!(!of(&Bus::approaching_matched(object, other).1), "the other class");
        }
        let (_, decision) = Bus::approaching_matched(object(100, 0), class);
        assert!(!of(&decision), "not closing");
    }
}

/// FCW-1a, PCW-1a: warnings have no least speed (MIT-6 speaks of mitigation).
#[test]
fn a_warning_needs_no_speed() {
    for Alarm { class, on, of, .. } in ALARMS {
        for speed in [kmh(0), kmh(9)] {
            let mut bus = Bus::driving(speed);
            bus.ahead_matched(at(on - 1), class);
            assert!(of(&bus.step()), "{class:?}");
        }
    }
}

/// FCW-1b, PCW-1b: off beyond 4.5 s, or when nothing is there; at 4.5 s and with lost perception it stays.
#[test]
fn a_warning_goes_off_beyond_4_5_s() {
    for Alarm { class, on, of, .. } in ALARMS {
        let begun = || {
            let (bus, decision) = Bus::approaching_matched(at(on - 1), class);
            assert!(of(&decision));
            bus
        };
        for (time, stays) in [(on, true), (4_499, true), (4_500, true), (4_501, false), (20_000, false)] {
            let mut bus = begun();
            bus.ahead_matched(at(time), class);
            assert_eq!(of(&bus.step()), stays, "{class:?} {time}");
        }
        let mut bus = begun();
        bus.road_clear();
        assert!(!of(&bus.step()), "no obstacle");
        let losses: [Edit; 2] = [
            |bus| bus.scene = Scene { radar_known: false, ..Scene::clear() },
            |bus| bus.scene = Scene { camera_known: false, ..Scene::clear() },
        ];
        for lose in losses {
            let mut bus = begun();
            lose(&mut bus);
            assert!(of(&bus.run_for(5_000)), "RULE-1d: unknown ends nothing");
        }
    }
}

/// PCW-1b, R-r: another object of another class does not end a warning.
#[test]
fn an_object_beside_does_not_end_a_warning() {
    for Alarm { class, other, on, of, .. } in ALARMS {
        let (mut bus, _) = Bus::approaching_matched(at(on - 1), class);
        bus.add_matched(RadarObject { offset: OffsetCm::new(-100), ..object(1_000, -10) }, other);
        assert!(of(&bus.run_for(1_000)));
    }
}

/// FCW-1c, PCW-1c: the main controller may warn earlier.
#[test]
fn the_main_controller_may_warn_earlier() {
    let mut bus = Bus::driving(kmh(50));
    bus.commands.warnings = Command::Fresh(Warnings { forward_collision: true, pedestrian: true, ..Warnings::NEUTRAL });
    assert_passed(&bus.step(), Channel::Warnings);
}

/// FCW-1a, PCW-1a, SELF-2a: an obliged warning goes out whatever is asked for.
#[test]
fn an_obliged_warning_goes_out_whatever_is_asked_for() {
    for Alarm { class, on, of, .. } in ALARMS {
        for command in [Command::Fresh(Warnings::NEUTRAL), Command::Absent, Command::Rejected(Rejection::Field)] {
            let mut bus = Bus::driving(kmh(50));
            bus.commands.warnings = command;
            bus.ahead_matched(at(on - 1), class);
            assert!(of(&bus.step()), "{command:?}");
        }
    }
}
