//! What `cargo test` printed, as far as it says which test came to what.

use std::fs;
use std::path::{Path, PathBuf};

use serde::Serialize;

use crate::error::{ToolError, file};

/// Where a log is looked for, if none is named.
pub const LOG: &str = "target/tests.log";

/// What came of a test.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum TestResult {
    /// It passed.
    Passed,
    /// It failed.
    Failed,
    /// It was left out.
    Ignored,
}

/// A log.
#[derive(Clone, Debug, Default)]
pub struct TestLog {
    /// The file.
    pub path: PathBuf,
    /// Test program, path of the test in it, and what came of it.
    tests: Vec<(Program, String, TestResult)>,
}

/// Which test program a line belongs to.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
struct Program {
    /// The crate of unit tests, or nothing.
    library: Option<String>,
    /// The file of integration tests, without its ending.
    file: Option<String>,
}

impl TestLog {
    /// Reads the log that is named; without one, the usual place if there is any.
    ///
    /// # Errors
    /// The named one cannot be read.
    pub fn find(root: &Path, named: Option<&Path>) -> Result<Option<Self>, ToolError> {
        let usual = root.join(LOG);
        let Some(path) = named.map(Path::to_owned).or_else(|| usual.exists().then_some(usual)) else { return Ok(None) };
        let text = fs::read(&path).map_err(|error| file(&path, error))?;
        Ok(Some(Self { tests: read(&String::from_utf8_lossy(&text)), path }))
    }

    /// What came of the test of this name in this source file.
    #[must_use]
    pub fn of(&self, source: &str, name: &str) -> Option<TestResult> {
        let of_name = |path: &str| path.rsplit("::").next() == Some(name);
        let found = self.tests.iter().find(|(program, path, _)| of_name(path) && program.compiles(source));
        found.map(|(.., result)| *result)
    }

    /// How many passed, failed and were left out.
    #[must_use]
    pub fn counts(&self) -> [usize; 3] {
        [TestResult::Passed, TestResult::Failed, TestResult::Ignored]
            .map(|wanted| self.tests.iter().filter(|(.., result)| *result == wanted).count())
    }
}

impl Program {
    /// `tests/seat_leave.rs (target/debug/deps/seat_leave-0123)` or `unittests src/lib.rs (target/debug/deps/x-0123)`.
    fn read(line: &str) -> Option<Self> {
        let rest = line.trim().strip_prefix("Running ")?;
        let (what, binary) = rest.split_once(" (")?;
        let stem = |path: &str| {
            let name = path.rsplit(['/', '\\']).next().unwrap_or(path).trim_end_matches(')');
            name.rsplit_once('-').map_or(name, |(stem, _)| stem).trim_end_matches(".rs").to_owned()
        };
        Some(if what.starts_with("unittests") {
            Self { library: Some(stem(binary)), file: None }
        } else {
            // A folder of tests is named by its `main.rs`: then the binary says which.
            Self { library: None, file: Some(stem(binary)) }
        })
    }

    /// Whether it is made of this source.
    fn compiles(&self, source: &str) -> bool {
        match (&self.library, &self.file) {
            (Some(library), _) => library_of(source).is_some_and(|of| of == *library),
            (_, Some(file)) => source.split_once("/tests/").is_some_and(|(_, rest)| {
                rest.strip_prefix(file.as_str()).is_some_and(|rest| rest.starts_with(['.', '/']))
            }),
            (None, None) => false,
        }
    }
}

/// The crate that a file below `src` belongs to.
fn library_of(source: &str) -> Option<String> {
    let (folder, _) = source.split_once("/src/")?;
    Some(match folder {
        "safety-case" => "safety_case".to_owned(),
        "fuzz" => "supervisor_fuzz".to_owned(),
        "supervisor" => "supervisor".to_owned(),
        "tests" => "supervisor_tests".to_owned(),
        "proofs" => "supervisor_proofs".to_owned(),
        other => other.replace(['/', '-'], "_"),
    })
}

fn read(text: &str) -> Vec<(Program, String, TestResult)> {
    let mut program = Program::default();
    let mut tests = Vec::new();
    for line in text.lines() {
        if let Some(next) = Program::read(line) {
            program = next;
        } else if line.trim().starts_with("Doc-tests ") {
            program = Program::default();
        } else if let Some((name, said)) = line.strip_prefix("test ").and_then(|rest| rest.rsplit_once(" ... ")) {
            let name = name.trim_end_matches(" - should panic").to_owned();
            let result = match said.split([',', ' ']).next() {
                Some("ok") => TestResult::Passed,
                Some("FAILED") => TestResult::Failed,
                Some("ignored") => TestResult::Ignored,
                _ => continue,
            };
            tests.push((program.clone(), name, result));
        }
    }
    tests
}

#[cfg(test)]
mod tests {
    use super::{TestLog, TestResult, read};

    const LOG: &str = "\
     Running unittests src/lib.rs (target/debug/deps/supervisor_core-a1b2)
running 1 test
test seat::tests::it_holds ... ok
     Running tests/seat_leave.rs (target/debug/deps/seat_leave-a1b2)
test leave_begins ... FAILED
test slow ... ignored, takes an hour
     Running tests/supervise/main.rs (target/debug/deps/supervise-a1b2)
test replay::logs ... ok
   Doc-tests supervisor_core
test supervisor/core/src/lib.rs - x (line 3) ... ok
";

    #[test]
    fn a_test_is_found_by_its_file_and_name() {
        let log = TestLog { tests: read(LOG), ..TestLog::default() };
        assert_eq!(log.of("supervisor/core/src/seat.rs", "it_holds"), Some(TestResult::Passed));
        assert_eq!(log.of("supervisor/wire/src/seat.rs", "it_holds"), None);
        assert_eq!(log.of("tests/tests/seat_leave.rs", "leave_begins"), Some(TestResult::Failed));
        assert_eq!(log.of("tests/tests/seat_leave.rs", "slow"), Some(TestResult::Ignored));
        assert_eq!(log.of("tests/tests/seat.rs", "leave_begins"), None);
        assert_eq!(log.of("safety-case/tests/supervise/replay.rs", "logs"), Some(TestResult::Passed));
        assert_eq!(log.counts(), [3, 1, 1]);
    }
}
