//! The program flow (SELF-6): single steps from any signature.

use supervisor_core::{Checkpoint, Flow};

use crate::properties::flow::{
    self_6_answer_exactly, self_6_difference_stays, self_6_in_order_is_complete, self_6_stages_differ,
    self_6_wrong_stage_leaves_the_path,
};

/// SELF-6a: the answer to any question is right for the complete signature alone, which the right order reaches; every wrong
/// stage in a cycle that was right so far leaves the right signatures.
#[kani::proof]
#[kani::unwind(10)]
fn self_6_answer_and_order() {
    let (flow, question): (Flow, u8) = (kani::any(), kani::any());
    assert!(self_6_answer_exactly(flow, question));
    assert!(self_6_in_order_is_complete());
    for before in 0..9 {
        for stage in Checkpoint::ALL {
            assert!(self_6_wrong_stage_leaves_the_path(before, *stage));
        }
    }
    kani::cover!(flow == Flow::COMPLETE, "the complete cycle");
    kani::cover!(flow != Flow::COMPLETE, "any other");
}

/// SELF-6b: from any signature another stage gives another signature.
#[kani::proof]
fn self_6_another_stage_differs() {
    let (flow, stage, other): (Flow, Checkpoint, Checkpoint) = (kani::any(), kani::any(), kani::any());
    assert!(self_6_stages_differ(flow, stage, other));
    kani::cover!(stage != other, "two stages");
}

/// SELF-6b: a difference stays, whatever stage runs after: nothing heals a wrong signature.
#[kani::proof]
fn self_6_difference_stays_for_ever() {
    let (flow, other, stage): (Flow, Flow, Checkpoint) = (kani::any(), kani::any(), kani::any());
    assert!(self_6_difference_stays(flow, other, stage));
    kani::cover!(flow != other, "two signatures");
}
