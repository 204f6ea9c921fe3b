//! Runs the tests once for each mutant.

use std::collections::BTreeSet;
use std::ffi::OsStr;
use std::path::Path;
use std::process::Stdio;
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use super::alone;
use super::build::built;
use super::list::every;
use super::record::{Entry, Outcome, Record};
use crate::copy::Program;
use crate::error::{ToolError, read, write};
use crate::mistakes::{Listed, Shard};
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

    fn patience(&self) -> Duration {
        self.takes.saturating_mul(8).saturating_add(PATIENCE)
    }

    /// How many mutants it catches in a second, about: those come first.
    fn worth(&self) -> f64 {
        f64::from(self.caught.saturating_add(1)) / self.takes.as_secs_f64().max(0.01)
    }
}

/// Whether a test program passes with these variables. One that does not end in time does not.
///
/// # Errors
/// It does not start.
pub(super) fn passes(program: &Program, variables: &[(&str, &OsStr)], within: Duration) -> Result<bool, ToolError> {
    let mut command = program.command();
    command.stdout(Stdio::null()).stderr(Stdio::null());
    command.env("RUST_TEST_THREADS", "1").env("RUST_BACKTRACE", "0").envs(variables.iter().copied());
    let started = ToolError::start(&program.name);
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

/// Runs the test programs without a mutant: how long each takes, and which mutants it meets. What does not pass then judges nothing, and
/// is told.
fn measured(
    programs: Vec<Program>,
    (longest, jobs): (Duration, usize),
    folder: &Path,
    say: &mut dyn FnMut(&str),
) -> Result<Vec<Test>, ToolError> {
    let mut all = Vec::new();
    let each = |program: Program| {
        let seen = folder.join(format!("seen-{}-{}", program.package, program.name));
        write(&seen, b"")?;
        let began = Instant::now();
        let mut alone = passes(&program, &[("MUTANT", OsStr::new("0"))], longest)?;
        let takes = began.elapsed();
        // To look at every mutant takes its time, too.
        alone = alone && passes(&program, &[("MUTANT_SEEN", seen.as_os_str())], longest.saturating_mul(10))?;
        let meets = read(&seen)?.lines().filter_map(|line| line.parse().ok()).collect();
        Ok((alone, Test { program, takes, caught: 0, meets }))
    };
    as_it_comes(programs.into_iter(), jobs, each, |result| {
        let Some(result) = result else { return Ok(()) };
        let (alone, test): (bool, Test) = result?;
        if alone {
            all.push(test);
        } else {
            say(&format!("LEFT OUT: {} does not pass within {} s without a mutant", test.name(), longest.as_secs()));
        }
        Ok::<(), ToolError>(())
    })?;
    all.sort_by(|one, other| one.program.cmp(&other.program));
    Ok(all)
}

/// The test programs in the order in which they run: the one that caught this mutant before, then those that catch most in the least time.
fn order<'a>(tests: impl Iterator<Item = &'a Test>, before: Option<&String>) -> Vec<Test> {
    let mut order: Vec<Test> = tests.cloned().collect();
    order.sort_by(|one, other| other.worth().total_cmp(&one.worth()));
    order.sort_by_key(|test| before != Some(&test.name()));
    order
}

/// Runs the tests that meet a mutant until one fails: which.
fn caught(tests: &Mutex<Vec<Test>>, mutant: u32, before: Option<&String>) -> Result<Option<String>, ToolError> {
    let lock = || tests.lock().unwrap_or_else(PoisonError::into_inner);
    let order = order(lock().iter().filter(|test| test.meets.contains(&mutant)), before);
    let number = mutant.to_string();
    for test in order {
        if !passes(&test.program, &[("MUTANT", OsStr::new(&number))], test.patience())? {
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
    let tests = measured(built.programs, (request.longest, request.jobs), &target.join("mutants"), say)?;
    let mut record = Record::load(root)?;
    let names: Vec<String> = tests.iter().map(Test::name).collect();
    // What caught a mutant on other sources proves nothing of these, but is tried first.
    let before = record.catchers();
    if record.sources != sources || request.again {
        record = Record::default();
    }
    // What one run left out another may have run.
    let tests_run = record.tests.iter().cloned().chain(names).collect::<BTreeSet<String>>().into_iter().collect();
    record = Record { sources: sources.clone(), listed: all.len(), tests: tests_run, ..record };
    record.mutants.retain(|entry| all.iter().any(|(_, listed)| listed.name == entry.name));
    // A survivor is tried again, after the others: there may be a new test.
    let (mut queue, mut survivors) = (Vec::new(), Vec::new());
    for (number, listed) in request.shard.part(all) {
        let name = listed.name.clone();
        let before = record.mutants.iter().find(|entry| entry.name == name).map(|entry| &entry.outcome);
        if built.unviable.contains(&number) {
            record.put(Entry { name, outcome: Outcome::Unviable });
        } else {
            match before {
                None => queue.push((number, listed)),
                Some(Outcome::Survived) => survivors.push((number, listed)),
                Some(Outcome::Caught { .. } | Outcome::Equal { .. } | Outcome::Unviable) => {}
            }
        }
    }
    // What must be built alone takes longest, and knows by then which test programs catch most.
    let is_alone = |(number, _): &(u32, Listed)| !built.inside.contains(number);
    queue.append(&mut survivors);
    queue.sort_by_key(is_alone);
    record.save(root)?;
    let (total, began) = (queue.len(), Instant::now());
    let alone = queue.iter().filter(|mutant| is_alone(mutant)).count();
    let count = tests.len();
    say(&format!("{total} to run against {count} test programs, {} at a time; {alone} are built alone", request.jobs));
    let tests = Mutex::new(tests);
    let copies = |job: usize| alone::copy(root, &target.join("mutants/alone").join(job.to_string()));
    let copies = Mutex::new((0..request.jobs.max(1)).map(copies).collect::<Result<Vec<_>, _>>()?);
    let copies = || copies.lock().unwrap_or_else(PoisonError::into_inner);
    let goes_on = |_: &(u32, Listed)| request.within.is_none_or(|within| began.elapsed() < within);
    let each = |(number, listed): (u32, Listed)| {
        let before = before.get(&listed.name);
        let outcome = if built.inside.contains(&number) {
            caught(&tests, number, before)?.map_or(Outcome::Survived, |by| Outcome::Caught { by })
        } else {
            // There is one for each job.
            let Some(copy) = copies().pop() else { return Err(ToolError::Arguments("no copy is left".to_owned())) };
            let order = order(tests.lock().unwrap_or_else(PoisonError::into_inner).iter(), before);
            let order: Vec<String> = order.iter().map(Test::name).collect();
            let judged = alone::judge(&copy, root, &listed, &order, request.longest.saturating_mul(8));
            copies().push(copy);
            judged?
        };
        Ok(Entry { name: listed.name, outcome })
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

#[cfg(test)]
mod tests {
    use super::{Test, order};
    use crate::copy::Program;
    use std::collections::BTreeSet;
    use std::time::Duration;

    #[test]
    fn what_caught_it_before_comes_first_then_what_catches_most_in_the_least_time() {
        let test = |name: &str, caught, seconds| Test {
            program: Program { package: "tests".into(), name: name.into(), folder: "".into(), path: "".into() },
            takes: Duration::from_secs(seconds),
            caught,
            meets: BTreeSet::new(),
        };
        let tests = [test("slow", 20, 10), test("quick", 9, 1), test("seldom", 0, 1)];
        let names = |before: Option<&String>| order(tests.iter(), before).iter().map(Test::name).collect::<Vec<_>>();
        assert_eq!(names(None), ["tests/quick", "tests/slow", "tests/seldom"]);
        assert_eq!(names(Some(&"tests/seldom".to_owned())), ["tests/seldom", "tests/quick", "tests/slow"]);
    }
}
