//! From outputs and status to frames. What sends inputs and commands is in `simulate.rs`.

#[cfg(feature = "simulate")]
mod simulate;

#[cfg(feature = "simulate")]
use supervisor_core::Count;
use supervisor_core::{Channel, Millis, Outputs, Status};

use crate::frame::Frame;
use crate::message::{Destination, Source, Values};
use crate::qualifier::elapsed;
use crate::table::Message;

/// SELF-10b: how long after it was sent a frame may come back: two cycles. A controller that hands back its own frames
/// does so when they are on the bus; one that waits longer for the bus is a fault of its own.
const ECHO: Millis = Millis::new(20);

/// A frame that was sent.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(kani, derive(kani::Arbitrary))]
pub(crate) struct Sent {
    /// Without counter and check field.
    payload: u64,
    pub(crate) counter: u8,
    at: Millis,
    /// It has come back: what looks the same from now on is of somebody else.
    echoed: bool,
}

/// What the sender keeps of one message.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(kani, derive(kani::Arbitrary))]
pub(crate) struct Slot {
    /// When it was due last.
    due: Millis,
    /// The last frame and the one before it.
    pub(crate) sent: [Option<Sent>; 2],
}

/// Sends frames: keeps counters and periods.
#[derive(Clone, Debug)]
#[cfg_attr(kani, derive(kani::Arbitrary))]
pub struct Sender {
    pub(crate) slots: [Slot; Message::COUNT],
    /// Cycles of the next object lists, of radar and camera.
    #[cfg(feature = "simulate")]
    cycles: [Count; 2],
}

impl Default for Sender {
    fn default() -> Self {
        Self::new()
    }
}

impl Sender {
    /// Nothing sent yet.
    #[must_use]
    pub const fn new() -> Self {
        let slot = Slot { due: Millis::ZERO, sent: [None; 2] };
        Self {
            slots: [slot; Message::COUNT],
            #[cfg(feature = "simulate")]
            cycles: [Count::ZERO; 2],
        }
    }

    /// Sends the outputs that are due or have changed, as the supervisor (CMD-3d, SELF-8a).
    pub fn encode_outputs(&mut self, now: Millis, outputs: &Outputs, emit: &mut impl FnMut(Frame)) {
        self.encode(now, Source::Supervisor, outputs, |_| true, emit);
    }

    /// Sends what the supervisor says of itself, when it is due (SELF-8a, RPT-1b). `now` goes along as time stamp.
    pub fn encode_status(&mut self, now: Millis, status: &Status, emit: &mut impl FnMut(Frame)) {
        let values = Values { status: *status, stamp: now, ..Values::NONE };
        self.send_due(now, Destination::Status, &values, emit);
    }

    /// Messages of one sender that are due.
    fn send_due(&mut self, now: Millis, to: Destination, values: &Values, emit: &mut impl FnMut(Frame)) {
        for message in Message::ALL.iter().copied().filter(|message| message.destination() == to) {
            if self.due(now, message) {
                self.send(now, message, message.id(), values, emit);
            }
        }
    }

    /// SELF-10b: whether this frame from the bus is ours, handed back: to the bit one of the last two that were sent of
    /// this message, within [`ECHO`]. Each comes back once.
    ///
    /// Two, because one may still wait for the bus when the next is sent; once, because a frame that is repeated makes
    /// the actuator refuse the counter.
    pub(crate) fn takes_back(&mut self, now: Millis, message: Message, frame: &Frame) -> bool {
        let (id, protection) = (message.id_from(Source::Supervisor), message.protection());
        let is_it = |sent: &&mut Sent| {
            let same = *frame == Frame::new(id, protection.seal(id, sent.payload, sent.counter));
            same && !sent.echoed && elapsed(now, sent.at) <= ECHO
        };
        let slot = self.slots.get_mut(message.number());
        let sent = slot.and_then(|slot| slot.sent.iter_mut().flatten().find(is_it));
        sent.map(|sent| sent.echoed = true).is_some()
    }

    /// The channels that are `present`; all frames of a channel go together.
    fn encode(
        &mut self,
        now: Millis,
        source: Source,
        outputs: &Outputs,
        present: impl Fn(&Channel) -> bool,
        emit: &mut impl FnMut(Frame),
    ) {
        let values = Values { outputs: *outputs, ..Values::NONE };
        for channel in Channel::ALL.iter().copied().filter(present) {
            let messages = Message::ALL.iter().filter(|message| message.destination() == Destination::Command(channel));
            if messages.clone().any(|message| self.due(now, *message) || self.changed(*message, &values)) {
                messages.for_each(|message| self.send(now, *message, message.id_from(source), &values, emit));
            }
        }
    }

    fn due(&self, now: Millis, message: Message) -> bool {
        let slot = self.slots.get(message.number());
        slot.is_some_and(|slot| slot.sent[0].is_none() || elapsed(now, slot.due) >= message.period())
    }

    fn changed(&self, message: Message, values: &Values) -> bool {
        let sent = self.slots.get(message.number()).and_then(|slot| slot.sent[0]);
        sent.is_none_or(|sent| sent.payload != message.write(values))
    }

    /// CMD-3d, e: under our counter and check field.
    pub(crate) fn send(
        &mut self,
        now: Millis,
        message: Message,
        id: u32,
        values: &Values,
        emit: &mut impl FnMut(Frame),
    ) {
        let Some(slot) = self.slots.get_mut(message.number()) else { return };
        let period = message.period();
        // The period runs on from when the frame was due, not from when it was sent: no drift. It begins anew after
        // a pause or a change; the very first one is shortened, so that not all messages are due together for ever.
        let first = u32::try_from(message.number()).unwrap_or(0).saturating_mul(10).checked_rem(period.raw());
        let due = Millis::new(slot.due.raw().wrapping_add(period.raw()));
        let [last, _] = slot.sent;
        slot.due = match last {
            None => Millis::new(now.raw().wrapping_sub(first.unwrap_or(0))),
            Some(_) if elapsed(now, due) < period => due,
            Some(_) => now,
        };
        let next = last.map_or(0, |last| last.counter.saturating_add(1));
        let counter = if next < message.protection().counts() { next } else { 0 };
        let payload = message.write(values);
        slot.sent = [Some(Sent { payload, counter, at: now, echoed: false }), last];
        emit(Frame::new(id, message.protection().seal(id, payload, counter)));
    }
}
