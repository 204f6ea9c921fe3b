//! How well the assumed sizes and the threshold fit things of true size, near and far, and a camera out of true (FUS-3a).
//!
//! The tables print with `cargo test -p supervisor-tests --test fusion_sizes -- --nocapture`; what they show is asserted.

mod common;
use common::*;
use supervisor_perceive::{Boxed, Lens, matches};
use supervisor_tests::bend::Pose;
use supervisor_tests::number::kmh as metres_per_second;
use supervisor_tests::plant::Parameters;
use supervisor_tests::road::{Body, Camera, Obstacle};
use supervisor_tests::sensing::Eyes;

const BODIES: [(&str, Body); 4] =
    [("car", Body::CAR), ("bus", Body::BUS), ("pedestrian", Body::PEDESTRIAN), ("cyclist", Body::CYCLIST)];

/// Intersection over union in per cent, by this camera at this gap in m; `None` where nothing overlaps.
fn share(body: &Body, gap: u16, camera: Camera) -> Option<f64> {
    let config = Config::DEFAULT;
    let lens = Lens::of(&config);
    let size = if body.class == Class::Pedestrian { config.pedestrian_size } else { config.object_size };
    let foot = lens.foot(DistanceCm::new(gap * 100), OffsetCm::ZERO)?;
    let cast = Boxed::of(lens.outline(foot, lens.size(size)));
    let seen = Boxed::of(lens.seen(camera.pixels(body, f64::from(gap), 0.0)?));
    let overlap = cast.overlap(&seen)?;
    Some(100.0 * f64::from(overlap.shared) / f64::from(overlap.sum - overlap.shared))
}

fn cell(share: Option<f64>) -> String {
    share.map_or("   –".to_owned(), |share| format!("{share:4.0}"))
}

/// FUS-3a: the default sizes and 30 % match every body from 5 to 100 m; the bus, whose true size is farthest off, has
/// the least to spare: 49 %. (With the size of a car assumed it would be 33 %.)
#[test]
fn the_default_sizes_match_every_body() {
    const GAPS: [u16; 8] = [5, 10, 15, 20, 30, 50, 80, 100];
    println!("intersection over union in %, by gap in m");
    println!("{:12}{}", "", GAPS.map(|gap| format!("{gap:5}")).concat());
    for (name, body) in BODIES {
        let shares = GAPS.map(|gap| share(&body, gap, Camera::STRAIGHT));
        println!("{name:12}{}", shares.map(|share| format!(" {}", cell(share))).concat());
        let least = shares.iter().flatten().copied().fold(f64::MAX, f64::min);
        assert!(shares.iter().all(Option::is_some) && least > 48.0, "{name}: {least}");
    }
}

/// FUS-3a: what a camera out of true loses. Half a degree moves a box at 50 m by 0.44 m: vehicles keep their match, a
/// pedestrian, 12 pixels wide there, keeps it up and down but not to the side; a degree is too much for most. What is
/// lost there matches nearer (second table), and until then waits for its updates (FUS-3c).
#[test]
fn a_camera_out_of_true_loses_what_the_table_says() {
    const NAMES: [&str; 8] =
        ["yaw -1.0", "yaw -0.5", "yaw +0.5", "yaw +1.0", "pitch -1.0", "pitch -0.5", "pitch +0.5", "pitch +1.0"];
    const TURNS: [f64; 4] = [-1.0, -0.5, 0.5, 1.0];
    let cameras: Vec<_> = (TURNS.iter().map(|yaw| Camera { yaw: *yaw, ..Camera::STRAIGHT }))
        .chain(TURNS.iter().map(|pitch| Camera { pitch: *pitch, ..Camera::STRAIGHT }))
        .collect();
    let header = format!("{:12}{}", "", BODIES.map(|(name, _)| format!("{name:>12}")).concat());
    println!("intersection over union in % at 50 m, camera turned by degrees\n{header}");
    let mut held = Vec::new();
    for (name, camera) in NAMES.iter().zip(&cameras) {
        let shares = BODIES.map(|(_, body)| share(&body, 50, *camera));
        println!("{name:12}{}", shares.map(|share| format!("{:>12}", cell(share))).concat());
        held.push(shares.map(|share| share.is_some_and(|share| share > 30.0)));
    }
    // Car, bus, pedestrian, cyclist.
    let yaw = [[false, false, false, false], [true, true, false, false]];
    let pitch = [[false, true, true, false], [true; 4], [true; 4], [true, false, true, false]];
    assert_eq!(held, [yaw[0], yaw[1], yaw[1], yaw[0], pitch[0], pitch[1], pitch[2], pitch[3]]);

    println!("matched up to so many m\n{header}");
    for (name, camera) in NAMES.iter().zip(&cameras) {
        let reach = BODIES.map(|(_, body)| {
            (5..=100)
                .take_while(|gap| share(&body, *gap, *camera).is_some_and(|share| share > 30.0))
                .last()
                .unwrap_or(0)
        });
        println!("{name:12}{}", reach.map(|gap| format!("{gap:>12}")).concat());
        let [vehicles, walkers] = [reach[0].min(reach[1]), reach[2].min(reach[3])];
        assert!(vehicles >= 30 && walkers >= 14, "{name}: {reach:?}");
    }
}

/// FUS-1a, FUS-3b: closed loop: driving up to each body at 50 km/h, with radar and camera at their own rates, every
/// object is matched as what it is in every cycle in which both see it, from 80 m to 3 m.
#[test]
fn the_bus_matches_what_it_drives_up_to() {
    let speed = metres_per_second(50.0);
    for (name, body) in BODIES {
        for (offset, lead) in [(0.0, 0.0), (1.0, 0.0), (-1.5, 0.0), (0.5, 5.0)] {
            let obstacle = Obstacle { body, offset, speed: lead, ..Obstacle::standing_car(90.0) };
            let road = [obstacle];
            let mut eyes = Eyes::new(road.len());
            let (mut judged, mut apart) = (0_u32, 0_u32);
            for now_ms in 0..9_000_u32 {
                let front = speed * f64::from(now_ms) / 1000.0;
                let gap = obstacle.rear(now_ms) - front;
                let pose = Pose { front, speed, curvature: 0.0, bends: &[] };
                eyes.sample(now_ms, &road, &pose, &Parameters::DEFAULT);
                let scene = eyes.scene(now_ms);
                if !now_ms.is_multiple_of(10) || scene.camera.is_empty() || gap < 3.0 {
                    continue;
                }
                let [radar, camera] = [scene.radar[0].age, scene.camera[0].age];
                apart += u32::from(radar != camera);
                judged += 1;
                let class = matches(&scene.radar, &scene.camera, &Config::DEFAULT)[0];
                assert_eq!(class, Some(body.class), "{name} {offset} at {gap} m, ages {radar:?} {camera:?}");
            }
            assert!(judged > 300 && apart > 100, "{judged} cycles, {apart} of them with two times");
        }
    }
}
