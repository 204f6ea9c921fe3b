//! What the record says of each listed harness today.

use std::collections::BTreeSet;
use std::fmt::{self, Display, Formatter};

use super::harness::{Checks, Harness, List};
use super::judge::{Verdict, judge};
use super::kani::counts;
use super::raw::Raw;
use super::record::{Place, Proof, Record};
use super::sources::Sources;

/// What the present sources and configuration are.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Present {
    /// Digests of the sources.
    pub sources: Sources,
    /// Digest of the sealed configuration.
    pub configuration: String,
}

/// What the record says of a harness.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum State {
    /// It is known not to hold as stated.
    Open(String),
    /// It never ran.
    NotRun,
    /// It ran on other sources, with another configuration, or decided less than it is to decide.
    Stale(Verdict),
    /// The raw result is missing, is another one, or does not say what the record says.
    Unsupported(String),
    /// It ran on what is here.
    Ran(Verdict),
}

impl State {
    /// The state of a harness.
    #[must_use]
    pub fn of(harness: &Harness, record: &Record, place: &Place, present: &Present) -> Self {
        if let Some(open) = &harness.open {
            return Self::Open(open.clone());
        }
        let Some(proof) = record.of(&harness.name) else { return Self::NotRun };
        // What decided its own checks only does not stand for a harness that is to decide all.
        let less = harness.checks == Checks::All && proof.decides == Checks::Own;
        if less || proof.sources != present.sources.of(&harness.name) || proof.configuration != present.configuration {
            return Self::Stale(proof.verdict.clone());
        }
        match supported(harness, proof, place) {
            Ok(()) => Self::Ran(proof.verdict.clone()),
            Err(why) => Self::Unsupported(why),
        }
    }

    /// Proved on what is here.
    #[must_use]
    pub fn is_proved(&self) -> bool {
        *self == Self::Ran(Verdict::Proved)
    }

    /// Neither proved nor declared open.
    #[must_use]
    pub fn is_bad(&self) -> bool {
        !self.is_proved() && !matches!(self, Self::Open(_))
    }
}

impl Display for State {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Open(why) => write!(f, "OPEN: {why}"),
            Self::NotRun => f.write_str("stated, NOT RUN"),
            Self::Stale(verdict) => write!(f, "STALE (was: {verdict})"),
            Self::Unsupported(why) => write!(f, "UNSUPPORTED: {why}"),
            Self::Ran(verdict) => write!(f, "{verdict}"),
        }
    }
}

/// Whether the raw result is there and says what the record says.
fn supported(harness: &Harness, proof: &Proof, place: &Place) -> Result<(), String> {
    let raw = Raw::load(&place.results, &harness.name).map_err(|error| error.to_string())?;
    if raw.digest() != proof.result {
        return Err("the raw result is not the recorded one".to_owned());
    }
    let export = raw.export().map_err(|error| error.to_string())?;
    let judged = judge(&export, &harness.id());
    if judged != proof.verdict {
        return Err(format!("the raw result says: {judged}"));
    }
    if counts(&export, &harness.id()) != Some((proof.checks, proof.covers)) {
        return Err("the raw result has other numbers of checks and covers".to_owned());
    }
    Ok(())
}

/// Where the list and the harnesses of the sources differ: a line for each.
#[must_use]
pub fn differences(list: &List, known: &BTreeSet<String>) -> Vec<String> {
    let listed: BTreeSet<String> = list.harness.iter().map(Harness::id).collect();
    let unlisted =
        known.difference(&listed).map(|id| format!("NOT LISTED: {id} is no harness of proofs/harnesses.toml"));
    let missing = listed.difference(known).map(|id| format!("MISSING: {id} is listed, and there is no such harness"));
    let mut lines: Vec<String> = unlisted.chain(missing).collect();
    if listed.len() != known.len() {
        lines.push(format!("{} harnesses are listed, {} are there", listed.len(), known.len()));
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::super::record::tests::{list, proof};
    use super::*;
    use serde_json::{Value, json};

    type Outcome = Result<(), Box<dyn std::error::Error>>;

    fn present() -> Present {
        Present { sources: Sources::same("s"), configuration: "c".to_owned() }
    }

    fn export(status: &str) -> Value {
        let check = |category: &str, status: &str| json!({"category": category, "status": status, "function": "f"});
        let mut checks = vec![check("assertion", "Success"); 4];
        checks.extend([check("assertion", status), check("cover", "Satisfied"), check("cover", "Satisfied")]);
        json!({"verification_results": {"results": [{"harness_id": "harness::m::a", "status": "Success", "checks": checks}]}})
    }

    #[test]
    fn a_record_counts_only_with_its_raw_result() -> Outcome {
        let folder = tempfile::tempdir()?;
        let place = Place::committed(folder.path());
        let list = list(&["a"])?;
        let harness = list.of("a").ok_or("a")?;
        let mut record = Record::default();
        let state = |record: &mut Record, result: &str, present: &Present| {
            record.put(Proof { result: result.to_owned(), ..proof("a", 3) }, &list);
            State::of(harness, record, &place, present)
        };
        assert!(matches!(state(&mut record, "r", &present()), State::Unsupported(_)), "no raw result");

        let raw = Raw::of(&export("Success"), folder.path());
        raw.save(&place.results, "a")?;
        assert_eq!(state(&mut record, &raw.digest(), &present()), State::Ran(Verdict::Proved));
        assert!(matches!(state(&mut record, "r", &present()), State::Unsupported(_)), "another digest");
        let others = [
            Present { sources: Sources::same("t"), ..present() },
            Present { configuration: "d".to_owned(), ..present() },
        ];
        for other in others {
            assert_eq!(state(&mut record, &raw.digest(), &other), State::Stale(Verdict::Proved));
        }

        record.put(Proof { result: raw.digest(), decides: Checks::Own, ..proof("a", 3) }, &list);
        assert_eq!(
            State::of(harness, &record, &place, &present()),
            State::Stale(Verdict::Proved),
            "its own checks only"
        );
        let own = Harness { checks: Checks::Own, ..harness.clone() };
        assert_eq!(State::of(&own, &record, &place, &present()), State::Ran(Verdict::Proved));

        let failed = Raw::of(&export("Failure"), folder.path());
        failed.save(&place.results, "a")?;
        assert!(
            matches!(state(&mut record, &failed.digest(), &present()), State::Unsupported(_)),
            "a record that lies"
        );
        Ok(())
    }

    #[test]
    fn only_proved_and_open_are_not_bad() -> Outcome {
        let list = list(&["a"])?;
        let mut harness = list.of("a").ok_or("a")?.clone();
        let place = Place::committed(std::path::Path::new("nowhere"));
        assert_eq!(State::of(&harness, &Record::default(), &place, &present()), State::NotRun);
        harness.open = Some("counterexample".to_owned());
        let open = State::of(&harness, &Record::default(), &place, &present());
        assert!(!open.is_bad() && !open.is_proved());
        let why = || "w".to_owned();
        for verdict in [Verdict::Failed(why()), Verdict::Vacuous(why()), Verdict::Undetermined(why())] {
            assert!(State::Ran(verdict).is_bad());
        }
        assert!(State::Stale(Verdict::Proved).is_bad() && State::NotRun.is_bad() && State::Unsupported(why()).is_bad());
        assert!(!State::Ran(Verdict::Proved).is_bad());
        Ok(())
    }

    #[test]
    fn the_list_and_the_harnesses_must_agree() -> Outcome {
        let list = list(&["a", "b"])?;
        let known = |names: &[&str]| names.iter().map(|name| format!("harness::m::{name}")).collect();
        assert!(differences(&list, &known(&["a", "b"])).is_empty());
        assert_eq!(differences(&list, &known(&["a"])).len(), 2);
        assert_eq!(differences(&list, &known(&["a", "c"])).len(), 2);
        assert_eq!(differences(&list, &known(&["a", "b", "c"])).len(), 2);
        Ok(())
    }
}
