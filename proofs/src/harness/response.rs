//! Whether the actuators follow: the monitors on any state, inputs, outputs and configuration (RSP-1, TRQ-7, SELF-10).

use supervisor_core::{
    Config, DecelMs2Q11, Deviation, Evidence, Faults, Gear, Inputs, Millis, Monitors, Moves, Outputs, Response,
    SteeredAngle, Ticks,
};

use crate::properties::follow::{Pursuit, Turn, rsp_1_follow, rsp_1_follow_fails, rsp_1_steered, rsp_1_steered_fails};
use crate::properties::response::{
    Watch, rsp_1_abs_never_escalates, rsp_1_brake_escalates_exactly, rsp_1_brake_is_compared,
    rsp_1_compared_with_what_went_out, rsp_1_drive, rsp_1_gear, rsp_1_help_stays_while_unknown,
    rsp_1_nothing_else_is_reported, rsp_1_overshoot, rsp_1_steering, self_10_bypass_counts_from_the_last,
    self_10_loose_parking_brake, self_10_positions_asked_for, self_10_unasked_is_a_bypass,
    trq_7_excess_is_found_exactly,
};

/// Any cycle of the monitors: the shipped `advance` and `record`.
struct AnyWatch {
    old: Monitors,
    inputs: Inputs,
    ticks: Ticks,
    config: Config,
    new: Monitors,
    response: Response,
    outputs: Outputs,
    total: DecelMs2Q11,
    emergency: bool,
    next: Monitors,
}

impl AnyWatch {
    fn new() -> Self {
        let (old, inputs, ticks, config): (Monitors, Inputs, Ticks, Config) =
            (kani::any(), kani::any(), kani::any(), kani::any());
        let (outputs, total, emergency): (Outputs, DecelMs2Q11, bool) = (kani::any(), kani::any(), kani::any());
        let (new, response) = old.advance(&Evidence::gather(&inputs, &config), &inputs, ticks, &config);
        let next = new.record(&outputs, total, emergency);
        Self { old, inputs, ticks, config, new, response, outputs, total, emergency, next }
    }
    fn watch(&self) -> Watch<'_> {
        Watch {
            old: &self.old,
            inputs: &self.inputs,
            ticks: self.ticks,
            config: &self.config,
            new: &self.new,
            response: &self.response,
            outputs: &self.outputs,
            total: self.total,
            emergency: self.emergency,
            next: &self.next,
        }
    }
}

/// RSP-1a to RSP-1c, RSP-1g, RSP-1i: one actuator against its target.
#[kani::proof]
#[kani::solver(kissat)]
fn rsp_1_actuator_follows() {
    let pursuit = Pursuit {
        old: kani::any(),
        target: kani::any(),
        measured: kani::any(),
        error: kani::any(),
        elapsed: kani::any(),
    };
    let Pursuit { old, target, measured, error, elapsed } = pursuit;
    let new = old.advance(target, measured, error, elapsed);
    assert!(rsp_1_follow(pursuit, &new));
    assert!(rsp_1_follow_fails(&new, kani::any(), kani::any()));
    kani::cover!(!old.following && new.following, "the target is reached");
    kani::cover!(old.following && new.command.is_running(), "the error is too great");
    kani::cover!(new.response.is_running() && !old.response.is_running(), "a first response");
    kani::cover!(new.fails(Millis::new(500), Millis::new(1000)), "it does not follow");
    kani::cover!(new.command.is_running() && !new.far, "short, within the error allowed");
}

/// RSP-1e, RSP-1f, RSP-1i, RSP-1j: the wheel against its angle.
#[kani::proof]
fn rsp_1_wheel_follows() {
    let turn =
        Turn { old: kani::any(), target: kani::any(), measured: kani::any(), band: kani::any(), elapsed: kani::any() };
    let Turn { old, target, measured, band, elapsed } = turn;
    let new = old.advance(target, measured, band, elapsed);
    assert!(rsp_1_steered(turn, &new));
    assert!(rsp_1_steered_fails(&new, kani::any(), kani::any()));
    kani::cover!(new.over.is_running(), "an overshoot");
    kani::cover!(new.still.is_running(), "no response");
    kani::cover!(old.off.is_running() && new == SteeredAngle::INITIAL, "it is there");
}

/// RSP-1a to RSP-1m, VLC-2f, TRQ-7a, TRQ-7b, RULE-1d, EPB-1b: brakes, drive, gearbox and steering.
#[kani::proof]
#[kani::unwind(17)]
#[kani::stub(supervisor_core::kernel::share_down, crate::harness::uninterpreted::share_down)]
#[kani::stub(supervisor_core::kernel::within_percent, crate::harness::uninterpreted::within_percent)]
#[kani::stub(supervisor_core::Follow::advance, crate::harness::uninterpreted::follow)]
fn rsp_1_deviations_are_found_exactly() {
    let any = AnyWatch::new();
    let watch = any.watch();
    assert!(rsp_1_brake_is_compared(&watch));
    assert!(rsp_1_brake_escalates_exactly(&watch));
    assert!(rsp_1_abs_never_escalates(&watch));
    assert!(rsp_1_help_stays_while_unknown(&watch));
    assert!(rsp_1_overshoot(&watch));
    assert!(rsp_1_drive(&watch));
    assert!(trq_7_excess_is_found_exactly(&watch));
    assert!(rsp_1_gear(&watch));
    assert!(rsp_1_steering(&watch));
    let (old, new, response) = (&any.old, &any.new, &any.response);
    kani::cover!(response.brake == Deviation::Persistent && !any.inputs.ebs_red.is(true), "after the retarder");
    kani::cover!(
        new.short.reached(any.config.response_retarder) && response.brake == Deviation::Confirmed,
        "nearly there"
    );
    kani::cover!(!old.helps && new.helps && !new.short.is_running(), "the limits do not reach it");
    kani::cover!(any.inputs.abs.is(true) && old.helps && old.service.raw() > 2_048, "ABS begins to work");
    kani::cover!(response.faults.contains(Faults::BRAKE_OVERSHOOT), "an overshoot");
    kani::cover!(!old.disobeys && new.disobeys, "the drive gives too much");
    kani::cover!(response.torque == Deviation::Persistent, "and still does");
    kani::cover!(response.steering, "the steering does not follow");
    kani::cover!(response.faults.contains(Faults::GEAR_RESPONSE), "the gear does not follow");
}

/// SELF-10a to SELF-10c, RULE-1d, RSP-1c: what moves unasked, and what the next cycle compares with.
#[kani::proof]
#[kani::unwind(17)]
fn self_10_unasked_moves_are_found() {
    let any = AnyWatch::new();
    let watch = any.watch();
    assert!(self_10_unasked_is_a_bypass(&watch));
    assert!(self_10_bypass_counts_from_the_last(&watch));
    assert!(self_10_loose_parking_brake(&watch));
    assert!(self_10_positions_asked_for(&watch));
    assert!(rsp_1_nothing_else_is_reported(&watch));
    assert!(rsp_1_compared_with_what_went_out(&watch));
    kani::cover!(any.response.bypass && !any.response.faults.contains(Faults::BYPASS), "it is held");
    kani::cover!(any.old.bypass.is_running() && !any.response.bypass, "it is over");
    kani::cover!(any.response.faults.contains(Faults::CONTACTOR), "a contactor moves unasked");
    kani::cover!(any.new.loose && !any.old.loose, "the parking brake comes loose");
    kani::cover!(any.old.loose && !any.next.loose, "it is held again");
}

/// SELF-10a: a position that moves unasked is found, and no other.
#[kani::proof]
fn self_10_moves_alone() {
    let (old, position): (Moves<Gear>, Option<Gear>) = (kani::any(), kani::any());
    let (new, alone) = old.advance(position);
    let moved = matches!((old.seen, position), (Some(seen), Some(position)) if seen != position);
    assert!(alone == (moved && position != old.asked));
    assert!(new.seen == position.or(old.seen));
    assert!(new.asked == if position.is_some() && position == old.asked { None } else { old.asked });
    kani::cover!(alone, "it moved unasked");
    kani::cover!(moved && !alone, "it moved as asked");
}
