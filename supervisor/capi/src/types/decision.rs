//! What a step decided.

use supervisor::{Channel, Decision, Status, Verdict};

use super::memory::SUPERVISOR_CHANNELS;
use super::outputs::SupervisorOutputs;

/// The verdict of one channel.
///
/// `value` and `limit` are in the unit of the field that `reason` speaks of; for yes/no fields 0 and 1, for codes the
/// code. `margin` is how far inside (positive) or outside (negative) the value was.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SupervisorVerdict {
    /// The offending (or the tightest) value.
    pub value: i32,
    /// Its limit.
    pub limit: i32,
    /// How far inside or outside.
    pub margin: i32,
    /// A `SupervisorKind`.
    pub kind: u8,
    /// A `SupervisorReason`.
    pub reason: u8,
    /// Given as 0.
    pub reserved: [u8; 2],
}

impl SupervisorVerdict {
    pub(crate) const fn of(verdict: Verdict) -> Self {
        let Verdict { kind, reason, value, limit, margin } = verdict;
        Self { value, limit, margin, kind: kind.code(), reason: reason.code(), reserved: [0; 2] }
    }
}

/// Where the supervisor stands.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SupervisorStatus {
    /// Time parked by leave towards the shutdown of high voltage, in ms.
    pub parked_for_ms: u32,
    /// Faults and hints of this cycle, see `SupervisorFault`.
    pub faults: u32,
    /// A `SupervisorOccupancy`.
    pub occupancy: u8,
    /// Parked by leave, 0 or 1.
    pub parked_by_leave: u8,
    /// A `SupervisorStage`.
    pub stage: u8,
    /// A `SupervisorLevel`.
    pub level: u8,
    /// A `SupervisorMode`.
    pub mode: u8,
    /// Why the automated mode last ended, a `SupervisorExitReason`.
    pub exit: u8,
    /// Safe state, 0 or 1.
    pub safe_state: u8,
    /// A `SupervisorRecord`: what to persist now, under a CRC of your own (AOU-10).
    pub record: u8,
}

impl SupervisorStatus {
    pub(crate) fn of(status: &Status) -> Self {
        Self {
            parked_for_ms: status.parked_for.raw(),
            faults: status.faults.bits(),
            occupancy: status.occupancy.code(),
            parked_by_leave: u8::from(status.parked_by_leave),
            stage: status.stage.code(),
            level: status.level.code(),
            mode: status.mode.code(),
            exit: status.exit.code(),
            safe_state: u8::from(status.safe_state),
            record: status.record.code(),
        }
    }
}

/// Everything that a step decided.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SupervisorDecision {
    /// One for each channel, in the order of `SupervisorChannel`.
    pub verdicts: [SupervisorVerdict; SUPERVISOR_CHANNELS],
    /// Where the supervisor stands.
    pub status: SupervisorStatus,
    /// What goes to the actuators; the frames say the same.
    pub outputs: SupervisorOutputs,
}

impl SupervisorDecision {
    pub(crate) fn of(decision: &Decision) -> Self {
        let verdict = |channel: Option<&Channel>| {
            let verdict = channel.map_or(Verdict::PASS, |channel| decision.verdicts.of(*channel));
            SupervisorVerdict::of(verdict)
        };
        Self {
            verdicts: core::array::from_fn(|number| verdict(Channel::ALL.get(number))),
            status: SupervisorStatus::of(&decision.status),
            outputs: SupervisorOutputs::of(&decision.outputs),
        }
    }
}
