//! What `vet` makes of a request, for any feasible envelope: without `decide`, so for every state at once.

use supervisor_core::{
    Commands, Config, DecelMs2Q11, Envelope, Faults, Inputs, Millis, Outputs, Percent, Response, State, Threat,
    vet_body, vet_brake, vet_epb, vet_retarder, vet_warnings,
};

use super::vetting::any_envelope;
use crate::properties::Cycle;
use crate::properties::body::{body_1_brake_lamps_exactly, body_1d_flashers_override_indicators, self_11j_body_passes};
use crate::properties::brake::{
    cmd_6a_obligation_has_its_own_mode, self_11b_request_in_bounds_passes, vlc_1e_requests_merge,
};
use crate::properties::retarder::{ret_1a_as_much_as_fits, self_11g_request_inside_cap_passes};
use crate::properties::split::vlc_2_split_exactly;
use crate::properties::warnings::self_11j_warnings_given_exactly;

/// A cycle around any feasible envelope and any commands: nothing of it comes from `decide`.
pub(super) struct Around {
    old: State,
    new: State,
    next: State,
    now: Millis,
    inputs: Inputs,
    threat: Threat,
    response: Response,
    pub(super) commands: Commands,
    config: Config,
    pub(super) envelope: Envelope,
    faults: Faults,
}

impl Around {
    /// Any state, inputs, threat and configuration around it: what is proved of `decide` may be asked of them.
    pub(super) fn any() -> Self {
        Self {
            old: kani::any(),
            new: kani::any(),
            inputs: kani::any(),
            threat: kani::any(),
            response: kani::any(),
            config: kani::any(),
            ..Self::new()
        }
    }
    /// The time-outs of the envelope are those of the configuration, as `e2e_1g_timeouts_as_configured` proves of `decide`.
    pub(super) fn timed() -> Self {
        let mut around = Self::new();
        around.config.timeout_50 = around.envelope.timeouts.ms50;
        around.config.timeout_100 = around.envelope.timeouts.ms100;
        around.config.timeout_200 = around.envelope.timeouts.ms200;
        around
    }
    /// For properties that read nothing but the envelope and the commands.
    fn new() -> Self {
        Self {
            old: State::INITIAL,
            new: State::INITIAL,
            next: State::INITIAL,
            now: kani::any(),
            inputs: Inputs::NEVER,
            threat: Threat::UNKNOWN,
            response: Response::FOLLOWS,
            commands: kani::any(),
            config: Config::DEFAULT,
            envelope: any_envelope(),
            faults: Faults::NONE,
        }
    }
    pub(super) fn cycle<'a>(&'a self, outputs: &'a Outputs) -> Cycle<'a> {
        Cycle {
            old: &self.old,
            now: self.now,
            inputs: &self.inputs,
            threat: &self.threat,
            response: &self.response,
            commands: &self.commands,
            config: &self.config,
            new: &self.new,
            envelope: &self.envelope,
            faults: self.faults,
            outputs,
            next: &self.next,
            agreed: crate::properties::facts::agreed_speeds(&self.inputs, &self.config),
        }
    }
}

/// VLC-1e, VLC-2, CMD-6, SELF-11b, RULE-3: the service brake. The properties read nothing but the envelope and the commands.
#[kani::proof]
#[kani::unwind(17)]
fn vlc_1e_brake_requests_merge() {
    let around = Around::new();
    let (envelope, given): (_, Outputs) = (&around.envelope, kani::any());
    let brake = vet_brake(envelope, around.commands.brake).0;
    let outputs = Outputs { brake, epb: vet_epb(envelope, around.commands.epb).0, ..given };
    let cycle = around.cycle(&outputs);
    assert!(vlc_1e_requests_merge(&cycle));
    assert!(vlc_2_split_exactly(&cycle));
    assert!(self_11b_request_in_bounds_passes(&cycle));
    assert!(cmd_6a_obligation_has_its_own_mode(&cycle));
    let obliged = envelope.brake.floor.most > DecelMs2Q11::ZERO;
    kani::cover!(obliged && brake.total > envelope.brake.floor.most, "a request beyond the obligation");
    kani::cover!(
        obliged && brake.total == envelope.brake.floor.most && brake.electric.raw() > 0,
        "split electric first"
    );
    kani::cover!(!obliged && brake.total == envelope.brake.cap.most && brake.total.raw() > 0, "a request at the cap");
    kani::cover!(envelope.epb.obliged.is_some(), "the parking brake is obliged");
}

/// RET-1a, SELF-11g, PHB-1: the retarder, for any division; that what fits stays below the cap, and not one per cent less, is
/// the contract of that division, which the test `ret_1_fits_by_its_contract` goes through for every valid configuration.
#[kani::proof]
#[kani::unwind(17)]
#[kani::stub(supervisor_core::kernel::fits, crate::harness::uninterpreted::fits)]
fn ret_1_retarder_inside_cap() {
    let (around, given): (_, Outputs) = (Around::new(), kani::any());
    let beside = around.envelope.brake.retarder_beside(given.brake.total);
    let retarder = vet_retarder(&around.envelope, beside, around.commands.retarder).0;
    let outputs = Outputs { retarder, ..given };
    assert!(ret_1a_as_much_as_fits(&around.cycle(&outputs)));
    let torque = outputs.retarder.torque;
    kani::cover!(torque > Percent::ZERO && torque < Percent::FULL, "some of it passes");
}

/// FCW-1c, PCW-1c, BODY-1, SELF-11j, E2E-2j: warnings and body.
#[kani::proof]
#[kani::unwind(17)]
#[kani::stub(supervisor_core::kernel::together, crate::harness::uninterpreted::together)]
fn body_1_lamps_and_warnings() {
    let around = Around::new();
    let (envelope, given): (_, Outputs) = (&around.envelope, kani::any());
    let body = vet_body(envelope, envelope.brake.total(&given), around.commands.body).0;
    let warnings = vet_warnings(envelope, around.commands.warnings).0;
    let outputs = Outputs { body, warnings, ..given };
    let cycle = around.cycle(&outputs);
    assert!(body_1_brake_lamps_exactly(&cycle));
    assert!(body_1d_flashers_override_indicators(&cycle));
    assert!(self_11j_body_passes(&cycle));
    assert!(self_11j_warnings_given_exactly(&cycle));
    kani::cover!(body.brake_lamps, "the brake lamps are on");
    kani::cover!(!body.brake_lamps, "they are off");
    kani::cover!(warnings.forward_collision && !envelope.warnings.forward_collision, "a warning is given earlier");
}
