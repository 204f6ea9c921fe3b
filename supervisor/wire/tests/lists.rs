//! Object lists: complete, or not used; their ages.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

mod common;

use common::*;
use supervisor_core::*;
use supervisor_perceive::Scene;
use supervisor_wire::*;

const RADAR: [Message; 2] = [Message::RadarPosition, Message::RadarMotion];
const CAMERA: [Message; 3] = [Message::CameraObject, Message::CameraCorner, Message::CameraSize];

/// The frames of a scene's lists, as the `number`-th update.
fn frames(scene: &Scene, number: u32) -> Vec<Frame> {
    let (mut sender, mut frames) = (Sender::new(), Vec::new());
    for time in 0..=number {
        frames.clear();
        sender.encode_inputs(ms(time * 50), &Inputs::NEVER, scene, &mut |frame| {
            if RADAR.iter().chain(&CAMERA).any(|message| message.id() == frame.id) {
                frames.push(frame);
            }
        });
    }
    frames
}

fn scene(radar: usize, camera: usize) -> Scene {
    let mut random = Random::new(9);
    let mut scene = Scene::clear();
    (0..radar).for_each(|_| scene.radar.push(random.radar()).unwrap());
    (0..camera).for_each(|_| scene.camera.push(random.camera()).unwrap());
    scene
}

fn receive(receiver: &mut Receiver, now: u32, frames: &[Frame]) {
    for frame in frames {
        let _ = receiver.accept(ms(now), frame);
    }
}

/// CMD-1d: every length of both lists, 0 included, comes out as it went in.
#[test]
fn every_length() {
    for length in 0..=32 {
        let scene = scene(length, length.min(16));
        let mut receiver = Receiver::new(&at_once());
        receive(&mut receiver, 0, &frames(&scene, 0));
        assert_eq!(*receiver.sample(ms(0)).scene, scene, "{length}");
    }
}

/// RULE-1a: with any one frame of a list missing, the list is not used; the other list is.
#[test]
fn any_frame_missing() {
    let scene = scene(3, 2);
    let all = frames(&scene, 0);
    assert_eq!(all.len(), 3 * 2 + 2 * 3);
    for missing in 0..all.len() {
        let mut receiver = Receiver::new(&at_once());
        let mut some = all.clone();
        some.remove(missing);
        receive(&mut receiver, 0, &some);
        let seen = receiver.sample(ms(0)).scene;
        assert_eq!((seen.radar_known, seen.camera_known), (missing >= 6, missing < 6), "{missing}");
        assert_eq!((seen.radar.len(), seen.camera.len()), if missing >= 6 { (3, 0) } else { (0, 2) });
    }
}

/// CMD-1d: the parts of a list may come in any order of the messages, as CAN controllers send them.
#[test]
fn by_message() {
    let scene = scene(5, 5);
    let mut sorted = frames(&scene, 0);
    sorted.sort_by_key(|frame| std::cmp::Reverse(frame.id));
    let mut receiver = Receiver::new(&at_once());
    receive(&mut receiver, 0, &sorted);
    assert_eq!(*receiver.sample(ms(0)).scene, scene);
}

/// RULE-1a: halves of two updates never make a whole one: what is missing of the first is not filled by the second.
#[test]
fn no_mixture() {
    let scene = scene(2, 0);
    for kept in 0..4 {
        let mut receiver = Receiver::new(&at_once());
        for message in [Message::CameraObject, Message::CameraCorner, Message::CameraSize] {
            assert!(frames(&scene, 0).iter().any(|frame| frame.id == message.id()));
        }
        let radar = |number| {
            let of_radar = |frame: &Frame| RADAR.iter().any(|message| message.id() == frame.id);
            frames(&scene, number).into_iter().filter(of_radar).collect::<Vec<_>>()
        };
        receive(&mut receiver, 0, &radar(0)[..kept]);
        receive(&mut receiver, 50, &radar(1)[kept..]);
        let seen = receiver.sample(ms(50)).scene.radar_known;
        assert_eq!(seen, kept == 0, "{kept}");
    }
}

/// RULE-1a: four updates later the cycle has come round; the remains are too old by then to be completed.
#[test]
fn cycle_comes_round() {
    let scene = scene(2, 2);
    for (now, known) in [(125, true), (126, false)] {
        let mut receiver = Receiver::new(&at_once());
        let first = frames(&scene, 0);
        // The counters of the remains go on from the first part, so that only the list can tell.
        let remains = |half: bool| {
            first.iter().filter(move |frame| {
                let index = if frame.id == Message::CameraCorner.id() {
                    bits(frame.payload(), 14, 4)
                } else {
                    bits(frame.payload(), 16, 4)
                };
                (index == 0) == half
            })
        };
        for frame in remains(true) {
            receiver.accept(ms(0), frame).unwrap();
        }
        // Something good in between, so that there is no gap: the first object once more.
        for frame in remains(true) {
            let message = Message::ALL.iter().copied().find(|message| message.id() == frame.id).unwrap();
            receiver.accept(ms(60), &resealed(message, frame, 1)).unwrap();
        }
        for frame in remains(false) {
            let message = Message::ALL.iter().copied().find(|message| message.id() == frame.id).unwrap();
            receiver.accept(ms(now), &resealed(message, frame, 2)).unwrap();
        }
        let seen = receiver.sample(ms(now)).scene;
        assert_eq!((seen.radar_known, seen.camera_known), (known, known), "{now}");
    }
}

/// RULE-1a: a whole list repeated with the same cycle begins anew: the old objects do not complete it.
#[test]
fn no_remains_of_a_whole_list() {
    let scene = scene(2, 2);
    let mut receiver = Receiver::new(&at_once());
    receive(&mut receiver, 0, &frames(&scene, 0));
    // The same cycle, four updates later; only the first object comes.
    let mut other = scene.clone();
    for object in &mut other.radar {
        object.distance = DistanceCm::new(1);
    }
    for object in &mut other.camera {
        object.distance = DistanceCm::new(1);
    }
    for frame in frames(&other, 0) {
        let message = Message::ALL.iter().copied().find(|message| message.id() == frame.id).unwrap();
        let index =
            if message == Message::CameraCorner { bits(frame.payload(), 14, 4) } else { bits(frame.payload(), 16, 4) };
        if index == 0 {
            receiver.accept(ms(10), &resealed(message, &frame, 2)).unwrap();
        }
    }
    let seen = receiver.sample(ms(10)).scene;
    assert_eq!(seen.radar[0].distance, scene.radar[0].distance);
    assert_eq!(seen.camera[0].distance, scene.camera[0].distance);
}

/// RULE-1a: a list grows old: known up to the time-out after its first frame, then not; ages grow with every cycle and
/// do not overflow.
#[test]
fn ages() {
    let mut scene = scene(2, 2);
    scene.radar[0].age = ms(40);
    scene.radar[1].age = ms(511);
    scene.camera[0].age = ms(510);
    scene.camera[1].age = ms(100_000);
    let mut receiver = Receiver::new(&at_once());
    let sent = frames(&scene, 0);
    receive(&mut receiver, 0, &sent[..6]);
    receive(&mut receiver, 5, &sent[6..]);
    let ages = |receiver: &mut Receiver, now| {
        let scene = receiver.sample(ms(now)).scene;
        let ages = [scene.radar[0].age, scene.radar[1].age, scene.camera[0].age, scene.camera[1].age];
        (ages.map(Millis::raw), scene.radar_known, scene.camera_known)
    };
    // The radar's list was begun and complete at 0, the camera's begun at 0 and complete at 5.
    assert_eq!(ages(&mut receiver, 10), ([50, u32::MAX, 520, u32::MAX], true, true));
    assert_eq!(ages(&mut receiver, 20), ([60, u32::MAX, 530, u32::MAX], true, true));
    assert_eq!(ages(&mut receiver, 125), ([165, u32::MAX, 635, u32::MAX], true, true));
    assert_eq!(ages(&mut receiver, 126), ([166, u32::MAX, 636, u32::MAX], false, false));
    assert!(!ages(&mut receiver, 125).1, "lost is lost, also if the clock steps back");
}

/// RULE-5a, RULE-1a: a sensor that says "not available" is lost at once, and back with its next whole list.
#[test]
fn sensor_lost() {
    let good = scene(1, 1);
    let mut bench = Bench::new(&at_once());
    bench.send(&Inputs::NEVER, &good, &Commands::ABSENT);
    let seen = bench.receiver.sample(bench.now).scene;
    assert!(seen.radar_known && seen.camera_known);
    bench.pass(50);
    bench.send(&Inputs::NEVER, &Scene { radar_known: false, ..good.clone() }, &Commands::ABSENT);
    let seen = bench.receiver.sample(bench.now).scene;
    assert!(!seen.radar_known && seen.camera_known);
    bench.pass(50);
    bench.send(&Inputs::NEVER, &Scene { camera_known: false, ..good.clone() }, &Commands::ABSENT);
    let seen = bench.receiver.sample(bench.now).scene;
    assert!(seen.radar_known && !seen.camera_known);
    assert_eq!((seen.radar.len(), seen.camera.len()), (1, 1));
}

/// RULE-5a: a failed frame of a list makes the sensor unknown at once, whichever part it is.
#[test]
fn failed_frame() {
    for message in RADAR.into_iter().chain(CAMERA) {
        let mut receiver = Receiver::new(&at_once());
        receive(&mut receiver, 0, &frames(&scene(1, 1), 0));
        assert!(receiver.accept(ms(10), &Frame::new(message.id(), 0)).is_err());
        let seen = receiver.sample(ms(10)).scene;
        let of_radar = RADAR.contains(&message);
        assert_eq!((seen.radar_known, seen.camera_known), (!of_radar, of_radar));
    }
}

/// E2E-1j: after a gap the lists requalify as every input does.
#[test]
fn requalify() {
    let mut bench = Bench::new(&Config::DEFAULT);
    let scene = scene(2, 1);
    for cycle in 0..150_u32 {
        bench.send(&Inputs::NEVER, &scene, &Commands::ABSENT);
        let seen = bench.receiver.sample(bench.now).scene;
        // The first interval of a message is shortened, so the second known list may come up to 50 ms early.
        if cycle < 100 {
            assert!(!seen.radar_known && !seen.camera_known, "{cycle}");
        }
        if cycle >= 106 {
            assert!(seen.radar_known && seen.camera_known, "{cycle}");
        }
        bench.pass(10);
    }
}

/// CMD-1b: an index beyond the list, a list too long, or an object in an empty list is refused.
#[test]
fn misfits() {
    let scene = scene(1, 1);
    for frame in frames(&scene, 0) {
        let message = Message::ALL.iter().copied().find(|message| message.id() == frame.id).unwrap();
        let place = |name| message.signals().iter().find(|signal| signal.name == name).unwrap();
        let (index, length) = (place("Index"), place("Length"));
        let longest = if RADAR.contains(&message) { 32 } else { 16 };
        for count in 0..1_u64 << length.width {
            for number in 0..1_u64 << index.width {
                for empty in [false, true] {
                    let mut payload = with_bits(frame.payload(), index.start, index.width, number);
                    payload = with_bits(payload, length.start, length.width, count);
                    for signal in message
                        .signals()
                        .iter()
                        .filter(|signal| empty && !["Cycle", "Index", "Length"].contains(&signal.name))
                    {
                        payload = with_bits(payload, signal.start, signal.width, 0);
                    }
                    let none = count == 0 || count == (1 << length.width) - 1;
                    let fits = if none { empty && number == 0 } else { count <= longest && number < count };
                    let mut receiver = Receiver::new(&at_once());
                    let taken = receiver.accept(ms(0), &resealed(message, &Frame::new(frame.id, payload), 0));
                    assert_eq!(taken.is_ok(), fits, "{message:?} {number} of {count}, empty: {empty}");
                }
            }
        }
    }
}

/// RULE-1a: a change of the length begins a new list, though the cycle is the same.
#[test]
fn other_length() {
    let (short, long) = (scene(1, 1), scene(2, 2));
    let mut receiver = Receiver::new(&at_once());
    // Of the long list only its second object comes, of the short one its only one: the long one is not complete.
    let second = |frame: &&Frame| {
        let start = if frame.id == Message::CameraCorner.id() { 14 } else { 16 };
        bits(frame.payload(), start, 4) == 1
    };
    for frame in frames(&short, 0).iter().take(1).chain(frames(&long, 0).iter().filter(second)) {
        let _ = receiver.accept(ms(0), frame);
    }
    let seen = receiver.sample(ms(0)).scene;
    assert!(!seen.radar_known && !seen.camera_known);
}
