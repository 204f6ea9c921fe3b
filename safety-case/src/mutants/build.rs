//! The copy with every mutant in it, and the test programs that are built of it.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use super::list::{PACKAGES, placed};
use super::switch::{CRATE, Genre, Mutant, Switched, switched};
use crate::copy::{Copy, Program, WITH_TESTS, cargo, errors, programs, with_dependency};
use crate::error::{ToolError, form, read};
use crate::mistakes::Listed;

/// So often is what the compiler refuses taken out.
const ROUNDS: usize = 60;
/// Optimised, because the tests run often; with the checks that they rely on.
pub(super) const PROFILE: [(&str, &str); 4] = [
    ("CARGO_PROFILE_RELEASE_OPT_LEVEL", "1"),
    ("CARGO_PROFILE_RELEASE_LTO", "off"),
    ("CARGO_PROFILE_RELEASE_DEBUG", "0"),
    ("CARGO_PROFILE_RELEASE_DEBUG_ASSERTIONS", "true"),
];
const MANIFEST: &str = "[package]\nname = \"mutant_switch\"\nversion = \"0.0.0\"\nedition = \"2024\"\npublish = false\n\n[lib]\npath = \"lib.rs\"\n";

/// The packages whose tests run: those of the step, and of the shipped crates that have tests of their own.
const TESTED: [&str; 4] = ["supervisor-tests", "supervisor-proofs", "supervisor-wire", "supervisor-observe"];

/// A built copy.
#[derive(Debug)]
pub struct Built {
    /// The mutants that are in it.
    pub inside: BTreeSet<u32>,
    /// Those that the compiler refuses as such. One that is in neither set cannot be switched.
    pub unviable: BTreeSet<u32>,
    /// Its test programs.
    pub programs: Vec<Program>,
}

/// Every mutant by its file, with the file's text.
type Files = BTreeMap<String, (String, Vec<Mutant>)>;

fn files(root: &Path, all: &[(u32, Listed)]) -> Result<Files, ToolError> {
    let mut files = Files::new();
    for (number, listed) in all {
        if !files.contains_key(&listed.file) {
            files.insert(listed.file.clone(), (read(&root.join(&listed.file))?, Vec::new()));
        }
        if let Some((text, mutants)) = files.get_mut(&listed.file) {
            mutants.extend(placed(*number, listed, text));
        }
    }
    Ok(files)
}

/// What the copy has beside the mutated files: the crate with the switch, and who depends on it.
fn with_switch(root: &Path) -> Result<BTreeMap<PathBuf, String>, ToolError> {
    let mut changed: BTreeMap<PathBuf, String> =
        PACKAGES.iter().map(|(_, folder)| with_dependency(root, folder, "mutant_switch")).collect::<Result<_, _>>()?;
    changed.insert("mutant_switch/Cargo.toml".into(), MANIFEST.to_owned());
    changed.insert("mutant_switch/lib.rs".into(), CRATE.to_owned());
    Ok(changed)
}

/// The function that the compiler misses as a constant one: `c`, where it says that it cannot call the method `A::<B>::c`.
fn missed(message: &str) -> Option<String> {
    let called = message.strip_prefix("cannot call non-const")?.split('`').nth(1)?;
    called
        .rsplit("::")
        .find(|part| !part.starts_with('<') && !part.is_empty())
        .map(|name| name.chars().take_while(|character| character.is_alphanumeric() || *character == '_').collect())
}

/// Builds the copy: whatever the compiler refuses is taken out until it compiles.
///
/// # Errors
/// A file cannot be written, cargo does not start, or it does not compile for another reason.
pub fn built(root: &Path, folder: &Path, all: &[(u32, Listed)], say: &mut dyn FnMut(&str)) -> Result<Built, ToolError> {
    let copy = Copy::of(&WITH_TESTS, root, folder)?;
    let mut files = files(root, all)?;
    let (mut constant, mut unviable, mut refused) = (BTreeSet::new(), BTreeSet::new(), BTreeSet::new());
    let mut check = vec!["check", "--release", "--keep-going", "--all-features", "-p", "supervisor-report"];
    check.extend(PACKAGES.iter().flat_map(|(package, _)| ["-p", package]));
    let mut with_tests = vec!["test", "--release", "--no-run"];
    with_tests.extend(TESTED.iter().flat_map(|package| ["-p", package]));
    let mut changed = with_switch(root)?;
    for round in 1..=ROUNDS {
        let mut present: BTreeMap<&String, Switched> = BTreeMap::new();
        for (name, (text, mutants)) in &files {
            let switched = switched(text, mutants, &constant).map_err(|error| form(&root.join(name), &error))?;
            changed.insert(name.into(), switched.text.clone());
            unviable.extend(switched.unviable.iter().copied());
            present.insert(name, switched);
        }
        copy.restore_with(&changed)?;
        let inside: BTreeSet<u32> = present.values().flat_map(|switched| switched.inside.iter().copied()).collect();
        let (mut compiles, mut said, mut rest) = cargo(&copy, &check, &PROFILE)?;
        if compiles {
            // What calls the crates may need a constant function, too.
            (compiles, said, rest) = cargo(&copy, &with_tests, &PROFILE)?;
        }
        if compiles {
            say(&format!("{} of {} mutants are switched, {} do not compile", inside.len(), all.len(), unviable.len()));
            return Ok(Built { inside, unviable, programs: programs(&said) });
        }
        let before = (constant.len(), unviable.len(), refused.len());
        let mut unknown = None;
        for message in errors(&said).filter(|message| !message.spans.is_empty()) {
            let at = message.spans.iter().find_map(|span| {
                let (_, switched) = present.iter().find(|(name, _)| span.file_name.ends_with(name.as_str()))?;
                switched.at(span.byte_start)
            });
            match (missed(&message.text), at) {
                (Some(name), _) => drop(constant.insert(name)),
                (None, Some(number)) => drop(refused.insert(number)),
                (None, None) => unknown.clone_from(&message.rendered),
            }
        }
        for (_, mutants) in files.values_mut() {
            // A value for a body stands behind its switch as it would stand there alone; of others it may be the switch that is refused.
            let value = |mutant: &&Mutant| mutant.genre == Genre::Body && refused.contains(&mutant.number);
            unviable.extend(mutants.iter().filter(value).map(|mutant| mutant.number));
            mutants.retain(|mutant| !unviable.contains(&mutant.number) && !refused.contains(&mutant.number));
        }
        say(&format!("round {round}: {} do not compile, {} functions stay constant", unviable.len(), constant.len()));
        if (constant.len(), unviable.len(), refused.len()) == before {
            return Err(ToolError::Compile(unknown.unwrap_or(rest)));
        }
    }
    Err(ToolError::Compile(format!("not after {ROUNDS} rounds")))
}

#[cfg(test)]
mod tests {
    use super::missed;

    #[test]
    fn the_function_that_is_missed_is_named() {
        for (message, name) in [
            ("cannot call non-const associated function `Timer::new` in constants", Some("new")),
            ("cannot call non-const method `Signal::<T>::known` in constant functions", Some("known")),
            ("cannot call non-const function `kernel::less` in statics", Some("less")),
            ("mismatched types", None),
        ] {
            assert_eq!(missed(message).as_deref(), name, "{message}");
        }
    }
}
