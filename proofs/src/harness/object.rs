//! Perception, object by object, and its fold over a list (TTC, MIT, FUS-3, FCW, PCW).
//!
//! Any object, class, age and limits. What multiplies is *any* function here; that the comparison of times is exact is the
//! first harness, that the needed deceleration is exact the matter of its contract (`proofs/creusot`).
//! `perceive` folds its lists by `merge`: what is proved of one object, of the empty list, of lists of one and of the merge of
//! *any* two assessments holds by induction for every list.

use supervisor_core::{Closing, ClosingCmS, Config, Level};
use supervisor_perceive::{
    Assessment, CameraObject, Class, RadarObject, Scene, camera_object, merge, perceive, radar_object, reached,
    reached_or_equal,
};

use super::configured::any_limits;
use crate::properties::object::{
    Sight, fcw_1_forward_warning, fcw_1_threat_says_what_was_merged, fus_3c_only_a_valid_obstacle_obliges,
    fus_3d_any_object_permits_by_need, fus_3d_camera_permits_by_need, fus_3e_one_corridor,
    mit_1_level_is_that_of_the_time, mit_6a_most_severe_decides, mit_6a_order_does_not_matter,
    mit_8b_disagreement_is_reported, mit_8d_more_severe_decides, pcw_1_pedestrian_warning,
    ttc_1_only_what_closes_has_a_time,
};

/// TTC-1: any distance, closing speed and limit, for any comparison of products. That the kernel's are exact is its contract, and the
/// property `ttc_1_products_are_exact` of the tests.
#[kani::proof]
#[kani::stub(supervisor_core::kernel::nearer_than, crate::harness::uninterpreted::nearer_than)]
#[kani::stub(supervisor_core::kernel::farther_than, crate::harness::uninterpreted::farther_than)]
fn ttc_1_times() {
    let (distance, closing, limit) = (kani::any(), kani::any(), kani::any());
    assert!(ttc_1_only_what_closes_has_a_time(distance, closing, limit));
    let (below, at_most) = (reached(distance, closing, limit), reached_or_equal(distance, closing, limit));
    kani::cover!(at_most && !below, "exactly at a limit");
}

/// SELF-1: the assessment of any object is total, with the real arithmetic.
#[kani::proof]
fn self_1_objects_are_total() {
    let config = any_limits();
    let radar = radar_object(&kani::any(), kani::any(), &config);
    let camera = camera_object(&kani::any(), &config);
    kani::cover!(radar.closing && !camera.closing, "an object in the corridor closes");
}

/// MIT-1 to MIT-3, MIT-8, FUS-3: one radar object.
#[kani::proof]
#[kani::unwind(17)]
#[kani::stub(supervisor_core::kernel::nearer_than, crate::harness::uninterpreted::nearer_than)]
#[kani::stub(supervisor_core::kernel::farther_than, crate::harness::uninterpreted::farther_than)]
#[kani::stub(supervisor_core::kernel::needed, crate::harness::uninterpreted::needed)]
#[kani::stub(supervisor_perceive::moved, crate::harness::uninterpreted::moved)]
fn mit_1_one_object() {
    let (object, class, config): (RadarObject, Option<Class>, Config) = (kani::any(), kani::any(), any_limits());
    let sight = Sight::of(&object, class, &config);
    assert!(mit_1_level_is_that_of_the_time(&sight));
    assert!(fus_3c_only_a_valid_obstacle_obliges(&sight));
    assert!(fus_3e_one_corridor(&sight));
    assert!(mit_8d_more_severe_decides(&sight));
    assert!(mit_8b_disagreement_is_reported(&sight));
    kani::cover!(sight.assessed.level == Level::One, "level 1");
    kani::cover!(sight.assessed.level == Level::Two, "level 2");
    kani::cover!(sight.assessed.level == Level::Three && class.is_none(), "level 3 by the radar alone");
    kani::cover!(!sight.valid() && sight.assessed.closing, "closing and not valid");
    kani::cover!(sight.assessed.disagreement && sight.assessed.level == Level::None, "severe, and no level");
}

/// FUS-3d, MIT-6c, MIT-8, FCW-1, PCW-1: one radar object, what it permits and warns of.
#[kani::proof]
#[kani::unwind(17)]
#[kani::stub(supervisor_core::kernel::nearer_than, crate::harness::uninterpreted::nearer_than)]
#[kani::stub(supervisor_core::kernel::farther_than, crate::harness::uninterpreted::farther_than)]
#[kani::stub(supervisor_core::kernel::needed, crate::harness::uninterpreted::needed)]
#[kani::stub(supervisor_perceive::moved, crate::harness::uninterpreted::moved)]
fn fus_3d_one_object() {
    let (object, class, config): (RadarObject, Option<Class>, Config) = (kani::any(), kani::any(), any_limits());
    let sight = Sight::of(&object, class, &config);
    assert!(fus_3d_any_object_permits_by_need(&sight));
    assert!(fcw_1_forward_warning(&sight));
    assert!(pcw_1_pedestrian_warning(&sight));
    kani::cover!(sight.assessed.emergency && !sight.valid(), "an object that is not valid permits");
    kani::cover!(sight.assessed.forward_begins, "an object");
    kani::cover!(sight.assessed.pedestrian_begins && !sight.valid(), "a pedestrian beside the corridor");
    kani::cover!(sight.assessed.forward_holds && !sight.assessed.forward_begins, "between on and off");
}

/// FUS-3d: one camera object.
#[kani::proof]
#[kani::unwind(17)]
#[kani::stub(supervisor_core::kernel::nearer_than, crate::harness::uninterpreted::nearer_than)]
#[kani::stub(supervisor_core::kernel::farther_than, crate::harness::uninterpreted::farther_than)]
#[kani::stub(supervisor_core::kernel::needed, crate::harness::uninterpreted::needed)]
#[kani::stub(supervisor_perceive::moved, crate::harness::uninterpreted::moved)]
fn fus_3d_camera() {
    let (object, config): (CameraObject, Config) = (kani::any(), any_limits());
    assert!(fus_3d_camera_permits_by_need(&object, &config));
    kani::cover!(camera_object(&object, &config).emergency, "the full cap");
}

/// MIT-6: the merge of any assessments.
#[kani::proof]
fn mit_6_merge() {
    let (one, two, three): (Assessment, Assessment, Assessment) = (kani::any(), kani::any(), kani::any());
    assert!(mit_6a_most_severe_decides(one, two));
    assert!(mit_6a_order_does_not_matter(one, two, three));
    let nearer = one.worst.zip(two.worst).is_some_and(|(near, far)| near.object.distance < far.object.distance);
    kani::cover!(nearer && merge(one, two).worst == two.worst, "the farther one decides");
}

/// RULE-1, FCW-1b: the threat of anything merged.
#[kani::proof]
fn fcw_1_threat() {
    let (merged, known): (Assessment, bool) = (kani::any(), kani::any());
    assert!(fcw_1_threat_says_what_was_merged(merged, known));
    kani::cover!(merged.threat(known).closing == Closing::Unknown, "unknown");
}
