//! What the supervisor reads itself, independently of the main controller.

use crate::command::Channels;
use crate::units::{
    AngleDeciDeg, CurrentDeciA, DecelMs2Q11, Mass10Kg, Pedal250, Percent, Pressure5KPa, SpeedKmhQ8, TorqueNmQ10,
};
use crate::word::codes;

codes! {
    /// Why a signal is unknown.
    Cause {
        /// No frame has carried it since boot.
        NeverReceived = 0,
        /// The last frame is older than the time-out.
        Stale = 1,
        /// The frame failed its end-to-end check (CRC, counter, data id).
        EndToEnd = 2,
        /// The value lies outside its plausible range.
        OutOfRange = 3,
        /// The sender says "error" or "not available" (J1939 0xFE, 0xFF).
        NotAvailable = 4,
        /// Frames are back after a gap but have not yet run for the requalification time.
        Requalifying = 5,
    }
    /// One seat sensor.
    Seat {
        /// Nobody sits.
        Vacant = 0,
        /// Somebody sits.
        Occupied = 1,
    }
    /// A gear: confirmed by the gearbox, or selected by the driver.
    Gear {
        /// Neutral.
        Neutral = 0,
        /// Drive.
        Drive = 1,
        /// Reverse.
        Reverse = 2,
        /// Park.
        Park = 3,
    }
    /// State of the electric parking brake. A brake on its way is reported as unknown.
    EpbState {
        /// Released.
        Released = 0,
        /// Applied.
        Applied = 1,
    }
    /// The driver's EPB switch.
    EpbSwitch {
        /// At rest.
        Idle = 0,
        /// Pulled: apply.
        Apply = 1,
        /// Pushed: release.
        Release = 2,
    }
    /// Who may operate the EPB (S4 BKR 19).
    EpbMode {
        /// Only the driver's switch.
        Manual = 0,
        /// External requests too.
        Automatic = 1,
    }
    /// The key.
    Key {
        /// Off.
        Off = 0,
        /// On.
        On = 1,
        /// Start (momentary).
        Start = 2,
    }
    /// Feedback of one contactor.
    Contact {
        /// Confirmed open.
        Open = 0,
        /// Confirmed closed.
        Closed = 1,
    }
    /// State of the electric power steering (S4 STR 5).
    EpsState {
        /// Ready for automatic steering, not steering.
        Ready = 0,
        /// Steering automatically.
        Active = 1,
        /// Derated by a fault (S4 STR 6).
        Derated = 2,
        /// Failed.
        Failed = 3,
    }
    /// State of the automated driving system (S4 ADSS 1).
    AdsState {
        /// Not ready.
        Standby = 0,
        /// Ready to take over.
        Ready = 1,
        /// Driving.
        Active = 2,
        /// Failed.
        Failed = 3,
    }
    /// Which external braking the brake system allows (S4 BKR 9).
    XbrStatus {
        /// None.
        Refused = 0,
        /// Highest priority only.
        EmergencyOnly = 1,
        /// All.
        Allowed = 2,
    }
}

/// A signal that was read: *known*, or unknown with the cause.
///
/// Unknown is evidence for nothing: neither for a hazard, nor for safety (spec rule 1).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(kani, derive(kani::Arbitrary))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
pub enum Signal<T> {
    /// Received in time, intact, in range.
    Known(T),
    /// Not to be relied on.
    Unknown(Cause),
}

impl<T: Copy + PartialEq> Signal<T> {
    /// A signal that no frame has carried yet.
    pub const NEVER: Self = Self::Unknown(Cause::NeverReceived);

    /// The value, if known.
    pub const fn known(self) -> Option<T> {
        match self {
            Self::Known(value) => Some(value),
            Self::Unknown(_) => None,
        }
    }
    /// Whether it is known to be `value`.
    pub fn is(self, value: T) -> bool {
        self.known() == Some(value)
    }
}

/// Everything that is read independently in one cycle, except the object lists (those become a
/// [`Threat`](crate::Threat) first).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(kani, derive(kani::Arbitrary))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
pub struct Inputs {
    /// The two seat sensors.
    pub seat: [Signal<Seat>; 2],
    /// Speed from the wheels (J1939 CCVS1).
    pub wheel_speed: Signal<SpeedKmhQ8>,
    /// Speed from the motor, the second source.
    pub motor_speed: Signal<SpeedKmhQ8>,
    /// Accelerator pedal, two tracks.
    pub accelerator: [Signal<Pedal250>; 2],
    /// Brake pedal, two tracks.
    pub brake_pedal: [Signal<Pedal250>; 2],
    /// Brake pedal switch: pressed.
    pub brake_switch: Signal<bool>,
    /// Measured steering-wheel angle.
    pub steering_angle: Signal<AngleDeciDeg>,
    /// Torque of the driver's hands.
    pub driver_torque: Signal<TorqueNmQ10>,
    /// The driver's gear selector.
    pub selector: Signal<Gear>,
    /// The gear confirmed by the gearbox.
    pub gear: Signal<Gear>,
    /// The parking brake.
    pub epb: Signal<EpbState>,
    /// The driver's parking-brake switch.
    pub epb_switch: Signal<EpbSwitch>,
    /// Who may operate the parking brake.
    pub epb_mode: Signal<EpbMode>,
    /// The key.
    pub key: Signal<Key>,
    /// The cruise switch: on.
    pub cruise_switch: Signal<bool>,
    /// The driver's "set" of the cruise control.
    pub driver_set: Signal<bool>,
    /// Feedback of contactor K1 (battery main circuit).
    pub k1: Signal<Contact>,
    /// Feedback of contactor K4 (front end of drive and auxiliaries).
    pub k4: Signal<Contact>,
    /// Current of the high-voltage circuit.
    pub hv_current: Signal<CurrentDeciA>,
    /// The drive confirms that it has stopped.
    pub drive_stopped: Signal<bool>,
    /// The auxiliary supplies confirm that they have stopped.
    pub auxiliaries_stopped: Signal<bool>,
    /// Greatest drive torque that VCU and battery allow now.
    pub drive_limit: Signal<Percent>,
    /// Drive torque executed (S4 ACR 4).
    pub executed_torque: Signal<Percent>,
    /// Greatest electric deceleration that VCU and battery allow now.
    pub electric_limit: Signal<DecelMs2Q11>,
    /// Greatest friction deceleration that the brake system allows now.
    pub friction_limit: Signal<DecelMs2Q11>,
    /// Electric deceleration that the drive gives now (VLC-3).
    pub electric_actual: Signal<DecelMs2Q11>,
    /// Mass of the vehicle by which the brake system splits (VLC-3).
    pub mass: Signal<Mass10Kg>,
    /// Brake pressure of the front and the rear axle (VLC-3).
    pub axle_pressure: [Signal<Pressure5KPa>; 2],
    /// Measured deceleration; 0 when the bus does not slow down.
    pub deceleration: Signal<DecelMs2Q11>,
    /// Anti-lock brakes at work (S4 BKR 2).
    pub abs: Signal<bool>,
    /// Drive slip control at work (S4 BKR 1).
    pub asr: Signal<bool>,
    /// Stability control at work: VDC, ROP or YC (S4 BKR 11–15).
    pub stability: Signal<bool>,
    /// EBS red warning (S4 BKR 6).
    pub ebs_red: Signal<bool>,
    /// EBS amber warning (S4 BKR 7).
    pub ebs_amber: Signal<bool>,
    /// Which external braking the brake system allows.
    pub xbr_status: Signal<XbrStatus>,
    /// The power steering.
    pub eps: Signal<EpsState>,
    /// Hands off the steering wheel (S4 STR 7).
    pub hands_off: Signal<bool>,
    /// The automated driving system.
    pub ads: Signal<AdsState>,
    /// Channels on which the bus showed an actuator message that is not our last output (SELF-10).
    pub foreign: Channels,
    /// The bus showed a frame with our source address that we did not send (SELF-10).
    pub second_sender: bool,
}

impl Inputs {
    /// Nothing received yet.
    pub const NEVER: Self = Self {
        seat: [Signal::NEVER; 2],
        wheel_speed: Signal::NEVER,
        motor_speed: Signal::NEVER,
        accelerator: [Signal::NEVER; 2],
        brake_pedal: [Signal::NEVER; 2],
        brake_switch: Signal::NEVER,
        steering_angle: Signal::NEVER,
        driver_torque: Signal::NEVER,
        selector: Signal::NEVER,
        gear: Signal::NEVER,
        epb: Signal::NEVER,
        epb_switch: Signal::NEVER,
        epb_mode: Signal::NEVER,
        key: Signal::NEVER,
        cruise_switch: Signal::NEVER,
        driver_set: Signal::NEVER,
        k1: Signal::NEVER,
        k4: Signal::NEVER,
        hv_current: Signal::NEVER,
        drive_stopped: Signal::NEVER,
        auxiliaries_stopped: Signal::NEVER,
        drive_limit: Signal::NEVER,
        executed_torque: Signal::NEVER,
        electric_limit: Signal::NEVER,
        friction_limit: Signal::NEVER,
        electric_actual: Signal::NEVER,
        mass: Signal::NEVER,
        axle_pressure: [Signal::NEVER; 2],
        deceleration: Signal::NEVER,
        abs: Signal::NEVER,
        asr: Signal::NEVER,
        stability: Signal::NEVER,
        ebs_red: Signal::NEVER,
        ebs_amber: Signal::NEVER,
        xbr_status: Signal::NEVER,
        eps: Signal::NEVER,
        hands_off: Signal::NEVER,
        ads: Signal::NEVER,
        foreign: Channels::NONE,
        second_sender: false,
    };
}
