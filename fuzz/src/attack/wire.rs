//! CAN frames through decoder and step: those of a whole bus, lost, repeated, late and broken; sealed ones that say anything;
//! and raw ones.

use super::{Reached, judge};
use crate::common::random::{Dice, STARTS, change_bus, change_command, change_input, change_scene, cycle, obey, start};
use crate::common::{Commands, Config, Inputs, Millis, Scene};
use supervisor::wire::{Frame, Message, Receiver, Sender};

/// So many cycles at most.
const LONGEST: u64 = 1_000;
/// How long the senders are heard before the first step, in cycles: long enough for every one of them to qualify.
const HEARD: u32 = 150;

/// What the senders on the bus say.
struct Road {
    sensors: Sender,
    controller: Sender,
    inputs: Inputs,
    scene: Scene,
    commands: Commands,
    last: Option<Frame>,
}

/// Events on the bus, and cycles of the supervisor that listens to it: the first byte says where it begins, then the link comes up.
///
/// # Panics
/// If a property, or a claim of the bench's own oracle, does not hold in a cycle.
pub fn wire_bytes(bytes: &[u8], reached: &mut Reached) {
    let mut dice = Dice::Bytes(bytes);
    let mut bus = start(dice.below(STARTS));
    let mut road = Road {
        sensors: Sender::new(),
        controller: Sender::new(),
        inputs: bus.inputs,
        scene: bus.scene.clone(),
        commands: bus.commands,
        last: None,
    };
    let mut receiver = Receiver::new(&Config::DEFAULT);
    for ago in (0..HEARD).rev() {
        let now = bus.now.wrapping_sub(ago * 10);
        send(&mut dice, now, false, &mut road, &mut receiver);
        let _ = receiver.sample(Millis::new(now));
    }
    let end = reached.cycles + LONGEST;
    while !dice.is_used_up() && reached.cycles < end {
        if let (Some(decision), false) = (bus.last, dice.one_in(8)) {
            obey(&decision.outputs, &mut road.inputs);
        }
        match dice.below(10) {
            0 => raw(&mut dice, bus.now, &mut receiver),
            1 => meaningful(&mut dice, bus.now, &mut receiver),
            2 => change_bus(&mut dice, &mut road.inputs),
            3 => change_input(&mut dice, &mut road.inputs),
            4 | 5 => change_command(&mut dice, &mut road.commands),
            6 => change_scene(&mut dice, &mut road.scene),
            _ => {
                // So long that a speed that is lost ends a level.
                let long = dice.one_in(16);
                let (count, tampers) = (if long { 220 } else { dice.of(&[1, 1, 2, 5, 30, 110]) }, dice.one_in(3));
                for _ in 0..count {
                    let elapsed = if long { 50 } else { cycle(&mut dice) };
                    let now = bus.now.wrapping_add(elapsed);
                    send(&mut dice, now, tampers, &mut road, &mut receiver);
                    let sample = receiver.sample(Millis::new(now));
                    let (inputs, scene, commands) = (*sample.inputs, sample.scene.clone(), *sample.commands);
                    (bus.inputs, bus.scene, bus.commands) = (inputs, scene.clone(), commands);
                    let old = bus.state();
                    let decision = bus.step_by(elapsed);
                    judge(old, now, bus.sealed(), (&inputs, &scene, &commands), &decision);
                    reached.look(&decision);
                }
            }
        }
    }
}

/// Any frame at all, or any payload under an identifier of the table.
fn raw(dice: &mut Dice<'_>, now: u32, receiver: &mut Receiver) {
    let id = if dice.flag() { dice.word() } else { dice.of(Message::ALL).id() };
    let frame = Frame { id, length: dice.byte(), data: dice.next().to_le_bytes() };
    let _ = receiver.accept(Millis::new(now), &frame);
}

/// A frame with a right check field that says anything.
fn meaningful(dice: &mut Dice<'_>, now: u32, receiver: &mut Receiver) {
    let message = dice.of(Message::ALL);
    let (payload, counter) = (dice.next(), dice.byte() & 15);
    let frame = Frame::new(message.id(), message.protection().seal(message.id(), payload, counter));
    let _ = receiver.accept(Millis::new(now), &frame);
}

/// What is due is sent; a tamperer loses, breaks, repeats, cuts or doubles some of it.
fn send(dice: &mut Dice<'_>, now: u32, tampers: bool, road: &mut Road, receiver: &mut Receiver) {
    let now = Millis::new(now);
    let Road { sensors, controller, inputs, scene, commands, last } = road;
    let mut put = |frame: Frame| {
        let mut sent = frame;
        match if tampers { dice.below(16) } else { 15 } {
            0 => return,
            1 => sent.data[dice.below(8)] ^= 1 << dice.below(8),
            2 => sent = last.unwrap_or(frame),
            3 => sent.length = dice.byte() % 9,
            4 => {
                let _ = receiver.accept(now, &frame);
            }
            _ => {}
        }
        *last = Some(frame);
        let _ = receiver.accept(now, &sent);
    };
    sensors.encode_inputs(now, inputs, scene, &mut put);
    controller.encode_commands(now, commands, &mut put);
}
