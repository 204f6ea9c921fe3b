//! The correct drives into which faults are injected: those that ship, and some more.

use supervisor::Gear;

use crate::catalogue;
use crate::drive::Scenario;
use crate::driver::{Act, Script, after_start};
use crate::plant::Parameters;
use crate::road::Obstacle;

/// From stop to stop.
const STOP_AND_GO: Script<'static> = after_start![
    (10_500, Act::Hold(25.0)),
    (22_000, Act::Accelerator(0.0)),
    (22_500, Act::Brake(0.3)),
    (31_000, Act::Brake(0.0)),
    (31_500, Act::Hold(35.0)),
    (46_000, Act::Accelerator(0.0)),
    (46_500, Act::Brake(0.35)),
];

/// On a clear road under cruise control, until the driver brakes. No faster than 40 km/h: beyond, the drive of the model
/// gives less than it says that it can (its power ends, its limit stays at 100 %), and that is rightly reported.
const CRUISE: Script<'static> = after_start![
    (10_500, Act::Hold(40.0)),
    (30_000, Act::CruiseSwitch(true)),
    (31_000, Act::Set(true)),
    (31_400, Act::Set(false)),
    (31_600, Act::Accelerator(0.0)),
    (50_000, Act::Brake(0.2)),
    (53_000, Act::Brake(0.0)),
    (54_000, Act::Hold(40.0)),
];

/// Up to a standing car; the driver brakes in time.
const BEHIND_A_CAR: Script<'static> =
    after_start![(10_500, Act::Hold(30.0)), (26_000, Act::Accelerator(0.0)), (26_500, Act::Brake(0.3)),];

/// The driver gets up at 30 km/h, comes back soon and drives on.
const SHORT_LEAVE: Script<'static> = after_start![
    (10_500, Act::Hold(30.0)),
    (26_000, Act::Accelerator(0.0)),
    (26_300, Act::Sit(false)),
    (45_000, Act::Sit(true)),
    (48_000, Act::Brake(0.4)),
    (49_000, Act::Selector(Gear::Neutral)),
    (51_000, Act::Selector(Gear::Drive)),
    (54_000, Act::Brake(0.0)),
    (55_000, Act::Accelerator(0.15)),
    (57_000, Act::Hold(20.0)),
    (66_000, Act::Accelerator(0.0)),
    (66_400, Act::Brake(0.3)),
];

/// The driver stops, gets up without the parking brake, comes back and drives on.
const RISES_AT_STOP: Script<'static> = after_start![
    (10_500, Act::Hold(25.0)),
    (22_000, Act::Accelerator(0.0)),
    (22_500, Act::Brake(0.35)),
    (29_500, Act::Brake(0.0)),
    (30_000, Act::Sit(false)),
    (40_000, Act::Sit(true)),
    (43_000, Act::Brake(0.4)),
    (44_000, Act::Selector(Gear::Neutral)),
    (46_000, Act::Selector(Gear::Drive)),
    (49_000, Act::Brake(0.0)),
    (50_000, Act::Accelerator(0.15)),
    (52_000, Act::Hold(20.0)),
];

/// The driver gets up at 30 km/h and stays away.
const AWAY: Script<'static> =
    after_start![(10_500, Act::Hold(30.0)), (26_000, Act::Accelerator(0.0)), (26_300, Act::Sit(false)),];

const fn ours(
    name: &'static str,
    description: &'static str,
    length_ms: u32,
    script: Script<'static>,
    road: &'static [Obstacle],
) -> Scenario<'static> {
    Scenario { name, title: name, description, length_ms, parameters: Parameters::DEFAULT, script, road, misdeeds: &[] }
}

const OURS: [Scenario<'static>; 6] = [
    ours("stop-and-go", "From stop to stop on a clear road.", 56_000, STOP_AND_GO, &[]),
    ours("cruise", "Cruise control and lane assistant on a clear road, until the driver brakes.", 66_000, CRUISE, &[]),
    ours(
        "behind-a-car",
        "The driver stops behind a standing car.",
        36_000,
        BEHIND_A_CAR,
        &[Obstacle::standing_car(112.0)],
    ),
    ours("short-leave", "The driver gets up at 30 km/h, and comes back after 19 s.", 72_000, SHORT_LEAVE, &[]),
    ours("rises-at-stop", "The driver gets up at a stop, without the parking brake.", 62_000, RISES_AT_STOP, &[]),
    ours("away", "The driver gets up at 30 km/h, and stays away for more than twelve minutes.", 800_000, AWAY, &[]),
];

/// Every correct drive: the two that ship, and ours.
#[must_use]
pub fn all() -> Vec<Scenario<'static>> {
    let shipped = catalogue::ALL.iter().filter(|scenario| scenario.misdeeds.is_empty());
    shipped.copied().chain(OURS).collect()
}
