//! Lost and refused commands (S4 table 5, spec E2E-2, rule 5).

use super::claims::{Claim, Outcome, demand};
use super::facts::Facts;
use super::read::*;
use crate::common::*;

/// The claims of this file.
pub const CLAIMS: &[Claim] = &[
    Claim { id: "E2E-2a, RULE-5a", judge: lost_torque, plant: |cycle| cycle.outputs.drive.torque = percent(1) },
    Claim { id: "E2E-2b", judge: lost_gear, plant: |cycle| cycle.outputs.gear = GearRequest::Drive },
    Claim { id: "E2E-2c", judge: lost_brake_is_held, plant: |cycle| cycle.outputs.brake.total = DecelMs2Q11::ZERO },
    Claim {
        id: "E2E-2c, E2E-2d",
        judge: lost_brake_falls,
        plant: |cycle| cycle.outputs.brake.total = DecelMs2Q11::new(7_000),
    },
    Claim { id: "E2E-2g", judge: lost_parking_brake, plant: |cycle| cycle.outputs.epb.request = EpbRequest::Apply },
    Claim { id: "E2E-2h", judge: lost_contactors, plant: |cycle| cycle.outputs.contactors.k4 = ContactorRequest::Open },
];

/// E2E-2a, RULE-5a: no drive frame for 125 ms, or a refused one: torque 0.
pub fn lost_torque(facts: &Facts<'_>, at: usize) -> Outcome {
    let cycle = facts.cycle(at);
    let lost = usable(cycle.commands.drive, 125).is_none();
    demand(lost, cycle.outputs.drive.torque == Percent::ZERO, "the drive command is lost: torque must be 0")
}

/// E2E-2b: no gear frame in time: hold, unless parked by leave asks for N.
pub fn lost_gear(facts: &Facts<'_>, at: usize) -> Outcome {
    let cycle = facts.cycle(at);
    let lost = usable(cycle.commands.gear, 250).is_none();
    let premise = lost && (!facts.parked.may.at(at) || facts.confirmed.at(at));
    demand(premise, cycle.outputs.gear == GearRequest::Hold, "the gear command is lost: hold must go out")
}

/// Since when the brake command has been lost or refused without a break, if it is.
fn brake_lost(facts: &Facts<'_>, at: usize) -> Option<usize> {
    let lost = |at: usize| usable(facts.cycle(at).commands.brake, 125).is_none();
    (0..=at).rev().take_while(|at| lost(*at)).last().filter(|first| *first > 0)
}

/// E2E-2c: with the road, the pedals and everything else calm since before, the last request goes on in the first 500 ms.
pub fn lost_brake_is_held(facts: &Facts<'_>, at: usize) -> Outcome {
    let Some(first) = brake_lost(facts, at) else { return Outcome::Idle };
    let sound = |at: usize| {
        let cycle = facts.cycle(at);
        let released = tracks(cycle.inputs.accelerator) == Some((0, 0)) && pedal_clear(&cycle.inputs);
        let attended = facts.confirmed.at(at) && facts.still.at(at);
        facts.calm.at(at) && attended && released && cycle.outputs.retarder.torque == Percent::ZERO
    };
    let last = facts.before(first).brake.total;
    let absent = (first..=at).all(|at| !matches!(facts.cycle(at).commands.brake, Command::Rejected(_)));
    let soon = facts.safety.between(first - 1, at) <= 500 && last.raw() <= 7_168 && absent;
    let premise = soon && (first - 1..=at).all(sound);
    demand(
        premise,
        facts.cycle(at).outputs.brake.total >= last,
        "the brake command is lost: the last request must go on",
    )
}

/// E2E-2c, d: 500 ms after the loss the request falls by 2 m/s³ at least, to 0; it never rises.
pub fn lost_brake_falls(facts: &Facts<'_>, at: usize) -> Outcome {
    let Some(first) = brake_lost(facts, at) else { return Outcome::Idle };
    // A parking brake released past us with nobody confirmed is answered by a hold (R-z).
    let calm = (first..=at).all(|at| facts.calm.at(at) && facts.confirmed.at(at) && facts.still.at(at));
    let last = i64::from(facts.before(first).brake.total.raw());
    let falling = (facts.safety.between(first, at) - 510).max(0);
    let most = (last * 1000 - 4_096 * falling).max(0);
    let total = i64::from(facts.cycle(at).outputs.brake.total.raw());
    demand(calm, total * 1000 <= most, "the brake command is lost for long: the request must fall to 0")
}

/// E2E-2g: no frame for 500 ms: none, unless something obliges (leave, the driver's switch, a bypass).
pub fn lost_parking_brake(facts: &Facts<'_>, at: usize) -> Outcome {
    let cycle = facts.cycle(at);
    let lost = usable(cycle.commands.epb, 500).is_none();
    let premise = lost && facts.calm.at(at) && facts.confirmed.at(at) && cycle.inputs.epb_switch.is(EpbSwitch::Idle);
    demand(
        premise,
        cycle.outputs.epb.request == EpbRequest::None,
        "the parking-brake command is lost: none must go out",
    )
}

/// E2E-2h: no frame for 500 ms: the contactors hold, unless the shutdown after leave runs.
pub fn lost_contactors(facts: &Facts<'_>, at: usize) -> Outcome {
    let cycle = facts.cycle(at);
    let lost = usable(cycle.commands.contactors, 500).is_none() && facts.trace.clean;
    let premise = lost && !facts.committed.may.at(at);
    demand(premise, cycle.outputs.contactors == Contactors::NEUTRAL, "the contactor command is lost: hold must go out")
}
