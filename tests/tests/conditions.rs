//! Branches that the rest of the tests do not reach (`supervise coverage`).

mod common;
use common::*;

/// SELF-1b: the arithmetic divides by whatever it is given; without a divisor it keeps to the lower point, or gives nothing.
#[test]
fn nothing_is_divided_by_zero() {
    for here in [0, 1, 2_000, u16::MAX] {
        assert_eq!(kernel::between_up(here, u16::MAX, 7, 0), here);
        assert_eq!(kernel::share_up(here, 200, 0), 0, "no whole, no share");
    }
    for here in [0, 1, 100, u8::MAX] {
        assert_eq!(kernel::between_down(here, u8::MAX, 7, 0), here);
    }
}
