//! One message at the receiver: is the frame intact, well-formed, in order? (E2E-1c)

use supervisor_core::{Cause, Command, Millis, Percent, Rejection, RetarderMode};

use crate::frame::Frame;
use crate::message::Values;
use crate::qualifier::{FOREVER, Qualifier, Timing, elapsed};
use crate::refusal::Fault;
use crate::table::Message;

/// Greatest step of a counter that is taken: two frames lost. As `MaxDeltaCounter` of AUTOSAR E2E; a step that is
/// greater, or back, is refused, and the next frame is compared with the refused one.
const GREATEST_STEP: u8 = 3;

/// What the receiver keeps of one message.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(kani, derive(kani::Arbitrary))]
pub struct Link {
    pub(crate) message: Message,
    pub(crate) timing: Timing,
    /// Counter of the last intact frame, forgotten after a gap.
    counter: Option<u8>,
    /// When it came.
    heard: Millis,
    qualifier: Qualifier,
    /// Why the last frame was refused, if it was.
    rejection: Option<Rejection>,
    /// A frame was accepted since the last sample.
    pub fresh: bool,
    /// The last frame of an on-demand message asked for nothing.
    idle: bool,
}

impl Link {
    /// Nothing received yet.
    #[must_use]
    pub const fn new(message: Message, timing: Timing) -> Self {
        Self {
            message,
            timing,
            counter: None,
            heard: Millis::ZERO,
            qualifier: Qualifier::NEVER,
            rejection: None,
            fresh: false,
            idle: false,
        }
    }

    /// Checks a frame and takes its signals over into `values`; how many frames before it are lost.
    ///
    /// RULE-5a: if anything is wrong with it, the message counts as failed from now on.
    ///
    /// # Errors
    /// What is wrong with it.
    pub fn receive(&mut self, now: Millis, frame: &Frame, values: &mut Values) -> Result<u8, Fault> {
        let checked = self.check(now, frame, values);
        if checked.is_ok() {
            self.qualifier.good(now, self.patience());
            self.idle = asks_nothing(self.message, values);
        } else {
            self.qualifier.bad(now, self.patience());
        }
        (self.fresh, self.rejection) = (checked.is_ok(), checked.err().and_then(Fault::rejection));
        checked
    }

    fn check(&mut self, now: Millis, frame: &Frame, values: &mut Values) -> Result<u8, Fault> {
        if frame.length != Frame::LENGTH {
            return Err(Fault::Length);
        }
        let counter = self.message.protection().open(frame.id, frame.payload())?;
        let order = counter.map_or(Ok(0), |counter| self.order(now, counter));
        self.message.read(frame.payload(), values)?;
        order
    }

    /// E2E-1c: the counter must go on from the last intact frame by 1 to [`GREATEST_STEP`].
    ///
    /// After a gap nothing is known of how many were lost. An input then begins its requalification; a command waits
    /// for a second frame, or any old frame could be replayed.
    fn order(&mut self, now: Millis, counter: u8) -> Result<u8, Fault> {
        self.forget(now);
        self.heard = now;
        let Some(last) = self.counter.replace(counter) else {
            return if self.message.is_command() { Err(Fault::NoPredecessor) } else { Ok(0) };
        };
        let wrapped = if counter < last { self.message.protection().counts() } else { 0 };
        match counter.saturating_add(wrapped).saturating_sub(last) {
            0 => Err(Fault::Repeated),
            step @ 1..=GREATEST_STEP => Ok(step.saturating_sub(1)),
            _ => Err(Fault::Sequence),
        }
    }

    /// The counter that the next frame must go on from; `None` after a gap.
    #[must_use]
    pub fn predecessor(&self, now: Millis) -> Option<u8> {
        self.counter.filter(|_| elapsed(now, self.heard) <= self.timing.timeout)
    }

    /// Forgets the counter after a gap; called in every cycle, so the clock cannot wrap unseen.
    fn forget(&mut self, now: Millis) {
        self.counter = self.predecessor(now);
    }

    /// E2E-1h: after a frame that asked for nothing, an on-demand message does not time out.
    fn patience(&self) -> Timing {
        if self.idle { Timing { timeout: FOREVER, ..self.timing } } else { self.timing }
    }

    /// The counter of the last frame, if it was accepted.
    pub(crate) fn good_counter(&self) -> Option<u8> {
        self.counter.filter(|_| self.rejection.is_none())
    }

    /// Age, or cause of "unknown".
    ///
    /// # Errors
    /// The cause.
    pub fn quality(&mut self, now: Millis) -> Result<Millis, Cause> {
        self.forget(now);
        self.qualifier.quality(now, self.patience())
    }

    /// CMD-2a to CMD-2d: the message as a command with this value.
    pub fn command<T>(&mut self, now: Millis, value: T) -> Command<T> {
        match (self.quality(now), self.rejection) {
            (Ok(_), _) if self.fresh => Command::Fresh(value),
            (Ok(age), _) => Command::Held(age.min(self.timing.timeout), value),
            (Err(Cause::EndToEnd), Some(why)) => Command::Rejected(why),
            (Err(_), _) => Command::Absent,
        }
    }
}

/// Whether an on-demand message (TSC1: pauses up to 2.98 s on real trucks) asks for nothing.
fn asks_nothing(message: Message, values: &Values) -> bool {
    let (drive, retarder) = (values.outputs.drive, values.outputs.retarder);
    message == Message::DriveTorque && !drive.active && drive.torque == Percent::ZERO
        || message == Message::Retarder && retarder.mode == RetarderMode::Off
}
