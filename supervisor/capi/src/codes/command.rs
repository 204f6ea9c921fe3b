//! Codes of the fields of a command.

/// Who asks for drive torque (S2).
#[repr(u8)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SupervisorOrigin {
    /// The driver's pedal.
    Driver = 0,
    /// The driver assistance (ADAS-VLC).
    Adas = 1,
    /// The brake system (EPBi-VLC).
    Epbi = 2,
}

/// Control mode of an external brake request (J1939 SPN 2916).
#[repr(u8)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SupervisorBrakeMode {
    /// Request disabled.
    Off = 0,
    /// Added to the driver's demand.
    Addition = 1,
    /// The greater of request and driver's demand: the driver's demand is the floor.
    Maximum = 2,
}

/// Priority of a request (J1939 SPN 2915, 897), 0 is the highest.
#[repr(u8)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SupervisorPriority {
    /// Highest: emergency.
    Highest = 0,
    /// High.
    High = 1,
    /// Medium.
    Medium = 2,
    /// Low.
    Low = 3,
}

/// Mode of a retarder request (J1939 SPN 695).
#[repr(u8)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SupervisorRetarderMode {
    /// Request disabled.
    Off = 0,
    /// Torque control.
    Torque = 2,
}

/// A gear request.
#[repr(u8)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SupervisorGearRequest {
    /// No request: the gearbox stays where it is.
    Hold = 0,
    /// Drive.
    Drive = 1,
    /// Reverse.
    Reverse = 2,
    /// Neutral.
    Neutral = 3,
    /// Park.
    Park = 4,
}

/// A parking-brake request.
#[repr(u8)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SupervisorEpbRequest {
    /// No request: the brake stays as it is.
    None = 0,
    /// Apply.
    Apply = 1,
    /// Release.
    Release = 2,
}

/// A contactor request.
#[repr(u8)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SupervisorContactorRequest {
    /// No request: the contactor stays as it is.
    Hold = 0,
    /// Open.
    Open = 1,
    /// Close.
    Close = 2,
}

/// Wipers.
#[repr(u8)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SupervisorWiper {
    /// Off.
    Off = 0,
    /// Interval.
    Interval = 1,
    /// Slow.
    Slow = 2,
    /// Fast.
    Fast = 3,
}

/// Requested driving mode.
#[repr(u8)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SupervisorDrivingMode {
    /// The driver drives.
    Manual = 0,
    /// Automated longitudinal control.
    Automated = 1,
}

/// Who may operate the EPB (S4 BKR 19).
#[repr(u8)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SupervisorEpbMode {
    /// Only the driver's switch.
    Manual = 0,
    /// External requests too.
    Automatic = 1,
}
