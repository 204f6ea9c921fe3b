//! What was counted, as JSON and back.
//!
//! ```text
//! { "schema": "supervise-disturb", "version": 1, "seed": 1, "shards": 1,
//!   "sources": { "shipped": "sha256", "configuration": "sha256", "bench": "sha256" },
//!   "wanted": { "runs": 4000, "days": 40, "metres": 5000 },
//!   "runs": { "clear road": { "runs": 400, "disturbed": 0, "warned": 0, "false_triggers": 0, "collisions": 0, "levels": 0 } },
//!   "run_causes": { "ServiceBrake Mitigation": 3 },
//!   "run_examples": { "ServiceBrake Mitigation": "run 17: a car cuts in, at 42.31 s" },
//!   "reaction": { "bus": { "3": 17 }, "wait": { "7": 12 }, "supervisor": { "0": 40 }, "all": { "10": 9 } },
//!   "load": [7000, 10000], "lost": 12,
//!   "days": 40, "metres": 200000, "seconds": 40000, "stops": 900, "hard": 3, "collisions": 0, "warnings": 200,
//!   "pieces": { "stop": 300 }, "levels": { "1": 10 },
//!   "causes": { "queue": { "ServiceBrake Mitigation": 3 } },
//!   "cases": { "queue, ServiceBrake Mitigation": [ "day 3 at 812.4 s: 24.1 km/h, gap 9.2 m, closing 6.7 m/s, braking 1.1 m/s²" ] } }
//! ```
//! `reaction`: how often each part took so many whole ms. `load`: time for which the bus was busy, and was there, in ms.
//! `disturbed`: runs with an intervention on any channel but the warnings; `warned`: runs with one on the warnings.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

/// Digests of all that a campaign depends on.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Sources {
    /// The shipped sources.
    pub shipped: String,
    /// The configuration.
    pub configuration: String,
    /// Bus, driver, road, main controller, disturbance.
    pub bench: String,
}

/// What was asked for, all parts together.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Wanted {
    /// Runs.
    pub runs: u64,
    /// Days ...
    pub days: u64,
    /// ... of so many m each.
    pub metres: u64,
}

/// Runs of one kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Runs {
    /// How many.
    pub runs: u64,
    /// With an intervention that moves the bus.
    pub disturbed: u64,
    /// With an intervention on the warnings.
    pub warned: u64,
    /// In which a level began without a cause.
    pub false_triggers: u64,
    /// In which the gap was used up.
    pub collisions: u64,
    /// In which a level began.
    pub levels: u64,
}

impl Runs {
    fn add(&mut self, other: &Self) {
        self.runs += other.runs;
        self.disturbed += other.disturbed;
        self.warned += other.warned;
        self.false_triggers += other.false_triggers;
        self.collisions += other.collisions;
        self.levels += other.levels;
    }
}

/// How often something took so many ms.
pub type Times = BTreeMap<u64, u64>;

/// Reactions, part by part.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Reactions {
    /// On the bus.
    pub bus: Times,
    /// Until the next cycle.
    pub wait: Times,
    /// In the supervisor.
    pub supervisor: Times,
    /// All of it.
    pub all: Times,
}

/// What was counted.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Tally {
    /// `supervise-disturb`.
    pub schema: String,
    /// Version of this layout.
    pub version: u32,
    /// The seed.
    pub seed: u64,
    /// Into how many parts it was divided.
    pub shards: usize,
    /// What it depends on.
    pub sources: Sources,
    /// What was asked for.
    pub wanted: Wanted,
    /// Runs by kind.
    pub runs: BTreeMap<String, Runs>,
    /// Interventions in runs by channel and reason.
    pub run_causes: BTreeMap<String, u64>,
    /// The first run of each.
    pub run_examples: BTreeMap<String, String>,
    /// The first runs that ended in a collision, and in which a level began without a cause, by their numbers.
    #[serde(default)]
    pub run_numbers: BTreeMap<String, Vec<u64>>,
    /// Reactions.
    pub reaction: Reactions,
    /// Time for which the bus was busy, and was there, in ms.
    pub load: [u64; 2],
    /// Frames that nobody read.
    pub lost: u64,
    /// Days driven.
    pub days: u64,
    /// The way in m.
    pub metres: u64,
    /// The time in s.
    pub seconds: u64,
    /// How often the bus came to rest.
    pub stops: u64,
    /// Of these, with more than 2 m/s² by the driver.
    pub hard: u64,
    /// The driver of the model ran into something.
    pub collisions: u64,
    /// How often a collision warning came on.
    pub warnings: u64,
    /// Pieces of the days.
    pub pieces: BTreeMap<String, u64>,
    /// Levels that began, by the highest that was reached.
    pub levels: BTreeMap<String, u64>,
    /// Interventions by piece of the day, channel and reason.
    pub causes: BTreeMap<String, BTreeMap<String, u64>>,
    /// The first of each.
    pub cases: BTreeMap<String, Vec<String>>,
}

/// The schema of the document.
pub const SCHEMA: &str = "supervise-disturb";
/// So many cases of each are kept.
pub const CASES: usize = 3;
/// So many numbers of runs are kept.
pub const NUMBERS: usize = 12;

/// Adds the counts of one to the other.
fn add<K: Ord + Clone>(to: &mut BTreeMap<K, u64>, from: &BTreeMap<K, u64>) {
    for (key, count) in from {
        *to.entry(key.clone()).or_default() += count;
    }
}

impl Tally {
    /// Reads a document.
    ///
    /// # Errors
    /// It is none.
    pub fn read(text: &str) -> Result<Self, String> {
        let tally: Self = serde_json::from_str(text).map_err(|error| error.to_string())?;
        if tally.schema == SCHEMA && tally.version == 1 {
            Ok(tally)
        } else {
            Err(format!("is {} {}, not {SCHEMA} 1", tally.schema, tally.version))
        }
    }

    /// The document.
    ///
    /// # Errors
    /// If a value has no JSON.
    pub fn write(&self) -> Result<String, serde_json::Error> {
        Ok(format!("{}\n", serde_json::to_string_pretty(self)?))
    }

    /// Adds what another one has counted; seed, sources and what was asked for stay.
    pub fn add(&mut self, other: &Self) {
        for (kind, theirs) in &other.runs {
            self.runs.entry(kind.clone()).or_default().add(theirs);
        }
        add(&mut self.run_causes, &other.run_causes);
        for (cause, example) in &other.run_examples {
            let ours = self.run_examples.entry(cause.clone()).or_insert_with(|| example.clone());
            if first(example) < first(ours) {
                ours.clone_from(example);
            }
        }
        for (what, numbers) in &other.run_numbers {
            let ours = self.run_numbers.entry(what.clone()).or_default();
            ours.extend(numbers);
            ours.sort_unstable();
            ours.truncate(NUMBERS);
        }
        add(&mut self.reaction.bus, &other.reaction.bus);
        add(&mut self.reaction.wait, &other.reaction.wait);
        add(&mut self.reaction.supervisor, &other.reaction.supervisor);
        add(&mut self.reaction.all, &other.reaction.all);
        for (ours, theirs) in self.load.iter_mut().zip(other.load) {
            *ours += theirs;
        }
        self.lost += other.lost;
        self.days += other.days;
        self.metres += other.metres;
        self.seconds += other.seconds;
        self.stops += other.stops;
        self.hard += other.hard;
        self.collisions += other.collisions;
        self.warnings += other.warnings;
        add(&mut self.pieces, &other.pieces);
        add(&mut self.levels, &other.levels);
        for (piece, causes) in &other.causes {
            add(self.causes.entry(piece.clone()).or_default(), causes);
        }
        for (key, cases) in &other.cases {
            let ours = self.cases.entry(key.clone()).or_default();
            ours.extend(cases.iter().cloned());
            ours.sort_by_key(|case| first(case));
            ours.truncate(CASES);
        }
    }

    /// The whole out of its parts.
    ///
    /// # Errors
    /// They do not belong together, or one is missing or twice there.
    pub fn merge(parts: &[Self]) -> Result<Self, String> {
        let (head, rest) = parts.split_first().ok_or("nothing to merge")?;
        if head.shards != parts.len() {
            return Err(format!("{} of {} parts", parts.len(), head.shards));
        }
        let mut whole = head.clone();
        for part in rest {
            let same = part.seed == whole.seed
                && part.shards == whole.shards
                && part.sources == whole.sources
                && part.wanted == whole.wanted;
            if !same {
                return Err("the parts are not of one campaign: seed, sources or what was asked for differ".to_owned());
            }
            whole.add(part);
        }
        let runs: u64 = whole.runs.values().map(|runs| runs.runs).sum();
        if runs != whole.wanted.runs || whole.days != whole.wanted.days {
            return Err(format!(
                "{runs} runs and {} days of {} and {}",
                whole.days, whole.wanted.runs, whole.wanted.days
            ));
        }
        whole.shards = 1;
        Ok(whole)
    }

    /// All runs together.
    #[must_use]
    pub fn all_runs(&self) -> Runs {
        let mut all = Runs::default();
        for kind in self.runs.values() {
            all.add(kind);
        }
        all
    }

    /// Interventions on the days by channel and reason.
    #[must_use]
    pub fn all_causes(&self) -> BTreeMap<String, u64> {
        let mut all = BTreeMap::new();
        self.causes.values().for_each(|causes| add(&mut all, causes));
        all
    }
}

/// The number that a case begins with: "run 17", "day 3".
fn first(case: &str) -> u64 {
    case.split([' ', ':', ',']).nth(1).and_then(|number| number.parse().ok()).unwrap_or(u64::MAX)
}

/// The value below which this share of all lies.
#[must_use]
pub fn quantile(times: &Times, percent: u64) -> Option<u64> {
    let all: u64 = times.values().sum();
    let mut rest = (all * percent).div_ceil(100).max(1);
    for (value, count) in times {
        if *count >= rest {
            return Some(*value);
        }
        rest -= count;
    }
    None
}

/// The mean of all.
#[must_use]
pub fn mean(times: &Times) -> Option<f64> {
    let all: u64 = times.values().sum();
    let sum: u64 = times.iter().map(|(value, count)| value * count).sum();
    (all > 0).then(|| crate::number::float(sum) / crate::number::float(all))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn part(runs: u64, days: u64) -> Tally {
        let counted = Runs { runs, disturbed: 1, ..Runs::default() };
        let example = |number: u64| format!("run {number}: clear road");
        Tally {
            schema: SCHEMA.to_owned(),
            version: 1,
            shards: 2,
            wanted: Wanted { runs: 5, days: 3, metres: 100 },
            runs: [("clear road".to_owned(), counted)].into(),
            run_examples: [("Gear Selector".to_owned(), example(runs))].into(),
            run_numbers: [("collision".to_owned(), (0_u64..12).map(|number| 10 * number + runs).collect())].into(),
            cases: [("queue".to_owned(), vec![format!("day {days}: x"), format!("day {}: y", days + 9)])].into(),
            days,
            ..Tally::default()
        }
    }

    #[test]
    fn parts_make_the_whole_and_nothing_else_does() -> Result<(), String> {
        let (one, two) = (part(2, 1), part(3, 2));
        let whole = Tally::merge(&[one.clone(), two.clone()])?;
        assert_eq!((whole.all_runs().runs, whole.all_runs().disturbed, whole.days, whole.shards), (5, 2, 3, 1));
        assert_eq!(whole.run_examples.values().next().map(String::as_str), Some("run 2: clear road"));
        assert_eq!(whole.cases["queue"], ["day 1: x", "day 2: x", "day 10: y"]);
        let numbers = [2, 3, 12, 13, 22, 23, 32, 33, 42, 43, 52, 53];
        assert_eq!(whole.run_numbers["collision"], numbers, "the first of both parts");
        let turned = Tally::merge(&[two.clone(), one.clone()])?;
        assert_eq!((turned.cases, turned.run_numbers), (whole.cases.clone(), whole.run_numbers.clone()));
        assert!(Tally::merge(std::slice::from_ref(&one)).is_err_and(|error| error.contains("1 of 2")));
        assert!(Tally::merge(&[one.clone(), one.clone()]).is_err_and(|error| error.contains("4 runs")));
        let other = Tally { seed: 9, ..two };
        assert!(Tally::merge(&[one.clone(), other]).is_err_and(|error| error.contains("one campaign")));
        assert_eq!(Tally::read(&whole.write().map_err(|error| error.to_string())?)?, whole);
        assert!(Tally::read("{}").is_err());
        Ok(())
    }

    #[test]
    fn quantiles_are_of_all_that_was_counted() {
        let times: Times = [(0, 50), (10, 49), (90, 1)].into();
        assert_eq!([50, 51, 99, 100].map(|percent| quantile(&times, percent)), [Some(0), Some(10), Some(10), Some(90)]);
        assert_eq!((quantile(&Times::new(), 50), mean(&Times::new())), (None, None));
        assert!(mean(&times).is_some_and(|mean| (mean - 5.8).abs() < 1e-9));
    }
}
