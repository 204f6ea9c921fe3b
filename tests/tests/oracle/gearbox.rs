//! Gear, auxiliaries and brake lamps (spec GEAR-1, AUX-1, BODY-1).

use super::claims::{Claim, Outcome, demand};
use super::facts::Facts;
use super::read::*;
use crate::common::*;

/// The claims of this file.
pub const CLAIMS: &[Claim] = &[
    Claim { id: "GEAR-1a", judge: no_park_rolling, plant: |cycle| cycle.outputs.gear = GearRequest::Park },
    Claim {
        id: "GEAR-1b",
        judge: no_reversal_rolling,
        plant: |cycle| {
            cycle.outputs.gear =
                if cycle.inputs.gear.is(Gear::Drive) { GearRequest::Reverse } else { GearRequest::Drive };
        },
    },
    Claim { id: "GEAR-1c", judge: speedless_holds, plant: |cycle| cycle.outputs.gear = GearRequest::Reverse },
    Claim { id: "GEAR-1d", judge: selector_decides, plant: |cycle| cycle.outputs.gear = GearRequest::Reverse },
    Claim { id: "SELF-11c", judge: gear_passes, plant: |cycle| cycle.outputs.gear = GearRequest::Hold },
    Claim {
        id: "AUX-1a, AUX-1b, AUX-1c",
        judge: auxiliaries_on,
        plant: |cycle| cycle.outputs.auxiliaries.air_pump = false,
    },
    Claim { id: "BODY-1a, BODY-1b", judge: brake_lamps, plant: |cycle| cycle.outputs.body.brake_lamps = false },
];

/// The gear that is asked of the gearbox.
fn asked(request: GearRequest) -> Option<Gear> {
    match request {
        GearRequest::Hold => None,
        GearRequest::Drive => Some(Gear::Drive),
        GearRequest::Reverse => Some(Gear::Reverse),
        GearRequest::Neutral => Some(Gear::Neutral),
        GearRequest::Park => Some(Gear::Park),
    }
}

/// GEAR-1a: P only at standstill, by the higher speed.
pub fn no_park_rolling(facts: &Facts<'_>, at: usize) -> Outcome {
    let parks = facts.cycle(at).outputs.gear == GearRequest::Park;
    demand(parks, facts.speed(at).below(77), "P goes out above standstill")
}

/// GEAR-1b: rolling, and rolling in every cycle since the other direction was last confirmed: no change of direction.
pub fn no_reversal_rolling(facts: &Facts<'_>, at: usize) -> Outcome {
    let other = match facts.cycle(at).outputs.gear {
        GearRequest::Drive => Gear::Reverse,
        GearRequest::Reverse => Gear::Drive,
        GearRequest::Hold | GearRequest::Neutral | GearRequest::Park => return Outcome::Idle,
    };
    let rolls = |at: usize| facts.speed(at).at_least(77);
    let wanted = asked(facts.cycle(at).outputs.gear);
    let gear = |at: usize| facts.cycle(at).inputs.gear.known();
    let rolling = (0..=at).rev().take_while(|at| rolls(*at));
    let last = rolling.filter_map(gear).find(|gear| Some(*gear) == wanted || *gear == other);
    demand(rolls(at), last != Some(other), "D and R change above standstill")
}

/// GEAR-1c: unknown speed: the gear is held. Two rows stand beside it: N that is asked for is the channel's safe direction and
/// passes (RULE-3a), and N of SEAT-6a, begun with the parking brake applied, goes on (RULE-1d).
pub fn speedless_holds(facts: &Facts<'_>, at: usize) -> Outcome {
    let cycle = facts.cycle(at);
    let parked = facts.parked.may.at(at) && !facts.confirmed.at(at) && cycle.inputs.epb.is(EpbState::Applied);
    let asked = usable(cycle.commands.gear, 250) == Some(GearRequest::Neutral);
    let holds = cycle.outputs.gear == GearRequest::Hold;
    let neutral = (parked || asked) && cycle.outputs.gear == GearRequest::Neutral;
    demand(facts.speed(at).unknown(), holds || neutral, "the speed is unknown: the gear must be held")
}

/// GEAR-1d, R-o: D, R and P only as the driver's selector shows.
pub fn selector_decides(facts: &Facts<'_>, at: usize) -> Outcome {
    let cycle = facts.cycle(at);
    let gear = asked(cycle.outputs.gear).filter(|gear| *gear != Gear::Neutral);
    demand(gear.is_some(), gear == cycle.inputs.selector.known(), "a gear that the driver's selector does not show")
}

/// SELF-11c: driver seated, standstill, not parked by leave: the gear that the selector shows passes.
pub fn gear_passes(facts: &Facts<'_>, at: usize) -> Outcome {
    let cycle = facts.cycle(at);
    let request = fresh(cycle.commands.gear);
    let shown = request.and_then(asked).is_some_and(|gear| cycle.inputs.selector.is(gear));
    let seated = facts.calm.at(at) && facts.confirmed.at(at) && facts.speed(at).below(77);
    let premise = shown && seated && cycle.inputs.epb.known().is_some();
    demand(premise, Some(cycle.outputs.gear) == request, "driver seated, standstill: the selected gear must pass")
}

/// AUX-1: none is switched off while rolling or with unknown speed.
pub fn auxiliaries_on(facts: &Facts<'_>, at: usize) -> Outcome {
    let off = facts.cycle(at).outputs.auxiliaries != Auxiliaries::NEUTRAL;
    demand(
        off || facts.speed(at).at_least(77),
        !off || facts.speed(at).below(77),
        "auxiliaries are off, not at standstill",
    )
}

/// BODY-1a, b: brake lamps from 0.7 m/s² on, and with every obligation to brake.
pub fn brake_lamps(facts: &Facts<'_>, at: usize) -> Outcome {
    let cycle = facts.cycle(at);
    let obliged = facts.mitigates(at) || (facts.leave.must.at(at) && facts.speed(at).at_least(512));
    let premise = obliged || braking_out(&cycle.outputs) >= 1_434;
    demand(premise, cycle.outputs.body.brake_lamps, "the bus brakes: the brake lamps must be on")
}
