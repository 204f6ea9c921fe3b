//! Automatic steering, any command (STR, SELF-5g, SELF-11e, E2E-2i).

use supervisor_core::{Outputs, Percent, vet_steering};

use super::Any;
use crate::properties::steering::{
    str_1_angle_is_exactly_bounded, str_1_overlay_below_takeover, str_1_rate_and_bar_never_widened,
    str_2_idle_commands_nothing, str_2_overlay_fades, str_2_permitted_exactly, str_2_weight_fades,
};

/// STR-1, STR-2, SELF-5g, E2E-2i: when it may act, how it begins and ends, and how far it turns meanwhile.
#[kani::proof]
#[kani::unwind(17)]
#[kani::stub(supervisor_core::kernel::portion, crate::harness::uninterpreted::portion)]
#[kani::stub(supervisor_core::kernel::share_down, crate::harness::uninterpreted::share_down)]
#[kani::stub(supervisor_core::kernel::within_percent, crate::harness::uninterpreted::within_percent)]
fn str_1_steering_is_exactly_bounded() {
    let any = Any::new();
    let steering = vet_steering(&any.decided.envelope, any.commands.steering).0;
    let outputs = Outputs { steering, ..kani::any() };
    let cycle = any.cycle(&outputs);
    assert!(str_2_permitted_exactly(&cycle));
    assert!(str_1_angle_is_exactly_bounded(&cycle));
    assert!(str_1_rate_and_bar_never_widened(&cycle));
    assert!(str_1_overlay_below_takeover(&cycle));
    assert!(str_2_overlay_fades(&cycle));
    assert!(str_2_weight_fades(&cycle));
    assert!(str_2_idle_commands_nothing(&cycle));
    let (before, out, new) = (any.old.steering.weight, &outputs.steering, &any.decided.state);
    let acts = out.weight > Percent::ZERO;
    kani::cover!(before == Percent::ZERO && acts, "it begins");
    kani::cover!(before > out.weight && acts && new.is_safe_state(), "in the safe state it fades out");
    kani::cover!(before == out.weight && acts && new.seat.leave, "in leave it goes on");
    kani::cover!(acts && out.angle != any.old.steering.angle, "the wheel turns");
    kani::cover!(acts && any.inputs.wheel_speed.known().is_none(), "without a speed it fades out");
    kani::cover!(!out.enable && out.angle.raw() > 0, "idle fields pass");
}
