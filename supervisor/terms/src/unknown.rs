//! What *unknown* means, input group by channel: one cell for each pair, none empty (CMD-4).
//!
//! The table declares; the machines act. A test takes every group away in random drives and compares each channel
//! with its cell: *unaffected* must not differ in a single cycle, every other cell but *persists* must be seen to act.

use crate::command::Channel;
use crate::input::{Inputs, Signal};
use crate::word::codes;

codes! {
    /// Input groups: what is lost together.
    Group {
        /// Seat sensors.
        Seat = 0,
        /// Wheel and motor speed.
        Speed = 1,
        /// Accelerator.
        Accelerator = 2,
        /// Brake pedal: both tracks and the switch.
        BrakePedal = 3,
        /// Steering-wheel angle and driver torque.
        SteeringWheel = 4,
        /// The driver's gear selector.
        Selector = 5,
        /// The confirmed gear.
        Gear = 6,
        /// State and mode of the parking brake.
        ParkingBrake = 7,
        /// The driver's parking-brake switch.
        ParkingSwitch = 8,
        /// The key.
        Key = 9,
        /// Cruise switch and set.
        Cruise = 10,
        /// Feedback of K1 and K4.
        Contactors = 11,
        /// Current, drive stopped, auxiliaries stopped.
        Loads = 12,
        /// Drive limit and executed torque.
        Drive = 13,
        /// Limits of the brake, and the values by which it splits.
        BrakeLimits = 14,
        /// Measured deceleration.
        Motion = 15,
        /// ABS, ASR, stability control.
        SlipControl = 16,
        /// EBS warnings and XBR status.
        BrakeStatus = 17,
        /// Power steering and hands-off.
        PowerSteering = 18,
        /// State of the automated driving system.
        Ads = 19,
        /// Radar and camera.
        Perception = 20,
    }
    /// What it means for a channel that a group is unknown.
    Meaning {
        /// Nothing.
        Unaffected = 0,
        /// What needs its evidence is refused: the channel is more restricted.
        Refused = 1,
        /// Nothing new begins by it, what has begun goes on; the channel changes only with that.
        Persists = 2,
        /// A comfort limit lacks its evidence: more braking is permitted.
        Widened = 3,
        /// Automatic steering fades out.
        Faded = 4,
        /// The driver is told.
        Told = 5,
    }
}

use Meaning::{Faded as F, Persists as P, Refused as R, Told as T, Unaffected as U, Widened as W};

/// Columns in the order of [`Channel`]: torque, target speed, brake, retarder, gear, EPB, steering, contactors,
/// auxiliaries, warnings, body, mode.
const TABLE: [(Group, [Meaning; 12]); 21] = [
    (Group::Seat, [R, P, P, P, R, R, P, R, U, T, P, R]),
    (Group::Speed, [R, R, P, P, R, R, F, R, R, T, P, R]),
    (Group::Accelerator, [R, R, P, P, U, R, P, P, U, T, P, R]),
    (Group::BrakePedal, [R, R, R, R, U, U, P, P, U, T, P, R]),
    (Group::SteeringWheel, [P, P, P, P, U, P, F, P, U, T, P, P]),
    (Group::Selector, [P, U, U, U, R, U, U, P, U, U, U, U]),
    (Group::Gear, [R, P, P, P, P, R, P, P, U, P, P, P]),
    (Group::ParkingBrake, [R, P, P, P, R, P, P, R, U, P, P, P]),
    (Group::ParkingSwitch, [U, U, U, U, U, P, U, U, U, U, U, U]),
    (Group::Key, [P, P, P, P, P, P, P, R, U, P, P, P]),
    (Group::Cruise, [R, R, P, P, U, U, P, P, U, U, P, R]),
    (Group::Contactors, [P, P, P, P, P, R, P, R, U, P, P, P]),
    (Group::Loads, [U, U, U, U, U, U, U, R, U, U, U, U]),
    (Group::Drive, [R, P, P, P, U, U, P, R, U, P, P, P]),
    (Group::BrakeLimits, [P, U, R, P, U, P, U, P, U, P, P, U]),
    (Group::Motion, [P, P, P, P, U, P, P, P, U, P, P, P]),
    (Group::SlipControl, [R, U, R, W, U, P, U, P, U, P, P, U]),
    (Group::BrakeStatus, [P, U, U, P, U, P, U, P, U, P, P, U]),
    (Group::PowerSteering, [P, P, P, P, U, U, F, P, U, T, P, P]),
    (Group::Ads, [R, R, P, P, U, U, P, P, U, T, P, R]),
    (Group::Perception, [R, R, W, W, U, P, P, P, U, T, P, R]),
];

/// CMD-4a: the cell of the matrix: what it means for `channel` that `group` is unknown.
#[must_use]
pub fn meaning(group: Group, channel: Channel) -> Meaning {
    let row = TABLE.iter().find(|(row, _)| *row == group).map(|(_, cells)| cells);
    row.and_then(|cells| cells.get(usize::from(channel.code()))).copied().unwrap_or(Meaning::Refused)
}

impl Inputs {
    /// The same inputs with one group unknown. Perception is no part of [`Inputs`]: the same.
    #[must_use]
    pub const fn without(mut self, group: Group) -> Self {
        match group {
            Group::Seat => self.seat = [Signal::NEVER; 2],
            Group::Speed => (self.wheel_speed, self.motor_speed) = (Signal::NEVER, Signal::NEVER),
            Group::Accelerator => self.accelerator = [Signal::NEVER; 2],
            Group::BrakePedal => (self.brake_pedal, self.brake_switch) = ([Signal::NEVER; 2], Signal::NEVER),
            Group::SteeringWheel => (self.steering_angle, self.driver_torque) = (Signal::NEVER, Signal::NEVER),
            Group::Selector => self.selector = Signal::NEVER,
            Group::Gear => self.gear = Signal::NEVER,
            Group::ParkingBrake => (self.epb, self.epb_mode) = (Signal::NEVER, Signal::NEVER),
            Group::ParkingSwitch => self.epb_switch = Signal::NEVER,
            Group::Key => self.key = Signal::NEVER,
            Group::Cruise => (self.cruise_switch, self.driver_set) = (Signal::NEVER, Signal::NEVER),
            Group::Contactors => (self.k1, self.k4) = (Signal::NEVER, Signal::NEVER),
            Group::Loads => {
                self.hv_current = Signal::NEVER;
                (self.drive_stopped, self.auxiliaries_stopped) = (Signal::NEVER, Signal::NEVER);
            }
            Group::Drive => (self.drive_limit, self.executed_torque) = (Signal::NEVER, Signal::NEVER),
            Group::BrakeLimits => {
                (self.electric_limit, self.friction_limit) = (Signal::NEVER, Signal::NEVER);
                (self.electric_actual, self.mass) = (Signal::NEVER, Signal::NEVER);
                self.axle_pressure = [Signal::NEVER; 2];
            }
            Group::Motion => self.deceleration = Signal::NEVER,
            Group::SlipControl => (self.abs, self.asr, self.stability) = (Signal::NEVER, Signal::NEVER, Signal::NEVER),
            Group::BrakeStatus => {
                (self.ebs_red, self.ebs_amber, self.xbr_status) = (Signal::NEVER, Signal::NEVER, Signal::NEVER);
            }
            Group::PowerSteering => (self.eps, self.hands_off) = (Signal::NEVER, Signal::NEVER),
            Group::Ads => self.ads = Signal::NEVER,
            Group::Perception => {}
        }
        self
    }
}
