//! Drive torque, the mode, and the parts of the brake (S2, spec section 4: TRQ, VLC, RET, SPD; MODE, RSP-1n).

use super::claims::{Claim, Outcome, demand};
use super::facts::Facts;
use super::read::*;
use super::trace::Cycle;
use crate::common::*;

/// The claims of this file.
pub const CLAIMS: &[Claim] = &[
    Claim { id: "TRQ-1a, TRQ-1b", judge: pedal_map, plant: full_torque },
    Claim { id: "TRQ-1c", judge: both_pedals, plant: full_torque },
    Claim { id: "TRQ-2a, TRQ-2e, VLC-1d", judge: automated_flag, plant: automated_torque },
    Claim { id: "TRQ-2b, TRQ-3c, MODE-1e", judge: automated_evidence, plant: automated_torque },
    Claim { id: "TRQ-2c", judge: automated_sees, plant: automated_torque },
    Claim { id: "TRQ-2d, TRQ-3a", judge: automated_yields, plant: automated_torque },
    Claim { id: "TRQ-5a", judge: drive_limit, plant: full_torque },
    Claim { id: "TRQ-5b, TRQ-5d", judge: gradient, plant: full_torque },
    Claim { id: "TRQ-5e", judge: released_after_leave, plant: full_torque },
    Claim { id: "TRQ-6a, TRQ-6b", judge: hill_hold, plant: full_torque },
    Claim { id: "TRQ-6c", judge: gear_direction, plant: full_torque },
    Claim { id: "RSP-1n", judge: no_rise_while_slipping, plant: full_torque },
    Claim {
        id: "SELF-11a, TRQ-5c, TRQ-5g",
        judge: torque_passes,
        plant: |cycle| cycle.outputs.drive = DriveTorque::NEUTRAL,
    },
    Claim {
        id: "VLC-2b, VLC-2c, VLC-2d",
        judge: electric_part,
        plant: |cycle| {
            (cycle.outputs.brake.total, cycle.outputs.brake.electric) = (ms2(400), ms2(400));
        },
    },
    Claim { id: "VLC-3a", judge: implausible_split, plant: |cycle| cycle.outputs.brake.electric = DecelMs2Q11::new(1) },
    Claim { id: "RET-1b", judge: retarder_off, plant: |cycle| cycle.outputs.retarder.torque = percent(1) },
    Claim { id: "SPD-1a", judge: target_speed, plant: |cycle| cycle.outputs.target_speed = kmh(61) },
    Claim {
        id: "MODE-1a, MODE-1b, MODE-1c",
        judge: mode_evidence,
        plant: |cycle| cycle.outputs.mode = DrivingMode::Automated,
    },
];

fn full_torque(cycle: &mut Cycle) {
    cycle.outputs.drive = driver_torque(100);
}
fn automated_torque(cycle: &mut Cycle) {
    cycle.outputs.drive = DriveTorque { torque: percent(61), active: false, origin: Origin::Adas };
}

/// The torque that goes out, if its origin is the driver.
fn of_driver(cycle: &Cycle) -> Option<i64> {
    let DriveTorque { torque, origin, .. } = cycle.outputs.drive;
    (origin == Origin::Driver && torque > Percent::ZERO).then(|| i64::from(torque.raw()))
}
/// The torque that goes out, if its origin is not the driver.
fn of_automation(cycle: &Cycle) -> Option<DriveTorque> {
    let out = cycle.outputs.drive;
    Some(out).filter(|out| out.origin != Origin::Driver && out.torque > Percent::ZERO)
}

/// TRQ-1a, b: at most the pedal map (here per cent for per cent) and 5 %, of the lower track; nothing if it is unknown.
pub fn pedal_map(facts: &Facts<'_>, at: usize) -> Outcome {
    let cycle = facts.cycle(at);
    let Some(torque) = of_driver(cycle) else { return Outcome::Idle };
    let allowed = tracks(cycle.inputs.accelerator).is_some_and(|(low, _)| torque * 10 <= low * 4 + 50);
    demand(true, allowed, "more driver torque than the accelerator allows")
}

/// TRQ-1c: both pedals known pressed: no driver torque.
pub fn both_pedals(facts: &Facts<'_>, at: usize) -> Outcome {
    let cycle = facts.cycle(at);
    let accelerates = tracks(cycle.inputs.accelerator).is_some_and(|(low, _)| low > 10);
    let premise = accelerates && pedal_pressed(&cycle.inputs);
    demand(premise, of_driver(cycle).is_none(), "both pedals are pressed: driver torque must be 0")
}

/// TRQ-2a (S2 §1 1 `ADAS_TorqueActive=Active`), TRQ-2e, VLC-1d: active, of the configured mode, at most 60 %.
pub fn automated_flag(facts: &Facts<'_>, at: usize) -> Outcome {
    let Some(out) = of_automation(facts.cycle(at)) else { return Outcome::Idle };
    let legal = out.active && out.origin == Origin::Adas && out.torque.raw() <= 60;
    demand(true, legal, "automated torque that is not active, not configured, or too much")
}

/// TRQ-2b, TRQ-3c (S2 §1 4), §2 1)): granted by cruise switch and set, and not ended since.
pub fn automated_evidence(facts: &Facts<'_>, at: usize) -> Outcome {
    let premise = of_automation(facts.cycle(at)).is_some();
    demand(premise, facts.granted.at(at), "automated torque without the driver's evidence, or after the mode has ended")
}

/// TRQ-2c: only with perception known.
pub fn automated_sees(facts: &Facts<'_>, at: usize) -> Outcome {
    let cycle = facts.cycle(at);
    demand(of_automation(cycle).is_some(), cycle.sensors_known(), "automated torque without perception")
}

/// TRQ-2d, TRQ-3a (S2 §2 1) "其扭矩发送有效位…也将变为未激活"): none in an obligation, none with the brake pedal pressed or unknown.
pub fn automated_yields(facts: &Facts<'_>, at: usize) -> Outcome {
    let cycle = facts.cycle(at);
    let obliged = facts.leave.must.at(at) || facts.mitigates(at);
    let premise = obliged || pedal_not_clear(&cycle.inputs);
    demand(premise, of_automation(cycle).is_none(), "automated torque against an obligation or the brake pedal")
}

/// TRQ-5a: at most the electric limit, nothing if it is unknown.
pub fn drive_limit(facts: &Facts<'_>, at: usize) -> Outcome {
    let cycle = facts.cycle(at);
    let torque = cycle.outputs.drive.torque;
    let allowed = cycle.inputs.drive_limit.known().is_some_and(|limit| torque <= limit);
    demand(torque > Percent::ZERO, allowed, "more torque than the electric limit, or the limit is unknown")
}

/// TRQ-5b, d: no rise over any span of the last 100 cycles beyond 200 % per second (less than one per cent of rounding).
pub fn gradient(facts: &Facts<'_>, at: usize) -> Outcome {
    let torque = |at: usize| i64::from(facts.cycle(at).outputs.drive.torque.raw());
    let kept = (at.saturating_sub(100)..at)
        .all(|from| (torque(at) - torque(from)) * 1000 <= 200 * facts.permission.between(from, at) + 999);
    demand(at > 0 && torque(at) > torque(at - 1), kept, "torque rises faster than 200 % per second")
}

/// TRQ-5e: after leave none until the accelerator has been seen released.
pub fn released_after_leave(facts: &Facts<'_>, at: usize) -> Outcome {
    let torque = facts.cycle(at).outputs.drive.torque;
    let since = (0..=at).rev().take_while(|at| !facts.leave.must.at(*at));
    let mut seen = since.map(|at| tracks(facts.cycle(at).inputs.accelerator).is_some_and(|(low, _)| low <= 10));
    let left = torque > Percent::ZERO && (0..at).any(|at| facts.leave.must.at(at));
    demand(left, !left || seen.any(|seen| seen), "torque after leave, and the accelerator was not seen released")
}

/// TRQ-6a, b: torque against a brake only of the driver, below 2 km/h, seat confirmed, for at most 1 s.
pub fn hill_hold(facts: &Facts<'_>, at: usize) -> Outcome {
    let against = |at: usize| {
        let outputs = &facts.cycle(at).outputs;
        outputs.drive.torque > Percent::ZERO && braking_out(outputs) > 0
    };
    if !against(at) {
        return Outcome::Idle;
    }
    let first = (0..=at).rev().take_while(|at| against(*at)).last().unwrap_or(at);
    let short = facts.permission.between(first, at) <= 1_000;
    let slow = facts.speed(at).below(512);
    let kept = short && slow && facts.confirmed.at(at) && facts.cycle(at).outputs.drive.origin == Origin::Driver;
    demand(true, kept, "torque against a brake demand that is no hill-hold")
}

/// TRQ-6c: only with D or R confirmed.
pub fn gear_direction(facts: &Facts<'_>, at: usize) -> Outcome {
    let cycle = facts.cycle(at);
    let engaged = cycle.inputs.gear.is(Gear::Drive) || cycle.inputs.gear.is(Gear::Reverse);
    demand(cycle.outputs.drive.torque > Percent::ZERO, engaged, "torque without a confirmed gear that has a direction")
}

/// RSP-1n: drive slip control at work: torque does not rise.
pub fn no_rise_while_slipping(facts: &Facts<'_>, at: usize) -> Outcome {
    let cycle = facts.cycle(at);
    let kept = cycle.outputs.drive.torque <= facts.before(at).drive.torque;
    demand(cycle.inputs.asr.is(true), kept, "drive slip control works, and torque rises")
}

/// SELF-11a, TRQ-5c, g: driver seated, nothing obliges: a driver torque up to the pedal map, and rising no faster than it may,
/// passes unchanged.
pub fn torque_passes(facts: &Facts<'_>, at: usize) -> Outcome {
    let cycle = facts.cycle(at);
    let inputs = &cycle.inputs;
    let asked = fresh(cycle.commands.drive).filter(|asked| asked.origin == Origin::Driver);
    let Some(asked) = asked else { return Outcome::Idle };
    let torque = i64::from(asked.torque.raw());
    let pedal = tracks(inputs.accelerator).is_some_and(|(low, _)| torque * 10 <= low * 4);
    let limit = inputs.drive_limit.known().is_some_and(|limit| asked.torque <= limit && limit <= Percent::FULL);
    let slip = fresh(cycle.commands.brake).is_some()
        && inputs.asr.is(false)
        && inputs.stability.is(false)
        && inputs.abs.is(false);
    let before = i64::from(facts.before(at).drive.torque.raw());
    let rise = torque <= before || (torque - before) * 1000 <= 200 * facts.permission.step(at);
    let gear =
        fresh(cycle.commands.gear).is_some_and(|asked| asked == GearRequest::Hold) && inputs.gear.is(Gear::Drive);
    let seated = facts.calm.at(at) && facts.still.at(at) && facts.confirmed.at(at) && facts.speed(at).known();
    let unbraked = braking_out(&cycle.outputs) == 0 && braking_out(&facts.before(at)) == 0;
    let free = pedal_clear(inputs) && unbraked && gear && inputs.selector.is(Gear::Drive);
    let left = (0..=at).any(|at| facts.leave.may.at(at));
    // Granted automation has its own override rules (TRQ-4).
    let manual = !(0..=at).rev().take(2).any(|at| facts.granted.at(at));
    let premise = pedal && limit && slip && rise && seated && free && manual && !left;
    demand(premise, cycle.outputs.drive == asked, "driver torque inside every bound must pass")
}

/// VLC-2b, c, d (S2 §1 "优先分配电制动"): the electric part is in the total, below its limit, and 0 without it or with slip control.
pub fn electric_part(facts: &Facts<'_>, at: usize) -> Outcome {
    let cycle = facts.cycle(at);
    let ServiceBrake { total, electric, .. } = cycle.outputs.brake;
    let Inputs { electric_limit, abs, asr, stability, .. } = cycle.inputs;
    let quiet = abs.is(false) && asr.is(false) && stability.is(false);
    let limited = electric_limit.known().is_some_and(|limit| electric <= limit) && electric <= total;
    demand(
        electric > DecelMs2Q11::ZERO,
        quiet && limited,
        "an electric part beyond its limit, or with slip control at work",
    )
}

/// VLC-3a: a value by which the brake splits is known and not plausible: no electric brake.
pub fn implausible_split(facts: &Facts<'_>, at: usize) -> Outcome {
    let cycle = facts.cycle(at);
    let mass = cycle.inputs.mass.known().is_some_and(|mass| !(600..=2_000).contains(&mass.raw()));
    let pressure = cycle.inputs.axle_pressure.iter().any(|axle| axle.known().is_some_and(|axle| axle.raw() > 220));
    let none = cycle.outputs.brake.electric == DecelMs2Q11::ZERO;
    demand(mass || pressure, none, "mass or pressure not plausible: no electric brake")
}

/// RET-1b (S4 §6.2.6 to 6.2.8): no retarder while ABS works.
pub fn retarder_off(facts: &Facts<'_>, at: usize) -> Outcome {
    let cycle = facts.cycle(at);
    demand(
        cycle.inputs.abs.is(true),
        cycle.outputs.retarder.torque == Percent::ZERO,
        "ABS works: the retarder must be off",
    )
}

/// SPD-1a: at most 60 km/h.
pub fn target_speed(facts: &Facts<'_>, at: usize) -> Outcome {
    let target = facts.cycle(at).outputs.target_speed;
    demand(target > SpeedKmhQ8::ZERO, target <= kmh(60), "a target speed above the limit")
}

/// MODE-1a, b, c: automated only by driver evidence that has not ended, with ADS state and brake pedal known.
pub fn mode_evidence(facts: &Facts<'_>, at: usize) -> Outcome {
    let cycle = facts.cycle(at);
    let ads = cycle.inputs.ads.known().is_some_and(|state| state != AdsState::Failed);
    let kept = facts.granted.at(at) && ads && cycle.sensors_known();
    demand(cycle.outputs.mode == DrivingMode::Automated, kept, "the automated mode without its evidence")
}
