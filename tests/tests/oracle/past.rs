//! Past-time logic over a recorded trace: each operator gives, for every cycle, what can be said of its past.
//!
//! A [`Series`] is a formula that has been evaluated in every cycle; an operator looks at this cycle and at earlier ones
//! only. Time is real time, from a [`Clock`], never a count of cycles.

/// Milliseconds since the first cycle, one value for each cycle; never falls.
#[derive(Clone, Debug)]
pub struct Clock(Vec<i64>);

impl Clock {
    /// From what each cycle adds.
    pub fn adding(spans: impl IntoIterator<Item = i64>) -> Self {
        let mut time = 0;
        Self(
            spans
                .into_iter()
                .map(|span| {
                    time += span;
                    time
                })
                .collect(),
        )
    }
    /// From one cycle to a later one.
    pub fn between(&self, from: usize, to: usize) -> i64 {
        self.0[to] - self.0[from]
    }
    /// What this cycle has added.
    pub fn step(&self, at: usize) -> i64 {
        if at == 0 { 0 } else { self.between(at - 1, at) }
    }
}

/// A formula, evaluated in every cycle.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Series(Vec<bool>);

impl Series {
    /// A formula of the cycle alone.
    pub fn of(count: usize, holds: impl Fn(usize) -> bool) -> Self {
        Self((0..count).map(holds).collect())
    }
    /// In this cycle.
    pub fn at(&self, at: usize) -> bool {
        self.0[at]
    }
    /// Both.
    pub fn and(&self, other: &Self) -> Self {
        Self::of(self.0.len(), |at| self.at(at) && other.at(at))
    }
    /// Either.
    pub fn or(&self, other: &Self) -> Self {
        Self::of(self.0.len(), |at| self.at(at) || other.at(at))
    }
    /// Not.
    pub fn not(&self) -> Self {
        Self::of(self.0.len(), |at| !self.at(at))
    }
    /// In the cycle before; nothing was before the first.
    pub fn previously(&self) -> Self {
        Self::of(self.0.len(), |at| at > 0 && self.at(at - 1))
    }
    /// In this cycle or any earlier one.
    pub fn once(&self) -> Self {
        Self::of(self.0.len(), |_| true).since(self)
    }
    /// `begin` held in this cycle, or in an earlier one, and this has held in every cycle after it.
    pub fn since(&self, begin: &Self) -> Self {
        let mut holds = false;
        Self(
            (0..self.0.len())
                .map(|at| {
                    holds = begin.at(at) || (self.at(at) && holds);
                    holds
                })
                .collect(),
        )
    }
    /// In every cycle from one that lies at least `span` back until now.
    pub fn held_for(&self, clock: &Clock, span: i64) -> Self {
        Self::of_run(self, |first, at| clock.between(first, at) >= span)
    }
    /// In every cycle from one that lies more than `span` back until now.
    pub fn held_longer(&self, clock: &Clock, span: i64) -> Self {
        Self::of_run(self, |first, at| clock.between(first, at) > span)
    }
    /// In every cycle until now, and from the last cycle in which it did not hold it is at least `span`.
    pub fn held_about(&self, clock: &Clock, span: i64) -> Self {
        Self::of_run(self, |first, at| clock.between(first.saturating_sub(1), at) >= span)
    }
    /// Holds now, and `judge` holds of the first cycle of the unbroken run that ends now.
    fn of_run(&self, judge: impl Fn(usize, usize) -> bool) -> Self {
        let mut first = 0;
        Self(
            (0..self.0.len())
                .map(|at| {
                    if !self.at(at) {
                        first = at + 1;
                    }
                    self.at(at) && judge(first, at)
                })
                .collect(),
        )
    }
    /// In some cycle that lies at most `span` back.
    pub fn within(&self, clock: &Clock, span: i64) -> Self {
        let mut last = None;
        Self(
            (0..self.0.len())
                .map(|at| {
                    if self.at(at) {
                        last = Some(at);
                    }
                    last.is_some_and(|last| clock.between(last, at) <= span)
                })
                .collect(),
        )
    }
    /// How much time the cycles in which this holds have added since `reset` last held.
    pub fn counted(&self, reset: &Self, clock: &Clock) -> Vec<i64> {
        let mut sum = 0;
        (0..self.0.len())
            .map(|at| {
                if reset.at(at) {
                    sum = 0;
                } else if self.at(at) {
                    sum += clock.step(at);
                }
                sum
            })
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::{Clock, Series};

    fn series(marks: &str) -> Series {
        Series(marks.chars().map(|mark| mark == 'x').collect())
    }
    fn clock(spans: &[i64]) -> Clock {
        Clock::adding(spans.iter().copied())
    }

    /// SEAT-1a, SEAT-7a: what the claims are made of.
    #[test]
    fn previously_once_and_since_look_back_only() {
        let formula = series(".x..x.");
        assert_eq!(formula.previously(), series("..x..x"));
        assert_eq!(formula.once(), series(".xxxxx"));
        assert_eq!(series("xx.xx.").since(&series("x...x.")), series("xx..x."));
        assert_eq!(formula.not().and(&formula.once()), series("..xx.x"));
        assert_eq!(formula.or(&series("x.....")), series("xx..x."));
    }

    /// SEAT-1a, SEAT-7a: what the claims are made of.
    #[test]
    fn held_for_counts_from_the_first_cycle_of_the_run() {
        let clock = clock(&[0, 10, 10, 50, 1, 9]);
        let formula = series(".xxx.x");
        assert_eq!(formula.held_for(&clock, 60), series("...x.."));
        assert_eq!(formula.held_for(&clock, 61), series("......"));
        assert_eq!(formula.held_longer(&clock, 59), series("...x.."));
        assert_eq!(formula.held_longer(&clock, 60), series("......"));
        assert_eq!(formula.held_about(&clock, 70), series("...x.."));
        assert_eq!(formula.held_for(&clock, 0), formula);
    }

    /// SEAT-1a, SEAT-7a: what the claims are made of.
    #[test]
    fn within_and_counted_measure_time() {
        let clock = clock(&[0, 10, 10, 50, 1, 9]);
        let formula = series(".x..x.");
        assert_eq!(formula.within(&clock, 10), series(".xx.xx"));
        assert_eq!(formula.counted(&series("......"), &clock), [0, 10, 10, 10, 11, 11]);
        assert_eq!(formula.counted(&series("..x..."), &clock), [0, 10, 0, 0, 1, 1]);
        assert_eq!(clock.step(3), 50);
    }
}
