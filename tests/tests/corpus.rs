//! The committed corpus of the fuzz targets, and what became of every finding, through the very functions that are fuzzed.

#[path = "../../fuzz/src/attack/mod.rs"]
mod attack;
mod common;
#[path = "../../fuzz/src/corpus.rs"]
mod corpus;
#[path = "oracle/mod.rs"]
mod oracle;

use attack::{Reached, command_stream, differential, wire_bytes};

fn replay(target: &str, run: fn(&[u8], &mut Reached)) -> Reached {
    let files = corpus::files(target).unwrap_or_default();
    assert!(!files.is_empty(), "{} is empty", corpus::folder(target).display());
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
    assert!(reached.size() > 160, "{} modes and verdicts: the corpus has lost its reach", reached.size());
}

/// SELF-2b: the independent oracle agrees in every cycle of its corpus, and the corpus reaches every mode.
#[test]
fn the_oracle_agrees() {
    let reached = replay("differential", differential);
    assert_eq!(reached.modes_missing(), Vec::<String>::new());
}

/// SELF-2a: what a fuzzer reports as vetted is what it vetted, and it keeps nothing else.
#[test]
fn a_fuzzer_counts_every_cycle() {
    let (mut all, mut counted) = (Reached::default(), Reached::only_cycles());
    for bytes in corpus::files("command_stream").unwrap_or_default().iter().take(10) {
        command_stream(bytes, &mut all);
        command_stream(bytes, &mut counted);
    }
    assert!(all.cycles > 0 && all.size() > 0);
    assert_eq!((counted.cycles, counted.size()), (all.cycles, 0));
}
