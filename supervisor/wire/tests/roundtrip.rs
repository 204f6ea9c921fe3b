//! From values to frames and back: lossless; periods, counters, changes.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

mod common;

use std::collections::BTreeMap;

use common::*;
use proptest::prelude::*;
use supervisor_core::*;
use supervisor_perceive::Scene;
use supervisor_wire::*;

proptest! {
    /// CMD-1d, CMD-3c: every input, object and command comes out as it went in, within the ranges of J1939.
    #[test]
    fn lossless(seed in any::<u64>()) {
        let mut random = Random::new(seed);
        let (inputs, scene, outputs) = (random.inputs(), random.scene(), random.outputs());
        let mut bench = Bench::new(&at_once());
        for _ in 0..21 {
            bench.send(&inputs, &scene, &fresh(&outputs));
            bench.pass(10);
        }
        let sample = bench.receiver.sample(bench.now);
        prop_assert_eq!(*sample.inputs, inputs);
        prop_assert_eq!(*sample.commands, fresh(&outputs));
        let ages = |scene: &Scene| Scene {
            radar: scene.radar.iter().map(|object| supervisor_perceive::RadarObject { age: Millis::ZERO, ..*object }).collect(),
            camera: scene.camera.iter().map(|object| supervisor_perceive::CameraObject { age: Millis::ZERO, ..*object }).collect(),
            ..*scene
        };
        prop_assert_eq!(ages(sample.scene), ages(&scene));
    }

    /// SELF-8a, SELF-10a: an actuator reads the outputs of the supervisor as they are, and no command of the main
    /// controller.
    #[test]
    fn outputs(seed in any::<u64>()) {
        let mut random = Random::new(seed);
        let (outputs, asked) = (random.outputs(), random.outputs());
        let (mut supervisor, mut controller) = (Sender::new(), Sender::new());
        let mut actuator = Receiver::listening_to(Source::Supervisor, &Config::DEFAULT);
        for now in (0..=200).step_by(10) {
            supervisor.encode_outputs(ms(now), &outputs, &mut |frame| { let _ = actuator.accept(ms(now), &frame); });
            controller.encode_commands(ms(now), &fresh(&asked), &mut |frame| {
                assert!(actuator.accept(ms(now), &frame).is_err());
            });
        }
        prop_assert_eq!(*actuator.sample(ms(200)).commands, fresh(&outputs));
    }
}

proptest! {
    /// SELF-8a, RPT-1b: what the supervisor says of itself comes out as it went in, with the time at which it was sent.
    #[test]
    fn status(seed in any::<u64>(), start in any::<u32>()) {
        let mut random = Random::new(seed);
        let mut supervisor = Sender::new();
        let mut ads = Receiver::listening_to(Source::Supervisor, &at_once());
        prop_assert_eq!(ads.status(ms(start)), Err(Cause::NeverReceived));
        let before = random.status();
        supervisor.encode_status(ms(start), &before, &mut |frame| { ads.accept(ms(7), &frame).unwrap(); });
        prop_assert_eq!(ads.status(ms(7)), Ok((ms(start), before)));
        // The next is due after its period, not before; a change waits for it.
        let after = random.status();
        let mut stamps = Vec::new();
        for since in (10..=200).step_by(10) {
            let now = ms(start.wrapping_add(since));
            supervisor.encode_status(now, &after, &mut |frame| { ads.accept(ms(7 + since), &frame).unwrap(); });
            let (stamp, told) = ads.status(ms(7 + since)).unwrap();
            stamps.push(stamp);
            prop_assert!(now.raw().wrapping_sub(stamp.raw()) < 50);
            if since >= 100 {
                prop_assert_eq!(told, after);
            }
        }
        stamps.dedup();
        prop_assert!((4..=5).contains(&stamps.len()), "{stamps:?}");
        // SELF-8a: dead. The receiver sees it by its own time-out.
        prop_assert!(ads.status(ms(200 + 7 + 100)).is_ok());
        prop_assert_eq!(ads.status(ms(200 + 7 + 126)), Err(Cause::Stale));
    }
}

/// RPT-1b: a time parked that has no room is told as the longest, and read as longer than any.
#[test]
fn parked_for_long() {
    for (parked, expected) in
        [(0, 0), (600_000, 600_000), (1_048_574, 1_048_574), (1_048_575, u32::MAX), (u32::MAX, u32::MAX)]
    {
        let status = Status { parked_for: ms(parked), ..Random::new(1).status() };
        let mut receiver = Receiver::listening_to(Source::Supervisor, &at_once());
        Sender::new().encode_status(ms(0), &status, &mut |frame| {
            receiver.accept(ms(0), &frame).unwrap();
        });
        assert_eq!(receiver.status(ms(0)).unwrap().1, Status { parked_for: ms(expected), ..status });
    }
}

/// Load of a bus of 500 kbit/s in per mille, by what one call every 10 ms sends in 10 s. A frame of 8 bytes with a
/// 29-bit identifier takes at most 160 bits: 131, and a stuffed bit after every fourth of those that are stuffed.
fn load(mut cycle: impl FnMut(&mut Sender, Millis, &mut dyn FnMut(Frame))) -> usize {
    let (mut sender, mut frames) = (Sender::new(), 0);
    for now in (0..10_000).step_by(10) {
        cycle(&mut sender, ms(now), &mut |_| frames += 1);
    }
    frames * 160 * 1000 / 10 / 500_000
}

/// CMD-3d: the link fits on buses of 500 kbit/s: outputs and status, also when every output changes in every cycle;
/// inputs and commands. Full object lists are for a bus of their own.
#[test]
fn bus_load() {
    let mut random = Random::new(3);
    let (outputs, status) = (random.outputs(), random.status());
    let rest = load(|sender, now, mut emit| {
        sender.encode_outputs(now, &outputs, &mut emit);
        sender.encode_status(now, &status, &mut emit);
    });
    assert!((110..130).contains(&rest), "outputs at rest {rest}");
    let busy = load(|sender, now, mut emit| {
        sender.encode_outputs(now, &random.outputs(), &mut emit);
        sender.encode_status(now, &status, &mut emit);
    });
    assert!((400..460).contains(&busy), "every output changes in every cycle {busy}");
    let asked = load(|sender, now, mut emit| sender.encode_commands(now, &fresh(&outputs), &mut emit));
    assert!((95..115).contains(&asked), "commands at rest {asked}");
    let read = load(|sender, now, mut emit| sender.encode_inputs(now, &Inputs::NEVER, &Scene::clear(), &mut emit));
    assert!((90..130).contains(&read), "inputs, object lists empty {read}");
}

/// CMD-1d: what lies beyond the range of J1939 is sent as its end: still far outside of every envelope.
#[test]
fn saturation() {
    for percent in 0..=255 {
        for (total, expected) in
            [(0, 0), (1, 1), (32_126, 32_126), (32_127, 32_127), (32_128, 32_127), (65_535, 32_127)]
        {
            let torque = Percent::new(percent);
            let outputs = Outputs {
                drive: DriveTorque { torque, ..DriveTorque::NEUTRAL },
                retarder: Retarder { torque, ..Retarder::NEUTRAL },
                brake: ServiceBrake { total: DecelMs2Q11::new(total), ..ServiceBrake::NEUTRAL },
                ..Outputs::NEUTRAL
            };
            let mut receiver = Receiver::new(&Config::DEFAULT);
            for message in [Message::DriveTorque, Message::Retarder, Message::ServiceBrake] {
                for counter in [0, 1] {
                    let _ = receiver
                        .accept(ms(0), &resealed(message, &frame(message, &Inputs::NEVER, &outputs, 0), counter));
                }
            }
            let commands = receiver.sample(ms(0)).commands;
            let torque = Percent::new(percent.min(125));
            assert_eq!(commands.drive, Command::Fresh(DriveTorque { torque, ..DriveTorque::NEUTRAL }));
            assert_eq!(commands.retarder, Command::Fresh(Retarder { torque, ..Retarder::NEUTRAL }));
            let total = DecelMs2Q11::new(expected);
            assert_eq!(commands.brake, Command::Fresh(ServiceBrake { total, ..ServiceBrake::NEUTRAL }));
        }
    }
}

/// When each message is sent over `span` ms of calls every `step` ms.
fn times(
    step: u32,
    span: u32,
    mut at: impl FnMut(&mut Sender, Millis, &mut dyn FnMut(Frame)),
) -> BTreeMap<u32, Vec<u32>> {
    let mut sender = Sender::new();
    let mut times: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
    for since in (0..span).step_by(usize::try_from(step).unwrap()) {
        // Across a wrap of the clock.
        let now = ms(since.wrapping_sub(span / 2));
        at(&mut sender, now, &mut |frame| times.entry(frame.id).or_default().push(since));
    }
    times
}

/// SELF-8a, CMD-3e: every message is sent with its period from the first call on, without drift, across a wrap of
/// the clock; the first interval may be shorter. Outputs and commands alike.
#[test]
fn periods() {
    for step in [1, 5, 7, 10] {
        let (inputs, scene, outputs) = (Inputs::NEVER, Scene::clear(), Outputs::NEUTRAL);
        let all = times(step, 10_000, |sender, now, mut emit| {
            sender.encode_inputs(now, &inputs, &scene, &mut emit);
            sender.encode_commands(now, &fresh(&outputs), &mut emit);
            sender.encode_status(now, &Random::new(2).status(), &mut emit);
        });
        let out = times(step, 10_000, |sender, now, mut emit| sender.encode_outputs(now, &outputs, &mut emit));
        assert_eq!(all.len(), Message::COUNT);
        assert_eq!(out.len(), Message::ALL.iter().filter(|message| message.is_command()).count());
        for message in Message::ALL {
            let period = message.period().raw();
            let by_output = out.get(&message.id_from(Source::Supervisor));
            for times in [Some(&all[&message.id()]), by_output].into_iter().flatten() {
                assert_eq!(times[0], 0, "{message:?}");
                assert!(times[1] <= period + step, "{message:?} {times:?}");
                for pair in times[1..].windows(2) {
                    assert!(
                        pair[1] - pair[0] < period + step && pair[1] - pair[0] + step > period,
                        "{message:?} {pair:?}"
                    );
                }
                let expected = 10_000 / period;
                assert!(times.len().abs_diff(usize::try_from(expected).unwrap()) <= 2, "{message:?} {}", times.len());
            }
        }
    }
}

/// Messages of one period are spread over it: no cycle carries more than half of them, after the first.
#[test]
fn spread() {
    let mut most = 0;
    let all =
        times(10, 2000, |sender, now, mut emit| sender.encode_inputs(now, &Inputs::NEVER, &Scene::clear(), &mut emit));
    for cycle in (210..2000).step_by(10) {
        most = most.max(all.values().filter(|times| times.contains(&cycle)).count());
    }
    assert!(most <= Message::ALL.iter().filter(|message| !message.is_command()).count() / 2, "{most}");
}

/// CMD-3e: after a pause of a whole period the next frame comes a period later, not at once; after one that is a millisecond shorter
/// the period runs on from when the frame was due.
#[test]
fn pauses() {
    let message = Message::DriveStatus;
    let period = message.period().raw();
    for (late, next) in [(period - 1, 1), (period, period), (period + 1, period)] {
        let mut sender = Sender::new();
        let mut is_sent = |now: u32| {
            let mut sent = false;
            sender
                .encode_inputs(ms(now), &Inputs::NEVER, &Scene::clear(), &mut |frame| sent |= frame.id == message.id());
            sent
        };
        // Looked at every millisecond it is sent when it is due.
        let last = (0..3 * period).filter(|now| is_sent(*now)).last().unwrap();
        // Nobody calls until the next one is late.
        let resumed = last + period + late;
        assert!(is_sent(resumed));
        assert_eq!((1..2 * period).find(|later| is_sent(resumed + later)), Some(next), "late by {late}");
    }
}

/// RXN-1a: a change of an output is sent in the same cycle, all frames of its channel and no other; once.
#[test]
fn changes() {
    let mut sender = Sender::new();
    let mut outputs = Outputs::NEUTRAL;
    for now in (0..2000).step_by(10) {
        sender.encode_outputs(ms(now), &outputs, &mut |_| ());
    }
    let count = |sender: &mut Sender, now, outputs: &Outputs| {
        let mut ids = Vec::new();
        sender.encode_outputs(ms(now), outputs, &mut |frame| ids.push(frame.id));
        ids
    };
    outputs.steering.overlay = TorqueNmQ10::new(1);
    let pair = [Message::SteeringAngle, Message::SteeringTorque].map(|message| message.id_from(Source::Supervisor));
    let first = count(&mut sender, 1991, &outputs);
    assert_eq!(first, pair);
    assert!(count(&mut sender, 1992, &outputs).is_empty());
    outputs.brake.total = DecelMs2Q11::new(2048);
    let pair = [Message::ServiceBrake, Message::BrakeSplit].map(|message| message.id_from(Source::Supervisor));
    assert_eq!(count(&mut sender, 1993, &outputs), pair);
    outputs.warnings.fault_lamp = true;
    assert_eq!(count(&mut sender, 1994, &outputs), [Message::Warnings.id_from(Source::Supervisor)]);
    // The period of what was sent on a change begins anew.
    let lamp = (1995..2200)
        .find(|now| count(&mut sender, *now, &outputs).contains(&Message::Warnings.id_from(Source::Supervisor)));
    assert_eq!(lamp, Some(2094));
}

/// CMD-3d, CMD-3e: the counter of each message runs on by one per frame, whatever it says and whoever asked for it.
#[test]
fn counters() {
    let (mut sender, mut random) = (Sender::new(), Random::new(10));
    let mut last: BTreeMap<u32, u8> = BTreeMap::new();
    for cycle in 0..500_u32 {
        let (inputs, scene, outputs) = (random.inputs(), random.scene(), random.outputs());
        let mut emit = |frame: Frame| {
            let message = Message::ALL
                .iter()
                .copied()
                .find(|message| [message.id(), message.id_from(Source::Supervisor)].contains(&frame.id))
                .unwrap();
            if message.protection() == Protection::Bare {
                return;
            }
            let (start, width, count) = counter_place(message);
            let counter = u8::try_from(bits(frame.payload(), start, width)).unwrap();
            assert_eq!(resealed(message, &frame, counter), frame, "sealed as computed independently");
            let expected = last.get(&frame.id).map_or(0, |last| (last + 1) % count);
            assert_eq!(counter, expected, "{message:?}");
            last.insert(frame.id, counter);
        };
        sender.encode_inputs(ms(cycle * 10), &inputs, &scene, &mut emit);
        sender.encode_outputs(ms(cycle * 10), &outputs, &mut emit);
        sender.encode_status(ms(cycle * 10), &random.status(), &mut emit);
    }
}

/// CMD-2d: channels without a value are not sent; when they come back, at once.
#[test]
fn absent_commands() {
    let mut sender = Sender::new();
    let mut sent = |now, commands: &Commands| {
        let mut ids = Vec::new();
        sender.encode_commands(ms(now), commands, &mut |frame| ids.push(frame.id));
        ids
    };
    assert!(sent(0, &Commands::ABSENT).is_empty());
    let rejected = Commands { gear: Command::Rejected(Rejection::Field), ..Commands::ABSENT };
    assert!(sent(10, &rejected).is_empty());
    let held = Commands { gear: Command::Held(ms(30), GearRequest::Drive), ..Commands::ABSENT };
    assert_eq!(sent(20, &held), [Message::Gear.id()]);
    assert!(sent(30, &held).is_empty());
    assert!(sent(40, &Commands::ABSENT).is_empty());
    assert!(sent(500, &Commands::ABSENT).is_empty());
    assert_eq!(sent(510, &held), [Message::Gear.id()]);
    macro_rules! only {
        ($($field:ident: $($message:ident)+;)*) => {$(
            let mut sender = Sender::new();
            let mut ids = Vec::new();
            let commands = Commands { $field: fresh(&Outputs::NEUTRAL).$field, ..Commands::ABSENT };
            sender.encode_commands(ms(0), &commands, &mut |frame| ids.push(frame.id));
            assert_eq!(ids, [$(Message::$message.id()),+]);
        )*};
    }
    only! {
        drive: DriveTorque; target_speed: TargetSpeed; brake: ServiceBrake BrakeSplit; retarder: Retarder; gear: Gear;
        epb: ParkingBrake; steering: SteeringAngle SteeringTorque; contactors: Contactors; auxiliaries: Auxiliaries;
        warnings: Warnings; body: Body; mode: Mode;
    }
}
