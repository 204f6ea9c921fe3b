//! What was decided of a command, and why.

use crate::command::Channel;
use crate::word::codes;

codes! {
    /// What happened to a command.
    Kind {
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
    Reason {
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
    /// Why the automated mode ended (S4 ACR 8, MODE-1).
    ExitReason {
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
}

/// The verdict of one channel in one cycle.
///
/// `value` and `limit` are in the unit of the field that `reason` speaks of; for yes/no fields 0 and 1, for
/// enums the code. `margin` is `limit - value` for an upper bound and `value - limit` for a lower one: negative
/// by as much as the command was outside.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Verdict {
    /// What happened.
    pub kind: Kind,
    /// Why.
    pub reason: Reason,
    /// The offending (or the tightest) value.
    pub value: i32,
    /// Its limit.
    pub limit: i32,
    /// How far inside (positive) or outside (negative) the value was.
    pub margin: i32,
}

impl Verdict {
    /// Passed; nothing to say about a margin.
    pub const PASS: Self = Self { kind: Kind::Pass, reason: Reason::Within, value: 0, limit: 0, margin: 0 };

    /// CMD-5b, c, d: judged against an upper bound.
    #[must_use]
    pub const fn above(kind: Kind, reason: Reason, value: i32, limit: i32) -> Self {
        Self { kind, reason, value, limit, margin: limit.saturating_sub(value) }
    }
    /// CMD-5b, c, d: judged against a lower bound.
    #[must_use]
    pub const fn below(kind: Kind, reason: Reason, value: i32, limit: i32) -> Self {
        Self { kind, reason, value, limit, margin: value.saturating_sub(limit) }
    }
    /// Refused for a fact: `value` is the code asked for, `limit` the code that goes out instead.
    #[must_use]
    pub fn fact(kind: Kind, reason: Reason, value: u8, limit: u8) -> Self {
        Self { kind, reason, value: i32::from(value), limit: i32::from(limit), margin: -1 }
    }
    /// Whether the command went out unchanged.
    #[must_use]
    pub fn passed(self) -> bool {
        self.kind == Kind::Pass
    }
}

/// One verdict per channel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Verdicts {
    /// In the order of [`Channel`].
    list: [Verdict; 12],
}

impl Verdicts {
    /// CMD-5a: the verdicts in the order of [`Channel`], one for each.
    #[must_use]
    pub const fn new(list: [Verdict; 12]) -> Self {
        Self { list }
    }
    /// The verdict of a channel.
    #[must_use]
    pub fn of(&self, channel: Channel) -> Verdict {
        self.list.get(usize::from(channel.code())).copied().unwrap_or(Verdict::PASS)
    }
    /// Every channel with its verdict.
    pub fn iter(&self) -> impl Iterator<Item = (Channel, Verdict)> + '_ {
        Channel::ALL.iter().copied().zip(self.list.iter().copied())
    }
}

/// The faults and hints of a cycle, one bit each. Debounced by `supervisor-report`, never here.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(kani, derive(kani::Arbitrary))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
pub struct Faults(u32);

macro_rules! faults {
    ($($(#[$doc:meta])* $name:ident = $bit:literal;)*) => {
        impl Faults {
            $($(#[$doc])* pub const $name: Self = Self(1 << $bit);)*
            /// Every fault with its name.
            pub const NAMES: &'static [(Self, &'static str)] = &[$((Self::$name, stringify!($name)),)*];
        }
    };
}

faults! {
    /// dt outside its range in this cycle (SELF-3).
    CLOCK = 0;
    /// Retained state did not decode (SELF-5); latched.
    STATE = 1;
    /// Three clock faults in a row (SELF-3); latched.
    CLOCK_LATCHED = 2;
    /// The configuration changed at run time (SELF-4); latched.
    CONFIGURATION = 3;
    /// The seat sensors disagree (SEAT-10).
    SEAT_DISAGREE = 4;
    /// A seat sensor is unknown (SEAT-10).
    SEAT_UNKNOWN = 5;
    /// The speeds disagree or one is unknown (rule 6).
    SPEED_UNKNOWN = 6;
    /// The parking brake did not confirm in time (SEAT-4).
    EPB_UNCONFIRMED = 7;
    /// K4 did not confirm in time (SEAT-7).
    K4_OVERDUE = 8;
    /// The loads did not stop or K1 did not confirm in time (SEAT-7).
    K1_OVERDUE = 9;
    /// Perception is unknown (MIT-7).
    PERCEPTION_UNKNOWN = 10;
    /// Time to collision and the second opinion disagree (MIT-8).
    TTC_DISAGREEMENT = 11;
    /// The drive command is lost (E2E-2).
    DRIVE_COMMAND_LOST = 12;
    /// The brake command is lost (E2E-2).
    BRAKE_COMMAND_LOST = 13;
    /// The steering command is lost (E2E-2).
    STEERING_COMMAND_LOST = 14;
    /// The accelerator tracks disagree or one is unknown (TRQ-1).
    ACCELERATOR_UNKNOWN = 15;
    /// The brake pedal is unknown (TRQ-3).
    BRAKE_PEDAL_UNKNOWN = 16;
    /// EBS red warning.
    EBS_RED = 17;
    /// The driver has taken over (STR-2).
    TAKEOVER = 18;
    /// The drive does not reach its torque in time, or stays beyond 15 % below it (RSP-1).
    DRIVE_RESPONSE = 19;
    /// The brakes do not reach their deceleration in time, stay beyond 15 % below it, or can not give it (RSP-1).
    BRAKE_RESPONSE = 20;
    /// The gearbox does not follow in time (RSP-1).
    GEAR_RESPONSE = 21;
    /// The steering does not follow in time (RSP-1).
    STEERING_RESPONSE = 22;
    /// The drive gives more torque than it was told (TRQ-7).
    EXCESS_TORQUE = 23;
    /// An actuator was commanded or moved past us (SELF-10).
    BYPASS = 24;
    /// Somebody sends under our address (SELF-10).
    SECOND_SENDER = 25;
    /// A contactor moved by itself or did not follow (SELF-7); latched.
    CONTACTOR = 26;
    /// A stage of the cycle was skipped, repeated or out of order (SELF-6); latched.
    FLOW = 27;
    /// A value by which the brake system splits is not plausible (VLC-3).
    SPLIT_IMPLAUSIBLE = 28;
    /// The brakes give beyond 15 % more than they were told (RSP-1).
    BRAKE_OVERSHOOT = 29;
    /// The steering goes beyond 15 % over its target (RSP-1).
    STEERING_OVERSHOOT = 30;
}

impl Faults {
    /// No fault.
    pub const NONE: Self = Self(0);
    /// What is reported without a fault lamp.
    pub const HINTS: Self = Self::TTC_DISAGREEMENT.with(Self::TAKEOVER);
    /// What is the safe state while it is latched.
    pub const SAFE_STATE: Self = Self::STATE.with(Self::CLOCK_LATCHED).with(Self::CONFIGURATION).with(Self::FLOW);
    /// The bits.
    #[must_use]
    pub const fn bits(self) -> u32 {
        self.0
    }
    /// Both sets together.
    #[must_use]
    pub const fn with(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }
    /// This set less another.
    #[must_use]
    pub const fn without(self, other: Self) -> Self {
        Self(self.0 & !other.0)
    }
    /// Adds `fault` where `condition` holds.
    #[must_use]
    pub const fn when(self, condition: bool, fault: Self) -> Self {
        if condition { self.with(fault) } else { self }
    }
    /// What both sets have.
    #[must_use]
    pub const fn and(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }
    /// Whether every fault of `other` is in this set.
    #[must_use]
    pub const fn contains(self, other: Self) -> bool {
        self.0 & other.0 == other.0
    }
}

impl crate::word::Word for Faults {
    fn to_word(self) -> u32 {
        self.0
    }
    fn from_word(word: u32) -> Option<Self> {
        Some(Self(word))
    }
}
