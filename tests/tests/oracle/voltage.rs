//! High voltage after leave and otherwise (S3 §2.6, spec SEAT-7, SEAT-8, SEAT-11, HV-1).

use super::claims::{Claim, Outcome, demand};
use super::facts::Facts;
use super::read::*;
use crate::common::*;

/// The claims of this file.
pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "SEAT-7a, SEAT-11",
        judge: shutdown_is_due,
        plant: |cycle| cycle.outputs.contactors.k4 = ContactorRequest::Hold,
    },
    Claim {
        id: "SEAT-7b, SEAT-7d, HV-1a, HV-1c",
        judge: k4_opens_guarded,
        plant: |cycle| cycle.outputs.contactors.k4 = ContactorRequest::Open,
    },
    Claim {
        id: "SEAT-7a, SEAT-11 K4 needs a reason",
        judge: k4_opens_with_reason,
        plant: |cycle| cycle.outputs.contactors.k4 = ContactorRequest::Open,
    },
    Claim {
        id: "SEAT-7f, HV-1b",
        judge: k4_first,
        plant: |cycle| cycle.outputs.contactors.k1 = ContactorRequest::Open,
    },
    Claim {
        id: "SEAT-7g",
        judge: k1_without_load,
        plant: |cycle| cycle.outputs.contactors.k1 = ContactorRequest::Open,
    },
    Claim {
        id: "SEAT-7e K1 needs a reason, HV-1c",
        judge: k1_opens_with_reason,
        plant: |cycle| cycle.outputs.contactors.k1 = ContactorRequest::Open,
    },
    Claim {
        id: "SEAT-7i, SEAT-7k",
        judge: shutdown_goes_on,
        plant: |cycle| cycle.outputs.contactors.k4 = ContactorRequest::Hold,
    },
    Claim {
        id: "SEAT-7e, SEAT-7j, SEAT-7k",
        judge: k1_is_owed,
        plant: |cycle| cycle.outputs.contactors.k1 = ContactorRequest::Hold,
    },
    Claim { id: "SEAT-8a, SEAT-8b", judge: restart_in_order, plant: close },
    Claim {
        id: "SEAT-8c",
        judge: k1_closes_first,
        plant: |cycle| cycle.outputs.contactors.k4 = ContactorRequest::Close,
    },
    Claim { id: "HV-1d, SEAT-9c", judge: closes_on_request, plant: close },
];

fn close(cycle: &mut super::trace::Cycle) {
    cycle.outputs.contactors.k1 = ContactorRequest::Close;
}

/// Standstill by the higher speed, executed torque known to be none.
fn guarded(facts: &Facts<'_>, at: usize) -> bool {
    facts.speed(at).below(77) && executed_at_most(&facts.cycle(at).inputs, 1)
}

fn opens_k4(outputs: &Outputs) -> bool {
    outputs.contactors.k4 == ContactorRequest::Open
}
fn opens_k1(outputs: &Outputs) -> bool {
    outputs.contactors.k1 == ContactorRequest::Open
}

/// SEAT-7a, SEAT-11 (S3 §2.6 "驻车保持10 min以上,且检测到车辆未断高压电时…K4断开指令"): K4 opens when its guards are met.
pub fn shutdown_is_due(facts: &Facts<'_>, at: usize) -> Outcome {
    let cycle = facts.cycle(at);
    let Inputs { seat, epb, k4, k1, .. } = cycle.inputs;
    let vacant = seat == [known(Seat::Vacant); 2];
    let on = k4 == CLOSED && k1 == CLOSED;
    let due = facts.parked.must.at(at) && facts.waited[0][at] >= 600_000 && vacant && on && epb.is(EpbState::Applied);
    let idle = executed_at_most(&cycle.inputs, 0) && facts.before(at).drive.torque == Percent::ZERO;
    let premise = due && guarded(facts, at) && idle && !facts.safe.at(at) && !facts.fault.at(at);
    demand(premise, opens_k4(&cycle.outputs), "10 min are over and the guards are met: K4 must open")
}

/// SEAT-7b, d, HV-1a, c: K4 newly opens only at standstill and without drive torque.
pub fn k4_opens_guarded(facts: &Facts<'_>, at: usize) -> Outcome {
    let cycle = facts.cycle(at);
    let newly = opens_k4(&cycle.outputs) && !opens_k4(&facts.before(at));
    let idle = cycle.outputs.drive.torque == Percent::ZERO;
    demand(newly, guarded(facts, at) && idle, "K4 opens, and standstill or torque 0 is not known")
}

/// SEAT-7a, c, SEAT-11: K4 newly opens only when asked to, or after the 10 min with the parking brake applied.
pub fn k4_opens_with_reason(facts: &Facts<'_>, at: usize) -> Outcome {
    let cycle = facts.cycle(at);
    let newly = opens_k4(&cycle.outputs) && !opens_k4(&facts.before(at));
    let asked = usable(cycle.commands.contactors, 500).is_some_and(|asked| asked.k4 == ContactorRequest::Open);
    let due = facts.waited[1][at] >= 600_000 && cycle.inputs.epb.is(EpbState::Applied);
    let begun = at > 0 && facts.committed.may.at(at - 1);
    demand(newly, asked || due || begun, "K4 opens, nobody asks, and the 10 min are not over")
}

/// SEAT-7f, HV-1b (S3 §2.6 "先给MCU…K4断开指令…再给BMS…K1断开指令"): K1 opens only with K4 confirmed open.
pub fn k4_first(facts: &Facts<'_>, at: usize) -> Outcome {
    let cycle = facts.cycle(at);
    demand(opens_k1(&cycle.outputs), cycle.inputs.k4 == OPEN, "K1 is commanded open, and K4 is not confirmed open")
}

/// SEAT-7g (S3 §2.6 "当电机驱动系统与辅源系统停止工作后"): K1 opens only with the loads confirmed stopped.
pub fn k1_without_load(facts: &Facts<'_>, at: usize) -> Outcome {
    let cycle = facts.cycle(at);
    demand(
        opens_k1(&cycle.outputs),
        loads_stopped(&cycle.inputs),
        "K1 is commanded open, and the loads have not stopped",
    )
}

/// HV-1c, SEAT-7e: K1 newly opens only at standstill, and only when asked to or in the shutdown.
pub fn k1_opens_with_reason(facts: &Facts<'_>, at: usize) -> Outcome {
    let cycle = facts.cycle(at);
    let newly = opens_k1(&cycle.outputs) && !opens_k1(&facts.before(at));
    let asked = usable(cycle.commands.contactors, 500).is_some_and(|asked| asked.k1 == ContactorRequest::Open);
    let reason = asked || facts.committed.may.at(at);
    demand(newly, reason && facts.speed(at).below(77), "K1 opens without a reason, or not at standstill")
}

/// Committed, and K1 not yet confirmed open: the cycle in which it began.
fn running(facts: &Facts<'_>, at: usize) -> bool {
    let begun = (0..=at).rev().take_while(|at| facts.committed.must.at(*at));
    let mut ended = begun.map(|at| {
        let Contactors { k4, k1 } = facts.cycle(at).outputs.contactors;
        facts.cycle(at).inputs.k1 != CLOSED || k4 == ContactorRequest::Close || k1 == ContactorRequest::Close
    });
    facts.committed.must.at(at) && !ended.any(|ended| ended)
}

/// SEAT-7i, k, RULE-4b: once committed K4 stays commanded open until K1 may be open, also with the driver back and after a
/// missed deadline, in every cycle in which its guards are met (SEAT-7b, c, d).
pub fn shutdown_goes_on(facts: &Facts<'_>, at: usize) -> Outcome {
    let met = guarded(facts, at) && facts.cycle(at).inputs.epb.is(EpbState::Applied);
    let premise = running(facts, at) && met && !facts.safe.at(at);
    demand(premise, opens_k4(&facts.cycle(at).outputs), "the shutdown is committed: K4 must stay commanded open")
}

/// SEAT-7e, j, k: committed, K4 confirmed open, loads stopped, standstill: K1 opens, however late.
pub fn k1_is_owed(facts: &Facts<'_>, at: usize) -> Outcome {
    let cycle = facts.cycle(at);
    let met = cycle.inputs.k4 == OPEN && loads_stopped(&cycle.inputs) && guarded(facts, at);
    // The sequence takes its steps one after the other: committed, and K4 confirmed open, for a cycle.
    let step = at > 0 && facts.committed.must.at(at - 1) && facts.cycle(at - 1).inputs.k4 == OPEN;
    let premise = step && running(facts, at) && met && !facts.safe.at(at) && !facts.fault.at(at);
    demand(premise, opens_k1(&cycle.outputs), "the shutdown is committed and the guards of K1 are met: K1 must open")
}

fn closes(outputs: &Outputs) -> bool {
    let Contactors { k4, k1 } = outputs.contactors;
    k4 == ContactorRequest::Close || k1 == ContactorRequest::Close
}

/// SEAT-8a, b (S3 §2.6 "直至车辆无离座且驾驶员重新关闭再开启钥匙Start挡"): since the shutdown, in this order: confirmed, key Off,
/// key Start after another position, and no sensor pair known vacant between (R-k); confirmed when closing begins.
pub fn restart_in_order(facts: &Facts<'_>, at: usize) -> Outcome {
    let cycle = facts.cycle(at);
    let newly = closes(&cycle.outputs) && !closes(&facts.before(at));
    if !(newly && facts.committed.must.at(at)) {
        return Outcome::Idle;
    }
    let key = |at: usize| facts.cycle(at).inputs.key;
    let vacant = |at: usize| facts.cycle(at).inputs.seat == [known(Seat::Vacant); 2];
    let attended = |at: usize| facts.committed.must.at(at) && !vacant(at);
    let past = |at: usize| (0..=at).rev().take_while(|at| attended(*at));
    let start = past(at).find(|at| key(*at).is(Key::Start) && *at > 0 && !key(*at - 1).is(Key::Start));
    let off = start.and_then(|start| past(start).find(|at| key(*at).is(Key::Off)));
    let seated = off.is_some_and(|off| past(off).any(|at| facts.confirmed.at(at)));
    demand(
        true,
        seated && facts.confirmed.at(at),
        "closing after a shutdown without seat, key Off, key Start in this order",
    )
}

/// SEAT-8c: K4 is commanded closed only with K1 confirmed closed.
pub fn k1_closes_first(facts: &Facts<'_>, at: usize) -> Outcome {
    let cycle = facts.cycle(at);
    let closes = cycle.outputs.contactors.k4 == ContactorRequest::Close;
    demand(closes, cycle.inputs.k1 == CLOSED, "K4 is commanded closed, and K1 is not confirmed closed")
}

/// HV-1d, SEAT-9c: nothing closes that nobody asks to close.
pub fn closes_on_request(facts: &Facts<'_>, at: usize) -> Outcome {
    let cycle = facts.cycle(at);
    let asked = usable(cycle.commands.contactors, 500).unwrap_or(Contactors::NEUTRAL);
    let Contactors { k4, k1 } = cycle.outputs.contactors;
    let of = |out: ContactorRequest, asked: ContactorRequest| out != ContactorRequest::Close || asked == out;
    demand(closes(&cycle.outputs), of(k4, asked.k4) && of(k1, asked.k1), "a contactor closes, and nobody asks for it")
}
