//! Where a signal lies in a frame, for both byte orders of a DBC.

use can_dbc::{ByteOrder, ValueType};

use crate::number;

/// A signal's place in the eight bytes of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Layout {
    order: ByteOrder,
    signed: bool,
    /// How far the signal is from the lowest bit of the 64-bit word, in its byte order.
    shift: u32,
    size: u32,
    /// How many bytes a frame must carry to hold it.
    bytes: u8,
}

impl Layout {
    /// The place of a signal, `None` if it does not fit into eight bytes.
    ///
    /// Big-endian signals count as DBC does: `start` is the most significant bit, bits are numbered 7 to 0 in the
    /// first byte, 15 to 8 in the second, and so on.
    #[must_use]
    pub fn new(start: u64, size: u64, order: ByteOrder, kind: ValueType) -> Option<Self> {
        let (start, size) = (u32::try_from(start).ok()?, u32::try_from(size).ok()?);
        let first = match order {
            ByteOrder::LittleEndian => start,
            ByteOrder::BigEndian => start.checked_div(8)?.checked_mul(8)?.checked_add(7 - start % 8)?,
        };
        let last = first.checked_add(size)?;
        if size == 0 || last > 64 {
            return None;
        }
        let shift = match order {
            ByteOrder::LittleEndian => first,
            ByteOrder::BigEndian => 64 - last,
        };
        let bytes = u8::try_from(last.div_ceil(8)).ok()?;
        Some(Self { order, signed: kind == ValueType::Signed, shift, size, bytes })
    }

    /// The raw bits, `None` if the frame is too short.
    #[must_use]
    pub fn raw(&self, data: [u8; 8], length: u8) -> Option<u64> {
        let word = match self.order {
            ByteOrder::LittleEndian => u64::from_le_bytes(data),
            ByteOrder::BigEndian => u64::from_be_bytes(data),
        };
        (length >= self.bytes).then_some((word >> self.shift) & self.ones())
    }

    /// All bits set: "not available" in J1939.
    #[must_use]
    pub const fn ones(&self) -> u64 {
        u64::MAX >> (64 - self.size)
    }

    /// How many bits it has.
    #[must_use]
    pub const fn size(&self) -> u32 {
        self.size
    }

    /// The raw bits as a number, sign extended if the signal is signed.
    #[must_use]
    pub fn number(&self, raw: u64) -> f64 {
        if self.signed {
            let unused = 64 - self.size;
            number::signed((raw << unused).cast_signed() >> unused)
        } else {
            number::float(raw)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Layout;
    use can_dbc::{ByteOrder, ValueType};

    const DATA: [u8; 8] = [0x12, 0x34, 0x56, 0x78, 0x9A, 0xBC, 0xDE, 0xF0];

    fn raw(start: u64, size: u64, order: ByteOrder) -> Option<u64> {
        Layout::new(start, size, order, ValueType::Unsigned)?.raw(DATA, 8)
    }

    #[test]
    fn little_endian() {
        assert_eq!(raw(0, 8, ByteOrder::LittleEndian), Some(0x12));
        assert_eq!(raw(8, 16, ByteOrder::LittleEndian), Some(0x5634));
        assert_eq!(raw(4, 8, ByteOrder::LittleEndian), Some(0x41));
        assert_eq!(raw(0, 64, ByteOrder::LittleEndian), Some(0xF0DE_BC9A_7856_3412));
        assert_eq!(raw(60, 4, ByteOrder::LittleEndian), Some(0xF));
        assert_eq!(raw(60, 5, ByteOrder::LittleEndian), None);
    }

    #[test]
    fn big_endian() {
        assert_eq!(raw(7, 8, ByteOrder::BigEndian), Some(0x12));
        assert_eq!(raw(7, 16, ByteOrder::BigEndian), Some(0x1234));
        assert_eq!(raw(3, 8, ByteOrder::BigEndian), Some(0x23));
        assert_eq!(raw(15, 12, ByteOrder::BigEndian), Some(0x345));
        assert_eq!(raw(7, 64, ByteOrder::BigEndian), Some(0x1234_5678_9ABC_DEF0));
        assert_eq!(raw(59, 4, ByteOrder::BigEndian), Some(0x0));
        assert_eq!(raw(59, 5, ByteOrder::BigEndian), None);
        assert_eq!(raw(7, 0, ByteOrder::BigEndian), None);
    }

    #[test]
    fn signs_are_extended() {
        let number = |kind, raw| Layout::new(0, 4, ByteOrder::LittleEndian, kind).map(|layout| layout.number(raw));
        assert_eq!(number(ValueType::Signed, 0xF), Some(-1.0));
        assert_eq!(number(ValueType::Signed, 0x7), Some(7.0));
        assert_eq!(number(ValueType::Unsigned, 0xF), Some(15.0));
    }

    #[test]
    fn a_short_frame_does_not_hold_it() {
        let layout = Layout::new(8, 16, ByteOrder::LittleEndian, ValueType::Unsigned);
        assert_eq!(layout.and_then(|layout| layout.raw(DATA, 2)), None);
        assert_eq!(layout.and_then(|layout| layout.raw(DATA, 3)), Some(0x5634));
        let layout = Layout::new(7, 16, ByteOrder::BigEndian, ValueType::Unsigned);
        assert_eq!(layout.and_then(|layout| layout.raw(DATA, 1)), None);
    }
}
