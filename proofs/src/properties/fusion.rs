//! Fusion: where a radar object stands in the picture, how boxes overlap, and which objects match (FUS-2, FUS-3).

use supervisor_core::{Config, DistanceCm, Millis, OffsetCm, Percent, Pixel, RotationQ14, Row};
use supervisor_perceive::{
    Boxed, CameraObject, Class, Lens, MAX_RADAR, Outline, Overlap, PixelBox, RadarObject, STEPS, Span, moved,
};

use super::implies;

/// Both directions of an image, or one length in it, in 1/8 px.
fn steps(pixels: Pixel) -> u16 {
    pixels.raw().saturating_mul(STEPS)
}

/// One row of the rotation, its translation, and what belongs to that direction of the image.
fn axes(config: &Config) -> [([RotationQ14; 3], OffsetCm); 3] {
    let [r0, r1, r2, d0, d1, d2, a0, a1, a2] = config.camera_rotation.0;
    let [right, down, ahead] = config.camera_translation.0;
    [([r0, r1, r2], right), ([d0, d1, d2], down), ([a0, a1, a2], ahead)]
}

/// A radar object's point on the road below it, along one camera axis, in 1/2¹⁴ cm.
fn position(axis: ([RotationQ14; 3], OffsetCm), distance: DistanceCm, offset: OffsetCm, config: &Config) -> i64 {
    let ([x, y, z], shift) = axis;
    let [x, y, z] = [x, y, z].map(|element| i64::from(element.raw()));
    let point = x * i64::from(distance.raw()) + y * i64::from(offset.raw()) - z * i64::from(config.radar_height.raw());
    point + i64::from(shift.raw()) * (1 << 14)
}

/// FUS-2a: whether `edge` is ⌊u₀ + f·X/Z⌋ in 1/8 px, clipped to the image: `position` is X in 1/2¹⁴ cm, `reach` what the edge lies
/// beside the foot in 1/8 px · cm.
fn is_edge(edge: u16, position: i64, reach: i64, depth: i64, [focal, principal, image]: [i64; 3]) -> bool {
    // All of it times 2¹¹: three bits of the 14 are the steps.
    let numerator = position * focal + (principal * depth + reach) * (1 << 11);
    let (edge, divisor) = (i64::from(edge), depth * (1 << 11));
    edge * divisor <= numerator.max(0) && edge <= image && (numerator < (edge + 1) * divisor || edge == image)
}

/// FUS-2a: radar frame to camera frame, pinhole, pixels: the box of a radar object is exact, rounded down to 1/8 px and clipped to the image;
/// there is none behind the camera and beyond the range of matching.
#[must_use]
pub fn fus_2a_projection_is_exact(
    distance: DistanceCm,
    offset: OffsetCm,
    size: Row<DistanceCm, 2>,
    config: &Config,
) -> bool {
    let lens = Lens::of(config);
    let [across, down, ahead] = axes(config).map(|axis| position(axis, distance, offset, config));
    let depth = ahead >> 14;
    let Some(foot) = lens.foot(distance, offset) else {
        return depth <= 0 || depth > i64::from(config.match_range.raw());
    };
    let [columns, rows] = lens.outline(foot, lens.size(size));
    let ([focal_x, focal_y], [column, row]) = (config.focal_length.0, config.principal_point.0);
    let [width, height] = config.image_size.0;
    let directions = [(focal_x, column, width), (focal_y, row, height)];
    let [horizontal, vertical] = directions.map(|(focal, principal, image)| {
        [i64::from(focal.raw()), i64::from(steps(principal)), i64::from(steps(image))]
    });
    let [wide, tall] = size.0.map(|length| i64::from(length.raw()));
    let (half, tall) = (horizontal[0] * wide * 4, vertical[0] * tall * 8);
    depth > 0
        && depth <= i64::from(config.match_range.raw())
        && is_edge(columns.least, across, -half, depth, horizontal)
        && is_edge(columns.most, across, half, depth, horizontal)
        && is_edge(rows.least, down, -tall, depth, vertical)
        && is_edge(rows.most, down, 0, depth, vertical)
}

/// FUS-2a: a camera's box by its edges, clipped to the image as a radar's is.
#[must_use]
pub fn fus_2a_camera_box_is_clipped(pixels: PixelBox, config: &Config) -> bool {
    let [width, height] = config.image_size.0.map(|length| u32::from(steps(length)));
    let edge = |at: u16, image: u32| (u32::from(at) * u32::from(STEPS)).min(u32::from(u16::MAX)).min(image);
    let is = |span: Span, least: u16, length: u16, image: u32| {
        u32::from(span.least) == edge(least, image)
            && u32::from(span.most) == edge(least.saturating_add(length), image)
            && span.least <= span.most
    };
    let [columns, rows] = Lens::of(config).seen(pixels);
    is(columns, pixels.left, pixels.width, width) && is(rows, pixels.top, pixels.height, height)
}

/// Whether every edge lies in an image of at most 4096 px, as every configuration in its range has it.
fn in_an_image(outline: Outline) -> bool {
    outline.iter().all(|span| span.least <= span.most && span.most <= 4096 * STEPS)
}

/// FUS-3a: two boxes share their intersection, and nothing where they only touch; the order of the two does not matter.
#[must_use]
pub fn fus_3a_overlap_is_exact(first: Outline, second: Outline) -> bool {
    if !in_an_image(first) || !in_an_image(second) {
        return true;
    }
    let common = |one: Span, other: Span| {
        let (least, most) = (one.least.max(other.least), one.most.min(other.most));
        if least < most { u32::from(most - least) } else { 0 }
    };
    let area = |[columns, rows]: Outline| u32::from(columns.most - columns.least) * u32::from(rows.most - rows.least);
    let shared = common(first[0], second[0]) * common(first[1], second[1]);
    let overlap = Boxed::of(first).overlap(&Boxed::of(second));
    let expected = Overlap { shared, sum: area(first) + area(second) };
    overlap == (shared > 0).then_some(expected)
}

/// FUS-3a: two boxes overlap exactly when they have a column and a row in common, more than an edge; in whatever order.
#[must_use]
pub fn fus_3a_overlap_exactly_in_common(first: Outline, second: Outline) -> bool {
    let common = |one: Span, other: Span| one.least.max(other.least) < one.most.min(other.most);
    let both = common(first[0], second[0]) && common(first[1], second[1]);
    let (first, second) = (Boxed::of(first), Boxed::of(second));
    first.overlap(&second).is_some() == both && second.overlap(&first).is_some() == both
}

/// FUS-3a: the order of two boxes does not matter.
#[must_use]
pub fn fus_3a_overlap_is_symmetric(first: Outline, second: Outline) -> bool {
    let (first, second) = (Boxed::of(first), Boxed::of(second));
    first.overlap(&second) == second.overlap(&first)
}

/// FUS-3a: greater than the threshold means: 100 times the intersection is more than the threshold times the union, in exact products.
#[must_use]
pub fn fus_3a_threshold_is_exact(overlap: Overlap, share: Percent) -> bool {
    let (shared, sum, share_raw) = (u64::from(overlap.shared), u64::from(overlap.sum), u64::from(share.raw()));
    implies(
        shared <= sum,
        overlap.exceeds(Overlap::threshold(share)) == (shared * 100 > share_raw * sum.saturating_sub(shared)),
    )
}

/// FUS-3a: the same by the sum of both areas, of which union is what the intersection leaves: p/100 of the union are p/(100 + p) of the sum.
#[must_use]
pub fn fus_3a_threshold_by_the_sum(overlap: Overlap, share: Percent) -> bool {
    let (shared, sum, share_raw) = (u64::from(overlap.shared), u64::from(overlap.sum), u64::from(share.raw()));
    overlap.exceeds(Overlap::threshold(share)) == (shared * (share_raw + 100) > sum * share_raw)
}

/// FUS-3a: of two overlaps the greater is that of the greater intersection over union, in exact products.
#[must_use]
pub fn fus_3a_order_is_exact(one: Overlap, other: Overlap) -> bool {
    let [(shared, sum), (other_shared, other_sum)] =
        [one, other].map(|overlap| (u64::from(overlap.shared), u64::from(overlap.sum)));
    let (Some(union), Some(other_union)) = (sum.checked_sub(shared), other_sum.checked_sub(other_shared)) else {
        return true;
    };
    one.exceeds(other) == (shared * other_union > other_shared * union)
}

/// FUS-3a: no overlap exceeds itself, and of two at most one exceeds the other.
#[must_use]
pub fn fus_3a_order_is_strict(one: Overlap, other: Overlap) -> bool {
    let both = one.exceeds(other) && other.exceeds(one);
    !one.exceeds(one) && !both
}

/// The class that a matched object carries.
fn carried(class: Class) -> Class {
    match class {
        Class::Pedestrian => Class::Pedestrian,
        Class::Unclassified | Class::Object => Class::Object,
    }
}

/// FUS-3a: whether the camera's object and the radar's, brought to the time of the image, overlap more than the threshold.
fn alike(radar: &RadarObject, camera: &CameraObject, image: Millis, config: &Config) -> bool {
    let lens = Lens::of(config);
    let size = if camera.class == Class::Pedestrian { config.pedestrian_size } else { config.object_size };
    let at_the_image = moved(radar.distance, radar.closing, radar.age, image);
    let cast = lens.foot(at_the_image, radar.offset).map(|foot| lens.outline(foot, lens.size(size)));
    let overlap = cast.and_then(|cast| Boxed::of(cast).overlap(&Boxed::of(lens.seen(camera.pixels))));
    radar.age <= config.object_age
        && camera.age <= config.object_age
        && overlap.is_some_and(|overlap| overlap.exceeds(Overlap::threshold(config.match_iou)))
}

/// The time of the image: the age of the newest object that is not too old.
fn image(camera: &[CameraObject], config: &Config) -> Millis {
    camera.iter().map(|object| object.age).fold(config.object_age, Millis::min)
}

/// FUS-3a, FUS-3b: one radar object and one camera object match exactly when they overlap more than the threshold, and carry the camera's
/// class.
#[must_use]
pub fn fus_3a_two_match_exactly(
    radar: &RadarObject,
    camera: &CameraObject,
    config: &Config,
    classes: &[Option<Class>; MAX_RADAR],
) -> bool {
    let matched = alike(radar, camera, image(std::slice::from_ref(camera), config), config);
    classes[0] == matched.then_some(carried(camera.class)) && classes[1..].iter().all(Option::is_none)
}

/// FUS-3a: matches are one to one: no more radar objects are pedestrians than the camera has, and no more are things; places without a radar
/// object match nothing.
#[must_use]
pub fn fus_3a_one_to_one(radar: &[RadarObject], camera: &[CameraObject], classes: &[Option<Class>; MAX_RADAR]) -> bool {
    let seen = |class| camera.iter().filter(|object| carried(object.class) == class).count();
    let given = |class| classes.iter().filter(|given| **given == Some(class)).count();
    given(Class::Pedestrian) <= seen(Class::Pedestrian)
        && given(Class::Object) <= seen(Class::Object)
        && given(Class::Unclassified) == 0
        && classes.iter().skip(radar.len()).all(Option::is_none)
}

/// FUS-3a, FUS-3b: whatever is matched overlaps a camera's object of its class more than the threshold.
#[must_use]
pub fn fus_3a_a_match_needs_overlap(
    radar: &[RadarObject],
    camera: &[CameraObject],
    config: &Config,
    classes: &[Option<Class>; MAX_RADAR],
) -> bool {
    let image = image(camera, config);
    radar.iter().zip(classes).all(|(object, given)| {
        let fits = |of: &CameraObject| *given == Some(carried(of.class)) && alike(object, of, image, config);
        given.is_none() || camera.iter().any(fits)
    })
}

/// FUS-3a: nothing that overlaps more than the threshold stays alone for nothing: it, or the camera's object, has a match.
#[must_use]
pub fn fus_3a_no_match_is_missed(
    radar: &[RadarObject],
    camera: &[CameraObject],
    config: &Config,
    classes: &[Option<Class>; MAX_RADAR],
) -> bool {
    let image = image(camera, config);
    let any_alike = radar.iter().any(|object| camera.iter().any(|of| alike(object, of, image, config)));
    implies(any_alike, classes.iter().any(Option::is_some))
}
