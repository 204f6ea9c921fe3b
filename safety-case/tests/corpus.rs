//! The committed corpus of the fuzz targets that read files, and what became of every finding.

#[path = "../../fuzz/src/host.rs"]
mod host;

use std::path::Path;

fn replay(target: &str, run: fn(&[u8])) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../fuzz/corpus").join(target);
    let entries = std::fs::read_dir(&folder).into_iter().flatten().filter_map(Result::ok);
    let files: Vec<Vec<u8>> = entries.filter_map(|entry| std::fs::read(entry.path()).ok()).collect();
    assert!(!files.is_empty(), "fuzz/corpus/{target} is empty");
    for bytes in &files {
        run(bytes);
    }
}

/// What is no log is refused line by line, never a panic.
#[test]
fn logs_never_panic() {
    replay("candump_log", host::candump_log);
}

/// What is no mapping or no DBC is refused, never a panic.
#[test]
fn mappings_and_dbcs_never_panic() {
    replay("dbc_map", host::dbc_map);
}
