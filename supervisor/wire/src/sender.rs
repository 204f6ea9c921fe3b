//! From inputs, commands and outputs to frames.

use supervisor_core::{Channel, Command, Commands, Count, Inputs, Millis, Outputs};
use supervisor_perceive::Scene;

use crate::frame::Frame;
use crate::list::Entry;
use crate::message::{Destination, Source, Values};
use crate::qualifier::elapsed;
use crate::table::Message;

/// What the sender keeps of one message.
#[derive(Clone, Copy, Debug)]
struct Slot {
    /// Counter of the next frame.
    counter: u8,
    /// When it was due last; `None` before the first one.
    due: Option<Millis>,
    /// The payload sent last.
    sent: u64,
}

/// Sends frames: keeps counters and periods.
#[derive(Clone, Debug)]
pub struct Sender {
    slots: [Slot; Message::COUNT],
    radar_cycle: Count,
    camera_cycle: Count,
}

impl Default for Sender {
    fn default() -> Self {
        Self::new()
    }
}

/// The value of a command that is sent: refused and absent ones are not.
fn sent<T>(command: Command<T>) -> Option<T> {
    match command {
        Command::Fresh(value) | Command::Held(_, value) => Some(value),
        Command::Absent | Command::Rejected(_) => None,
    }
}

/// The values of the commands, and which channels have one.
macro_rules! gather {
    ($commands:ident; $($field:ident: $channel:ident),*) => {(
        Outputs { $($field: sent($commands.$field).unwrap_or(Outputs::NEUTRAL.$field),)* },
        |channel: &Channel| match channel { $(Channel::$channel => sent($commands.$field).is_some(),)* },
    )};
}

/// The cycle of the next list: 2 bits.
fn next(cycle: Count) -> Count {
    Count::new(cycle.raw().wrapping_add(1) & 3)
}

impl Sender {
    /// Nothing sent yet.
    #[must_use]
    pub const fn new() -> Self {
        let slot = Slot { counter: 0, due: None, sent: 0 };
        Self { slots: [slot; Message::COUNT], radar_cycle: Count::ZERO, camera_cycle: Count::ZERO }
    }

    /// Sends the inputs and object lists that are due, as their sensors. What is unknown is sent as "not available".
    pub fn encode_inputs(&mut self, now: Millis, inputs: &Inputs, scene: &Scene, emit: &mut impl FnMut(Frame)) {
        let mut values = Values { inputs: *inputs, ..Values::NONE };
        for message in Message::ALL.iter().copied() {
            let due = self.due(now, message);
            match message.destination() {
                Destination::Input if due => self.send(now, message, message.id(), &values, emit),
                Destination::Radar(0) if due => {
                    for entry in Entry::list(self.radar_cycle, scene.radar_known, &scene.radar) {
                        values.radar = entry;
                        for part in [Message::RadarPosition, Message::RadarMotion] {
                            self.send(now, part, part.id(), &values, emit);
                        }
                    }
                    self.radar_cycle = next(self.radar_cycle);
                }
                Destination::Camera(0) if due => {
                    for entry in Entry::list(self.camera_cycle, scene.camera_known, &scene.camera) {
                        values.camera = entry;
                        for part in [Message::CameraObject, Message::CameraCorner, Message::CameraSize] {
                            self.send(now, part, part.id(), &values, emit);
                        }
                    }
                    self.camera_cycle = next(self.camera_cycle);
                }
                Destination::Input | Destination::Radar(_) | Destination::Camera(_) | Destination::Command(_) => {}
            }
        }
    }

    /// Sends the commands that are due or have changed, as the main controller.
    pub fn encode_commands(&mut self, now: Millis, commands: &Commands, emit: &mut impl FnMut(Frame)) {
        self.encode(now, Source::MainController, commands, emit);
    }

    /// Sends the outputs that are due or have changed, as the supervisor (CMD-3d, SELF-8a).
    pub fn encode_outputs(&mut self, now: Millis, outputs: &Outputs, emit: &mut impl FnMut(Frame)) {
        self.encode(now, Source::Supervisor, &outputs.as_commands(), emit);
    }

    /// All frames of a channel go together.
    fn encode(&mut self, now: Millis, source: Source, commands: &Commands, emit: &mut impl FnMut(Frame)) {
        let (outputs, present) = gather!(commands; drive: DriveTorque, target_speed: TargetSpeed, brake: ServiceBrake,
            retarder: Retarder, gear: Gear, epb: ParkingBrake, steering: Steering, contactors: Contactors,
            auxiliaries: Auxiliaries, warnings: Warnings, body: Body, mode: Mode);
        let values = Values { outputs, ..Values::NONE };
        for channel in Channel::ALL.iter().copied().filter(present) {
            let messages = Message::ALL.iter().filter(|message| message.destination() == Destination::Command(channel));
            if messages.clone().any(|message| self.due(now, *message) || self.changed(*message, &values)) {
                messages.for_each(|message| self.send(now, *message, message.id_from(source), &values, emit));
            }
        }
    }

    fn due(&self, now: Millis, message: Message) -> bool {
        let due = self.slots.get(message.number()).and_then(|slot| slot.due);
        due.is_none_or(|due| elapsed(now, due) >= message.period())
    }

    fn changed(&self, message: Message, values: &Values) -> bool {
        self.slots.get(message.number()).is_some_and(|slot| slot.sent != message.write(values))
    }

    /// CMD-3d, e: under our counter and check field.
    fn send(&mut self, now: Millis, message: Message, id: u32, values: &Values, emit: &mut impl FnMut(Frame)) {
        let Some(slot) = self.slots.get_mut(message.number()) else { return };
        let period = message.period();
        // The period runs on from when the frame was due, not from when it was sent: no drift. It begins anew after
        // a pause or a change; the very first one is shortened, so that not all messages are due together for ever.
        let first = u32::try_from(message.number()).unwrap_or(0).saturating_mul(10).checked_rem(period.raw());
        let due = slot.due.map(|due| Millis::new(due.raw().wrapping_add(period.raw())));
        slot.due = Some(match due {
            None => Millis::new(now.raw().wrapping_sub(first.unwrap_or(0))),
            Some(due) if elapsed(now, due) < period => due,
            Some(_) => now,
        });
        slot.sent = message.write(values);
        emit(Frame::new(id, message.protection().seal(id, slot.sent, slot.counter)));
        let next = slot.counter.saturating_add(1);
        slot.counter = if next < message.protection().counts() { next } else { 0 };
    }
}
