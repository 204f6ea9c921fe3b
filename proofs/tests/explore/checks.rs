//! What must hold in every cycle: the registry of the package.

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
}

impl Check {
    /// Whether it holds of a cycle that ran.
    pub fn holds(&self, witness: &Witness, cycle: &Cycle<'_>) -> bool {
        match self.holds {
            Holds::Cycle(holds) => holds(cycle),
            Holds::Witness(holds) => holds(witness),
        }
    }
}

/// Properties of the vector of outputs: the registry has those of cycles only.
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
    of_cycle.chain(VECTOR.iter().copied()).collect()
}
