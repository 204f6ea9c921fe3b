//! Mutants that cannot be switched: each is built alone.
//!
//! They stand in a function or a value that must be constant, or beside a pattern that binds a name; a switch is not constant.

use std::collections::BTreeMap;
use std::path::Path;
use std::time::Duration;

use super::build::PROFILE;
use super::record::{Outcome, Record};
use super::run::passes;
use crate::copy::{Copy, WITH_TESTS, cargo, errors, programs};
use crate::error::ToolError;
use crate::mistakes::Listed;

/// The test programs, those first that have caught most.
#[must_use]
pub fn order(record: &Record) -> Vec<String> {
    let mut caught: BTreeMap<&str, usize> = BTreeMap::new();
    for entry in &record.mutants {
        if let Outcome::Caught { by } = &entry.outcome {
            let count = caught.entry(by).or_default();
            *count = count.saturating_add(1);
        }
    }
    let mut order = record.tests.clone();
    order.sort_by_key(|test| std::cmp::Reverse(caught.get(test.as_str()).copied().unwrap_or_default()));
    order
}

/// Where they are planted.
///
/// # Errors
/// The folder cannot be made.
pub fn copy(root: &Path, folder: &Path) -> Result<Copy, ToolError> {
    Copy::of(&WITH_TESTS, root, folder)
}

/// Plants one, and builds and runs one test program after the other until one fails, or does not compile any more; each may take so long.
///
/// # Errors
/// A file or a tool fails.
pub fn judge(
    copy: &Copy,
    root: &Path,
    listed: &Listed,
    order: &[String],
    within: Duration,
) -> Result<Outcome, ToolError> {
    copy.plant(&listed.change(root)?)?;
    // With every feature: what is built for simulations only must compile, too, to be a mutant.
    let (compiles, ..) =
        cargo(copy, &["check", "--release", "--lib", "--all-features", "-p", &listed.package], &PROFILE)?;
    if !compiles {
        return Ok(Outcome::Unviable);
    }
    for test in order {
        let (package, name) = test.split_once('/').unwrap_or(("tests", test));
        let package = format!("supervisor-{package}");
        // The library of a package has tests of its own.
        let chosen: &[&str] = if package.replace('-', "_") == *name { &["--lib"] } else { &["--test", name] };
        let build = [&["test", "--release", "--no-run", "-p", package.as_str()], chosen].concat();
        let (compiles, said, _) = cargo(copy, &build, &PROFILE)?;
        let caught = || Outcome::Caught { by: test.clone() };
        if !compiles && errors(&said).next().is_some() {
            return Ok(caught());
        }
        // One that is no test target (the tests of a binary) is not built, and judges nothing.
        for program in programs(&said) {
            if !passes(&program, &[], within)? {
                return Ok(caught());
            }
        }
    }
    Ok(Outcome::Survived)
}

#[cfg(test)]
mod tests {
    use super::order;
    use crate::mutants::record::{Entry, Outcome, Record};

    #[test]
    fn what_has_caught_most_comes_first() {
        let mut record = Record { tests: ["a/x", "a/y", "b/z"].map(str::to_owned).into(), ..Record::default() };
        for (name, by) in [("1", "b/z"), ("2", "b/z"), ("3", "a/y")] {
            record.put(Entry { name: name.to_owned(), outcome: Outcome::Caught { by: by.to_owned() } });
        }
        assert_eq!(order(&record), ["b/z", "a/y", "a/x"]);
    }
}
