//! The table: a row for each requirement.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use serde::Serialize;

use super::TraceError;
use super::id::Id;
use super::scan::{Kind, Place, Scan, Tag};
use crate::analysis::{Analysis, Method, Requirement};
use crate::prove::{Harness, List, RECORD, Record, Sources, Verdict};

/// The greatest work package that must be complete.
const LAST_PACKAGE: u8 = 2;
/// Where the harnesses are listed.
pub const HARNESSES: &str = "proofs/harnesses.toml";

/// An item that carries a requirement.
#[derive(Clone, Debug, Serialize)]
pub struct Carrier {
    /// Where.
    #[serde(flatten)]
    pub place: Place,
    /// It names the group, not the demand.
    pub by_group: bool,
}

/// A harness that proves a requirement, or shall.
#[derive(Clone, Debug, Serialize)]
pub struct Harnessed {
    /// Where: its function if it is there, else its entry.
    #[serde(flatten)]
    pub place: Place,
    /// The record says that it is proved.
    pub proved: bool,
    /// What the record says, in words.
    pub verdict: String,
}

/// What is there for a requirement.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Status {
    /// Code, and a test, a check or a proof.
    Covered,
    /// Code; its methods are analysis and review, which nothing here can see.
    ByReview,
    /// Something is missing.
    Orphan,
    /// Of a later work package.
    Exempt,
}

/// A requirement and everything that carries its id.
#[derive(Debug, Serialize)]
pub struct Row {
    /// Its id.
    pub id: String,
    /// The demand.
    pub text: String,
    /// Where it comes from.
    pub source: String,
    /// Its work package.
    pub package: u8,
    /// How it shall be verified.
    pub method: Vec<Method>,
    /// Where it stands.
    pub place: Place,
    /// Items that implement it.
    pub code: Vec<Carrier>,
    /// Why no item implements it, where that is so.
    pub without_code: Option<String>,
    /// Rows of the table of limits.
    pub limits: Vec<Place>,
    /// Properties.
    pub properties: Vec<Place>,
    /// Harnesses.
    pub harnesses: Vec<Harnessed>,
    /// Tests.
    pub tests: Vec<Place>,
    /// Steps of `.ci/run`.
    pub checks: Vec<Place>,
    /// What is there.
    pub status: Status,
}

impl Row {
    /// An item implements it, or none needs to.
    #[must_use]
    pub fn has_code(&self) -> bool {
        !self.code.is_empty() || self.without_code.is_some()
    }
    /// A test, a check or a recorded proof shows it.
    #[must_use]
    pub fn has_evidence(&self) -> bool {
        !self.tests.is_empty() || !self.checks.is_empty() || self.is_proved()
    }
    /// At least one harness is recorded as proved.
    #[must_use]
    pub fn is_proved(&self) -> bool {
        self.harnesses.iter().any(|harness| harness.proved)
    }
    /// A proof is planned and there is none.
    #[must_use]
    pub fn awaits_proof(&self) -> bool {
        self.method.contains(&Method::Proof) && !self.is_proved()
    }
    /// A machine shall show it.
    fn needs_evidence(&self) -> bool {
        self.method.iter().any(|method| matches!(method, Method::Proof | Method::Test | Method::Campaign))
    }

    fn judged(mut self) -> Self {
        self.status = match (self.has_code(), self.has_evidence()) {
            _ if self.package > LAST_PACKAGE => Status::Exempt,
            (true, true) => Status::Covered,
            (true, false) if !self.needs_evidence() => Status::ByReview,
            _ => Status::Orphan,
        };
        self
    }
}

/// How much of the table is filled.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Summary {
    /// Requirements.
    pub requirements: usize,
    /// With code and a test, a check or a proof.
    pub covered: usize,
    /// With code; analysis and review are their only methods.
    pub by_review: usize,
    /// Something is missing.
    pub orphans: usize,
    /// Of a later package.
    pub exempt: usize,
    /// With code that names the demand itself.
    pub code_by_demand: usize,
    /// With code that names its group only.
    pub code_by_group: usize,
    /// For which no item needs to name it.
    pub without_code: usize,
    /// With a test.
    pub tested: usize,
    /// With a harness that is recorded as proved.
    pub proved: usize,
    /// Proof is planned, and there is none.
    pub planned_not_proved: usize,
}

impl Summary {
    /// Of these rows.
    #[must_use]
    pub fn of(rows: &[Row]) -> Self {
        let count = |which: &dyn Fn(&&Row) -> bool| rows.iter().filter(which).count();
        let by_demand = |row: &&Row| row.code.iter().any(|carrier| !carrier.by_group);
        Self {
            requirements: rows.len(),
            covered: count(&|row| row.status == Status::Covered),
            by_review: count(&|row| row.status == Status::ByReview),
            orphans: count(&|row| row.status == Status::Orphan),
            exempt: count(&|row| row.status == Status::Exempt),
            code_by_demand: count(&by_demand),
            code_by_group: count(&|row| !row.code.is_empty() && !by_demand(row)),
            without_code: count(&|row| row.without_code.is_some()),
            tested: count(&|row| !row.tests.is_empty()),
            proved: count(&|row| row.is_proved()),
            planned_not_proved: count(&|row| row.awaits_proof()),
        }
    }
}

/// The listed harnesses and what the record says of them.
#[derive(Debug, Default)]
pub struct Proofs {
    /// Entry, its line, proved, the verdict in words.
    pub listed: Vec<(Harness, usize, bool, String)>,
}

impl Proofs {
    /// Reads the list and the record; absent ones are empty.
    pub fn load(root: &Path) -> Result<Self, TraceError> {
        let path = root.join(HARNESSES);
        if !path.exists() {
            return Ok(Self::default());
        }
        let text = fs::read_to_string(&path).map_err(|error| TraceError::File { path, error })?;
        let list = List::load(root)?;
        let record = Record::load(&root.join(RECORD))?;
        let sources = if record.proofs.is_empty() { None } else { Some(Sources::load(root)?) };
        let listed = list.harness.into_iter().map(|harness| {
            let (proved, words) = verdict(&harness, &record, sources.as_ref());
            let line = line_with(&text, &format!("name = \"{}\"", harness.name));
            (harness, line, proved, words)
        });
        Ok(Self { listed: listed.collect() })
    }
}

fn verdict(harness: &Harness, record: &Record, sources: Option<&Sources>) -> (bool, String) {
    if let Some(open) = &harness.open {
        return (false, format!("open: {open}"));
    }
    let Some(proof) = record.of(&harness.name) else { return (false, "not run".to_owned()) };
    let words = match &proof.verdict {
        Verdict::Proved => "proved".to_owned(),
        Verdict::Failed(why) => format!("failed: {why}"),
        Verdict::Vacuous(why) => format!("vacuous: {why}"),
        Verdict::Undetermined(why) => format!("undetermined: {why}"),
    };
    let age = if sources.is_some_and(|sources| proof.sources == sources.of(&harness.name)) {
        ""
    } else {
        ", on older sources"
    };
    (proof.verdict == Verdict::Proved, words + age)
}

/// The first line that contains the words, from 1.
fn line_with(text: &str, words: &str) -> usize {
    text.lines().position(|line| line.contains(words)).map_or(0, |line| line + 1)
}

/// Every row.
pub fn rows(root: &Path, analysis: &Analysis, scan: &Scan, proofs: &Proofs) -> Vec<Row> {
    let mut by_id: BTreeMap<&Id, Vec<&Tag>> = BTreeMap::new();
    for tag in &scan.tags {
        by_id.entry(&tag.id).or_default().push(tag);
    }
    // Groups of which code names a demand: there the group itself counts no more.
    let is_code = |tag: &&Tag| tag.kind == Kind::Code && tag.id.letter.is_some();
    let finer: BTreeSet<Id> = scan.tags.iter().filter(is_code).map(|tag| tag.id.group()).collect();
    analysis
        .requirements
        .iter()
        .map(|requirement| row(root, analysis, requirement, &by_id, &finer, scan, proofs))
        .collect()
}

fn row(
    root: &Path,
    analysis: &Analysis,
    requirement: &Requirement,
    by_id: &BTreeMap<&Id, Vec<&Tag>>,
    finer: &BTreeSet<Id>,
    scan: &Scan,
    proofs: &Proofs,
) -> Row {
    let id = Id::parse(&requirement.id);
    let tags = |id: Option<&Id>, kind| {
        let found = id.and_then(|id| by_id.get(id)).into_iter().flatten();
        let mut places: Vec<Place> = found.filter(|tag| tag.kind == kind).map(|tag| tag.place.clone()).collect();
        places.sort();
        places.dedup();
        places
    };
    let group = id.as_ref().map(Id::group).filter(|group| !finer.contains(group));
    let own = tags(id.as_ref(), Kind::Code).into_iter().map(|place| Carrier { place, by_group: false });
    let shared = tags(group.as_ref(), Kind::Code).into_iter().map(|place| Carrier { place, by_group: true });
    let harnesses = (proofs.listed.iter()).filter(|(harness, ..)| harness.requirements.contains(&requirement.id)).map(
        |(harness, line, proved, verdict)| {
            let function = scan.harnesses.iter().find(|place| place.item == harness.name).cloned();
            let entry = || Place { file: HARNESSES.to_owned(), line: *line, item: harness.name.clone() };
            Harnessed { place: function.unwrap_or_else(entry), proved: *proved, verdict: verdict.clone() }
        },
    );
    Row {
        id: requirement.id.clone(),
        text: requirement.text.clone(),
        source: requirement.source.clone(),
        package: requirement.package,
        method: requirement.method.clone(),
        place: defined(root, analysis, &requirement.id),
        code: own.chain(shared).collect(),
        without_code: requirement.without_code.clone(),
        limits: tags(id.as_ref(), Kind::Limit),
        properties: tags(id.as_ref(), Kind::Property),
        harnesses: harnesses.collect(),
        tests: tags(id.as_ref(), Kind::Test),
        checks: tags(id.as_ref(), Kind::Check),
        status: Status::Orphan,
    }
    .judged()
}

/// Where the analysis defines an id.
fn defined(root: &Path, analysis: &Analysis, id: &str) -> Place {
    let entry = format!("id = \"{id}\"");
    let found = analysis.texts.iter().find_map(|(file, text)| {
        let line = text.lines().position(|line| line.trim() == entry)?;
        let file = Path::new(file).strip_prefix(root).unwrap_or(Path::new(file)).to_string_lossy().replace('\\', "/");
        Some(Place { file, line: line + 1, item: id.to_owned() })
    });
    found.unwrap_or_else(|| Place { file: "safety-case/analysis".to_owned(), line: 0, item: id.to_owned() })
}
