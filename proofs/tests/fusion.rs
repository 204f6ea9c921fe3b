//! The properties of fusion on random boxes and scenes, most of them with boxes that nearly fit (FUS-2, FUS-3).

use proptest::collection::vec;
use proptest::prelude::{ProptestConfig, Strategy, any, prop_oneof, proptest};
use proptest::sample::select;
use supervisor_core::{ClosingCmS, Config, Count, DistanceCm, Millis, OffsetCm, Percent, Row};
use supervisor_perceive::{
    CameraObject, Class, Lens, MAX_RADAR, Outline, Overlap, PixelBox, RadarObject, STEPS, Span, matches,
};
use supervisor_proofs::properties::fusion::{
    fus_2a_camera_box_is_clipped, fus_2a_projection_is_exact, fus_3a_a_match_needs_overlap, fus_3a_no_match_is_missed,
    fus_3a_one_to_one, fus_3a_order_is_exact, fus_3a_order_is_strict, fus_3a_overlap_exactly_in_common,
    fus_3a_overlap_is_exact, fus_3a_overlap_is_symmetric, fus_3a_threshold_by_the_sum, fus_3a_threshold_is_exact,
    fus_3a_two_match_exactly,
};

const CASES: u32 = 20_000;

fn span() -> impl Strategy<Value = Span> {
    let ordered = (0..=4096 * STEPS, 0..=4096 * STEPS)
        .prop_map(|(one, other)| Span { least: one.min(other), most: one.max(other) });
    let narrow = (0..200_u16, 0..200_u16).prop_map(|(least, length)| Span { least, most: least + length });
    prop_oneof![ordered, narrow, any::<[u16; 2]>().prop_map(|[least, most]| Span { least, most })]
}

fn outline() -> impl Strategy<Value = Outline> {
    [span(), span()]
}

/// Any overlap, or one at the edge of a share.
fn overlap() -> impl Strategy<Value = (Overlap, u8)> {
    let edge = (1..=100_u8, 1..400_000_u32, -1..=1_i64).prop_map(|(share, scale, off)| {
        let shared = i64::from(share) * i64::from(scale) + off;
        let sum = (100 + i64::from(share)) * i64::from(scale);
        let whole = |value: i64| u32::try_from(value).unwrap_or(u32::MAX);
        (Overlap { shared: whole(shared), sum: whole(sum) }, share)
    });
    prop_oneof![
        edge,
        (any::<[u32; 2]>(), any::<u8>()).prop_map(|([shared, sum], share)| (Overlap { shared, sum }, share))
    ]
}

fn radar() -> impl Strategy<Value = RadarObject> {
    let near = (100..6_000_u16, -400..400_i16, -200..2_000_i16, 0..280_u32, 0..5_u8);
    let far = (any::<u16>(), any::<i16>(), any::<i16>(), any::<u32>(), any::<u8>());
    prop_oneof![4 => near.boxed(), 1 => far.boxed()].prop_map(|(distance, offset, closing, age, updates)| RadarObject {
        distance: DistanceCm::new(distance),
        offset: OffsetCm::new(offset),
        closing: ClosingCmS::new(closing),
        age: Millis::new(age),
        updates: Count::new(updates),
    })
}

/// A camera's object that nearly fits this radar object, or any.
fn fitting(radar: &RadarObject, class: Class, jitter: [i16; 4], age: u32) -> CameraObject {
    let config = Config::DEFAULT;
    let lens = Lens::of(&config);
    let size = if class == Class::Pedestrian { config.pedestrian_size } else { config.object_size };
    let outline = lens.foot(radar.distance, radar.offset).map(|foot| lens.outline(foot, lens.size(size)));
    let [columns, rows] =
        outline.unwrap_or_default().map(|span| (span.least / STEPS, (span.most - span.least) / STEPS));
    let [left, top, width, height] = jitter;
    CameraObject {
        pixels: PixelBox {
            left: columns.0.saturating_add_signed(left),
            top: rows.0.saturating_add_signed(top),
            width: columns.1.saturating_add_signed(width),
            height: rows.1.saturating_add_signed(height),
        },
        class,
        distance: radar.distance,
        closing: radar.closing,
        age: Millis::new(age),
    }
}

/// Up to `most` radar objects, and camera objects that nearly fit some of them.
fn scene(most: usize) -> impl Strategy<Value = (Vec<RadarObject>, Vec<CameraObject>)> {
    let jitter = prop_oneof![
        [-40..40_i16, -40..40_i16, -40..40_i16, -40..40_i16],
        [-4..4_i16, -4..4_i16, -4..4_i16, -4..4_i16],
        any::<[i16; 4]>()
    ];
    let seen = (any::<usize>(), select(Class::ALL), jitter, 0..270_u32);
    (vec(radar(), 1..=most), vec(seen, 1..=most.min(16))).prop_map(|(radar, seen)| {
        let camera =
            seen.into_iter().map(|(of, class, jitter, age)| fitting(&radar[of % radar.len()], class, jitter, age));
        let camera = camera.collect();
        (radar, camera)
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: CASES, failure_persistence: None, ..ProptestConfig::default() })]

    /// FUS-2a: the projection is exact, by the default and by any calibration.
    #[test]
    fn projection_is_exact(object in radar(), size in any::<[u16; 2]>(), values in vec(any::<u8>(), 2_048)) {
        let config = arbitrary::Arbitrary::arbitrary(&mut arbitrary::Unstructured::new(&values)).unwrap_or(Config::DEFAULT);
        let [wide, tall] = size.map(DistanceCm::new);
        for (config, size) in [(Config::DEFAULT, Config::DEFAULT.object_size), (config, Row([wide, tall]))] {
            // Only an image beyond 8191 px saturates; its range ends at 4096.
            let image = config.image_size.0.iter().chain(&config.principal_point.0).all(|length| length.raw() <= 8191);
            assert!(!image || fus_2a_projection_is_exact(object.distance, object.offset, size, &config));
        }
    }

    /// FUS-2a: a camera's box is clipped to the image.
    #[test]
    fn camera_box_is_clipped([left, top, width, height] in any::<[u16; 4]>(), small in any::<[u8; 4]>()) {
        let [near_left, near_top, narrow, low] = small.map(u16::from);
        for pixels in [PixelBox { left, top, width, height }, PixelBox { left: near_left, top: near_top, width: narrow, height: low }] {
            assert!(fus_2a_camera_box_is_clipped(pixels, &Config::DEFAULT));
        }
    }

    /// FUS-3a: intersection and areas are exact; the order of two boxes does not matter.
    #[test]
    fn overlap_is_exact(first in outline(), second in outline()) {
        assert!(fus_3a_overlap_is_exact(first, second));
        assert!(fus_3a_overlap_exactly_in_common(first, second));
        assert!(fus_3a_overlap_is_symmetric(first, second));
    }

    /// FUS-3a: the threshold is that of intersection over union, exactly; and of two overlaps one is the greater.
    #[test]
    fn threshold_is_exact((one, share) in overlap(), (other, _) in overlap()) {
        assert!(fus_3a_threshold_is_exact(one, Percent::new(share)));
        assert!(fus_3a_threshold_by_the_sum(one, Percent::new(share)));
        assert!(fus_3a_order_is_exact(one, other));
        assert!(fus_3a_order_is_strict(one, other));
    }

    /// FUS-3a, FUS-3b: two objects match exactly when they overlap enough.
    #[test]
    fn two_match_exactly((radar, camera) in scene(1)) {
        let classes = matches(&radar, &camera, &Config::DEFAULT);
        assert!(fus_3a_two_match_exactly(&radar[0], &camera[0], &Config::DEFAULT, &classes));
    }

    /// FUS-3a, FUS-3b: lists of up to six match one to one, only what overlaps enough, and something where something does.
    #[test]
    fn lists_match_one_to_one((radar, camera) in scene(6)) {
        let config = Config::DEFAULT;
        let classes = matches(&radar, &camera, &config);
        assert!(fus_3a_one_to_one(&radar, &camera, &classes));
        assert!(fus_3a_a_match_needs_overlap(&radar, &camera, &config, &classes));
        assert!(fus_3a_no_match_is_missed(&radar, &camera, &config, &classes));
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1_000, failure_persistence: None, ..ProptestConfig::default() })]

    /// FUS-3a, FUS-3b: the same of full lists.
    #[test]
    fn full_lists_match_one_to_one((radar, camera) in scene(MAX_RADAR)) {
        let config = Config::DEFAULT;
        let classes = matches(&radar, &camera, &config);
        assert!(fus_3a_one_to_one(&radar, &camera, &classes));
        assert!(fus_3a_a_match_needs_overlap(&radar, &camera, &config, &classes));
        assert!(fus_3a_no_match_is_missed(&radar, &camera, &config, &classes));
    }
}
