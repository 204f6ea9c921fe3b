//! The explorer can fail: a planted property, a planted promise and a mode out of reach are found.

use std::error::Error;
use std::fs;

use supervisor_core::{EpbRequest, Record, ResetCause, Sealed, State};

use crate::candump;
use crate::checks::{Check, Holds};
use crate::coverage::Coverage;
use crate::model::{Exploration, Promise, Start, Vector};
use crate::plant::Plant;
use crate::report::{Slice, explore, explore_to, folder};
use crate::vectors::{Alphabet, SCALED};
use crate::{collision, drive, seat};

const PLANTED: Check = Check {
    name: "planted: the parking brake is never asked to be applied",
    holds: Holds::Witness(|witness| witness.outputs.epb.request != EpbRequest::Apply),
};

fn gets_up(vector: &mut Vector) {
    crate::vectors::seat(vector, [Some(supervisor_core::Seat::Vacant); 2]);
}

/// A bus rolls at 2 km/h; the driver sits or does not.
fn exploration() -> Result<Exploration, Box<dyn Error>> {
    let mut alphabet = Alphabet::new(&SCALED);
    alphabet.add("occupied", |_| {});
    alphabet.add("vacant", gets_up);
    let plant = Some(Plant::rolling(500));
    Ok(Exploration {
        name: "planted",
        sealed: Sealed::new(SCALED)?,
        config: SCALED,
        starts: vec![Start { cause: ResetCause::PowerOn, record: Some(Record::None), plant }],
        vectors: alphabet.done(),
        fine: 1,
        promises: Vec::new(),
        checks: vec![PLANTED],
    })
}

/// SEAT-4a: a planted property that SEAT-4 breaks is found by a shortest way, and the log of that way breaks it too.
#[test]
fn a_planted_property_is_found_by_a_shortest_way_that_replays() -> Result<(), Box<dyn Error>> {
    let (outcome, explorer) = explore(exploration()?);
    let found = outcome.found.ok_or("not found")?;
    assert_eq!(found.name, PLANTED.name);
    let broken = found.drive.cycles.iter().filter(|(_, ran)| ran.next.broken.is_some()).count();
    assert_eq!(broken, 1, "the last cycle, and no other, breaks it");
    assert!(
        found.text.contains("seat.leave: no -> yes") && found.text.contains("parking brake Apply"),
        "{}",
        found.text
    );
    // Nothing nearer: the finding lies one node beyond what is explored here.
    let (nearer, _) = explore_to(exploration()?, found.actions + 1);
    assert!(nearer.found.is_none(), "there is a shorter way");
    let (again, _) = explore_to(exploration()?, found.actions + 2);
    assert!(again.found.is_some(), "the way is as long as it says");

    let command = candump::write("planted", &explorer, &found.drive)?;
    println!("{}\n{command}", found.text);
    let log = fs::read_to_string(folder().join("planted-counterexample.candump"))?;
    let ran = candump::replay(&log, &SCALED, State::boot(ResetCause::PowerOn, Some(Record::None)))?;
    let at = ran.iter().position(|witness| !PLANTED.holds(witness, &witness.cycle()));
    let at = at.ok_or("the log does not show it")?;
    assert!(ran[at].next.seat.leave, "and for the same reason");
    Ok(())
}

/// SEAT-1a: a promise that is not kept is found, and so is a mode that is never reached.
#[test]
fn a_broken_promise_and_a_missing_mode_are_found() -> Result<(), Box<dyn Error>> {
    let mut hasty = exploration()?;
    hasty.checks.clear();
    hasty.promises.push(Promise { name: "planted: leave ends at once", most: 3, waits: |cycle| cycle.new.seat.leave });
    let (outcome, _) = explore(hasty);
    assert_eq!(outcome.found.map(|found| found.name), Some("planted: leave ends at once"));

    let mut blind = exploration()?;
    blind.checks.clear();
    let covers = &["high_voltage.restart"];
    let slice = Slice { name: "planted", explorations: vec![blind], covers, unreachable: &[] };
    let missing = slice.run().err().map(|error| error.to_string()).unwrap_or_default();
    assert!(missing.contains("high_voltage.restart=Started"), "{missing}");
    Ok(())
}

/// Timers that no slice has to see in each of its phases.
const NOT_ASKED_FOR: &[&str] = &[
    "brake.retarder_lost",
    // Its deadlines are facts of their own.
    "high_voltage.wait",
    "monitors.brake.response",
    "monitors.brake_over",
    "monitors.drive.response",
    "monitors.steering.over",
    "monitors.steers",
];

/// SELF-1a: every enumeration, fact and timer of the retained state belongs to a slice that must reach all its values, or
/// is named as one that none has to.
#[test]
fn every_mode_belongs_to_a_slice() {
    let slices = [seat::COVERS, collision::COVERS, drive::COVERS, NOT_ASKED_FOR];
    let modes = Coverage::new(&SCALED).modes();
    let groups = modes.keys().filter_map(|mode| mode.split_once('=')).map(|(group, _)| group);
    let homeless: Vec<&str> = groups.filter(|group| !slices.iter().any(|slice| slice.contains(group))).collect();
    assert!(homeless.is_empty(), "in no slice: {homeless:?}");
}
