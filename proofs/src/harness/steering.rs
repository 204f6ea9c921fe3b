//! Automatic steering, any command (STR, SELF-5g, SELF-11e, E2E-2i).

use supervisor_core::{Outputs, Percent, vet_steering, vet_warnings};

use super::Any;
use super::channels::Around;
use crate::properties::steering::{
    cmd_3_steering_counts_from_our_last_output, str_1_angle_stays_in_range, str_1_bounds_exactly,
    str_1_goes_out_within_its_bounds, str_2_asked_for_anew, str_2_end_is_shown, str_2_fades_exactly,
    str_2_permitted_exactly, str_2_takeover_ends,
};

/// STR-1, STR-2a, STR-2e to STR-2h, SELF-5g: when it may act, and how far it may turn, exactly.
#[kani::proof]
#[kani::unwind(17)]
#[kani::stub(supervisor_core::kernel::portion, crate::harness::uninterpreted::portion)]
#[kani::stub(supervisor_core::kernel::within_percent, crate::harness::uninterpreted::within_percent)]
fn str_1_bounds_of_the_steering() {
    let any = Any::new();
    let outputs = kani::any();
    let cycle = any.cycle(&outputs);
    assert!(str_2_permitted_exactly(&cycle));
    assert!(str_1_bounds_exactly(&cycle));
    let (bound, acts) = (&any.decided.envelope.steering, any.old.steering.weight > Percent::ZERO);
    kani::cover!(!acts && bound.enable.is_ok() && bound.angle_least < bound.angle_most, "it may begin");
    kani::cover!(acts && any.inputs.wheel_speed.known().is_none(), "without a speed");
}

/// STR-1e, STR-2c, STR-2d, SELF-5g: what fades.
#[kani::proof]
#[kani::unwind(17)]
#[kani::stub(supervisor_core::kernel::portion, crate::harness::uninterpreted::portion)]
#[kani::stub(supervisor_core::kernel::share_down, crate::harness::uninterpreted::share_down)]
fn str_2_fades_of_the_steering() {
    let any = Any::new();
    let outputs = kani::any();
    assert!(str_2_fades_exactly(&any.cycle(&outputs)));
    let bound = &any.decided.envelope.steering;
    kani::cover!(bound.weight_least > Percent::ZERO && bound.overlay_neutral.raw() < 0, "it fades out");
}

/// STR-1, STR-2, SELF-5g, E2E-2i: what goes out, exactly, of any feasible envelope. Put together with its bounds
/// (`str_1_bounds_of_the_steering`, `str_2_fades_of_the_steering`) this is all that goes out.
#[kani::proof]
fn str_1_steering_up_to_its_bounds() {
    let around = Around::timed();
    let steering = vet_steering(&around.envelope, around.commands.steering).0;
    let outputs = Outputs { steering, ..kani::any() };
    let cycle = around.cycle(&outputs);
    assert!(str_1_goes_out_within_its_bounds(&cycle));
    let (bound, acts) = (&around.envelope.steering, steering.weight > Percent::ZERO);
    kani::cover!(acts && steering.angle == bound.angle_most, "the wheel turns as far as it may");
    kani::cover!(acts && bound.enable.is_err(), "it fades out");
    kani::cover!(!steering.enable && steering.angle.raw() > 0, "idle fields pass");
}

/// STR-1a, STR-2a, STR-2b, CMD-3f: takeover, and what the next cycle counts from and remembers of the steering.
#[kani::proof]
#[kani::unwind(17)]
#[kani::stub(supervisor_core::kernel::together, crate::harness::uninterpreted::together)]
#[kani::stub(supervisor_core::kernel::portion, crate::harness::uninterpreted::portion)]
#[kani::stub(supervisor_core::kernel::share_down, crate::harness::uninterpreted::share_down)]
#[kani::stub(supervisor_core::kernel::within_percent, crate::harness::uninterpreted::within_percent)]
fn str_2_next_cycle_counts_from_the_output() {
    let mut any = Any::new();
    let envelope = &any.decided.envelope;
    let steering = vet_steering(envelope, any.commands.steering).0;
    let warnings = vet_warnings(envelope, any.commands.warnings).0;
    let outputs = Outputs { steering, warnings, ..kani::any() };
    any.record(&outputs);
    let cycle = any.cycle(&outputs);
    assert!(str_2_takeover_ends(&cycle));
    assert!(str_2_asked_for_anew(&cycle));
    assert!(str_2_end_is_shown(&cycle));
    assert!(str_1_angle_stays_in_range(&cycle));
    assert!(cmd_3_steering_counts_from_our_last_output(&cycle));
    let (old, next) = (&any.old.steering, &any.next.steering);
    kani::cover!(!old.barred && next.barred, "the driver takes over the steering");
    kani::cover!(old.barred && !next.barred, "it is asked for anew");
    kani::cover!(next.lost, "its command is lost");
}
