//! Time between two calls, for reports only.

use supervisor_core::Millis;

/// The longest step that is believed; also the longest cycle of the decision core (SELF-3).
const GREATEST: Millis = Millis::new(50);
/// What a step counts that is not believed: the nominal cycle.
const NOMINAL: Millis = Millis::new(10);

/// Measures the time from call to call. A clock that wraps changes nothing; one that leaps counts one nominal cycle,
/// so that a leap neither ripens a report nor lets two frames follow each other too closely.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Clock {
    last: Option<Millis>,
}

impl Clock {
    /// Has not been read.
    pub(crate) const NEW: Self = Self { last: None };

    /// The time since the last call: 0 at the first one and for the same time again.
    pub(crate) fn elapsed(&mut self, now: Millis) -> Millis {
        let last = self.last.replace(now).unwrap_or(now);
        let elapsed = Millis::new(now.raw().wrapping_sub(last.raw()));
        if elapsed <= GREATEST { elapsed } else { NOMINAL }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// END-1b: a wrap of the clock counts as what it is, a leap either way as one nominal cycle.
    #[test]
    fn a_wrap_is_nothing_and_a_leap_is_one_cycle() {
        let mut clock = Clock::NEW;
        let mut elapsed = |now: u32| clock.elapsed(Millis::new(now)).raw();
        assert_eq!(elapsed(u32::MAX - 4), 0, "the first call");
        assert_eq!(elapsed(5), 10, "over the wrap");
        assert_eq!(elapsed(5), 0, "the same time again");
        assert_eq!(elapsed(55), 50);
        assert_eq!(elapsed(106), 10, "too long");
        assert_eq!(elapsed(90), 10, "backwards");
    }
}
