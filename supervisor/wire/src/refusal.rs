//! What came of a frame: accepted, or refused with the reason.

use core::fmt;

use supervisor_core::Rejection;

use crate::table::Message;

/// A frame that was taken over.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Accepted {
    /// Which message it is.
    pub message: Message,
    /// How many frames before it are missing by the counter: tolerated, to be reported.
    pub lost: u8,
}

/// A frame that was not taken over.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Refusal {
    /// Which message it claims to be; `None` if its id is not in the table.
    pub message: Option<Message>,
    /// What is wrong with it.
    pub fault: Fault,
}

macro_rules! faults {
    ($($(#[$doc:meta])* $fault:ident $(($signal:ident: $type:ty))? = $text:literal, $rejection:expr;)*) => {
        /// What is wrong with a frame.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum Fault { $($(#[$doc])* $fault $(($type))?,)* }

        impl Fault {
            /// What the vetting is told; `None` if no channel is concerned.
            #[must_use]
            pub const fn rejection(self) -> Option<Rejection> {
                match self { $(Self::$fault { .. } => $rejection,)* }
            }
        }

        impl fmt::Display for Fault {
            fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
                match self { $(Self::$fault $(($signal))? => write!(formatter, $text),)* }
            }
        }
    };
}

faults! {
    /// No message has this id (CMD-1a).
    Identifier = "identifier is not in the table", None;
    /// A command from a source that is not listened to; with the supervisor's own address, a second sender of it
    /// (SELF-10b).
    Source = "wrong source address", None;
    /// Not 8 bytes.
    Length = "length is not 8", Some(Rejection::Form);
    /// CRC or checksum wrong (E2E-1b).
    Checksum = "checksum wrong", Some(Rejection::Checksum);
    /// The counter is reserved or "not available".
    NoCounter = "counter reserved or not available", Some(Rejection::Counter);
    /// A reserved bit is wrong.
    Reserved = "reserved bit wrong", Some(Rejection::Form);
    /// This signal has a value that is not in its table (CMD-1b, CMD-1c).
    Signal(signal: &'static str) = "value of {signal} is not in its table", Some(Rejection::Field);
    /// The counter has not moved: a repeated or frozen frame (E2E-1c).
    Repeated = "counter repeated", Some(Rejection::Counter);
    /// The counter went back, or on by more than is tolerated (E2E-1c).
    Sequence = "counter out of sequence", Some(Rejection::Counter);
    /// The first frame after a gap: nothing yet shows that its counter runs.
    NoPredecessor = "first frame after a gap", Some(Rejection::Requalifying);
}

impl fmt::Display for Refusal {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{}: {}", self.message.map_or("unknown", Message::name), self.fault)
    }
}
