//! Single parts of the link, to be proved one by one (feature `inspect`): no vehicle needs them.

use supervisor_core::Millis;

use crate::frame::Frame;
pub use crate::link::Link;
pub use crate::list::{Entry, List};
use crate::message::Source;
pub use crate::message::Values;
use crate::qualifier::Timing;
use crate::refusal::Fault;
use crate::sender::Sender;
use crate::table::Message;

/// Sends one message of ours, due or not.
pub fn send(sender: &mut Sender, now: Millis, message: Message, values: &Values, emit: &mut impl FnMut(Frame)) {
    sender.send(now, message, message.id_from(Source::Supervisor), values, emit);
}

/// Reads the signals of a message.
///
/// # Errors
/// The first thing that means nothing.
pub fn read(message: Message, payload: u64, values: &mut Values) -> Result<(), Fault> {
    message.read(payload, values)
}

/// Writes the signals of a message, without counter and check field.
#[must_use]
pub fn write(message: Message, values: &Values) -> u64 {
    message.write(values)
}

/// The message with this identifier, and from whom it comes.
#[must_use]
pub fn identify(id: u32) -> Option<(Message, Source)> {
    Message::identify(id)
}

impl Link {
    /// The same state, of this message.
    #[must_use]
    pub const fn of(mut self, message: Message) -> Self {
        self.message = message;
        self
    }

    /// The same state, with these times.
    #[must_use]
    pub const fn timed(mut self, timing: Timing) -> Self {
        self.timing = timing;
        self
    }
}

impl Sender {
    /// The counter of the last frame of this message.
    #[must_use]
    pub fn counter(&self, message: Message) -> Option<u8> {
        let [last, _] = self.slots.get(message.number())?.sent;
        Some(last?.counter)
    }
}
