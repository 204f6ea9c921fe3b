//! Golden vectors: what is kept of them is what is made, and they say what the drives say.

use std::error::Error;
use std::path::{Path, PathBuf};

use supervisor::wire::Frame;
use supervisor_tests::catalogue;
use supervisor_tests::drive::replay;
use supervisor_tests::vectors::columns::{Column, decision};
use supervisor_tests::vectors::digest::{Digest, digest};
use supervisor_tests::vectors::files::{VectorError, all, keep, vectors};
use supervisor_tests::vectors::{Made, boundary, run};

type Outcome = Result<(), Box<dyn Error>>;

fn kept(file: &str) -> PathBuf {
    [env!("CARGO_MANIFEST_DIR"), "vectors", file].iter().collect()
}

/// SELF-3a: the vectors are made to the same bytes every time, and the committed ones are those.
#[test]
fn the_vectors_regenerate_to_what_is_kept() -> Outcome {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../target/vectors");
    std::fs::create_dir_all(&folder)?;
    let sums = all(&folder, &mut |_, _| ())?;
    let mut total = 0;
    for (name, bytes) in keep(&folder, &sums)? {
        let again = "is not what is kept: run `cargo run --release -p supervisor-tests --bin make-vectors`";
        assert!(std::fs::read(kept(&name)).is_ok_and(|committed| committed == bytes), "{name} {again}");
        total += bytes.len();
    }
    assert!(total < 300 * 1024, "{total} bytes are kept");
    Ok(())
}

/// SELF-3a: a vector of a drive has the decisions of its replay.
#[test]
fn a_vector_decides_as_the_replay() -> Outcome {
    let scenario = catalogue::named("approach-misbehaving").ok_or("no such drive")?;
    let vector = vectors()?.into_iter().find(|vector| vector.name == scenario.name).ok_or("no such vector")?;
    let log = Path::new(env!("CARGO_MANIFEST_DIR")).join("drives/approach-misbehaving.candump.gz");
    let frames = supervisor_tests::candump::unpacked(&std::fs::read(log)?)?;
    let mut answers = replay(&frames, scenario.length_ms)?.into_iter();
    run(&vector, |read, made| {
        let answer = answers.next();
        let same = answer.is_some_and(|answer| {
            let decided = (made.decision.outputs, made.decision.verdicts, made.decision.status);
            (answer.outputs, answer.verdicts, answer.status) == decided
        });
        assert!(same, "at {} ms", read.now_ms);
        Ok::<(), VectorError>(())
    })?;
    assert_eq!(answers.count(), 0, "cycles are missing");
    Ok(())
}

/// CMD-5b: the boundary set meets every kind of verdict on every channel that has it, and many reasons.
#[test]
fn the_boundary_set_meets_the_boundaries() -> Outcome {
    let mut met = std::collections::BTreeSet::new();
    let mut cycles = 0;
    for vector in boundary::all() {
        run(&vector, |_, made: &Made| {
            for (channel, verdict) in made.decision.verdicts.iter() {
                met.insert((channel, verdict.kind, verdict.reason));
            }
            cycles += 1;
            Ok::<(), VectorError>(())
        })?;
    }
    let reasons: std::collections::BTreeSet<_> = met.iter().map(|(.., reason)| *reason).collect();
    let kinds: std::collections::BTreeSet<_> = met.iter().map(|(channel, kind, _)| (*channel, *kind)).collect();
    println!("{cycles} cycles, {} reasons, {} kinds on channels", reasons.len(), kinds.len());
    assert!(cycles < 8_000, "{cycles} cycles are too many to read");
    assert!(reasons.len() >= 39, "only {} reasons: {reasons:?}", reasons.len());
    assert!(kinds.len() >= 38, "only {}: {kinds:?}", kinds.len());
    Ok(())
}

/// SELF-3a: the digest is FNV-1a, and changes with every column and every frame.
#[test]
fn the_digest_changes_with_everything() -> Outcome {
    let mut fnv = Digest::default();
    fnv.bytes(b"foobar");
    assert_eq!(fnv.finish(), 0x8594_4171_F739_67E8, "a published value");
    let vector = boundary::all().into_iter().next().ok_or("no vector")?;
    let mut first = None;
    run(&vector, |_, made| {
        first.get_or_insert_with(|| made.clone());
        Ok::<(), VectorError>(())
    })?;
    let made = first.ok_or("no cycle")?;
    let columns = decision(&made);
    let whole = digest(&made.decision, &made.sent);
    let of = |columns: &[Column], sent: &[Frame]| {
        let mut digest = Digest::default();
        for (_, value) in columns {
            digest.field(*value);
        }
        for frame in sent {
            digest.frame(frame);
        }
        digest.finish()
    };
    assert_eq!(of(&columns, &made.sent), whole, "the columns are all that is digested");
    assert_eq!(columns.len(), 112, "60 of verdicts, 42 of outputs, 10 of the status");
    for at in 0..columns.len() {
        let mut changed = columns.clone();
        changed[at].1 ^= 1;
        assert_ne!(of(&changed, &made.sent), whole, "{}", changed[at].0);
    }
    assert_eq!(made.sent.len(), 16);
    for at in 0..made.sent.len() {
        let mut changed = made.sent.clone();
        changed[at].data[7] ^= 1;
        assert_ne!(of(&columns, &changed), whole);
    }
    Ok(())
}
