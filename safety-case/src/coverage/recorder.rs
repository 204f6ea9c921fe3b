//! Records what ran, in the copy of the sources that coverage is measured on; nothing of it is shipped.
//!
//! What a process does for the first time goes at once to the end of the file that `SUPERVISE_COVERAGE` names, so nothing
//! is lost however the process ends. A line is `p POINT`, or `d DECISION EVALUATED VALUES OUTCOME`, or `f DECISION` for a
//! decision with more vectors than there is room for.

use std::cell::Cell;
use std::env;
use std::fs::{File, OpenOptions};
use std::io::Write;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Mutex, OnceLock, PoisonError};

/// Greatest number of points.
pub const POINTS: usize = 8192;
/// Greatest number of decisions.
pub const DECISIONS: usize = 2048;
/// Greatest number of conditions of one decision.
pub const CONDITIONS: usize = 24;
/// Greatest number of vectors of one decision.
const VECTORS: usize = 128;

static SEEN: [AtomicBool; POINTS] = [const { AtomicBool::new(false) }; POINTS];
static FULL: [AtomicBool; DECISIONS] = [const { AtomicBool::new(false) }; DECISIONS];
static VECTOR: [[AtomicU64; VECTORS]; DECISIONS] = [const { [const { AtomicU64::new(0) }; VECTORS] }; DECISIONS];
static OUT: OnceLock<Option<Mutex<File>>> = OnceLock::new();

/// A bit that makes the word of every vector differ from 0.
const PRESENT: u64 = 1 << 63;
const OUTCOME: u64 = 1 << 62;
const MASK: u64 = (1 << 24) - 1;

fn write(line: &str) {
    let open = || {
        let path = env::var_os("SUPERVISE_COVERAGE")?;
        OpenOptions::new().create(true).append(true).open(path).ok().map(Mutex::new)
    };
    if let Some(file) = OUT.get_or_init(open) {
        // Whoever reads misses a line that could not be written, and reports less.
        let _ = file.lock().unwrap_or_else(PoisonError::into_inner).write_all(line.as_bytes());
    }
}

/// This point was reached.
#[inline]
pub fn hit(point: usize) {
    if let Some(seen) = SEEN.get(point)
        && !seen.load(Ordering::Relaxed)
        && !seen.swap(true, Ordering::Relaxed)
    {
        write(&format!("p {point}\n"));
    }
}

/// What `?` stands behind.
pub trait Tried {
    /// Whether it goes on.
    fn goes_on(&self) -> bool;
}

impl<T> Tried for Option<T> {
    fn goes_on(&self) -> bool {
        self.is_some()
    }
}

impl<T, E> Tried for Result<T, E> {
    fn goes_on(&self) -> bool {
        self.is_ok()
    }
}

/// Reaches one of two points, by whether `?` goes on.
#[inline]
pub fn tried<T: Tried>(on: usize, back: usize, value: T) -> T {
    hit(if value.goes_on() { on } else { back });
    value
}

/// One evaluation of a decision.
#[derive(Debug)]
pub struct Eval {
    decision: usize,
    seen: Cell<u64>,
}

impl Eval {
    /// Nothing evaluated yet.
    #[inline]
    #[must_use]
    pub fn new(decision: usize) -> Self {
        Self { decision, seen: Cell::new(PRESENT) }
    }

    /// This condition was evaluated to this.
    #[inline]
    pub fn c(&self, condition: usize, value: bool) -> bool {
        self.seen.set(self.seen.get() | (1 << condition) | (u64::from(value) << (24 + condition)));
        value
    }

    /// The decision came to this.
    #[inline]
    pub fn done(self, outcome: bool) -> bool {
        let word = self.seen.get() | if outcome { OUTCOME } else { 0 };
        let Some(vectors) = VECTOR.get(self.decision) else { return outcome };
        let first = usize::try_from(word.wrapping_mul(0x9E37_79B9_7F4A_7C15) >> 57).unwrap_or(0);
        for slot in vectors.iter().cycle().skip(first).take(VECTORS) {
            let present = slot.load(Ordering::Relaxed);
            if present == word {
                return outcome;
            }
            if present == 0 {
                match slot.compare_exchange(0, word, Ordering::Relaxed, Ordering::Relaxed) {
                    Ok(_) => {
                        let (evaluated, values) = (word & MASK, (word >> 24) & MASK);
                        write(&format!("d {} {evaluated} {values} {}\n", self.decision, u8::from(outcome)));
                        return outcome;
                    }
                    Err(other) if other == word => return outcome,
                    Err(_) => {}
                }
            }
        }
        if FULL.get(self.decision).is_some_and(|full| !full.swap(true, Ordering::Relaxed)) {
            write(&format!("f {}\n", self.decision));
        }
        outcome
    }
}
