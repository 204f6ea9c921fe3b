//! The rules of all machines (RULE-1, RULE-6), and what a command can do to the state (CMD-1, CMD-3, CMD-7).

use supervisor_core::{Mode, Outputs, vet_body, vet_brake, vet_drive, vet_epb, vet_mode, vet_retarder, vet_steering};

use super::Any;
use crate::properties::command::cmd_5_envelope_explains;
use crate::properties::rules::{
    cmd_1_fields_in_range, cmd_3_rates_count_from_the_output, cmd_7_commands_are_no_evidence,
    rule_1_unknown_begins_nothing, rule_1_unknown_ends_nothing, rule_1_unknown_is_reported,
    rule_1_unknown_permits_nothing, rule_6_speeds,
};

/// CMD-5b: every refusal and every bound has a reason.
#[kani::proof]
#[kani::unwind(17)]
fn cmd_5_refusals_have_reasons() {
    let any = Any::new();
    assert!(cmd_5_envelope_explains(&any.decided.envelope));
    kani::cover!(any.decided.envelope.automated.is_err(), "a refusal");
}

/// RULE-1, RULE-6: unknown begins nothing, ends nothing, permits nothing; which of the two speeds counts.
#[kani::proof]
#[kani::unwind(17)]
#[kani::stub(supervisor_core::kernel::within_percent, crate::harness::uninterpreted::within_percent)]
fn rule_1_unknown() {
    let any = Any::new();
    let outputs: Outputs = kani::any();
    let cycle = any.cycle(&outputs);
    assert!(rule_1_unknown_is_reported(&cycle));
    assert!(rule_1_unknown_begins_nothing(&cycle));
    assert!(rule_1_unknown_permits_nothing(&cycle));
    assert!(rule_1_unknown_ends_nothing(&cycle));
    assert!(rule_6_speeds(&cycle));
    let no_speed = cycle.known_speeds().is_none();
    kani::cover!(no_speed && any.decided.state.seat.leave && any.old.seat.leave, "leave without a speed");
    kani::cover!(no_speed && any.old.mitigation.three && !any.decided.state.mitigation.three, "level 3 becomes a hold");
    kani::cover!(any.decided.envelope.automated.is_ok(), "a mode is permitted");
}

/// CMD-1b, CMD-3f, CMD-7a: fields in range, rates from the output, commands are no evidence.
#[kani::proof]
#[kani::unwind(17)]
fn cmd_7_no_evidence() {
    let mut any = Any::new();
    let (envelope, commands) = (&any.decided.envelope, &any.commands);
    let others: Outputs = kani::any();
    let most = kani::any::<supervisor_core::Bound<supervisor_core::Percent>>();
    kani::assume(most.most <= supervisor_core::Percent::FULL);
    let outputs = Outputs {
        drive: vet_drive(envelope, others.mode, others.gear, kani::any(), commands.drive).0,
        brake: vet_brake(envelope, commands.brake).0,
        retarder: vet_retarder(envelope, most, commands.retarder).0,
        steering: vet_steering(envelope, commands.steering).0,
        epb: vet_epb(envelope, commands.epb).0,
        mode: vet_mode(envelope, commands.mode).0,
        body: vet_body(envelope, kani::any(), commands.body).0,
        ..others
    };
    any.record(&outputs);
    let cycle = any.cycle(&outputs);
    assert!(cmd_1_fields_in_range(&cycle));
    assert!(cmd_3_rates_count_from_the_output(&cycle));
    assert!(cmd_7_commands_are_no_evidence(&cycle));
    kani::cover!(
        any.next.drive.mode == Mode::Automated && any.decided.state.drive.mode == Mode::Manual,
        "a mode begins"
    );
    kani::cover!(any.decided.state.parking.by_leave && !any.next.parking.by_leave, "a release ends parked by leave");
}
