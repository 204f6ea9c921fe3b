//! CAN frames through decoder and step: those of a whole bus, lost, repeated, late and broken; sealed ones that say anything;
//! and raw ones.

use super::{Reached, judge};
use crate::common::random::{Dice, change_command, change_input, change_scene};
use crate::common::{
    Commands, Config, Inputs, Millis, Outputs, Record, ResetCause, Scene, Sealed, Supervisor, healthy,
};
use supervisor::wire::{Frame, Message, Receiver, Sender};

/// So many cycles at most.
const LONGEST: u64 = 1_000;

/// What the senders on the bus say.
struct Bus {
    sensors: Sender,
    controller: Sender,
    inputs: Inputs,
    scene: Scene,
    commands: Commands,
    last: Option<Frame>,
}

/// Events on the bus, and cycles of the supervisor that listens to it.
///
/// # Panics
/// If a property does not hold in a cycle.
pub fn wire_bytes(bytes: &[u8], reached: &mut Reached) {
    let Ok(sealed) = Sealed::from_default() else { return };
    let mut dice = Dice::Bytes(bytes);
    let mut supervisor = Supervisor::new(sealed, ResetCause::PowerOn, Some(Record::None));
    let mut receiver = Receiver::new(&Config::DEFAULT);
    let mut bus = Bus {
        sensors: Sender::new(),
        controller: Sender::new(),
        inputs: healthy(),
        scene: Scene::clear(),
        commands: Outputs::NEUTRAL.as_commands(),
        last: None,
    };
    let (mut now, end) = (1_000_u32, reached.cycles + LONGEST);
    while !dice.is_used_up() && reached.cycles < end {
        match dice.below(8) {
            0 => raw(&mut dice, now, &mut receiver),
            1 => meaningful(&mut dice, now, &mut receiver),
            2 => change_input(&mut dice, &mut bus.inputs),
            3 => change_command(&mut dice, &mut bus.commands),
            4 => change_scene(&mut dice, &mut bus.scene),
            _ => {
                let (count, tampers) = (dice.of(&[1, 1, 2, 5, 30, 110]), dice.one_in(3));
                for _ in 0..count {
                    now = now.wrapping_add(crate::common::random::cycle(&mut dice));
                    send(&mut dice, now, tampers, &mut bus, &mut receiver);
                    let sample = receiver.sample(Millis::new(now));
                    let old = supervisor.image().decode();
                    let (inputs, scene, commands) = (sample.inputs, sample.scene, sample.commands);
                    let decision = supervisor.step(Millis::new(now), inputs, scene, commands);
                    judge(old, now, &sealed, (inputs, scene, commands), &decision);
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
fn send(dice: &mut Dice<'_>, now: u32, tampers: bool, bus: &mut Bus, receiver: &mut Receiver) {
    let now = Millis::new(now);
    let Bus { sensors, controller, inputs, scene, commands, last } = bus;
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
