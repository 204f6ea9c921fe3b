//! Who sits, when leave begins and ends, what it obliges (SEAT-0, SEAT-1, SEAT-9, SEAT-10).

use supervisor_core::{
    ContactorRequest, EpbRequest, GearRequest, Outputs, vet_contactors, vet_epb, vet_gear, vet_warnings,
};

use super::Any;
use crate::properties::seat::{
    seat_0a_confirmed_exactly, seat_1_leave_begins_and_ends_exactly, seat_1_leave_warns, seat_1_vacancy_counts_exactly,
    seat_9_nothing_is_given_back_by_itself, seat_9_return_ends_and_resets, seat_10_unknown_is_reported,
    seat_10_unknown_obliges_nothing, seat_10_unknown_permits_nothing,
};

/// SEAT-0, SEAT-1, SEAT-10: confirmed, vacancy and leave, exactly.
#[kani::proof]
#[kani::unwind(17)]
#[kani::stub(supervisor_core::kernel::within_percent, crate::harness::uninterpreted::within_percent)]
fn seat_1_leave_exactly() {
    let any = Any::new();
    let outputs = Outputs { warnings: vet_warnings(&any.decided.envelope, any.commands.warnings).0, ..kani::any() };
    let cycle = any.cycle(&outputs);
    assert!(seat_0a_confirmed_exactly(&cycle));
    assert!(seat_1_leave_begins_and_ends_exactly(&cycle));
    assert!(seat_1_vacancy_counts_exactly(&cycle));
    assert!(seat_1_leave_warns(&cycle));
    assert!(seat_10_unknown_obliges_nothing(&cycle));
    assert!(seat_10_unknown_is_reported(&cycle));
    let (old, new) = (&any.old.seat, &any.decided.state.seat);
    kani::cover!(!old.leave && new.leave && outputs.warnings.seat_leave, "leave begins and warns");
    kani::cover!(old.leave && !new.leave, "leave ends");
    kani::cover!(new.unknown.is_running() && new.vacant.is_running(), "the vacancy is frozen");
    kani::cover!(!new.vacant.is_running() && new.unknown.is_running() && old.vacant.is_running(), "and then reset");
    kani::cover!(new.occupied.is_running() && !new.confirmed(&any.config), "occupied, not yet confirmed");
}

/// SEAT-9, SEAT-10b: the return resets; nothing is given back by itself, and nothing is permitted without the seat.
#[kani::proof]
#[kani::unwind(17)]
#[kani::stub(supervisor_core::kernel::within_percent, crate::harness::uninterpreted::within_percent)]
fn seat_9_return_and_permissions() {
    let any = Any::new();
    let (envelope, commands) = (&any.decided.envelope, &any.commands);
    let others: Outputs = kani::any();
    let outputs = Outputs {
        epb: vet_epb(envelope, commands.epb).0,
        gear: vet_gear(envelope, commands.gear).0,
        contactors: vet_contactors(envelope, others.drive.torque, commands.contactors).0,
        ..others
    };
    let cycle = any.cycle(&outputs);
    assert!(seat_9_return_ends_and_resets(&cycle));
    assert!(seat_9_nothing_is_given_back_by_itself(&cycle));
    assert!(seat_10_unknown_permits_nothing(&cycle));
    kani::cover!(any.old.seat.leave && !any.decided.state.seat.leave, "the return");
    kani::cover!(outputs.epb.request == EpbRequest::Release, "a release that was asked for");
    kani::cover!(outputs.gear == GearRequest::Drive, "a gear that was asked for");
    kani::cover!(outputs.contactors.k1 == ContactorRequest::Close, "a contactor that was asked to close");
}
