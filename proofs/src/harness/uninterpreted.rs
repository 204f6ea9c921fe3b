//! Kernels of which nothing is known but that they are functions: equal arguments give equal results.
//!
//! A harness that puts them in the place of multiplications and divisions proves its properties for *any* arithmetic
//! there, and so for the real one; what the real one gives is the matter of its own contracts (`proofs/creusot`).

use core::sync::atomic::{AtomicU64, AtomicUsize, Ordering};

/// More calls than any harness makes; one more is a failed proof, not a silent one.
const CALLS: usize = 16;

/// The calls of one function so far.
struct Calls {
    count: AtomicUsize,
    arguments: [AtomicU64; CALLS],
    results: [AtomicU64; CALLS],
}

impl Calls {
    const fn new() -> Self {
        Self {
            count: AtomicUsize::new(0),
            arguments: [const { AtomicU64::new(0) }; CALLS],
            results: [const { AtomicU64::new(0) }; CALLS],
        }
    }

    /// Any result, but the one of before where the arguments are those of before: no assumption narrows the first.
    fn of(&self, arguments: u64) -> u64 {
        let (count, result): (usize, u64) = (self.count.load(Ordering::Relaxed), kani::any());
        assert!(count < CALLS);
        for call in 0..CALLS {
            let same = call < count && self.arguments[call].load(Ordering::Relaxed) == arguments;
            kani::assume(!same || self.results[call].load(Ordering::Relaxed) == result);
        }
        self.arguments[count].store(arguments, Ordering::Relaxed);
        self.results[count].store(result, Ordering::Relaxed);
        self.count.store(count + 1, Ordering::Relaxed);
        result
    }
}

fn low<T: TryFrom<u64>>(wide: u64, mask: u64) -> T {
    T::try_from(wide & mask).unwrap_or_else(|_| unreachable!())
}

/// For [`kernel::portion`](supervisor_core::kernel::portion).
pub(super) fn portion(per_second: u16, elapsed: u32, rest: u16) -> (u32, u16) {
    static SEEN: Calls = Calls::new();
    let result = SEEN.of(u64::from(per_second) << 48 | u64::from(elapsed) << 16 | u64::from(rest));
    (low(result, 0xFFFF_FFFF), low(result >> 32, 0xFFFF))
}

/// For [`kernel::between_down`](supervisor_core::kernel::between_down).
pub(super) fn between_down(here: u8, next: u8, rest: u8, step: u8) -> u8 {
    static SEEN: Calls = Calls::new();
    let result = SEEN.of(u64::from(u32::from_be_bytes([here, next, rest, step])));
    low(result, 0xFF)
}

/// For [`kernel::within_percent`](supervisor_core::kernel::within_percent).
pub(super) fn within_percent(difference: u16, percent: u8, of: u16) -> bool {
    static SEEN: Calls = Calls::new();
    SEEN.of(u64::from(difference) << 24 | u64::from(percent) << 16 | u64::from(of)) & 1 == 1
}

/// For [`kernel::share_down`](supervisor_core::kernel::share_down).
pub(super) fn share_down(value: u16, percent: u8) -> u16 {
    static SEEN: Calls = Calls::new();
    low(SEEN.of(u64::from(value) << 8 | u64::from(percent)), 0xFFFF)
}
