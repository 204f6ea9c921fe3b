//! Where the supervisor stands: the codes that status, records and diagnosis speak of.

use crate::word::codes;

codes! {
    /// Why the supervisor starts.
    ResetCause {
        /// Power was switched on (key-on).
        PowerOn = 0,
        /// The watchdog.
        Watchdog = 1,
        /// Anything else: brown-out, software, unknown.
        Other = 2,
    }
    /// What was persisted, protected by the integrator's CRC.
    Record {
        /// Nothing.
        None = 0,
        /// In leave, or parked by leave.
        Leave = 1,
        /// High voltage is being, or was, shut down after leave.
        HighVoltageDown = 2,
    }
    /// The longitudinal mode as granted.
    Mode {
        /// The driver drives.
        Manual = 0,
        /// Automated.
        Automated = 1,
        /// Automated, but the driver's accelerator governs for now (TRQ-4).
        Suspended = 2,
    }
    /// How far the shutdown after leave has gone.
    Stage {
        /// Not begun.
        Up = 0,
        /// Committed: K4 opens.
        OpeningK4 = 1,
        /// K4 was confirmed open: loads stop, then K1 opens.
        OpeningK1 = 2,
        /// Both were confirmed open.
        Down = 3,
    }
    /// What the supervisor says of the seat.
    Occupancy {
        /// Confirmed occupied.
        Confirmed = 0,
        /// Not confirmed; no leave runs.
        NotConfirmed = 1,
        /// Leave runs.
        Leave = 2,
    }
}
