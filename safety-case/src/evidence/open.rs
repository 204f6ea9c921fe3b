//! What is open: first what fails, then what was not run or is stale, then what is known and left.

use serde::Serialize;

use super::Collected;
use super::records::State;
use crate::analysis::Answer;
use crate::argument::Element;

/// Why it is open.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Why {
    /// The check fails.
    Finding,
    /// A record is not of the present sources.
    Stale,
    /// There is no record.
    NotRun,
    /// A record itself says that something is open.
    InRecord,
    /// A claim that nothing supports.
    Undeveloped,
    /// A doubt that is not answered, or only in part.
    Doubt,
    /// A known limitation or anomaly.
    Limitation,
    /// A method that is not, or only partly, used.
    Method,
    /// A risk that is left on purpose.
    Risk,
}

impl Why {
    /// Every one, with the words above its list.
    pub const ALL: [(Self, &'static str); 9] = [
        (Self::Finding, "Findings: the check fails"),
        (Self::Stale, "Stale: measured on other sources"),
        (Self::NotRun, "Not run: no record, or none at hand"),
        (Self::InRecord, "Open in a record"),
        (Self::Undeveloped, "Claims that nothing here supports"),
        (Self::Doubt, "Doubts that stand"),
        (Self::Limitation, "Known limitations and anomalies"),
        (Self::Method, "Methods not, or only partly, used"),
        (Self::Risk, "Risks that are left"),
    ];
}

/// One open item.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
pub struct Open {
    /// Why.
    pub why: Why,
    /// What it belongs to.
    pub place: String,
    /// What is open.
    pub text: String,
    /// What would end it, where that is known.
    pub cure: String,
}

/// Every open item, by its reason, in the order of the sources.
#[must_use]
pub fn open(collected: &Collected) -> Vec<Open> {
    let mut all = Vec::new();
    let mut add = |why, place: &str, text: String, cure: &str| {
        all.push(Open { why, place: place.to_owned(), text, cure: cure.to_owned() });
    };
    for finding in &collected.findings {
        add(Why::Finding, &finding.place, finding.message.clone(), finding.check);
    }
    for standing in &collected.standings {
        match &standing.state {
            State::Stale { changed } => {
                add(Why::Stale, &standing.title, format!("changed since: {}", changed.join(", ")), standing.command);
            }
            State::NotRun => add(Why::NotRun, &standing.title, standing.not_shown.to_owned(), standing.command),
            State::Fresh => {}
        }
        for text in &standing.open {
            add(Why::InRecord, &standing.title, text.clone(), "");
        }
    }
    for (module, id, node) in collected.argument.nodes() {
        if node.undeveloped {
            add(Why::Undeveloped, id, node.text.clone(), &module.name);
        }
        if Element::of(id) == Some(Element::CounterGoal)
            && !node.defeated
            && !answers(collected, node.challenges.as_deref())
        {
            add(Why::Doubt, id, node.text.clone(), node.challenges.as_deref().unwrap_or_default());
        }
    }
    for limitation in &collected.analysis.limitations {
        add(
            Why::Limitation,
            &limitation.id,
            format!("{}: {} {}", limitation.kind.word(), limitation.text, limitation.effect),
            &limitation.cure,
        );
    }
    for table in &collected.analysis.methods {
        for row in table.row.iter().filter(|row| matches!(row.answer, Answer::No | Answer::Partly)) {
            let answer = if row.answer == Answer::No { "no" } else { "partly" };
            add(Why::Method, &row.id, format!("{}, {}: {answer}", table.title, row.method), &row.place);
        }
    }
    for risk in &collected.analysis.risks {
        add(Why::Risk, &risk.id, risk.text.clone(), &risk.assumptions.join(", "));
    }
    // A stable sort: within a reason the order of the sources stays.
    all.sort_by_key(|open| open.why);
    all
}

/// Whether this is a counter-goal: what challenges one is an answer, and no doubt.
fn answers(collected: &Collected, challenged: Option<&str>) -> bool {
    challenged.is_some_and(|id| Element::of(id) == Some(Element::CounterGoal) && collected.argument.find(id).is_some())
}
