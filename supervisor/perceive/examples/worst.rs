//! Full lists for counting the instructions of `perceive`, whose calls take the bulk of this program:
//!
//! ```text
//! cargo build --release -p supervisor-perceive --example worst
//! valgrind --tool=callgrind --toggle-collect='*measured*' target/release/examples/worst same
//! ```
//! Divide by the number of calls it prints. `same`: every pair matches, each better than the one before; `near`: every pair overlaps and none matches;
//! `apart`: no pair overlaps; `empty`: no object.

use std::hint::black_box;

use supervisor_core::{ClosingCmS, Config, Count, DistanceCm, Millis, OffsetCm, Threat};
use supervisor_perceive::{CameraObject, Class, MAX_CAMERA, MAX_RADAR, PixelBox, RadarObject, Scene, perceive};

/// The call that is counted.
#[inline(never)]
fn measured(scene: &Scene, config: &Config) -> Threat {
    perceive(black_box(scene), black_box(config))
}

/// Full lists: a car 30 m ahead, seen so often, and boxes of this place and size.
fn full(pixels: impl Fn(u16) -> PixelBox) -> Scene {
    let mut scene = Scene::clear();
    for index in 0..u16::try_from(MAX_RADAR).unwrap_or(0) {
        let object = RadarObject {
            distance: DistanceCm::new(3_128_u16.saturating_sub(index.saturating_mul(4))),
            offset: OffsetCm::ZERO,
            closing: ClosingCmS::new(1_000),
            age: Millis::new(15),
            updates: Count::new(index.to_le_bytes()[0]),
        };
        scene.radar.push(object).unwrap_or(());
    }
    for index in 0..u16::try_from(MAX_CAMERA).unwrap_or(0) {
        let object = CameraObject {
            pixels: pixels(index),
            class: if index.is_multiple_of(2) { Class::Object } else { Class::Pedestrian },
            distance: DistanceCm::new(3_000),
            closing: ClosingCmS::new(1_000),
            age: Millis::new(u32::from(index)),
        };
        scene.camera.push(object).unwrap_or(());
    }
    scene
}

fn main() {
    const CALLS: u32 = 100;
    // An object's projected box has 79 by 79 pixels from column 600, row 348; a pedestrian's 20 by 67 from 630, 360.
    let scene = match std::env::args().nth(1).as_deref() {
        Some("same") => full(|index| {
            if index.is_multiple_of(2) {
                PixelBox { left: 600, top: 348, width: 79, height: 79 }
            } else {
                PixelBox { left: 630, top: 360, width: 20, height: 67 }
            }
        }),
        Some("near") => full(|_| PixelBox { left: 635, top: 400, width: 90, height: 90 }),
        Some("apart") => full(|index| PixelBox { left: index.saturating_mul(30), top: 368, width: 20, height: 59 }),
        _ => Scene::clear(),
    };
    let mut threat = Threat::UNKNOWN;
    for _ in 0..CALLS {
        threat = measured(&scene, &Config::DEFAULT);
    }
    println!("{CALLS} calls, the last one: {threat:?}");
}
