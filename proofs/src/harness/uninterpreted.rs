//! Kernels of which nothing is known but that they are functions: equal arguments give equal results.
//!
//! A harness that puts them in the place of multiplications and divisions proves its properties for *any* arithmetic
//! there, and so for the real one; what the real one gives is the matter of its own contracts (`proofs/creusot`), or of a
//! harness of its own.

use core::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering};

use supervisor_core::word::Word;
use supervisor_core::{ClosingCmS, DistanceCm, Follow, Millis};
use supervisor_wire::{Fault, Protection};

/// More calls than any harness makes; one more is a failed proof, not a silent one.
const CALLS: usize = 16;

/// The calls of one function so far: their arguments and results, in so many words.
struct Calls<const A: usize> {
    count: AtomicUsize,
    arguments: [[AtomicU64; A]; CALLS],
    results: [[AtomicU64; 2]; CALLS],
}

/// Whether these are the words that were stored.
fn stored<const N: usize>(slots: &[AtomicU64; N], words: [u64; N]) -> bool {
    let mut same = true;
    for (slot, word) in slots.iter().zip(words) {
        same &= slot.load(Ordering::Relaxed) == word;
    }
    same
}

fn store<const N: usize>(slots: &[AtomicU64; N], words: [u64; N]) {
    for (slot, word) in slots.iter().zip(words) {
        slot.store(word, Ordering::Relaxed);
    }
}

impl<const A: usize> Calls<A> {
    const fn new() -> Self {
        Self {
            count: AtomicUsize::new(0),
            arguments: [const { [const { AtomicU64::new(0) }; A] }; CALLS],
            results: [const { [const { AtomicU64::new(0) }; 2] }; CALLS],
        }
    }

    /// `result` may be any, but is the one of before where the arguments are those of before: the first of them is not
    /// narrowed.
    fn agree(&self, arguments: [u64; A], result: [u64; 2]) {
        let count = self.count.load(Ordering::Relaxed);
        assert!(count < CALLS);
        for call in 0..CALLS {
            let same = call < count && stored(&self.arguments[call], arguments);
            kani::assume(!same || stored(&self.results[call], result));
        }
        store(&self.arguments[count], arguments);
        store(&self.results[count], result);
        self.count.store(count + 1, Ordering::Relaxed);
    }
}

/// The first call of a function that a harness calls again and again with the same arguments: other ones may give
/// anything, which proves no less.
struct First {
    called: AtomicBool,
    arguments: AtomicU64,
    result: AtomicU64,
}

impl First {
    const fn new() -> Self {
        Self { called: AtomicBool::new(false), arguments: AtomicU64::new(0), result: AtomicU64::new(0) }
    }

    fn agree(&self, arguments: u64, result: u64) {
        if self.called.load(Ordering::Relaxed) {
            let same = self.arguments.load(Ordering::Relaxed) == arguments;
            kani::assume(!same || self.result.load(Ordering::Relaxed) == result);
        } else {
            self.called.store(true, Ordering::Relaxed);
            self.arguments.store(arguments, Ordering::Relaxed);
            self.result.store(result, Ordering::Relaxed);
        }
    }
}

/// For [`kernel::portion`](supervisor_core::kernel::portion).
pub(super) fn portion(per_second: u16, elapsed: u32, rest: u16) -> (u32, u16) {
    static SEEN: Calls<1> = Calls::new();
    let (whole, left): (u32, u16) = kani::any();
    let arguments = u64::from(per_second) << 48 | u64::from(elapsed) << 16 | u64::from(rest);
    SEEN.agree([arguments], [u64::from(whole), u64::from(left)]);
    (whole, left)
}

/// For [`kernel::between_down`](supervisor_core::kernel::between_down).
pub(super) fn between_down(here: u8, next: u8, rest: u8, step: u8) -> u8 {
    static SEEN: First = First::new();
    let result: u8 = kani::any();
    SEEN.agree(u64::from(u32::from_be_bytes([here, next, rest, step])), u64::from(result));
    result
}

/// For [`kernel::together`](supervisor_core::kernel::together) of what goes out.
pub(super) fn together(service: u16, each: u16, percents: u8) -> u16 {
    static SEEN: First = First::new();
    let result: u16 = kani::any();
    SEEN.agree(u64::from(service) << 24 | u64::from(each) << 8 | u64::from(percents), u64::from(result));
    result
}

/// For [`kernel::within_percent`](supervisor_core::kernel::within_percent) of the two speeds of one cycle.
pub(super) fn within_percent_of_one(difference: u16, percent: u8, of: u16) -> bool {
    static SEEN: First = First::new();
    let result: bool = kani::any();
    let arguments = u64::from(difference) << 24 | u64::from(percent) << 16 | u64::from(of);
    SEEN.agree(arguments, u64::from(result));
    result
}

/// For [`kernel::between_up`](supervisor_core::kernel::between_up): of which it is also known, from its contract, that it lies
/// between its two points.
pub(super) fn between_up(here: u16, next: u16, rest: u16, step: u16) -> u16 {
    static SEEN: Calls<1> = Calls::new();
    let result: u16 = kani::any();
    kani::assume(rest >= step || (result >= here && result <= here.max(next)));
    let arguments = u64::from(here) << 48 | u64::from(next) << 32 | u64::from(rest) << 16 | u64::from(step);
    SEEN.agree([arguments], [u64::from(result), 0]);
    result
}

/// For [`kernel::within_percent`](supervisor_core::kernel::within_percent).
pub(super) fn within_percent(difference: u16, percent: u8, of: u16) -> bool {
    static SEEN: Calls<1> = Calls::new();
    let result: bool = kani::any();
    let arguments = u64::from(difference) << 24 | u64::from(percent) << 16 | u64::from(of);
    SEEN.agree([arguments], [u64::from(result), 0]);
    result
}

/// For [`kernel::share_down`](supervisor_core::kernel::share_down).
pub(super) fn share_down(value: u16, percent: u8) -> u16 {
    static SEEN: Calls<1> = Calls::new();
    let result: u16 = kani::any();
    SEEN.agree([u64::from(value) << 8 | u64::from(percent)], [u64::from(result), 0]);
    result
}

fn words(follow: Follow) -> [u64; 2] {
    let Follow { reference, start, command, response, following } = follow;
    let small = u64::from(reference) << 32 | u64::from(start) << 16 | u64::from(following);
    [small, u64::from(command.to_word()) << 32 | u64::from(response.to_word())]
}

/// For [`Follow::advance`]: without a target it begins anew, with nothing measured it stays (both proved by
/// `rsp_1_actuator_follows`, which calls the real one); anything else may be.
pub(super) fn follow(old: Follow, target: u16, measured: Option<u16>, error: u8, elapsed: Millis) -> Follow {
    static SEEN: Calls<4> = Calls::new();
    let result: Follow = kani::any();
    let [small, timers] = words(old);
    let told = u64::from(target) << 16 | u64::from(measured.unwrap_or(0));
    SEEN.agree([small, timers, told, u64::from(elapsed.raw()) << 8 | u64::from(error)], words(result));
    match (target, measured) {
        (0, _) => Follow::INITIAL,
        (_, None) => old,
        (_, Some(_)) => result,
    }
}

/// For [`kernel::nearer_than`](supervisor_core::kernel::nearer_than).
pub(super) fn nearer_than(distance: u16, closing: u16, limit: u32) -> bool {
    static SEEN: Calls<1> = Calls::new();
    let result: bool = kani::any();
    let arguments = u64::from(limit) << 32 | u64::from(distance) << 16 | u64::from(closing);
    SEEN.agree([arguments], [u64::from(result), 0]);
    result
}

/// For [`kernel::farther_than`](supervisor_core::kernel::farther_than).
pub(super) fn farther_than(distance: u16, closing: u16, limit: u32) -> bool {
    static SEEN: Calls<1> = Calls::new();
    let result: bool = kani::any();
    let arguments = u64::from(limit) << 32 | u64::from(distance) << 16 | u64::from(closing);
    SEEN.agree([arguments], [u64::from(result), 0]);
    result
}

/// For [`kernel::needed`](supervisor_core::kernel::needed).
pub(super) fn needed(closing: u16, gap: u16) -> u16 {
    static SEEN: Calls<1> = Calls::new();
    let result: u16 = kani::any();
    SEEN.agree([u64::from(closing) << 16 | u64::from(gap)], [u64::from(result), 0]);
    result
}

/// For [`moved`](supervisor_perceive::moved) to now.
pub(super) fn moved(distance: DistanceCm, closing: ClosingCmS, age: Millis, then: Millis) -> DistanceCm {
    static SEEN: Calls<1> = Calls::new();
    assert!(then == Millis::ZERO);
    let result: u16 = kani::any();
    let speed = u64::from(closing.raw().cast_unsigned());
    let arguments = u64::from(age.raw()) << 32 | u64::from(distance.raw()) << 16 | speed;
    SEEN.agree([arguments], [u64::from(result), 0]);
    DistanceCm::new(result)
}

/// For [`kernel::share_up`](supervisor_core::kernel::share_up).
pub(super) fn share_up(full: u16, part: u8, whole: u8) -> u16 {
    static SEEN: Calls<1> = Calls::new();
    let result: u16 = kani::any();
    let arguments = u64::from(full) << 16 | u64::from(part) << 8 | u64::from(whole);
    SEEN.agree([arguments], [u64::from(result), 0]);
    result
}

/// For [`kernel::fallen`](supervisor_core::kernel::fallen).
pub(super) fn fallen(per_second: u16, elapsed: u32) -> u16 {
    static SEEN: Calls<1> = Calls::new();
    let result: u16 = kani::any();
    SEEN.agree([u64::from(per_second) << 32 | u64::from(elapsed)], [u64::from(result), 0]);
    result
}

/// For [`kernel::together`](supervisor_core::kernel::together).
pub(super) fn with_retarder(service: u16, each: u16, percents: u8) -> u16 {
    static SEEN: Calls<1> = Calls::new();
    let result: u16 = kani::any();
    let arguments = u64::from(service) << 32 | u64::from(each) << 16 | u64::from(percents);
    SEEN.agree([arguments], [u64::from(result), 0]);
    result
}

/// For [`kernel::fits`](supervisor_core::kernel::fits).
pub(super) fn fits(room: u16, each: u16) -> u8 {
    static SEEN: Calls<1> = Calls::new();
    let result: u8 = kani::any();
    SEEN.agree([u64::from(room) << 16 | u64::from(each)], [u64::from(result), 0]);
    result
}

/// For [`Protection::open`]: of which it is also known, proved by `e2e_1_profile_11` and `e2e_1_j1939`, that a counter is one of
/// the protection's, and that a bare message has none.
pub(super) fn open(of: Protection, id: u32, payload: u64) -> Result<Option<u8>, Fault> {
    static SEEN: Calls<2> = Calls::new();
    if of == Protection::Bare {
        return Ok(None);
    }
    let (counter, no_counter, checksum): (u8, bool, bool) = kani::any();
    let result = match (no_counter, checksum) {
        (true, _) => Err(Fault::NoCounter),
        (false, true) => Err(Fault::Checksum),
        (false, false) => Ok(Some(counter)),
    };
    kani::assume(counter < of.counts());
    let told = u64::from(counter) << 2 | u64::from(no_counter) << 1 | u64::from(checksum);
    SEEN.agree([u64::from(of.counts()) << 32 | u64::from(id), payload], [told, 0]);
    result
}
