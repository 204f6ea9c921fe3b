//! A bounded ring that counts what it drops.

/// The last `N` values; a ring of length 0 does not compile. When it is full the oldest goes, and is counted.
///
/// An array of its own and not a `heapless::Deque`: that one counts its places with sums that are checked for overflow
/// wherever the profile checks, and the check is a panic in whoever takes an event record (SELF-1b).
#[derive(Clone, Debug)]
pub(crate) struct Ring<T, const N: usize> {
    values: [Option<T>; N],
    /// Where the next value goes: the oldest one, once the ring is full.
    next: usize,
    dropped: u32,
}

impl<T, const N: usize> Ring<T, N> {
    /// Empty.
    pub(crate) const fn new() -> Self {
        const { assert!(N > 0, "a ring of length 0 keeps nothing") };
        Self { values: [const { None }; N], next: 0, dropped: 0 }
    }

    /// Adds a value.
    pub(crate) fn push(&mut self, value: T) {
        if self.values.get_mut(self.next).and_then(|slot| slot.replace(value)).is_some() {
            self.dropped = self.dropped.saturating_add(1);
        }
        let next = self.next.saturating_add(1);
        self.next = if next < N { next } else { 0 };
    }

    /// From the oldest to the newest.
    pub(crate) fn iter(&self) -> impl Iterator<Item = &T> {
        let (newer, older) = (self.values.get(..self.next), self.values.get(self.next..));
        older.unwrap_or_default().iter().chain(newer.unwrap_or_default()).flatten()
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
