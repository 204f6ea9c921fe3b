//! Driver out of seat (S3 §2.1 to §2.5, spec section 5): warning, torque, brake, parking brake, gear.

use super::claims::{Claim, Outcome, demand};
use super::facts::Facts;
use super::read::*;
use crate::common::*;

/// The claims of this file.
pub const CLAIMS: &[Claim] = &[
    Claim { id: "SEAT-1a..h warning", judge: leave_warns, plant: |cycle| cycle.outputs.warnings.seat_leave = false },
    Claim {
        id: "SEAT-1a, SEAT-9a, SEAT-10a no warning without leave",
        judge: no_warning_without_leave,
        plant: |cycle| cycle.outputs.warnings.seat_leave = true,
    },
    Claim { id: "SEAT-2a", judge: leave_no_torque, plant: |cycle| cycle.outputs.drive.torque = percent(1) },
    Claim { id: "SEAT-3a..c", judge: leave_brakes, plant: |cycle| cycle.outputs.brake.total = ms2(120) },
    Claim { id: "SEAT-3d", judge: leave_holds, plant: |cycle| cycle.outputs.brake.total = DecelMs2Q11::new(2_764) },
    Claim { id: "SEAT-3e", judge: leave_speedless, plant: |cycle| cycle.outputs.brake.total = DecelMs2Q11::new(2_764) },
    Claim { id: "SEAT-3f", judge: leave_speedless_parks, plant: |cycle| cycle.outputs.epb.request = EpbRequest::None },
    Claim { id: "SEAT-4a, SEAT-4b", judge: leave_parks, plant: |cycle| cycle.outputs.epb = ParkingBrake::NEUTRAL },
    Claim { id: "SEAT-4c", judge: unconfirmed_is_told, plant: |cycle| cycle.outputs.warnings.fault_lamp = false },
    Claim { id: "SEAT-5a", judge: release_needs_driver, plant: release },
    Claim { id: "SEAT-5b, SEAT-5c, SEAT-5d", judge: release_after_leave, plant: release },
    Claim {
        id: "SELF-11d release",
        judge: legal_release_passes,
        plant: |cycle| cycle.outputs.epb.request = EpbRequest::None,
    },
    Claim {
        id: "SELF-11d none, apply",
        judge: epb_passes,
        plant: |cycle| {
            cycle.outputs.epb.request = match cycle.outputs.epb.request {
                EpbRequest::None => EpbRequest::Apply,
                EpbRequest::Apply | EpbRequest::Release => EpbRequest::None,
            };
        },
    },
    Claim { id: "SEAT-6a", judge: parked_neutral, plant: |cycle| cycle.outputs.gear = GearRequest::Hold },
    Claim { id: "SEAT-6b", judge: unattended_no_torque, plant: |cycle| cycle.outputs.drive.torque = percent(1) },
    Claim { id: "SEAT-6c", judge: unattended_no_gear, plant: |cycle| cycle.outputs.gear = GearRequest::Reverse },
    Claim { id: "SEAT-11d", judge: applied_again, plant: |cycle| cycle.outputs.epb.request = EpbRequest::None },
    Claim { id: "EPB-1a", judge: no_apply_at_speed, plant: |cycle| cycle.outputs.epb.request = EpbRequest::Apply },
    Claim { id: "EPB-1d", judge: switch_first, plant: |cycle| cycle.outputs.epb.request = EpbRequest::None },
];

fn release(cycle: &mut super::trace::Cycle) {
    cycle.outputs.epb.request = EpbRequest::Release;
}

/// SEAT-1b, c, d (S3 §2.1 "及时给车载仪表发出声光预警指令…自动激活双闪灯"): during leave the warning and the flashers.
pub fn leave_warns(facts: &Facts<'_>, at: usize) -> Outcome {
    let Warnings { seat_leave, hazard_flashers, .. } = facts.cycle(at).outputs.warnings;
    let premise = facts.leave.must.at(at) && !facts.safe.at(at);
    demand(premise, seat_leave && hazard_flashers, "leave runs: seat-leave warning and hazard flashers must be on")
}

/// SEAT-1a, e, f, SEAT-10a: no warning but the asked one while no leave can have begun (S3 §2.1 "连续保持 2 s 以上").
pub fn no_warning_without_leave(facts: &Facts<'_>, at: usize) -> Outcome {
    let cycle = facts.cycle(at);
    let silent = fresh(cycle.commands.warnings).is_some_and(|asked| !asked.seat_leave);
    let premise = silent && !facts.leave.may.at(at) && !facts.safe.at(at);
    demand(premise, !cycle.outputs.warnings.seat_leave, "no leave can run and nobody asks: no seat-leave warning")
}

/// SEAT-2a (S3 §2.2 "限制整车动力扭矩为 0"): torque 0.
pub fn leave_no_torque(facts: &Facts<'_>, at: usize) -> Outcome {
    let torque = facts.cycle(at).outputs.drive.torque;
    demand(facts.leave.must.at(at), torque == Percent::ZERO, "leave runs: drive torque must be 0")
}

/// SEAT-3a, b, c (S3 §2.3 table 1): at least a0 of the lower speed (RULE-6a).
pub fn leave_brakes(facts: &Facts<'_>, at: usize) -> Outcome {
    let total = facts.cycle(at).outputs.brake.total;
    match facts.speed(at) {
        Speed::Known(low, _) => demand(facts.leave.must.at(at), a0(low).met_by(total), "leave runs: a0(v) must go out"),
        Speed::Open | Speed::Unknown => Outcome::Idle,
    }
}

/// SEAT-3d: below 2 km/h 1.35 m/s² until the parking brake has been confirmed.
pub fn leave_holds(facts: &Facts<'_>, at: usize) -> Outcome {
    let total = facts.cycle(at).outputs.brake.total;
    let premise = facts.leave.must.at(at) && facts.speed(at).below(512) && !facts.leave_applied.at(at);
    demand(
        premise,
        Exact::HOLD.met_by(total),
        "leave, below 2 km/h, parking brake not confirmed: 1.35 m/s² must go out",
    )
}

/// SEAT-3e: unknown speed: the last demand of this leave, and 1.35 m/s².
pub fn leave_speedless(facts: &Facts<'_>, at: usize) -> Outcome {
    let premise = facts.leave.must.at(at) && facts.speed(at).unknown();
    if !premise {
        return Outcome::Idle;
    }
    let last = (0..at).rev().take_while(|at| facts.leave.must.at(*at)).find(|at| !facts.speed(*at).unknown());
    let last = last.map(|at| match facts.speed(at) {
        Speed::Known(low, _) => a0(low),
        Speed::Open | Speed::Unknown => Exact::HOLD,
    });
    let floor = last.map_or(Exact::HOLD, |last| last.or_more(Exact::HOLD));
    let total = facts.cycle(at).outputs.brake.total;
    demand(true, floor.met_by(total), "leave, speed unknown: the last demand and 1.35 m/s² must go out")
}

/// SEAT-3f: speed unknown for 20 s in leave: the parking brake is applied.
pub fn leave_speedless_parks(facts: &Facts<'_>, at: usize) -> Outcome {
    let cycle = facts.cycle(at);
    // At least 20 s, of which every cycle is in leave with unknown speed, whichever clock counts.
    let mut first = at;
    while first > 0 && facts.leave.must.at(first) && facts.speed(first).unknown() {
        first -= 1;
    }
    let long = first < at && facts.permission.between(first + 1, at) >= 20_000;
    let premise = long && !facts.leave_applied.at(at) && !facts.safe.at(at);
    demand(premise, cycle.outputs.epb.request == EpbRequest::Apply, "leave, speed unknown for 20 s: apply must go out")
}

/// SEAT-4a, b (S3 §2.4 "车速低于1.5 km/h时…发送驻车指令"), CMD-6a: applied below 1.5 km/h until confirmed, in automatic mode.
pub fn leave_parks(facts: &Facts<'_>, at: usize) -> Outcome {
    let premise = facts.leave.must.at(at) && facts.speed(at).below(384) && !facts.leave_applied.at(at);
    let applied = ParkingBrake { request: EpbRequest::Apply, mode: EpbMode::Automatic };
    demand(
        premise,
        facts.cycle(at).outputs.epb == applied,
        "leave, below 1.5 km/h: apply must go out, in automatic mode",
    )
}

/// SEAT-4c: apply demanded for more than 2 s and not confirmed: the driver is told.
pub fn unconfirmed_is_told(facts: &Facts<'_>, at: usize) -> Outcome {
    let mut first = at;
    let due = |at: usize| facts.leave.must.at(at) && facts.speed(at).below(384) && !facts.leave_applied.at(at);
    while first > 0 && due(first) {
        first -= 1;
    }
    let long = due(at) && facts.permission.between((first + 1).min(at), at) > 2_050;
    let lamp = facts.cycle(at).outputs.warnings.fault_lamp;
    demand(long && !facts.safe.at(at), lamp, "apply not confirmed for more than 2 s: the fault lamp must be on")
}

/// SEAT-5a (S3 §2.4 "直至车辆无离座…时解除电子驻车状态"): never a release without the confirmed driver.
pub fn release_needs_driver(facts: &Facts<'_>, at: usize) -> Outcome {
    let releases = facts.cycle(at).outputs.epb.request == EpbRequest::Release;
    demand(releases, facts.confirmed.at(at), "a release goes out, and the seat is not confirmed occupied")
}

/// The facts that SEAT-5a to SEAT-5c ask for, in a cycle.
fn ready(facts: &Facts<'_>, at: usize) -> bool {
    let Inputs { k1, k4, gear, .. } = facts.cycle(at).inputs;
    let engaged = gear.known().is_some_and(|gear| gear != Gear::Neutral);
    facts.confirmed.at(at) && k1 == CLOSED && k4 == CLOSED && engaged
}

/// SEAT-5b, c, d (S3 §2.4 "直至车辆无离座、非空挡且驾驶员重新踩驱动踏板"): a release after parked-by-leave: K1, K4 closed, gear
/// not N, and since they are so the accelerator was seen released and then pressed.
pub fn release_after_leave(facts: &Facts<'_>, at: usize) -> Outcome {
    let releases = facts.cycle(at).outputs.epb.request == EpbRequest::Release;
    if !(releases && facts.parked.must.at(at)) {
        return Outcome::Idle;
    }
    let pedal = |at: usize| tracks(facts.cycle(at).inputs.accelerator);
    let since = |at: usize| (0..=at).rev().take_while(|at| ready(facts, *at));
    let pressed = since(at).find(|at| pedal(*at).is_some_and(|(_, high)| high > 10));
    let anew = pressed.is_some_and(|at| since(at).any(|at| pedal(at).is_some_and(|(low, _)| low <= 10)));
    demand(true, anew, "parked by leave: released without K1, K4, gear and the accelerator pressed anew")
}

/// The request for the parking brake passes if nothing else says otherwise.
fn unhindered(facts: &Facts<'_>, at: usize) -> Option<ParkingBrake> {
    let cycle = facts.cycle(at);
    let calm = facts.calm.at(at) && facts.confirmed.at(at) && cycle.inputs.epb_switch.is(EpbSwitch::Idle);
    fresh(cycle.commands.epb).filter(|asked| calm && asked.mode == EpbMode::Automatic && facts.speed(at).below(384))
}

/// SELF-11d, SELF-2b, R-n: a release that is asked for and legal passes unchanged.
pub fn legal_release_passes(facts: &Facts<'_>, at: usize) -> Outcome {
    let cycle = facts.cycle(at);
    let asked = unhindered(facts, at).filter(|asked| asked.request == EpbRequest::Release);
    let pedal = |at: usize| tracks(facts.cycle(at).inputs.accelerator);
    let pressed = pedal(at).is_some_and(|(low, _)| low > 10);
    let anew = pressed
        && (0..=at).rev().take_while(|at| ready(facts, *at)).any(|at| pedal(at).is_some_and(|(_, high)| high <= 10));
    let premise = asked.is_some() && (!facts.parked.may.at(at) || anew);
    demand(premise, Some(cycle.outputs.epb) == asked, "a legal release is asked for and must pass")
}

/// SELF-11d: with the driver seated none, and apply below 1.5 km/h, pass unchanged.
pub fn epb_passes(facts: &Facts<'_>, at: usize) -> Outcome {
    let asked = unhindered(facts, at).filter(|asked| asked.request != EpbRequest::Release);
    let out = facts.cycle(at).outputs.epb;
    demand(
        asked.is_some(),
        Some(out) == asked,
        "driver seated, below 1.5 km/h: what is asked of the parking brake must pass",
    )
}

/// SEAT-6a (S3 §2.5 "将整车挡位自动退回空挡"), R-u: parked by leave, applied, nobody confirmed, at standstill: gear N.
pub fn parked_neutral(facts: &Facts<'_>, at: usize) -> Outcome {
    let cycle = facts.cycle(at);
    let stands = facts.speed(at).below(77) && cycle.inputs.epb.is(EpbState::Applied);
    let premise = facts.parked.must.at(at) && stands && !facts.confirmed.at(at) && !facts.safe.at(at);
    demand(premise, cycle.outputs.gear == GearRequest::Neutral, "parked by leave, nobody confirmed: gear N must go out")
}

/// Nobody confirmed, and below 1.5 km/h or the parking brake applied.
fn unattended(facts: &Facts<'_>, at: usize) -> bool {
    let applied = facts.cycle(at).inputs.epb.is(EpbState::Applied);
    !facts.confirmed.at(at) && (applied || facts.speed(at).below(384))
}

/// SEAT-6b: torque 0.
pub fn unattended_no_torque(facts: &Facts<'_>, at: usize) -> Outcome {
    let torque = facts.cycle(at).outputs.drive.torque;
    demand(unattended(facts, at), torque == Percent::ZERO, "nobody confirmed, slow or parked: drive torque must be 0")
}

/// SEAT-6c (S3 §2.5 "直至车辆无离座时才允许驾驶员挂挡"): no gear but N is newly engaged.
pub fn unattended_no_gear(facts: &Facts<'_>, at: usize) -> Outcome {
    let cycle = facts.cycle(at);
    let keeps = match cycle.outputs.gear {
        GearRequest::Hold | GearRequest::Neutral => true,
        GearRequest::Drive => cycle.inputs.gear.is(Gear::Drive),
        GearRequest::Reverse => cycle.inputs.gear.is(Gear::Reverse),
        GearRequest::Park => cycle.inputs.gear.is(Gear::Park),
    };
    demand(unattended(facts, at), keeps, "nobody confirmed, slow or parked: no gear but N may be newly engaged")
}

/// SEAT-11d: parked by leave, released past us, nobody confirmed: applied again.
pub fn applied_again(facts: &Facts<'_>, at: usize) -> Outcome {
    let cycle = facts.cycle(at);
    let lost = cycle.inputs.epb.is(EpbState::Released) && facts.speed(at).below(384);
    let premise = facts.parked.must.at(at) && lost && !facts.confirmed.at(at);
    demand(
        premise,
        cycle.outputs.epb.request == EpbRequest::Apply,
        "parked by leave and found released: apply must go out",
    )
}

/// EPB-1a, R-z: above 1.5 km/h nothing but the driver's switch applies the parking brake, while no leave, no level 3 and no
/// bypass of a parking brake with nobody confirmed can be.
pub fn no_apply_at_speed(facts: &Facts<'_>, at: usize) -> Outcome {
    let cycle = facts.cycle(at);
    let fast = facts.speed(at).at_least(385) && !cycle.inputs.epb_switch.is(EpbSwitch::Apply);
    let premise = fast && facts.confirmed.at(at) && !facts.leave.may.at(at) && !facts.latches[2].may.at(at);
    demand(
        premise,
        cycle.outputs.epb.request != EpbRequest::Apply,
        "above 1.5 km/h, no reason to apply the parking brake",
    )
}

/// EPB-1d (S4 §6.2.11 "驾驶员操作 EPB 功能开关时,EPB应优先响应驾驶员指令"): the driver's apply goes before every request.
pub fn switch_first(facts: &Facts<'_>, at: usize) -> Outcome {
    let cycle = facts.cycle(at);
    let premise = cycle.inputs.epb_switch.is(EpbSwitch::Apply) && !facts.safe.at(at);
    demand(premise, cycle.outputs.epb.request == EpbRequest::Apply, "the driver's switch says apply: apply must go out")
}
