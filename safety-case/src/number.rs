//! The few conversions between integers and floating point that the host program needs, in one place.

/// Exact up to 2⁵³; beyond that the nearest.
#[must_use]
#[expect(clippy::as_conversions, clippy::cast_precision_loss, reason = "std has no other way; the nearest is meant")]
pub fn float(value: u64) -> f64 {
    value as f64
}

/// Exact up to 2⁵³; beyond that the nearest.
#[must_use]
#[expect(clippy::as_conversions, clippy::cast_precision_loss, reason = "std has no other way; the nearest is meant")]
pub fn signed(value: i64) -> f64 {
    value as f64
}

/// The nearest integer, `None` if there is none in 32 bits.
#[must_use]
#[expect(clippy::as_conversions, clippy::cast_possible_truncation, reason = "std has no other way; range is checked")]
pub fn rounded(value: f64) -> Option<i32> {
    let value = value.round();
    (value >= f64::from(i32::MIN) && value <= f64::from(i32::MAX)).then_some(value as i32)
}

/// Whole microseconds as seconds.
#[must_use]
pub fn seconds(micros: u64) -> f64 {
    float(micros) / 1e6
}

/// The lower 32 bits: milliseconds as the supervisor counts them, wrapping.
#[must_use]
pub fn wrapping_millis(micros: u64) -> u32 {
    u32::try_from((micros / 1000) & u64::from(u32::MAX)).unwrap_or(u32::MAX)
}

/// A count with thin spaces between its thousands.
#[must_use]
pub fn grouped(count: u64) -> String {
    let digits = count.to_string();
    let mut text = String::new();
    for (index, digit) in digits.chars().enumerate() {
        if index > 0 && (digits.len() - index).is_multiple_of(3) {
            text.push('\u{202f}');
        }
        text.push(digit);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::{grouped, rounded, wrapping_millis};

    #[test]
    fn rounds_or_refuses() {
        assert_eq!(rounded(2.5), Some(3));
        assert_eq!(rounded(-2.4), Some(-2));
        assert_eq!(rounded(f64::NAN), None);
        assert_eq!(rounded(3e9), None);
    }

    #[test]
    fn milliseconds_wrap() {
        assert_eq!(wrapping_millis(4_294_967_296_000), 0);
        assert_eq!(wrapping_millis(12_345_678), 12_345);
    }

    #[test]
    fn thousands_are_grouped() {
        assert_eq!(grouped(7), "7");
        assert_eq!(grouped(1_234_567), "1\u{202f}234\u{202f}567");
    }
}
