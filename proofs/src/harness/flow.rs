//! The program flow (SELF-6): the answer, and the right order. Every single wrong stage is a test: there is nothing to search.
//!
//! That a difference stays for ever rests on a multiplication by an odd number, which is reversible; the solver does not
//! find that in ten minutes. It is tested on random signatures, and every sequence of up to nine stages is tried.

use supervisor_core::Flow;

use crate::properties::flow::{self_6_answer_exactly, self_6_in_order_is_complete};

/// SELF-6a: the answer to any question is right for the complete signature alone, which the right order reaches.
#[kani::proof]
#[kani::unwind(10)]
fn self_6_answer_and_order() {
    let (flow, question): (Flow, u8) = (kani::any(), kani::any());
    assert!(self_6_answer_exactly(flow, question));
    assert!(self_6_in_order_is_complete());
    kani::cover!(flow == Flow::COMPLETE, "the complete cycle");
    kani::cover!(flow != Flow::COMPLETE, "any other");
}
