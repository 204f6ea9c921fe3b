//! The actuator channels: what the main controller may ask for, and what the supervisor sends.
//!
//! Commands and outputs have the same types, so vetting an output again is meaningful (it changes nothing).
//! The world is closed: a channel, field or enum value that is not here cannot be expressed, and a frame that
//! carries one is [`Rejected`](Command::Rejected) before it gets here.

use crate::input::EpbMode;
use crate::units::{AngleDeciDeg, BarTorque50mNm, DecelMs2Q11, Millis, Percent, RateDeciDegS, SpeedKmhQ8, TorqueNmQ10};
use crate::verdict::Reason;
use crate::word::{Word, Words, codes};

codes! {
    /// The actuator channels, in the order of spec §2.
    Channel {
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
    /// Why a frame with a command was not accepted.
    Rejection {
        /// CRC or checksum wrong.
        Checksum = 0,
        /// Counter repeated, lost or out of order.
        Counter = 1,
        /// A field carries a value that the channel does not have.
        Field = 2,
        /// Length or reserved bits wrong.
        Form = 3,
        /// Not yet requalified after a gap.
        Requalifying = 4,
    }
    /// Who asks for drive torque (S2).
    Origin {
        /// The driver's pedal.
        Driver = 0,
        /// The driver assistance (ADAS-VLC).
        Adas = 1,
        /// The brake system (EPBi-VLC).
        Epbi = 2,
    }
    /// Control mode of an external brake request (J1939 SPN 2916).
    BrakeMode {
        /// Request disabled.
        Off = 0,
        /// Added to the driver's demand.
        Addition = 1,
        /// The greater of request and driver's demand: the driver's demand is the floor.
        Maximum = 2,
    }
    /// Priority of a request (J1939 SPN 2915, 897), 0 is the highest.
    Priority {
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
    RetarderMode {
        /// Request disabled.
        Off = 0,
        /// Torque control.
        Torque = 2,
    }
    /// A gear request.
    GearRequest {
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
    EpbRequest {
        /// No request: the brake stays as it is.
        None = 0,
        /// Apply.
        Apply = 1,
        /// Release.
        Release = 2,
    }
    /// A contactor request.
    ContactorRequest {
        /// No request: the contactor stays as it is.
        Hold = 0,
        /// Open.
        Open = 1,
        /// Close.
        Close = 2,
    }
    /// Wipers.
    Wiper {
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
    DrivingMode {
        /// The driver drives.
        Manual = 0,
        /// Automated longitudinal control.
        Automated = 1,
    }
}

/// A set of channels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(kani, derive(kani::Arbitrary))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
pub struct Channels(u16);

impl Channels {
    /// None.
    pub const NONE: Self = Self(0);
    /// This set with another channel.
    #[must_use]
    pub fn with(self, channel: Channel) -> Self {
        Self(self.0 | 1_u16.rotate_left(u32::from(channel.code())))
    }
    /// Whether the channel is in the set.
    #[must_use]
    pub fn contains(self, channel: Channel) -> bool {
        self.with(channel) == self
    }
}

/// What a channel was asked for in this cycle. Frames come every 10–200 ms, cycles every 10 ms.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(kani, derive(kani::Arbitrary))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
pub enum Command<T> {
    /// Nothing received within the time-out, or ever.
    Absent,
    /// The last frame was refused: it is disobeyed at once.
    Rejected(Rejection),
    /// A frame in this cycle.
    Fresh(T),
    /// The last good frame, this old.
    Held(Millis, T),
}

impl<T> Command<T> {
    /// The value, if it may be used: fresh, or held for no longer than `timeout`.
    ///
    /// # Errors
    /// [`Reason::CommandLost`] or [`Reason::CommandRejected`].
    pub fn usable(self, timeout: Millis) -> Result<T, Reason> {
        match self {
            Self::Fresh(value) => Ok(value),
            Self::Held(age, value) if age <= timeout => Ok(value),
            Self::Absent | Self::Held(_, _) => Err(Reason::CommandLost),
            Self::Rejected(_) => Err(Reason::CommandRejected),
        }
    }
}

macro_rules! channel_value {
    ($($(#[$doc:meta])* $name:ident { $($(#[$field_doc:meta])* $field:ident: $type:ty = $neutral:expr,)+ })*) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        #[cfg_attr(kani, derive(kani::Arbitrary))]
        #[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
        pub struct $name { $($(#[$field_doc])* pub $field: $type,)+ }

        impl $name {
            /// The value that asks for nothing.
            pub const NEUTRAL: Self = Self { $($field: $neutral,)+ };
        }
    )*};
}

impl Words for Body {
    const COUNT: usize = 7;
    fn write(&self, sink: &mut impl FnMut(u32)) {
        sink(self.wipers.to_word());
        let lamps =
            [self.brake_lamps, self.indicator_left, self.indicator_right, self.low_beam, self.high_beam, self.horn];
        for lamp in lamps {
            sink(lamp.to_word());
        }
    }
    #[expect(clippy::inline_always, reason = "measured: decoding the state costs half when it is one piece")]
    #[inline(always)]
    fn read(source: &mut impl FnMut() -> Option<u32>) -> Option<Self> {
        Some(Self {
            wipers: Words::read(source)?,
            brake_lamps: Words::read(source)?,
            indicator_left: Words::read(source)?,
            indicator_right: Words::read(source)?,
            low_beam: Words::read(source)?,
            high_beam: Words::read(source)?,
            horn: Words::read(source)?,
        })
    }
}

channel_value! {
    /// Drive torque in the direction of the gear. S2's virtual throttle is the same channel by another road.
    DriveTorque {
        /// Torque, 0 to 100 %.
        torque: Percent = Percent::ZERO,
        /// The sender's active flag; counts for ADAS and EPBi.
        active: bool = false,
        /// Who asks.
        origin: Origin = Origin::Driver,
    }
    /// Service brake: total deceleration, of which a part is electric; friction supplies the rest.
    ServiceBrake {
        /// Total deceleration asked for.
        total: DecelMs2Q11 = DecelMs2Q11::ZERO,
        /// Electric part (regeneration, drag), at most `total`.
        electric: DecelMs2Q11 = DecelMs2Q11::ZERO,
        /// Control mode.
        mode: BrakeMode = BrakeMode::Off,
        /// Priority.
        priority: Priority = Priority::Low,
    }
    /// Retarder.
    Retarder {
        /// Braking torque, 0 to 100 %.
        torque: Percent = Percent::ZERO,
        /// Mode.
        mode: RetarderMode = RetarderMode::Off,
        /// Priority.
        priority: Priority = Priority::Low,
    }
    /// Parking brake.
    ParkingBrake {
        /// Request.
        request: EpbRequest = EpbRequest::None,
        /// Mode in which the request is to be obeyed.
        mode: EpbMode = EpbMode::Manual,
    }
    /// Steering.
    Steering {
        /// Automatic steering enabled.
        enable: bool = false,
        /// Target angle.
        angle: AngleDeciDeg = AngleDeciDeg::ZERO,
        /// Greatest rate towards the angle.
        rate: RateDeciDegS = RateDeciDegS::ZERO,
        /// Overlay torque.
        overlay: TorqueNmQ10 = TorqueNmQ10::ZERO,
        /// Weight of the angle controller's torque, 0 to 100 %.
        weight: Percent = Percent::ZERO,
        /// Limit of the overlaid bar torque.
        bar_limit: BarTorque50mNm = BarTorque50mNm::ZERO,
    }
    /// Contactors.
    Contactors {
        /// K4: front end of drive and auxiliaries.
        k4: ContactorRequest = ContactorRequest::Hold,
        /// K1: battery main circuit.
        k1: ContactorRequest = ContactorRequest::Hold,
    }
    /// Auxiliaries; `true` is on, which is also what they are without a command.
    Auxiliaries {
        /// Air pump.
        air_pump: bool = true,
        /// Power steering.
        power_steering: bool = true,
        /// DC/DC converter.
        dc_dc: bool = true,
    }
    /// Warnings; the last three pass through.
    Warnings {
        /// Forward-collision warning.
        forward_collision: bool = false,
        /// Pedestrian-collision warning.
        pedestrian: bool = false,
        /// Seat-leave warning: sound and flashing yellow icon.
        seat_leave: bool = false,
        /// Hazard flashers.
        hazard_flashers: bool = false,
        /// Fault lamp.
        fault_lamp: bool = false,
        /// Notice lamp: a takeover is asked for, a mode has ended.
        notice_lamp: bool = false,
        /// Lane departure.
        lane_departure: bool = false,
        /// Speed limit.
        speed_limit: bool = false,
        /// Headway.
        headway: bool = false,
    }
    /// Body (S4 BCS).
    Body {
        /// Wipers.
        wipers: Wiper = Wiper::Off,
        /// Brake lamps.
        brake_lamps: bool = false,
        /// Left indicator.
        indicator_left: bool = false,
        /// Right indicator.
        indicator_right: bool = false,
        /// Low beam.
        low_beam: bool = false,
        /// High beam.
        high_beam: bool = false,
        /// Horn.
        horn: bool = false,
    }
}

macro_rules! channels {
    ($($(#[$doc:meta])* $field:ident: $type:ty = $neutral:expr;)*) => {
        /// One command per channel.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        #[cfg_attr(kani, derive(kani::Arbitrary))]
        #[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
        pub struct Commands { $($(#[$doc])* pub $field: Command<$type>,)* }

        /// What the supervisor sends, on every channel in every cycle.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        #[cfg_attr(kani, derive(kani::Arbitrary))]
        #[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
        pub struct Outputs { $($(#[$doc])* pub $field: $type,)* }

        impl Commands {
            /// A silent main controller.
            pub const ABSENT: Self = Self { $($field: Command::Absent,)* };
        }

        impl Outputs {
            /// Asks for nothing on every channel.
            pub const NEUTRAL: Self = Self { $($field: $neutral,)* };

            /// The same values as commands received in this cycle.
            #[must_use]
            pub const fn as_commands(&self) -> Commands {
                Commands { $($field: Command::Fresh(self.$field),)* }
            }
        }
    };
}

channels! {
    /// Drive torque.
    drive: DriveTorque = DriveTorque::NEUTRAL;
    /// Target speed.
    target_speed: SpeedKmhQ8 = SpeedKmhQ8::ZERO;
    /// Service brake.
    brake: ServiceBrake = ServiceBrake::NEUTRAL;
    /// Retarder.
    retarder: Retarder = Retarder::NEUTRAL;
    /// Gear.
    gear: GearRequest = GearRequest::Hold;
    /// Parking brake.
    epb: ParkingBrake = ParkingBrake::NEUTRAL;
    /// Steering.
    steering: Steering = Steering::NEUTRAL;
    /// Contactors.
    contactors: Contactors = Contactors::NEUTRAL;
    /// Auxiliaries.
    auxiliaries: Auxiliaries = Auxiliaries::NEUTRAL;
    /// Warnings.
    warnings: Warnings = Warnings::NEUTRAL;
    /// Body.
    body: Body = Body::NEUTRAL;
    /// Mode request.
    mode: DrivingMode = DrivingMode::Manual;
}
