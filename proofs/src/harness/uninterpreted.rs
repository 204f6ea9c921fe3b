//! Kernels of which nothing is known but that they are functions: equal arguments give equal results.
//!
//! A harness that puts them in the place of multiplications and divisions proves its properties for *any* arithmetic
//! there, and so for the real one; what the real one gives is the matter of its own contracts (`proofs/creusot`), or of a
//! harness of its own.

use core::sync::atomic::{AtomicBool, AtomicU64, Ordering};

use supervisor_core::word::Word;
use supervisor_core::{ClosingCmS, DistanceCm, Follow, Millis};
use supervisor_wire::{Fault, Protection};

/// One call: its arguments and its result, in so many words.
struct Call<const A: usize, const R: usize> {
    made: AtomicBool,
    arguments: [AtomicU64; A],
    result: [AtomicU64; R],
}

impl<const A: usize, const R: usize> Call<A, R> {
    const NEVER: Self = Self {
        made: AtomicBool::new(false),
        arguments: [const { AtomicU64::new(0) }; A],
        result: [const { AtomicU64::new(0) }; R],
    };
}

/// The last calls of one function, the latest first. A call that is forgotten may give anything: that proves no less.
///
/// Whole words in fixed places, moved on with every call: a symbolic place would cost CBMC more than the proof itself.
struct Calls<const N: usize, const A: usize, const R: usize>([Call<A, R>; N]);

/// Whether these are the words that were stored.
fn stored<const K: usize>(words: &[AtomicU64; K], expected: [u64; K]) -> bool {
    let (mut same, mut word) = (true, 0);
    while word < K {
        same &= words[word].load(Ordering::Relaxed) == expected[word];
        word += 1;
    }
    same
}

fn store<const K: usize>(words: &[AtomicU64; K], new: [u64; K]) {
    let mut word = 0;
    while word < K {
        words[word].store(new[word], Ordering::Relaxed);
        word += 1;
    }
}

fn copy<const K: usize>(from: &[AtomicU64; K], to: &[AtomicU64; K]) {
    let mut word = 0;
    while word < K {
        to[word].store(from[word].load(Ordering::Relaxed), Ordering::Relaxed);
        word += 1;
    }
}

impl<const N: usize, const A: usize, const R: usize> Calls<N, A, R> {
    const fn new() -> Self {
        Self([const { Call::NEVER }; N])
    }

    /// `result` may be any, but is the one of before where the arguments are those of before: the first of them is not
    /// narrowed.
    fn agree(&self, arguments: [u64; A], result: [u64; R]) {
        let mut place = N;
        while place > 0 {
            place -= 1;
            let call = &self.0[place];
            let same = call.made.load(Ordering::Relaxed) & stored(&call.arguments, arguments);
            kani::assume(!same | stored(&call.result, result));
            if place + 1 < N {
                let next = &self.0[place + 1];
                next.made.store(call.made.load(Ordering::Relaxed), Ordering::Relaxed);
                copy(&call.arguments, &next.arguments);
                copy(&call.result, &next.result);
            }
        }
        let latest = &self.0[0];
        latest.made.store(true, Ordering::Relaxed);
        store(&latest.arguments, arguments);
        store(&latest.result, result);
    }
}

/// For [`kernel::portion`](supervisor_core::kernel::portion).
pub(super) fn portion(per_second: u16, elapsed: u32, rest: u16) -> (u32, u16) {
    static SEEN: Calls<8, 1, 1> = Calls::new();
    let (whole, left): (u32, u16) = kani::any();
    let arguments = u64::from(per_second) << 48 | u64::from(elapsed) << 16 | u64::from(rest);
    SEEN.agree([arguments], [u64::from(whole) << 16 | u64::from(left)]);
    (whole, left)
}

/// For [`kernel::between_down`](supervisor_core::kernel::between_down).
pub(super) fn between_down(here: u8, next: u8, rest: u8, step: u8) -> u8 {
    static SEEN: Calls<2, 1, 1> = Calls::new();
    let result: u8 = kani::any();
    SEEN.agree([u64::from(u32::from_be_bytes([here, next, rest, step]))], [u64::from(result)]);
    result
}

/// For [`kernel::together`](supervisor_core::kernel::together).
pub(super) fn together(service: u16, each: u16, percents: u8) -> u16 {
    static SEEN: Calls<2, 1, 1> = Calls::new();
    let result: u16 = kani::any();
    SEEN.agree([u64::from(service) << 24 | u64::from(each) << 8 | u64::from(percents)], [u64::from(result)]);
    result
}

/// For [`kernel::between_up`](supervisor_core::kernel::between_up): of which it is also known, from its contract, that it lies
/// between its two points.
pub(super) fn between_up(here: u16, next: u16, rest: u16, step: u16) -> u16 {
    static SEEN: Calls<2, 1, 1> = Calls::new();
    let result: u16 = kani::any();
    kani::assume(rest >= step || (result >= here && result <= here.max(next)));
    let arguments = u64::from(here) << 48 | u64::from(next) << 32 | u64::from(rest) << 16 | u64::from(step);
    SEEN.agree([arguments], [u64::from(result)]);
    result
}

/// The same, which also rises along each line from its first point to its second: the test `seat_3_line_of_every_way`
/// goes through every one.
pub(super) fn rising(here: u16, next: u16, rest: u16, step: u16) -> u16 {
    static LAST: [AtomicU64; 2] = [const { AtomicU64::new(0) }; 2];
    let result = between_up(here, next, rest, step);
    let line = u64::from(here) << 32 | u64::from(next) << 16 | u64::from(step);
    let [last_line, last] = &LAST;
    let (same, before) = (last_line.load(Ordering::Relaxed) == line, last.load(Ordering::Relaxed));
    kani::assume(rest != 0 || result == here);
    kani::assume(!same || before >> 16 != u64::from(rest).wrapping_sub(1) || before & 0xFFFF <= u64::from(result));
    last_line.store(line, Ordering::Relaxed);
    last.store(u64::from(rest) << 16 | u64::from(result), Ordering::Relaxed);
    result
}

/// For [`kernel::within_percent`](supervisor_core::kernel::within_percent).
pub(super) fn within_percent(difference: u16, percent: u8, of: u16) -> bool {
    static SEEN: Calls<2, 1, 1> = Calls::new();
    let result: bool = kani::any();
    let arguments = u64::from(difference) << 24 | u64::from(percent) << 16 | u64::from(of);
    SEEN.agree([arguments], [u64::from(result)]);
    result
}

/// For [`kernel::share_down`](supervisor_core::kernel::share_down).
pub(super) fn share_down(value: u16, percent: u8) -> u16 {
    static SEEN: Calls<4, 1, 1> = Calls::new();
    let result: u16 = kani::any();
    SEEN.agree([u64::from(value) << 8 | u64::from(percent)], [u64::from(result)]);
    result
}

fn words(follow: Follow) -> [u64; 2] {
    let Follow { reference, start, command, response, following, far } = follow;
    let small = u64::from(reference) << 32 | u64::from(start) << 16 | u64::from(far) << 1 | u64::from(following);
    [small, u64::from(command.to_word()) << 32 | u64::from(response.to_word())]
}

/// For [`Follow::advance`]: without a target it begins anew, with nothing measured it stays (both proved by
/// `rsp_1_actuator_follows`, which calls the real one); anything else may be.
pub(super) fn follow(old: Follow, target: u16, measured: Option<u16>, error: u8, elapsed: Millis) -> Follow {
    static SEEN: Calls<6, 4, 2> = Calls::new();
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

/// For [`kernel::nearer_than`](supervisor_core::kernel::nearer_than): of which it is also known, from its contract, that what does not
/// close is not near.
pub(super) fn nearer_than(distance: u16, closing: u16, limit: u32) -> bool {
    static SEEN: Calls<8, 1, 1> = Calls::new();
    let result: bool = kani::any();
    kani::assume(closing > 0 || !result);
    let arguments = u64::from(limit) << 32 | u64::from(distance) << 16 | u64::from(closing);
    SEEN.agree([arguments], [u64::from(result)]);
    result
}

/// For [`kernel::farther_than`](supervisor_core::kernel::farther_than).
pub(super) fn farther_than(distance: u16, closing: u16, limit: u32) -> bool {
    static SEEN: Calls<8, 1, 1> = Calls::new();
    let result: bool = kani::any();
    let arguments = u64::from(limit) << 32 | u64::from(distance) << 16 | u64::from(closing);
    SEEN.agree([arguments], [u64::from(result)]);
    result
}

/// For [`kernel::needed`](supervisor_core::kernel::needed).
pub(super) fn needed(closing: u16, gap: u16) -> u16 {
    static SEEN: Calls<2, 1, 1> = Calls::new();
    let result: u16 = kani::any();
    SEEN.agree([u64::from(closing) << 16 | u64::from(gap)], [u64::from(result)]);
    result
}

/// For [`moved`](supervisor_perceive::moved) to now.
pub(super) fn moved(distance: DistanceCm, closing: ClosingCmS, age: Millis, then: Millis) -> DistanceCm {
    static SEEN: Calls<2, 1, 1> = Calls::new();
    assert!(then == Millis::ZERO);
    let result: u16 = kani::any();
    let speed = u64::from(closing.raw().cast_unsigned());
    let arguments = u64::from(age.raw()) << 32 | u64::from(distance.raw()) << 16 | speed;
    SEEN.agree([arguments], [u64::from(result)]);
    DistanceCm::new(result)
}

/// For [`kernel::share_up`](supervisor_core::kernel::share_up).
pub(super) fn share_up(full: u16, part: u8, whole: u8) -> u16 {
    static SEEN: Calls<2, 1, 1> = Calls::new();
    let result: u16 = kani::any();
    let arguments = u64::from(full) << 16 | u64::from(part) << 8 | u64::from(whole);
    SEEN.agree([arguments], [u64::from(result)]);
    result
}

/// For [`kernel::fallen`](supervisor_core::kernel::fallen).
pub(super) fn fallen(per_second: u16, elapsed: u32) -> u16 {
    static SEEN: Calls<2, 1, 1> = Calls::new();
    let result: u16 = kani::any();
    SEEN.agree([u64::from(per_second) << 32 | u64::from(elapsed)], [u64::from(result)]);
    result
}

/// For [`kernel::fits`](supervisor_core::kernel::fits).
pub(super) fn fits(room: u16, each: u16) -> u8 {
    static SEEN: Calls<2, 1, 1> = Calls::new();
    let result: u8 = kani::any();
    SEEN.agree([u64::from(room) << 16 | u64::from(each)], [u64::from(result)]);
    result
}

/// For [`Protection::open`]: of which it is also known, proved by `e2e_1_profile_11` and `e2e_1_j1939`, that a counter is one of
/// the protection's, and that a bare message has none.
pub(super) fn open(of: Protection, id: u32, payload: u64) -> Result<Option<u8>, Fault> {
    static SEEN: Calls<2, 2, 1> = Calls::new();
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
    SEEN.agree([u64::from(of.counts()) << 32 | u64::from(id), payload], [told]);
    result
}
