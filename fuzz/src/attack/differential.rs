//! The step against the independent oracle of `tests/tests/oracle`: every claim in every cycle, over the whole past.

use super::Reached;
use crate::common::random::Dice;
use crate::oracle::claims::{all, judge};
use crate::oracle::starts::{BEGINNINGS, LONG, beginning, event};
use crate::oracle::trace::told;

/// So many cycles at most, beside those of the beginning.
const LONGEST: usize = 1_000;

/// A drive: the first bytes say where it begins, the others what happens in it.
///
/// # Panics
/// With the drive as text, if a claim does not hold.
pub fn differential(bytes: &[u8], reached: &mut Reached) {
    let mut dice = Dice::Bytes(bytes);
    // Judging a past of ten minutes takes its time: less often.
    let which = if dice.one_in(16) { LONG + dice.below(BEGINNINGS - LONG) } else { dice.below(LONG) };
    let mut drive = beginning(which);
    let from = drive.trace.cycles.len();
    while !dice.is_used_up() && drive.trace.cycles.len() < from + LONGEST {
        event(&mut drive, &mut dice);
    }
    for cycle in &drive.trace.cycles[from..] {
        let (status, verdicts) = &cycle.said;
        reached.look_at(status, verdicts, cycle.outputs.mode);
    }
    let broken = judge(&drive.trace, from, &all());
    let shown = broken.map(|(at, id, why)| format!("cycle {at}\n{}\n{id}: {why}", told(&drive.trace, from, at)));
    assert!(shown.is_none(), "beginning {which}, {}", shown.unwrap_or_default());
}
