//! The arithmetic of the supervisor, on plain integers: exact or rounded to the safe side, for every value.
//!
//! Everything that multiplies or divides stands here, or in `perceive` where it is geometry. No function can overflow or
//! divide by zero, whatever it is given, and each returns.
//!
//! `proofs/creusot` compiles this very file with its contracts: `x@` is the mathematical integer of `x`, which never
//! overflows, and `==>` implies. Each contract fixes the result for all that its function is used for, so the proofs of
//! the machines may take these functions as known. A product of shares is compared as products: "rounded up" reads as
//! the least number whose product is enough.

#[cfg(creusot)]
use creusot_std::macros::{check, ensures};

/// TTC-1: T < `limit`, that is `distance` / `closing` < `limit`, by cross-multiplication: no division, no rounding.
///
/// `distance` in cm, `closing` in cm/s and positive, `limit` in ms.
#[must_use]
#[cfg_attr(creusot, check(terminates))]
#[cfg_attr(creusot, ensures(result == (distance@ * 1000 < limit@ * closing@)))]
pub fn nearer_than(distance: u16, closing: u16, limit: u32) -> bool {
    // 65 535 · 1000 < 2³² and (2³² − 1) · 65 535 < 2⁴⁸: nothing can overflow 64 bits.
    u64::from(distance).saturating_mul(1000) < u64::from(limit).saturating_mul(u64::from(closing))
}

/// TTC-1: T > `limit`, in the same units.
#[must_use]
#[cfg_attr(creusot, check(terminates))]
#[cfg_attr(creusot, ensures(result == (distance@ * 1000 > limit@ * closing@)))]
pub fn farther_than(distance: u16, closing: u16, limit: u32) -> bool {
    u64::from(distance).saturating_mul(1000) > u64::from(limit).saturating_mul(u64::from(closing))
}

/// MIT-6, MIT-8: the deceleration that takes away the closing speed before the gap is used up, v²/(2·gap), in 1/2048 m/s² and
/// rounded up. Saturates, also without a gap; 0 when not closing.
///
/// `closing` in cm/s, `gap` in cm.
// v in cm/s, gap in cm: v²/(2·gap) cm/s² = v²·2048/(2·gap·100) in 1/2048 m/s² = v²·256/(25·gap).
#[must_use]
#[cfg_attr(creusot, check(terminates))]
#[cfg_attr(creusot, ensures(closing@ == 0 ==> result@ == 0))]
#[cfg_attr(creusot, ensures(closing@ > 0 && gap@ == 0 ==> result@ == u16::MAX@))]
#[cfg_attr(creusot, ensures(result@ < u16::MAX@ ==> result@ * (25 * gap@) >= closing@ * closing@ * 256))]
#[cfg_attr(creusot, ensures(result@ > 0 ==> (result@ - 1) * (25 * gap@) < closing@ * closing@ * 256))]
pub fn needed(closing: u16, gap: u16) -> u16 {
    let square = u64::from(closing).saturating_mul(u64::from(closing)).saturating_mul(256);
    let divisor = u64::from(gap).saturating_mul(25);
    match square.saturating_add(divisor.saturating_sub(1)).checked_div(divisor) {
        Some(decel) => u16::try_from(decel).unwrap_or(u16::MAX),
        None if closing == 0 => 0,
        None => u16::MAX,
    }
}

/// FUS-3a: two shares `part`/`whole` on one denominator: their order is that of the products, 32 by 32 bits each, exact.
#[must_use]
#[cfg_attr(creusot, check(terminates))]
#[cfg_attr(creusot, ensures(result.0@ == part@ * other_whole@))]
#[cfg_attr(creusot, ensures(result.1@ == other_part@ * whole@))]
pub fn crossed(part: u32, whole: u32, other_part: u32, other_whole: u32) -> (u64, u64) {
    let first = u64::from(part).saturating_mul(u64::from(other_whole));
    let second = u64::from(other_part).saturating_mul(u64::from(whole));
    (first, second)
}

/// `product` / `by`, rounded up. None without a divisor, and where the sum for rounding would not fit.
#[cfg_attr(creusot, check(terminates))]
#[cfg_attr(creusot, ensures((result == None) == (by@ == 0 || product@ + by@ - 1 > u32::MAX@)))]
#[cfg_attr(creusot, ensures(forall<least: u32> result == Some(least) ==> least@ * by@ >= product@))]
#[cfg_attr(creusot, ensures(forall<least: u32> result == Some(least) ==> (least@ - 1) * by@ < product@))]
fn divided_up(product: u32, by: u32) -> Option<u32> {
    match product.checked_add(by.saturating_sub(1)) {
        Some(sum) => sum.checked_div(by),
        None => None,
    }
}

/// SEAT-3: from `here` towards `next`, `rest` of `step` of the way, rounded up. A `next` below `here` counts as `here`.
#[must_use]
#[cfg_attr(creusot, check(terminates))]
#[cfg_attr(creusot, ensures(result@ >= here@))]
#[cfg_attr(creusot, ensures(next@ <= here@ || step@ == 0 ==> result@ == here@))]
#[cfg_attr(creusot, ensures(rest@ <= step@ && here@ <= next@ ==> result@ <= next@))]
#[cfg_attr(creusot, ensures(rest@ <= step@ && here@ <= next@ ==> (result@ - here@) * step@ >= (next@ - here@) * rest@))]
#[cfg_attr(creusot, ensures(rest@ <= step@ && here@ < result@ ==> (result@ - here@ - 1) * step@ < (next@ - here@) * rest@))]
pub fn between_up(here: u16, next: u16, rest: u16, step: u16) -> u16 {
    let way = u32::from(next.saturating_sub(here)).saturating_mul(u32::from(rest));
    match divided_up(way, u32::from(step)) {
        Some(rise) => here.saturating_add(u16::try_from(rise).unwrap_or(0)),
        None => here,
    }
}

/// TRQ-1: the same, rounded down.
#[must_use]
#[cfg_attr(creusot, check(terminates))]
#[cfg_attr(creusot, ensures(result@ >= here@))]
#[cfg_attr(creusot, ensures(next@ <= here@ || step@ == 0 ==> result@ == here@))]
#[cfg_attr(creusot, ensures(rest@ <= step@ && here@ <= next@ ==> result@ <= next@))]
#[cfg_attr(creusot, ensures(rest@ <= step@ && here@ <= next@ ==> (result@ - here@) * step@ <= (next@ - here@) * rest@))]
#[cfg_attr(creusot, ensures(rest@ <= step@ && 0 < step@ && here@ <= next@
    ==> (result@ - here@ + 1) * step@ > (next@ - here@) * rest@))]
pub fn between_down(here: u8, next: u8, rest: u8, step: u8) -> u8 {
    let way = u16::from(next.saturating_sub(here)).saturating_mul(u16::from(rest));
    match way.checked_div(u16::from(step)) {
        Some(rise) => here.saturating_add(u8::try_from(rise).unwrap_or(0)),
        None => here,
    }
}

/// Whole units that `per_second` gives in `elapsed` ms, and what is left over in thousandths: slow rates and short cycles
/// lose nothing. Saturates.
#[must_use]
#[cfg_attr(creusot, check(terminates))]
#[cfg_attr(creusot, ensures(result.1@ < 1000))]
#[cfg_attr(creusot, ensures(per_second@ * elapsed@ + rest@ <= u32::MAX@
    ==> result.0@ * 1000 + result.1@ == per_second@ * elapsed@ + rest@))]
#[cfg_attr(creusot, ensures(per_second@ * elapsed@ + rest@ > u32::MAX@ ==> result.0@ * 1000 + result.1@ == u32::MAX@))]
pub fn portion(per_second: u16, elapsed: u32, rest: u16) -> (u32, u16) {
    let thousandths = u32::from(per_second).saturating_mul(elapsed).saturating_add(u32::from(rest));
    (thousandths / 1000, u16::try_from(thousandths % 1000).unwrap_or(0))
}

/// E2E-2: what `per_second` takes away in `elapsed` ms, rounded up. Saturates.
#[must_use]
#[cfg_attr(creusot, check(terminates))]
#[cfg_attr(creusot, ensures(result@ < u16::MAX@ ==> result@ * 1000 >= per_second@ * elapsed@))]
#[cfg_attr(creusot, ensures(result@ > 0 ==> (result@ - 1) * 1000 < per_second@ * elapsed@))]
pub fn fallen(per_second: u16, elapsed: u32) -> u16 {
    match divided_up(u32::from(per_second).saturating_mul(elapsed), 1000) {
        Some(units) => u16::try_from(units).unwrap_or(u16::MAX),
        // 2³² thousandths are more than any 16 bits of units.
        None => u16::MAX,
    }
}

/// `part` of `whole` of `full`, rounded up. Nothing, if there is no whole. Saturates.
#[must_use]
#[cfg_attr(creusot, check(terminates))]
#[cfg_attr(creusot, ensures(whole@ == 0 ==> result@ == 0))]
#[cfg_attr(creusot, ensures(part@ <= whole@ ==> result@ <= full@))]
#[cfg_attr(creusot, ensures(whole@ > 0 && result@ < u16::MAX@ ==> result@ * whole@ >= full@ * part@))]
#[cfg_attr(creusot, ensures(whole@ > 0 && result@ > 0 ==> (result@ - 1) * whole@ < full@ * part@))]
pub fn share_up(full: u16, part: u8, whole: u8) -> u16 {
    match divided_up(u32::from(full).saturating_mul(u32::from(part)), u32::from(whole)) {
        Some(share) => u16::try_from(share).unwrap_or(u16::MAX),
        None => 0,
    }
}

/// `percent` of `value`, rounded down. Saturates.
#[must_use]
#[cfg_attr(creusot, check(terminates))]
#[cfg_attr(creusot, ensures(percent@ <= 100 ==> result@ <= value@))]
#[cfg_attr(creusot, ensures(result@ * 100 <= value@ * percent@))]
#[cfg_attr(creusot, ensures(result@ < u16::MAX@ ==> (result@ + 1) * 100 > value@ * percent@))]
pub fn share_down(value: u16, percent: u8) -> u16 {
    u16::try_from(u32::from(value).saturating_mul(u32::from(percent)) / 100).unwrap_or(u16::MAX)
}

/// RET-1: the retarder's deceleration for each per cent, times its per cents, and the service brake beside it. Saturates.
#[must_use]
#[cfg_attr(creusot, check(terminates))]
#[cfg_attr(creusot, ensures(service@ + each@ * percents@ <= u16::MAX@ ==> result@ == service@ + each@ * percents@))]
#[cfg_attr(creusot, ensures(service@ + each@ * percents@ > u16::MAX@ ==> result@ == u16::MAX@))]
pub fn together(service: u16, each: u16, percents: u8) -> u16 {
    service.saturating_add(each.saturating_mul(u16::from(percents)))
}

/// RET-1: the greatest per cents whose deceleration fits in `room`; all of them, if they cost nothing.
#[must_use]
#[cfg_attr(creusot, check(terminates))]
#[cfg_attr(creusot, ensures(result@ <= 100))]
#[cfg_attr(creusot, ensures(each@ * result@ <= room@))]
#[cfg_attr(creusot, ensures(result@ < 100 ==> each@ * (result@ + 1) > room@))]
pub fn fits(room: u16, each: u16) -> u8 {
    match room.checked_div(each) {
        Some(percents) if percents < 100 => u8::try_from(percents).unwrap_or(0),
        Some(_) | None => 100,
    }
}

/// VLC-2: a total as its electric part, as much as its limit allows, and the friction that fills it up.
#[must_use]
#[cfg_attr(creusot, check(terminates))]
#[cfg_attr(creusot, ensures(result.0@ + result.1@ == total@))]
#[cfg_attr(creusot, ensures(result.0@ <= electric_limit@))]
#[cfg_attr(creusot, ensures(result.1@ > 0 ==> result.0@ == electric_limit@))]
pub fn split(total: u16, electric_limit: u16) -> (u16, u16) {
    let electric = if electric_limit < total { electric_limit } else { total };
    (electric, total.saturating_sub(electric))
}

/// RULE-6c: whether `difference` is at most `percent` of `of`.
#[must_use]
#[cfg_attr(creusot, check(terminates))]
#[cfg_attr(creusot, ensures(result == (difference@ * 100 <= percent@ * of@)))]
pub fn within_percent(difference: u16, percent: u8, of: u16) -> bool {
    u32::from(difference).saturating_mul(100) <= u32::from(percent).saturating_mul(u32::from(of))
}

/// END-1a, SEAT-11f: a counter that starts at 1 in its first cycle and then adds what has passed. 0 says that it does not run. Saturates.
#[must_use]
#[cfg_attr(creusot, check(terminates))]
#[cfg_attr(creusot, ensures(result@ >= 1 && result@ >= count@))]
#[cfg_attr(creusot, ensures(count@ == 0 ==> result@ == 1))]
#[cfg_attr(creusot, ensures(count@ > 0 && count@ + elapsed@ <= u32::MAX@ ==> result@ == count@ + elapsed@))]
#[cfg_attr(creusot, ensures(count@ > 0 && count@ + elapsed@ > u32::MAX@ ==> result@ == u32::MAX@))]
pub fn counted(count: u32, elapsed: u32) -> u32 {
    if count == 0 { 1 } else { count.saturating_add(elapsed) }
}
