//! The object lists of one cycle, and what they mean together.

use heapless::Vec;
use supervisor_core::{Alert, ClosingCmS, Config, Count, DistanceCm, Millis, OffsetCm, Threat};

use crate::assess::{Assessment, camera_object, merge, radar_object};

/// Longest radar list.
pub const MAX_RADAR: usize = 32;
/// Longest camera list.
pub const MAX_CAMERA: usize = 16;

/// What an object is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(kani, derive(kani::Arbitrary))]
pub enum Class {
    /// Seen by the radar only: not matched.
    Unmatched,
    /// A vehicle or another thing.
    Object,
    /// A pedestrian.
    Pedestrian,
}

impl Class {
    /// Every class, in the order of the codes.
    pub const ALL: &'static [Self] = &[Self::Unmatched, Self::Object, Self::Pedestrian];
    /// The stable code.
    #[must_use]
    pub const fn code(self) -> u8 {
        match self {
            Self::Unmatched => 0,
            Self::Object => 1,
            Self::Pedestrian => 2,
        }
    }
    /// The class with this code.
    #[must_use]
    pub const fn from_code(code: u8) -> Option<Self> {
        match code {
            0 => Some(Self::Unmatched),
            1 => Some(Self::Object),
            2 => Some(Self::Pedestrian),
            _ => None,
        }
    }
}

/// An object of the radar.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(kani, derive(kani::Arbitrary))]
pub struct RadarObject {
    /// Longitudinal distance.
    pub distance: DistanceCm,
    /// Lateral offset from the predicted path, left positive.
    pub offset: OffsetCm,
    /// Closing speed.
    pub closing: ClosingCmS,
    /// Age of the measurement.
    pub age: Millis,
    /// In how many updates in a row this object was seen, saturating.
    pub updates: Count,
    /// Its class if the camera has matched it.
    pub class: Class,
}

/// A box in the camera's image, in pixels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(kani, derive(kani::Arbitrary))]
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

/// An object of the camera.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(kani, derive(kani::Arbitrary))]
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

/// MIT-6a: assesses every object and merges: the most severe object decides, not the nearest.
///
/// Perception is *known* when both sensors deliver and no object is too old. A list of a sensor that is lost
/// obliges nothing and permits nothing.
#[must_use]
pub fn perceive(scene: &Scene, config: &Config) -> Threat {
    let fresh = |age: Millis| age <= config.object_age;
    let radar = scene.radar.iter().filter(|_| scene.radar_known);
    let camera = scene.camera.iter().filter(|_| scene.camera_known);
    let aged = radar.clone().any(|object| !fresh(object.age)) || camera.clone().any(|object| !fresh(object.age));
    let known = scene.radar_known && scene.camera_known && !aged;
    let merged = radar
        .filter(|object| fresh(object.age))
        .map(|object| radar_object(object, config))
        .chain(camera.filter(|object| fresh(object.age)).map(|object| camera_object(object, config)))
        .fold(Assessment::NOTHING, merge);
    merged.threat(known)
}

impl Assessment {
    /// What the merged assessment says, given whether perception is known.
    #[must_use]
    pub fn threat(self, known: bool) -> Threat {
        use supervisor_core::Closing;
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
            object: self.object,
        }
    }
}
