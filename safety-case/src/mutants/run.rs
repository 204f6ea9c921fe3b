//! Runs the tests once for each mutant.

use std::collections::BTreeSet;
use std::ffi::OsStr;
use std::path::Path;
use std::process::Stdio;
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use super::build::built;
use super::list::every;
use super::record::{Entry, Outcome, Record};
use crate::copy::Program;
use crate::error::{ToolError, read, write};
use crate::mistakes::Shard;
use crate::prove::shipped;
use crate::spread::as_it_comes;

/// What a test program may take beside a multiple of what it takes without a mutant.
const PATIENCE: Duration = Duration::from_secs(5);
/// How often is looked whether it has ended.
const LOOK: Duration = Duration::from_millis(5);
/// The record is written every so many mutants.
const EVERY: usize = 10;

/// What to run.
#[derive(Clone, Copy, Debug)]
pub struct Request {
    /// Only this part.
    pub shard: Shard,
    /// How many at a time.
    pub jobs: usize,
    /// Again what the record has for the present sources.
    pub again: bool,
    /// No further mutant is begun after so long.
    pub within: Option<Duration>,
    /// A test program that takes longer without a mutant does not run: every mutant that survives the others would wait for it.
    pub longest: Duration,
}

/// A test program, and what is known of it.
#[derive(Clone, Debug)]
struct Test {
    program: Program,
    /// What it takes without a mutant.
    takes: Duration,
    /// How many mutants it has caught.
    caught: u32,
    /// The mutants that make a difference in it where they stand, or may: no other can be caught by it.
    meets: BTreeSet<u32>,
}

impl Test {
    fn name(&self) -> String {
        format!("{}/{}", self.program.package, self.program.name)
    }

    /// Whether it passes with this variable. One that does not end in time does not.
    fn passes(&self, variable: (&str, &OsStr), within: Duration) -> Result<bool, ToolError> {
        let mut command = self.program.command();
        command.stdout(Stdio::null()).stderr(Stdio::null());
        command.env("RUST_TEST_THREADS", "1").env("RUST_BACKTRACE", "0").env(variable.0, variable.1);
        let started = ToolError::start(&self.program.name);
        let mut child = command.spawn().map_err(&started)?;
        let began = Instant::now();
        loop {
            if let Some(status) = child.try_wait().map_err(&started)? {
                return Ok(status.success());
            }
            if began.elapsed() > within {
                child.kill().and_then(|()| child.wait()).map_err(&started)?;
                return Ok(false);
            }
            std::thread::sleep(LOOK);
        }
    }

    fn patience(&self) -> Duration {
        self.takes.saturating_mul(8).saturating_add(PATIENCE)
    }

    /// How many mutants it catches in a second, about: those come first.
    fn worth(&self) -> f64 {
        f64::from(self.caught.saturating_add(1)) / self.takes.as_secs_f64().max(0.01)
    }
}

/// Runs the test programs without a mutant: how long each takes, and which mutants it meets. What does not pass then judges nothing, and
/// is told.
fn measured(
    programs: Vec<Program>,
    longest: Duration,
    folder: &Path,
    say: &mut dyn FnMut(&str),
) -> Result<Vec<Test>, ToolError> {
    let (mut all, seen) = (Vec::new(), folder.join("seen"));
    for program in programs {
        write(&seen, b"")?;
        let mut test = Test { program, takes: Duration::ZERO, caught: 0, meets: BTreeSet::new() };
        let began = Instant::now();
        let mut passes = test.passes(("MUTANT", OsStr::new("0")), longest)?;
        test.takes = began.elapsed();
        // To look at every mutant takes its time, too.
        passes = passes && test.passes(("MUTANT_SEEN", seen.as_os_str()), longest.saturating_mul(10))?;
        if passes {
            test.meets = read(&seen)?.lines().filter_map(|line| line.parse().ok()).collect();
            all.push(test);
        } else {
            say(&format!("LEFT OUT: {} does not pass within {} s without a mutant", test.name(), longest.as_secs()));
        }
    }
    Ok(all)
}

/// Runs the tests until one fails: which.
fn caught(tests: &Mutex<Vec<Test>>, mutant: u32) -> Result<Option<String>, ToolError> {
    let lock = || tests.lock().unwrap_or_else(PoisonError::into_inner);
    let mut order: Vec<Test> = lock().iter().filter(|test| test.meets.contains(&mutant)).cloned().collect();
    order.sort_by(|one, other| other.worth().total_cmp(&one.worth()));
    let number = mutant.to_string();
    for test in order {
        if !test.passes(("MUTANT", OsStr::new(&number)), test.patience())? {
            if let Some(found) = lock().iter_mut().find(|present| present.program == test.program) {
                found.caught = found.caught.saturating_add(1);
            }
            return Ok(Some(test.name()));
        }
    }
    Ok(None)
}

/// Runs what is asked for, keeps the record, tells `say` how far it is.
///
/// # Errors
/// A file or a tool fails, or the sources change while it runs. What ran before is in the record.
pub fn run(root: &Path, request: Request, say: &mut dyn FnMut(&str)) -> Result<(), ToolError> {
    let sources = shipped(root)?;
    let all = every(root)?;
    let target = std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root.join("target"), |folder| root.join(folder));
    let built = built(root, &target.join("mutants"), &all, say)?;
    let tests = measured(built.programs, request.longest, &target.join("mutants"), say)?;
    let mut record = Record::load(root)?;
    let names = tests.iter().map(Test::name).collect();
    if record.sources != sources || request.again {
        record = Record::default();
    }
    record = Record { sources: sources.clone(), listed: all.len(), tests: names, ..record };
    // A survivor is tried again, after the others: there may be a new test.
    let (mut queue, mut survivors) = (Vec::new(), Vec::new());
    for (number, listed) in request.shard.part(all) {
        let name = listed.name.clone();
        if built.inside.contains(&number) {
            match record.mutants.iter().find(|entry| entry.name == name).map(|entry| &entry.outcome) {
                None => queue.push((number, name)),
                Some(Outcome::Survived) => survivors.push((number, name)),
                Some(Outcome::Caught { .. } | Outcome::Unviable | Outcome::LeftOut { .. }) => {}
            }
        } else {
            let why = "in a constant function, or beside a pattern that binds a name".to_owned();
            let outcome = if built.unviable.contains(&number) { Outcome::Unviable } else { Outcome::LeftOut { why } };
            record.put(Entry { name, outcome });
        }
    }
    queue.append(&mut survivors);
    record.save(root)?;
    let (total, began) = (queue.len(), Instant::now());
    say(&format!("{total} to run against {} test programs, {} at a time", tests.len(), request.jobs));
    let tests = Mutex::new(tests);
    let goes_on = |_: &(u32, String)| request.within.is_none_or(|within| began.elapsed() < within);
    let each = |(number, name)| {
        let by = caught(&tests, number)?;
        Ok(Entry { name, outcome: by.map_or(Outcome::Survived, |by| Outcome::Caught { by }) })
    };
    let mut done = 0_usize;
    as_it_comes(queue.into_iter().take_while(goes_on), request.jobs, each, |result| {
        let Some(result) = result else { return Ok(()) };
        let entry = result?;
        done = done.saturating_add(1);
        if entry.outcome == Outcome::Survived {
            say(&format!("SURVIVED {}", entry.name));
        }
        record.put(entry);
        if done.is_multiple_of(EVERY) || done == total {
            let minutes = began.elapsed().as_secs() / 60;
            say(&format!("{done} of {total}, {minutes} min so far"));
            if shipped(root)? != sources {
                return Err(ToolError::Arguments("the sources have changed while this ran".to_owned()));
            }
            record.save(root)?;
        }
        Ok(())
    })?;
    record.save(root)
}
