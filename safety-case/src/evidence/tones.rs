//! How the evidence of each solution of the argument stands: as its worst piece.

use std::collections::BTreeMap;

use super::records::{Standing, State};
use crate::analysis::{Evidence, Kind};
use crate::argument::{Argument, Element};
use crate::trace::Trace;

/// The class of each node that stands on evidence: `good`, `stale`, `notrun` or `bad`, the worst of its pieces.
#[must_use]
pub fn tones(argument: &Argument, standings: &[Standing], trace: &Trace) -> BTreeMap<String, &'static str> {
    let mut tones = BTreeMap::new();
    for (_, id, node) in argument.nodes().filter(|(_, id, _)| Element::of(id).is_some_and(Element::is_solution)) {
        let pieces = node.pieces().filter_map(|piece| Evidence::try_from(piece.to_owned()).ok());
        let worst = pieces.map(|piece| tone(&piece, standings, trace)).max_by_key(|tone| rank(tone));
        tones.insert(id.to_owned(), worst.unwrap_or("bad"));
    }
    tones
}

fn rank(tone: &str) -> usize {
    ["good", "stale", "notrun", "bad"].iter().position(|known| *known == tone).unwrap_or(0)
}

/// How a piece of evidence stands.
#[must_use]
pub fn tone(evidence: &Evidence, standings: &[Standing], trace: &Trace) -> &'static str {
    let record = |name: &str| {
        standings.iter().find(|standing| standing.name == name).map_or("bad", |standing| match standing.state {
            State::Fresh => "good",
            State::Stale { .. } => "stale",
            State::NotRun => "notrun",
        })
    };
    match evidence.kind {
        Kind::Record => record(&evidence.name),
        Kind::Fault => record("inject"),
        Kind::Mistake => record("mistakes"),
        Kind::Harness => {
            let harness =
                trace.rows.iter().flat_map(|row| &row.harnesses).find(|harness| harness.place.item == evidence.name);
            match harness.map(|harness| harness.verdict.as_str()) {
                Some("proved") => "good",
                Some(verdict) if verdict.starts_with("proved") => "stale",
                Some("not run") => "notrun",
                Some(_) | None => "bad",
            }
        }
        // That a test or a step is there; whether it passed, the record of the tests and `.ci/run` say.
        Kind::Test | Kind::Step => "good",
    }
}
