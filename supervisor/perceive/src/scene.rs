//! The object lists of one cycle, and what they mean together.

use heapless::Vec;
use supervisor_core::{Alert, Closing, ClosingCmS, Config, Count, DistanceCm, Millis, OffsetCm, Threat, codes};

use crate::assess::{Assessment, camera_object, merge, radar_object};
use crate::fusion::matches;

/// Longest radar list.
pub const MAX_RADAR: usize = 32;
/// Longest camera list.
pub const MAX_CAMERA: usize = 16;

codes! {
    /// What the camera takes an object for.
    Class {
        /// It does not say; treated as an object.
        Unclassified = 0,
        /// A vehicle or another thing.
        Object = 1,
        /// A pedestrian, or a cyclist.
        Pedestrian = 2,
    }
}

/// An object of the radar. Ordered by its values, so that no order of a list decides anything.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[cfg_attr(kani, derive(kani::Arbitrary))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
pub struct RadarObject {
    /// Longitudinal distance.
    pub distance: DistanceCm,
    /// Lateral offset from the predicted path, left positive.
    pub offset: OffsetCm,
    /// Closing speed.
    pub closing: ClosingCmS,
    /// Age of the measurement.
    pub age: Millis,
    /// In how many updates in a row the radar's own tracker has seen it, saturating (FUS-3c).
    pub updates: Count,
}

impl RadarObject {
    /// All zeros: a place without an object.
    pub const NONE: Self = Self {
        distance: DistanceCm::ZERO,
        offset: OffsetCm::ZERO,
        closing: ClosingCmS::ZERO,
        age: Millis::ZERO,
        updates: Count::ZERO,
    };
}

/// A box in the camera's image, in pixels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
#[cfg_attr(kani, derive(kani::Arbitrary))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
pub struct PixelBox {
    /// Left edge.
    pub left: u16,
    /// Upper edge.
    pub top: u16,
    /// Width.
    pub width: u16,
    /// Height.
    pub height: u16,
}

/// An object of the camera. Ordered by its values.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[cfg_attr(kani, derive(kani::Arbitrary))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
pub struct CameraObject {
    /// Its box in the image.
    pub pixels: PixelBox,
    /// Its class.
    pub class: Class,
    /// Distance.
    pub distance: DistanceCm,
    /// Closing speed.
    pub closing: ClosingCmS,
    /// Age of the measurement.
    pub age: Millis,
}

impl CameraObject {
    /// All zeros: a place without an object.
    pub const NONE: Self = Self {
        pixels: PixelBox { left: 0, top: 0, width: 0, height: 0 },
        class: Class::Unclassified,
        distance: DistanceCm::ZERO,
        closing: ClosingCmS::ZERO,
        age: Millis::ZERO,
    };
}

/// Both object lists of one cycle.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Scene {
    /// The radar delivers in time; an empty list then means an empty road.
    pub radar_known: bool,
    /// The camera delivers in time.
    pub camera_known: bool,
    /// The radar's objects.
    pub radar: Vec<RadarObject, MAX_RADAR>,
    /// The camera's objects.
    pub camera: Vec<CameraObject, MAX_CAMERA>,
}

impl Scene {
    /// Both sensors deliver, and see nothing.
    #[must_use]
    pub const fn clear() -> Self {
        Self { radar_known: true, camera_known: true, radar: Vec::new(), camera: Vec::new() }
    }
}

/// MIT-6a: matches, assesses every object and merges: the most severe object decides, not the nearest.
///
/// Perception is *known* when both sensors deliver and no object is too old. A list of a sensor that is lost
/// obliges nothing and permits nothing, and matches nothing.
#[must_use]
pub fn perceive(scene: &Scene, config: &Config) -> Threat {
    let radar: &[RadarObject] = if scene.radar_known { &scene.radar } else { &[] };
    let camera: &[CameraObject] = if scene.camera_known { &scene.camera } else { &[] };
    let mut known = scene.radar_known && scene.camera_known;
    let mut merged = Assessment::NOTHING;
    for (object, class) in radar.iter().zip(matches(radar, camera, config)) {
        if object.age <= config.object_age {
            merged = merge(merged, radar_object(object, class, config));
        } else {
            known = false;
        }
    }
    for object in camera {
        if object.age <= config.object_age {
            merged = merge(merged, camera_object(object, config));
        } else {
            known = false;
        }
    }
    merged.threat(known)
}

impl Assessment {
    /// What the merged assessment says, given whether perception is known.
    #[must_use]
    pub fn threat(self, known: bool) -> Threat {
        let alert = |begins, holds| match (begins, holds, known) {
            (true, _, _) => Alert::On,
            (false, false, true) => Alert::Off,
            (false, true, _) | (false, false, false) => Alert::Keep,
        };
        Threat {
            known,
            level: self.level,
            closing: match (self.closing, known) {
                (true, _) => Closing::Yes,
                (false, true) => Closing::No,
                (false, false) => Closing::Unknown,
            },
            required: self.required,
            mitigable: self.mitigable,
            emergency: self.emergency,
            forward: alert(self.forward_begins, self.forward_holds),
            pedestrian: alert(self.pedestrian_begins, self.pedestrian_holds),
            disagreement: self.disagreement,
            object: self.worst.map(|worst| worst.object),
        }
    }
}
