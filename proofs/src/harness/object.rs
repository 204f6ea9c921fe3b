//! Perception, object by object, and its fold over a list (TTC, MIT, FUS-3, FCW, PCW).
//!
//! Any object, class and age; any limits but the times to collision, unless a harness says `configured`. `perceive` folds its lists by `merge`:
//! what is proved of one object, of the empty list, of lists of one and of the merge of *any* two assessments holds by
//! induction for every list.

use supervisor_core::{Closing, Config, Level, Millis};
use supervisor_perceive::{
    Assessment, CameraObject, Class, RadarObject, Scene, camera_object, merge, perceive, radar_object, reached_or_equal,
};

use super::configured::{any_limits, configured};
use crate::properties::object::{
    Sight, fcw_1_forward_warning, fcw_1_threat_says_what_was_merged, fus_1a_moved_is_exact,
    fus_3c_only_a_valid_obstacle_obliges, fus_3d_any_object_permits, fus_3d_camera_only_permits, fus_3e_one_corridor,
    mit_1_level_is_that_of_the_time, mit_6a_most_severe_decides, mit_6a_order_does_not_matter,
    mit_6c_required_is_exact, mit_8b_disagreement_is_reported, mit_8d_more_severe_decides, pcw_1_pedestrian_warning,
    ttc_1_level_is_monotone, ttc_1_products_are_exact,
};

/// TTC-1: any distance, closing speed and limit.
#[kani::proof]
#[kani::solver(kissat)]
fn ttc_1_products() {
    let (distance, closing, limit) = (kani::any(), kani::any(), kani::any());
    assert!(ttc_1_products_are_exact(distance, closing, limit));
    kani::cover!(
        reached_or_equal(distance, closing, limit) && !supervisor_perceive::reached(distance, closing, limit),
        "exactly at a limit"
    );
}

/// FUS-1: any distance, closing speed and age.
#[kani::proof]
#[kani::solver(kissat)]
fn fus_1_moved() {
    let (distance, closing, age) = (kani::any(), kani::any(), kani::any());
    assert!(fus_1a_moved_is_exact(distance, closing, age));
    kani::cover!(age > Millis::new(40_000) && closing > supervisor_core::ClosingCmS::ZERO, "very old");
}

/// TTC-1, MIT-1 to MIT-3, FUS-3: the level, what is valid, the corridor.
#[kani::proof]
fn mit_1_level() {
    let (object, class, config): (RadarObject, Option<Class>, Config) = (kani::any(), kani::any(), any_limits());
    let sight = Sight::of(&object, class, &config);
    assert!(mit_1_level_is_that_of_the_time(&sight));
    assert!(fus_3c_only_a_valid_obstacle_obliges(&sight));
    assert!(fus_3e_one_corridor(&sight));
    kani::cover!(sight.assessed.level == Level::One, "level 1");
    kani::cover!(sight.assessed.level == Level::Two, "level 2");
    kani::cover!(sight.assessed.level == Level::Three && class.is_none(), "level 3 by the radar alone");
    kani::cover!(!sight.valid() && sight.assessed.closing, "closing and not valid");
}

/// FCW-1, PCW-1.
#[kani::proof]
fn fcw_1_warnings() {
    let (object, class, config): (RadarObject, Option<Class>, Config) = (kani::any(), kani::any(), any_limits());
    let sight = Sight::of(&object, class, &config);
    assert!(fcw_1_forward_warning(&sight));
    assert!(pcw_1_pedestrian_warning(&sight));
    kani::cover!(sight.assessed.forward_begins, "an object");
    kani::cover!(sight.assessed.pedestrian_begins && !sight.valid(), "a pedestrian beside the corridor");
    kani::cover!(sight.assessed.forward_holds && !sight.assessed.forward_begins, "between on and off");
}

/// MIT-8, FUS-3d: what is permitted, what is reported.
#[kani::proof]
fn mit_8_second_opinion() {
    let (object, class, config): (RadarObject, Option<Class>, Config) = (kani::any(), kani::any(), any_limits());
    let sight = Sight::of(&object, class, &config);
    assert!(mit_8d_more_severe_decides(&sight));
    assert!(mit_8b_disagreement_is_reported(&sight));
    kani::cover!(sight.assessed.disagreement && sight.assessed.level == Level::None, "severe, and no level");
    kani::cover!(sight.assessed.disagreement && sight.assessed.level == Level::Three, "level 3, and mild");
    kani::cover!(sight.assessed.emergency && !sight.valid(), "an object that is not valid permits");
}

/// MIT-8a, FUS-3d: v² ≥ 2·a·gap, of any radar object as of now, for the configured limits.
#[kani::proof]
#[kani::solver(kissat)]
fn mit_8_severe_is_exact() {
    let (object, class, config) = (RadarObject { age: Millis::ZERO, ..kani::any() }, kani::any(), configured());
    let sight = Sight::of(&object, class, &config);
    assert!(fus_3d_any_object_permits(&sight));
    kani::cover!(sight.assessed.mitigable && !sight.assessed.emergency, "mitigation only");
}

/// FUS-3d: the same of any camera object as of now.
#[kani::proof]
#[kani::solver(kissat)]
fn fus_3d_camera() {
    let (object, config) = (CameraObject { age: Millis::ZERO, ..kani::any() }, configured());
    assert!(fus_3d_camera_only_permits(&object, &config));
    kani::cover!(camera_object(&object, &config).emergency, "the full cap");
}

/// MIT-6c: the required deceleration is exact, for the configured margin, of any object as of now.
#[kani::proof]
#[kani::solver(kissat)]
fn mit_6c_required() {
    let (object, class, config) = (RadarObject { age: Millis::ZERO, ..kani::any() }, kani::any(), configured());
    let sight = Sight::of(&object, class, &config);
    assert!(mit_6c_required_is_exact(&sight));
    kani::cover!(sight.assessed.required == supervisor_core::DecelMs2Q11::new(7_168), "just severe");
}

/// TTC-1, FUS-3c: nearer and faster is never less severe, for the configured limits, of any objects as of now.
#[kani::proof]
#[kani::solver(kissat)]
fn ttc_1_monotone() {
    let (object, config) = (RadarObject { age: Millis::ZERO, ..kani::any() }, configured());
    let class = kani::any();
    let worse = RadarObject { distance: kani::any(), closing: kani::any(), ..object };
    let (sight, worse) = (Sight::of(&object, class, &config), Sight::of(&worse, class, &config));
    assert!(ttc_1_level_is_monotone(&sight, &worse));
    kani::cover!(sight.assessed.level == Level::One && worse.assessed.level == Level::Three, "from level 1 to level 3");
}

/// MIT-6: the merge of any assessments.
#[kani::proof]
fn mit_6_merge() {
    let (one, two, three): (Assessment, Assessment, Assessment) = (kani::any(), kani::any(), kani::any());
    assert!(mit_6a_most_severe_decides(one, two));
    assert!(mit_6a_order_does_not_matter(one, two, three));
    kani::cover!(
        one.object.zip(two.object).is_some_and(|(near, far)| near.distance < far.distance)
            && merge(one, two).object == two.object,
        "the farther one decides"
    );
}

/// RULE-1, FCW-1b: the threat of anything merged.
#[kani::proof]
fn fcw_1_threat() {
    let (merged, known): (Assessment, bool) = (kani::any(), kani::any());
    assert!(fcw_1_threat_says_what_was_merged(merged, known));
    kani::cover!(merged.threat(known).closing == Closing::Unknown, "unknown");
}

/// MIT-6a, MIT-7a, RULE-1a: the fold of lists of none and of one, whatever perception knows: what is too old or comes from a lost sensor
/// obliges and permits nothing.
#[kani::proof]
#[kani::unwind(33)]
fn mit_6_fold() {
    let (object, config): (RadarObject, Config) = (kani::any(), any_limits());
    let mut scene = Scene { radar_known: kani::any(), camera_known: kani::any(), ..Scene::default() };
    let both = scene.radar_known && scene.camera_known;
    assert!(perceive(&scene, &config) == Assessment::NOTHING.threat(both));
    assert!(scene.radar.push(object).is_ok());
    let young = object.age <= config.object_age;
    let one = if scene.radar_known && young { radar_object(&object, None, &config) } else { Assessment::NOTHING };
    assert!(perceive(&scene, &config) == merge(Assessment::NOTHING, one).threat(both && (young || !scene.radar_known)));
    kani::cover!(both && young && one.level == Level::Three, "level 3");
}
