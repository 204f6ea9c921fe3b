//! Whether what the analysis and the argument call evidence is there, and whether every part of the supervisor has its failure modes.

use std::collections::BTreeSet;
use std::path::Path;

use super::Finding;
use super::records::{COMMITTED, MADE};
use crate::analysis::{Analysis, Evidence, Kind};
use crate::argument::Argument;
use crate::error::{ToolError, read};
use crate::mistakes;
use crate::prove;

const SCRIPT: &str = ".ci/run";

/// Everything that evidence may name.
#[derive(Debug)]
pub struct Names<'a> {
    root: &'a Path,
    harnesses: BTreeSet<String>,
    mistakes: BTreeSet<String>,
    steps: BTreeSet<String>,
    faults: &'a BTreeSet<String>,
}

impl<'a> Names<'a> {
    /// Reads the lists.
    ///
    /// # Errors
    /// A list cannot be read.
    pub fn load(root: &'a Path, analysis: &'a Analysis) -> Result<Self, ToolError> {
        let step =
            |line: &str| line.trim().strip_prefix("step \"").and_then(|rest| rest.split('"').next().map(str::to_owned));
        Ok(Self {
            root,
            harnesses: prove::List::load(root)?.harness.into_iter().map(|harness| harness.name).collect(),
            mistakes: mistakes::List::load(root)?.mistake.into_iter().map(|mistake| mistake.name).collect(),
            steps: read(&root.join(SCRIPT))?.lines().filter_map(step).collect(),
            faults: &analysis.faults,
        })
    }

    /// Whether it is there.
    #[must_use]
    pub fn has(&self, evidence: &Evidence) -> bool {
        let name = evidence.name.as_str();
        match evidence.kind {
            Kind::Harness => self.harnesses.contains(name),
            Kind::Mistake => self.mistakes.contains(name),
            Kind::Fault => self.faults.contains(name),
            Kind::Test => self.root.join(name).is_file(),
            Kind::Record => COMMITTED.contains(&name) || MADE.contains(&name),
            Kind::Step => self.steps.contains(name),
        }
    }

    /// Evidence of failure modes and argument that is not there; files that limitations, parts and nodes name in vain.
    #[must_use]
    pub fn dangling(&self, analysis: &Analysis, argument: &Argument) -> Vec<Finding> {
        let mut findings = Vec::new();
        let mut evidence = |place: &str, evidence: &Evidence| {
            if !self.has(evidence) {
                findings.push(Finding::new("evidence", place, format!("{evidence} is not there")));
            }
        };
        for failure in &analysis.failures {
            failure.evidence.iter().for_each(|piece| evidence(&format!("fmea.toml: {}", failure.id), piece));
        }
        for (module, id, node) in argument.nodes() {
            let place = format!("{}: {id}", module.file);
            node.pieces()
                .filter_map(|piece| Evidence::try_from(piece.to_owned()).ok())
                .for_each(|piece| evidence(&place, &piece));
        }
        let mut file = |place: String, name: &str| {
            if !self.root.join(name).exists() {
                findings.push(Finding::new("evidence", &place, format!("{name} is not there")));
            }
        };
        for failure in &analysis.failures {
            failure.parts.iter().for_each(|part| file(format!("fmea.toml: {}", failure.id), part));
        }
        for limitation in &analysis.limitations {
            file(format!("limitations.toml: {}", limitation.id), &limitation.place);
        }
        for (module, id, node) in argument.nodes() {
            node.url.iter().for_each(|url| file(format!("{}: {id}", module.file), url));
        }
        findings
    }

    /// Source files of the supervisor that no failure mode speaks of. The head of a package only names its modules; that of the
    /// facade does more.
    #[must_use]
    pub fn parts_without_failure(&self, analysis: &Analysis) -> Vec<Finding> {
        let named: BTreeSet<&str> =
            analysis.failures.iter().flat_map(|failure| &failure.parts).map(String::as_str).collect();
        let mut findings = Vec::new();
        let walk = walkdir::WalkDir::new(self.root.join("supervisor")).sort_by_file_name();
        for entry in walk.into_iter().filter_map(Result::ok).filter(|entry| entry.file_type().is_file()) {
            let path = entry.path().strip_prefix(self.root).unwrap_or(entry.path());
            let name = path.to_string_lossy().replace('\\', "/");
            let is_head = name != "supervisor/src/lib.rs" && name.ends_with("/src/lib.rs");
            let is_rust = path.extension().is_some_and(|extension| extension == "rs");
            // What stands in an example does not ship.
            let is_part = name.contains("/src/") && is_rust && !is_head && !name.contains("/example/");
            // A row may speak of a whole folder.
            let is_named =
                path.ancestors().any(|part| named.contains(part.to_string_lossy().replace('\\', "/").as_str()));
            if is_part && !is_named {
                findings.push(Finding::new(
                    "failure modes",
                    &name,
                    "is a part that no failure mode speaks of".to_owned(),
                ));
            }
        }
        findings
    }
}
