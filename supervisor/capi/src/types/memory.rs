//! Memory of the caller, opaque to him, and the numbers that he needs before he calls.

/// Version of this header. A library of another version refuses to start.
pub const SUPERVISOR_ABI_VERSION: u32 = 2;
/// Length of a sealed configuration in bytes.
pub const SUPERVISOR_SEALED_BYTES: usize = 708;
/// How many frames a step gives at most: so many must the buffer hold.
pub const SUPERVISOR_OUTPUT_FRAMES: usize = 16;
/// How many channels there are.
pub const SUPERVISOR_CHANNELS: usize = 12;
/// How many bytes answer the watchdog.
pub const SUPERVISOR_ANSWER_BYTES: usize = 4;
/// How many events are kept.
pub const SUPERVISOR_EVENTS: usize = 64;
/// How many trouble codes there are.
pub const SUPERVISOR_TROUBLES: usize = 38;
/// Words of the state. The same on every target, and more than any needs today.
pub const SUPERVISOR_STATE_WORDS: usize = 896;
/// Bytes of the state.
pub const SUPERVISOR_STATE_BYTES: usize = 8 * SUPERVISOR_STATE_WORDS;
/// Words of the diagnosis.
pub const SUPERVISOR_DIAGNOSIS_WORDS: usize = 448;
/// Bytes of the diagnosis.
pub const SUPERVISOR_DIAGNOSIS_BYTES: usize = 8 * SUPERVISOR_DIAGNOSIS_WORDS;

/// The state of a supervisor. Allocate it statically, where only the supervisor's partition can write (AOU-04), and
/// initialise it with `supervisor_init`; what is in it is nobody else's concern. It may not be copied: two copies would
/// send the same counters.
#[repr(C)]
#[derive(Debug)]
pub struct SupervisorState {
    words: [u64; SUPERVISOR_STATE_WORDS],
}

impl SupervisorState {
    /// Nothing is kept in it yet.
    pub const ZERO: Self = Self { words: [0; SUPERVISOR_STATE_WORDS] };
}

/// Event record and trouble codes. It only reads what was decided: it may stand in a partition of less trust.
#[repr(C)]
#[derive(Debug)]
pub struct SupervisorDiagnosis {
    words: [u64; SUPERVISOR_DIAGNOSIS_WORDS],
}

impl SupervisorDiagnosis {
    /// Nothing is kept in it yet.
    pub const ZERO: Self = Self { words: [0; SUPERVISOR_DIAGNOSIS_WORDS] };
}

#[cfg(test)]
mod tests {
    use super::*;
    use supervisor::wire::{Destination, Message};

    #[test]
    fn the_numbers_are_those_of_the_supervisor() {
        assert_eq!(SUPERVISOR_SEALED_BYTES, supervisor::SEALED_BYTES);
        assert_eq!(SUPERVISOR_CHANNELS, supervisor::Channel::ALL.len());
        assert_eq!(SUPERVISOR_TROUBLES, supervisor::report::TROUBLE_CODES.len());
        let sent = |message: &&Message| matches!(message.destination(), Destination::Command(_) | Destination::Status);
        assert_eq!(SUPERVISOR_OUTPUT_FRAMES, Message::ALL.iter().filter(sent).count());
    }
}
