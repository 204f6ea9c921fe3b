//! Collision mitigation: when a level begins, when it ends, what stays permitted (MIT).

use supervisor_core::{Level, Mitigation};

use super::Any;
use crate::properties::mitigation::{
    mit_1_latches_begin_exactly, mit_4_latches_end_exactly, mit_4_timers_run_without_a_break,
    mit_4g_level_three_ends_at_standstill_only, mit_4h_every_latch_ends_at_standstill, mit_6d_braking_stays_permitted,
    mit_7_hold_follows_lost_speed, mit_7_unknown_keeps_what_has_begun, mit_8c_only_time_to_collision_obliges,
};
use crate::properties::warnings::fcw_1_pcw_1_begin_and_end_exactly;

/// MIT-1 to MIT-3, MIT-6, MIT-7d, MIT-8, FCW-1, PCW-1: every level begins exactly by its own conditions; what is permitted; the warnings.
#[kani::proof]
#[kani::unwind(17)]
#[kani::stub(supervisor_core::kernel::within_percent, crate::harness::uninterpreted::within_percent)]
fn mit_1_levels_begin_exactly() {
    let any = Any::new();
    let outputs = kani::any();
    let cycle = any.cycle(&outputs);
    assert!(mit_1_latches_begin_exactly(&cycle));
    assert!(mit_8c_only_time_to_collision_obliges(&cycle));
    assert!(mit_6d_braking_stays_permitted(&cycle));
    assert!(fcw_1_pcw_1_begin_and_end_exactly(&cycle));
    let (old, new): (&Mitigation, &Mitigation) = (&any.old.mitigation, &any.decided.state.mitigation);
    kani::cover!(!old.running() && new.three && !new.one && !new.two, "level 3 alone begins");
    kani::cover!(any.threat.level == Level::Three && !new.running(), "a level is called for and does not begin");
    let little = any.threat.required < any.config.level_least_required;
    kani::cover!(any.threat.level == Level::Three && little && !new.running(), "little braking is enough");
    kani::cover!(new.permitted && !new.running() && any.threat.level == Level::None, "permitted though not obliged");
}

/// MIT-4, MIT-7: every level ends exactly by its own conditions, each of them reachable.
#[kani::proof]
#[kani::unwind(17)]
#[kani::stub(supervisor_core::kernel::within_percent, crate::harness::uninterpreted::within_percent)]
fn mit_4_levels_end_exactly() {
    let any = Any::new();
    let outputs = kani::any();
    let cycle = any.cycle(&outputs);
    assert!(mit_4_latches_end_exactly(&cycle));
    assert!(mit_4_timers_run_without_a_break(&cycle));
    assert!(mit_4h_every_latch_ends_at_standstill(&cycle));
    assert!(mit_4g_level_three_ends_at_standstill_only(&cycle));
    assert!(mit_7_hold_follows_lost_speed(&cycle));
    assert!(mit_7_unknown_keeps_what_has_begun(&cycle));
    let (old, new): (&Mitigation, &Mitigation) = (&any.old.mitigation, &any.decided.state.mitigation);
    kani::cover!(old.one && old.two && !new.one && new.two, "level 1 ends by steering, level 2 goes on");
    kani::cover!(old.three && !new.three && new.standstill.is_running(), "level 3 ends at standstill");
    kani::cover!(old.three && !new.three && !new.standstill.is_running() && new.hold, "a lost speed becomes the hold");
}
