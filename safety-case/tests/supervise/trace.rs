//! Traceability: the real project, and a small one with an orphan of every kind.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use safety_case::trace::{Kind, Rule, Status, json, page, rows, trace};
use supervisor::LIMITS;

use crate::common::{Outcome, project, supervise_in};

/// A folder with the files of a small project that has no finding; `change` alters them first.
fn small(change: impl Fn(&str, String) -> String) -> std::io::Result<tempfile::TempDir> {
    let requirement = |id: &str| {
        format!(
            "[[requirement]]\nid = \"{id}\"\ntext = \"Demand {id}.\"\nsource = \"own\"\nmethod = [\"test\"]\npackage = 1\n\n"
        )
    };
    let analysis = project().join("safety-case/analysis");
    let shared = ["item", "hazards", "goals", "assumptions", "timing", "readings"].map(|name| {
        let name = format!("{name}.toml");
        fs::read_to_string(analysis.join(&name)).map(|text| (format!("safety-case/analysis/{name}"), text))
    });
    let mut files = shared.into_iter().collect::<Result<Vec<_>, _>>()?;
    let own = [
        ("safety-case/analysis/requirements/all.toml", ["BRK-1a", "BRK-1b", "BRK-2a"].map(requirement).concat()),
        (
            "supervisor/core/src/brake.rs",
            concat!(
                "//! Brakes (BRK-2a at the head of a file is a mention).\n",
                "/// BRK-1: both demands of the group.\npub fn hold() {}\n",
                "pub fn fade() {\n    // BRK-2a: falls.\n}\n"
            )
            .to_owned(),
        ),
        (
            "supervisor/terms/src/limits.rs",
            "limits! {\n    /// A number.\n    hold: Millis = [1], 1..=2, \"ms\", \"own\", \"BRK-1a\";\n}\n".to_owned(),
        ),
        ("proofs/harnesses.toml", "harness = []\n".to_owned()),
        (
            "tests/tests/brake.rs",
            concat!(
                "/// BRK-1a, b: holds.\n#[test]\nfn holds() {}\n",
                "proptest! {\n    /// BRK-2a: falls.\n    #[test]\n    fn falls(x in 0..1) {}\n}\n"
            )
            .to_owned(),
        ),
    ];
    files.extend(own.map(|(name, text)| (name.to_owned(), text)));
    let folder = tempfile::tempdir()?;
    for (name, text) in files {
        let path = folder.path().join(&name);
        fs::create_dir_all(path.parent().unwrap_or(folder.path()))?;
        fs::write(path, change(&name, text))?;
    }
    Ok(folder)
}

/// The findings of the small project after `from` became `to` in a file, as `file:line item [Rule]`.
fn findings(file: &str, from: &str, to: &str) -> Result<Vec<String>, Box<dyn std::error::Error>> {
    let folder = small(|name, text| if name == file { text.replacen(from, to, 1) } else { text })?;
    let path = folder.path().join(file);
    if !path.exists() {
        fs::write(path, to)?;
    }
    let found = trace(folder.path())?.findings;
    Ok(found
        .iter()
        .map(|finding| {
            let place = &finding.place;
            format!("{}:{} {} [{:?}]", place.file, place.line, place.item, finding.rule)
        })
        .collect())
}

const CODE: &str = "supervisor/core/src/brake.rs";
const TESTS: &str = "tests/tests/brake.rs";
const TABLE: &str = "safety-case/analysis/requirements/all.toml";

#[test]
fn a_small_project_is_traced_to_items_and_lines() -> Outcome {
    let folder = small(|_, text| text)?;
    let trace = trace(folder.path())?;
    assert_eq!(trace.findings, []);
    let of = |id: &str| trace.rows.iter().find(|row| row.id == id).ok_or("no row");
    let (first, last) = (of("BRK-1a")?, of("BRK-2a")?);
    let code: Vec<_> =
        first.code.iter().map(|code| (code.place.line, code.place.item.as_str(), code.by_group)).collect();
    assert_eq!(code, [(2, "hold", true)]);
    let code: Vec<_> =
        last.code.iter().map(|code| (code.place.line, code.place.item.as_str(), code.by_group)).collect();
    assert_eq!(code, [(5, "fade", false)]);
    assert_eq!(first.limits.iter().map(|limit| (limit.line, limit.item.as_str())).collect::<Vec<_>>(), [(3, "hold")]);
    assert_eq!(last.tests.iter().map(|test| (test.line, test.item.as_str())).collect::<Vec<_>>(), [(7, "falls")]);
    assert_eq!((last.place.file.as_str(), last.place.line), (TABLE, 16));
    Ok(())
}

#[test]
fn every_kind_of_orphan_is_found_where_it_is() -> Outcome {
    for (file, from, to, expected) in [
        // (a) A requirement without code; without a test.
        (CODE, "// BRK-2a: falls.", "// falls.", format!("{TABLE}:16 BRK-2a [NoCode]")),
        (TESTS, "BRK-2a: falls", "BRK-1a: falls", format!("{TABLE}:16 BRK-2a [NoEvidence]")),
        // One demand named: the group counts no more for the other.
        (CODE, "BRK-1: both", "BRK-1a: both", format!("{TABLE}:9 BRK-1b [NoCode]")),
        // An ignored test does not run.
        (
            TESTS,
            "#[test]\n    fn falls",
            "#[test]\n    #[ignore]\n    fn falls",
            format!("{TABLE}:16 BRK-2a [NoEvidence]"),
        ),
        // A mention in a sentence, or at the head of a file, is no tag.
        (CODE, "// BRK-2a: falls.", "// Falls, as BRK-2a says.", format!("{TABLE}:16 BRK-2a [NoCode]")),
        // (b) Ids that nothing defines: in a tag, a sentence, a range, a limit, a harness.
        (CODE, "// BRK-2a: falls.", "// BRK-2a, BRK-7a: falls.", format!("{CODE}:5 fade [UnknownId]")),
        (CODE, "// BRK-2a: falls.", "// BRK-2a: falls.\n    // Not as BRAKE-1a.", format!("{CODE}:6 fade [UnknownId]")),
        (TESTS, "BRK-1a, b", "BRK-1a to BRK-1c", format!("{TESTS}:3 holds [UnknownId]")),
        (TESTS, "BRK-1a, b", "BRK-1a, BRK-1b, BRK-1b to BRK-1a", format!("{TESTS}:1 holds [BrokenRange]")),
        (
            "supervisor/terms/src/limits.rs",
            "\"BRK-1a\"",
            "\"BRK-9a\"",
            "supervisor/terms/src/limits.rs:3 hold [UnknownId]".to_owned(),
        ),
        // A group where a demand is meant.
        (TESTS, "BRK-1a, b", "BRK-1a, BRK-1b, BRK-2", format!("{TESTS}:3 holds [Coarse]")),
        ("proofs/harnesses.toml", "harness = []", HARNESS, "proofs/harnesses.toml:2 brk_1 [NoHarness]".to_owned()),
        ("safety-case/analysis/trace.toml", "", ALLOWED, "safety-case/analysis/trace.toml:2 FOO [Idle]".to_owned()),
        // A reason to be without code, where there is code.
        (TABLE, "id = \"BRK-2a\"", "id = \"BRK-2a\"\nwithout_code = \"none\"", format!("{TABLE}:16 BRK-2a [Idle]")),
    ] {
        let found = findings(file, from, to)?;
        assert!(found.contains(&expected), "{file}: {to}: {expected} is not among {found:?}");
    }
    Ok(())
}

const HARNESS: &str = "[[harness]]\nname = \"brk_1\"\npath = \"harness\"\nfamily = \"step\"\nrequirements = [\"BRK-1a\"]\nextent = \"exhaustive\"";
const ALLOWED: &str = "[[word]]\narea = \"FOO\"\nreason = \"nothing\"\n";

#[test]
fn an_untagged_test_is_found_unless_it_is_listed_with_a_reason() -> Outcome {
    let idle = "#[test]\nfn idles() {}\n/// BRK-1a";
    assert_eq!(findings(TESTS, "/// BRK-1a", idle)?, [format!("{TESTS}:2 idles [UntaggedTest]")]);
    let folder = small(|name, text| if name == TESTS { text.replacen("/// BRK-1a", idle, 1) } else { text })?;
    let list = folder.path().join("safety-case/analysis/trace.toml");
    let entry = format!("[[untagged]]\nfile = \"{TESTS}\"\ntest = \"idles\"\nreason = ");
    fs::write(&list, format!("{entry}\"of the bench\"\n"))?;
    assert_eq!(trace(folder.path())?.findings, []);
    fs::write(&list, format!("{entry}\"\"\n"))?;
    assert!(trace(folder.path()).is_err_and(|error| error.to_string().contains("idles is allowed without a reason")));
    Ok(())
}

#[test]
fn the_exit_code_and_the_text_say_what_is_missing() -> Outcome {
    let orphan = |name: &str, text: String| if name == CODE { text.replace("BRK-2a: ", "") } else { text };
    let folder = small(orphan)?;
    let ran = supervise_in(folder.path(), &["trace", "--root", ".", "--json", "t.json", "--html", "t.html"])?;
    assert_eq!(ran.code, 1, "{}", ran.err);
    assert!(ran.out.contains(&format!("{TABLE}:16: BRK-2a: no code carries it")), "{}", ran.out);
    assert!(ran.out.contains("3: 2 covered, 0 by analysis or review alone, 1 orphans"), "{}", ran.out);
    let document: serde_json::Value = serde_json::from_str(&fs::read_to_string(folder.path().join("t.json"))?)?;
    assert_eq!(document["requirements"][2]["status"], "orphan");
    assert_eq!(document["findings"][0]["line"], 16);
    assert!(fs::read_to_string(folder.path().join("t.html"))?.contains("no code"));
    let ran = supervise_in(folder.path(), &["trace", "--root", ".", "BRK-9"])?;
    assert_eq!((ran.code, ran.err.contains("BRK-9")), (2, true), "{}", ran.err);
    Ok(())
}

#[test]
fn the_real_project_names_nothing_unknown_and_tags_every_test() -> Outcome {
    let trace = trace(&project())?;
    let orphans = [Rule::NoCode, Rule::NoEvidence];
    let found: Vec<_> = trace.findings.iter().filter(|finding| !orphans.contains(&finding.rule)).collect();
    assert!(found.is_empty(), "{found:#?}");
    // Not vacuous: the parking brake's first demand has everything.
    let row = trace.rows.iter().find(|row| row.id == "SEAT-5a").ok_or("no SEAT-5a")?;
    assert_eq!(row.status, Status::Covered);
    assert!(!row.code.is_empty() && !row.properties.is_empty() && !row.harnesses.is_empty() && row.tests.len() > 2);
    assert!(rows(&trace, "SEAT-5").lines().count() > 20);
    let page = page(&trace)?;
    assert!(page.contains("SEAT-5a") && page.contains("default-src 'none'") && !page.contains("http://"));
    assert_eq!(json(&trace)["requirements"].as_array().map(Vec::len), Some(trace.rows.len()));
    Ok(())
}

#[test]
fn every_limit_of_the_table_is_found_in_its_source() -> Outcome {
    let trace = trace(Path::new(&project()))?;
    let tags = trace.scan.tags.iter().filter(|tag| tag.kind == Kind::Limit);
    let found: BTreeSet<_> = tags.map(|tag| (tag.place.item.clone(), tag.id.to_string())).collect();
    let rows = LIMITS.iter().map(|limit| (limit.name.to_owned(), limit.requirement.to_owned()));
    assert_eq!(found, rows.collect::<BTreeSet<_>>());
    Ok(())
}
