//! Every test as a test case of `JUnit`, with what it verifies; its result only where a log shows it.

use std::collections::{BTreeMap, BTreeSet};

use quick_junit::{NonSuccessKind, Property, Report, TestCase, TestCaseStatus, TestSuite};

use crate::evidence::records::{TestLog, TestResult};
use crate::trace::{Kind, Trace};

/// The document. Without a log each test is skipped, and says "not run".
///
/// # Errors
/// It cannot be written as XML.
pub fn junit(trace: &Trace, log: Option<&TestLog>) -> Result<String, quick_junit::SerializeError> {
    let mut verifies: BTreeMap<(&str, &str), BTreeSet<String>> = BTreeMap::new();
    for tag in trace.scan.tags.iter().filter(|tag| tag.kind == Kind::Test) {
        verifies.entry((&tag.place.file, &tag.place.item)).or_default().insert(tag.id.to_string());
    }
    let mut suites: BTreeMap<&str, TestSuite> = BTreeMap::new();
    for test in &trace.scan.tests {
        let (file, item) = (test.place.file.as_str(), test.place.item.as_str());
        let status = match log.and_then(|log| log.of(file, item)) {
            Some(TestResult::Passed) => TestCaseStatus::success(),
            Some(TestResult::Failed) => TestCaseStatus::non_success(NonSuccessKind::Failure),
            Some(TestResult::Ignored) => skipped("left out"),
            None => skipped("not run: no log at hand shows it"),
        };
        let mut case = TestCase::new(item, status);
        case.set_classname(file);
        if let Some(ids) = verifies.get(&(file, item)) {
            let ids: Vec<&str> = ids.iter().map(String::as_str).collect();
            case.add_property(Property::new("PartiallyVerifies", ids.join(", ")));
            case.add_property(Property::new("DerivationTechnique", "requirements-analysis"));
        }
        case.add_property(Property::new("TestType", kind(file)));
        case.add_property(Property::new("Line", test.place.line.to_string()));
        suites.entry(file).or_insert_with(|| TestSuite::new(file)).add_test_case(case);
    }
    let mut report = Report::new("Safety supervisor");
    report.add_test_suites(suites.into_values());
    report.to_string()
}

fn skipped(why: &str) -> TestCaseStatus {
    let mut status = TestCaseStatus::skipped();
    status.set_message(why);
    status
}

/// What kind of test a file holds.
fn kind(file: &str) -> &'static str {
    let has = |word: &str| file.contains(word);
    if has("inject") || has("bitflip") || has("survives") {
        "fault-injection"
    } else if has("supervisor/wire/") || has("tests/interface") || has("capi") {
        "interface-test"
    } else if has("tests/loops") || has("tests/endurance") {
        "resource-usage"
    } else {
        "requirements-based"
    }
}
