//! How many cycles a fuzzer has vetted: libFuzzer counts inputs only.

use std::sync::atomic::{AtomicU64, Ordering::Relaxed};

static INPUTS: AtomicU64 = AtomicU64::new(0);
static CYCLES: AtomicU64 = AtomicU64::new(0);

/// Adds the cycles of one input. Every 256 inputs the sum goes to the file that `TALLY` names; what comes after the last of them
/// is not counted.
pub fn add(cycles: u64) {
    let sum = CYCLES.fetch_add(cycles, Relaxed) + cycles;
    if INPUTS.fetch_add(1, Relaxed) % 256 == 255
        && let Some(file) = std::env::var_os("TALLY")
    {
        // A tally that cannot be written shows up as one that is missing.
        let _ignored = std::fs::write(file, sum.to_string());
    }
}
