//! Codes of the boot and of the status.

/// Why the supervisor starts.
#[repr(u8)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SupervisorResetCause {
    /// Power was switched on (key-on).
    PowerOn = 0,
    /// The watchdog.
    Watchdog = 1,
    /// Anything else: brown-out, software, unknown.
    Other = 2,
}

/// What was persisted, protected by the integrator's CRC.
#[repr(u8)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SupervisorRecord {
    /// Nothing.
    None = 0,
    /// In leave, or parked by leave.
    Leave = 1,
    /// High voltage is being, or was, shut down after leave.
    HighVoltageDown = 2,
    /// What was read back fails its CRC. Never given back by a step.
    Broken = 255,
}

/// The longitudinal mode as granted.
#[repr(u8)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SupervisorMode {
    /// The driver drives.
    Manual = 0,
    /// Automated.
    Automated = 1,
    /// Automated, but the driver's accelerator governs for now (TRQ-4).
    Suspended = 2,
}

/// How far the shutdown after leave has gone.
#[repr(u8)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SupervisorStage {
    /// Not begun.
    Up = 0,
    /// Committed: K4 opens.
    OpeningK4 = 1,
    /// K4 was confirmed open: loads stop, then K1 opens.
    OpeningK1 = 2,
    /// Both were confirmed open.
    Down = 3,
}

/// What the supervisor says of the seat.
#[repr(u8)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SupervisorOccupancy {
    /// Confirmed occupied.
    Confirmed = 0,
    /// Not confirmed; no leave runs.
    NotConfirmed = 1,
    /// Leave runs.
    Leave = 2,
}

/// Why the automated mode ended (S4 ACR 8, MODE-1).
#[repr(u8)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SupervisorExitReason {
    /// It has not ended.
    None = 0,
    /// Asked for by the main controller.
    Requested = 1,
    /// Brake pedal pressed or unknown.
    BrakePedal = 2,
    /// The driver took over the steering.
    Takeover = 3,
    /// The cruise switch is off or unknown.
    Switch = 4,
    /// The automated driving system is not valid.
    AdsState = 5,
    /// The brake request was lost.
    CommandLost = 6,
    /// An input group that the mode needs is unknown.
    InputLost = 7,
    /// The driver left the seat.
    Leave = 8,
    /// Clock fault or safe state.
    Fault = 9,
    /// A mitigation level has begun: it needs new driver evidence afterwards.
    Mitigation = 10,
    /// Somebody else commands an actuator, or the drive does not obey (SELF-10, TRQ-7).
    Bypass = 11,
}

/// Level of collision mitigation that the time to collision calls for (S1 §3.1.2).
#[repr(u8)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SupervisorLevel {
    /// None.
    None = 0,
    /// Level 1: 1.0 m/s².
    One = 1,
    /// Level 2: 2.5 m/s².
    Two = 2,
    /// Level 3: 5.0 m/s².
    Three = 3,
}
