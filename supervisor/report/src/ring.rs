//! A bounded ring that counts what it drops.

use heapless::Deque;

/// The last `N` values; a ring of length 0 does not compile. When it is full the oldest goes, and is counted.
#[derive(Clone, Debug)]
pub(crate) struct Ring<T, const N: usize> {
    values: Deque<T, N>,
    dropped: u32,
}

impl<T, const N: usize> Ring<T, N> {
    /// Empty.
    pub(crate) const fn new() -> Self {
        Self { values: Deque::new(), dropped: 0 }
    }

    /// Adds a value.
    pub(crate) fn push(&mut self, value: T) {
        if self.values.is_full() {
            self.values.pop_front();
            self.dropped = self.dropped.saturating_add(1);
        }
        // Room was made, so it does not fail.
        let _ = self.values.push_back(value);
    }

    /// From the oldest to the newest.
    pub(crate) fn iter(&self) -> impl Iterator<Item = &T> {
        self.values.iter()
    }

    /// How many were dropped, saturating.
    pub(crate) const fn dropped(&self) -> u32 {
        self.dropped
    }
}

#[cfg(test)]
mod tests {
    use super::Ring;

    /// RPT-1a: a full ring keeps the newest and counts the rest.
    #[test]
    fn a_full_ring_keeps_the_newest_and_counts_the_rest() {
        let (mut ring, mut one) = (Ring::<u8, 3>::new(), Ring::<u8, 1>::new());
        for value in 1..=5 {
            ring.push(value);
            one.push(value);
        }
        assert!(ring.iter().eq(&[3, 4, 5]) && one.iter().eq(&[5]));
        assert_eq!((ring.dropped(), one.dropped()), (2, 4));
    }
}
