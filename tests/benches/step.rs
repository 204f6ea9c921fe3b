//! What a cycle takes in time: the whole step with empty and full lists and how it grows with the objects, the decision with
//! its vetting, one channel alone, and a frame from the bus through the step to the bus.
//!
//! `cargo bench -p supervisor-tests` runs it, `target/criterion/report/index.html` shows it. Times hold for the machine that ran it and only beside
//! one another; instruction counts, which repeat, come from `supervise cost`.

#![expect(clippy::wildcard_imports, reason = "the words of the bench, as its tests use them")]
#![expect(missing_docs, reason = "criterion_group! declares a public function")]

#[path = "../tests/common/mod.rs"]
mod common;

use std::hint::black_box;

use common::*;
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use supervisor::wire::{Frame, Receiver, Sender};

/// So many objects, all near, closing, and different from one another; each has its picture as far as pictures have room.
fn scene(objects: u16) -> Scene {
    let mut scene = Scene::clear();
    for number in 0..objects {
        let object = object(2_000 + 100 * number, 500 + 10 * number.cast_signed());
        assert!(scene.radar.push(object).is_ok(), "the list has room");
        if let Some(picture) = picture_of(&object, &body_of(Class::Object)) {
            // What has no room is left out.
            scene.camera.push(picture).unwrap_or(());
        }
    }
    scene
}

fn supervisor(bus: &Bus) -> Supervisor {
    let mut image = StateImage::encode(&State::INITIAL);
    let _same = bus.state().map(|state| image = StateImage::encode(&state));
    Supervisor::new(*bus.sealed(), ResetCause::PowerOn, Some(Record::None)).with_image(image)
}

/// A cycle again and again: time goes on, everything else stays.
fn step_with_objects(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("whole step, objects");
    let bus = Bus::automated(kmh(50));
    for objects in [0, 1, 2, 4, 8, 16, 32] {
        let (mut supervisor, mut now, scene) = (supervisor(&bus), bus.now, scene(objects));
        group.bench_with_input(BenchmarkId::from_parameter(objects), &scene, |bencher, scene| {
            bencher.iter(|| {
                now = now.wrapping_add(CYCLE);
                supervisor.step(Millis::new(now), black_box(&bus.inputs), scene, black_box(&bus.commands))
            });
        });
    }
    group.finish();
}

/// The decision and what goes out of it, and each dear channel alone.
fn decide_and_vet(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("decide and vet");
    let bus = Bus::steering(kmh(10));
    let config = Config::DEFAULT;
    let Some(state) = bus.state() else { unreachable!("the state of a running bus decodes") };
    let threat = perceive(&scene(1), &config);
    let (_, ticks) = state.clock.advance(Millis::new(bus.now.wrapping_add(CYCLE)), &config);
    let (monitors, response) =
        state.monitors.advance(&Evidence::gather(&bus.inputs, &config), &bus.inputs, ticks, &config);
    let state = State { monitors, ..state };
    let now = Millis::new(bus.now.wrapping_add(CYCLE));
    group.bench_function("decide", |bencher| {
        bencher.iter(|| decide(black_box(&state), now, black_box(&bus.inputs), &threat, &response, &config));
    });
    let decided = decide(&state, now, &bus.inputs, &threat, &response, &config);
    let (envelope, commands) = (decided.envelope, bus.commands);
    group.bench_function("vet, all channels", |bencher| {
        bencher.iter(|| vet(black_box(&envelope), black_box(&commands)));
    });
    group.bench_function("vet_brake", |bencher| {
        bencher.iter(|| vet_brake(black_box(&envelope), black_box(commands.brake)));
    });
    group.bench_function("vet_epb", |bencher| bencher.iter(|| vet_epb(black_box(&envelope), black_box(commands.epb))));
    group.bench_function("vet_gear", |bencher| {
        bencher.iter(|| vet_gear(black_box(&envelope), black_box(commands.gear)));
    });
    group.bench_function("vet_steering", |bencher| {
        bencher.iter(|| vet_steering(black_box(&envelope), black_box(commands.steering)));
    });
    group.finish();
}

/// A busy cycle of the link: every frame of a cycle decoded, the step, every frame to the actuators encoded.
fn frames(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("frames");
    let mut bus = Bus::driving(kmh(50));
    bus.scene = scene(8);
    let (mut sensors, mut controller) = (Sender::new(), Sender::new());
    // Two seconds: every message is sent in them, and every sender qualifies.
    let cycles: Vec<Vec<Frame>> = (0..200_u32)
        .map(|cycle| {
            let (now, mut frames) = (Millis::new(cycle * CYCLE), Vec::new());
            sensors.encode_inputs(now, &bus.inputs, &bus.scene, &mut |frame| frames.push(frame));
            controller.encode_commands(now, &bus.commands, &mut |frame| frames.push(frame));
            frames
        })
        .collect();
    let count: usize = cycles.iter().map(Vec::len).sum();
    group.throughput(Throughput::Elements(u64::try_from(count).unwrap_or(u64::MAX)));
    group.bench_function("two seconds: decode, step, encode", |bencher| {
        bencher.iter(|| {
            let mut supervisor = Supervisor::new(*bus.sealed(), ResetCause::PowerOn, Some(Record::None));
            let (mut receiver, mut actuators) = (Receiver::new(supervisor.config()), Sender::new());
            let mut sent = 0_u32;
            for (cycle, frames) in (0_u32..).zip(&cycles) {
                let now = Millis::new(cycle * CYCLE);
                for frame in frames {
                    let _refused = receiver.accept(now, black_box(frame));
                }
                let sample = receiver.sample(now);
                let decision = supervisor.step(now, sample.inputs, sample.scene, sample.commands);
                actuators.encode_outputs(now, &decision.outputs, &mut |frame| {
                    black_box(frame);
                    sent += 1;
                });
            }
            assert!(sent > 0);
            sent
        });
    });
    group.finish();
}

criterion_group!(benches, step_with_objects, decide_and_vet, frames);
criterion_main!(benches);
