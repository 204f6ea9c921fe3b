//! One command against the envelope of the cycle, for a gateway.
#![expect(unsafe_code, reason = "C calls these functions by their names and with pointers")]

use supervisor::{
    Channel, Command, Decision, Millis, Rejection, Verdict, vet_auxiliaries, vet_body, vet_brake, vet_contactors,
    vet_drive, vet_epb, vet_gear, vet_mode, vet_retarder, vet_steering, vet_target_speed, vet_warnings,
};

use super::code;
use crate::codes::SupervisorCode;
use crate::memory::{Input, Output, Place, disjoint};
use crate::state::State;
use crate::types::{SupervisorOutputs, SupervisorState, SupervisorVerdict};

/// Vets one command of one channel against the envelope of the last step, and changes nothing: for a gateway that
/// forwards frames between two steps.
///
/// `channel` is a `SupervisorChannel`; of `asked` only its fields count. `outputs` becomes the outputs of the last step
/// with this channel replaced by what may go out; `verdict` says why. A code that is not in its table is a command that
/// was rejected. Channels that are coupled (mode and gear to torque; brake to retarder, torque and brake lamps; torque
/// to K4) are judged beside the outputs of the last step; what a new brake demand means for the others follows in the
/// next step. The envelope expires with the cycle: after the configured longest cycle it is refused.
///
/// # Safety
/// Each pointer leads to one value of its type; nothing else touches them during the call.
#[must_use]
// SAFETY: no other function of the program has this name; it begins with that of the library.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn supervisor_vet(
    state: *mut SupervisorState,
    now_ms: u32,
    channel: u8,
    asked: *const SupervisorOutputs,
    outputs: *mut SupervisorOutputs,
    verdict: *mut SupervisorVerdict,
) -> SupervisorCode {
    code(|| {
        // SAFETY: promised by the caller.
        let place = unsafe { Place::<State>::new(state) }?;
        // SAFETY: promised by the caller.
        let asked = unsafe { Input::new(asked, 1) }?;
        // SAFETY: promised by the caller.
        let outputs = unsafe { Output::new(outputs, 1) }?;
        // SAFETY: promised by the caller.
        let verdict = unsafe { Output::new(verdict, 1) }?;
        disjoint(&[place.span(), asked.span(), outputs.span(), verdict.span()])?;
        let channel = Channel::from_code(channel).ok_or(SupervisorCode::Value)?;
        let asked = asked.first().ok_or(SupervisorCode::Null)?;
        let (out, why) = place.enter(|state| {
            let last = state.last.ok_or(SupervisorCode::NotStepped)?;
            let age = Millis::new(now_ms.wrapping_sub(last.now.raw()));
            if age > state.supervisor.config().cycle_greatest {
                return Err(SupervisorCode::Expired);
            }
            Ok(vetted(&last.decision, channel, &asked))
        })??;
        outputs.put(0, out);
        verdict.put(0, SupervisorVerdict::of(why));
        Ok(SupervisorCode::Ok)
    })
}

/// What could be read is a frame of this moment; what could not is rejected (CMD-1c).
fn fresh<T>(value: Option<T>) -> Command<T> {
    value.map_or(Command::Rejected(Rejection::Field), Command::Fresh)
}

fn vetted(decision: &Decision, channel: Channel, asked: &SupervisorOutputs) -> (SupervisorOutputs, Verdict) {
    let (envelope, mut out) = (&decision.envelope, decision.outputs);
    let braking = envelope.brake.total(&out);
    let verdict;
    match channel {
        Channel::DriveTorque => {
            (out.drive, verdict) = vet_drive(envelope, out.mode, out.gear, braking, fresh(asked.drive()));
        }
        Channel::TargetSpeed => {
            (out.target_speed, verdict) = vet_target_speed(envelope, out.mode, Command::Fresh(asked.target_speed()));
        }
        Channel::ServiceBrake => (out.brake, verdict) = vet_brake(envelope, fresh(asked.brake())),
        Channel::Retarder => {
            let beside = envelope.brake.retarder_beside(out.brake.total);
            (out.retarder, verdict) = vet_retarder(envelope, beside, fresh(asked.retarder()));
        }
        Channel::Gear => (out.gear, verdict) = vet_gear(envelope, fresh(asked.gear())),
        Channel::ParkingBrake => (out.epb, verdict) = vet_epb(envelope, fresh(asked.epb())),
        Channel::Steering => (out.steering, verdict) = vet_steering(envelope, fresh(asked.steering())),
        Channel::Contactors => {
            (out.contactors, verdict) = vet_contactors(envelope, out.drive.torque, fresh(asked.contactors()));
        }
        Channel::Auxiliaries => (out.auxiliaries, verdict) = vet_auxiliaries(envelope, fresh(asked.auxiliaries())),
        Channel::Warnings => (out.warnings, verdict) = vet_warnings(envelope, fresh(asked.warnings())),
        Channel::Body => (out.body, verdict) = vet_body(envelope, braking, fresh(asked.body())),
        Channel::Mode => (out.mode, verdict) = vet_mode(envelope, fresh(asked.mode())),
    }
    (SupervisorOutputs::of(&out), verdict)
}
