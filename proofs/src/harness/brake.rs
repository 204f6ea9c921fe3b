//! The service brake and what helps it (SEAT-3, MIT, RSP-1).

use supervisor_core::{Origin, Outputs, Percent, Reason, vet_brake, vet_drive, vet_epb, vet_mode};

use super::Any;
use super::channels::Around;
use crate::properties::brake::{brake_never_below_obligation, mit_4b_greatest_demand_exactly, rsp_1_retarder_helps};
use crate::properties::drive::{
    self_10_bypass_is_answered, trq_7_excess_is_answered, vlc_1_mode_not_configured_commands_nothing,
};
use crate::properties::mitigation::{mit_1_latches_begin_exactly, rxn_1_same_cycle};
use crate::properties::parking::epb_1_parking_brake_helps;

/// SEAT-3, MIT-1 to MIT-4, RXN-1: the service brake is never below an obligation, whatever the command, from the cycle in
/// which it begins.
///
/// Of the cycle nothing is taken for granted but what is proved of `decide`: a feasible envelope, whose obligation is the greatest
/// demand (`phb_1_cap_and_obligation_exactly`), and levels that begin exactly (`mit_1_levels_begin_exactly`). All else is any.
#[kani::proof]
#[kani::unwind(17)]
#[kani::stub(supervisor_core::kernel::within_percent, crate::harness::uninterpreted::within_percent)]
fn mit_4_brake_never_below_obligation() {
    let around = Around::any();
    let outputs = Outputs { brake: vet_brake(&around.envelope, kani::any()).0, ..kani::any() };
    let cycle = around.cycle(&outputs);
    kani::assume(mit_4b_greatest_demand_exactly(&cycle) && mit_1_latches_begin_exactly(&cycle));
    assert!(brake_never_below_obligation(&cycle));
    assert!(rxn_1_same_cycle(&cycle));
    kani::cover!(cycle.new.mitigation.three && !cycle.old.mitigation.running(), "level 3 begins");
    kani::cover!(cycle.new.seat.leave, "leave");
}

/// RSP-1, TRQ-7, SELF-10, EPB-1, VLC-1: an actuator that does not follow calls the next stronger means.
#[kani::proof]
#[kani::unwind(17)]
fn rsp_1_next_stronger_means() {
    let any = Any::new();
    let envelope = &any.decided.envelope;
    let others: Outputs = kani::any();
    let outputs = Outputs {
        brake: vet_brake(envelope, kani::any()).0,
        drive: vet_drive(envelope, kani::any(), kani::any(), kani::any(), kani::any()).0,
        epb: vet_epb(envelope, kani::any()).0,
        mode: vet_mode(envelope, kani::any()).0,
        ..others
    };
    let cycle = any.cycle(&outputs);
    assert!(trq_7_excess_is_answered(&cycle));
    assert!(self_10_bypass_is_answered(&cycle));
    assert!(rsp_1_retarder_helps(&cycle));
    assert!(epb_1_parking_brake_helps(&cycle));
    assert!(vlc_1_mode_not_configured_commands_nothing(&cycle));
    kani::cover!(envelope.brake.retarder_obliged, "the retarder helps");
    kani::cover!(envelope.epb.obliged == Some(Reason::BrakeResponse), "the parking brake helps");
    kani::cover!(outputs.drive.torque > Percent::ZERO && outputs.drive.origin == Origin::Epbi, "EPBi torque passes");
}
