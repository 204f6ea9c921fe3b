//! The committed corpus of the fuzz targets that read files, and what became of every finding.

#[path = "../../fuzz/src/corpus.rs"]
mod corpus;
#[path = "../../fuzz/src/host.rs"]
mod host;

fn replay(target: &str, run: fn(&[u8])) {
    let files = corpus::files(target).unwrap_or_default();
    assert!(!files.is_empty(), "{} is empty", corpus::folder(target).display());
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
