//! The list of harnesses, `proofs/harnesses.toml`.

use std::fmt::{self, Display, Formatter};
use std::path::Path;

use serde::{Deserialize, Serialize};

use crate::error::{ToolError, form, read};

/// Where the list stands.
pub const LIST: &str = "proofs/harnesses.toml";

/// Longest time that a solver gets, in seconds, unless the list says otherwise.
const TIMEOUT: u64 = 600;

/// Which solver decides. Always named: Kani's own default falls back silently where it is not there.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, clap::ValueEnum)]
#[serde(rename_all = "snake_case")]
pub enum Solver {
    /// Built into CBMC.
    #[default]
    Minisat,
    /// A program of its own.
    Kissat,
    /// Built into some CBMC.
    Cadical,
}

impl Display for Solver {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Minisat => "minisat",
            Self::Kissat => "kissat",
            Self::Cadical => "cadical",
        })
    }
}

/// Which checks a harness decides.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Checks {
    /// Every one that Kani and CBMC make: no panic, no overflow, no bad pointer, in all that the harness calls.
    #[default]
    All,
    /// Its own assertions and covers, those of the property functions, and every bound of a loop. That the shipped
    /// functions themselves neither panic nor overflow for the same arguments is then left to harnesses that decide all:
    /// once instead of in each, which takes a hundred times as long.
    Own,
}

/// One harness of the list.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Harness {
    /// Its name, unique.
    pub name: String,
    /// Its module.
    pub path: String,
    /// base, step, safety, reach.
    pub family: String,
    /// Rows of the specification that it proves.
    pub requirements: Vec<String>,
    /// `exhaustive` (`exhaustive for ...`), or `bounded` with the bound.
    pub extent: String,
    /// Why it is known not to hold as stated; it then counts as open, never as proved.
    pub open: Option<String>,
    /// Which solver decides it.
    #[serde(default)]
    pub solver: Solver,
    /// Longest time that the solver gets, in seconds.
    #[serde(default = "timeout")]
    pub timeout: u64,
    /// It replaces functions by `#[kani::stub]`.
    #[serde(default)]
    pub stubs: bool,
    /// Kani also looks whether each single assertion is reached. Costs about as much again; that a harness is not
    /// vacuous rests on its covers either way.
    #[serde(default)]
    pub reach_checks: bool,
    /// Which checks it decides.
    #[serde(default)]
    pub checks: Checks,
    /// `prove --quick` always runs it.
    #[serde(default)]
    pub key: bool,
    /// It multiplies by configured numbers: `prove --config` runs it again.
    #[serde(default)]
    pub configured: bool,
}

const fn timeout() -> u64 {
    TIMEOUT
}

impl Harness {
    /// One that stands in no list.
    #[must_use]
    pub fn apart(name: &str, path: &str, solver: Solver) -> Self {
        Self {
            name: name.to_owned(),
            path: path.to_owned(),
            family: String::new(),
            requirements: Vec::new(),
            extent: String::new(),
            open: None,
            solver,
            timeout: TIMEOUT,
            stubs: false,
            reach_checks: false,
            checks: Checks::All,
            key: false,
            configured: false,
        }
    }

    /// As Kani names it.
    #[must_use]
    pub fn id(&self) -> String {
        format!("{}::{}", self.path, self.name)
    }
}

/// The list.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct List {
    /// The harnesses.
    pub harness: Vec<Harness>,
}

impl List {
    /// Reads the list.
    ///
    /// # Errors
    /// The file cannot be read, or names a harness twice.
    pub fn load(root: &Path) -> Result<Self, ToolError> {
        let path = root.join(LIST);
        let list: Self = toml::from_str(&read(&path)?).map_err(|error| form(&path, &error))?;
        let mut names: Vec<_> = list.harness.iter().map(|harness| &harness.name).collect();
        names.sort();
        match names.windows(2).find(|pair| pair.first() == pair.last()) {
            Some(pair) => Err(form(&path, &format!("harness {pair:?} stands twice"))),
            None => Ok(list),
        }
    }

    /// The harness of that name.
    #[must_use]
    pub fn of(&self, name: &str) -> Option<&Harness> {
        self.harness.iter().find(|harness| harness.name == name)
    }

    /// Where it stands.
    #[must_use]
    pub fn place(&self, name: &str) -> Option<usize> {
        self.harness.iter().position(|harness| harness.name == name)
    }
}
