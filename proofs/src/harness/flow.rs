//! The program flow (SELF-6): the answer, the right order, and every single wrong stage.
//!
//! That a difference stays for ever rests on a multiplication by an odd number, which is reversible; the solver does not
//! find that in ten minutes. It is tested on random signatures, and every sequence of up to nine stages is tried.

use supervisor_core::{Checkpoint, Flow};

use crate::properties::flow::{self_6_answer_exactly, self_6_in_order_is_complete, self_6_wrong_stage_leaves_the_path};

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
