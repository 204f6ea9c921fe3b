//! What stood around an event that matters.

use supervisor_core::{Bound, DecelMs2Q11, Decision, Envelope, Inputs, Millis, Percent, Permission, Status};

use crate::event::What;

/// The bounds of the cycle that say most: how much the bus must and may brake, may drive, and whether the parking
/// brake may be released.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Bounds {
    /// Least deceleration, and what obliges it.
    pub brake_floor: Bound<DecelMs2Q11>,
    /// Greatest deceleration.
    pub brake_cap: Bound<DecelMs2Q11>,
    /// Greatest drive torque for the driver's pedal.
    pub torque_driver: Bound<Percent>,
    /// Greatest drive torque for ADAS.
    pub torque_automated: Bound<Percent>,
    /// Release of the parking brake.
    pub epb_release: Permission,
}

impl Bounds {
    const fn of(envelope: &Envelope) -> Self {
        Self {
            brake_floor: envelope.brake.floor,
            brake_cap: envelope.brake.cap,
            torque_driver: envelope.torque.driver,
            torque_automated: envelope.torque.automated,
            epb_release: envelope.epb.release,
        }
    }
}

/// The surroundings of an event: enough to see what was known, and what followed from it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Snapshot {
    /// Time of the cycle, as given to the step.
    pub time: Millis,
    /// The gravest event of the cycle: safe state, leave, a rising level, or the first verdict that is no pass.
    pub cause: What,
    /// Where the supervisor stood.
    pub status: Status,
    /// What had to and could happen.
    pub bounds: Bounds,
    /// What was read, if it was given.
    pub inputs: Option<Inputs>,
}

impl Snapshot {
    pub(crate) fn of(time: Millis, cause: What, decision: &Decision, inputs: Option<&Inputs>) -> Self {
        let bounds = Bounds::of(&decision.envelope);
        Self { time, cause, status: decision.status, bounds, inputs: inputs.copied() }
    }
}

// What an integrator pays for each: kept in bytes, so that growth is seen.
const _: () = assert!(size_of::<Snapshot>() <= SNAPSHOT_BYTES);
/// Bytes of one snapshot, at most.
const SNAPSHOT_BYTES: usize = 192;
