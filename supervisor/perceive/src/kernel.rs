//! The arithmetic kernel of TTC-1, on plain integers, exact for every value.
//!
//! `proofs/creusot` compiles this very file with its contract.

/// T < `limit`, that is `distance` / `closing` < `limit`, by cross-multiplication: no division, no rounding.
///
/// `distance` in cm, `closing` in cm/s and positive, `limit` in ms.
#[must_use]
#[cfg_attr(creusot, creusot_std::macros::ensures(result == (distance@ * 1000 < limit@ * closing@)))]
pub fn nearer_than(distance: u16, closing: u16, limit: u32) -> bool {
    // 65 535 · 1000 < 2³² and (2³² − 1) · 65 535 < 2⁴⁸: nothing can overflow 64 bits.
    u64::from(distance).saturating_mul(1000) < u64::from(limit).saturating_mul(u64::from(closing))
}

/// T > `limit`, in the same units.
#[must_use]
#[cfg_attr(creusot, creusot_std::macros::ensures(result == (distance@ * 1000 > limit@ * closing@)))]
pub fn farther_than(distance: u16, closing: u16, limit: u32) -> bool {
    u64::from(distance).saturating_mul(1000) > u64::from(limit).saturating_mul(u64::from(closing))
}
