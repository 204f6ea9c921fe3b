//! A CAN frame, and bits in its payload.

/// A CAN frame with a 29-bit identifier.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(kani, derive(kani::Arbitrary))]
pub struct Frame {
    /// Identifier, 29 bits.
    pub id: u32,
    /// Number of data bytes.
    pub length: u8,
    /// Data; bytes beyond `length` have no meaning.
    pub data: [u8; 8],
}

impl Frame {
    /// The length of every frame of the table.
    pub const LENGTH: u8 = 8;

    /// A full frame with this payload, least significant byte first.
    #[must_use]
    pub const fn new(id: u32, payload: u64) -> Self {
        Self { id, length: Self::LENGTH, data: payload.to_le_bytes() }
    }
    /// The data as one number, least significant byte first: bit n of it is bit n of the DBC (Intel order).
    #[must_use]
    pub const fn payload(&self) -> u64 {
        u64::from_le_bytes(self.data)
    }
}

/// The greatest raw value of a field of `width` bits.
pub(crate) const fn full(width: u32) -> u64 {
    1_u64.wrapping_shl(width).wrapping_sub(1)
}

/// The raw value of the field of `width` bits at `start`.
pub(crate) const fn extract(payload: u64, start: u32, width: u32) -> u64 {
    payload.wrapping_shr(start) & full(width)
}

/// The payload with `raw` in the field of `width` bits at `start`.
pub(crate) const fn insert(payload: u64, start: u32, width: u32, raw: u64) -> u64 {
    // The field's bits that differ are flipped.
    payload ^ (payload ^ raw.wrapping_shl(start)) & full(width).wrapping_shl(start)
}
