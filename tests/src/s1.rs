//! S1 §3.2 (figures 4 and 5) beside ours: 12 m bus, 40 km/h, a car stands 60 m ahead.

use supervisor::{ConfigError, Level};

use crate::catalogue::s1_approach;
use crate::drive::{Cycle, run};
use crate::plant::Parameters;

/// An approach as S1 tells it; times in s from the moment when 60 m are left.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Approach {
    /// When levels 1, 2, 3 begin; `None` if they do not.
    pub levels: [Option<f64>; 3],
    /// Speed at that moment, in km/h.
    pub speed: [Option<f64>; 3],
    /// When the bus stands.
    pub standstill: Option<f64>,
    /// Gap that remains, in m.
    pub rest_gap: Option<f64>,
}

/// The published figures. They do not close: at 40 km/h the time to collision falls below 4.4 s when 48.9 m are
/// left, 1.0 s after the 60 m; the published decelerations, integrated, reach level 3 at 26.5 km/h, and 5 m/s² take
/// 1.5 s from there, not 1.1 s.
pub const PUBLISHED: Approach = Approach {
    levels: [Some(2.21), Some(3.19), Some(4.30)],
    speed: [None; 3],
    standstill: Some(5.40),
    rest_gap: Some(1.3),
};

/// Ours, with the supervisor and a correct main controller, for a dead time of the service brake in s.
///
/// # Errors
/// If the default configuration is refused.
pub fn approach(brake_dead_s: f64) -> Result<Approach, ConfigError> {
    let scenario = s1_approach(Parameters::DEFAULT.with_brake_dead(brake_dead_s));
    Ok(told(&run(&scenario)?.cycles))
}

fn told(cycles: &[Cycle]) -> Approach {
    let zero = cycles.iter().find(|cycle| cycle.truth.gap.is_some_and(|gap| gap <= 60.0));
    let zero_ms = zero.map_or(0, |cycle| cycle.now_ms);
    let after = || cycles.iter().filter(|cycle| cycle.now_ms >= zero_ms);
    let since = |cycle: &Cycle| f64::from(cycle.now_ms - zero_ms) / 1000.0;
    let begins =
        [Level::One, Level::Two, Level::Three].map(|level| after().find(|cycle| cycle.answer.status.level >= level));
    let stands = after().find(|cycle| cycle.truth.speed <= 0.0);
    Approach {
        levels: begins.map(|cycle| cycle.map(since)),
        speed: begins.map(|cycle| cycle.map(|cycle| cycle.truth.speed * 3.6)),
        standstill: stands.map(since),
        rest_gap: stands.and_then(|cycle| cycle.truth.gap),
    }
}
