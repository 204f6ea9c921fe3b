//! FUS-1: one time for what was measured at different times.
//!
//! Radar and camera measure at their own times and rates; every object carries the *age* of its measurement. For
//! matching, the radar objects are brought to the time of the camera's image, whose pixels then need not move; for the
//! assessment every object is brought to now. The closing speed is taken as constant: within the 250 ms that an
//! object may be old, 6 m/s² change a distance by 19 cm.

use supervisor_core::{ClosingCmS, DistanceCm, Millis};

/// An older age counts as this one, about half a minute: so old an object is never used ([`Config::object_age`]
/// is 500 ms at most), and the products below cannot overflow.
///
/// [`Config::object_age`]: supervisor_core::Config
const OLDEST: i32 = 32_767;

/// An age in ms, at most [`OLDEST`]: 15 bits.
pub(crate) fn whole(age: Millis) -> i32 {
    i32::try_from(age.raw()).unwrap_or(OLDEST).min(OLDEST)
}

/// Where an object measured `age` ago was, or will be, at the time that was `then` ago; `then` is zero for now.
///
/// Exact but for one rounding, to the *nearer* centimetre. Saturates at 0, the bumper, and at 655.35 m.
#[must_use]
pub fn moved(distance: DistanceCm, closing: ClosingCmS, age: Millis, then: Millis) -> DistanceCm {
    // cm/s · ms = cm/1000. 2¹⁵ · 2¹⁵ = 2³⁰ and 65 535 · 1000 < 2²⁶: their difference stays below 2³¹.
    let closed = i32::from(closing.raw()).saturating_mul(whole(age).saturating_sub(whole(then)));
    let thousandths = i32::from(distance.raw()).saturating_mul(1000).saturating_sub(closed);
    DistanceCm::new(u16::try_from(thousandths.max(0) / 1000).unwrap_or(u16::MAX))
}
