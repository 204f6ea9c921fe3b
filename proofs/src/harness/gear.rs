//! The gear and the auxiliaries (GEAR-1, AUX-1).

use supervisor_core::{Auxiliaries, GearRequest, Outputs, vet_auxiliaries, vet_gear};

use super::Any;
use crate::properties::auxiliaries::{aux_1_on_while_rolling, self_11_auxiliaries_pass};
use crate::properties::gear::{
    gear_1_direction_exactly, gear_1_no_change_while_rolling, gear_1_selector_decides, gear_1_speed_unknown_holds,
    self_11_gear_passes,
};

/// GEAR-1, AUX-1, SELF-11c, SELF-11i.
#[kani::proof]
#[kani::unwind(17)]
#[kani::stub(supervisor_core::kernel::within_percent, crate::harness::uninterpreted::within_percent)]
fn gear_1_and_auxiliaries() {
    let any = Any::new();
    let envelope = &any.decided.envelope;
    let outputs = Outputs {
        gear: vet_gear(envelope, any.commands.gear).0,
        auxiliaries: vet_auxiliaries(envelope, any.commands.auxiliaries).0,
        ..kani::any()
    };
    let cycle = any.cycle(&outputs);
    assert!(gear_1_direction_exactly(&cycle));
    assert!(gear_1_no_change_while_rolling(&cycle));
    assert!(gear_1_speed_unknown_holds(&cycle));
    assert!(gear_1_selector_decides(&cycle));
    assert!(self_11_gear_passes(&cycle));
    assert!(aux_1_on_while_rolling(&cycle));
    assert!(self_11_auxiliaries_pass(&cycle));
    kani::cover!(outputs.gear == GearRequest::Park, "park passes");
    kani::cover!(outputs.gear == GearRequest::Drive && !cycle.stands(), "drive passes while rolling");
    kani::cover!(outputs.gear == GearRequest::Reverse && cycle.stands(), "reverse passes at standstill");
    kani::cover!(outputs.auxiliaries != Auxiliaries::NEUTRAL, "an auxiliary is switched off");
}
