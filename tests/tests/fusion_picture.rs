//! Fusion: where a radar object stands in the picture (FUS-2), by hand, in floating point, and by the bus model's camera.

mod common;
use common::*;
use proptest::prelude::{ProptestConfig, proptest};
use supervisor_perceive::{Lens, STEPS, matches};
use supervisor_tests::number::to_i16;
use supervisor_tests::road::{Body, Camera};

/// Depth 12.00 m for a camera 0.50 m behind the radar: f = 1200 px, so 1 px is 1 cm.
const Z12: u16 = 1_150;

/// The edges of the box in 1/8 px: left, right, top, bottom.
fn edges(distance: u16, offset: i16, size: Row<DistanceCm, 2>, config: &Config) -> Option<[u16; 4]> {
    let lens = Lens::of(config);
    let foot = lens.foot(DistanceCm::new(distance), OffsetCm::new(offset))?;
    let [columns, rows] = lens.outline(foot, lens.size(size));
    Some([columns.least, columns.most, rows.least, rows.most])
}

/// FUS-2a: by hand: straight ahead, to the left, to the right, a pedestrian, twice as far.
#[test]
fn boxes_by_hand() {
    let config = Config::DEFAULT;
    let (car, person) = (config.object_size, config.pedestrian_size);
    for (distance, offset, size, pixels) in [
        (Z12, 0, car, [540, 740, 330, 530]),
        (Z12, 100, car, [440, 640, 330, 530]),
        (Z12, -100, car, [640, 840, 330, 530]),
        (Z12, 0, person, [615, 665, 360, 530]),
        (2_350, 0, car, [590, 690, 345, 445]),
        // Half out of the picture, and all of it.
        (Z12, 640, car, [0, 100, 330, 530]),
        (Z12, 2_000, car, [0, 0, 330, 530]),
        // At the bumper a pedestrian fills the lower half, an object all of it.
        (0, 0, person, [40, 1_240, 360, 720]),
        (0, 0, car, [0, 1_280, 0, 720]),
    ] {
        let expected = pixels.map(|edge: u16| edge * STEPS);
        assert_eq!(edges(distance, offset, size, &config), Some(expected), "{distance} {offset}");
    }
}

/// FUS-2a: behind the camera, in its plane and beyond the range there is no box, and so no match.
#[test]
fn behind_the_camera_and_beyond_the_range_there_is_no_box() {
    let mut config = Config::DEFAULT;
    for (distance, there) in [(0, true), (14_950, true), (14_951, false), (u16::MAX, false)] {
        assert_eq!(edges(distance, 0, config.object_size, &config).is_some(), there, "{distance}");
    }
    config.camera_translation = Row([0, 120, -300].map(OffsetCm::new));
    for (distance, there) in [(0, false), (299, false), (300, false), (301, true)] {
        assert_eq!(edges(distance, 0, config.object_size, &config).is_some(), there, "{distance}");
        let pixels = PixelBox { left: 0, top: 360, width: 1_280, height: 360 };
        let everything = CameraObject { pixels, class: Class::Pedestrian, ..camera_object(60_000, 0) };
        let class = matches(&[object(distance, 0)], &[everything], &config)[0];
        assert_eq!(class, there.then_some(Class::Pedestrian), "{distance}");
    }
}

/// The same box in floating point, from the configuration: left, right, top, bottom in px; and its depth in cm.
fn oracle(distance: u16, offset: i16, size: Row<DistanceCm, 2>, config: &Config) -> ([f64; 4], f64) {
    let point = [f64::from(distance), f64::from(offset), -f64::from(config.radar_height.raw())];
    let rotation = config.camera_rotation.0.map(|element| f64::from(element.raw()) / 16_384.0);
    let along = |row: usize| {
        let turned: f64 =
            rotation[row * 3..row * 3 + 3].iter().zip(point).map(|(element, value)| element * value).sum();
        turned + f64::from(config.camera_translation.0[row].raw())
    };
    let (x, y, depth) = (along(0), along(1), along(2));
    let pixel = |row: Row<Pixel, 2>| row.0.map(|value| f64::from(value.raw()));
    let ([fx, fy], [cx, cy], [columns, rows]) =
        (pixel(config.focal_length), pixel(config.principal_point), pixel(config.image_size));
    let [width, height] = size.0.map(|value| f64::from(value.raw()));
    let column = |x: f64| (cx + fx * x / depth).clamp(0.0, columns);
    let row = |y: f64| (cy + fy * y / depth).clamp(0.0, rows);
    ([column(x - width / 2.0), column(x + width / 2.0), row(y - height), row(y)], depth)
}

/// A rotation by angles in degrees: to the left, downwards, to the right about the axis; rows right, down, ahead.
fn turned(yaw: f64, pitch: f64, roll: f64) -> Row<RotationQ14, 9> {
    let [(sy, cy), (sp, cp), (sr, cr)] = [yaw, pitch, roll].map(|angle| angle.to_radians().sin_cos());
    let ahead = [cp * cy, cp * sy, -sp];
    let level = [sy, -cy, 0.0];
    let down = [-sp * cy, -sp * sy, -cp];
    let mix = |first: f64, second: f64, index: usize| first * level[index] + second * down[index];
    let rows = [0, 1, 2].map(|index| [mix(cr, sr, index), mix(-sr, cr, index), ahead[index]]);
    let element = |row: usize, column: usize| RotationQ14::new(to_i16(rows[column][row] * 16_384.0));
    Row([0, 1, 2, 3, 4, 5, 6, 7, 8].map(|index| element(index / 3, index % 3)))
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, cases: 2_000, ..ProptestConfig::default() })]

    /// FUS-2a: the box agrees with floating point, for any mounting: a step, and what one centimetre of depth makes.
    #[test]
    fn boxes_agree_with_floating_point(
        distance in 0_u16..15_000, offset in -3_000_i16..3_000,
        (yaw, pitch, roll) in (-20.0..20.0, -20.0..20.0, -20.0..20.0),
        translation in [-200_i16..200, 50_i16..250, -100_i16..300],
        size in [20_u16..300, 20_u16..300], focal in [400_u16..3_000, 400_u16..3_000],
    ) {
        let mut config = Config::DEFAULT;
        config.camera_rotation = turned(yaw, pitch, roll);
        config.camera_translation = Row(translation.map(OffsetCm::new));
        config.focal_length = Row(focal.map(Pixel::new));
        config.match_range = DistanceCm::new(32_767);
        assert!(config.is_valid(), "{:?}", config.broken_relation());
        let size = Row(size.map(DistanceCm::new));
        let (expected, depth) = oracle(distance, offset, size, &config);
        let Some(edges) = edges(distance, offset, size, &config) else {
            assert!(depth < 1.01, "{depth}");
            return Ok(());
        };
        if depth < 2.0 {
            return Ok(());
        }
        for (edge, (expected, centre)) in edges.into_iter().zip(expected.into_iter().zip([640.0, 640.0, 360.0, 360.0])) {
            let tolerance = 2.0 / 8.0 + 1.01 * f64::from(edge.max(1)).mul_add(0.125, -centre).abs().max((expected - centre).abs()) / (depth - 1.0);
            assert!((f64::from(edge) / 8.0 - expected).abs() <= tolerance, "{edge} {expected} {depth}");
        }
    }

    /// FUS-2a: calibrated to it, a turned camera sees the boxes where the supervisor puts them.
    #[test]
    fn a_calibrated_camera_agrees_with_the_bus_model(gap in 600_u16..10_000, across in -100_i16..100, yaw in -4.0..4.0, pitch in -4.0..4.0) {
        let offset = i16::try_from(i32::from(across) * i32::from(gap) / 400).unwrap_or(0);
        let camera = Camera { yaw, pitch, ..Camera::STRAIGHT };
        let mut config = Config::DEFAULT;
        config.camera_rotation = turned(yaw, pitch, 0.0);
        // The camera stands 0.50 m behind and 1.20 m above the radar: the translation is the rotation of that.
        let rotation = config.camera_rotation.0.map(|element| f64::from(element.raw()) / 16_384.0);
        config.camera_translation = Row([0, 1, 2].map(|row| {
            OffsetCm::new(to_i16(rotation[row * 3] * 50.0 - rotation[row * 3 + 2] * 120.0))
        }));
        let body = Body { width: 2.0, height: 2.0, ..Body::CAR };
        let Some(pixels) = camera.pixels(&body, f64::from(gap) / 100.0, f64::from(offset) / 100.0) else { return Ok(()) };
        let Some(edges) = edges(gap, offset, config.object_size, &config) else { unreachable!("in range") };
        let truth = [pixels.left, pixels.left + pixels.width, pixels.top, pixels.top + pixels.height];
        for (edge, truth) in edges.into_iter().zip(truth) {
            // A box faces the camera, a rear faces the road: turned by 4° its corners are up to 7 and 14 cm nearer or
            // farther, which moves an edge 640 px from the centre by 13 440 px·cm.
            let tolerance = 2.0 + 14_000.0 / f64::from(gap);
            assert!((f64::from(edge) / 8.0 - f64::from(truth)).abs() <= tolerance, "{edges:?} {truth}");
        }
    }
}
