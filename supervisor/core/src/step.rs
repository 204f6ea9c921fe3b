//! Step: the only way in.

use crate::decide::{Decided, decide};
use crate::envelope::Envelope;
use crate::state::{State, StateImage};
use crate::vet::vet;

use supervisor_observe::Evidence;
use supervisor_terms::{
    Checkpoint, Commands, Config, ExitReason, Faults, Flow, Inputs, Level, Millis, Mode, Occupancy, Outputs, Record,
    Sealed, Stage, Threat, Verdicts,
};

/// The state after the cycle, for people and records. Nothing in it can be written back.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(kani, derive(kani::Arbitrary))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
pub struct Status {
    /// The seat.
    pub occupancy: Occupancy,
    /// Parked by leave.
    pub parked_by_leave: bool,
    /// Time parked by leave towards the shutdown of high voltage.
    pub parked_for: Millis,
    /// Stage of that shutdown.
    pub stage: Stage,
    /// Highest mitigation level set.
    pub level: Level,
    /// The longitudinal mode.
    pub mode: Mode,
    /// Why the automated mode last ended.
    pub exit: ExitReason,
    /// Safe state.
    pub safe_state: bool,
    /// Faults and hints of this cycle.
    pub faults: Faults,
    /// What to persist now (SELF-9).
    pub record: Record,
}

/// Everything that one cycle decides.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Decision {
    /// What goes to the actuators, on every channel.
    pub outputs: Outputs,
    /// Why.
    pub verdicts: Verdicts,
    /// What had to and could happen.
    pub envelope: Envelope,
    /// Where the supervisor stands.
    pub status: Status,
    /// The stages that ran: [`Flow::answer`] answers the watchdog (SELF-6).
    pub flow: Flow,
}

/// SELF-4f: one cycle, without a switch that leaves a part out: decode the state, observe the actuators, decide, vet, put the state to rest.
///
/// `flow` has passed what ran before, [`Flow::PERCEIVED`] where perception did or was not needed (SELF-6).
///
/// Total: any image, time, inputs, threat and commands give a decision (SELF-1). State that does not decode, or a
/// configuration that has changed, is the safe state, latched (SELF-4e, SELF-5b).
#[must_use]
pub fn step(
    image: &mut StateImage,
    sealed: &Sealed,
    flow: Flow,
    now: Millis,
    inputs: &Inputs,
    threat: &Threat,
    commands: &Commands,
) -> Decision {
    let mut state = image.decode().unwrap_or_else(|| State::damaged(image));
    let flow = flow.pass(Checkpoint::Decode);
    let config = sealed.intact().unwrap_or_else(|| {
        state.latches.faults = state.latches.faults.with(Faults::CONFIGURATION);
        &Config::DEFAULT
    });
    let flow = flow.pass(Checkpoint::Configuration);
    let (_, ticks) = state.clock.advance(now, config);
    let (monitors, response) = state.monitors.advance(&Evidence::gather(inputs, config), inputs, ticks, config);
    let flow = flow.pass(Checkpoint::Observe);
    let decided = decide(&State { monitors, ..state }, now, inputs, threat, &response, config);
    let flow = flow.pass(Checkpoint::Decide);
    let (outputs, verdicts) = vet(&decided.envelope, commands);
    let flow = flow.pass(Checkpoint::Vet);
    let next = record(&decided, &outputs, commands, config);
    let flow = flow.pass(Checkpoint::Record);
    *image = StateImage::encode(&State { flow, ..next });
    let flow = flow.pass(Checkpoint::Encode);
    let lost = |reason: bool, fault| if reason { fault } else { Faults::NONE };
    let timeouts = decided.envelope.timeouts;
    let faults = decided
        .faults
        .with(lost(commands.drive.usable(timeouts.ms50).is_err(), Faults::DRIVE_COMMAND_LOST))
        .with(lost(commands.brake.usable(timeouts.ms50).is_err(), Faults::BRAKE_COMMAND_LOST))
        .with(lost(
            commands.steering.usable(timeouts.ms50).is_err() && decided.state.steering.acts(),
            Faults::STEERING_COMMAND_LOST,
        ));
    let status = status(&next, faults, config);
    Decision { outputs, verdicts, envelope: decided.envelope, status, flow }
}

/// What went out becomes part of the state: rates, ramps and latches count from it.
#[must_use]
pub fn record(decided: &Decided, outputs: &Outputs, commands: &Commands, config: &Config) -> State {
    let timeouts = decided.envelope.timeouts;
    let usable = [commands.brake.usable(timeouts.ms50).is_ok(), commands.retarder.usable(timeouts.ms100).is_ok()];
    let asked = commands.drive.usable(timeouts.ms50).ok();
    let mode_lost = commands.mode.usable(timeouts.ms200).is_err();
    let steers = commands.steering.usable(timeouts.ms50).ok().map(|steering| steering.enable);
    let (state, bound) = (decided.state, &decided.envelope.brake);
    let braking = bound.total(outputs);
    State {
        parking: state.parking.record(outputs),
        drive: state.drive.record(outputs, braking, asked, mode_lost, decided.ticks, config),
        brake: state.brake.record(outputs, bound.lamps_due(braking, config.lamp_decel), usable, decided.ticks, config),
        steering: state.steering.record(outputs, &decided.envelope.steering, steers, decided.ticks, config),
        body: outputs.body,
        monitors: state.monitors.record(outputs, braking, state.mitigation.three),
        ..state
    }
}

fn status(state: &State, faults: Faults, config: &Config) -> Status {
    let occupancy = if state.seat.leave {
        Occupancy::Leave
    } else if state.seat.confirmed(config) {
        Occupancy::Confirmed
    } else {
        Occupancy::NotConfirmed
    };
    Status {
        occupancy,
        parked_by_leave: state.parking.by_leave,
        parked_for: state.high_voltage.parked.elapsed(),
        stage: state.high_voltage.stage,
        level: state.mitigation.level(),
        mode: state.drive.mode,
        exit: state.drive.exit,
        safe_state: state.is_safe_state(),
        faults,
        record: state.record(),
    }
}
