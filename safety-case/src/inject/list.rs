//! The faults of `analysis/faults.toml`, and what is expected of each. An error names file and line.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::fs;
use std::path::Path;

use serde::{Deserialize, Serialize};
use supervisor_tests::inject::campaign;
use supervisor_tests::inject::harm::{Ftti, Goal};
use supervisor_tests::inject::kind::{Kind, When};
use toml::Spanned;

use crate::analysis::{Analysis, AnalysisError, load};

/// The file, in the folder of the analysis.
pub const FILE: &str = "faults.toml";

/// Who fails.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Group {
    /// The main controller.
    Controller,
    /// The link from it.
    Frames,
    /// A sensor.
    Sensors,
    /// An actuator.
    Actuators,
    /// The supervisor's clock.
    Clock,
    /// The supervisor's memory.
    Memory,
    /// The supervisor's power.
    Power,
}

/// What is expected.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Expected {
    /// Where it would do harm, the supervisor sees it in time.
    Detected,
    /// It does no harm.
    Tolerated,
    /// It may do harm unseen: an assumption of use.
    Residual,
}

/// What a detection leads to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Effect {
    /// The harm does not come.
    Averted,
    /// It is reported; the harm may come.
    Reported,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    fault: Vec<Entry>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Entry {
    id: Spanned<String>,
    group: Group,
    what: Spanned<String>,
    inject: Spanned<String>,
    place: Spanned<String>,
    when: Spanned<String>,
    lasts_ms: Option<Spanned<[u32; 2]>>,
    goals: Vec<Spanned<String>>,
    expected: Spanned<Expected>,
    effect: Option<Effect>,
    assumption: Option<Spanned<String>>,
    reason: Spanned<String>,
    known: Option<String>,
}

/// A fault.
#[derive(Clone, Debug)]
pub struct Fault {
    /// What a run needs of it.
    pub run: campaign::Fault,
    /// Who fails.
    pub group: Group,
    /// What happens, for people.
    pub what: String,
    /// What is expected.
    pub expected: Expected,
    /// What a detection leads to.
    pub effect: Effect,
    /// The assumption of use that covers what the supervisor does not see.
    pub assumption: Option<String>,
    /// Why that is expected.
    pub reason: String,
    /// A finding that contradicts it and is not cured.
    pub known: Option<String>,
}

/// All faults, with the FTTI of the goals.
#[derive(Clone, Debug)]
pub struct List {
    /// In the order of the file.
    pub faults: Vec<Fault>,
    /// Every goal's FTTI.
    pub ftti: Ftti,
}

/// What is wrong with the list.
#[derive(Debug, thiserror::Error)]
pub enum ListError {
    /// The analysis cannot be read.
    #[error("{0}")]
    Analysis(#[from] AnalysisError),
    /// The file cannot be read.
    #[error("{file}: {error}")]
    File {
        /// Which.
        file: String,
        /// Why.
        error: std::io::Error,
    },
    /// An entry is wrong.
    #[error("{file}:{line}: {message}")]
    Entry {
        /// The file.
        file: String,
        /// The line, from 1.
        line: usize,
        /// What is wrong.
        message: String,
    },
}

impl List {
    /// Reads the faults of an analysis.
    ///
    /// # Errors
    /// The analysis or the file cannot be read, or an entry names what does not exist.
    pub fn load(folder: &Path) -> Result<Self, ListError> {
        let analysis = load(folder)?;
        let path = folder.join(FILE);
        let file = path.display().to_string();
        let text = fs::read_to_string(&path).map_err(|error| ListError::File { file: file.clone(), error })?;
        Self::parse(&file, &text, &analysis)
    }

    /// Reads the text of the file.
    ///
    /// # Errors
    /// As [`load`](Self::load).
    pub fn parse(file: &str, text: &str, analysis: &Analysis) -> Result<Self, ListError> {
        let place = Place { file, text };
        let parsed: File = toml::from_str(text)
            .map_err(|error| place.error(error.span().map_or(0, |span| span.start), error.message()))?;
        let ftti = ftti(analysis);
        let assumptions: BTreeSet<&str> = analysis.assumptions.iter().map(|entry| entry.id.as_str()).collect();
        let mut seen = BTreeSet::new();
        let mut faults = Vec::new();
        for entry in parsed.fault {
            if !seen.insert(entry.id.get_ref().clone()) {
                return Err(place.at(&entry.id, format!("{} is defined more than once", entry.id.get_ref())));
            }
            faults.push(fault(&place, entry, &ftti, &assumptions)?);
        }
        Ok(Self { faults, ftti })
    }

    /// The fault of this id.
    #[must_use]
    pub fn named(&self, id: &str) -> Option<&Fault> {
        self.faults.iter().find(|fault| fault.run.id == id)
    }
}

/// `SG-01` to 1.
fn goal(id: &str) -> Option<Goal> {
    id.strip_prefix("SG-")?.parse().ok().map(Goal)
}

fn ftti(analysis: &Analysis) -> Ftti {
    analysis.goals.iter().filter_map(|entry| Some((goal(&entry.id)?, entry.ftti_ms))).collect::<BTreeMap<_, _>>()
}

struct Place<'a> {
    file: &'a str,
    text: &'a str,
}

impl Place<'_> {
    fn error(&self, byte: usize, message: impl fmt::Display) -> ListError {
        let before = self.text.get(..byte).unwrap_or(self.text);
        let line = before.matches('\n').count().saturating_add(1);
        ListError::Entry { file: self.file.to_owned(), line, message: message.to_string() }
    }

    fn at<T>(&self, value: &Spanned<T>, message: impl fmt::Display) -> ListError {
        self.error(value.span().start, message)
    }
}

fn fault(place: &Place<'_>, entry: Entry, ftti: &Ftti, assumptions: &BTreeSet<&str>) -> Result<Fault, ListError> {
    let number = entry.id.get_ref().strip_prefix("FI-").filter(|number| number.len() >= 2);
    if number.is_none_or(|number| number.parse::<u16>().is_err()) {
        return Err(place.at(&entry.id, "an id has the form FI-07"));
    }
    for text in [&entry.what, &entry.reason] {
        if text.get_ref().trim().is_empty() {
            return Err(place.at(text, "is empty"));
        }
    }
    let kind = Kind::named(entry.inject.get_ref())
        .ok_or_else(|| place.at(&entry.inject, format!("no injector is called {}", entry.inject.get_ref())))?;
    if kind.place() != entry.place.get_ref() {
        return Err(place.at(&entry.place, format!("{} works in the {}", kind.name(), kind.place())));
    }
    let when = When::named(entry.when.get_ref())
        .ok_or_else(|| place.at(&entry.when, format!("nothing is called {}", entry.when.get_ref())))?;
    let lasts_ms = match &entry.lasts_ms {
        Some(span) => match span.get_ref() {
            [least, most] if *least > 0 && least <= most => Some((*least, *most)),
            _ => return Err(place.at(span, "least and greatest duration, both above 0")),
        },
        None => None,
    };
    let mut goals = Vec::new();
    for id in &entry.goals {
        let known = goal(id.get_ref()).filter(|goal| ftti.contains_key(goal));
        goals.push(known.ok_or_else(|| place.at(id, format!("no safety goal is called {}", id.get_ref())))?);
    }
    if goals.is_empty() {
        return Err(place.at(&entry.id, "endangers no safety goal"));
    }
    let expected = *entry.expected.get_ref();
    match (&entry.assumption, expected) {
        (Some(id), Expected::Residual) if !assumptions.contains(id.get_ref().as_str()) => {
            return Err(place.at(id, format!("no assumption of use is called {}", id.get_ref())));
        }
        (None, Expected::Residual) => return Err(place.at(&entry.expected, "residual, and no assumption of use")),
        (Some(id), Expected::Detected | Expected::Tolerated) => {
            return Err(place.at(id, "an assumption of use belongs to what is residual"));
        }
        (Some(_), Expected::Residual) | (None, Expected::Detected | Expected::Tolerated) => {}
    }
    let by_itself = expected == Expected::Detected && goals.contains(&Goal::OF_THE_SUPERVISOR);
    Ok(Fault {
        run: campaign::Fault { id: entry.id.into_inner(), kind, when, lasts_ms, goals, by_itself },
        group: entry.group,
        what: entry.what.into_inner(),
        expected,
        effect: entry.effect.unwrap_or(Effect::Averted),
        assumption: entry.assumption.map(Spanned::into_inner),
        reason: entry.reason.into_inner(),
        known: entry.known,
    })
}
