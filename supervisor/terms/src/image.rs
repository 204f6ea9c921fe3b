//! Retained values at rest: words beside their complement (SELF-5).

use crate::word::Words;

/// Integers beside their complement. A flipped bit makes [`decode`](Self::decode) fail.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(kani, derive(kani::Arbitrary))]
pub struct Image<const N: usize> {
    words: [u32; N],
    complement: [u32; N],
}

impl<const N: usize> Image<N> {
    /// Puts a value of `N` words to rest.
    #[must_use]
    pub fn encode<T: Words>(value: &T) -> Self {
        let mut image = Self { words: [0; N], complement: [u32::MAX; N] };
        let mut slots = image.words.iter_mut().zip(image.complement.iter_mut());
        value.write(&mut |word| {
            if let Some((slot, complement)) = slots.next() {
                *slot = word;
                *complement = !word;
            }
        });
        image
    }

    /// SELF-5a: whether every word and its complement agree.
    #[must_use]
    pub fn intact(&self) -> bool {
        self.words.iter().zip(&self.complement).all(|(word, complement)| *word == !*complement)
    }

    /// The value, or `None` if the image is not intact, or a word decodes to no value.
    #[must_use]
    pub fn decode<T: Words>(&self) -> Option<T> {
        let mut words = self.words.iter().copied();
        if self.intact() { T::read(&mut || words.next()) } else { None }
    }

    /// The same image with bit `bit` of word `index` flipped; indices run over words, then complements.
    ///
    /// Fault injection in safe code: a flipped bit at rest.
    #[must_use]
    pub fn with_flipped_bit(mut self, index: usize, bit: u32) -> Self {
        let mask = 1_u32.checked_shl(bit).unwrap_or(0);
        let complement = index.checked_sub(N).and_then(|index| self.complement.get_mut(index));
        if let Some(word) = self.words.get_mut(index).or(complement) {
            *word ^= mask;
        }
        self
    }
}
