//! Fusion: the picture of any object, the overlap of any boxes (FUS-2, FUS-3).
//!
//! Areas, thresholds and matches multiply symbolic numbers: they are tested, not proved (`proofs/tests/fusion.rs`).

use supervisor_core::Config;
use supervisor_perceive::{Boxed, Lens};

use crate::properties::fusion::{fus_2a_camera_box_is_clipped, fus_3a_overlap_exactly_in_common};

/// FUS-2: the projection is total, for any object and any configuration.
#[kani::proof]
fn fus_2_projection_is_total() {
    let (distance, offset, size, config): (_, _, _, Config) = (kani::any(), kani::any(), kani::any(), kani::any());
    let lens = Lens::of(&config);
    let foot = lens.foot(distance, offset);
    let outline = foot.map(|foot| lens.outline(foot, lens.size(size)));
    kani::cover!(outline.is_some(), "a box");
}

/// FUS-2a: a camera's box, for any configuration.
#[kani::proof]
fn fus_2_camera_box() {
    let (pixels, config) = (kani::any(), kani::any());
    assert!(fus_2a_camera_box_is_clipped(pixels, &config));
    kani::cover!(Lens::of(&config).seen(pixels)[0].most > 0, "a box");
}

/// FUS-3a: any two boxes; their areas are tested.
#[kani::proof]
fn fus_3_overlap() {
    let (first, second) = (kani::any(), kani::any());
    assert!(fus_3a_overlap_exactly_in_common(first, second));
    kani::cover!(Boxed::of(first).overlap(&Boxed::of(second)).is_some(), "they overlap");
}
