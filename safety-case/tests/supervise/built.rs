//! What this program is built from.

use std::fs;

use safety_case::built::{BESIDE, SHIPPED, fingerprint};

use crate::common::Outcome;

/// A changed, a new and a moved file of what is built in are noticed; so is a folder that is not there.
#[test]
fn other_sources_have_another_fingerprint() -> Outcome {
    let root = tempfile::tempdir()?;
    assert!(fingerprint(root.path()).is_err(), "nothing is there");
    for folder in SHIPPED.iter().chain(&BESIDE) {
        fs::create_dir_all(root.path().join(folder).join("deep"))?;
    }
    let file = root.path().join("supervisor/terms/src/deep/limits.rs");
    let mut seen = vec![fingerprint(root.path())?];
    for text in ["corridor = 160", "corridor = 180"] {
        fs::write(&file, text)?;
        seen.push(fingerprint(root.path())?);
    }
    assert_eq!(seen.last(), Some(&fingerprint(root.path())?), "the same files, the same fingerprint");
    fs::rename(&file, root.path().join("tests/src/limits.rs"))?;
    seen.push(fingerprint(root.path())?);
    let count = seen.len();
    seen.sort();
    seen.dedup();
    assert_eq!(seen.len(), count, "{seen:?}");
    Ok(())
}
