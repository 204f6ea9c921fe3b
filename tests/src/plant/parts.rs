//! The parts that the bus model is made of: lags, dead times, and things that take a while to move.

use std::collections::VecDeque;

/// Steps of the model inside one cycle: 1 ms each.
pub const STEP_S: f64 = 0.001;

/// First-order lag.
#[derive(Clone, Copy, Debug, Default)]
pub struct Lag {
    value: f64,
}

impl Lag {
    /// One millisecond towards `target` with this time constant; 0 follows at once.
    pub fn follow(&mut self, target: f64, constant_s: f64) -> f64 {
        self.value += (target - self.value) * (STEP_S / (constant_s + STEP_S));
        self.value
    }
    /// The value now.
    #[must_use]
    pub const fn value(&self) -> f64 {
        self.value
    }
}

/// Dead time: what goes in comes out a fixed number of milliseconds later.
#[derive(Clone, Debug, Default)]
pub struct DeadTime {
    line: VecDeque<f64>,
}

impl DeadTime {
    /// A line of `length` milliseconds, at rest.
    #[must_use]
    pub fn new(length: usize) -> Self {
        Self { line: VecDeque::from(vec![0.0; length]) }
    }
    /// One millisecond.
    pub fn pass(&mut self, value: f64) -> f64 {
        self.line.push_back(value);
        self.line.pop_front().unwrap_or(value)
    }
}

/// Something that goes from one position to another in a known time, and reports the old one until it arrives.
#[derive(Clone, Copy, Debug)]
pub struct Mover<T> {
    position: T,
    target: T,
    left_ms: u32,
}

impl<T: Copy + PartialEq> Mover<T> {
    /// At rest in `position`.
    #[must_use]
    pub const fn new(position: T) -> Self {
        Self { position, target: position, left_ms: 0 }
    }
    /// Sets off towards `target`, unless it is there or on its way.
    pub fn aim(&mut self, target: T, duration_ms: u32) {
        if target != self.target {
            (self.target, self.left_ms) = (target, duration_ms);
        }
    }
    /// One millisecond.
    pub fn tick(&mut self) {
        self.left_ms = self.left_ms.saturating_sub(1);
        if self.left_ms == 0 {
            self.position = self.target;
        }
    }
    /// Where it is: the old position while it moves.
    #[must_use]
    pub const fn position(&self) -> T {
        self.position
    }
    /// Whether it moves.
    #[must_use]
    pub fn moving(&self) -> bool {
        self.position != self.target
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_lag_reaches_95_percent_in_three_constants() {
        let mut lag = Lag::default();
        let reached = (0_u32..1000).find(|_| lag.follow(1.0, 0.15) >= 0.95);
        assert!(reached.is_some_and(|ms| (430..470).contains(&ms)), "{reached:?}");
    }

    #[test]
    fn dead_time_of_zero_passes_at_once() {
        assert!((DeadTime::new(0).pass(2.0) - 2.0).abs() < 1e-12);
        let mut line = DeadTime::new(2);
        let out = [line.pass(1.0), line.pass(1.0), line.pass(1.0)];
        assert!(out[1].abs() < 1e-12 && (out[2] - 1.0).abs() < 1e-12);
    }

    #[test]
    fn a_mover_arrives_after_its_time_and_turns_back_on_the_way() {
        let mut mover = Mover::new(false);
        mover.aim(true, 3);
        mover.tick();
        assert!(mover.moving() && !mover.position());
        mover.aim(false, 2);
        mover.tick();
        mover.tick();
        assert!(!mover.moving() && !mover.position());
    }
}
