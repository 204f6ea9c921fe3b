//! What follows from the contracts alone, over more than one call: Creusot sees the kernels' contracts here, not their bodies.

use crate::kernel::{between_down, between_up, crossed, fits, portion, together};
use creusot_std::prelude::*;

/// SEAT-3b: farther on the way to a greater value demands no less.
#[check(terminates)]
#[requires(rest@ <= further@ && further@ <= step@)]
#[ensures(result.0@ <= result.1@)]
pub fn between_up_rises(here: u16, next: u16, rest: u16, further: u16, step: u16) -> (u16, u16) {
    (between_up(here, next, rest, step), between_up(here, next, further, step))
}

/// TRQ-1a: the same, rounded down.
#[check(terminates)]
#[requires(rest@ <= further@ && further@ <= step@)]
#[ensures(result.0@ <= result.1@)]
pub fn between_down_rises(here: u8, next: u8, rest: u8, further: u8, step: u8) -> (u8, u8) {
    (between_down(here, next, rest, step), between_down(here, next, further, step))
}

/// FUS-3a: with the threshold written as `percent` of 100 + `percent` of the sum of both areas, the shared area exceeds it
/// exactly when intersection over union is more than `percent`: the union is the sum less what is shared.
#[check(terminates)]
#[ensures(result == (shared@ * 100 > percent@ * (sum@ - shared@)))]
pub fn overlap_exceeds(shared: u32, sum: u32, percent: u8) -> bool {
    let (mine, threshold) = crossed(shared, sum, u32::from(percent), u32::from(percent).saturating_add(100));
    mine > threshold
}

/// RET-1a: as much retarder as fits beside the service brake never takes both over their cap.
#[check(terminates)]
#[ensures(result@ <= cap@ || result@ == service@)]
pub fn retarder_stays_below(service: u16, each: u16, cap: u16) -> u16 {
    together(service, each, fits(cap.saturating_sub(service), each))
}

/// What a rate gives in two cycles is what it gives in one as long as both: cutting time into cycles loses nothing.
#[check(terminates)]
#[requires(per_second@ * (first@ + second@) + rest@ <= u32::MAX@)]
#[ensures(result.0@ == result.1@ && result.2@ == result.3@)]
pub fn cycles_lose_nothing(per_second: u16, first: u32, second: u32, rest: u16) -> (u32, u32, u16, u16) {
    let (before, between) = portion(per_second, first, rest);
    let (after, left) = portion(per_second, second, between);
    let (whole, left_of_whole) = portion(per_second, first.saturating_add(second), rest);
    (before.saturating_add(after), whole, left, left_of_whole)
}
