//! Collision mitigation and phantom braking (S1 §3.1.2, spec section 3: MIT, PHB, RXN; SELF-2b for the brake).

use super::claims::{Claim, Outcome, demand};
use super::facts::Facts;
use super::read::*;
use crate::common::*;

/// The claims of this file.
pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "MIT-1, MIT-4, RXN-1a level 1",
        judge: |facts, at| level_brakes(facts, at, 0),
        plant: |cycle| brake_less(cycle, 2_047),
    },
    Claim {
        id: "MIT-2, MIT-4, RXN-1a level 2",
        judge: |facts, at| level_brakes(facts, at, 1),
        plant: |cycle| brake_less(cycle, 5_119),
    },
    Claim {
        id: "MIT-3, MIT-4g, RXN-1a level 3",
        judge: |facts, at| level_brakes(facts, at, 2),
        plant: |cycle| brake_less(cycle, 10_239),
    },
    Claim { id: "MIT-5a", judge: level_no_torque, plant: |cycle| cycle.outputs.drive.torque = percent(1) },
    Claim { id: "CMD-6a", judge: obligation_has_mode, plant: |cycle| cycle.outputs.brake.mode = BrakeMode::Addition },
    Claim {
        id: "SELF-2b, MIT-6, RULE-1b brake",
        judge: brake_passes,
        plant: |cycle| {
            cycle.outputs.brake.total = DecelMs2Q11::new(cycle.outputs.brake.total.raw().wrapping_add(1));
        },
    },
    Claim { id: "PHB-1a", judge: comfort_cap, plant: |cycle| cycle.outputs.brake.total = DecelMs2Q11::new(7_169) },
    Claim {
        id: "PHB-1b cap",
        judge: greatest_cap,
        plant: |cycle| cycle.outputs.brake.total = DecelMs2Q11::new(12_289),
    },
    Claim { id: "PHB-1b, MIT-6d, FUS-3d permission", judge: emergency_passes, plant: |cycle| brake_less(cycle, 7_168) },
];

fn brake_less(cycle: &mut super::trace::Cycle, most: u16) {
    cycle.outputs.brake.total = DecelMs2Q11::new(most);
}

/// MIT-1b, 2b, 3b, MIT-4b (S1 §3.1.2 3) to 5), "加速度为-1 / -2.5 / -5 m/s²"): while the level runs, in the cycle in which it
/// begins too (RXN-1a).
fn level_brakes(facts: &Facts<'_>, at: usize, level: usize) -> Outcome {
    let (_, _, _, least) = LEVEL[level];
    let total = i64::from(facts.cycle(at).outputs.brake.total.raw());
    demand(facts.latches[level].must.at(at), total >= least, "the level runs: its deceleration must go out")
}

/// MIT-5a, TRQ-4h, R-f (S1 "此时油门不再起作用"): while a level runs the drive torque is 0.
pub fn level_no_torque(facts: &Facts<'_>, at: usize) -> Outcome {
    let torque = facts.cycle(at).outputs.drive.torque;
    demand(facts.mitigates(at), torque == Percent::ZERO, "a level runs: drive torque must be 0")
}

/// CMD-6a, b: an obligation has the mode with the driver's demand as the floor.
pub fn obligation_has_mode(facts: &Facts<'_>, at: usize) -> Outcome {
    let ServiceBrake { total, mode, .. } = facts.cycle(at).outputs.brake;
    let fast = facts.leave.must.at(at) && facts.speed(at).at_least(512);
    let premise = (facts.mitigates(at) || fast) && total > DecelMs2Q11::ZERO;
    demand(premise, mode == BrakeMode::Maximum, "an obligation brakes: the driver's demand must be the floor")
}

/// Nobody overrides, no pedal is pressed, nothing obliges: what is asked of the brake, fresh and in its mode.
fn asked(facts: &Facts<'_>, at: usize) -> Option<ServiceBrake> {
    let cycle = facts.cycle(at);
    let released = tracks(cycle.inputs.accelerator) == Some((0, 0)) && pedal_clear(&cycle.inputs);
    let no_retarder = fresh(cycle.commands.retarder).is_some_and(|asked| asked.torque == Percent::ZERO);
    // A parking brake that was released past us with nobody confirmed is answered by a hold (R-z).
    let attended = facts.confirmed.at(at) && facts.still.at(at);
    let calm = facts.calm.at(at) && attended && released && no_retarder;
    let calm = calm && cycle.outputs.retarder.torque == Percent::ZERO;
    fresh(cycle.commands.brake)
        .filter(|asked| calm && asked.mode == BrakeMode::Maximum && asked.electric <= asked.total)
}

/// The electric part may be as it is asked for (VLC-2, VLC-3).
fn electric_may(inputs: &Inputs, electric: DecelMs2Q11) -> bool {
    let quiet = inputs.abs.is(false) && inputs.asr.is(false) && inputs.stability.is(false);
    let mass = inputs.mass.known().is_some_and(|mass| (600..=2_000).contains(&mass.raw()));
    let pressure = inputs.axle_pressure.iter().all(|axle| axle.known().is_some_and(|axle| axle.raw() <= 220));
    let limit = inputs.electric_limit.known();
    let actual = inputs.electric_actual.known();
    let plausible = limit
        .is_some_and(|limit| actual.is_some_and(|actual| i64::from(actual.raw()) <= i64::from(limit.raw()) + 1_024));
    electric == DecelMs2Q11::ZERO
        || (quiet && mass && pressure && plausible && limit.is_some_and(|limit| electric <= limit))
}

/// SELF-2b, SELF-11b, MIT-6b, c, RULE-1b: without any obligation a deceleration up to 3.5 m/s² passes unchanged: no less, and
/// no braking that nothing asks for.
pub fn brake_passes(facts: &Facts<'_>, at: usize) -> Outcome {
    let cycle = facts.cycle(at);
    let asked =
        asked(facts, at).filter(|asked| asked.total.raw() <= 7_168 && electric_may(&cycle.inputs, asked.electric));
    demand(
        asked.is_some(),
        Some(cycle.outputs.brake) == asked,
        "no obligation, inside the cap: the brake request must pass",
    )
}

/// PHB-1a, PHB-1b, R-ag: brake and retarder together at most 3.5 m/s² without an emergency, if the driver does not brake and the
/// bus is not known to stand; levels 1 and 2 demand less.
pub fn comfort_cap(facts: &Facts<'_>, at: usize) -> Outcome {
    let cycle = facts.cycle(at);
    let premise = facts.clear.at(at) && pedal_clear(&cycle.inputs) && !facts.safe.at(at) && !facts.speed(at).below(77);
    demand(premise, braking_out(&cycle.outputs) <= 7_168, "the road is known clear: at most 3.5 m/s²")
}

/// PHB-1b, R-j: never more than 6 m/s², if the driver does not brake.
pub fn greatest_cap(facts: &Facts<'_>, at: usize) -> Outcome {
    let cycle = facts.cycle(at);
    demand(pedal_clear(&cycle.inputs), braking_out(&cycle.outputs) <= 12_288, "never more than 6 m/s²")
}

/// PHB-1b, MIT-6d, FUS-3d, RULE-3a: an emergency of any single object, or unknown perception, permits what is asked up to 6 m/s².
pub fn emergency_passes(facts: &Facts<'_>, at: usize) -> Outcome {
    let cycle = facts.cycle(at);
    let permitted = must_be_emergency(cycle) || !cycle.sensors_known();
    let asked = asked(facts, at).filter(|asked| permitted && (7_169..=12_288).contains(&asked.total.raw()));
    let out = cycle.outputs.brake.total;
    demand(
        asked.is_some(),
        asked.is_some_and(|asked| asked.total == out),
        "up to 6 m/s² are permitted here and must pass",
    )
}
