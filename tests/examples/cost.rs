//! What one cycle costs: runs every stage of it in named scenarios, each between two calls that a counter can see.
//!
//! `supervise cost` runs it under `valgrind --tool=callgrind`, which counts the instructions of every call of
//! [`measured`] and of nothing else, and takes each line that it prints as the name of one call. With the argument
//! `time` it runs each stage many times instead and prints nanoseconds.

#![expect(clippy::wildcard_imports, reason = "the words of the bench, as its tests use them")]

#[path = "../tests/common/mod.rs"]
mod common;

use std::hint::black_box;
use std::sync::OnceLock;
use std::time::Instant;

use common::random::{Dice, STARTS, change_command, change_input, change_scene, start};
use common::*;
use supervisor::wire::{Frame, Receiver, Sender};

/// How many random cycles; the greatest figure of them counts.
const RANDOM_CYCLES: u32 = 400;
/// Calls in a batch, and batches, when it times.
const BATCH: u32 = 1_000;
/// See [`BATCH`].
const BATCHES: u32 = 30;
/// The seed of the random cycles.
const SEED: u64 = 0x00C0_57ED;

/// Counted from its first instruction to its last.
#[inline(never)]
fn measured(run: &mut dyn FnMut()) {
    run();
    // Not the last call, or it would be a jump, and the counter would miss the return.
    black_box(());
}

/// Whether to time instead of to count.
static TIME: OnceLock<bool> = OnceLock::new();

/// Measures one stage; the result is used, so nothing is optimised away.
fn stage<T>(scenario: &str, name: &str, mut run: impl FnMut() -> T) {
    let mut run = || {
        black_box(run());
    };
    if TIME.get() != Some(&true) {
        println!("{scenario}\t{name}");
        measured(&mut run);
        return;
    }
    // The cheapest batch: whatever else the machine does only adds.
    let batch = |run: &mut dyn FnMut()| {
        let begin = Instant::now();
        for _ in 0..BATCH {
            measured(run);
        }
        begin.elapsed().as_secs_f64() * 1e9 / f64::from(BATCH)
    };
    let least = (0..BATCHES).map(|_| batch(&mut run)).fold(f64::INFINITY, f64::min);
    println!("{scenario}\t{name}\t{least:.2}");
}

/// What one cycle reads, and the state that it meets.
struct Meets {
    image: StateImage,
    sealed: Sealed,
    now: Millis,
    inputs: Inputs,
    scene: Scene,
    commands: Commands,
}

impl Meets {
    /// The next cycle of a bus.
    fn of(bus: &Bus, sealed: &Sealed) -> Self {
        let seen = std::cell::Cell::new(None);
        let _same = bus.with_image(|image| {
            seen.set(Some(image));
            image
        });
        let image = seen.get().unwrap_or_else(|| StateImage::encode(&State::INITIAL));
        Self {
            image,
            sealed: *sealed,
            now: Millis::new(bus.now.wrapping_add(CYCLE)),
            inputs: bus.inputs,
            scene: bus.scene.clone(),
            commands: bus.commands,
        }
    }
}

/// Every stage of one cycle, each with the very values that the cycle before it in the chain gives.
fn stages(scenario: &str, meets: &Meets) {
    let Meets { image, sealed, now, inputs, scene, commands } = black_box(meets);
    stage(scenario, "nothing", || ());
    stage(scenario, "image decode", || image.decode::<State>());
    stage(scenario, "sealed digest", || sealed.intact().is_some());
    let state = black_box(image.decode().unwrap_or_else(State::corrupted));
    let config = black_box(sealed.intact().copied().unwrap_or(Config::DEFAULT));
    stage(scenario, "perceive", || perceive(scene, &config));
    let threat = black_box(perceive(scene, &config));
    let (_, ticks) = state.clock.advance(*now, &config);
    let observe = || state.monitors.advance(&Evidence::gather(inputs, &config), inputs, ticks, &config);
    stage(scenario, "observe", observe);
    let (monitors, response) = black_box(observe());
    let state = State { monitors, ..state };
    stage(scenario, "decide", || decide(&state, *now, inputs, &threat, &response, &config));
    let decided = black_box(decide(&state, *now, inputs, &threat, &response, &config));
    vetting(scenario, &decided.envelope, commands);
    let (outputs, _) = black_box(vet(&decided.envelope, commands));
    stage(scenario, "record", || record(&decided, &outputs, commands, &config));
    let next = black_box(record(&decided, &outputs, commands, &config));
    stage(scenario, "image encode", || StateImage::encode(&next));
    let mut retained = black_box(*image);
    stage(scenario, "core step", || step(&mut retained, sealed, Flow::PERCEIVED, *now, inputs, &threat, commands));
    let mut supervisor = Supervisor::new(*sealed, ResetCause::PowerOn, Some(Record::None)).with_image(*image);
    stage(scenario, "whole step", || supervisor.step(*now, inputs, scene, commands));
}

/// Vet, all channels and each alone.
fn vetting(scenario: &str, envelope: &Envelope, commands: &Commands) {
    stage(scenario, "vet", || vet(envelope, commands));
    let (out, _) = black_box(vet(envelope, commands));
    let beside = black_box(envelope.brake.retarder_beside(out.brake.total));
    let braking = black_box(envelope.brake.total(&out));
    stage(scenario, "vet_gear", || vet_gear(envelope, commands.gear));
    stage(scenario, "vet_brake", || vet_brake(envelope, commands.brake));
    stage(scenario, "vet_retarder", || vet_retarder(envelope, beside, commands.retarder));
    stage(scenario, "vet_mode", || vet_mode(envelope, commands.mode));
    stage(scenario, "vet_drive", || vet_drive(envelope, out.mode, out.gear, braking, commands.drive));
    stage(scenario, "vet_target_speed", || vet_target_speed(envelope, out.mode, commands.target_speed));
    stage(scenario, "vet_epb", || vet_epb(envelope, commands.epb));
    stage(scenario, "vet_steering", || vet_steering(envelope, commands.steering));
    stage(scenario, "vet_contactors", || vet_contactors(envelope, out.drive.torque, commands.contactors));
    stage(scenario, "vet_auxiliaries", || vet_auxiliaries(envelope, commands.auxiliaries));
    stage(scenario, "vet_warnings", || vet_warnings(envelope, commands.warnings));
    stage(scenario, "vet_body", || vet_body(envelope, braking, commands.body));
}

/// Both lists full of objects that differ, every one of them near and closing.
fn full_lists() -> Scene {
    let mut scene = Scene::clear();
    let mut dice = Dice::Number(SEED);
    while !scene.radar.is_full() {
        let near = object(2_000 + dice.half() % 4_000, 500 + dice.signed().rem_euclid(1_000));
        assert!(scene.radar.push(near).is_ok());
    }
    while !scene.camera.is_full() {
        let near = camera_object(2_000 + dice.half() % 4_000, 500);
        assert!(scene.camera.push(near).is_ok());
    }
    scene
}

/// How the step grows with what the radar sees: so many objects, near and closing, all different.
fn growing(objects: usize, sealed: &Sealed) {
    let mut bus = Bus::driving(kmh(50));
    let full = full_lists();
    bus.scene.radar = full.radar.iter().take(objects).copied().collect();
    let Meets { image, sealed, now, inputs, scene, commands } = black_box(Meets::of(&bus, sealed));
    let mut supervisor = Supervisor::new(sealed, ResetCause::PowerOn, Some(Record::None)).with_image(image);
    stage(&format!("{objects} radar objects"), "whole step", || supervisor.step(now, &inputs, &scene, &commands));
}

/// The link: every frame of a busy second, the sample of every cycle, everything that is sent.
fn link(scenario: &str, bus: &Bus, sealed: &Sealed) {
    let mut supervisor = Supervisor::new(*sealed, ResetCause::PowerOn, Some(Record::None));
    let mut receiver = Receiver::new(supervisor.config());
    let (mut sensors, mut controller, mut actuators) = (Sender::new(), Sender::new(), Sender::new());
    for cycle in 0..220_u32 {
        let now = Millis::new(cycle * CYCLE);
        let mut frames: Vec<Frame> = Vec::new();
        sensors.encode_inputs(now, &bus.inputs, &bus.scene, &mut |frame| frames.push(frame));
        controller.encode_commands(now, &bus.commands, &mut |frame| frames.push(frame));
        let busy = cycle >= 200;
        for frame in &frames {
            if busy {
                stage(scenario, "wire receive, one frame", || receiver.accept(now, black_box(frame)));
            } else {
                let _ = receiver.accept(now, frame);
            }
        }
        if busy {
            stage(scenario, "wire sample", || receiver.sample(now).commands.drive == Command::Absent);
        }
        let sample = receiver.sample(now);
        let decision = supervisor.step(now, sample.inputs, sample.scene, sample.commands);
        let mut emit = |frame: Frame| {
            black_box(frame);
        };
        if busy {
            stage(scenario, "wire send, all channels", || {
                actuators.encode_outputs(now, black_box(&decision.outputs), &mut emit);
            });
        } else {
            actuators.encode_outputs(now, &decision.outputs, &mut emit);
        }
    }
}

fn main() {
    let time = *TIME.get_or_init(|| std::env::args().nth(1).is_some_and(|argument| argument == "time"));
    let Ok(sealed) = Sealed::from_default() else { unreachable!("the table is valid") };
    let mut busy = Bus::steering(kmh(10));
    busy.scene = full_lists();
    let lists = {
        let mut bus = Bus::driving(kmh(50));
        bus.scene = full_lists();
        bus
    };
    let mut safe = Bus::leave(kmh(50));
    for _ in 0..3 {
        safe.step_by(0);
    }
    let corrupted = Bus::driving(kmh(50)).with_image(|image| image.with_flipped_bit(STATE_WORDS - 1, 31));
    let scenarios = vec![
        ("cruising, clear road", Bus::automated(kmh(50))),
        ("full lists, level 3", lists),
        ("steering, full lists", busy.clone()),
        ("leave at 50 km/h", Bus::leave(kmh(50))),
        ("parked by leave", Bus::parked_by_leave()),
        ("safe state", safe),
        ("corrupted image", corrupted),
    ];
    for (name, bus) in &scenarios {
        stages(name, &Meets::of(bus, &sealed));
    }
    for objects in [0, 1, 2, 4, 8, 16, 32] {
        growing(objects, &sealed);
    }
    if time {
        return;
    }
    let mut dice = Dice::Number(SEED);
    for _ in 0..RANDOM_CYCLES {
        let mut bus = start(dice.below(STARTS));
        for _ in 0..6 {
            change_input(&mut dice, &mut bus.inputs);
            change_command(&mut dice, &mut bus.commands);
        }
        change_scene(&mut dice, &mut bus.scene);
        bus.step_unjudged(CYCLE);
        change_command(&mut dice, &mut bus.commands);
        stages("random", &Meets::of(&bus, &sealed));
    }
    link("link, full lists", &busy, &sealed);
}
