//! Retained values at rest: words beside their complement, and a digest (SELF-5).

use crate::word::Words;

/// Integers beside their complement. A flipped bit makes [`decode`](Self::decode) fail; the digest then tells which of
/// the two copies is whole.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(kani, derive(kani::Arbitrary))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
pub struct Image<const N: usize> {
    words: [u32; N],
    complement: [u32; N],
    digest: u32,
}

/// Changes with every single flipped bit: rotation and exclusive or are both bijective.
fn digest(words: impl Iterator<Item = u32>) -> u32 {
    words.fold(!0, |digest, word| digest.rotate_left(5) ^ word)
}

impl<const N: usize> Image<N> {
    /// Puts a value of `N` words to rest.
    #[must_use]
    pub fn encode<T: Words>(value: &T) -> Self {
        let mut image = Self { words: [0; N], complement: [u32::MAX; N], digest: 0 };
        let mut slots = image.words.iter_mut().zip(image.complement.iter_mut());
        value.write(&mut |word| {
            if let Some((slot, complement)) = slots.next() {
                *slot = word;
                *complement = !word;
            }
        });
        image.digest = digest(image.words.iter().copied());
        image
    }

    /// SELF-5a: whether every word and its complement agree.
    #[must_use]
    pub fn intact(&self) -> bool {
        // Every pair is looked at, whatever the ones before it say: no early end, and the same time for any image.
        self.words.iter().zip(&self.complement).fold(0, |differ, (word, complement)| differ | (word ^ !complement)) == 0
    }

    /// The value, or `None` if the image is not intact, or a word decodes to no value.
    #[must_use]
    pub fn decode<T: Words>(&self) -> Option<T> {
        if self.intact() { read(self.words.iter().copied()) } else { None }
    }

    /// SELF-5c: the value of an image that is not intact, from the copy that the digest calls whole; `None` if neither is.
    #[must_use]
    pub fn recover<T: Words>(&self) -> Option<T> {
        let (words, complement) = (self.words.iter().copied(), self.complement.iter().map(|word| !*word));
        if digest(words.clone()) == self.digest {
            read(words)
        } else if digest(complement.clone()) == self.digest {
            read(complement)
        } else {
            None
        }
    }

    /// The same image with bit `bit` of word `index` flipped; indices run over words, then complements, then the digest.
    ///
    /// Fault injection in safe code: a flipped bit at rest.
    #[must_use]
    pub fn with_flipped_bit(mut self, index: usize, bit: u32) -> Self {
        let mask = 1_u32.checked_shl(bit).unwrap_or(0);
        let beyond = index.checked_sub(N);
        if let Some(word) = self.words.get_mut(index).or(beyond.and_then(|index| self.complement.get_mut(index))) {
            *word ^= mask;
        } else if beyond == Some(N) {
            self.digest ^= mask;
        }
        self
    }
}

fn read<T: Words>(mut words: impl Iterator<Item = u32>) -> Option<T> {
    T::read(&mut || words.next())
}
