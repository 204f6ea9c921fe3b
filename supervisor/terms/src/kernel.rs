//! The arithmetic of the supervisor, on plain integers: exact or rounded to the safe side, for every value.
//!
//! Everything that multiplies or divides stands here, or in `perceive` where it is geometry. No function can overflow or
//! divide by zero, whatever it is given. `proofs/creusot` compiles this very file with its contracts, whose `@` is the
//! mathematical integer of a value; the proofs of the machines may take these functions as known.

/// TTC-1: T < `limit`, that is `distance` / `closing` < `limit`, by cross-multiplication: no division, no rounding.
///
/// `distance` in cm, `closing` in cm/s and positive, `limit` in ms.
#[must_use]
#[cfg_attr(creusot, creusot_std::macros::ensures(result == (distance@ * 1000 < limit@ * closing@)))]
pub fn nearer_than(distance: u16, closing: u16, limit: u32) -> bool {
    // 65 535 · 1000 < 2³² and (2³² − 1) · 65 535 < 2⁴⁸: nothing can overflow 64 bits.
    u64::from(distance).saturating_mul(1000) < u64::from(limit).saturating_mul(u64::from(closing))
}

/// TTC-1: T > `limit`, in the same units.
#[must_use]
#[cfg_attr(creusot, creusot_std::macros::ensures(result == (distance@ * 1000 > limit@ * closing@)))]
pub fn farther_than(distance: u16, closing: u16, limit: u32) -> bool {
    u64::from(distance).saturating_mul(1000) > u64::from(limit).saturating_mul(u64::from(closing))
}

/// MIT-6c, MIT-8a: the deceleration that takes away the closing speed before the gap is used up, v²/(2·gap), in 1/2048 m/s² and
/// rounded up. Saturates, also without a gap; 0 when not closing.
///
/// `closing` in cm/s, `gap` in cm.
#[must_use]
pub fn needed(closing: u16, gap: u16) -> u16 {
    // v in cm/s, gap in cm: v²/(2·gap) cm/s² = v²·2048/(2·gap·100) in 1/2048 m/s² = v²·256/(25·gap).
    let square = u64::from(closing).saturating_mul(u64::from(closing)).saturating_mul(256);
    match (closing, u64::from(gap).saturating_mul(25)) {
        (0, _) => 0,
        (_, divisor) => square
            .checked_add(divisor.saturating_sub(1))
            .and_then(|sum| sum.checked_div(divisor))
            .map_or(u16::MAX, saturated),
    }
}

fn saturated(wide: u64) -> u16 {
    u16::try_from(wide).unwrap_or(u16::MAX)
}

/// FUS-3a: two shares `part`/`whole` on one denominator: their order is that of the products, 32 by 32 bits each, exact.
#[must_use]
pub fn crossed(part: u32, whole: u32, other_part: u32, other_whole: u32) -> (u64, u64) {
    let product = |part: u32, whole: u32| u64::from(part).saturating_mul(u64::from(whole));
    (product(part, other_whole), product(other_part, whole))
}

/// SEAT-3b: from `here` towards `next`, `rest` of `step` of the way, rounded up. A `next` below `here` counts as `here`.
#[must_use]
pub fn between_up(here: u16, next: u16, rest: u16, step: u16) -> u16 {
    let way = u32::from(next.saturating_sub(here)).saturating_mul(u32::from(rest));
    let rise = way.checked_add(u32::from(step.saturating_sub(1))).and_then(|sum| sum.checked_div(u32::from(step)));
    here.saturating_add(rise.and_then(|rise| u16::try_from(rise).ok()).unwrap_or(0))
}

/// TRQ-1a: the same, rounded down.
#[must_use]
pub fn between_down(here: u8, next: u8, rest: u8, step: u8) -> u8 {
    let way = u16::from(next.saturating_sub(here)).saturating_mul(u16::from(rest));
    here.saturating_add(way.checked_div(u16::from(step)).and_then(|rise| u8::try_from(rise).ok()).unwrap_or(0))
}

/// Whole units that `per_second` gives in `elapsed` ms, and what is left over in thousandths: slow rates and short cycles
/// lose nothing.
#[must_use]
pub fn portion(per_second: u16, elapsed: u32, rest: u16) -> (u32, u16) {
    let thousandths = u32::from(per_second).saturating_mul(elapsed).saturating_add(u32::from(rest));
    (thousandths / 1000, u16::try_from(thousandths % 1000).unwrap_or(0))
}

/// E2E-2d: what `per_second` takes away in `elapsed` ms, rounded up.
#[must_use]
pub fn fallen(per_second: u16, elapsed: u32) -> u16 {
    u16::try_from(u32::from(per_second).saturating_mul(elapsed).div_ceil(1000)).unwrap_or(u16::MAX)
}

/// `part` of `whole` of `full`, rounded up. Nothing, if there is no whole.
#[must_use]
pub fn share_up(full: u16, part: u8, whole: u8) -> u16 {
    let product = u32::from(full).saturating_mul(u32::from(part));
    let share =
        product.checked_add(u32::from(whole.saturating_sub(1))).and_then(|sum| sum.checked_div(u32::from(whole)));
    share.map_or(0, |share| u16::try_from(share).unwrap_or(u16::MAX))
}

/// `percent` of `value`, rounded down.
#[must_use]
pub fn share_down(value: u16, percent: u8) -> u16 {
    u16::try_from(u32::from(value).saturating_mul(u32::from(percent)) / 100).unwrap_or(u16::MAX)
}

/// RET-1a: the retarder's deceleration for each per cent, times its per cents, and the service brake beside it. Saturates.
#[must_use]
pub fn together(service: u16, each: u16, percents: u8) -> u16 {
    service.saturating_add(each.saturating_mul(u16::from(percents)))
}

/// RET-1a: the greatest per cents whose deceleration fits in `room`; all of them, if they cost nothing.
#[must_use]
pub fn fits(room: u16, each: u16) -> u8 {
    room.checked_div(each).and_then(|percents| u8::try_from(percents.min(100)).ok()).unwrap_or(100)
}

/// VLC-2: a total as its electric part, as much as its limit allows, and the friction that fills it up.
#[must_use]
pub fn split(total: u16, electric_limit: u16) -> (u16, u16) {
    let electric = electric_limit.min(total);
    (electric, total.saturating_sub(electric))
}

/// RULE-6c: whether `difference` is at most `percent` of `of`.
#[must_use]
pub fn within_percent(difference: u16, percent: u8, of: u16) -> bool {
    u32::from(difference).saturating_mul(100) <= u32::from(percent).saturating_mul(u32::from(of))
}

/// END-1a, SEAT-11f: a counter that starts at 1 in its first cycle and then adds what has passed. 0 says that it does not run. Saturates.
#[must_use]
pub fn counted(count: u32, elapsed: u32) -> u32 {
    if count == 0 { 1 } else { count.saturating_add(elapsed) }
}
