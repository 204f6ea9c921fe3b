//! The first cut: what the object lists mean, as a small plain value.
//!
//! `supervisor-perceive` computes it; `decide` accepts *any* value of it, so the proofs of the
//! decision need no assumption about perception.

use crate::units::{ClosingCmS, DecelMs2Q11, DistanceCm, OffsetCm};
use crate::word::codes;

codes! {
    /// Level of collision mitigation that the time to collision calls for (S1 §3.1.2).
    Level {
        /// None.
        None = 0,
        /// Level 1: 1.0 m/s².
        One = 1,
        /// Level 2: 2.5 m/s².
        Two = 2,
        /// Level 3: 5.0 m/s².
        Three = 3,
    }
    /// Whether a valid obstacle in the corridor is closing.
    Closing {
        /// Known: none is.
        No = 0,
        /// At least one is.
        Yes = 1,
        /// Perception is lost.
        Unknown = 2,
    }
    /// What perception says to a warning.
    Alert {
        /// Its condition to end holds.
        Off = 0,
        /// Its condition to begin holds.
        On = 1,
        /// Neither (hysteresis), or perception is lost.
        Keep = 2,
    }
}

/// The object that decides, for explanation only.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(kani, derive(kani::Arbitrary))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
pub struct Object {
    /// Longitudinal distance.
    pub distance: DistanceCm,
    /// Lateral offset from the path.
    pub offset: OffsetCm,
    /// Closing speed.
    pub closing: ClosingCmS,
}

/// What perception knows of the road ahead in this cycle. Every combination of fields is legal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(kani, derive(kani::Arbitrary))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
pub struct Threat {
    /// Both sensors deliver in time.
    pub known: bool,
    /// Level of the most severe *valid* obstacle (MIT-1 to MIT-3, MIT-6): may oblige.
    pub level: Level,
    /// Whether an object in the corridor is closing (MIT-4).
    pub closing: Closing,
    /// Deceleration that stops the closing before the margin, v²/(2·(gap − margin)), rounded up (MIT-6).
    pub required: DecelMs2Q11,
    /// Any single-sensor object that mitigation of any level may be asked for: may permit (rule 1, TRQ-3).
    pub mitigable: bool,
    /// Any single-sensor object with T ≤ 3.2 s, or the second opinion calls it severe: permits the full cap (PHB-1).
    pub emergency: bool,
    /// Forward-collision warning (FCW-1).
    pub forward: Alert,
    /// Pedestrian-collision warning (PCW-1).
    pub pedestrian: Alert,
    /// Second opinion and time to collision differ beyond the bound (MIT-8).
    pub disagreement: bool,
    /// The deciding object.
    pub object: Option<Object>,
}

impl Threat {
    /// Perception lost: evidence for nothing.
    pub const UNKNOWN: Self = Self {
        known: false,
        level: Level::None,
        closing: Closing::Unknown,
        required: DecelMs2Q11::ZERO,
        mitigable: false,
        emergency: false,
        forward: Alert::Keep,
        pedestrian: Alert::Keep,
        disagreement: false,
        object: None,
    };
    /// Perception known, road clear.
    pub const CLEAR: Self =
        Self { known: true, closing: Closing::No, forward: Alert::Off, pedestrian: Alert::Off, ..Self::UNKNOWN };
}
