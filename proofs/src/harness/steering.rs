//! Automatic steering, any command (STR, SELF-5g, SELF-11e, E2E-2i).

use supervisor_core::{Outputs, Percent, vet_steering, vet_warnings};

use super::{Any, uninterpreted};
use crate::properties::steering::{
    cmd_3_steering_counts_from_our_last_output, str_1_angle_is_exactly_bounded, str_1_angle_stays_in_range,
    str_1_overlay_below_takeover, str_1_rate_and_bar_never_widened, str_2_asked_for_anew, str_2_end_is_shown,
    str_2_idle_commands_nothing, str_2_overlay_fades, str_2_permitted_exactly, str_2_takeover_ends, str_2_weight_fades,
};

impl Any {
    /// Steering and warnings as vetted for the commands of the cycle.
    fn steering(&self) -> Outputs {
        let envelope = &self.decided.envelope;
        let steering = vet_steering(envelope, self.commands.steering).0;
        Outputs { steering, warnings: vet_warnings(envelope, self.commands.warnings).0, ..kani::any() }
    }
}

/// STR-1: the angle, its rate and what the driver can overpower.
#[kani::proof]
#[kani::unwind(17)]
#[kani::stub(supervisor_core::kernel::portion, uninterpreted::portion)]
#[kani::stub(supervisor_core::kernel::share_down, uninterpreted::share_down)]
#[kani::stub(supervisor_core::kernel::within_percent, uninterpreted::within_percent)]
fn str_1_angle_within_window_and_rate() {
    let any = Any::new();
    let outputs = any.steering();
    let cycle = any.cycle(&outputs);
    assert!(str_1_angle_is_exactly_bounded(&cycle));
    assert!(str_1_rate_and_bar_never_widened(&cycle));
    assert!(str_1_overlay_below_takeover(&cycle));
    assert!(str_2_idle_commands_nothing(&cycle));
    let out = &outputs.steering;
    kani::cover!(out.enable && out.angle != any.old.steering.angle, "the wheel turns");
    kani::cover!(out.enable && any.inputs.wheel_speed.known().is_none(), "without a speed it fades out");
    kani::cover!(!out.enable && out.angle.raw() > 0, "idle fields pass");
}

/// STR-2, SELF-5g, E2E-2i: when it may act, how it begins and ends.
#[kani::proof]
#[kani::unwind(17)]
#[kani::stub(supervisor_core::kernel::portion, uninterpreted::portion)]
#[kani::stub(supervisor_core::kernel::share_down, uninterpreted::share_down)]
#[kani::stub(supervisor_core::kernel::within_percent, uninterpreted::within_percent)]
fn str_2_permission_and_fade() {
    let any = Any::new();
    let outputs = any.steering();
    let cycle = any.cycle(&outputs);
    assert!(str_2_permitted_exactly(&cycle));
    assert!(str_2_overlay_fades(&cycle));
    assert!(str_2_weight_fades(&cycle));
    let (before, now) = (any.old.steering.weight, outputs.steering.weight);
    kani::cover!(before == Percent::ZERO && now > Percent::ZERO, "it begins");
    kani::cover!(before > now && now > Percent::ZERO && any.decided.state.is_safe_state(), "safe state: it fades out");
    kani::cover!(now == before && now > Percent::ZERO && any.decided.state.seat.leave, "in leave it goes on");
}

/// STR-1a, STR-2a, STR-2b, CMD-3f: takeover, and what the next cycle counts from.
#[kani::proof]
#[kani::unwind(17)]
#[kani::stub(supervisor_core::kernel::portion, uninterpreted::portion)]
#[kani::stub(supervisor_core::kernel::share_down, uninterpreted::share_down)]
#[kani::stub(supervisor_core::kernel::within_percent, uninterpreted::within_percent)]
fn str_2_takeover_and_next_cycle() {
    let mut any = Any::new();
    let outputs = any.steering();
    any.record(&outputs);
    let cycle = any.cycle(&outputs);
    assert!(str_2_takeover_ends(&cycle));
    assert!(str_2_asked_for_anew(&cycle));
    assert!(str_2_end_is_shown(&cycle));
    assert!(str_1_angle_stays_in_range(&cycle));
    assert!(cmd_3_steering_counts_from_our_last_output(&cycle));
    kani::cover!(!any.old.steering.barred && any.next.steering.barred, "the driver takes over");
    kani::cover!(any.old.steering.barred && !any.next.steering.barred, "it is asked for anew");
    kani::cover!(any.next.steering.lost, "its command is lost");
}
