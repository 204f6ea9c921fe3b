//! What must hold in every cycle: the properties of the package, one table.

use supervisor_core::{Commands, Decision};
use supervisor_proofs::properties::{self, Cycle};

/// A property of a cycle.
#[derive(Clone, Copy)]
pub struct Check {
    /// Its name.
    pub name: &'static str,
    /// Whether it holds.
    pub holds: fn(&Cycle, &Commands, &Decision) -> bool,
}

macro_rules! of_cycle {
    ($($name:ident),* $(,)?) => { &[$(Check { name: stringify!($name), holds: |cycle, _, _| cycle.$name() },)*] };
}

/// Properties of a cycle.
const CYCLE: &[Check] = of_cycle!(
    seat_5a_no_release_without_confirmed_seat,
    seat_5_confirmation_counts_real_time,
    seat_5_release_after_leave_needs_all,
    seat_5_pedal_chain_is_honest,
    seat_4_apply_in_leave,
    seat_4_latch_holds,
    seat_7_k1_after_k4,
    hv_1_k4_opens_without_load,
    seat_7_shutdown_happens,
    seat_7_k1_follows,
    seat_7_committed,
    seat_11_ten_minutes_are_real,
    seat_8_close_needs_restart,
    seat_8_restart_in_order,
    no_torque_under_obligation,
    seat_6_neutral,
    brake_never_below_obligation,
    self_5_safe_state,
    self_7_latched,
    self_7_quiet_counts_real_time,
    self_6_flow_fault_is_the_safe_state,
    self_7_contactor_fault_closes_nothing,
    trq_7_excess_is_answered,
    self_10_bypass_is_answered,
    rsp_1_retarder_helps,
    epb_1_parking_brake_helps,
    vlc_1_mode_not_configured_commands_nothing,
);

/// Properties of envelope, commands and outputs.
const VECTOR: &[Check] = &[
    Check { name: "self_2_feasible", holds: |cycle, _, _| cycle.envelope.is_feasible() },
    Check { name: "self_2_sound", holds: |cycle, _, _| properties::self_2_sound(cycle.envelope, cycle.outputs) },
    Check {
        name: "self_2_transparent",
        holds: |cycle, commands, decision| {
            properties::self_2_transparent(cycle.envelope, commands, cycle.outputs, &decision.verdicts)
        },
    },
];

/// Every property.
pub fn all() -> impl Iterator<Item = Check> {
    CYCLE.iter().chain(VECTOR).copied()
}
