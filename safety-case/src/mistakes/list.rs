//! The list of planted mistakes, `proofs/mistakes.toml`.

use std::collections::HashSet;
use std::path::Path;

use serde::Deserialize;

use super::change::{Change, source};
use crate::error::ToolError;
use crate::prove::{Harness, List as Harnesses};

/// Where the list stands.
pub const LIST: &str = "proofs/mistakes.toml";

/// A named mistake.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Mistake {
    /// Its name, unique.
    pub name: String,
    /// What would go wrong in the bus.
    pub what: String,
    /// The source file.
    pub file: String,
    /// What is replaced; occurs exactly once.
    pub find: String,
    /// By what.
    pub replace: String,
    /// The harnesses that must fail on it, in the order in which they are tried; one is enough.
    pub harness: Vec<String>,
    /// The assertion of theirs that is asked first, by its text: it takes less time than all. Without it, and where it does
    /// not fail, any.
    pub assertion: Option<String>,
    /// The requirements that it breaks.
    pub requirements: Vec<String>,
    /// Why no proof catches it, if it is known that none does. Such a mistake counts as a survivor.
    pub survives: Option<String>,
}

/// How the drawn ones are drawn.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Drawn {
    /// The seed.
    pub seed: u64,
    /// How many that compile.
    pub count: usize,
    /// The package whose list is drawn from.
    pub package: String,
    /// Longest time for one, in seconds; what is not caught by then has survived.
    pub within: u64,
}

/// Which harnesses to try on a drawn mistake in a file.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Module {
    /// The source file.
    pub file: String,
    /// The function; without it, any other in that file.
    pub function: Option<String>,
    /// In this order.
    pub harness: Vec<String>,
}

/// Why a drawn mistake survives.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Explained {
    /// As cargo-mutants names it.
    pub mutation: String,
    /// Why.
    pub why: String,
}

/// The list.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct List {
    /// How the drawn ones are drawn.
    pub drawn: Drawn,
    /// What is tried on the drawn ones.
    #[serde(default)]
    pub module: Vec<Module>,
    /// Survivors among the drawn ones.
    #[serde(default)]
    pub explained: Vec<Explained>,
    /// The named ones.
    pub mistake: Vec<Mistake>,
}

impl Mistake {
    /// The file with the mistake in it.
    ///
    /// # Errors
    /// The file cannot be read, or the mistake does not fit it.
    pub fn change(&self, root: &Path) -> Result<Change, ToolError> {
        let text = source(root, &self.file)?;
        Change::new(&self.file, &text, &self.find, &self.replace)
            .map_err(|message| ToolError::Form { path: root.join(LIST), message: format!("{}: {message}", self.name) })
    }
}

impl List {
    /// Reads the list.
    ///
    /// # Errors
    /// The file cannot be read, or is no list.
    pub fn load(root: &Path) -> Result<Self, ToolError> {
        let text = source(root, LIST)?;
        toml::from_str(&text).map_err(|error| ToolError::Form { path: root.join(LIST), message: error.to_string() })
    }

    /// The harnesses to try on a drawn mistake in this function of this file.
    #[must_use]
    pub fn harnesses(&self, file: &str, function: &str) -> &[String] {
        let fits =
            |module: &&Module| module.file == file && module.function.as_deref().is_none_or(|name| name == function);
        self.module.iter().find(fits).map_or(&[], |module| &module.harness)
    }

    /// What is wrong with the list itself: a name twice, no or an unknown harness, a mistake that does not fit its file.
    #[must_use]
    pub fn findings(&self, root: &Path, harnesses: &Harnesses) -> Vec<String> {
        let known: HashSet<&str> = harnesses.harness.iter().map(|harness| harness.name.as_str()).collect();
        let mut all = Vec::new();
        let mut seen = HashSet::new();
        for mistake in &self.mistake {
            let name = &mistake.name;
            if !seen.insert(name) {
                all.push(format!("{name} stands twice"));
            }
            if mistake.harness.is_empty() != mistake.survives.is_some() {
                all.push(format!("{name} needs a harness, or a reason why it survives, and not both"));
            }
            all.extend(mistake.change(root).err().map(|error| error.to_string()));
            let tried = harnesses.harness.iter().filter(|harness| mistake.harness.contains(&harness.name));
            let asserts = |text: &str| tried.clone().any(|harness| body(root, harness).contains(text));
            if let Some(text) = mistake.assertion.as_deref().filter(|text| !asserts(text)) {
                all.push(format!("{name}: none of its harnesses asserts {text}"));
            }
        }
        let named = self.mistake.iter().map(|mistake| (&mistake.name, &mistake.harness));
        let modules = self.module.iter().map(|module| (&module.file, &module.harness));
        for (name, tried) in named.chain(modules) {
            let unknown = tried.iter().filter(|harness| !known.contains(harness.as_str()));
            all.extend(unknown.map(|harness| format!("{name}: no harness {harness} in proofs/harnesses.toml")));
        }
        all
    }
}

/// What a harness does; nothing where its source cannot be read.
fn body(root: &Path, harness: &Harness) -> String {
    let file = root.join("proofs/src").join(harness.path.replace("::", "/")).with_extension("rs");
    let text = std::fs::read_to_string(file).unwrap_or_default();
    let after = text.split_once(&format!("fn {}()", harness.name)).map_or("", |(_, after)| after);
    after.split("\n}").next().unwrap_or_default().to_owned()
}

#[cfg(test)]
mod tests {
    use std::collections::HashSet;
    use std::path::Path;

    use super::List;
    use crate::analysis;
    use crate::prove::List as Harnesses;

    fn root() -> &'static Path {
        Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap_or(Path::new("."))
    }

    fn list() -> List {
        List::load(root()).unwrap_or_else(|error| unreachable!("{error}"))
    }

    #[test]
    fn every_mistake_fits_the_present_sources_and_names_a_harness() {
        let harnesses = Harnesses::load(root()).unwrap_or_else(|error| unreachable!("{error}"));
        assert_eq!(list().findings(root(), &harnesses), Vec::<String>::new());
    }

    #[test]
    fn there_are_at_least_forty_and_sixty() {
        let list = list();
        let named = list.mistake.iter().filter(|mistake| mistake.survives.is_none()).count();
        assert!(named >= 40, "{named}");
        assert!(list.drawn.count >= 60, "{}", list.drawn.count);
    }

    #[test]
    fn every_requirement_of_a_mistake_exists() {
        let folder = root().join("safety-case/analysis");
        let analysis = analysis::load(&folder).unwrap_or_else(|error| unreachable!("{error}"));
        let known: HashSet<&str> = analysis.requirements.iter().map(|requirement| requirement.id.as_str()).collect();
        for mistake in list().mistake {
            assert!(!mistake.requirements.is_empty(), "{}", mistake.name);
            for id in &mistake.requirements {
                assert!(known.contains(id.as_str()), "{}: no requirement {id}", mistake.name);
            }
        }
    }
}
