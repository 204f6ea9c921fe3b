//! What a call says of itself, what a frame was refused for, and which kind an event is.
//!
//! Every other code is one of the supervisor's own tables. They stand in `supervisor-terms` and `supervisor-report` and nowhere else;
//! `tests/header` brings them into the C header from there.

/// Whether a call was carried out. 0 to 15: it was; from 16 on it was refused, and changed nothing.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SupervisorCode {
    /// Carried out.
    Ok = 0,
    /// Carried out, and the frame counts for nothing: the receipt says why. Nothing to do; the vetting knows.
    FrameRefused = 1,
    /// Carried out: there is nothing to give at this time.
    Nothing = 2,

    /// A pointer is null.
    Null = 16,
    /// A pointer does not have the alignment of what it points to.
    Misaligned = 17,
    /// Memory is smaller than what belongs there, or ends beyond the address space.
    Size = 18,
    /// The state (or diagnosis) was never initialised, its last initialisation was refused, or it was overwritten.
    Uninitialised = 19,
    /// Two arguments share memory.
    Overlap = 20,
    /// The header that the caller was compiled with is of another version than the library.
    Version = 21,
    /// An argument is no code of its table.
    Value = 22,
    /// A call with this state runs in another context, or was broken off.
    Busy = 23,
    /// The buffer has no room for everything that may be given.
    Capacity = 24,
    /// No step since the start; for the watchdog: since the last answer.
    NotStepped = 25,
    /// The last step is too long ago: its envelope has expired.
    Expired = 26,

    /// The configuration is not `SUPERVISOR_SEALED_BYTES` long.
    ConfigLength = 32,
    /// No sealed configuration, or one of another version.
    ConfigHeader = 33,
    /// The CRC of the configuration does not match.
    ConfigCrc = 34,
    /// A word of the configuration is no value of its type.
    ConfigWord = 35,
    /// A configured value is outside its range.
    ConfigRange = 36,
    /// A relation between configured values does not hold.
    ConfigRelation = 37,
}

/// What is wrong with a frame: `fault` of the receipt.
#[repr(u8)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SupervisorFrameFault {
    /// Nothing: it was accepted.
    None = 0,
    /// No message has this identifier.
    Identifier = 1,
    /// A command from a source that is not listened to; with the supervisor's own address, a second sender of it.
    Source = 2,
    /// Not 8 bytes.
    Length = 3,
    /// CRC or checksum wrong.
    Checksum = 4,
    /// The counter is reserved or "not available".
    NoCounter = 5,
    /// A reserved bit is wrong.
    Reserved = 6,
    /// A signal has a value that is not in its table.
    Signal = 7,
    /// The counter has not moved: a repeated or frozen frame.
    Repeated = 8,
    /// The counter went back, or on by more than is tolerated.
    Sequence = 9,
    /// The first frame after a gap: nothing yet shows that its counter runs.
    NoPredecessor = 10,
}

/// What an event tells: `what` of the event.
#[repr(u8)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SupervisorEventKind {
    /// The verdict of a channel: its kind or its reason changed.
    Verdict = 0,
    /// The seat; `code` is a `SupervisorOccupancy`.
    Occupancy = 1,
    /// Parked by leave began (1) or ended (0).
    ParkedByLeave = 2,
    /// Stage of the shutdown of high voltage; `code` is a `SupervisorStage`.
    Stage = 3,
    /// Mitigation level; `code` is a `SupervisorLevel`.
    Level = 4,
    /// Longitudinal mode; `code` is a `SupervisorMode`.
    Mode = 5,
    /// The safe state began (1) or ended (0).
    SafeState = 6,
    /// The set of faults; `code` has a bit for each, see `SupervisorFault`.
    Faults = 7,
}
