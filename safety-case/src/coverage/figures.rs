//! The figures, and what is open.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::plan::{Kind, Place, Plan};
use super::run::Seen;

/// So many of so many.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Count {
    /// Covered.
    pub covered: usize,
    /// There are.
    pub of: usize,
}

impl Count {
    fn add(&mut self, covered: bool) {
        self.covered = self.covered.saturating_add(usize::from(covered));
        self.of = self.of.saturating_add(1);
    }
}

impl std::fmt::Display for Count {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}/{}", self.covered, self.of)
    }
}

/// Of a function, a file, or everything.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Figures {
    /// Statements that ran.
    pub statements: Count,
    /// Branches that were taken.
    pub branches: Count,
    /// Decisions that came to true and to false.
    pub decisions: Count,
    /// Conditions whose independent effect is shown, by masking.
    pub conditions: Count,
    /// The same by unique cause.
    pub unique: Count,
}

/// Something that no test covers.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Open {
    /// Its file.
    pub file: String,
    /// Its line.
    pub line: usize,
    /// Its function.
    pub function: String,
    /// What it is.
    pub kind: Kind,
    /// How it reads.
    pub text: String,
    /// The decision that a condition belongs to.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub decision: Option<String>,
    /// The vectors that were seen of it.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub seen: Vec<String>,
}

impl Open {
    fn new(place: &Place, kind: Kind, text: &str) -> Self {
        let (file, function) = (place.file.clone(), place.function.clone());
        Self { file, line: place.line, function, kind, text: text.to_owned(), decision: None, seen: Vec::new() }
    }
}

impl std::fmt::Display for Open {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let kind = self.kind.word();
        write!(f, "{}:{} {}: {kind} `{}`", self.file, self.line, self.function, self.text)?;
        if let Some(decision) = &self.decision {
            write!(f, " of `{decision}`, seen {}", self.seen.join(", "))?;
        }
        Ok(())
    }
}

/// The figures of each function by file, and what is open, in the order of the sources.
#[must_use]
pub fn figures(plan: &Plan, seen: &Seen) -> (BTreeMap<String, BTreeMap<String, Figures>>, Vec<Open>) {
    let mut rows: BTreeMap<String, BTreeMap<String, Figures>> = BTreeMap::new();
    let mut open = Vec::new();
    let mut row = |place: &Place, change: &dyn Fn(&mut Figures)| {
        change(rows.entry(place.file.clone()).or_default().entry(place.function.clone()).or_default());
    };
    for (number, point) in plan.points.iter().enumerate() {
        let reached = seen.points.contains(&number);
        row(&point.place, &|figures| match point.kind {
            Kind::Statement => figures.statements.add(reached),
            Kind::Branch | Kind::Condition => figures.branches.add(reached),
        });
        if !reached {
            open.push(Open::new(&point.place, point.kind, &point.text));
        }
    }
    for (number, decision) in plan.decisions.iter().enumerate() {
        let vectors = seen.of(number);
        let came = |outcome| vectors.iter().any(|vector| vector.outcome == outcome);
        row(&decision.place, &|figures| figures.decisions.add(came(true) && came(false)));
        for (outcome, word) in [(true, "true"), (false, "false")] {
            if decision.branches {
                row(&decision.place, &|figures| figures.branches.add(came(outcome)));
                if !came(outcome) {
                    open.push(Open::new(&decision.place, Kind::Branch, &format!("{}: {word}", decision.text)));
                }
            }
        }
        let (masking, unique) = (decision.shown(&vectors), decision.shown_uniquely(&vectors));
        for (((line, text), shown), by_one) in decision.conditions.iter().zip(masking).zip(unique) {
            row(&decision.place, &|figures| {
                figures.conditions.add(shown);
                figures.unique.add(by_one);
            });
            if !shown {
                let letters = vectors.iter().map(|vector| decision.letters(vector)).collect();
                let place = Place { line: *line, ..decision.place.clone() };
                let open_one = Open::new(&place, Kind::Condition, text);
                open.push(Open { decision: Some(decision.text.clone()), seen: letters, ..open_one });
            }
        }
    }
    open.sort_by(|one, other| (&one.file, one.line, one.kind).cmp(&(&other.file, other.line, other.kind)));
    (rows, open)
}

impl Figures {
    /// All of these together.
    #[must_use]
    pub fn sum<'a>(of: impl IntoIterator<Item = &'a Self>) -> Self {
        let mut sum = Self::default();
        let add = |sum: &mut Count, count: Count| {
            sum.covered = sum.covered.saturating_add(count.covered);
            sum.of = sum.of.saturating_add(count.of);
        };
        for figures in of {
            add(&mut sum.statements, figures.statements);
            add(&mut sum.branches, figures.branches);
            add(&mut sum.decisions, figures.decisions);
            add(&mut sum.conditions, figures.conditions);
            add(&mut sum.unique, figures.unique);
        }
        sum
    }
}
