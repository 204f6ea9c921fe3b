//! The run: instrument a copy, build its tests, run each, read what was recorded.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use super::instrument::instrument;
use super::plan::{Plan, Vector};
use crate::copy::{Copy, Program, WITH_TESTS, cargo, errors, programs, with_dependency};
use crate::error::{ToolError, file, form, read};
use crate::spread::{as_it_comes, cores};

/// What `decide` and `vet` are made of: the core, what it reads the inputs with, and its arithmetic and timers.
const SOURCES: [&str; 4] = [
    "supervisor/core/src",
    "supervisor/observe/src",
    "supervisor/terms/src/kernel.rs",
    "supervisor/terms/src/units.rs",
];
/// Where functions that are `const` must stay so.
const KEEPS_CONST: &str = "supervisor/terms";
/// The packages of these sources.
const PACKAGES: [&str; 3] = ["supervisor/core", "supervisor/observe", "supervisor/terms"];
/// The packages whose tests go through the real step.
const TESTS: [&str; 2] = ["supervisor-tests", "supervisor-proofs"];
/// Left out of a whole run: `explore` tries every state of three slices, which takes many minutes with a recorder in it;
/// `back_to_back` builds the C library, which a recorder with `std` in it does not let link.
const LEFT_OUT: [&str; 2] = ["explore", "back_to_back"];
const RECORDER: &str = include_str!("recorder.rs");
const MANIFEST: &str = "[package]\nname = \"recorder\"\nversion = \"0.0.0\"\nedition = \"2024\"\npublish = false\n\n[lib]\npath = \"lib.rs\"\n";

/// What was recorded.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Seen {
    /// The points that were reached.
    pub points: BTreeSet<usize>,
    /// The vectors of each decision.
    pub vectors: BTreeMap<usize, BTreeSet<Vector>>,
    /// Decisions with more vectors than were recorded.
    pub full: BTreeSet<usize>,
}

impl Seen {
    /// Takes in what a process has recorded; the number of the first line that is none.
    ///
    /// # Errors
    /// The number of the first line that is not understood.
    pub fn add(&mut self, text: &str) -> Result<(), usize> {
        for (number, line) in text.lines().enumerate() {
            self.line(line).ok_or(number.saturating_add(1))?;
        }
        Ok(())
    }

    fn line(&mut self, line: &str) -> Option<()> {
        let mut words = line.split(' ');
        match words.next()? {
            "p" => drop(self.points.insert(words.next()?.parse().ok()?)),
            "f" => drop(self.full.insert(words.next()?.parse().ok()?)),
            "d" => {
                let decision = words.next()?.parse().ok()?;
                let (evaluated, values) = (words.next()?.parse().ok()?, words.next()?.parse().ok()?);
                let outcome = words.next()? == "1";
                self.vectors.entry(decision).or_default().insert(Vector { evaluated, values, outcome });
            }
            _ => return None,
        }
        words.next().is_none().then_some(())
    }

    /// The vectors of a decision.
    #[must_use]
    pub fn of(&self, decision: usize) -> BTreeSet<Vector> {
        self.vectors.get(&decision).cloned().unwrap_or_default()
    }
}

/// What a run came to.
#[derive(Clone, Debug)]
pub struct Measured {
    /// What there is to cover.
    pub plan: Plan,
    /// What was covered.
    pub seen: Seen,
    /// What ran.
    pub targets: Vec<Program>,
}

/// What there is to cover, and every changed file of the copy.
///
/// # Errors
/// A source cannot be read or is no Rust.
pub fn plan(root: &Path) -> Result<(Plan, BTreeMap<PathBuf, String>), ToolError> {
    let (mut plan, mut changed) = (Plan::default(), BTreeMap::new());
    for source in SOURCES {
        for file in files(root, Path::new(source))? {
            let path = root.join(&file);
            let text = read(&path)?;
            let name = file.to_string_lossy().replace('\\', "/");
            let keeps_const = name.starts_with(KEEPS_CONST);
            let text = instrument(&name, &text, keeps_const, &mut plan).map_err(|error| form(&path, &error))?;
            changed.insert(file, text);
        }
    }
    for package in PACKAGES {
        let (file, manifest) = with_dependency(root, package, "recorder")?;
        changed.insert(file, manifest);
    }
    changed.insert("recorder/lib.rs".into(), RECORDER.to_owned());
    changed.insert("recorder/Cargo.toml".into(), MANIFEST.to_owned());
    Ok((plan, changed))
}

/// Instruments a copy in `target/coverage`, and runs there the test programs of these names, or all of them.
///
/// A program that has passed and was not built anew since is not run again, unless it is to run `again`.
///
/// # Errors
/// The copy cannot be made or does not compile, or a test fails in it.
pub fn run(root: &Path, names: &[String], again: bool, say: &mut dyn FnMut(&str)) -> Result<Measured, ToolError> {
    let folder = root.join("target/coverage");
    let copy = Copy::of(&WITH_TESTS, root, &folder)?;
    let (plan, changed) = plan(root)?;
    copy.restore_with(&changed)?;
    say("building the tests of the instrumented copy");
    let targets = build(&copy, names)?;
    let seen = folder.join("seen");
    if again && seen.exists() {
        fs::remove_dir_all(&seen).map_err(|error| file(&seen, error))?;
    }
    fs::create_dir_all(&seen).map_err(|error| file(&seen, error))?;
    let all = side_by_side(&targets, &seen, say)?;
    Ok(Measured { plan, seen: all, targets })
}

/// Runs the test programs, as many at a time as there are cores.
fn side_by_side(targets: &[Program], folder: &Path, say: &mut dyn FnMut(&str)) -> Result<Seen, ToolError> {
    let (mut all, mut count) = (Seen::default(), 0_usize);
    let each = |target: &Program| {
        let path = folder.join(format!("{}-{}.txt", target.package, target.name));
        Ok::<_, ToolError>((target.name.clone(), test(target, &path)?, path))
    };
    as_it_comes(targets.iter(), cores(), each, |result| {
        let Some(result) = result else { return Ok(()) };
        let (name, took, path) = result?;
        if path.exists() {
            let failed = |line: usize| form(&path, &format!("line {line} is not understood"));
            all.add(&read(&path)?).map_err(failed)?;
        }
        count = count.saturating_add(1);
        let took = took.map_or("   as before".to_owned(), |took| format!("{:10.1} s", took.as_secs_f64()));
        say(&format!("{count:>3} of {}  {took}  {name}", targets.len()));
        Ok::<(), ToolError>(())
    })?;
    Ok(all)
}

fn build(copy: &Copy, names: &[String]) -> Result<Vec<Program>, ToolError> {
    let mut arguments = vec!["test", "--no-run"];
    arguments.extend(TESTS.iter().flat_map(|package| ["-p", package]));
    arguments.extend(names.iter().flat_map(|name| ["--test", name]));
    // There is much to build.
    let small = [("CARGO_INCREMENTAL", "0"), ("CARGO_PROFILE_TEST_DEBUG", "0"), ("CARGO_PROFILE_DEV_DEBUG", "0")];
    let (compiles, said, rest) = cargo(copy, &arguments, &small)?;
    if !compiles {
        let said: Vec<&str> = errors(&said).filter_map(|message| message.rendered.as_deref()).take(4).collect();
        return Err(ToolError::Compile(if said.is_empty() { end(&rest) } else { said.concat() }));
    }
    let wanted = |program: &Program| !names.is_empty() || !LEFT_OUT.contains(&program.name.as_str());
    Ok(programs(&said).into_iter().filter(wanted).collect())
}

/// The time that it took; `None` if it had passed before, as it is.
fn test(target: &Program, recorded: &Path) -> Result<Option<Duration>, ToolError> {
    let (begun, passed) = (Instant::now(), recorded.with_extension("done"));
    let changed = |path: &Path| fs::metadata(path).and_then(|data| data.modified()).ok();
    if changed(&passed).zip(changed(&target.path)).is_some_and(|(passed, built)| passed > built) {
        return Ok(None);
    }
    for left in [recorded, &passed] {
        if left.exists() {
            fs::remove_file(left).map_err(|error| file(left, error))?;
        }
    }
    let done = target.command().env("SUPERVISE_COVERAGE", recorded).output().map_err(ToolError::start(&target.name))?;
    if !done.status.success() {
        let text = end(&String::from_utf8_lossy(&done.stdout));
        return Err(ToolError::Test { test: target.name.clone(), text });
    }
    fs::write(&passed, "").map_err(|error| file(&passed, error))?;
    Ok(Some(begun.elapsed()))
}

/// The last lines.
fn end(text: &str) -> String {
    let lines: Vec<&str> = text.lines().collect();
    lines.get(lines.len().saturating_sub(40)..).unwrap_or_default().join("\n")
}

/// The Rust files of a folder, or the file, from the root.
fn files(root: &Path, of: &Path) -> Result<Vec<PathBuf>, ToolError> {
    let path = root.join(of);
    if !path.is_dir() {
        return Ok(vec![of.to_owned()]);
    }
    let mut files = Vec::new();
    for entry in fs::read_dir(&path).map_err(|error| file(&path, error))? {
        let entry = entry.map_err(|error| file(&path, error))?;
        if entry.path().extension().is_some_and(|extension| extension == "rs") {
            files.push(of.join(entry.file_name()));
        }
    }
    files.sort();
    Ok(files)
}
