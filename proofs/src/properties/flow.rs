//! The program flow (SELF-6): one step from any signature. What differs once differs for ever, and only the whole cycle answers
//! the watchdog.

use supervisor_core::{Checkpoint, Flow};

use super::implies;

/// Every stage once and in order.
pub const IN_ORDER: [Checkpoint; 8] = [
    Checkpoint::Perceive,
    Checkpoint::Decode,
    Checkpoint::Configuration,
    Checkpoint::Observe,
    Checkpoint::Decide,
    Checkpoint::Vet,
    Checkpoint::Record,
    Checkpoint::Encode,
];

/// SELF-6a: every stage once and in order leads from the start to the complete signature, over those that rest.
#[must_use]
pub fn self_6_in_order_is_complete() -> bool {
    let mut flow = Flow::START;
    let mut right = true;
    for checkpoint in IN_ORDER {
        flow = flow.pass(checkpoint);
        right &= implies(checkpoint == Checkpoint::Perceive, flow == Flow::PERCEIVED);
        right &= implies(checkpoint == Checkpoint::Record, flow == Flow::RECORDED);
    }
    right && flow == Flow::COMPLETE
}

/// SELF-6b: from any signature, another stage in its place gives another signature.
#[must_use]
pub fn self_6_stages_differ(flow: Flow, stage: Checkpoint, other: Checkpoint) -> bool {
    (flow.pass(stage) == flow.pass(other)) == (stage == other)
}

/// SELF-6b: two signatures that differ stay different whatever stage runs after: nothing heals a wrong one.
#[must_use]
pub fn self_6_difference_stays(flow: Flow, other: Flow, stage: Checkpoint) -> bool {
    (flow.pass(stage) == other.pass(stage)) == (flow == other)
}

/// SELF-6a: the answer to any question is right exactly for the complete signature.
#[must_use]
pub fn self_6_answer_exactly(flow: Flow, question: u8) -> bool {
    (flow.answer(question) == Flow::COMPLETE.answer(question)) == (flow == Flow::COMPLETE)
}

/// SELF-6a, SELF-6b: a stage at the wrong place of a cycle that was right so far, at any of its places, leaves the right signatures: what it
/// gives is none that a right cycle has anywhere.
#[must_use]
pub fn self_6_wrong_stage_leaves_the_path(before: usize, stage: Checkpoint) -> bool {
    let mut path = [Flow::START; 9];
    let mut flow = Flow::START;
    for (slot, checkpoint) in path.iter_mut().skip(1).zip(IN_ORDER) {
        flow = flow.pass(checkpoint);
        *slot = flow;
    }
    let right = IN_ORDER.get(before) == Some(&stage);
    path.get(before).is_none_or(|reached| path.contains(&reached.pass(stage)) == right)
}
