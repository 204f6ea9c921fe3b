//! Fusion: the picture and the overlaps of any boxes; which objects match, for short lists (FUS-2, FUS-3).

use supervisor_core::Config;
use supervisor_perceive::{CameraObject, Class, Lens, MAX_RADAR, Overlap, RadarObject, matches};

use super::configured::configured;
use crate::properties::fusion::{
    fus_2a_camera_box_is_clipped, fus_2a_projection_is_exact, fus_3a_one_to_one, fus_3a_order_is_strict,
    fus_3a_overlap_is_exact, fus_3a_overlap_is_symmetric, fus_3a_threshold_by_the_sum, fus_3a_two_match_exactly,
};

/// FUS-2: the projection is total, for any object and any configuration.
#[kani::proof]
fn fus_2_projection_is_total() {
    let (distance, offset, size, config): (_, _, _, Config) = (kani::any(), kani::any(), kani::any(), kani::any());
    let lens = Lens::of(&config);
    let foot = lens.foot(distance, offset);
    let outline = foot.map(|foot| lens.outline(foot, lens.size(size)));
    kani::cover!(outline.is_some(), "a box");
}

/// FUS-2a: the projection is exact and clipped, for the configured calibration.
#[kani::proof]
#[kani::solver(kissat)]
fn fus_2_projection_is_exact() {
    let (distance, offset, config) = (kani::any(), kani::any(), configured());
    assert!(fus_2a_projection_is_exact(distance, offset, config.object_size, &config));
    kani::cover!(Lens::of(&config).foot(distance, offset).is_some(), "before the camera");
    kani::cover!(Lens::of(&config).foot(distance, offset).is_none(), "out of range");
}

/// FUS-2a: a camera's box, for any configuration.
#[kani::proof]
fn fus_2_camera_box() {
    let (pixels, config) = (kani::any(), kani::any());
    assert!(fus_2a_camera_box_is_clipped(pixels, &config));
    kani::cover!(Lens::of(&config).seen(pixels)[0].most > 0, "a box");
}

/// FUS-3a: intersection and areas of any two boxes.
#[kani::proof]
#[kani::solver(kissat)]
fn fus_3_overlap() {
    let (first, second) = (kani::any(), kani::any());
    assert!(fus_3a_overlap_is_exact(first, second));
    assert!(fus_3a_overlap_is_symmetric(first, second));
    kani::cover!(
        supervisor_perceive::Boxed::of(first).overlap(&supervisor_perceive::Boxed::of(second)).is_some(),
        "they overlap"
    );
}

/// FUS-3a: any overlap against the configured threshold.
#[kani::proof]
fn fus_3_threshold() {
    let (overlap, share) = (Overlap { shared: kani::any(), sum: kani::any() }, configured().match_iou);
    assert!(fus_3a_threshold_by_the_sum(overlap, share));
    kani::cover!(overlap.shared < overlap.sum && overlap.exceeds(Overlap::threshold(share)), "a match");
}

/// FUS-3a: any two overlaps.
#[kani::proof]
#[kani::solver(kissat)]
fn fus_3_order() {
    let [one, other] = [(); 2].map(|()| Overlap { shared: kani::any(), sum: kani::any() });
    assert!(fus_3a_order_is_strict(one, other));
    kani::cover!(one.exceeds(other), "one is greater");
}

/// FUS-3a, FUS-3b: one radar object and one camera object, both as of now and of one age, for the configured calibration.
#[kani::proof]
#[kani::unwind(33)]
#[kani::solver(kissat)]
fn fus_3_two_match() {
    let (radar, camera, config): (RadarObject, CameraObject, _) = (kani::any(), kani::any(), configured());
    let radar = RadarObject { age: camera.age, ..radar };
    let classes = matches(std::slice::from_ref(&radar), std::slice::from_ref(&camera), &config);
    assert!(fus_3a_two_match_exactly(&radar, &camera, &config, &classes));
    kani::cover!(classes[0] == Some(Class::Pedestrian), "a pedestrian");
}

/// FUS-3a: two radar objects and two camera objects match one to one, for the configured calibration.
#[kani::proof]
#[kani::unwind(33)]
#[kani::solver(kissat)]
fn fus_3_one_to_one() {
    let (radar, camera): ([RadarObject; 2], [CameraObject; 2]) = (kani::any(), kani::any());
    let classes: [Option<Class>; MAX_RADAR] = matches(&radar, &camera, &configured());
    assert!(fus_3a_one_to_one(&radar, &camera, &classes));
    kani::cover!(classes[0].is_some() && classes[1].is_some(), "both match");
}
