//! Codes of a verdict: channel, kind, reason.

/// The actuator channels, in the order of spec §2.
#[repr(u8)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SupervisorChannel {
    /// Drive torque.
    DriveTorque = 0,
    /// Target speed.
    TargetSpeed = 1,
    /// Service brake.
    ServiceBrake = 2,
    /// Retarder.
    Retarder = 3,
    /// Gear.
    Gear = 4,
    /// Electric parking brake.
    ParkingBrake = 5,
    /// Steering.
    Steering = 6,
    /// Contactors K4 and K1.
    Contactors = 7,
    /// Auxiliaries.
    Auxiliaries = 8,
    /// Warnings.
    Warnings = 9,
    /// Body.
    Body = 10,
    /// Mode request.
    Mode = 11,
}

/// What happened to a command.
#[repr(u8)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SupervisorKind {
    /// Every signal unchanged.
    Pass = 0,
    /// Moved to the nearest safe value.
    Limit = 1,
    /// Replaced by the obligation, or by the fallback of a lost command.
    Substitute = 2,
    /// Replaced by the channel's neutral value.
    Block = 3,
}

/// Why. The codes are stable; the requirement stands behind each.
#[repr(u8)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SupervisorReason {
    /// Inside the envelope.
    Within = 0,
    /// No command in time (E2E-2).
    CommandLost = 1,
    /// The frame failed its check (rule 5).
    CommandRejected = 2,
    /// Safe state (SELF-5).
    SafeState = 3,
    /// Clock fault in this cycle (SELF-3).
    ClockFault = 4,
    /// Somebody else commands an actuator, or one moved by itself (SELF-10).
    Bypass = 5,
    /// A mitigation level runs (MIT-1 to MIT-5).
    Mitigation = 10,
    /// Leave runs (SEAT-2, SEAT-3).
    Leave = 11,
    /// Speed is lost after an obligation: the bus is held (MIT-7).
    SpeedlessHold = 12,
    /// Comfort cap: the road is known to be clear (PHB-1).
    PhantomBraking = 13,
    /// Greatest deceleration (PHB-1).
    BrakeCap = 14,
    /// Brake pedal pressed or unknown: no comfort braking (TRQ-3).
    BrakePedal = 15,
    /// The driver overrides: no comfort braking (TRQ-4).
    DriverOverride = 16,
    /// The obligation needs its own mode and priority (spec §2).
    BrakeMode = 17,
    /// Electric limit, unknown, or slip control at work (VLC-2).
    ElectricLimit = 18,
    /// ABS at work (RET-1).
    AntiLock = 19,
    /// The brakes give less than is obliged: the next stronger means (RSP-1, EPB-1).
    BrakeResponse = 20,
    /// More torque than the accelerator allows (TRQ-1).
    PedalMap = 30,
    /// Accelerator unknown (TRQ-1).
    AcceleratorUnknown = 31,
    /// Both pedals, or the brake pedal is unknown (TRQ-1, TRQ-3).
    BothPedals = 32,
    /// The sender's active flag is not set (TRQ-2).
    NotActive = 33,
    /// The mode is not granted by driver evidence (TRQ-2, MODE-1).
    ModeNotGranted = 34,
    /// Perception unknown (TRQ-2).
    PerceptionUnknown = 35,
    /// Our own acceleration bound (TRQ-2).
    AccelerationBound = 36,
    /// Electric limit of VCU and battery, or unknown (TRQ-5).
    DriveLimit = 37,
    /// Rising faster than the gradient (TRQ-5).
    TorqueRamp = 38,
    /// After leave the accelerator has not been seen released (TRQ-5).
    ReleaseNeeded = 39,
    /// EPBi torque below the idle torque (TRQ-5).
    IdleTorque = 40,
    /// A brake demand runs (TRQ-6).
    BrakeDemand = 41,
    /// The confirmed gear has no drive direction, or differs from the requested one (TRQ-6).
    GearDirection = 42,
    /// Slip control at work or unknown: no rise (RSP-1).
    SlipControl = 43,
    /// An obstacle ahead calls for mitigation: no automated torque towards it (TRQ-2).
    ObstacleAhead = 45,
    /// The drive gives more than it was told (TRQ-7).
    ExcessTorque = 46,
    /// The sender belongs to the longitudinal mode that is not configured (VLC-1).
    NotConfigured = 47,
    /// Target speed above the limit or above what the mode allows (SPD-1).
    SpeedLimit = 44,
    /// The seat is not confirmed occupied (SEAT-5, SEAT-6, SEAT-8).
    SeatNotOccupied = 50,
    /// Parked by leave: K1, K4, gear and accelerator are not all confirmed (SEAT-5).
    ParkedByLeave = 51,
    /// The parking brake is to be applied (SEAT-4).
    EpbApply = 52,
    /// The driver's own switch says apply (EPB-1).
    DriverSwitch = 53,
    /// Too fast, or speed unknown, to apply the parking brake (EPB-1).
    EpbSpeed = 54,
    /// Not at standstill, or speed unknown (GEAR-1, HV-1, AUX-1).
    NotStandstill = 55,
    /// The driver's selector does not ask for it, or is unknown (GEAR-1).
    Selector = 56,
    /// Parked by leave: neutral (SEAT-6).
    NeutralObliged = 57,
    /// High voltage is shut down after leave (SEAT-7).
    Shutdown = 60,
    /// K4 is not confirmed open (SEAT-7, HV-1).
    K4NotOpen = 61,
    /// Drive or auxiliaries are not confirmed stopped (SEAT-7, HV-1).
    LoadsNotStopped = 62,
    /// Closing needs seat, key Off, key Start in that order (SEAT-8).
    NoRestart = 63,
    /// K1 is not confirmed closed: K1 closes before K4 (SEAT-8).
    K1NotClosed = 64,
    /// A contactor fault is latched: nothing closes (SELF-7).
    ContactorFault = 65,
    /// Automatic steering is not permitted (STR-2).
    SteeringRefused = 70,
    /// The driver has taken over (STR-2).
    Takeover = 71,
    /// The power steering is derated, failed or unknown (STR-2).
    PowerSteering = 72,
    /// Outside the speed range, or speed unknown (STR-2).
    SteeringSpeed = 73,
    /// Angle outside the envelope (STR-1).
    SteeringAngle = 74,
    /// Rate above the bound (STR-1).
    SteeringRate = 75,
    /// Overlay torque above the bound (STR-1).
    SteeringOverlay = 76,
    /// Weight above the fade (STR-2) or above 100 %.
    SteeringWeight = 77,
    /// The bar-torque limit would widen the authority (STR-1).
    BarTorque = 78,
    /// The steering does not follow (RSP-1).
    SteeringResponse = 79,
    /// A warning is obliged (FCW-1, PCW-1, SEAT-1, RPT-1).
    WarningObliged = 80,
    /// Brake lamps are obliged (BODY-1).
    BrakeLamps = 81,
    /// Hazard flashers override the indicators (BODY-1).
    HazardFlashers = 82,
    /// A percentage above 100 (CMD: fields).
    FieldRange = 83,
}
