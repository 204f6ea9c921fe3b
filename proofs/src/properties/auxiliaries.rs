//! Air pump, power steering and DC/DC converter (AUX-1).

use supervisor_core::Auxiliaries;

use super::facts::asked;
use super::{Cycle, Property, all, implies};

/// Every property of this file.
pub const ALL: &[Property] = all![aux_1_on_while_rolling, self_11_auxiliaries_pass];

/// AUX-1a, AUX-1b, AUX-1c, RULE-6b: unless the bus is known to stand, by the higher speed, each of the three is on.
#[must_use]
pub fn aux_1_on_while_rolling(cycle: &Cycle<'_>) -> bool {
    let Auxiliaries { air_pump, power_steering, dc_dc } = cycle.outputs.auxiliaries;
    implies(!cycle.stands(), air_pump && power_steering && dc_dc)
}

/// SELF-11i: on passes always, off at standstill; and each one that is asked to be on is on.
#[must_use]
pub fn self_11_auxiliaries_pass(cycle: &Cycle<'_>) -> bool {
    let Some(wanted) = asked(cycle.commands.auxiliaries, cycle.config.timeout_200) else { return true };
    let out = cycle.outputs.auxiliaries;
    implies(cycle.stands() || wanted == Auxiliaries::NEUTRAL, out == wanted)
        && implies(wanted.air_pump, out.air_pump)
        && implies(wanted.power_steering, out.power_steering)
        && implies(wanted.dc_dc, out.dc_dc)
}
