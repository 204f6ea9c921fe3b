//! Raw CAN frames through the decoder and the step: nothing panics, and what goes out is inside the envelope.
#![no_main]

use arbitrary::Arbitrary;
use libfuzzer_sys::fuzz_target;
use supervisor::wire::{Frame, Message, Receiver};
use supervisor::{Config, Millis, Record, ResetCause, Sealed, Supervisor, vet};
use supervisor_proofs::properties::vetting::{self_2_sound, self_2_transparent};

/// One event on the bus.
#[derive(Debug, Arbitrary)]
enum Event {
    /// A frame with the identifier of a known message.
    Known { message: u8, length: u8, data: [u8; 8] },
    /// Any frame.
    Any { id: u32, length: u8, data: [u8; 8] },
    /// A cycle after this many milliseconds.
    Step { elapsed: u8 },
}

fuzz_target!(|events: Vec<Event>| {
    let Ok(sealed) = Sealed::from_default() else { return };
    let mut supervisor = Supervisor::new(sealed, ResetCause::PowerOn, Some(Record::None));
    let mut receiver = Receiver::new(&Config::DEFAULT);
    let mut now = 0_u32;
    for event in events {
        let frame = match event {
            Event::Known { message, length, data } => {
                let message = Message::ALL[usize::from(message) % Message::ALL.len()];
                Frame { id: message.id(), length, data }
            }
            Event::Any { id, length, data } => Frame { id, length, data },
            Event::Step { elapsed } => {
                now = now.wrapping_add(u32::from(elapsed));
                let sample = receiver.sample(Millis::new(now));
                let decision = supervisor.step(Millis::new(now), sample.inputs, sample.scene, sample.commands);
                assert!(decision.envelope.is_feasible());
                assert!(self_2_sound(&decision.envelope, &decision.outputs));
                assert!(self_2_transparent(&decision.envelope, sample.commands, &decision.outputs, &decision.verdicts));
                assert_eq!(vet(&decision.envelope, &decision.outputs.as_commands()).0, decision.outputs);
                continue;
            }
        };
        let _ = receiver.accept(Millis::new(now), &frame);
    }
});
