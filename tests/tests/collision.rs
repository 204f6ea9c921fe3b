//! Collision mitigation: time to collision, and what sets a level (TTC, MIT-1 to MIT-3, MIT-6, RXN, parts of FUS-3).
//!
//! With a closing speed of 10 m/s a distance in cm is a time to collision in ms: `at`.

mod common;
use common::*;

fn level_of(object: RadarObject) -> Level {
    let mut scene = Scene::clear();
    assert!(scene.radar.push(object).is_ok());
    perceive(&scene, &Config::DEFAULT).level
}

// Time to collision.

/// The level by TTC-1, MIT-1 to MIT-3 and reading b, in wide integers: T < 4.4, T ≤ 3.6, T ≤ 2.7 s.
fn expected_level(distance: u16, closing: i16) -> Level {
    let (distance, closing) = (i128::from(distance) * 1_000, i128::from(closing));
    if closing <= 0 {
        Level::None
    } else if distance <= 2_700 * closing {
        Level::Three
    } else if distance <= 3_600 * closing {
        Level::Two
    } else if distance < 4_400 * closing {
        Level::One
    } else {
        Level::None
    }
}

/// TTC-1a, TTC-1c, MIT-1a, MIT-2a, MIT-3a: every closing speed, each side of each threshold, to the centimetre.
#[test]
fn every_threshold_is_exact_at_every_closing_speed() {
    for closing in 1..=i16::MAX {
        for threshold in [2_700, 3_600, 4_400] {
            let exact = i64::from(closing) * threshold / 1_000;
            for distance in (exact - 1)..=(exact + 1) {
                let Ok(distance) = u16::try_from(distance) else { continue };
                assert_eq!(
                    level_of(object(distance, closing)),
                    expected_level(distance, closing),
                    "{distance} {closing}"
                );
            }
        }
    }
}

/// TTC-1a, TTC-1c: the extremes of both ranges.
#[test]
fn the_extremes_of_distance_and_closing_speed_are_judged_exactly() {
    let distances = [0, 1, 2, 99, 100, 101, 32_767, 32_768, 65_534, u16::MAX];
    let speeds = [i16::MIN, -32_767, -1, 0, 1, 2, 148, 149, 150, 182, 243, 14_894, 14_895, 32_766, i16::MAX];
    for distance in distances {
        for closing in speeds {
            assert_eq!(level_of(object(distance, closing)), expected_level(distance, closing), "{distance} {closing}");
        }
    }
}

/// TTC-1b: what does not close has no time to collision, at no distance.
#[test]
fn what_does_not_close_enters_no_level() {
    for closing in [0, -1, -1_000, i16::MIN] {
        for distance in [0, 1, 100, 5_000] {
            let (_, decision) = Bus::approaching(object(distance, closing));
            assert_eq!(decision.status.level, Level::None);
            assert_eq!(decision.outputs.brake.total, ms2(0));
        }
    }
}

// Entering.

/// MIT-1a, MIT-2a, MIT-3a, R-b: exactly 3.6 and 2.7 s go to the more severe level, exactly 4.4 s obliges nothing.
#[test]
fn the_levels_enter_at_their_times() {
    for (milliseconds, level) in [
        (4_401, Level::None),
        (4_400, Level::None),
        (4_399, Level::One),
        (3_601, Level::One),
        (3_600, Level::Two),
        (2_701, Level::Two),
        (2_700, Level::Three),
        (1, Level::Three),
        (0, Level::Three),
    ] {
        let (_, decision) = Bus::approaching(at(milliseconds));
        assert_eq!(decision.status.level, level, "{milliseconds} ms");
    }
}

/// MIT-1b, MIT-2b, MIT-3b, RXN-1a: the demand leaves in the cycle in which the object enters.
#[test]
fn the_demand_leaves_in_the_cycle_in_which_the_object_enters() {
    for (object, hundredths) in [(at(4_399), 100), (at(3_600), 250), (at(2_700), 500)] {
        let (_, decision) = Bus::approaching(object);
        assert_eq!(decision.outputs.brake.total, ms2(hundredths));
        assert_verdict(&decision, Channel::ServiceBrake, Kind::Substitute, Reason::Mitigation);
        assert!(decision.outputs.body.brake_lamps);
    }
}

/// MIT-1a, MIT-2a, MIT-3a: each level enters below its steering angle, both ways, to a tenth of a degree.
#[test]
fn the_levels_enter_below_their_steering_angles() {
    for (milliseconds, deci_deg, level) in [
        (4_000, 599, Level::One),
        (4_000, 600, Level::None),
        (3_000, 600, Level::Two),
        (3_000, 699, Level::Two),
        (3_000, 700, Level::None),
        (2_000, 700, Level::Three),
        (2_000, 799, Level::Three),
        (2_000, 800, Level::None),
        (2_000, 7_200, Level::None),
    ] {
        for sign in [1, -1] {
            let mut bus = Bus::driving(kmh(50));
            bus.inputs.steering_angle = known(angle(deci_deg * sign));
            bus.ahead(at(milliseconds));
            assert_eq!(bus.step().status.level, level, "{milliseconds} ms {deci_deg} {sign}");
        }
    }
}

/// MIT-7d: with the steering angle unknown, or impossible, nothing is newly set.
#[test]
fn with_the_steering_angle_unknown_nothing_enters() {
    let mut angles: Vec<_> = CAUSES.iter().map(|cause| unknown(*cause)).collect();
    angles.extend([known(angle(7_201)), known(angle(-7_201)), known(angle(i16::MAX)), known(angle(i16::MIN))]);
    for unknown_angle in angles {
        let mut bus = Bus::driving(kmh(50));
        bus.inputs.steering_angle = unknown_angle;
        bus.ahead(at(1_000));
        assert_eq!(bus.run_for(1_000).status.level, Level::None, "{unknown_angle:?}");
        bus.inputs.steering_angle = known(angle(0));
        assert_eq!(bus.step().status.level, Level::Three);
    }
}

/// FUS-3c, FUS-3e: in the corridor (half-width 1.8 m), and matched or seen three times.
#[test]
fn only_a_valid_obstacle_obliges() {
    for (class, updates, obliges) in [
        (None, 0, false),
        (None, 1, false),
        (None, 2, false),
        (None, 3, true),
        (None, 255, true),
        (Some(Class::Unclassified), 0, true),
        (Some(Class::Object), 0, true),
        (Some(Class::Pedestrian), 1, true),
    ] {
        for (offset, inside) in
            [(0, true), (180, true), (-180, true), (181, false), (-181, false), (i16::MIN, false), (i16::MAX, false)]
        {
            let object = RadarObject { updates: Count::new(updates), offset: OffsetCm::new(offset), ..at(2_000) };
            let level = if obliges && inside { Level::Three } else { Level::None };
            let (_, decision) = match class {
                Some(class) => Bus::approaching_matched(object, class),
                None => Bus::approaching(object),
            };
            assert_eq!(decision.status.level, level, "{class:?} {updates} {offset}");
        }
    }
}

/// FUS-3c: a camera object alone obliges nothing, however near.
#[test]
fn a_camera_object_alone_obliges_nothing() {
    let mut bus = Bus::driving(kmh(50));
    assert!(bus.scene.camera.push(camera_object(100, 2_000)).is_ok());
    let decision = bus.run_for(1_000);
    assert_eq!((decision.status.level, decision.outputs.brake.total), (Level::None, ms2(0)));
}

/// RULE-1a, RULE-1b: an object older than 250 ms obliges nothing, and perception is not known.
#[test]
fn an_old_object_obliges_nothing() {
    for (age, level) in [(0, Level::Three), (250, Level::Three), (251, Level::None), (u32::MAX, Level::None)] {
        let (_, decision) = Bus::approaching(RadarObject { age: Millis::new(age), ..at(2_000) });
        assert_eq!(decision.status.level, level, "{age}");
        assert_eq!(decision.status.faults.contains(Faults::PERCEPTION_UNKNOWN), level == Level::None, "{age}");
    }
}

/// RULE-1b, RULE-1c: the objects of a radar that is lost oblige nothing.
#[test]
fn the_objects_of_a_lost_radar_oblige_nothing() {
    let mut bus = Bus::driving(kmh(50));
    bus.ahead(at(2_000));
    bus.scene.radar_known = false;
    assert_eq!(bus.run_for(1_000).status.level, Level::None);
}

/// MIT-6a: the most severe object decides, wherever it stands in the list and however far it is.
#[test]
fn the_most_severe_object_decides_and_not_the_nearest() {
    let near_and_slow = object(1_500, 100); // 15 s
    let far_and_fast = object(6_000, 2_000); // 3 s
    let middle = object(4_000, TEN); // 4 s
    for list in [
        vec![near_and_slow, far_and_fast],
        vec![far_and_fast, near_and_slow],
        vec![near_and_slow, middle, far_and_fast],
        vec![far_and_fast, middle, near_and_slow],
    ] {
        let mut bus = Bus::driving(kmh(50));
        for object in &list {
            assert!(bus.scene.radar.push(*object).is_ok());
        }
        let decision = bus.step();
        assert_eq!((decision.status.level, decision.outputs.brake.total), (Level::Two, ms2(250)));
    }
}

/// MIT-6a, SELF-1a: a full list, the severe object last.
#[test]
fn a_full_list_is_judged_to_its_end() {
    let mut bus = Bus::driving(kmh(50));
    for _ in 1..MAX_RADAR {
        assert!(bus.scene.radar.push(object(60_000, 10)).is_ok());
    }
    assert!(bus.scene.radar.push(at(2_000)).is_ok());
    for _ in 0..MAX_CAMERA {
        assert!(bus.scene.camera.push(camera_object(60_000, 10)).is_ok());
    }
    assert_eq!(bus.step().status.level, Level::Three);
}

/// MIT-6b: below 10 km/h nothing enters, by the lower speed; a begun level goes on.
#[test]
fn below_10_kmh_nothing_enters() {
    for (low, high, level) in [
        (kmh(10), kmh(10), Level::Three),
        (bit_below(kmh(10)), bit_below(kmh(10)), Level::None),
        (bit_below(kmh(10)), kmh(11), Level::None),
        (kmh(0), kmh(0), Level::None),
    ] {
        let mut bus = Bus::driving(kmh(50));
        bus.speeds(low, high);
        bus.ahead(at(2_000));
        assert_eq!(bus.run_for(500).status.level, level, "{low:?} {high:?}");
    }
    for level in LEVELS {
        let mut bus = Bus::mitigating(level);
        bus.speed(kmh(1));
        assert_eq!(bus.run_for(5_000).status.level, level);
    }
}

/// MIT-6c: while the bus brakes enough nothing enters: v²/(2·(gap − 1 m)), to the least bit.
#[test]
fn while_the_bus_brakes_enough_nothing_enters() {
    // 10 m/s, 35 m: 100/(2·34) = 1.4706 m/s² = 3011.8 bits.
    for (measured, level) in [(0, Level::Two), (3_011, Level::Two), (3_012, Level::None), (12_288, Level::None)] {
        let mut bus = Bus::driving(kmh(50));
        bus.inputs.deceleration = known(DecelMs2Q11::new(measured));
        bus.ahead(at(3_500));
        assert_eq!(bus.run_for(100).status.level, level, "{measured}");
    }
    for cause in CAUSES {
        let mut bus = Bus::driving(kmh(50));
        bus.inputs.deceleration = unknown(*cause);
        bus.ahead(at(3_500));
        assert_eq!(bus.step().status.level, Level::Two, "unknown is no evidence for braking");
    }
}

/// MIT-6e, R-ah: where less than the least deceleration is required nothing enters, to the least bit; with the gap used up
/// everything does. The default holds nothing back.
#[test]
fn where_little_is_required_nothing_enters() {
    // 10 m/s, 35 m: 3012 bits, as above.
    for (least, distance, level) in [
        (0, 3_500, Level::Two),
        (3_012, 3_500, Level::Two),
        (3_013, 3_500, Level::None),
        (5_120, 3_500, Level::None),
        (5_120, 100, Level::Three),
    ] {
        let config = Config { level_least_required: DecelMs2Q11::new(least), ..Config::DEFAULT };
        let mut bus = Bus::driving_with(&config, kmh(50));
        bus.ahead(at(distance));
        assert_eq!(bus.step().status.level, level, "{least} {distance}");
    }
    assert_eq!(Config::DEFAULT.level_least_required, DecelMs2Q11::ZERO);
}

/// MIT-6c: with the gap used up (gap ≤ margin) no deceleration is enough.
#[test]
fn with_the_gap_used_up_no_deceleration_is_enough() {
    for distance in [0, 1, 99, 100] {
        for measured in [0, 12_288, 20_480, u16::MAX] {
            let mut bus = Bus::driving(kmh(50));
            bus.inputs.deceleration = known(DecelMs2Q11::new(measured));
            bus.ahead(object(distance, 100));
            assert_eq!(bus.step().status.level, Level::Three, "{distance} {measured}");
        }
    }
}

/// MIT-6c, RULE-1a: a measured deceleration that no bus reaches is no evidence.
#[test]
fn an_impossible_deceleration_is_no_evidence() {
    let mut bus = Bus::driving(kmh(50));
    bus.inputs.deceleration = known(DecelMs2Q11::new(u16::MAX));
    bus.ahead(at(2_000));
    assert_eq!(bus.step().status.level, Level::Three, "32 m/s²");
}

/// MIT-6c, RULE-1a: the greatest plausible deceleration still counts, to the bit.
#[test]
fn the_greatest_plausible_deceleration_counts() {
    let greatest = Config::DEFAULT.decel_plausible.raw();
    for (measured, level) in [(greatest, Level::None), (greatest + 1, Level::Three)] {
        let mut bus = Bus::driving(kmh(50));
        bus.inputs.deceleration = known(DecelMs2Q11::new(measured));
        bus.ahead(at(2_000));
        assert_eq!(bus.step().status.level, level, "{measured}");
    }
}

/// RULE-1b: two sensors that deliver and see nothing give a clear road; without them nothing is known.
#[test]
fn an_empty_road_is_clear_and_a_lost_one_unknown() {
    let threat = |scene: &Scene| perceive(scene, &Config::DEFAULT);
    assert_eq!(threat(&Scene::clear()), Threat::CLEAR);
    assert_eq!(threat(&Scene::default()), Threat::UNKNOWN);
}

/// FCW-1a, PCW-1a, RULE-1b: at boot, with perception not known yet, no warning is on.
#[test]
fn no_warning_is_on_before_anything_is_seen() {
    for scene in [Scene::default(), Scene::clear()] {
        let mut bus = Bus::boot(ResetCause::PowerOn, Some(Record::None), healthy());
        bus.scene = scene;
        bus.run_with(1_000, 10, |decision| {
            let Warnings { forward_collision, pedestrian, .. } = decision.outputs.warnings;
            assert!(!forward_collision && !pedestrian);
            assert_eq!(decision.status.level, Level::None);
        });
    }
}

/// MIT-6c, MIT-4c: braking enough does not end a begun level.
#[test]
fn braking_enough_does_not_end_a_begun_level() {
    for level in LEVELS {
        let mut bus = Bus::mitigating(level);
        bus.inputs.deceleration = known(ms2(600));
        assert_eq!(bus.run_for(10_000).status.level, level);
    }
}

/// MIT-6d: what is not obliged below 10 km/h, or while braking enough, stays permitted.
#[test]
fn what_is_not_obliged_stays_permitted() {
    for (speed, measured) in [(kmh(9), 0), (kmh(50), 600)] {
        let mut bus = Bus::driving(speed);
        bus.inputs.deceleration = known(ms2(measured));
        bus.ahead(at(2_000));
        bus.ask_brake(ms2(600));
        let decision = bus.step();
        assert_eq!(decision.status.level, Level::None);
        assert_passed(&decision, Channel::ServiceBrake);
    }
}
