//! The program flow (SELF-6): single steps from any signature.

use supervisor_core::{Checkpoint, Flow};

use crate::properties::flow::{
    self_6_answer_exactly, self_6_difference_stays, self_6_in_order_is_complete, self_6_stages_differ,
    self_6_wrong_stage_leaves_the_path,
};

/// SELF-6a, SELF-6b: the answer is right for the complete signature alone; another stage gives another signature; every wrong
/// stage in a cycle that was right so far leaves the right signatures.
#[kani::proof]
#[kani::unwind(10)]
fn self_6_answer_and_order() {
    let (flow, question): (Flow, u8) = (kani::any(), kani::any());
    let (stage, other): (Checkpoint, Checkpoint) = (kani::any(), kani::any());
    let before: usize = kani::any();
    assert!(self_6_answer_exactly(flow, question));
    assert!(self_6_stages_differ(flow, stage, other));
    assert!(self_6_in_order_is_complete());
    assert!(self_6_wrong_stage_leaves_the_path(before, stage));
    kani::cover!(flow == Flow::COMPLETE, "the complete cycle");
    kani::cover!(flow != Flow::COMPLETE && stage != other, "any other");
    kani::cover!(before == 8 && stage == Checkpoint::Encode, "the last stage once more");
}

/// SELF-6b: a difference stays, whatever stage runs after: nothing heals a wrong signature.
#[kani::proof]
fn self_6_difference_stays_for_ever() {
    let (flow, other, stage): (Flow, Flow, Checkpoint) = (kani::any(), kani::any(), kani::any());
    assert!(self_6_difference_stays(flow, other, stage));
    kani::cover!(flow != other, "two signatures");
}
