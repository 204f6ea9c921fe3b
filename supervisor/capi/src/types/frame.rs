//! CAN frames, and what came of one.

use supervisor::wire::{Accepted, Fault, Frame, Message, Refusal};

use crate::codes::SupervisorFrameFault;

/// A CAN frame with a 29-bit identifier. The messages stand in `supervisor/wire/ebus.dbc`.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SupervisorFrame {
    /// Identifier, 29 bits, without any flag.
    pub id: u32,
    /// Data; bytes beyond `length` have no meaning.
    pub data: [u8; 8],
    /// Number of data bytes, 0 to 8.
    pub length: u8,
    /// Given as 0, not looked at.
    pub reserved: [u8; 3],
}

impl SupervisorFrame {
    pub(crate) const fn of(frame: Frame) -> Self {
        Self { id: frame.id, data: frame.data, length: frame.length, reserved: [0; 3] }
    }
    pub(crate) const fn frame(self) -> Frame {
        Frame { id: self.id, length: self.length, data: self.data }
    }
}

/// What came of a frame.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SupervisorReceipt {
    /// The number of its message in the table of `supervisor/wire`; 255 if no message has its identifier.
    pub message: u8,
    /// 0, or a `SupervisorFrameFault`.
    pub fault: u8,
    /// How many frames before it are missing by the counter; tolerated, to be reported.
    pub lost: u8,
    /// Given as 0.
    pub reserved: u8,
}

impl SupervisorReceipt {
    pub(crate) fn accepted(accepted: Accepted) -> Self {
        Self { message: number(accepted.message), fault: 0, lost: accepted.lost, reserved: 0 }
    }
    pub(crate) fn refused(refusal: Refusal) -> Self {
        let message = refusal.message.map_or(u8::MAX, number);
        Self { message, fault: code(refusal.fault), lost: 0, reserved: 0 }
    }
    /// A frame of the actuators' bus that is no command of somebody else.
    pub(crate) const NOTHING: Self = Self { message: u8::MAX, fault: 0, lost: 0, reserved: 0 };
}

fn number(message: Message) -> u8 {
    u8::try_from(message.number()).unwrap_or(u8::MAX)
}

fn code(fault: Fault) -> u8 {
    let fault = match fault {
        Fault::Identifier => SupervisorFrameFault::Identifier,
        Fault::Source => SupervisorFrameFault::Source,
        Fault::Length => SupervisorFrameFault::Length,
        Fault::Checksum => SupervisorFrameFault::Checksum,
        Fault::NoCounter => SupervisorFrameFault::NoCounter,
        Fault::Reserved => SupervisorFrameFault::Reserved,
        Fault::Signal(_) => SupervisorFrameFault::Signal,
        Fault::Repeated => SupervisorFrameFault::Repeated,
        Fault::Sequence => SupervisorFrameFault::Sequence,
        Fault::NoPredecessor => SupervisorFrameFault::NoPredecessor,
    };
    #[expect(clippy::as_conversions, reason = "the number of a variant without fields: no other way leads to it")]
    let code = fault as u8;
    code
}
