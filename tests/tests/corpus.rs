//! The committed corpus of the fuzz targets, and what became of every finding, through the very functions that are fuzzed.

#[path = "../../fuzz/src/attack/mod.rs"]
mod attack;
mod common;

use attack::{Reached, command_stream, wire_bytes};
use std::path::Path;

/// Every file of a target's corpus, in the order of their names.
fn corpus(target: &str) -> Vec<Vec<u8>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../fuzz/corpus").join(target);
    let Ok(entries) = std::fs::read_dir(&folder) else { return Vec::new() };
    let mut files: Vec<_> = entries.filter_map(|entry| entry.ok().map(|entry| entry.path())).collect();
    files.sort();
    files.iter().filter_map(|file| std::fs::read(file).ok()).collect()
}

fn replay(target: &str, run: fn(&[u8], &mut Reached)) -> Reached {
    let files = corpus(target);
    assert!(!files.is_empty(), "fuzz/corpus/{target} is empty");
    let mut reached = Reached::default();
    for bytes in &files {
        run(bytes, &mut reached);
    }
    println!("{target}: {} files, {}", files.len(), reached.report());
    reached
}

/// SELF-1a, SELF-2a: every property holds in every cycle of the corpus, and its streams reach every mode.
#[test]
fn command_streams_keep_every_property() {
    let reached = replay("command_stream", command_stream);
    assert_eq!(reached.modes_missing(), Vec::<String>::new());
}

/// SELF-1a, SELF-2a, E2E-1a: the same of frames.
#[test]
fn frames_keep_every_property() {
    let reached = replay("wire_bytes", wire_bytes);
    assert!(reached.size() > 100, "{} modes and verdicts: the corpus has lost its reach", reached.size());
}
