//! What must hold in every cycle: the registries of the package.

use supervisor_proofs::properties::response::{self, Watch};
use supervisor_proofs::properties::{ALL, Cycle, Witness, vetting};

/// A property of a cycle.
#[derive(Clone, Copy)]
pub struct Check {
    /// Its name.
    pub name: &'static str,
    /// Whether it holds.
    pub holds: Holds,
}

/// How it is asked.
#[derive(Clone, Copy)]
pub enum Holds {
    /// Of a cycle.
    Cycle(fn(&Cycle<'_>) -> bool),
    /// Of a cycle and its verdicts.
    Witness(fn(&Witness) -> bool),
    /// Of the monitors.
    Watch(fn(&Watch<'_>) -> bool),
}

/// The monitors in a cycle that ran.
fn watch<'a>(cycle: &Cycle<'a>) -> Watch<'a> {
    let (_, ticks) = cycle.old.clock.advance(cycle.now, cycle.config);
    Watch {
        old: &cycle.old.monitors,
        inputs: cycle.inputs,
        ticks,
        config: cycle.config,
        new: &cycle.new.monitors,
        response: cycle.response,
        outputs: cycle.outputs,
        total: cycle.envelope.brake.total(cycle.outputs),
        emergency: cycle.new.mitigation.three,
        next: &cycle.next.monitors,
    }
}

impl Check {
    /// Whether it holds of a cycle that ran.
    pub fn holds(&self, witness: &Witness, cycle: &Cycle<'_>) -> bool {
        match self.holds {
            Holds::Cycle(holds) => holds(cycle),
            Holds::Witness(holds) => holds(witness),
            Holds::Watch(holds) => holds(&watch(cycle)),
        }
    }
}

/// Properties of the vector of outputs, which no registry lists.
const VECTOR: &[Check] = &[
    Check { name: "self_2_feasible", holds: Holds::Witness(|witness| witness.cycle().envelope.is_feasible()) },
    Check {
        name: "self_2_sound",
        holds: Holds::Witness(|witness| vetting::self_2_sound(witness.cycle().envelope, &witness.outputs)),
    },
    Check {
        name: "self_2_transparent",
        holds: Holds::Witness(|witness| {
            let cycle = witness.cycle();
            vetting::self_2_transparent(cycle.envelope, cycle.commands, cycle.outputs, &witness.verdicts)
        }),
    },
];

/// Every property.
pub fn every() -> Vec<Check> {
    let registry = ALL.iter().copied().flatten();
    let of_cycle = registry.map(|property| Check { name: property.name, holds: Holds::Cycle(property.holds) });
    let of_monitors = response::ALL.iter().map(|(name, holds)| Check { name, holds: Holds::Watch(*holds) });
    of_cycle.chain(of_monitors).chain(VECTOR.iter().copied()).collect()
}
