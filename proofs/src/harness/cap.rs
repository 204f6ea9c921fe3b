//! How much must and may the bus brake (PHB-1, MIT-4, TRQ-3, TRQ-4, SEAT-3, RET-1).

use supervisor_core::{DecelMs2Q11, Mode};

use super::Any;
use crate::properties::brake::{mit_4b_greatest_demand_exactly, rule_1d_slow_is_kept};
use crate::properties::cap::{
    phb_1_cap_exactly, phb_1_never_against_obligation_or_driver, phb_1b_full_cap_in_danger,
    self_11b_nothing_else_limits, trq_3b_comfort_braking_ends_at_the_pedal,
    trq_4g_no_comfort_braking_against_the_accelerator,
};
use crate::properties::leave::seat_3_demand_of_leave;
use crate::properties::retarder::ret_1b_bound_exactly;

/// PHB-1, TRQ-3, TRQ-4, MIT-4b: the obligation is the greatest demand that runs, the cap exactly what road and driver leave,
/// for any map from pedal to deceleration.
#[kani::proof]
#[kani::unwind(17)]
#[kani::stub(supervisor_core::kernel::share_up, crate::harness::uninterpreted::share_up)]
#[kani::stub(supervisor_core::kernel::within_percent, crate::harness::uninterpreted::within_percent)]
fn phb_1_cap_and_obligation_exactly() {
    let any = Any::new();
    let outputs = kani::any();
    let cycle = any.cycle(&outputs);
    assert!(phb_1_cap_exactly(&cycle));
    assert!(phb_1b_full_cap_in_danger(&cycle));
    assert!(trq_3b_comfort_braking_ends_at_the_pedal(&cycle));
    assert!(phb_1_never_against_obligation_or_driver(&cycle));
    assert!(trq_4g_no_comfort_braking_against_the_accelerator(&cycle));
    assert!(self_11b_nothing_else_limits(&cycle));
    assert!(mit_4b_greatest_demand_exactly(&cycle));
    assert!(rule_1d_slow_is_kept(&cycle));
    assert!(seat_3_demand_of_leave(&cycle));
    assert!(ret_1b_bound_exactly(&cycle));
    let (bound, state) = (&any.decided.envelope.brake, &any.decided.state);
    let obliged = bound.floor.most > DecelMs2Q11::ZERO;
    kani::cover!(!obliged && bound.cap.most == any.config.comfort_cap, "the cap of comfort");
    kani::cover!(!obliged && bound.cap.most == any.config.brake_cap, "the full cap, nothing obliged");
    let stands = cycle.stands() && bound.cap.most > any.config.comfort_cap;
    kani::cover!(!obliged && stands && !any.inputs.brake_switch.is(true), "at standstill");
    kani::cover!(!obliged && bound.cap.most == DecelMs2Q11::ZERO, "nothing is left");
    let (pressed, comfort) = (any.inputs.brake_switch.is(true), any.config.comfort_cap);
    kani::cover!(!obliged && pressed && bound.cap.most > comfort, "the driver brakes harder");
    kani::cover!(!obliged && pressed && bound.cap.most < comfort, "no more than the driver");
    kani::cover!(
        state.drive.mode == Mode::Suspended && bound.cap.most > DecelMs2Q11::ZERO,
        "mitigation though overridden"
    );
    kani::cover!(obliged && bound.cap.most > any.config.brake_cap, "an obligation beyond the cap raises it");
    kani::cover!(state.brake.leave > DecelMs2Q11::ZERO && !state.is_safe_state(), "leave brakes");
    kani::cover!(obliged && state.is_safe_state() && !state.seat.leave, "the safe state brakes");
}
