//! The content of DM1, PGN 65226 (J1939-73): lamps, then four bytes for every active code.

use crate::fault::{FaultReport, Lamps, Trouble};
use crate::table::CODES;

/// Bytes before the first code.
const HEAD: usize = 2;
/// Bytes of one code.
const EACH: usize = 4;
/// The longest content: every code active.
const MOST: usize = HEAD + EACH * CODES;

// A transport session carries at most 1785 bytes.
const _: () = assert!(MOST <= 1785);

/// The content of one DM1.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Dm1 {
    bytes: heapless::Vec<u8, MOST>,
}

impl Dm1 {
    /// No code is active: lamps off, SPN 0, FMI 0, count 0.
    pub(crate) fn clear() -> Self {
        Self::of(Lamps::default(), core::iter::empty())
    }

    /// What is active now.
    pub(crate) fn of_report(report: &FaultReport) -> Self {
        Self::of(report.lamps(), report.active())
    }

    fn of(lamps: Lamps, troubles: impl Iterator<Item = Trouble>) -> Self {
        let mut bytes = heapless::Vec::new();
        // There is room for every row of the table, so no append fails.
        let _ = bytes.extend_from_slice(&[status(lamps), NO_FLASH]);
        for trouble in troubles {
            let _ = bytes.extend_from_slice(&code(trouble));
        }
        if bytes.len() == HEAD {
            let _ = bytes.extend_from_slice(&[0; EACH]);
        }
        Self { bytes }
    }

    /// How many bytes.
    pub(crate) fn length(&self) -> usize {
        self.bytes.len()
    }

    /// The byte at this place; 0xFF beyond the end, as J1939 pads.
    pub(crate) fn byte(&self, at: usize) -> u8 {
        self.bytes.get(at).copied().unwrap_or(PAD)
    }
}

/// Fills a frame up.
pub(crate) const PAD: u8 = 0xFF;
/// Byte 2, two bits for each lamp: "does not flash".
const NO_FLASH: u8 = 0xFF;

/// Byte 1, two bits for each lamp, 1 is on: MIL (bits 8, 7), red stop (6, 5), amber warning (4, 3), protect (2, 1).
/// The MIL speaks of emissions and the protect lamp of parts that are no electronics: both stay off.
const fn status(lamps: Lamps) -> u8 {
    let red = if lamps.red_stop { 0b01_00_00 } else { 0 };
    let amber = if lamps.amber_warning { 0b01_00 } else { 0 };
    red | amber
}

/// Four bytes: SPN bits 1 to 8, 9 to 16, then 17 to 19 above the FMI, then the count below the conversion method 0.
fn code(trouble: Trouble) -> [u8; EACH] {
    let [low, middle, high, _] = trouble.code.spn.raw().to_le_bytes();
    [low, middle, high.wrapping_shl(5) | trouble.code.fmi.code(), trouble.occurrences & 0x7F]
}
