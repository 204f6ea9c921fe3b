//! What "less safe" means, channel by channel (spec §2, column *safe direction*), in one place.

use super::common::*;

/// What both runs share in the cycle that is judged.
#[derive(Clone, Copy, Debug)]
pub struct Cycle<'a> {
    /// What was read.
    pub inputs: &'a Inputs,
    /// What went out in the cycle before: jumps count from it.
    pub before: &'a Outputs,
}

/// The channels on which `run` is less safe than `reference`, both the answer to the same inputs and commands.
///
/// Gear and contactors: *hold* is never less safe, it is what the safe state asks for (SELF-5f).
pub fn less_safe(cycle: Cycle<'_>, reference: &Decision, run: &Decision) -> Vec<Channel> {
    let (bound, was, is) = (&reference.envelope, &reference.outputs, &run.outputs);
    let weaker = |mode: BrakeMode, than: BrakeMode| mode.code() < than.code();
    let braking = |outputs| bound.brake.total(outputs);
    let rolls = cycle.inputs.wheel_speed.known().is_none_or(|speed| speed >= KMH_1_5)
        || cycle.inputs.motor_speed.known().is_none_or(|speed| speed >= KMH_1_5);
    let judged = [
        // Less.
        (Channel::DriveTorque, is.drive.torque > was.drive.torque),
        (Channel::TargetSpeed, is.target_speed > was.target_speed),
        // More, up to the cap; an obligation that is obeyed with a lower mode or priority is less.
        (
            Channel::ServiceBrake,
            is.brake.total < was.brake.total
                || (is.brake.total > was.brake.total && is.brake.total > bound.brake.cap.most)
                || is.brake.electric > bound.brake.electric.max(was.brake.electric)
                || (was.brake.total > DecelMs2Q11::ZERO
                    && (weaker(is.brake.mode, was.brake.mode) || is.brake.priority > was.brake.priority)),
        ),
        (Channel::Retarder, braking(is) < braking(was)),
        // N, or hold while rolling.
        (
            Channel::Gear,
            is.gear != was.gear && matches!(is.gear, GearRequest::Drive | GearRequest::Reverse | GearRequest::Park),
        ),
        // None, then apply at standstill.
        (
            Channel::ParkingBrake,
            match is.epb.request {
                EpbRequest::Release => was.epb.request != EpbRequest::Release,
                EpbRequest::None => was.epb.request == EpbRequest::Apply,
                EpbRequest::Apply => was.epb.request != EpbRequest::Apply && rolls,
            },
        ),
        (Channel::Steering, steering(cycle, &was.steering, &is.steering)),
        (
            Channel::Contactors,
            (is.contactors.k4 != was.contactors.k4 && is.contactors.k4 != ContactorRequest::Hold)
                || (is.contactors.k1 != was.contactors.k1 && is.contactors.k1 != ContactorRequest::Hold),
        ),
        // On while rolling.
        (
            Channel::Auxiliaries,
            (was.auxiliaries.air_pump && !is.auxiliaries.air_pump)
                || (was.auxiliaries.power_steering && !is.auxiliaries.power_steering)
                || (was.auxiliaries.dc_dc && !is.auxiliaries.dc_dc),
        ),
        (Channel::Warnings, warnings(was.warnings).iter().zip(warnings(is.warnings)).any(|(was, is)| *was && !is)),
        // Lamps stay on; indicators give way to the hazard flashers (BODY-1d).
        (
            Channel::Body,
            (was.body.brake_lamps && !is.body.brake_lamps)
                || (was.body.low_beam && !is.body.low_beam)
                || (!is.warnings.hazard_flashers
                    && (was.body.indicator_left != is.body.indicator_left
                        || was.body.indicator_right != is.body.indicator_right))
                || is.body.wipers.code() < was.body.wipers.code(),
        ),
        (Channel::Mode, was.mode == DrivingMode::Manual && is.mode == DrivingMode::Automated),
    ];
    judged.into_iter().filter(|(_, worse)| *worse).map(|(channel, _)| channel).collect()
}

/// No jump first, then the driver: a smaller weight is safer, but not at once.
fn steering(cycle: Cycle<'_>, was: &Steering, is: &Steering) -> bool {
    let before = &cycle.before.steering;
    // The fade of 100 %/s gives 1 % in 10 ms, the greatest rate of 400°/s gives 4°, a rest may add one step.
    let jumps = is.weight.raw().abs_diff(before.weight.raw()) > 2
        || (is.weight > Percent::ZERO && is.angle.raw().abs_diff(before.angle.raw()) > 41);
    let stronger = is.weight > was.weight
        || is.overlay.raw().unsigned_abs() > was.overlay.raw().unsigned_abs()
        || is.bar_limit > was.bar_limit
        || (is.weight > Percent::ZERO && is.rate > was.rate);
    jumps || stronger
}

const fn warnings(warnings: Warnings) -> [bool; 9] {
    let Warnings {
        forward_collision,
        pedestrian,
        seat_leave,
        hazard_flashers,
        fault_lamp,
        notice_lamp,
        lane_departure,
        speed_limit,
        headway,
    } = warnings;
    [
        forward_collision,
        pedestrian,
        seat_leave,
        hazard_flashers,
        fault_lamp,
        notice_lamp,
        lane_departure,
        speed_limit,
        headway,
    ]
}
