//! SELF-2: what `vet` gives, channel by channel and as a whole vector.

use supervisor_core::{
    BrakeMode, Channel, Command, Commands, ContactorBound, ContactorRequest, Contactors, DecelMs2Q11, DriveTorque,
    DrivingMode, Envelope, EpbRequest, GearRequest, Millis, Origin, Outputs, ParkingBrake, Percent, Priority,
    ServiceBrake, Steering, Verdicts, Warnings,
};

use super::implies;

/// SELF-2a: soundness of the service brake: never below the obligation, never above the cap; the electric part within
/// its limit and within the total; an obligation carries its own mode and priority.
#[must_use]
pub fn self_2_brake_sound(envelope: &Envelope, out: &ServiceBrake) -> bool {
    let bound = &envelope.brake;
    let obliged = bound.floor.most > DecelMs2Q11::ZERO;
    out.total >= bound.floor.most
        && out.total <= bound.cap.most
        && out.electric <= out.total
        && out.electric <= bound.electric
        && implies(obliged, out.mode == BrakeMode::Maximum && out.priority == Priority::Highest)
}

/// SELF-2a: soundness of the retarder: with the service brake it stays below the cap.
#[must_use]
pub fn self_2_retarder_sound(envelope: &Envelope, outputs: &Outputs) -> bool {
    let bound = &envelope.brake;
    outputs.retarder.torque <= bound.retarder.most
        && implies(
            outputs.retarder.torque > Percent::ZERO && outputs.brake.total <= bound.cap.most,
            bound.total(outputs) <= bound.cap.most,
        )
}

/// SELF-2a: soundness of the drive torque beside a gear and a total deceleration: within its bound, not against the
/// brake but for hill-hold, and only active.
#[must_use]
pub fn self_2_drive_sound(
    envelope: &Envelope,
    mode: DrivingMode,
    gear: GearRequest,
    braking: DecelMs2Q11,
    drive: &DriveTorque,
) -> bool {
    let by_driver = drive.origin == Origin::Driver;
    let most = match drive.origin {
        Origin::Driver => envelope.torque.driver.most,
        Origin::Adas => envelope.torque.automated.most,
        Origin::Epbi => envelope.torque.epbi.most,
    };
    let flows = drive.torque > Percent::ZERO;
    drive.torque <= most
        && implies(flows && !(envelope.torque.hill_hold && by_driver), braking == DecelMs2Q11::ZERO)
        && implies(flows && !by_driver, drive.active && mode == DrivingMode::Automated)
        && implies(flows && drive.origin == Origin::Epbi, drive.torque >= envelope.torque.idle)
        && implies(flows, !matches!(gear, GearRequest::Neutral | GearRequest::Park))
}

/// SELF-2a: soundness of the steering: what acts is inside the window, the overlay and the fade.
#[must_use]
pub fn self_2_steering_sound(envelope: &Envelope, out: &Steering) -> bool {
    let bound = &envelope.steering;
    implies(
        out.enable,
        out.angle >= bound.angle_least
            && out.angle <= bound.angle_most
            && out.rate <= bound.rate
            && out.overlay >= bound.overlay_least
            && out.overlay <= bound.overlay_most
            && out.weight >= bound.weight_least
            && out.weight <= bound.weight_most
            && out.bar_limit <= bound.bar,
    ) && implies(out.enable && bound.enable.is_err(), out.weight == bound.weight_least)
        && implies(!out.enable, out.weight == Percent::ZERO)
}

/// SELF-2a: soundness of the contactors.
#[must_use]
pub fn self_2_contactors_sound(envelope: &Envelope, out: &Contactors) -> bool {
    let permitted = |request, bound: &ContactorBound| match request {
        ContactorRequest::Hold => true,
        ContactorRequest::Open => bound.open.is_ok(),
        ContactorRequest::Close => bound.close.is_ok(),
    };
    permitted(out.k4, &envelope.k4)
        && permitted(out.k1, &envelope.k1)
        && implies(envelope.k1.obliged, out.k1 == ContactorRequest::Open)
}

/// SELF-2a: soundness of the parking brake: an obliged apply goes out, a release only if permitted.
#[must_use]
pub fn self_2_epb_sound(envelope: &Envelope, out: &ParkingBrake) -> bool {
    match out.request {
        EpbRequest::None => envelope.epb.obliged.is_none(),
        EpbRequest::Apply => envelope.epb.apply.is_ok(),
        EpbRequest::Release => envelope.epb.release.is_ok() && envelope.epb.obliged.is_none(),
    }
}

/// SELF-2a: soundness of the gear.
#[must_use]
pub fn self_2_gear_sound(envelope: &Envelope, out: GearRequest) -> bool {
    let bound = &envelope.gear;
    let permitted = match out {
        GearRequest::Hold => true,
        GearRequest::Neutral => bound.to_neutral.is_ok(),
        GearRequest::Drive => bound.drive.is_ok(),
        GearRequest::Reverse => bound.reverse.is_ok(),
        GearRequest::Park => bound.park.is_ok(),
    };
    permitted && implies(bound.neutral, out == GearRequest::Neutral)
}

/// SELF-2a: soundness of the warnings: what is obliged is on.
#[must_use]
pub fn self_2_warnings_sound(envelope: &Envelope, out: &Warnings) -> bool {
    let bound = &envelope.warnings;
    implies(bound.seat_leave, out.seat_leave)
        && implies(bound.hazard_flashers, out.hazard_flashers)
        && implies(bound.forward_collision, out.forward_collision)
        && implies(bound.pedestrian, out.pedestrian)
        && implies(bound.fault_lamp, out.fault_lamp)
        && implies(bound.notice_lamp, out.notice_lamp)
}

/// SELF-2a: soundness of the whole vector.
#[must_use]
pub fn self_2_sound(envelope: &Envelope, outputs: &Outputs) -> bool {
    self_2_brake_sound(envelope, &outputs.brake)
        && self_2_retarder_sound(envelope, outputs)
        && self_2_drive_sound(envelope, outputs.mode, outputs.gear, envelope.brake.total(outputs), &outputs.drive)
        && self_2_steering_sound(envelope, &outputs.steering)
        && self_2_contactors_sound(envelope, &outputs.contactors)
        && self_2_epb_sound(envelope, &outputs.epb)
        && self_2_gear_sound(envelope, outputs.gear)
        && self_2_warnings_sound(envelope, &outputs.warnings)
        && outputs.target_speed <= envelope.target_speed.most
        && implies(outputs.mode == DrivingMode::Automated, envelope.automated.is_ok())
}

/// Whether a usable command went out unchanged.
#[must_use]
pub fn went_unchanged<T: PartialEq + Copy>(command: Command<T>, timeout: Millis, out: T) -> bool {
    command.usable(timeout).is_ok_and(|value| value == out)
}

/// SELF-2b: transparency: a verdict says *pass* exactly when a usable command went out unchanged.
#[must_use]
pub fn self_2_transparent(envelope: &Envelope, commands: &Commands, outputs: &Outputs, verdicts: &Verdicts) -> bool {
    let Envelope { timeouts, .. } = envelope;
    let same = |channel, unchanged| verdicts.of(channel).passed() == unchanged;
    same(Channel::DriveTorque, went_unchanged(commands.drive, timeouts.ms50, outputs.drive))
        && same(Channel::TargetSpeed, went_unchanged(commands.target_speed, timeouts.ms50, outputs.target_speed))
        && same(Channel::ServiceBrake, went_unchanged(commands.brake, timeouts.ms50, outputs.brake))
        && same(Channel::Retarder, went_unchanged(commands.retarder, timeouts.ms100, outputs.retarder))
        && same(Channel::Gear, went_unchanged(commands.gear, timeouts.ms100, outputs.gear))
        && same(Channel::ParkingBrake, went_unchanged(commands.epb, timeouts.ms200, outputs.epb))
        && same(Channel::Steering, went_unchanged(commands.steering, timeouts.ms50, outputs.steering))
        && same(Channel::Contactors, went_unchanged(commands.contactors, timeouts.ms100, outputs.contactors))
        && same(Channel::Auxiliaries, went_unchanged(commands.auxiliaries, timeouts.ms200, outputs.auxiliaries))
        && same(Channel::Warnings, went_unchanged(commands.warnings, timeouts.ms200, outputs.warnings))
        && same(Channel::Body, went_unchanged(commands.body, timeouts.ms200, outputs.body))
        && same(Channel::Mode, went_unchanged(commands.mode, timeouts.ms200, outputs.mode))
}
