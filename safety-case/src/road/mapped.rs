//! The road of a mapping: frames of any DBC become inputs, objects and commands.

use std::collections::HashMap;

use supervisor::wire::{Qualifier, Timing};
use supervisor::{
    CameraObject, Channel, Class, Command, Commands, Inputs, Millis, OffsetCm, Outputs, PixelBox, RadarObject,
    Rejection, Scene, Signal,
};

use super::extract::Extraction;
use super::field::{CommandField, InputField};
use super::mapping::Ids;
use super::value::Value;
use crate::candump::LogFrame;

/// Older than this a command is no longer shown as held; every time-out of the supervisor is shorter.
const FORGOTTEN: u32 = 10_000;

/// An input and the signal that fills it.
#[derive(Debug)]
pub(super) struct InputSlot {
    pub field: InputField,
    pub extraction: Extraction,
    pub timing: Timing,
    pub qualifier: Qualifier,
    pub last: Signal<i32>,
}

/// A command and the message that fills it.
#[derive(Debug)]
pub(super) struct CommandSlot {
    pub channel: Channel,
    pub fields: Vec<(CommandField, Extraction)>,
    /// The constants of the mapping; the signals are put over them.
    pub template: Outputs,
    pub last: Last,
}

#[derive(Debug)]
pub(super) enum Last {
    Never,
    Rejected,
    Good { at: Millis, fresh: bool, outputs: Box<Outputs> },
}

/// A place of an object list and the message that fills it.
#[derive(Debug)]
pub(super) struct ObjectSlot {
    pub camera: bool,
    pub distance: Extraction,
    pub offset: Option<Extraction>,
    pub closing: Extraction,
    pub class: Option<Extraction>,
    pub present: Option<Extraction>,
    pub seen: Option<(Millis, Option<(RadarObject, Class)>)>,
}

/// What a frame fills.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Slot {
    Input(usize),
    Command(usize),
    Object(usize),
}

/// A decoder made from a mapping and a DBC.
#[derive(Debug)]
pub struct Mapped {
    pub(super) ids: Ids,
    /// By identifier, or by parameter group: (only this sender, what it fills).
    pub(super) slots: HashMap<Key, Vec<(Option<u8>, Slot)>>,
    pub(super) inputs: Vec<InputSlot>,
    pub(super) commands: Vec<CommandSlot>,
    pub(super) objects: Vec<ObjectSlot>,
    pub(super) object_age: Millis,
}

/// Whether it is extended, and the identifier or parameter group.
type Key = (bool, u32);

/// What identifies a frame: all of it, or its parameter group (without the destination of an addressed one).
pub(super) fn key(ids: Ids, extended: bool, id: u32) -> Key {
    const ADDRESSED_BELOW: u32 = 0xF0;
    let id = match (ids, extended) {
        (Ids::J1939, true) if (id >> 16) & 0xFF < ADDRESSED_BELOW => id & 0x03FF_0000,
        (Ids::J1939, true) => id & 0x03FF_FF00,
        (Ids::J1939, false) | (Ids::Exact, _) => id,
    };
    (extended, id)
}

fn elapsed(now: Millis, then: Millis) -> Millis {
    Millis::new(now.raw().wrapping_sub(then.raw()))
}

impl Mapped {
    /// Takes a frame. `None`: no entry of the mapping speaks of it; an error: it is too short.
    pub fn accept(&mut self, now: Millis, frame: &LogFrame) -> Option<Result<(), ()>> {
        let Self { ids, slots, inputs, commands, objects, .. } = self;
        let filled = slots.get(&key(*ids, frame.extended, frame.id))?;
        let sender = frame.id.to_le_bytes()[0];
        let mut found = None;
        for (source, slot) in filled {
            if source.is_some_and(|source| source != sender) {
                continue;
            }
            let whole = match *slot {
                Slot::Input(index) => inputs.get_mut(index).and_then(|slot| slot.take(now, frame)),
                Slot::Command(index) => commands.get_mut(index).and_then(|slot| slot.take(now, frame)),
                Slot::Object(index) => objects.get_mut(index).and_then(|slot| slot.take(now, frame)),
            };
            found = Some(found.unwrap_or(Ok(())).and(whole.ok_or(())));
        }
        found
    }

    /// Puts what is mapped over what the other road gave.
    pub fn sample(&mut self, now: Millis, inputs: &mut Inputs, scene: &mut Scene, commands: &mut Commands) {
        for slot in &mut self.inputs {
            let signal = slot.qualifier.quality(now, slot.timing).map_or_else(Signal::Unknown, |_| slot.last);
            (slot.field.set)(inputs, signal);
        }
        for slot in &mut self.commands {
            slot.sample(now, commands);
        }
        self.scene(now, scene);
    }

    fn scene(&self, now: Millis, scene: &mut Scene) {
        for camera in [false, true] {
            let mine = || self.objects.iter().filter(|slot| slot.camera == camera);
            if mine().next().is_none() {
                continue;
            }
            let known = mine().any(|slot| slot.seen.is_some_and(|(at, _)| elapsed(now, at) <= self.object_age));
            let current = mine().filter_map(|slot| {
                let (at, object) = slot.seen?;
                let age = elapsed(now, at);
                let aged = |(object, class)| (RadarObject { age, ..object }, class);
                (age <= self.object_age).then_some(object).flatten().map(aged)
            });
            if camera {
                scene.camera_known = known;
                scene.camera.clear();
                for (RadarObject { distance, closing, age, .. }, class) in current {
                    let object = CameraObject { pixels: PixelBox::default(), class, distance, closing, age };
                    // The list is as long as the supervisor's; `bind` refuses longer ones.
                    if scene.camera.push(object).is_err() {
                        break;
                    }
                }
            } else {
                scene.radar_known = known;
                scene.radar.clear();
                for (object, _) in current {
                    if scene.radar.push(object).is_err() {
                        break;
                    }
                }
            }
        }
    }
}

impl InputSlot {
    fn take(&mut self, now: Millis, frame: &LogFrame) -> Option<()> {
        let Some(signal) = self.extraction.read(frame.data, frame.length) else {
            self.qualifier.bad(now, self.timing);
            return None;
        };
        self.qualifier.good(now, self.timing);
        self.last = signal;
        Some(())
    }
}

impl CommandSlot {
    fn take(&mut self, now: Millis, frame: &LogFrame) -> Option<()> {
        let mut outputs = self.template;
        self.last = Last::Rejected;
        let mut legal = true;
        for (field, extraction) in &self.fields {
            let raw = extraction.read(frame.data, frame.length)?.known();
            legal &= raw.and_then(|raw| (field.set)(&mut outputs, raw)).is_some();
        }
        if legal {
            self.last = Last::Good { at: now, fresh: true, outputs: Box::new(outputs) };
        }
        Some(())
    }

    fn sample(&mut self, now: Millis, commands: &mut Commands) {
        if matches!(self.last, Last::Good { at, .. } if elapsed(now, at).raw() > FORGOTTEN) {
            self.last = Last::Never;
        }
        let command = match &self.last {
            Last::Never => Command::Absent,
            Last::Rejected => Command::Rejected(Rejection::Field),
            Last::Good { fresh: true, outputs, .. } => Command::Fresh(outputs.as_ref()),
            Last::Good { at, outputs, .. } => Command::Held(elapsed(now, *at), outputs.as_ref()),
        };
        put(commands, self.channel, command);
        if let Last::Good { fresh, .. } = &mut self.last {
            *fresh = false;
        }
    }
}

fn put(commands: &mut Commands, channel: Channel, command: Command<&Outputs>) {
    fn of<T>(command: Command<&Outputs>, field: impl Fn(&Outputs) -> T) -> Command<T> {
        match command {
            Command::Absent => Command::Absent,
            Command::Rejected(why) => Command::Rejected(why),
            Command::Fresh(outputs) => Command::Fresh(field(outputs)),
            Command::Held(age, outputs) => Command::Held(age, field(outputs)),
        }
    }
    match channel {
        Channel::DriveTorque => commands.drive = of(command, |outputs| outputs.drive),
        Channel::TargetSpeed => commands.target_speed = of(command, |outputs| outputs.target_speed),
        Channel::ServiceBrake => commands.brake = of(command, |outputs| outputs.brake),
        Channel::Retarder => commands.retarder = of(command, |outputs| outputs.retarder),
        Channel::Gear => commands.gear = of(command, |outputs| outputs.gear),
        Channel::ParkingBrake => commands.epb = of(command, |outputs| outputs.epb),
        Channel::Steering => commands.steering = of(command, |outputs| outputs.steering),
        Channel::Contactors => commands.contactors = of(command, |outputs| outputs.contactors),
        Channel::Auxiliaries => commands.auxiliaries = of(command, |outputs| outputs.auxiliaries),
        Channel::Warnings => commands.warnings = of(command, |outputs| outputs.warnings),
        Channel::Body => commands.body = of(command, |outputs| outputs.body),
        Channel::Mode => commands.mode = of(command, |outputs| outputs.mode),
    }
}

impl ObjectSlot {
    fn take(&mut self, now: Millis, frame: &LogFrame) -> Option<()> {
        let read = |extraction: &Extraction| extraction.read(frame.data, frame.length);
        let present = self.present.as_ref().map_or(Some(Signal::Known(1)), read)?;
        let (distance, closing) = (read(&self.distance)?, read(&self.closing)?);
        let offset = self.offset.as_ref().map_or(Some(Signal::Known(0)), read)?;
        let class = self.class.as_ref().map_or(Some(Signal::Known(0)), read)?;
        let updates = self.seen.and_then(|(_, object)| object).map_or(0, |(object, _)| object.updates.raw());
        let object = || {
            let class = class.known().and_then(Value::from_raw).unwrap_or(Class::Unclassified);
            let object = RadarObject {
                distance: Value::from_raw(distance.known()?)?,
                offset: OffsetCm::from_raw(offset.known()?)?,
                closing: Value::from_raw(closing.known()?)?,
                age: Millis::ZERO,
                updates: supervisor::Count::new(updates.saturating_add(1)),
            };
            Some((object, class))
        };
        self.seen = Some((now, present.is(1).then(object).flatten()));
        Some(())
    }
}
