//! What a claim is, and all of them.

use super::facts::Facts;
use super::trace::{Cycle, Trace};
use super::{collision, drive, gearbox, lost, seat, voltage};

/// What a claim says of a cycle.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// It demands nothing here.
    Idle,
    /// What it demands is so.
    Kept,
    /// It is not so.
    Broken(String),
}

/// `premise` demands `kept`; `why` is for people.
pub fn demand(premise: bool, kept: bool, why: &str) -> Outcome {
    match (premise, kept) {
        (false, _) => Outcome::Idle,
        (true, true) => Outcome::Kept,
        (true, false) => Outcome::Broken(why.to_owned()),
    }
}

/// A requirement as a predicate over the whole past, judged in a cycle; and an output that it must refuse.
#[derive(Clone, Copy, Debug)]
pub struct Claim {
    /// The requirements.
    pub id: &'static str,
    /// Judges a cycle.
    pub judge: fn(&Facts<'_>, usize) -> Outcome,
    /// Plants a wrong output.
    pub plant: fn(&mut Cycle),
}

/// Every claim.
pub fn all() -> Vec<Claim> {
    [seat::CLAIMS, voltage::CLAIMS, collision::CLAIMS, drive::CLAIMS, gearbox::CLAIMS, lost::CLAIMS].concat()
}

/// The first cycle from `from` on in which a claim is broken: the cycle, the claim, and why.
pub fn judge(trace: &Trace, from: usize, claims: &[Claim]) -> Option<(usize, &'static str, String)> {
    let facts = Facts::of(trace);
    (from..trace.cycles.len()).find_map(|at| {
        claims.iter().find_map(|claim| match (claim.judge)(&facts, at) {
            Outcome::Idle | Outcome::Kept => None,
            Outcome::Broken(why) => Some((at, claim.id, why)),
        })
    })
}
