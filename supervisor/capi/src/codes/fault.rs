//! Faults and hints of a cycle, one bit each.

/// Faults and hints: the bits of `faults` in the status.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SupervisorFault {
    /// dt outside its range in this cycle (SELF-3).
    Clock = 0x0000_0001,
    /// Retained state did not decode (SELF-5); latched.
    State = 0x0000_0002,
    /// Three clock faults in a row (SELF-3); latched.
    ClockLatched = 0x0000_0004,
    /// The configuration changed at run time (SELF-4); latched.
    Configuration = 0x0000_0008,
    /// The seat sensors disagree (SEAT-10).
    SeatDisagree = 0x0000_0010,
    /// A seat sensor is unknown (SEAT-10).
    SeatUnknown = 0x0000_0020,
    /// The speeds disagree or one is unknown (rule 6).
    SpeedUnknown = 0x0000_0040,
    /// The parking brake did not confirm in time (SEAT-4).
    EpbUnconfirmed = 0x0000_0080,
    /// K4 did not confirm in time (SEAT-7).
    K4Overdue = 0x0000_0100,
    /// The loads did not stop or K1 did not confirm in time (SEAT-7).
    K1Overdue = 0x0000_0200,
    /// Perception is unknown (MIT-7).
    PerceptionUnknown = 0x0000_0400,
    /// Time to collision and the second opinion disagree (MIT-8).
    TtcDisagreement = 0x0000_0800,
    /// The drive command is lost (E2E-2).
    DriveCommandLost = 0x0000_1000,
    /// The brake command is lost (E2E-2).
    BrakeCommandLost = 0x0000_2000,
    /// The steering command is lost (E2E-2).
    SteeringCommandLost = 0x0000_4000,
    /// The accelerator tracks disagree or one is unknown (TRQ-1).
    AcceleratorUnknown = 0x0000_8000,
    /// The brake pedal is unknown (TRQ-3).
    BrakePedalUnknown = 0x0001_0000,
    /// EBS red warning.
    EbsRed = 0x0002_0000,
    /// The driver has taken over (STR-2).
    Takeover = 0x0004_0000,
    /// The drive does not reach its torque in time, or stays beyond 15 % below it (RSP-1).
    DriveResponse = 0x0008_0000,
    /// The brakes do not reach their deceleration in time, stay beyond 15 % below it, or can not give it (RSP-1).
    BrakeResponse = 0x0010_0000,
    /// The gearbox does not follow in time (RSP-1).
    GearResponse = 0x0020_0000,
    /// The steering does not follow in time (RSP-1).
    SteeringResponse = 0x0040_0000,
    /// The drive gives more torque than it was told (TRQ-7).
    ExcessTorque = 0x0080_0000,
    /// An actuator was commanded or moved past us (SELF-10).
    Bypass = 0x0100_0000,
    /// Somebody sends under our address (SELF-10).
    SecondSender = 0x0200_0000,
    /// A contactor moved by itself or did not follow (SELF-7); latched.
    Contactor = 0x0400_0000,
    /// A stage of the cycle was skipped, repeated or out of order (SELF-6); latched.
    Flow = 0x0800_0000,
    /// A value by which the brake system splits is not plausible (VLC-3).
    SplitImplausible = 0x1000_0000,
    /// The brakes give beyond 15 % more than they were told (RSP-1).
    BrakeOvershoot = 0x2000_0000,
    /// The steering goes beyond 15 % over its target (RSP-1).
    SteeringOvershoot = 0x4000_0000,
}

/// Failure mode identifier of J1939-73: in which way. Only those that our table speaks of, or soon will.
#[repr(u8)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SupervisorFmi {
    /// Data valid but above the normal range, most severe.
    AboveNormal = 0,
    /// Data erratic, intermittent or incorrect.
    Erratic = 2,
    /// Mechanical system not responding, or out of adjustment.
    NotResponding = 7,
    /// Abnormal update rate.
    UpdateRate = 9,
    /// Bad intelligent device or component.
    BadDevice = 12,
    /// Out of calibration.
    Calibration = 13,
    /// Data valid but above the normal range, moderately severe.
    AboveNormalModerate = 16,
    /// Received network data in error.
    NetworkData = 19,
    /// Condition exists.
    ConditionExists = 31,
}

/// The lamp that a code lights (J1939-73). Ours are never emission-related: the MIL stays off.
#[repr(u8)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SupervisorLamp {
    /// None: a hint, no fault (`Faults::HINTS`).
    None = 0,
    /// Amber warning lamp: drive on with what still works.
    AmberWarning = 1,
    /// Red stop lamp: stop the bus safely.
    RedStop = 2,
}

/// What does not work, as the ADS is told. The codes are stable.
#[repr(u8)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SupervisorSystem {
    /// The supervisor itself.
    Supervisor = 0,
    /// Drive.
    Drive = 1,
    /// Service brake.
    Brake = 2,
    /// Steering.
    Steering = 3,
    /// Gearbox.
    Gear = 4,
    /// Parking brake.
    ParkingBrake = 5,
    /// High voltage.
    HighVoltage = 6,
    /// Seat sensors.
    Seat = 7,
    /// Radar and camera.
    Perception = 8,
    /// Lamps and wipers.
    Body = 9,
    /// Speed.
    Speed = 10,
}
