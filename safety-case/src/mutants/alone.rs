//! Mutants that cannot be switched: each is built alone.
//!
//! They stand in a function or a value that must be constant, or beside a pattern that binds a name; a switch is not constant.

use std::path::Path;
use std::time::Duration;

use super::build::PROFILE;
use super::record::Outcome;
use super::run::passes;
use crate::copy::{Copy, WITH_TESTS, cargo, errors, programs};
use crate::error::ToolError;
use crate::mistakes::Listed;

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
