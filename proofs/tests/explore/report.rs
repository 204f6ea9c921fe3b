//! Runs explorations, says what they showed, and keeps a record without times.

use std::collections::{BTreeMap, BTreeSet};
use std::error::Error;
use std::path::PathBuf;
use std::sync::atomic::Ordering;
use std::time::Instant;

use serde_json::{Value, json};
use stateright::{Checker, HasDiscoveries, Model};

use crate::model::{Exploration, Explorer, HOLDS};
use crate::trace::{self, Drive};

/// No exploration has more transitions than this: one that does is not closed.
const MOST: usize = 400_000;

/// What an exploration showed.
pub struct Outcome {
    /// As it stands in the record.
    pub json: Value,
    /// Modes, and whether each was seen.
    pub modes: BTreeMap<String, bool>,
    /// States, transitions.
    pub size: (usize, usize),
    /// What was found, and the shortest way there.
    pub found: Option<Found>,
}

/// A finding.
pub struct Found {
    /// What was broken.
    pub name: &'static str,
    /// The way there.
    pub drive: Drive,
    /// The same for people.
    pub text: String,
}

/// Where records and counterexamples go.
pub fn folder() -> PathBuf {
    PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("../exploration")
}

/// Explores, breadth first, by one thread: the first way found to a finding is a shortest one.
pub fn explore(of: Exploration) -> (Outcome, Explorer) {
    let started = Instant::now();
    let (name, vectors, starts) = (of.name, of.vectors.len(), of.starts.len());
    let again = Explorer::new(of.clone());
    let checker = Explorer::new(of).checker().finish_when(HasDiscoveries::Any).target_state_count(MOST).spawn_bfs().join();
    let found = checker.discovery(HOLDS).map(|path| {
        let steps = path.into_vec();
        let actions: Vec<usize> = steps.iter().filter_map(|(_, action)| *action).collect();
        let drive = steps.first().map(|(first, _)| trace::drive(&again, first, &actions));
        (drive, steps.last().and_then(|(last, _)| last.broken))
    });
    let found = found.and_then(|(drive, broken)| {
        let (drive, name) = (drive?, broken.map(|broken| again.name_of(broken))?);
        let text = trace::text(&again, &drive);
        Some(Found { name, drive, text })
    });
    let (states, transitions, depth) = (checker.unique_state_count(), checker.state_count(), checker.max_depth());
    let closed = transitions < MOST && found.is_none();
    let explorer = checker.model();
    let counts = &explorer.counts;
    let [cycles, pruned, held, twice] =
        [&counts.cycles, &counts.pruned, &counts.held, &counts.twice].map(|count| count.load(Ordering::Relaxed));
    let longest: Vec<Value> = explorer
        .of
        .promises
        .iter()
        .zip(&counts.longest)
        .map(|(promise, longest)| {
            let longest = longest.load(Ordering::Relaxed);
            json!({ "promise": promise.name, "longest_cycles": longest, "most_cycles": promise.most })
        })
        .collect();
    let seconds = started.elapsed().as_secs_f64();
    println!(
        "{name}: {vectors} vectors, {states} states, {transitions} transitions, {cycles} cycles, depth {depth}, \
         {pruned} into a long timer, {held} across one, {seconds:.1} s{}",
        if closed { "" } else { ", NOT CLOSED" }
    );
    for wait in &longest {
        println!("  {wait}");
    }
    let modes = explorer.coverage.modes();
    let json = json!({
        "name": name, "starts": starts, "vectors": vectors, "states": states, "transitions": transitions,
        "cycles": cycles, "depth": depth, "closed": closed, "pruned": pruned, "held": held, "made_twice": twice,
        "promises": longest, "checks": explorer.of.checks.iter().map(|check| check.name).collect::<Vec<_>>(),
        "modes": modes.iter().filter(|(_, seen)| **seen).map(|(mode, _)| mode).collect::<Vec<_>>(),
    });
    (Outcome { json, modes, size: (states, transitions), found }, again)
}

/// A slice: explorations that cover a list of modes together.
pub struct Slice {
    /// Its name.
    pub name: &'static str,
    /// What is explored.
    pub explorations: Vec<Exploration>,
    /// The groups whose modes must all be seen.
    pub covers: &'static [&'static str],
    /// Modes of them that can not be reached, and why.
    pub unreachable: &'static [(&'static str, &'static str)],
}

impl Slice {
    /// Explores all of it, writes the record, and fails on a finding, a mode that was not seen, or one that was seen
    /// though it is said to be out of reach.
    pub fn run(self) -> Result<(), Box<dyn Error>> {
        let mut modes: BTreeMap<String, bool> = BTreeMap::new();
        let (mut states, mut transitions) = (0, 0);
        let mut records = Vec::new();
        for exploration in self.explorations {
            let (outcome, explorer) = explore(exploration);
            if let Some(found) = &outcome.found {
                let file = crate::candump::write(self.name, &explorer, &found.drive)?;
                return Err(format!("{}\n{}\nas a log: {file}", found.name, found.text).into());
            }
            if outcome.json["closed"] != json!(true) {
                return Err(format!("{} is not closed after {MOST} transitions", outcome.json["name"]).into());
            }
            (states, transitions) = (states + outcome.size.0, transitions + outcome.size.1);
            for (mode, seen) in outcome.modes {
                *modes.entry(mode).or_default() |= seen;
            }
            records.push(outcome.json);
        }
        let of = |mode: &str| mode.split_once('=').map_or(mode, |(group, _)| group).to_owned();
        let wanted: BTreeMap<&String, &bool> =
            modes.iter().filter(|(mode, _)| self.covers.contains(&of(mode).as_str())).collect();
        let excused: BTreeSet<&str> = self.unreachable.iter().map(|(mode, _)| *mode).collect();
        let missing: Vec<&&String> =
            wanted.iter().filter(|(mode, seen)| !**seen && !excused.contains(mode.as_str())).map(|(mode, _)| mode).collect();
        let stale: Vec<&&str> = excused.iter().filter(|mode| modes.get(**mode) != Some(&false)).collect();
        let unknown: Vec<&&str> =
            self.covers.iter().filter(|group| !wanted.keys().any(|mode| of(mode) == ***group)).collect();
        let reached = wanted.values().filter(|seen| ***seen).count();
        println!("slice {}: {states} states, {transitions} transitions, {reached} modes", self.name);
        println!("  modes: {}", wanted.iter().filter(|(_, seen)| ***seen).map(|(mode, _)| mode.as_str()).collect::<Vec<_>>().join(" "));
        let record = json!({
            "slice": self.name, "states": states, "transitions": transitions, "explorations": records,
            "modes_covered": wanted.iter().filter(|(_, seen)| ***seen).map(|(mode, _)| mode).collect::<Vec<_>>(),
            "modes_unreachable": self.unreachable.iter().map(|(mode, why)| json!({ "mode": mode, "why": why })).collect::<Vec<_>>(),
        });
        std::fs::create_dir_all(folder())?;
        std::fs::write(folder().join(format!("{}.json", self.name)), format!("{record:#}\n"))?;
        assert!(missing.is_empty(), "never seen: {missing:?}");
        assert!(stale.is_empty(), "said to be out of reach, and seen (or no mode at all): {stale:?}");
        assert!(unknown.is_empty(), "no such group: {unknown:?}");
        Ok(())
    }
}
