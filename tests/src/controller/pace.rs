//! When a change goes out: at once where it matters, else with the next frame of its period.
//!
//! The link sends every message with its period, and at once when its content changes. A torque that rises and a
//! brake demand that falls change in every cycle; they wait for the 50 ms of S4 table 5 (a control time is the
//! longest period, spec reading h), so that the bus is not flooded. Drive and retarder torque travel in TSC1, which
//! J1939 sends on demand: a controller that wants none says so for a while and then pauses.

use supervisor::{Command, Commands, DriveTorque, Outputs, Percent, RetarderMode, ServiceBrake};

/// S4 table 5, ACS 3 and BKS 1.
const PERIOD_MS: u32 = 50;
/// How long "no torque" is said before the pause (own).
const FAREWELL_MS: u32 = 200;

/// What has gone out last, and when.
#[derive(Clone, Copy, Debug)]
pub struct Pace {
    drive: (DriveTorque, u32),
    brake: (ServiceBrake, u32),
    farewell_ms: [u32; 2],
}

impl Default for Pace {
    fn default() -> Self {
        Self { drive: (DriveTorque::NEUTRAL, 0), brake: (ServiceBrake::NEUTRAL, 0), farewell_ms: [FAREWELL_MS; 2] }
    }
}

impl Pace {
    /// What goes out in this cycle of 10 ms.
    pub fn next(&mut self, wanted: &Outputs) -> Commands {
        let form = |drive: &DriveTorque| (drive.active, drive.origin);
        let (drive, age) = &mut self.drive;
        *age += 10;
        if wanted.drive.torque < drive.torque || form(&wanted.drive) != form(drive) || *age >= PERIOD_MS {
            (*drive, *age) = (wanted.drive, 0);
        }
        let form = |brake: &ServiceBrake| (brake.mode, brake.priority);
        let (brake, age) = &mut self.brake;
        *age += 10;
        let urgent = wanted.brake.total > brake.total || wanted.brake.electric < brake.electric;
        if urgent || form(&wanted.brake) != form(brake) || *age >= PERIOD_MS {
            (*brake, *age) = (wanted.brake, 0);
        }
        let sent = Outputs { drive: self.drive.0, brake: self.brake.0, ..*wanted };
        let drives = sent.drive.active || sent.drive.torque > Percent::ZERO;
        let retards = sent.retarder.mode != RetarderMode::Off;
        for (left, asks) in self.farewell_ms.iter_mut().zip([drives, retards]) {
            *left = if asks { FAREWELL_MS } else { left.saturating_sub(10) };
        }
        let mut commands = sent.as_commands();
        let [drive, retarder] = self.farewell_ms.map(|left| left > 0);
        if !drive {
            commands.drive = Command::Absent;
        }
        if !retarder {
            commands.retarder = Command::Absent;
        }
        commands
    }
}
