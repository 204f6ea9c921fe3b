//! What is kept for diagnosis, apart from the supervisor.

use supervisor::report::{BodyFeedback, BodyMonitor, Dm1Sender, EventRecord, FaultReport};
use supervisor::wire::Source;
use supervisor::{Decision, Millis};

use crate::memory::Kept;
use crate::types::{SUPERVISOR_EVENTS, SupervisorDiagnosis};

/// Event record, debounced faults, lamps and wipers that do not follow, DM1.
#[derive(Debug)]
pub(crate) struct Diagnosis {
    pub(crate) record: EventRecord<SUPERVISOR_EVENTS, 1>,
    pub(crate) faults: FaultReport,
    pub(crate) dm1: Dm1Sender,
    lamps: BodyMonitor,
}

impl Diagnosis {
    pub(crate) fn new() -> Self {
        Self {
            record: EventRecord::new(),
            faults: FaultReport::default(),
            dm1: Dm1Sender::new(Source::Supervisor.address()),
            lamps: BodyMonitor::new(),
        }
    }

    /// RPT-1a: takes one cycle.
    pub(crate) fn observe(&mut self, now: Millis, decision: &Decision, feedback: &BodyFeedback) {
        self.record.observe(now, decision, None);
        self.faults.observe(now, decision, self.lamps.observe(now, decision, feedback));
    }
}

impl Kept for Diagnosis {
    type Memory = SupervisorDiagnosis;
    /// "DIAG".
    const MAGIC: u32 = 0x4741_4944;
}
