//! What only a simulation sends: inputs and object lists as the sensors do, commands as the main controller does.
//!
//! Behind the feature `simulate`: not in the supervisor that is shipped, which sends outputs and status alone.

use supervisor_core::{Channel, Commands, Count, Inputs, Millis, Outputs, Signal};
use supervisor_perceive::Scene;

use super::Sender;
use crate::frame::Frame;
use crate::list::{Entry, Object};
use crate::message::{Destination, Source, Values};
use crate::qualifier::FOREVER;
use crate::table::Message;

/// The entries of a whole list, at least one.
fn list<T: Object>(cycle: Count, known: bool, objects: &[T]) -> impl Iterator<Item = Entry<T>> {
    let objects = if known { objects } else { &[] };
    let count = u8::try_from(objects.len()).unwrap_or(u8::MAX);
    let length = if known { Signal::Known(Count::new(count)) } else { Signal::NEVER };
    (0..count.max(1)).map(move |index| {
        let object = objects.get(usize::from(index)).copied().unwrap_or(T::NONE);
        Entry { cycle, index: Count::new(index), length, object }
    })
}

/// The cycle of the next list: 2 bits.
fn next(cycle: Count) -> Count {
    Count::new(cycle.raw().wrapping_add(1) & 3)
}

/// The values of the commands, and which channels have one: refused and absent ones are not sent.
macro_rules! gather {
    ($commands:ident; $($field:ident: $channel:ident),*) => {(
        Outputs { $($field: $commands.$field.usable(FOREVER).unwrap_or(Outputs::NEUTRAL.$field),)* },
        |channel: &Channel| match channel { $(Channel::$channel => $commands.$field.usable(FOREVER).is_ok(),)* },
    )};
}

impl Sender {
    /// Sends the inputs and object lists that are due, as their sensors. What is unknown is sent as "not available".
    pub fn encode_inputs(&mut self, now: Millis, inputs: &Inputs, scene: &Scene, emit: &mut impl FnMut(Frame)) {
        let mut values = Values { inputs: *inputs, ..Values::NONE };
        self.send_due(now, Destination::Input, &values, emit);
        if self.due(now, Message::RadarPosition) {
            for entry in list(self.cycles[0], scene.radar_known, &scene.radar) {
                values.radar = entry;
                for part in [Message::RadarPosition, Message::RadarMotion] {
                    self.send(now, part, part.id(), &values, emit);
                }
            }
            self.cycles[0] = next(self.cycles[0]);
        }
        if self.due(now, Message::CameraObject) {
            for entry in list(self.cycles[1], scene.camera_known, &scene.camera) {
                values.camera = entry;
                for part in [Message::CameraObject, Message::CameraCorner, Message::CameraSize] {
                    self.send(now, part, part.id(), &values, emit);
                }
            }
            self.cycles[1] = next(self.cycles[1]);
        }
    }

    /// Sends the commands that are due or have changed, as the main controller.
    pub fn encode_commands(&mut self, now: Millis, commands: &Commands, emit: &mut impl FnMut(Frame)) {
        let (outputs, present) = gather!(commands; drive: DriveTorque, target_speed: TargetSpeed, brake: ServiceBrake,
            retarder: Retarder, gear: Gear, epb: ParkingBrake, steering: Steering, contactors: Contactors,
            auxiliaries: Auxiliaries, warnings: Warnings, body: Body, mode: Mode);
        self.encode(now, Source::MainController, &outputs, present, emit);
    }
}
