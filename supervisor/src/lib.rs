//! Safety supervisor of an electric bus.
//!
//! It stands between the main controller and the actuators, decides from the raw inputs what *must* and what *may*
//! happen, and gives every command a verdict with a reason.
//!
//! ```
//! use supervisor::{Commands, Inputs, Millis, Record, ResetCause, Scene, Sealed, Supervisor};
//!
//! # fn main() -> Result<(), supervisor::ConfigError> {
//! let mut supervisor = Supervisor::new(Sealed::from_default()?, ResetCause::PowerOn, Some(Record::None));
//! // Every 10 ms: what was read, what the main controller asks for.
//! let decision = supervisor.step(Millis::new(10), &Inputs::NEVER, &Scene::clear(), &Commands::ABSENT);
//! // A silent main controller, and nothing known: nothing is asked of any actuator, and the reasons stand beside it.
//! assert_eq!(decision.outputs.drive.torque.raw(), 0);
//! # Ok(())
//! # }
//! ```
#![no_std]
#![forbid(unsafe_code)]

pub use supervisor_core::*;
pub use supervisor_perceive::{CameraObject, Class, MAX_CAMERA, MAX_RADAR, PixelBox, RadarObject, Scene, perceive};
pub use supervisor_report as report;
pub use supervisor_wire as wire;

/// The supervisor: retained state and sealed configuration.
///
/// [`step`](Supervisor::step) is the only way in.
#[derive(Clone, Debug)]
pub struct Supervisor {
    image: StateImage,
    sealed: Sealed,
}

impl Supervisor {
    /// Starts after a reset (SELF-9). `record` is what was persisted, `None` if it fails its CRC.
    #[must_use]
    pub fn new(sealed: Sealed, cause: ResetCause, record: Option<Record>) -> Self {
        Self { image: StateImage::encode(&State::boot(cause, record)), sealed }
    }

    /// RXN-1a: one cycle, every 10 ms: perceive, decide, vet.
    ///
    /// `now` is in milliseconds and may wrap. Total: any values give a decision.
    #[must_use]
    pub fn step(&mut self, now: Millis, inputs: &Inputs, scene: &Scene, commands: &Commands) -> Decision {
        let threat = perceive(scene, self.config());
        let flow = Flow::START.pass(Checkpoint::Perceive);
        step(&mut self.image, &self.sealed, flow, now, inputs, &threat, commands)
    }

    /// SELF-4e: the configuration, to be read only. One that has changed since it was checked leads to the safe state in
    /// [`step`](Self::step); the defaults stand in for it.
    #[must_use]
    pub fn config(&self) -> &Config {
        self.sealed.intact().unwrap_or(&Config::DEFAULT)
    }

    /// The retained state at rest, for fault injection and diagnosis.
    #[must_use]
    pub const fn image(&self) -> &StateImage {
        &self.image
    }

    /// The same supervisor with another image: fault injection in safe code.
    #[must_use]
    pub const fn with_image(mut self, image: StateImage) -> Self {
        self.image = image;
        self
    }
}
