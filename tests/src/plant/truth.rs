//! The truth of one moment: what no sensor has touched.

use supervisor::{Class, EpbState, EpbSwitch, Gear};

/// The truth of one moment, for pictures and for judging whether the bus stayed safe.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Truth {
    /// Speed in m/s, forward positive.
    pub speed: f64,
    /// Acceleration in m/s².
    pub acceleration: f64,
    /// Way driven, in m.
    pub position: f64,
    /// Gap to the nearest obstacle present ahead, in m; negative after a collision.
    pub gap: Option<f64>,
    /// The seat sensors see a driver.
    pub seat: [bool; 2],
    /// The parking brake, `None` on its way.
    pub epb: Option<EpbState>,
    /// The gear engaged.
    pub gear: Gear,
    /// K1 and K4 are closed.
    pub closed: [bool; 2],
    /// The steering-wheel angle in degrees.
    pub angle: f64,
    /// Torque that the drive gives, as a share of its greatest.
    pub torque: f64,
    /// Deceleration by all brakes, in m/s².
    pub braking: f64,
    /// Current from the battery, in A.
    pub current: f64,
    /// The nearest obstacle in the corridor.
    pub ahead: Option<Ahead>,
    /// What the driver does.
    pub hands: Hands,
}

/// What stands or moves in the corridor ahead.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ahead {
    /// Gap in m; negative after a collision.
    pub gap: f64,
    /// Closing speed in m/s.
    pub closing: f64,
    /// What it is.
    pub class: Class,
}

/// What the driver does with hands and feet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hands {
    /// Accelerator, 0 to 1.
    pub accelerator: f64,
    /// Brake pedal, 0 to 1.
    pub brake: f64,
    /// Gear selector.
    pub selector: Gear,
    /// Switch of the parking brake.
    pub epb_switch: EpbSwitch,
    /// Cruise control switched on.
    pub cruise: bool,
    /// "Set" pressed.
    pub set: bool,
}
