//! The argument: why the goals are kept, in Goal Structuring Notation, in the YAML form that gsn2x reads.
//!
//! `safety-case/argument` has one file for each module. Beside what gsn2x knows, a solution names its `evidence` and says what
//! is `notShown` by it. [`load`] reads the folder, [`check`] finds what does not hold together, [`sheets`] draws it.

mod check;
mod draw;
mod load;
#[cfg(test)]
mod tests;

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

pub use check::{Finding, Rule, check};
pub use draw::{Sheet, sheets};
pub use load::{FOLDER, load};

/// What kind of element a node is: its id says so.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
pub enum Element {
    /// A claim.
    Goal,
    /// How a claim is divided.
    Strategy,
    /// What a claim stands on.
    Solution,
    /// Where a claim stands.
    Context,
    /// What is taken for granted.
    Assumption,
    /// Why a way of arguing is right.
    Justification,
    /// A doubt.
    CounterGoal,
    /// What a doubt, or its answer, stands on.
    CounterSolution,
}

impl Element {
    /// By the beginning of the id; the longer beginnings first.
    const PREFIXES: [(&'static str, Self); 8] = [
        ("CSn", Self::CounterSolution),
        ("CG", Self::CounterGoal),
        ("Sn", Self::Solution),
        ("G", Self::Goal),
        ("S", Self::Strategy),
        ("C", Self::Context),
        ("A", Self::Assumption),
        ("J", Self::Justification),
    ];

    /// The kind that an id says.
    #[must_use]
    pub fn of(id: &str) -> Option<Self> {
        Self::PREFIXES.iter().find(|(prefix, _)| id.starts_with(prefix)).map(|(_, element)| *element)
    }

    /// Whether it stands on evidence.
    #[must_use]
    pub const fn is_solution(self) -> bool {
        matches!(self, Self::Solution | Self::CounterSolution)
    }

    /// Whether it must be supported or be marked as undeveloped.
    #[must_use]
    pub const fn needs_support(self) -> bool {
        matches!(self, Self::Goal | Self::Strategy)
    }
}

/// One node.
#[derive(Clone, Debug, Default, Deserialize, Serialize)]
#[serde(deny_unknown_fields, rename_all = "camelCase")]
pub struct Node {
    /// What it says.
    #[serde(default)]
    pub text: String,
    /// What supports it.
    #[serde(default)]
    pub supported_by: Vec<String>,
    /// In which context it stands.
    #[serde(default)]
    pub in_context_of: Vec<String>,
    /// Nothing here supports it.
    #[serde(default)]
    pub undeveloped: bool,
    /// What it doubts.
    #[serde(default)]
    pub challenges: Option<String>,
    /// Its doubt is answered.
    #[serde(default)]
    pub defeated: bool,
    /// A file, from the root of the project.
    #[serde(default)]
    pub url: Option<String>,
    /// What it stands on, separated by semicolons.
    #[serde(default)]
    pub evidence: Option<String>,
    /// What it does not show.
    #[serde(default)]
    pub not_shown: Option<String>,
}

impl Node {
    /// The pieces of evidence that it names, as they are written.
    pub fn pieces(&self) -> impl Iterator<Item = &str> {
        self.evidence.iter().flat_map(|text| text.split(';')).map(str::trim).filter(|piece| !piece.is_empty())
    }
}

/// One file.
#[derive(Clone, Debug, Serialize)]
pub struct Module {
    /// Its file in the folder.
    pub file: String,
    /// Its name.
    pub name: String,
    /// What it is about.
    pub brief: String,
    /// The other files that it needs.
    pub uses: Vec<String>,
    /// Its nodes.
    pub nodes: BTreeMap<String, Node>,
}

/// All of it.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Argument {
    /// The modules, in the order of their files; `index.gsn.yaml` first.
    pub modules: Vec<Module>,
    /// Name and text of each file, for the words.
    #[serde(skip)]
    pub texts: Vec<(String, String)>,
}

impl Argument {
    /// Every node with its id and module.
    pub fn nodes(&self) -> impl Iterator<Item = (&Module, &str, &Node)> {
        self.modules.iter().flat_map(|module| module.nodes.iter().map(move |(id, node)| (module, id.as_str(), node)))
    }

    /// The node of this id, and its module.
    #[must_use]
    pub fn find(&self, id: &str) -> Option<(&Module, &Node)> {
        self.modules.iter().find_map(|module| module.nodes.get(id).map(|node| (module, node)))
    }
}
