//! What the road's channels are bounded by, and what is recorded of them (VLC-2, VLC-3, E2E-2, BODY-1, RPT-1, RET-1).

use supervisor_core::{DecelMs2Q11, Faults, Millis, Outputs, Percent, vet_retarder};

use super::Any;
use crate::properties::body::{
    body_1c_delay_counts_real_time, body_1c_lamps_go_off_after_the_delay, e2e_1g_timeouts_as_configured,
};
use crate::properties::brake::{
    cmd_3f_brake_counts_from_last_output, e2e_2_lost_request_is_told, e2e_2c_lost_request_holds,
    e2e_2d_then_falls_by_the_ramp, rsp_1_held_against_what_went_out,
};
use crate::properties::retarder::ret_1b_none_beside_abs;
use crate::properties::split::{vlc_2_electric_limit_exactly, vlc_3_implausible_is_told};
use crate::properties::warnings::warnings_obliged_exactly;

/// VLC-2, VLC-3, BODY-1, RET-1: the electric limit, what is told, the lamps and the retarder.
#[kani::proof]
#[kani::unwind(17)]
#[kani::stub(supervisor_core::kernel::within_percent, crate::harness::uninterpreted::within_percent)]
#[kani::stub(supervisor_core::kernel::fits, crate::harness::uninterpreted::fits)]
fn vlc_2_bounds_of_the_road() {
    let any = Any::new();
    let envelope = &any.decided.envelope;
    let given: Outputs = kani::any();
    let (retarder, _) = vet_retarder(envelope, envelope.brake.retarder_beside(given.brake.total), kani::any());
    let outputs = Outputs { retarder, ..given };
    let cycle = any.cycle(&outputs);
    assert!(vlc_2_electric_limit_exactly(&cycle));
    assert!(vlc_3_implausible_is_told(&cycle));
    assert!(warnings_obliged_exactly(&cycle));
    assert!(body_1c_lamps_go_off_after_the_delay(&cycle));
    assert!(e2e_1g_timeouts_as_configured(&cycle));
    assert!(e2e_2_lost_request_is_told(&cycle));
    assert!(ret_1b_none_beside_abs(&cycle));
    kani::cover!(envelope.brake.electric > DecelMs2Q11::ZERO, "an electric part is allowed");
    kani::cover!(any.decided.faults.contains(Faults::SPLIT_IMPLAUSIBLE), "a value for the split is not plausible");
    kani::cover!(envelope.warnings.fault_lamp, "the fault lamp");
    kani::cover!(envelope.lamps_delayed, "the lamps stay on");
    kani::cover!(outputs.retarder.torque > Percent::ZERO, "a retarder torque passes");
}

/// RSP-1a to RSP-1e, SELF-10a: what the actuators are held against from the next cycle on.
#[kani::proof]
#[kani::unwind(17)]
#[kani::stub(supervisor_core::kernel::together, crate::harness::uninterpreted::together)]
fn rsp_1_next_cycle_is_held_against_the_output() {
    let mut any = Any::new();
    let outputs = kani::any();
    any.record(&outputs);
    assert!(rsp_1_held_against_what_went_out(&any.cycle(&outputs)));
    let (before, next) = (&any.decided.state.monitors, &any.next.monitors);
    kani::cover!(next.total > next.service, "the retarder is told to help");
    kani::cover!(next.emergency && !before.emergency, "level 3 begins");
    kani::cover!(next.torque > before.torque, "more torque than before");
}

/// E2E-2, CMD-3f, BODY-1c: for how long a lost request holds, how it falls then, and what the next cycle begins with.
#[kani::proof]
#[kani::unwind(17)]
#[kani::stub(supervisor_core::kernel::fallen, crate::harness::uninterpreted::fallen)]
#[kani::stub(supervisor_core::kernel::together, crate::harness::uninterpreted::together)]
fn e2e_2_lost_request_and_record() {
    let mut any = Any::new();
    let outputs = kani::any();
    any.record(&outputs);
    let cycle = any.cycle(&outputs);
    assert!(e2e_2c_lost_request_holds(&cycle));
    assert!(e2e_2d_then_falls_by_the_ramp(&cycle));
    assert!(cmd_3f_brake_counts_from_last_output(&cycle));
    assert!(body_1c_delay_counts_real_time(&cycle));
    let fallback = any.decided.envelope.brake.fallback;
    kani::cover!(any.old.brake.lost.is_running() && fallback == any.old.brake.total && fallback.raw() > 0, "it holds");
    kani::cover!(fallback < any.old.brake.total && fallback.raw() > 0, "it falls");
    kani::cover!(any.next.brake.lost.is_running(), "a request is lost");
    kani::cover!(
        any.next.brake.lamps > Millis::ZERO && any.next.brake.lamps < any.config.lamp_delay,
        "the delay passes"
    );
}
