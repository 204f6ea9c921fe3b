//! Is this frame intact, and does it carry a counter? (E2E-1b, CMD-7c)

use crate::frame::{extract, insert};
use crate::refusal::Fault;

/// How a message is protected: its class (E2E-1a), of which every message has exactly one. *Redundant* is a property of
/// signals, not of messages: the core compares the two sources.
///
/// How much it is worth: Profile 11 finds every 2 flipped bits and every burst of 8 bits behind the CRC, and lets one
/// random corruption in 256 pass. The nibbles of J1939 let one in 8 (TSC1) or 16 (XBR) pass; that of TSC1 even misses
/// a single flipped bit 1 of a byte when the sum passes a multiple of 256. The vetting does not rest on them: a
/// corrupted command is a command like any other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Protection {
    /// AUTOSAR E2E Profile 11, variant A: byte 0 is the CRC8 (SAE J1850) over data id and bytes 1 to 7, the low
    /// nibble of byte 1 counts 0 to 14. The data id is the low 16 bits of the CAN id: group extension and source
    /// address, so no frame passes for another message, nor for another sender.
    Profile11,
    /// J1939 TSC1: counter 0 to 7 (SPN 4206) and checksum (SPN 4207) in byte 8; 15 is "not available".
    Tsc1,
    /// J1939 XBR: counter 0 to 15 (SPN 3189) and checksum (SPN 3188) in byte 8.
    Xbr,
    /// None: range and age only (E2E-1e).
    Bare,
}

/// Where a field stands: first bit and width.
type Place = (u32, u32);

impl Protection {
    /// How many values the counter has; it follows on from the last to 0.
    #[must_use]
    pub const fn counts(self) -> u8 {
        match self {
            Self::Profile11 => 15,
            Self::Tsc1 => 8,
            Self::Xbr => 16,
            Self::Bare => 1,
        }
    }

    /// Counter and check field.
    pub(crate) const fn places(self) -> Option<(Place, Place)> {
        match self {
            Self::Profile11 => Some(((8, 4), (0, 8))),
            Self::Tsc1 | Self::Xbr => Some(((56, 4), (60, 4))),
            Self::Bare => None,
        }
    }

    /// What the check field must hold; what stands in it now does not matter.
    fn check(self, id: u32, payload: u64) -> u64 {
        let data = payload.to_le_bytes().into_iter();
        let id_bytes = id.to_le_bytes();
        // J1939: all bytes of data and identifier, with the counter but without the checksum.
        let sum = insert(payload, 60, 4, 0).to_le_bytes().into_iter().chain(id_bytes).map(u64::from).sum::<u64>();
        match self {
            Self::Profile11 => u64::from(crc8(id_bytes.into_iter().take(2).chain(data.skip(1)))),
            Self::Tsc1 => extract(extract(sum, 6, 2).wrapping_add(extract(sum, 3, 9)).wrapping_add(sum), 0, 3),
            Self::Xbr => extract(extract(sum, 4, 8).wrapping_add(sum), 0, 4),
            Self::Bare => 0,
        }
    }

    /// The payload with this counter and the check field it needs.
    #[must_use]
    pub fn seal(self, id: u32, payload: u64, counter: u8) -> u64 {
        self.places().map_or(payload, |((start, width), (check_start, check_width))| {
            let payload = insert(payload, start, width, u64::from(counter));
            insert(payload, check_start, check_width, self.check(id, payload))
        })
    }

    /// The counter of an intact frame; `None` if the message is bare.
    ///
    /// E2E-1b, CMD-7c: a wrong check field is refused, and so is a counter that is reserved or "not available".
    ///
    /// # Errors
    /// What is wrong with it.
    pub fn open(self, id: u32, payload: u64) -> Result<Option<u8>, Fault> {
        let Some(((start, width), (check_start, check_width))) = self.places() else { return Ok(None) };
        let counter = u8::try_from(extract(payload, start, width)).ok().filter(|counter| *counter < self.counts());
        let counter = counter.ok_or(Fault::NoCounter)?;
        if extract(payload, check_start, check_width) != self.check(id, payload) {
            return Err(Fault::Checksum);
        }
        Ok(Some(counter))
    }
}

/// CRC8 with the polynomial of SAE J1850 (0x1D), started and ended with 0 as Profile 11 has it.
fn crc8(bytes: impl Iterator<Item = u8>) -> u8 {
    bytes.fold(0, |crc, byte| {
        (0..8).fold(crc ^ byte, |crc, _| if crc & 0x80 == 0 { crc << 1 } else { (crc << 1) ^ 0x1D })
    })
}
