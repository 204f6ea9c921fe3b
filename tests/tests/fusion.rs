//! Fusion of radar and camera: one time, one to one, and what a match means (FUS-1, FUS-3).
//!
//! `Z12` puts an object where one centimetre is one pixel, so that boxes can be computed by hand.

mod common;
use common::*;
use proptest::collection::vec;
use proptest::prelude::{Just, ProptestConfig, Strategy, any, prop_oneof, proptest};
use supervisor_perceive::{Boxed, Overlap, Span, matches, moved};
use supervisor_tests::road::Body;

/// Depth 12.00 m for a camera 0.50 m behind the radar: f = 1200 px, so 1 px is 1 cm.
const Z12: u16 = 1_150;
/// The box of an object there: 2 m by 2 m on the road, 1.70 m below the camera, in a picture centred at (640, 360).
const BOX: PixelBox = PixelBox { left: 540, top: 330, width: 200, height: 200 };

fn once(distance: u16, offset: i16, closing: i16) -> RadarObject {
    RadarObject { offset: OffsetCm::new(offset), updates: Count::new(1), ..object(distance, closing) }
}

fn seen(pixels: PixelBox, class: Class) -> CameraObject {
    CameraObject { pixels, class, ..camera_object(60_000, -10) }
}

fn classes(radar: &[RadarObject], camera: &[CameraObject]) -> Vec<Option<Class>> {
    matches(radar, camera, &Config::DEFAULT)[..radar.len()].to_vec()
}

fn matched(radar: RadarObject, camera: CameraObject) -> bool {
    classes(&[radar], &[camera]) == [Some(Class::Object)]
}

// One time.

/// FUS-1a: a distance at another time, to the nearer centimetre, both ways, and where it saturates.
#[test]
fn a_distance_is_moved_to_the_nearer_centimetre() {
    for (distance, closing, age, then, expected) in [
        (1_000, 1_000, 100, 0, 900),
        (1_000, 1_000, 0, 100, 1_100),
        (1_000, 1_000, 70, 70, 1_000),
        (1_000, -1_000, 100, 0, 1_100),
        (1_000, 1, 1, 0, 999),     // 0.001 cm nearer counts as one
        (1_000, 1, 999, 0, 999),   // 0.999 cm
        (1_000, 1, 1_000, 0, 999), // exactly one
        (1_000, 1, 1_001, 0, 998),
        (1_000, -1, 999, 0, 1_000), // not a whole centimetre farther
        (1_000, -1, 1_000, 0, 1_001),
        (1_000, 1, 0, 999, 1_000),
        (100, 1_000, 100, 0, 0),
        (99, 1_000, 100, 0, 0),
        (65_535, -1_000, 250, 0, 65_535),
        (65_535, i16::MIN, u32::MAX, 0, 65_535),
        (65_535, i16::MAX, u32::MAX, 0, 0),
        (0, i16::MIN, 250, 0, 8_192),
        (0, i16::MAX, 0, u32::MAX, 65_535),
    ] {
        let at = moved(DistanceCm::new(distance), ClosingCmS::new(closing), Millis::new(age), Millis::new(then));
        assert_eq!(at.raw(), expected, "{distance} {closing} {age} {then}");
    }
}

/// FUS-1a, TTC-1a: the levels judge where an object is now, not where it was measured.
#[test]
fn an_object_is_judged_where_it_is_now() {
    for (distance, age, level) in [
        (4_440, 40, Level::None), // 44.00 m by now: exactly 4.4 s
        (4_439, 40, Level::One),
        (4_400, 0, Level::None),
        (2_950, 250, Level::Three),
        (2_951, 250, Level::Two),
        (100, 250, Level::Three), // past its zero
    ] {
        let (_, decision) = Bus::approaching(RadarObject { age: Millis::new(age), ..at(distance) });
        assert_eq!(decision.status.level, level, "{distance} {age}");
    }
    // A camera object permits where it is now: T <= 3.2 s raises the cap.
    for (distance, passes) in [(3_300, true), (3_301, false)] {
        let mut bus = Bus::driving(kmh(9));
        let object = CameraObject { age: Millis::new(100), ..camera_object(distance, TEN) };
        assert!(bus.scene.camera.push(object).is_ok());
        bus.ask_brake(ms2(600));
        assert_eq!(bus.step().verdicts.of(Channel::ServiceBrake).passed(), passes, "{distance}");
    }
}

/// FUS-1a: radar and camera meet at the time of the image: closing at 20 m/s, 100 ms are 2 m, and the box still fits.
#[test]
fn radar_and_camera_meet_at_the_time_of_the_image() {
    let picture = |gap: u16, age| CameraObject {
        age: Millis::new(age),
        ..picture_of(&object(gap, 2_000), &Body::CAR).unwrap_or(CameraObject::NONE)
    };
    let radar = |distance: u16, age| RadarObject { age: Millis::new(age), ..once(distance, 0, 2_000) };
    // 8.00 m now; the radar saw it 100 ms ago at 10.00 m, the camera 40 ms ago at 8.80 m, or the other way round.
    for (radar, camera) in [
        (radar(1_000, 100), picture(880, 40)),
        (radar(880, 40), picture(1_000, 100)),
        (radar(800, 0), picture(1_300, 250)),
    ] {
        assert!(matched(radar, camera));
    }
    // In a list that mixes images the newest one gives the time: an old box elsewhere moves nothing.
    let aside = CameraObject { pixels: PixelBox { left: 0, top: 0, width: 9, height: 9 }, ..picture(1_300, 250) };
    for list in [[aside, picture(300, 0)], [picture(300, 0), aside]] {
        assert!(
            classes(&[RadarObject { closing: ClosingCmS::new(4_000), ..radar(300, 0) }], &list)
                .contains(&Some(Class::Object))
        );
    }
    // 250 ms apart at 40 m/s are 10 m: taken as of one time, the boxes of 13 m and 3 m do not match.
    let fast = RadarObject { closing: ClosingCmS::new(4_000), ..radar(300, 0) };
    let old = picture(1_300, 250);
    assert!(matched(fast, old) && !matched(RadarObject { age: Millis::new(250), ..fast }, old));
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, cases: 2_000, ..ProptestConfig::default() })]

    /// FUS-1a: moving a distance is the floor of exact arithmetic, for any values.
    #[test]
    fn moving_agrees_with_wide_arithmetic(distance in any::<u16>(), closing in any::<i16>(), age in 0_u32..32_768, then in 0_u32..32_768) {
        let thousandths = i128::from(distance) * 1000 - i128::from(closing) * (i128::from(age) - i128::from(then));
        let expected = u16::try_from(thousandths.div_euclid(1000).max(0)).unwrap_or(u16::MAX);
        let at = moved(DistanceCm::new(distance), ClosingCmS::new(closing), Millis::new(age), Millis::new(then));
        assert_eq!(at.raw(), expected);
    }

    /// FUS-3a, MIT-6a: any order of either list gives the same threat, with ties and duplicates in plenty.
    #[test]
    fn no_order_of_the_lists_decides_anything(radar in vec(crowded(), 0..=MAX_RADAR), camera in vec(pictured(), 0..=MAX_CAMERA), seed in any::<u64>()) {
        let threat = |radar: &[RadarObject], camera: &[CameraObject]| {
            let mut scene = Scene::clear();
            assert!(scene.radar.extend_from_slice(radar).is_ok() && scene.camera.extend_from_slice(camera).is_ok());
            perceive(&scene, &Config::DEFAULT)
        };
        let expected = threat(&radar, &camera);
        let mut dice = random::Dice::Number(seed);
        for _ in 0..4 {
            let (mut radar, mut camera) = (radar.clone(), camera.clone());
            (1..radar.len()).for_each(|last| radar.swap(last, dice.below(last + 1)));
            (1..camera.len()).for_each(|last| camera.swap(last, dice.below(last + 1)));
            assert_eq!(threat(&radar, &camera), expected);
        }
    }

    /// FUS-3a: one to one: no camera object matches twice, whatever the lists.
    #[test]
    fn matches_are_one_to_one(radar in vec(crowded(), 0..=MAX_RADAR), camera in vec(pictured(), 0..=MAX_CAMERA)) {
        let classes = classes(&radar, &camera);
        for of in [Class::Object, Class::Pedestrian] {
            let given = classes.iter().filter(|class| **class == Some(of)).count();
            let there = camera.iter().filter(|seen| (seen.class == Class::Pedestrian) == (of == Class::Pedestrian)).count();
            assert!(given <= there, "{given} of {there} {of:?}");
        }
    }

    /// SELF-1a: full lists of any bits under a configuration of any bits: a threat, and no panic.
    #[test]
    fn any_bits_give_a_threat(seed in any::<u64>()) {
        let mut dice = random::Dice::Number(seed);
        let config = any_config(&mut dice);
        let mut scene = Scene { radar_known: !dice.one_in(8), camera_known: !dice.one_in(8), ..Scene::default() };
        for _ in 0..MAX_RADAR {
            let object = RadarObject {
                distance: DistanceCm::new(dice.half()),
                offset: OffsetCm::new(dice.signed()),
                closing: ClosingCmS::new(dice.signed()),
                age: Millis::new(dice.word() >> dice.below(32)),
                updates: Count::new(dice.byte()),
            };
            assert!(scene.radar.push(object).is_ok());
        }
        for _ in 0..MAX_CAMERA {
            let pixels = PixelBox { left: dice.half(), top: dice.half(), width: dice.half(), height: dice.half() };
            let object = CameraObject {
                pixels: if dice.flag() { pixels } else { PixelBox { left: 0, top: 0, ..pixels } },
                class: dice.of(Class::ALL),
                distance: DistanceCm::new(dice.half()),
                closing: ClosingCmS::new(dice.signed()),
                age: Millis::new(dice.word() >> dice.below(32)),
            };
            assert!(scene.camera.push(object).is_ok());
        }
        let threat = perceive(&scene, &config);
        assert!(threat.level == Level::None || threat.object.is_some());
    }
}

/// A radar object out of few values, so that many tie.
fn crowded() -> impl Strategy<Value = RadarObject> {
    let values = ([1_150_u16, 1_160, 2_350], [0_i16, 20, -100], [1_000_i16, 990, -10], [0_u32, 10, 251], [1_u8, 3]);
    let pick = |count: usize| 0..count;
    (pick(3), pick(3), pick(3), pick(3), pick(2)).prop_map(move |(distance, offset, closing, age, updates)| {
        RadarObject {
            distance: DistanceCm::new(values.0[distance]),
            offset: OffsetCm::new(values.1[offset]),
            closing: ClosingCmS::new(values.2[closing]),
            age: Millis::new(values.3[age]),
            updates: Count::new(values.4[updates]),
        }
    })
}

/// A camera object out of few values.
fn pictured() -> impl Strategy<Value = CameraObject> {
    let left = prop_oneof![Just(550), Just(540), Just(600), Just(615), Just(650)];
    let size = prop_oneof![Just((180, 150)), Just((50, 170)), Just((90, 75))];
    (left, size, 0..3_usize, prop_oneof![Just(0), Just(10), Just(251)]).prop_map(
        |(left, (width, height), class, age)| {
            let pixels = PixelBox { left, top: 380, width, height };
            CameraObject { age: Millis::new(age), ..seen(pixels, Class::ALL[class]) }
        },
    )
}

/// A configuration of any bits that its types can hold.
fn any_config(dice: &mut random::Dice) -> Config {
    let mut words = Vec::new();
    Config::DEFAULT.write(&mut |word| words.push(word));
    let read = |words: &[u32]| {
        let mut source = words.iter().copied();
        Config::read(&mut || source.next())
    };
    for index in 0..words.len() {
        let (word, old) = (dice.word(), words[index]);
        for narrower in [word, word >> 16, word >> 24] {
            words[index] = narrower;
            if read(&words).is_some() {
                break;
            }
            words[index] = old;
        }
    }
    read(&words).unwrap_or(Config::DEFAULT)
}

// One to one.

/// FUS-3a: the threshold, by hand: 30 % exactly is no match, a step more is.
#[test]
fn the_threshold_is_exact() {
    let overlap = |width: u16, other: u16, shift: u16| {
        let span = |least, most| Span { least, most };
        let boxed = |least, most| Boxed::of([span(least, most), span(0, 10)]);
        boxed(100, 100 + width).overlap(&boxed(100 + shift, 100 + shift + other))
    };
    let exceeds = |overlap: Option<Overlap>, share| {
        overlap.is_some_and(|overlap| overlap.exceeds(Overlap::threshold(percent(share))))
    };
    // 13 wide, 7 apart: 6 of 20. 13 wide, 6 apart: 7 of 19.
    assert_eq!(overlap(13, 13, 7), Some(Overlap { shared: 60, sum: 260 }));
    assert!(!exceeds(overlap(13, 13, 7), 30) && exceeds(overlap(13, 13, 7), 29));
    assert!(exceeds(overlap(13, 13, 6), 36) && !exceeds(overlap(13, 13, 6), 37));
    // Touching, apart, the same, one inside the other.
    assert_eq!((overlap(13, 13, 13), overlap(13, 13, 14)), (None, None));
    assert!(exceeds(overlap(13, 13, 0), 99) && !exceeds(overlap(13, 13, 0), 100));
    assert!(!exceeds(overlap(1_000, 300, 0), 30) && exceeds(overlap(1_000, 301, 0), 30));
}

/// FUS-3a: the same through the whole of the matching, in pixels of the camera.
#[test]
fn the_threshold_in_pixels() {
    let radar = once(Z12, 0, 0);
    let matched = |pixels| matched(radar, seen(pixels, Class::Object));
    assert!(matched(BOX));
    // Beside: (200 − k)/(200 + k) > 0.3 up to k = 107; to either side, up and down.
    for (across, down, expected) in [
        (107, 0, true),
        (108, 0, false),
        (-107, 0, true),
        (-108, 0, false),
        (0, 107, true),
        (0, 108, false),
        (0, -107, true),
        (0, -108, false),
    ] {
        let shifted =
            PixelBox { left: BOX.left.saturating_add_signed(across), top: BOX.top.saturating_add_signed(down), ..BOX };
        assert_eq!(matched(shifted), expected, "{across} {down}");
    }
    // Inside: 60 of 200 columns are 30 % exactly.
    for (width, expected) in [(59, false), (60, false), (61, true)] {
        assert_eq!(matched(PixelBox { width, ..BOX }), expected, "{width}");
    }
    // At the radar itself it fills the picture, and all that is known of it is 0: 384 of 1280 columns.
    for (width, expected) in [(383, false), (384, false), (385, true)] {
        let pixels = PixelBox { left: 0, top: 0, width, height: 720 };
        let unseen = RadarObject { updates: Count::new(0), ..once(0, 0, 0) };
        assert_eq!(classes(&[unseen], &[seen(pixels, Class::Object)]), [expected.then_some(Class::Object)], "{width}");
    }
    // Nothing, and boxes out of the picture.
    for pixels in [
        PixelBox::default(),
        PixelBox { width: 0, ..BOX },
        PixelBox { height: 0, ..BOX },
        PixelBox { left: 1_280, ..BOX },
        PixelBox { left: u16::MAX, top: u16::MAX, width: u16::MAX, height: u16::MAX },
    ] {
        assert!(!matched(pixels), "{pixels:?}");
    }
}

/// FUS-3a: both sensors must deliver, and neither object be too old.
#[test]
fn lost_and_old_objects_match_nothing() {
    let ghost = once(Z12, 0, TEN);
    let level = |radar: RadarObject, camera: CameraObject, camera_known: bool| {
        let mut bus = Bus::driving(kmh(50));
        bus.scene.camera_known = camera_known;
        bus.ahead(radar);
        assert!(bus.scene.camera.push(camera).is_ok());
        bus.step().status.level
    };
    let picture = seen(BOX, Class::Object);
    let aged = |age| CameraObject { age: Millis::new(age), ..picture };
    assert_eq!(level(ghost, picture, true), Level::Three);
    assert_eq!(level(ghost, picture, false), Level::None);
    // 250 ms ago it was 2.50 m farther, and smaller in the picture by a fifth: still a match.
    assert_eq!(level(ghost, aged(250), true), Level::Three);
    assert_eq!(level(ghost, aged(251), true), Level::None);
    assert_eq!(level(RadarObject { age: Millis::new(251), ..ghost }, picture, true), Level::None);
}

/// FUS-3b: the match gives the class; what the camera cannot class is an object.
#[test]
fn the_match_gives_the_class() {
    let person = PixelBox { left: 615, top: 360, width: 50, height: 170 };
    for (pixels, class, expected) in [
        (BOX, Class::Object, Some(Class::Object)),
        (BOX, Class::Unclassified, Some(Class::Object)),
        (BOX, Class::Pedestrian, None),
        (person, Class::Pedestrian, Some(Class::Pedestrian)),
        (person, Class::Object, None),
    ] {
        assert_eq!(classes(&[once(Z12, 0, 0)], &[seen(pixels, class)]), [expected], "{pixels:?} {class:?}");
    }
}

/// FUS-3a: of several reflections of one thing the one that fits best is matched, of several boxes the best one counts.
#[test]
fn each_takes_what_fits_best() {
    let car = seen(BOX, Class::Object);
    let reflections = [once(Z12 + 300, 0, 0), once(Z12, 10, 0), once(Z12, 0, 0), once(Z12 - 200, 0, 0)];
    assert_eq!(classes(&reflections, &[car]), [None, None, Some(Class::Object), None]);
    // A pedestrian before the car, as wide as a third of it: the radar's one object goes to whom it fits better.
    let near = PixelBox { left: 610, top: 355, width: 60, height: 175 };
    for order in [[seen(near, Class::Pedestrian), car], [car, seen(near, Class::Pedestrian)]] {
        assert_eq!(classes(&[once(Z12, 0, 0)], &order), [Some(Class::Object)]);
    }
    // Between equals the pedestrian counts.
    let mut config = Config::DEFAULT;
    config.pedestrian_size = config.object_size;
    for order in [[seen(BOX, Class::Pedestrian), car], [car, seen(BOX, Class::Pedestrian)]] {
        assert_eq!(matches(&[once(Z12, 0, 0)], &order, &config)[0], Some(Class::Pedestrian));
    }
    // Two pedestrians side by side, each with its own box.
    let pair = [once(Z12, 40, 0), once(Z12, -40, 0)];
    let boxes = [575, 655].map(|left| seen(PixelBox { left, top: 360, width: 50, height: 170 }, Class::Pedestrian));
    assert_eq!(classes(&pair, &boxes), [Some(Class::Pedestrian); 2]);
}

// What a match means.

/// FUS-3a: between two that fit equally well their values decide, never their places: the nearer one (both so near that they fill the
/// picture), the slower one, the one with fewer updates.
#[test]
fn between_equal_fits_the_values_decide() {
    let whole = PixelBox { left: 0, top: 0, width: 1_280, height: 720 };
    let (slow, fast) = (once(Z12, 0, 100), once(Z12, 0, 200));
    let often = RadarObject { updates: Count::new(255), ..slow };
    for (pixels, taken, other) in [(whole, once(10, 0, 200), once(20, 0, 100)), (BOX, slow, fast), (BOX, slow, often)] {
        let camera = [seen(pixels, Class::Object)];
        assert_eq!(classes(&[taken, other], &camera), [Some(Class::Object), None]);
        assert_eq!(classes(&[other, taken], &camera), [None, Some(Class::Object)]);
    }
}

/// FUS-3c: a ghost of one update obliges nothing and permits; the camera's box makes it an obstacle.
#[test]
fn a_ghost_obliges_nothing_until_the_camera_sees_it() {
    let ghost = once(2_000, 0, TEN);
    let (mut bus, decision) = Bus::approaching(ghost);
    assert_eq!((decision.status.level, decision.outputs.brake.total), (Level::None, ms2(0)));
    bus.ask_brake(ms2(600));
    assert_passed(&bus.step(), Channel::ServiceBrake);
    for body in [Body::CAR, Body::BUS, Body::PEDESTRIAN, Body::CYCLIST] {
        let (mut bus, _) = Bus::approaching(ghost);
        let Some(picture) = picture_of(&ghost, &body) else { unreachable!("in the picture") };
        assert!(bus.scene.camera.push(picture).is_ok());
        assert_eq!(bus.step().status.level, Level::Three, "{body:?}");
    }
}

/// FUS-3a, FUS-3d: a camera that is wrong about the distance undoes no match; its own distance permits and never obliges.
#[test]
fn a_wrong_distance_of_the_camera_undoes_no_match() {
    for distance in [0, 100, 6_000, u16::MAX] {
        for (radar, level) in [(once(2_000, 0, TEN), Level::Three), (once(2_000, 0, 100), Level::None)] {
            let mut bus = Bus::driving(kmh(50));
            bus.ahead_matched(radar, Class::Object);
            for seen in &mut bus.scene.camera {
                (seen.distance, seen.closing) = (DistanceCm::new(distance), ClosingCmS::new(TEN));
            }
            let decision = bus.step();
            assert_eq!(decision.status.level, level, "{distance}: the radar's distance and speed oblige");
            if level == Level::None {
                bus.ask_brake(ms2(600));
                let permitted = bus.step().verdicts.of(Channel::ServiceBrake).passed();
                assert_eq!(permitted, distance <= 3_200, "{distance}");
            }
        }
    }
}
