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
const MOST: usize = 2_000_000;

/// What an exploration showed.
pub struct Outcome {
    /// As it stands in the record.
    pub json: Value,
    /// Modes, and whether each was seen.
    pub modes: BTreeMap<String, bool>,
    /// States, transitions.
    pub size: (usize, usize),
    /// Every node was expanded.
    pub closed: bool,
    /// What was found, and the shortest way there.
    pub found: Option<Found>,
}

/// A finding.
pub struct Found {
    /// How many actions lead there.
    pub actions: usize,
    /// What was broken.
    pub name: &'static str,
    /// The way there.
    pub drive: Drive,
    /// The same for people.
    pub text: String,
}

/// Where records and counterexamples go.
pub fn folder() -> PathBuf {
    PathBuf::from(env!("CARGO_TARGET_TMPDIR")).with_file_name("exploration")
}

/// Explores, breadth first, by one thread: the first way found to a finding is a shortest one.
pub fn explore(of: Exploration) -> (Outcome, Explorer) {
    explore_to(of, 0)
}

/// The same, no deeper than so many nodes; 0 is as deep as it goes.
pub fn explore_to(of: Exploration, depth: usize) -> (Outcome, Explorer) {
    let started = Instant::now();
    let (name, vectors, starts) = (of.name, of.vectors.len(), of.starts.len());
    let again = Explorer::new(of.clone());
    let builder = Explorer::new(of).checker().finish_when(HasDiscoveries::Any).target_state_count(MOST);
    let checker = builder.target_max_depth(depth).spawn_bfs().join();
    let found = checker.discovery(HOLDS).map(|path| {
        let steps = path.into_vec();
        let actions: Vec<usize> = steps.iter().filter_map(|(_, action)| *action).collect();
        let drive = steps.first().map(|(first, _)| trace::drive(&again, first, &actions));
        (drive, steps.last().and_then(|(last, _)| last.broken), actions.len())
    });
    let found = found.and_then(|(drive, broken, actions)| {
        let (drive, name) = (drive?, broken.map(|broken| again.name_of(broken))?);
        let text = trace::text(&again, &drive);
        Some(Found { actions, name, drive, text })
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
        "cycles": cycles, "depth": depth, "closed": closed, "pruned": pruned, "held": held, "cycles_run_twice": twice,
        "promises": longest, "checks": explorer.of.checks.iter().map(|check| check.name).collect::<Vec<_>>(),
        "modes": modes.iter().filter(|(_, seen)| **seen).map(|(mode, _)| mode).collect::<Vec<_>>(),
    });
    (Outcome { json, modes, size: (states, transitions), closed, found }, again)
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
            if !outcome.closed {
                return Err(format!("{} is not closed after {MOST} transitions", outcome.json["name"]).into());
            }
            (states, transitions) = (states + outcome.size.0, transitions + outcome.size.1);
            for (mode, seen) in outcome.modes {
                *modes.entry(mode).or_default() |= seen;
            }
            records.push(outcome.json);
        }
        let group = |mode: &str| mode.split_once('=').map_or("", |(group, _)| group).to_owned();
        modes.retain(|mode, _| self.covers.contains(&group(mode).as_str()));
        let excused: BTreeSet<&str> = self.unreachable.iter().map(|(mode, _)| *mode).collect();
        let covered: Vec<&String> = modes.iter().filter(|(_, seen)| **seen).map(|(mode, _)| mode).collect();
        let missing: Vec<&String> = modes
            .iter()
            .filter(|(mode, seen)| !**seen && !excused.contains(mode.as_str()))
            .map(|(mode, _)| mode)
            .collect();
        let stale: Vec<&&str> = excused.iter().filter(|mode| modes.get(**mode) != Some(&false)).collect();
        let unknown: Vec<&&str> =
            self.covers.iter().filter(|name| !modes.keys().any(|mode| group(mode) == **name)).collect();
        println!("slice {}: {states} states, {transitions} transitions, {} modes:", self.name, covered.len());
        println!("  {}", covered.iter().map(|mode| mode.as_str()).collect::<Vec<_>>().join(" "));
        let record = json!({
            "slice": self.name, "states": states, "transitions": transitions, "explorations": records,
            "modes_covered": covered,
            "modes_out_of_reach": self.unreachable.iter().map(|(mode, why)| json!({ "mode": mode, "why": why })).collect::<Vec<_>>(),
        });
        std::fs::create_dir_all(folder())?;
        std::fs::write(folder().join(format!("{}.json", self.name)), format!("{record:#}\n"))?;
        for (what, modes) in
            [("never seen", format!("{missing:?}")), ("said to be out of reach, and seen", format!("{stale:?}"))]
        {
            if modes != "[]" {
                return Err(format!("slice {}: {what}: {modes}", self.name).into());
            }
        }
        if unknown.is_empty() { Ok(()) } else { Err(format!("no such modes: {unknown:?}").into()) }
    }
}
