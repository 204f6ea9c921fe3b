//! Words for people: channels, verdicts, reasons with their requirement, faults, causes.

use supervisor::{Cause, Channel, Kind, Reason, Rejection};

/// A channel.
#[must_use]
pub const fn channel(channel: Channel) -> &'static str {
    match channel {
        Channel::DriveTorque => "drive torque",
        Channel::TargetSpeed => "target speed",
        Channel::ServiceBrake => "service brake",
        Channel::Retarder => "retarder",
        Channel::Gear => "gear",
        Channel::ParkingBrake => "parking brake",
        Channel::Steering => "steering",
        Channel::Contactors => "contactors",
        Channel::Auxiliaries => "auxiliaries",
        Channel::Warnings => "warnings",
        Channel::Body => "body",
        Channel::Mode => "mode request",
    }
}

/// A verdict.
#[must_use]
pub const fn kind(kind: Kind) -> &'static str {
    match kind {
        Kind::Pass => "PASS",
        Kind::Limit => "LIMIT",
        Kind::Substitute => "SUBSTITUTE",
        Kind::Block => "BLOCK",
    }
}

/// Why a signal is unknown.
#[must_use]
pub const fn cause(cause: Cause) -> &'static str {
    match cause {
        Cause::NeverReceived => "never received",
        Cause::Stale => "stale: no frame in time",
        Cause::EndToEnd => "failed its end-to-end check",
        Cause::OutOfRange => "out of range",
        Cause::NotAvailable => "sent as error or not available",
        Cause::Requalifying => "back, but not yet requalified",
    }
}

/// Why a frame was refused.
#[must_use]
pub const fn rejection(rejection: Rejection) -> &'static str {
    match rejection {
        Rejection::Checksum => "wrong checksum",
        Rejection::Counter => "counter repeated, lost or out of order",
        Rejection::Field => "a value that the channel does not have",
        Rejection::Form => "wrong length or reserved bits",
        Rejection::Requalifying => "first after a gap, its counter not yet seen to run",
    }
}

/// A reason in a sentence, and the requirement behind it.
#[must_use]
pub const fn reason(reason: Reason) -> (&'static str, &'static str) {
    match reason {
        Reason::Within => ("inside the envelope", "SELF-2"),
        Reason::CommandLost => ("no command in time", "E2E-2"),
        Reason::CommandRejected => ("the frame failed its check", "rule 5"),
        Reason::SafeState => ("safe state", "SELF-5"),
        Reason::ClockFault => ("clock fault in this cycle", "SELF-3"),
        Reason::Bypass => ("somebody else commands an actuator, or one moved by itself", "SELF-10"),
        Reason::Mitigation => ("a collision-mitigation level runs", "MIT-1..5"),
        Reason::Leave => ("the driver has left the seat", "SEAT-2, SEAT-3"),
        Reason::SpeedlessHold => ("speed lost after an obligation: the bus is held", "MIT-7"),
        Reason::PhantomBraking => ("comfort cap: the road is known to be clear", "PHB-1"),
        Reason::BrakeCap => ("greatest deceleration", "PHB-1"),
        Reason::BrakePedal => ("brake pedal pressed or unknown: no comfort braking", "TRQ-3"),
        Reason::DriverOverride => ("the driver overrides: no comfort braking", "TRQ-4"),
        Reason::BrakeMode => ("the obligation needs its own mode and priority", "spec §2"),
        Reason::ElectricLimit => ("electric limit reached, unknown, or slip control at work", "VLC-2"),
        Reason::AntiLock => ("ABS at work", "RET-1"),
        Reason::BrakeResponse => ("the brakes give less than is obliged: the next stronger means", "RSP-1, EPB-1"),
        Reason::PedalMap => ("more torque than the accelerator allows", "TRQ-1"),
        Reason::AcceleratorUnknown => ("accelerator unknown", "TRQ-1"),
        Reason::BothPedals => ("brake pedal pressed or unknown", "TRQ-1, TRQ-3"),
        Reason::NotActive => ("the sender's active flag is not set", "TRQ-2"),
        Reason::ModeNotGranted => ("the mode is not granted by driver evidence", "TRQ-2, MODE-1"),
        Reason::PerceptionUnknown => ("perception unknown", "TRQ-2"),
        Reason::AccelerationBound => ("our own acceleration bound", "TRQ-2"),
        Reason::DriveLimit => ("electric limit of VCU and battery reached, or unknown", "TRQ-5"),
        Reason::TorqueRamp => ("rising faster than the gradient", "TRQ-5"),
        Reason::ReleaseNeeded => ("after leave the accelerator has not been seen released", "TRQ-5"),
        Reason::IdleTorque => ("EPBi torque below the idle torque", "TRQ-5"),
        Reason::BrakeDemand => ("a brake demand runs", "TRQ-6"),
        Reason::GearDirection => ("no confirmed gear in the direction of the torque", "TRQ-6"),
        Reason::SlipControl => ("slip control at work or unknown: no rise", "RSP-1"),
        Reason::ExcessTorque => ("the drive gives more than it was told", "TRQ-7"),
        Reason::NotConfigured => ("the sender belongs to the longitudinal mode that is not configured", "VLC-1"),
        Reason::SpeedLimit => ("above the speed limit or what the mode allows", "SPD-1"),
        Reason::ObstacleAhead => ("an obstacle ahead calls for mitigation: no automated torque", "TRQ-2"),
        Reason::SeatNotOccupied => ("the seat is not confirmed occupied", "SEAT-5, SEAT-6, SEAT-8"),
        Reason::ParkedByLeave => ("parked by leave: K1, K4, gear and accelerator are not all confirmed", "SEAT-5"),
        Reason::EpbApply => ("the parking brake is to be applied", "SEAT-4"),
        Reason::DriverSwitch => ("the driver's own switch says apply", "EPB-1"),
        Reason::EpbSpeed => ("too fast, or speed unknown, for the parking brake", "EPB-1"),
        Reason::NotStandstill => ("not at standstill, or speed unknown", "GEAR-1, HV-1, AUX-1"),
        Reason::Selector => ("the driver's selector does not ask for it, or is unknown", "GEAR-1"),
        Reason::NeutralObliged => ("parked by leave: neutral", "SEAT-6"),
        Reason::Shutdown => ("high voltage is shut down after leave", "SEAT-7"),
        Reason::K4NotOpen => ("K4 is not confirmed open", "SEAT-7, HV-1"),
        Reason::LoadsNotStopped => ("drive or auxiliaries are not confirmed stopped", "SEAT-7, HV-1"),
        Reason::NoRestart => ("closing needs seat, key Off, key Start in that order", "SEAT-8"),
        Reason::K1NotClosed => ("K1 is not confirmed closed: K1 closes before K4", "SEAT-8"),
        Reason::ContactorFault => ("a contactor fault is latched: nothing closes", "SELF-7"),
        Reason::SteeringRefused => ("automatic steering is not permitted", "STR-2"),
        Reason::Takeover => ("the driver has taken over", "STR-2"),
        Reason::PowerSteering => ("power steering derated, failed or unknown", "STR-2"),
        Reason::SteeringSpeed => ("outside the speed range, or speed unknown", "STR-2"),
        Reason::SteeringAngle => ("angle outside the envelope", "STR-1"),
        Reason::SteeringRate => ("rate above the bound", "STR-1"),
        Reason::SteeringOverlay => ("overlay torque above the bound", "STR-1"),
        Reason::SteeringWeight => ("weight beyond the fade", "STR-2"),
        Reason::BarTorque => ("the bar-torque limit would widen the authority", "STR-1"),
        Reason::SteeringResponse => ("the steering does not follow", "RSP-1"),
        Reason::WarningObliged => ("a warning is obliged", "FCW-1, PCW-1, SEAT-1, RPT-1"),
        Reason::BrakeLamps => ("brake lamps are obliged", "BODY-1"),
        Reason::HazardFlashers => ("hazard flashers override the indicators", "BODY-1"),
        Reason::FieldRange => ("a field beyond its range", "CMD"),
    }
}

/// The requirement behind a reason on this channel: narrower than [`reason`] says where channels share one.
#[must_use]
pub const fn requirement(channel: Channel, why: Reason) -> &'static str {
    match (why, channel) {
        (Reason::NotStandstill, Channel::Gear) => "GEAR-1",
        (Reason::NotStandstill | Reason::LoadsNotStopped | Reason::K4NotOpen, Channel::Contactors) => "SEAT-7, HV-1",
        (Reason::NotStandstill, Channel::Auxiliaries) => "AUX-1",
        (Reason::SeatNotOccupied, Channel::ParkingBrake) => "SEAT-5",
        (Reason::SeatNotOccupied, Channel::Contactors) => "SEAT-8",
        (Reason::SeatNotOccupied, _) => "SEAT-6",
        (Reason::Leave, Channel::ServiceBrake) => "SEAT-3",
        (Reason::Leave, Channel::ParkingBrake) => "SEAT-4",
        (Reason::Leave, Channel::DriveTorque) => "SEAT-2",
        (Reason::Mitigation, Channel::DriveTorque) => "MIT-5",
        (Reason::Mitigation, Channel::ServiceBrake) => "MIT-1..4",
        _ => reason(why).1,
    }
}

/// A fault by its name in the supervisor.
#[must_use]
pub fn fault(name: &str) -> String {
    name.to_lowercase()
        .replace('_', " ")
        .replace("epb", "EPB")
        .replace("ttc", "TTC")
        .replace("ebs", "EBS")
        .replace("k1", "K1")
        .replace("k4", "K4")
}
