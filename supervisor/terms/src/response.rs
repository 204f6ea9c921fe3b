//! The third cut: whether the actuators follow, as a small plain value.
//!
//! `supervisor-observe` computes it; `decide` accepts *any* value of it, so the proofs of the decision need no
//! assumption about the monitors.

use crate::verdict::Faults;
use crate::word::codes;

codes! {
    /// A shortfall or excess of an actuator, and for how long: each step calls the next stronger means (RSP-1k).
    Deviation {
        /// It follows, as far as is known.
        None = 0,
        /// Confirmed.
        Confirmed = 1,
        /// Confirmed, and still there after the next stronger means had its time.
        Persistent = 2,
    }
}

/// Whether the actuators follow their commands. Every combination of fields is legal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(kani, derive(kani::Arbitrary))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
pub struct Response {
    /// The brakes give less than the last output (RSP-1), or can give less than it (VLC-2f).
    pub brake: Deviation,
    /// The drive gives more than the last output (TRQ-7).
    pub torque: Deviation,
    /// The steering does not follow (RSP-1).
    pub steering: bool,
    /// The parking brake was released, though no output released it (SELF-10).
    pub parking: bool,
    /// Somebody else commands an actuator, or one moved though no output moved it (SELF-10).
    pub bypass: bool,
    /// What is to be reported.
    pub faults: Faults,
}

impl Response {
    /// Every actuator follows.
    pub const FOLLOWS: Self = Self {
        brake: Deviation::None,
        torque: Deviation::None,
        steering: false,
        parking: false,
        bypass: false,
        faults: Faults::NONE,
    };
}
