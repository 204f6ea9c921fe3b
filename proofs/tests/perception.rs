//! The properties of perception on random objects, many of them just at a threshold (TTC, MIT, FUS, FCW, PCW).

use proptest::option;
use proptest::prelude::{Just, ProptestConfig, Strategy, any, prop_oneof, proptest};
use proptest::sample::select;
use supervisor_core::{ClosingCmS, Config, Count, DistanceCm, Level, Millis, Object, OffsetCm};
use supervisor_perceive::{
    Assessment, CameraObject, Class, PixelBox, RadarObject, Scene, Worst, camera_object, merge, perceive, radar_object,
};
use supervisor_proofs::properties::object::{
    ALL, Sight, fcw_1_threat_says_what_was_merged, fus_1a_moved_is_exact, fus_3d_camera_only_permits,
    mit_6a_most_severe_decides, mit_6a_order_does_not_matter, mit_8d_more_severe_decides, ttc_1_level_is_monotone,
    ttc_1_products_are_exact,
};

const CASES: u32 = 40_000;

/// Every threshold of time, in ms.
fn limits() -> Vec<u32> {
    let config = Config::DEFAULT;
    let rows = [config.level_ttc.0.as_slice(), &config.forward_ttc.0, &config.pedestrian_ttc.0].concat();
    rows.into_iter().chain([config.emergency_ttc, config.mitigable_ttc]).map(Millis::raw).collect()
}

/// Distance and closing speed: any, or just at a threshold of time, or just at one of deceleration.
fn approach() -> impl Strategy<Value = (u16, i16)> {
    let at_time = (select(limits()), 0..2_000_i16, -1..=1_i64).prop_map(|(limit, closing, off)| {
        let distance = i64::from(limit) * i64::from(closing) / 1000 + off;
        (u16::try_from(distance.max(0)).unwrap_or(u16::MAX), closing)
    });
    let at_severe = (1..4_000_i16, -2..=2_i64).prop_map(|(closing, off)| {
        let config = Config::DEFAULT;
        let square = i64::from(closing) * i64::from(closing) * 256;
        let gap = square / (25 * i64::from(config.severe_decel.raw()));
        let distance = gap + i64::from(config.gap_margin.raw()) + off;
        (u16::try_from(distance.max(0)).unwrap_or(u16::MAX), closing)
    });
    prop_oneof![(any::<u16>(), any::<i16>()), (0..300_u16, -50..400_i16), at_time, at_severe]
}

/// At or beside a bound of the lateral offset, on either side.
fn offset() -> impl Strategy<Value = i16> {
    let bound = (select(vec![160_i16, 180, 200]), -1..=1_i16, any::<bool>());
    prop_oneof![any::<i16>(), -250..250_i16, bound.prop_map(|(at, off, left)| if left { at + off } else { -at - off })]
}

fn age() -> impl Strategy<Value = u32> {
    prop_oneof![Just(0), 0..300_u32, Just(250), Just(251), Just(u32::MAX), any::<u32>()]
}

fn radar() -> impl Strategy<Value = RadarObject> {
    (approach(), offset(), age(), 0..6_u8).prop_map(|((distance, closing), offset, age, updates)| RadarObject {
        distance: DistanceCm::new(distance),
        offset: OffsetCm::new(offset),
        closing: ClosingCmS::new(closing),
        age: Millis::new(age),
        updates: Count::new(updates),
    })
}

fn class() -> impl Strategy<Value = Option<Class>> {
    option::of(select(Class::ALL))
}

fn camera() -> impl Strategy<Value = CameraObject> {
    (approach(), age(), select(Class::ALL), any::<[u16; 4]>()).prop_map(
        |((distance, closing), age, class, [left, top, width, height])| CameraObject {
            pixels: PixelBox { left, top, width, height },
            class,
            distance: DistanceCm::new(distance),
            closing: ClosingCmS::new(closing),
            age: Millis::new(age),
        },
    )
}

/// What one object, or several merged, may say.
fn assessment() -> impl Strategy<Value = Assessment> {
    let several = (radar(), radar(), class(), class()).prop_map(|(one, two, first, second)| {
        let [one, two] =
            [(one, first), (two, second)].map(|(object, class)| radar_object(&object, class, &Config::DEFAULT));
        merge(one, two)
    });
    let lone = (radar(), class()).prop_map(|(object, class)| radar_object(&object, class, &Config::DEFAULT));
    // Equal severity with different objects: the values decide.
    let twin = (lone, option::of((0..3_u16, 0..3_i16, 0..3_i16)), any::<bool>()).prop_map(|(lone, place, none)| {
        let (level, required) = (if none { Level::None } else { lone.level }, lone.required);
        let worst = place.map(|(distance, offset, closing)| Worst {
            level,
            required,
            object: Object {
                distance: DistanceCm::new(distance),
                offset: OffsetCm::new(offset),
                closing: ClosingCmS::new(closing),
            },
        });
        Assessment { worst, level, ..lone }
    });
    prop_oneof![several, twin]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: CASES, failure_persistence: None, ..ProptestConfig::default() })]

    /// TTC-1a, TTC-1b, TTC-1c: exact at any distance, speed and limit, and at the configured limits.
    #[test]
    fn products_are_exact((distance, closing) in approach(), limit in any::<u32>(), configured in select(limits())) {
        for limit in [limit, configured] {
            assert!(ttc_1_products_are_exact(DistanceCm::new(distance), ClosingCmS::new(closing), Millis::new(limit)));
        }
    }

    /// FUS-1a: where an object is now.
    #[test]
    fn moved_is_exact((distance, closing) in approach(), age in age()) {
        assert!(fus_1a_moved_is_exact(DistanceCm::new(distance), ClosingCmS::new(closing), Millis::new(age)));
    }

    /// MIT-1a, MIT-2a, MIT-3a, MIT-6c, MIT-8a to MIT-8d, FUS-3c to FUS-3e, FCW-1a, FCW-1b, PCW-1a, PCW-1b: every property of one object.
    #[test]
    fn every_property_of_an_object_holds(object in radar(), class in class()) {
        let sight = Sight::of(&object, class, &Config::DEFAULT);
        let broken = ALL.iter().find(|(_, holds)| !holds(&sight)).map(|(name, _)| *name);
        assert_eq!(broken, None);
        assert!(mit_8d_more_severe_decides(&sight));
    }

    /// TTC-1a, FUS-3c: nearer and faster is never less severe.
    #[test]
    fn level_is_monotone(object in radar(), nearer in 0..400_u16, faster in 0..400_i16, class in class()) {
        let worse = RadarObject {
            distance: DistanceCm::new(object.distance.raw().saturating_sub(nearer)),
            closing: ClosingCmS::new(object.closing.raw().saturating_add(faster)),
            ..object
        };
        let config = Config::DEFAULT;
        assert!(ttc_1_level_is_monotone(&Sight::of(&object, class, &config), &Sight::of(&worse, class, &config)));
    }

    /// FUS-3d, MIT-8a, MIT-8d: a camera's object permits and no more.
    #[test]
    fn camera_only_permits(object in camera()) {
        assert!(fus_3d_camera_only_permits(&object, &Config::DEFAULT));
    }

    /// MIT-6a: two merged, three in any order.
    #[test]
    fn most_severe_decides(one in assessment(), two in assessment(), three in assessment()) {
        assert!(mit_6a_most_severe_decides(one, two));
        assert!(mit_6a_order_does_not_matter(one, two, three));
    }

    /// RULE-1a, FCW-1b, PCW-1b: the threat says what was merged.
    #[test]
    fn threat_says_what_was_merged(merged in assessment(), known: bool) {
        assert!(fcw_1_threat_says_what_was_merged(merged, known));
    }

    /// MIT-6a, MIT-7a, RULE-1a: a list is folded by the merge, object by object; what is too old is not assessed and makes perception
    /// unknown.
    #[test]
    fn lists_are_folded(radar in proptest::collection::vec(radar(), 0..4), camera in proptest::collection::vec(camera(), 0..4)) {
        let config = Config::DEFAULT;
        let scene = Scene {
            radar: radar.iter().copied().collect(),
            camera: camera.iter().copied().collect(),
            ..Scene::clear()
        };
        let classes = supervisor_perceive::matches(&radar, &camera, &config);
        let young = |age: Millis| age <= config.object_age;
        let ones = radar.iter().zip(classes).filter(|(object, _)| young(object.age));
        let ones = ones.map(|(object, class)| radar_object(object, class, &config));
        let others = camera.iter().filter(|object| young(object.age)).map(|object| camera_object(object, &config));
        let merged = ones.chain(others).fold(Assessment::NOTHING, merge);
        let known = radar.iter().map(|object| object.age).chain(camera.iter().map(|object| object.age)).all(young);
        assert_eq!(perceive(&scene, &config), merged.threat(known));
    }
}
