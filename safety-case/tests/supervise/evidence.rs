//! `supervise evidence`: the folder, and that its check sees each kind of defect planted in a copy of the project.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use cyclonedx_bom::prelude::{Bom, Validate};
use serde_json::Value;

use crate::common::{Outcome, project, supervise_in};

/// What a copy of the project is made of.
const COPIED: [&str; 10] = [
    "supervisor",
    "proofs",
    "tests",
    "fuzz",
    "safety-case",
    ".ci",
    "README.md",
    "Cargo.toml",
    "Cargo.lock",
    "clippy.toml",
];

fn copied() -> Result<tempfile::TempDir, Box<dyn std::error::Error>> {
    let (root, folder) = (project(), tempfile::tempdir()?);
    for name in COPIED {
        let walk = walkdir::WalkDir::new(root.join(name)).into_iter();
        for entry in walk.filter_entry(|entry| entry.file_name() != "target" && entry.file_name() != "corpus") {
            let entry = entry?;
            let to = folder.path().join(entry.path().strip_prefix(&root)?);
            if entry.file_type().is_dir() {
                fs::create_dir_all(&to)?;
            } else {
                fs::copy(entry.path(), &to)?;
            }
        }
    }
    Ok(folder)
}

/// The lines of findings of `--check`, and its exit code.
fn check(root: &Path, out: &Path) -> Result<(i32, String), Box<dyn std::error::Error>> {
    let (root, out) = (root.display().to_string(), out.display().to_string());
    let ran = supervise_in(Path::new("."), &["evidence", "--check", "--root", &root, "--out", &out])?;
    let findings = ran.out.lines().skip_while(|line| !line.contains(" open items, "));
    Ok((ran.code, findings.collect::<Vec<_>>().join("\n") + &ran.err))
}

/// A file, what stands in it, what is planted in its place, and what the check says of it.
const PLANTS: [(&str, &str, &str, &str); 11] = [
    ("supervisor/core/src/gear.rs", "(GEAR-1", "(GEAR-99", "traceability: supervisor/core/src/gear.rs"),
    ("tests/tests/gear.rs", "/// GEAR-1a: P at", "/// A test: P at", "[UntaggedTest]"),
    ("safety-case/analysis/goals.toml", "ftti_ms = 1200", "ftti_ms = 12", "[ChainTooLong]"),
    (
        "safety-case/analysis/timing.toml",
        "value_ms = 125\nconfig",
        "value_ms = 120\nconfig",
        "timing.toml: TM-10: says 120 ms",
    ),
    (
        "safety-case/analysis/timing.toml",
        "config = \"timeout_100\"",
        "config = \"timeout_1\"",
        "timeout_1 is not in the table of limits",
    ),
    ("safety-case/analysis/fmea.toml", "\"SEAT-1a\"", "\"SEAT-99z\"", "refers to SEAT-99z, which nothing defines"),
    ("safety-case/analysis/fmea.toml", "harness seat_1_leave_exactly", "harness seat_0", "harness seat_0 is not there"),
    (
        "safety-case/analysis/fmea.toml",
        "\"supervisor/core/src/gear.rs\"",
        "\"supervisor/core/src/seat.rs\"",
        "is a part that no failure mode speaks of",
    ),
    ("safety-case/argument/own.gsn.yaml", "fault FI-81", "fault FI-999", "fault FI-999 is not there"),
    (
        "safety-case/argument/index.gsn.yaml",
        "supportedBy: [S-Top]",
        "supportedBy: [S-Nowhere]",
        "refers to S-Nowhere, which nothing defines",
    ),
    ("safety-case/argument/index.gsn.yaml", "statement of conformity", "Certified system", "says \"certified\""),
];

/// The same, of what one defect would hide of another: one at a time.
const ALONE: [(&str, &str, &str, &str); 3] = [
    ("README.md", " dangerous runs of faults", "9 dangerous runs of faults", "a figure is not that of its record"),
    ("safety-case/README.md", "<!-- evidence records:", "<!-- records:", "has no table of the records"),
    ("safety-case/records/inject.json", "\"averted\":1", "\"averted\":2", "a figure is not that of its record"),
];

#[test]
fn every_planted_defect_turns_the_check_red() -> Outcome {
    let folder = copied()?;
    let root = folder.path();
    let out = root.join("target/evidence");
    assert_eq!(check(root, &out)?.0, 0, "{}", check(root, &out)?.1);
    let plant = |name: &str, from: &str, to: &str| -> Result<String, Box<dyn std::error::Error>> {
        let text = fs::read_to_string(root.join(name))?;
        assert!(text.contains(from), "{name} has no {from}");
        fs::write(root.join(name), text.replacen(from, to, 1))?;
        Ok(text)
    };
    for (name, from, to, says) in ALONE {
        let before = plant(name, from, to)?;
        let (code, findings) = check(root, &out)?;
        assert!(code == 1 && findings.contains(says), "{name}: {to}: {code}\n{findings}");
        fs::write(root.join(name), before)?;
    }
    // The others are named one by one, so they may be planted together: each run takes seconds.
    for (name, from, to, _) in PLANTS {
        plant(name, from, to)?;
    }
    let (code, findings) = check(root, &out)?;
    assert_eq!(code, 1);
    for (name, _, to, says) in PLANTS {
        assert!(findings.contains(says), "{name}: {to}: not found\n{findings}");
    }
    Ok(())
}

fn files(folder: &Path) -> Result<BTreeMap<PathBuf, Vec<u8>>, Box<dyn std::error::Error>> {
    let mut files = BTreeMap::new();
    for entry in walkdir::WalkDir::new(folder) {
        let entry = entry?;
        if entry.file_type().is_file() {
            files.insert(entry.path().strip_prefix(folder)?.to_owned(), fs::read(entry.path())?);
        }
    }
    Ok(files)
}

#[test]
fn two_runs_give_the_same_folder_and_its_manifest_holds() -> Outcome {
    let folder = tempfile::tempdir()?;
    let root = project().display().to_string();
    let out = |name: &str| folder.path().join(name);
    for name in ["one", "two"] {
        let path = out(name).display().to_string();
        let ran = supervise_in(folder.path(), &["evidence", "--no-drives", "--root", &root, "--out", &path])?;
        assert_eq!(ran.code, 0, "{}{}", ran.out, ran.err);
    }
    let (mut one, mut two) = (files(&out("one"))?, files(&out("two"))?);
    for files in [&mut one, &mut two] {
        assert!(files.remove(Path::new("run.json")).is_some());
    }
    assert_eq!(one.keys().collect::<Vec<_>>(), two.keys().collect::<Vec<_>>());
    for (name, bytes) in &one {
        assert!(two.get(name) == Some(bytes), "{} differs", name.display());
    }
    exports(&one)?;

    // A byte more, a file more, a file less: each is seen.
    assert_eq!(check(&project(), &out("one"))?.0, 0);
    let text = fs::read_to_string(out("one").join("trace.json"))?;
    fs::write(out("one").join("trace.json"), text + " ")?;
    fs::write(out("one").join("more.txt"), "more")?;
    fs::remove_file(out("one").join("needs.json"))?;
    let (code, findings) = check(&project(), &out("one"))?;
    assert_eq!(code, 1);
    for says in [
        "trace.json: has another digest",
        "more.txt: is not in the manifest",
        "needs.json: is in the manifest, and is gone",
    ] {
        assert!(findings.contains(says), "{says}: {findings}");
    }

    // What is not ours is not overwritten.
    let path = out("one").display().to_string();
    let ran = supervise_in(folder.path(), &["evidence", "--no-drives", "--root", &root, "--out", &path])?;
    assert!(ran.code == 2 && ran.err.contains("more.txt"), "{}", ran.err);
    Ok(())
}

/// The exports are what they say they are, and hold what they must.
fn exports(files: &BTreeMap<PathBuf, Vec<u8>>) -> Outcome {
    let file = |name: &str| files.get(Path::new(name)).ok_or_else(|| format!("no {name}"));
    let json = |name: &str| -> Result<Value, Box<dyn std::error::Error>> { Ok(serde_json::from_slice(file(name)?)?) };
    let requirements = json("trace.json")?["requirements"].as_array().map_or(0, Vec::len);
    assert!(requirements > 300);

    let needs = json("needs.json")?;
    let version = needs["current_version"].as_str().ok_or("no version")?.to_owned();
    let needs = needs["versions"][&version]["needs"].as_object().ok_or("no needs")?.clone();
    assert_eq!(needs.values().filter(|need| need["type"] == "req").count(), requirements);
    for (id, need) in &needs {
        let links = need["links"].as_array().ok_or("no links")?;
        assert!(links.iter().all(|link| link.as_str().is_some_and(|link| needs.contains_key(link))), "{id}: {links:?}");
    }
    // sphinx-needs is told of every type, and of every field that it does not have by itself.
    let told: toml::Table = String::from_utf8_lossy(file("needs.toml")?).parse()?;
    let types = told["needs"]["types"].as_array().ok_or("no types")?;
    let fields = told["needs"]["fields"].as_table().ok_or("no fields")?;
    let own = ["id", "type", "title", "content", "status", "tags", "links"];
    for (id, need) in &needs {
        assert!(types.iter().any(|one| one["directive"].as_str() == need["type"].as_str()), "{id}: {}", need["type"]);
        let mut names = need.as_object().ok_or("no need")?.keys();
        assert!(names.all(|name| own.contains(&name.as_str()) || fields.contains_key(name)), "{id}: {need}");
    }

    let sdoc = String::from_utf8_lossy(file("requirements.sdoc")?).into_owned();
    assert_eq!(sdoc.lines().filter(|line| *line == "[REQUIREMENT]").count(), requirements);

    let report = quick_junit::Report::deserialize(file("tests.xml")?.as_slice())?;
    let cases: Vec<_> = report.test_suites.iter().flat_map(|suite| &suite.test_cases).collect();
    let verifies = |case: &&&quick_junit::TestCase| {
        case.properties.iter().any(|property| property.name.as_str() == "PartiallyVerifies")
    };
    assert!(cases.len() > 500 && cases.iter().filter(verifies).count() > 300, "{}", cases.len());

    let bom = Bom::parse_from_json(file("sbom.cdx.json")?.as_slice())?;
    assert!(bom.validate().passed(), "{:?}", bom.validate());
    assert!(bom.components.is_some_and(|components| components.0.iter().any(|one| one.name.to_string() == "heapless")));

    let page = String::from_utf8_lossy(file("index.html")?).into_owned();
    let (open, records) = (page.find("<h2>Open</h2>"), page.find("<h2>Records</h2>"));
    assert!(open.is_some() && open < records, "open items come first");
    assert!(!page.contains("src=\"http") && !page.contains("<script"), "the page stands alone");
    assert!(page.contains("undeveloped") && page.contains("not run"));
    Ok(())
}

#[test]
fn a_record_that_is_gone_is_not_run_and_a_changed_source_makes_it_stale() -> Outcome {
    let folder = copied()?;
    let root = folder.path();
    fs::remove_file(root.join("safety-case/records/coverage.json"))?;
    let path = root.join("supervisor/core/src/gear.rs");
    let text = fs::read_to_string(&path)?;
    fs::write(&path, text + "\nconst _: u8 = 0;\n")?;
    let out = root.join("out").display().to_string();
    let shown = root.display().to_string();
    let ran = supervise_in(root, &["evidence", "--no-drives", "--root", &shown, "--out", &out])?;
    let stands = |title: &str| ran.out.lines().find(|line| line.ends_with(title)).unwrap_or_default().to_owned();
    assert!(stands("Structural coverage of decide and vet").starts_with("not run"), "{}", ran.out);
    assert!(stands("Proofs by model checking").starts_with("stale"), "{}", ran.out);
    assert!(stands("Faults injected into correct drives").starts_with("stale"), "{}", ran.out);
    // Published figures say so, too.
    assert!(ran.code == 1 && ran.out.contains("a figure is not that of its record"), "{}", ran.out);
    Ok(())
}
