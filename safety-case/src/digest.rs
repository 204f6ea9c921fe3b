//! A digest of every verdict: two replays agree to the bit exactly when their digests do.
//!
//! FNV-1a, 64 bits, over kind and reason (one byte each), value, limit and margin (32 bits, little endian) of every
//! channel in order, cycle by cycle. The simulation that made the shipped drives writes the same digest.

use supervisor::Verdicts;

/// A digest in the making.
#[derive(Clone, Copy, Debug)]
pub struct Digest(u64);

impl Default for Digest {
    fn default() -> Self {
        Self(0xCBF2_9CE4_8422_2325)
    }
}

impl Digest {
    /// Adds the verdicts of a cycle.
    pub fn add(&mut self, verdicts: &Verdicts) {
        for (_, verdict) in verdicts.iter() {
            let codes = [verdict.kind.code(), verdict.reason.code()];
            let numbers = [verdict.value, verdict.limit, verdict.margin].map(i32::to_le_bytes);
            for byte in codes.iter().chain(numbers.as_flattened()) {
                self.0 = (self.0 ^ u64::from(*byte)).wrapping_mul(0x0000_0100_0000_01B3);
            }
        }
    }

    /// The digest of everything added.
    #[must_use]
    pub const fn value(self) -> u64 {
        self.0
    }
}
