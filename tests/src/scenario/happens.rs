//! What can happen in a drive, by the names that scenarios use. It happens in the cycle in which it becomes true.

use supervisor::{EpbState, Gear, Level, Mode, Occupancy, Percent};

use crate::drive::Cycle;

/// What it is, and whether it holds in a cycle.
type Named = (&'static str, fn(&Cycle) -> bool);

const ALL: &[Named] = &[
    ("60 m left", |cycle| cycle.truth.gap.is_some_and(|gap| gap <= 60.0)),
    ("level 1", |cycle| cycle.answer.status.level >= Level::One),
    ("level 2", |cycle| cycle.answer.status.level >= Level::Two),
    ("level 3", |cycle| cycle.answer.status.level >= Level::Three),
    ("mitigation ends", |cycle| cycle.answer.status.level == Level::None),
    ("forward warning", |cycle| cycle.answer.outputs.warnings.forward_collision),
    ("pedestrian warning", |cycle| cycle.answer.outputs.warnings.pedestrian),
    ("seat empty", |cycle| cycle.truth.seat == [false; 2]),
    ("seat taken", |cycle| cycle.truth.seat == [true; 2]),
    ("leave", |cycle| cycle.answer.status.occupancy == Occupancy::Leave),
    ("leave ends", |cycle| cycle.answer.status.occupancy == Occupancy::Confirmed),
    ("seat warning", |cycle| cycle.answer.outputs.warnings.seat_leave),
    ("flashers", |cycle| cycle.answer.outputs.warnings.hazard_flashers),
    ("standstill", |cycle| cycle.truth.speed <= 0.0),
    ("moves off", |cycle| cycle.truth.speed > 0.5),
    ("parking brake applied", |cycle| cycle.truth.epb == Some(EpbState::Applied)),
    ("parking brake released", |cycle| cycle.truth.epb == Some(EpbState::Released)),
    ("neutral", |cycle| cycle.truth.gear == Gear::Neutral),
    ("drive", |cycle| cycle.truth.gear == Gear::Drive),
    ("K1 open", |cycle| !cycle.truth.closed[0]),
    ("K1 closed", |cycle| cycle.truth.closed[0]),
    ("K4 open", |cycle| !cycle.truth.closed[1]),
    ("K4 closed", |cycle| cycle.truth.closed[1]),
    ("automated", |cycle| cycle.answer.status.mode == Mode::Automated),
    ("suspended", |cycle| cycle.answer.status.mode == Mode::Suspended),
    ("manual", |cycle| cycle.answer.status.mode == Mode::Manual),
    ("torque", |cycle| cycle.answer.outputs.drive.torque > Percent::ZERO),
    ("torque off", |cycle| cycle.answer.outputs.drive.torque == Percent::ZERO),
];

/// Whether this holds in a cycle, by its name; `None` if nothing is called so.
#[must_use]
pub fn named(name: &str) -> Option<fn(&Cycle) -> bool> {
    ALL.iter().find(|(known, _)| *known == name).map(|(_, holds)| *holds)
}

/// Something that happened.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Happened {
    /// When, in ms.
    pub at_ms: u32,
    /// What.
    pub what: &'static str,
}

/// Everything that happened, in order of time.
#[must_use]
pub fn happened(cycles: &[Cycle]) -> Vec<Happened> {
    let mut found = Vec::new();
    for (before, now) in cycles.iter().zip(cycles.iter().skip(1)) {
        for (what, holds) in ALL {
            if holds(now) && !holds(before) {
                found.push(Happened { at_ms: now.now_ms, what });
            }
        }
    }
    found
}
