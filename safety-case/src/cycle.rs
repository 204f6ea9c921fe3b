//! One cycle of the replay: what went in, what came out.

use supervisor::{Commands, Decision, Inputs, Scene, Threat};

use crate::troubles::Active;

/// The period of the supervisor in microseconds.
pub const CYCLE: u64 = 10_000;

/// One cycle.
#[derive(Clone, Copy, Debug)]
pub struct Cycle<'a> {
    /// Time on the axis of the replay, in microseconds.
    pub at: u64,
    /// What the supervisor read.
    pub inputs: &'a Inputs,
    /// The object lists.
    pub scene: &'a Scene,
    /// What they mean together.
    pub threat: &'a Threat,
    /// What the main controller asked for.
    pub commands: &'a Commands,
    /// What was decided.
    pub decision: &'a Decision,
    /// The trouble codes that are active after it.
    pub troubles: Active,
}
