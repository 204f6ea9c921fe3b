//! What becomes of a command (CMD-2, CMD-3, CMD-5): usable or not, and a verdict that says what happened and why.

use supervisor_core::{
    BrakeMode, Command, DecelMs2Q11, DriveTorque, DrivingMode, Envelope, GearRequest, Kind, Millis, Percent,
    Permission, Priority, Reason, ServiceBrake, Steering, Verdict,
};

use super::implies;
use super::vetting::self_2_drive_sound;

/// CMD-2a to CMD-2d: a command is exactly one of four; fresh it is usable, held for as long as its time-out; never, too old
/// or refused it is not, each for its own reason.
#[must_use]
pub fn cmd_2_usable_exactly<T: Copy + PartialEq>(command: Command<T>, timeout: Millis) -> bool {
    let expected = match command {
        Command::Fresh(value) => Ok(value),
        Command::Held(age, value) if age.raw() <= timeout.raw() => Ok(value),
        Command::Held(_, _) | Command::Absent => Err(Reason::CommandLost),
        Command::Rejected(_) => Err(Reason::CommandRejected),
    };
    command.usable(timeout) == expected
}

/// CMD-3b, CMD-3c, CMD-5a, CMD-5b: pass exactly when a usable command went out unchanged, and exactly then without a reason;
/// blocked, the channel is neutral.
#[must_use]
pub fn cmd_5_verdict_is_true<T: Copy + PartialEq>(
    command: Command<T>,
    timeout: Millis,
    out: T,
    neutral: T,
    verdict: Verdict,
) -> bool {
    let unchanged = command.usable(timeout).is_ok_and(|value| value == out);
    verdict.passed() == unchanged
        && (verdict.reason == Reason::Within) == unchanged
        && implies(verdict.kind == Kind::Block, out == neutral)
}

/// CMD-2e, CMD-5b: where what stands for a lost or refused command goes out, the verdict says just that: why there was no command, as
/// blocked where nothing goes out, as substituted where something is kept.
#[must_use]
pub fn cmd_2_lost_is_told<T: Copy + PartialEq>(
    command: Command<T>,
    timeout: Millis,
    (instead, neutral): (T, T),
    (out, verdict): (T, Verdict),
) -> bool {
    let kind = if out == neutral { Kind::Block } else { Kind::Substitute };
    let told = |reason| verdict.reason == reason && verdict.kind == kind;
    command.usable(timeout).err().is_none_or(|reason| implies(out == instead, told(reason)))
}

/// What stands for a lost request of the service brake: the one that `decide` keeps, or none.
#[must_use]
pub fn brake_instead(envelope: &Envelope) -> ServiceBrake {
    match envelope.brake.fallback {
        DecelMs2Q11::ZERO => ServiceBrake::NEUTRAL,
        total => {
            ServiceBrake { total, electric: DecelMs2Q11::ZERO, mode: BrakeMode::Maximum, priority: Priority::Medium }
        }
    }
}

/// CMD-5b: every refusal and every bound that a command can meet has a reason. `decide` gives only such envelopes (proved);
/// the proofs of `vet` assume nothing else.
#[must_use]
pub fn cmd_5_envelope_explains(envelope: &Envelope) -> bool {
    let told = |reason: Reason| reason != Reason::Within;
    let refused = |permission: Permission| permission.err().is_none_or(told);
    let (torque, brake, gear, epb) = (&envelope.torque, &envelope.brake, &envelope.gear, &envelope.epb);
    let permissions = [
        gear.drive,
        gear.reverse,
        gear.park,
        gear.to_neutral,
        epb.apply,
        epb.release,
        envelope.steering.enable,
        envelope.k4.open,
        envelope.k4.close,
        envelope.k1.open,
        envelope.k1.close,
        envelope.auxiliaries_off,
        envelope.automated,
    ];
    let bounds = [torque.driver.reason, torque.automated.reason, torque.epbi.reason, brake.retarder.reason];
    permissions.into_iter().all(refused)
        && bounds.into_iter().all(told)
        && told(brake.cap.reason)
        && told(envelope.target_speed.reason)
        && implies(brake.floor.most > DecelMs2Q11::ZERO, told(brake.floor.reason))
        && epb.obliged.is_none_or(told)
}

/// No value is nearer to the wanted one than what went out.
fn nearest(wanted: i32, out: i32, other: i32) -> bool {
    wanted.abs_diff(out) <= wanted.abs_diff(other)
}

/// CMD-5e: the service brake: no total inside floor and cap is nearer to the one asked for.
#[must_use]
pub fn cmd_5_brake_nearest(envelope: &Envelope, wanted: &ServiceBrake, out: &ServiceBrake, other: DecelMs2Q11) -> bool {
    let bound = &envelope.brake;
    let inside = other >= bound.floor.most && other <= bound.cap.most;
    implies(inside, nearest(wanted.total.wide(), out.total.wide(), other.wide()))
}

/// CMD-5e: drive torque that was limited: no torque that would be sound beside this gear and deceleration is nearer.
#[must_use]
pub fn cmd_5_drive_nearest(
    envelope: &Envelope,
    mode: DrivingMode,
    gear: GearRequest,
    braking: DecelMs2Q11,
    wanted: &DriveTorque,
    vetted: (DriveTorque, Verdict),
    other: Percent,
) -> bool {
    let sound = self_2_drive_sound(envelope, mode, gear, braking, &DriveTorque { torque: other, ..*wanted });
    let (out, verdict) = vetted;
    // A gear that is being engaged has no torque yet.
    let steady = gear == GearRequest::Hold;
    implies(
        verdict.kind == Kind::Limit && sound && steady,
        nearest(wanted.torque.wide(), out.torque.wide(), other.wide()),
    )
}

/// CMD-5e: steering that was limited: each field is the nearest one inside its window.
#[must_use]
pub fn cmd_5_steering_nearest(
    envelope: &Envelope,
    wanted: &Steering,
    vetted: (Steering, Verdict),
    other: &Steering,
) -> bool {
    let (bound, (out, verdict)) = (&envelope.steering, vetted);
    let pairs = [
        (wanted.angle.wide(), out.angle.wide(), other.angle.wide(), bound.angle_least.wide(), bound.angle_most.wide()),
        (wanted.rate.wide(), out.rate.wide(), other.rate.wide(), 0, bound.rate.wide()),
        (
            wanted.overlay.wide(),
            out.overlay.wide(),
            other.overlay.wide(),
            bound.overlay_least.wide(),
            bound.overlay_most.wide(),
        ),
        (
            wanted.weight.wide(),
            out.weight.wide(),
            other.weight.wide(),
            bound.weight_least.wide(),
            bound.weight_most.wide(),
        ),
        (wanted.bar_limit.wide(), out.bar_limit.wide(), other.bar_limit.wide(), 0, bound.bar.wide()),
    ];
    implies(
        verdict.kind == Kind::Limit,
        pairs.into_iter().all(|(wanted, out, other, least, most)| {
            implies(other >= least && other <= most, nearest(wanted, out, other))
        }),
    )
}
