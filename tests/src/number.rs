//! From the model's real numbers to the integers on the link: the one place where a float becomes an integer.

/// The integer nearest to `value`; saturates, and takes "not a number" for 0.
#[must_use]
pub fn nearest(value: f64) -> i64 {
    #[expect(
        clippy::as_conversions,
        clippy::cast_possible_truncation,
        reason = "no From leads from f64 to an integer; `as` saturates and maps NaN to 0, as documented"
    )]
    let integer = value.round() as i64;
    integer
}

/// The nearest `u8`, saturating.
#[must_use]
pub fn to_u8(value: f64) -> u8 {
    u8::try_from(nearest(value).clamp(0, i64::from(u8::MAX))).unwrap_or(u8::MAX)
}

/// The nearest `u16`, saturating.
#[must_use]
pub fn to_u16(value: f64) -> u16 {
    u16::try_from(nearest(value).clamp(0, i64::from(u16::MAX))).unwrap_or(u16::MAX)
}

/// The nearest `i16`, saturating.
#[must_use]
pub fn to_i16(value: f64) -> i16 {
    i16::try_from(nearest(value).clamp(i64::from(i16::MIN), i64::from(i16::MAX))).unwrap_or(i16::MAX)
}

/// Kilometres per hour to metres per second.
#[must_use]
pub fn kmh(value: f64) -> f64 {
    value / 3.6
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn saturates_at_both_ends() {
        assert_eq!((to_u8(-3.0), to_u8(2.5), to_u8(300.0)), (0, 3, 255));
        assert_eq!((to_u16(-1.0), to_u16(65_535.4), to_u16(1.0e9)), (0, 65_535, 65_535));
        assert_eq!((to_i16(-40_000.0), to_i16(40_000.0), to_i16(f64::NAN)), (i16::MIN, i16::MAX, 0));
    }
}
