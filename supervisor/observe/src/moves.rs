//! One actuator of few positions that shall move only when it was told to (SELF-10).

use supervisor_terms::Word;
use supervisor_terms::Words;

/// The last position confirmed, and the last one asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(kani, derive(kani::Arbitrary))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
pub struct Moves<T> {
    /// Last known position.
    pub seen: Option<T>,
    /// Last position that an output asked for.
    pub asked: Option<T>,
}

impl<T: Copy + PartialEq> Moves<T> {
    /// Nothing seen, nothing asked for.
    pub const INITIAL: Self = Self { seen: None, asked: None };

    /// One cycle: the next state, and whether it moved without being asked. What was never known did not move.
    #[must_use]
    pub fn advance(self, position: Option<T>) -> (Self, bool) {
        let alone = self.seen.is_some() && position.is_some() && position != self.seen && position != self.asked;
        // What was asked for and reached is used up: the way there may pass other positions.
        let asked = if position.is_some() && position == self.asked { None } else { self.asked };
        (Self { seen: position.or(self.seen), asked }, alone)
    }

    /// After vetting: what went out asks for this position; `None` asks for none.
    #[must_use]
    pub fn record(self, asked: Option<T>) -> Self {
        Self { asked: asked.or(self.asked), ..self }
    }
}

impl<T: Word> Words for Moves<T> {
    const COUNT: usize = 2;
    fn write(&self, sink: &mut impl FnMut(u32)) {
        sink(self.seen.to_word());
        sink(self.asked.to_word());
    }
    fn read(source: &mut impl FnMut() -> Option<u32>) -> Option<Self> {
        Some(Self { seen: Words::read(source)?, asked: Words::read(source)? })
    }
}
