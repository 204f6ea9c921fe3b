//! What the injector can do, by the names that `safety-case/analysis/faults.toml` uses.

/// Declares an enum whose variants have a name.
macro_rules! named {
    ($($(#[$doc:meta])* $kind:ident { $($(#[$variant_doc:meta])* $variant:ident = $name:literal,)+ })*) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
        pub enum $kind { $($(#[$variant_doc])* $variant,)+ }

        impl $kind {
            /// Every one, with its name.
            pub const NAMES: &'static [(Self, &'static str)] = &[$((Self::$variant, $name),)+];

            /// The one of this name.
            #[must_use]
            pub fn named(name: &str) -> Option<Self> {
                Self::NAMES.iter().find(|(_, known)| *known == name).map(|(kind, _)| *kind)
            }

            /// Its name.
            #[must_use]
            pub const fn name(self) -> &'static str {
                match self { $(Self::$variant => $name,)+ }
            }
        }
    )*};
}

named! {
    /// What the main controller asks for.
    Wrong {
        /// Every value stays.
        Stuck = "commands_stuck",
        /// Every value comes late.
        Late = "commands_late",
        /// Nothing is sent.
        Silent = "silent",
        /// Full torque in the driver's name.
        FullTorque = "full_torque",
        /// Full torque in the assistant's name.
        AdasTorque = "adas_torque",
        /// The torque grows.
        TorqueDrifts = "torque_drift",
        /// The torque jumps.
        TorqueOscillates = "torque_oscillates",
        /// Four times the torque.
        TorqueWrongUnit = "torque_wrong_unit",
        /// Torque for brake, brake for torque.
        ChannelsSwapped = "channels_swapped",
        /// Torque against the brake pedal.
        TorqueWhileBraking = "torque_while_braking",
        /// Nobody sits: it does not care.
        IgnoresSeat = "ignores_seat",
        /// Something stands ahead: it does not care.
        IgnoresRoad = "ignores_road",
        /// It never brakes.
        NoBrake = "no_brake",
        /// It brakes with a third.
        WeakBrake = "weak_brake",
        /// It brakes for nothing.
        PhantomBraking = "phantom_braking",
        /// The brake demand jumps.
        BrakeOscillates = "brake_oscillates",
        /// Brake and retarder together are too much.
        RetarderOnTop = "retarder_on_top",
        /// It releases the parking brake.
        ReleasesEpb = "releases_epb",
        /// It applies the parking brake.
        AppliesEpb = "applies_epb",
        /// It drives off by itself.
        DrivesOff = "drives_off_empty",
        /// It shifts to R.
        ShiftsToReverse = "shifts_to_reverse",
        /// It shifts to P.
        ShiftsToPark = "shifts_to_park",
        /// R for D.
        WrongDirection = "wrong_direction",
        /// K1 before K4.
        OpensK1 = "opens_k1_first",
        /// K4 opens.
        OpensK4 = "opens_k4",
        /// Both open at once.
        OpensBoth = "opens_both",
        /// K4 closes, then K1.
        ClosesK4 = "closes_k4_first",
        /// High voltage stays up.
        KeepsHighVoltage = "keeps_high_voltage",
        /// K1 closes, then K4.
        ClosesHighVoltage = "closes_high_voltage",
        /// The steering jumps.
        SteeringStep = "steering_step",
        /// The steering jumps to and fro.
        SteeringOscillates = "steering_oscillates",
        /// The steering runs away slowly.
        SteeringCreeps = "steering_creeps",
        /// Auxiliaries off.
        AuxiliariesOff = "auxiliaries_off",
        /// Lamps and warnings off.
        LampsOff = "lamps_off",
        /// Automated without being asked to.
        WrongMode = "wrong_mode",
        /// The target speed jumps.
        TargetSpeedJumps = "target_speed_jumps",
    }
    /// What becomes of frames on their way.
    Mangled {
        /// Some commands are lost.
        LostSome = "frames_lost_some",
        /// All commands are lost.
        Lost = "frames_lost",
        /// Old commands again.
        Repeated = "frames_repeated",
        /// Commands wait in a queue.
        Late = "frames_late",
        /// Commands change places.
        Reordered = "frames_reordered",
        /// A bit of each command is flipped.
        Corrupted = "frames_corrupted",
        /// Many frames too many.
        Babbling = "babbling",
        /// Commands under each other's identifier.
        WrongIdentifier = "wrong_channel_frames",
        /// No frame of the seat sensors.
        SeatLost = "seat_frames_lost",
    }
    /// What the sensors say.
    Misread {
        /// One seat sensor: occupied.
        SeatOccupiedOne = "seat_stuck_occupied_one",
        /// Both seat sensors: occupied.
        SeatOccupiedBoth = "seat_stuck_occupied_both",
        /// One seat sensor: vacant.
        SeatVacantOne = "seat_stuck_vacant_one",
        /// Both seat sensors: vacant.
        SeatVacantBoth = "seat_stuck_vacant_both",
        /// One seat sensor: now this, now that.
        SeatFlickers = "seat_flickers",
        /// One track of the accelerator: full.
        PedalFullOne = "pedal_stuck_full_one",
        /// Both tracks of the accelerator: full.
        PedalFullBoth = "pedal_stuck_full_both",
        /// One track of the accelerator drifts.
        PedalDrifts = "pedal_drifts_one",
        /// The brake switch: pressed.
        BrakeSwitch = "brake_switch_stuck",
        /// The wheel speed: 0.
        WheelSpeedZero = "wheel_speed_zero",
        /// The wheel speed stays.
        WheelSpeedStuck = "wheel_speed_stuck",
        /// Both speeds: 0.
        BothSpeedsZero = "both_speeds_zero_driver_leaves",
        /// A ghost for a moment.
        GhostShort = "radar_ghost_short",
        /// A ghost that stays.
        GhostLong = "radar_ghost_long",
        /// The radar drifts.
        RadarDrifts = "radar_drifts",
        /// The radar gives up.
        RadarLost = "radar_lost",
        /// The radar's list stays.
        RadarFrozen = "radar_frozen",
        /// The camera sees nothing.
        CameraBlind = "camera_blind",
        /// The camera gives up.
        CameraLost = "camera_lost",
        /// The steering angle jumps.
        SteeringAngle = "steering_angle_jumps",
        /// K4: open.
        K4Open = "k4_feedback_open",
        /// The parking brake: applied.
        EpbApplied = "epb_feedback_applied",
    }
    /// What fails in the vehicle.
    Failing {
        /// The drive pushes.
        DrivePushes = "drive_pushes",
        /// The brake fades.
        BrakesFade = "brakes_fade",
        /// K4 drops out.
        K4Drops = "k4_drops",
    }
    /// What befalls the supervisor itself.
    Own {
        /// Its clock stops.
        ClockStops = "clock_stops",
        /// Its clock leaps.
        ClockLeaps = "clock_leaps",
        /// Its clock runs backwards.
        ClockRunsBack = "clock_runs_back",
        /// Its clock jitters.
        ClockJitters = "clock_jitters",
        /// Its clock is slow.
        ClockSlow = "clock_slow",
        /// It comes late.
        StepLate = "step_late",
        /// It hangs.
        StepHangs = "step_hangs",
        /// A bit of its state.
        StateBit = "state_bit",
        /// A bit of the digest of its state.
        DigestBit = "digest_bit",
        /// Two bits of its state that hide each other.
        StateBitsHidden = "state_bits_hidden",
        /// A bit of its configuration.
        ConfigurationBit = "configuration_bit",
        /// Reset, cause power-on.
        ResetPowerOn = "reset_power_on",
        /// Reset, cause watchdog.
        ResetWatchdog = "reset_watchdog",
        /// Reset, any other cause.
        ResetOther = "reset_other",
        /// Reset, record lost.
        ResetRecordLost = "reset_record_lost",
        /// No power for a while.
        BrownOut = "brown_out",
    }
    /// What must be true of the drive when a fault begins.
    When {
        /// Nothing.
        Any = "any",
        /// Faster than 10 km/h, the driver sits.
        Driving = "driving",
        /// Driving, accelerator pressed.
        Torque = "torque",
        /// Driving, accelerator released.
        Coasting = "coasting",
        /// Driving, brake pedal pressed.
        Braking = "braking",
        /// Standing, the driver sits, high voltage on.
        Standing = "standing",
        /// Faster than 20 km/h, the driver sits, nothing ahead.
        Clear = "clear",
        /// An obstacle is less than 7 s ahead.
        Closing = "closing",
        /// The driver gets up within 3 s.
        BeforeLeave = "before_leave",
        /// Nobody sits, the bus rolls.
        Leaving = "leaving",
        /// Nobody sits.
        Empty = "empty",
        /// Nobody sits, the parking brake is applied.
        Parked = "parked",
        /// K1 and K4 are closed.
        Powered = "powered",
        /// Parked for nearly ten minutes, high voltage on.
        TenMinutes = "ten_minutes",
        /// Nobody sits, high voltage is off.
        Dark = "dark",
    }
}

/// What is done, and where.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    /// In the commands.
    Commands(Wrong),
    /// In the frames.
    Frames(Mangled),
    /// In the inputs.
    Inputs(Misread),
    /// In the vehicle.
    Vehicle(Failing),
    /// In the supervisor.
    Supervisor(Own),
}

impl Kind {
    /// The one of this name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Wrong::named(name)
            .map(Self::Commands)
            .or_else(|| Mangled::named(name).map(Self::Frames))
            .or_else(|| Misread::named(name).map(Self::Inputs))
            .or_else(|| Failing::named(name).map(Self::Vehicle))
            .or_else(|| Own::named(name).map(Self::Supervisor))
    }

    /// Its name.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Commands(kind) => kind.name(),
            Self::Frames(kind) => kind.name(),
            Self::Inputs(kind) => kind.name(),
            Self::Vehicle(kind) => kind.name(),
            Self::Supervisor(kind) => kind.name(),
        }
    }

    /// Where `faults.toml` says that it is done.
    #[must_use]
    pub const fn place(self) -> &'static str {
        match self {
            Self::Commands(_) => "commands",
            Self::Frames(Mangled::SeatLost) => "input frames",
            Self::Frames(_) => "command frames",
            Self::Inputs(_) => "inputs",
            Self::Vehicle(_) => "vehicle",
            Self::Supervisor(own) => own.place(),
        }
    }
}

impl Own {
    const fn place(self) -> &'static str {
        match self {
            Self::ClockStops
            | Self::ClockLeaps
            | Self::ClockRunsBack
            | Self::ClockJitters
            | Self::ClockSlow
            | Self::StepLate
            | Self::StepHangs => "clock",
            Self::StateBit | Self::DigestBit | Self::StateBitsHidden => "state",
            Self::ConfigurationBit => "configuration",
            Self::ResetPowerOn | Self::ResetWatchdog | Self::ResetOther | Self::ResetRecordLost | Self::BrownOut => {
                "reset"
            }
        }
    }
}
