//! Logs as candump writes them: `(seconds.micros) can0 ID#DATA`, packed with gzip without a time stamp of its own.

use std::fmt::Write as _;
use std::io::{self, Read as _, Write as _};

use flate2::read::GzDecoder;
use flate2::{Compression, GzBuilder};
use supervisor::wire::Frame;

use crate::link::Stamped;

/// The name of the bus in the logs.
const BUS: &str = "can0";

/// The log as text.
#[must_use]
pub fn text(frames: &[Stamped]) -> String {
    let mut text = String::with_capacity(frames.len() * 48);
    for Stamped { micros, frame } in frames {
        let (seconds, rest) = (micros / 1_000_000, micros % 1_000_000);
        let data = frame.data.iter().take(usize::from(frame.length));
        // Writing to a String cannot fail.
        let _ = write!(text, "({seconds:010}.{rest:06}) {BUS} {:08X}#", frame.id);
        data.for_each(|byte| {
            let _ = write!(text, "{byte:02X}");
        });
        text.push('\n');
    }
    text
}

/// The log as a gzip file: the same bytes for the same frames.
///
/// # Errors
/// None in practice: it writes to memory.
pub fn packed(frames: &[Stamped]) -> io::Result<Vec<u8>> {
    let mut encoder = GzBuilder::new().mtime(0).operating_system(255).write(Vec::new(), Compression::best());
    encoder.write_all(text(frames).as_bytes())?;
    encoder.finish()
}

/// The frames of a gzip file that [`packed`] wrote.
///
/// # Errors
/// If it is no gzip file, or a line is none of [`text`]'s.
pub fn unpacked(file: &[u8]) -> io::Result<Vec<Stamped>> {
    let mut text = String::new();
    GzDecoder::new(file).read_to_string(&mut text)?;
    let bad = |line: &str| io::Error::new(io::ErrorKind::InvalidData, line.to_owned());
    text.lines().map(|line| parse(line).ok_or_else(|| bad(line))).collect()
}

fn parse(line: &str) -> Option<Stamped> {
    let (stamp, rest) = line.strip_prefix('(')?.split_once(") ")?;
    let (seconds, micros) = stamp.split_once('.')?;
    let (id, digits) = rest.strip_prefix(BUS)?.trim_start().split_once('#')?;
    let mut frame = Frame { id: u32::from_str_radix(id, 16).ok()?, length: 0, data: [0; 8] };
    for (byte, at) in frame.data.iter_mut().zip((0..digits.len()).step_by(2)) {
        *byte = u8::from_str_radix(digits.get(at..at + 2)?, 16).ok()?;
        frame.length += 1;
    }
    let micros = seconds.parse::<u64>().ok()? * 1_000_000 + micros.parse::<u64>().ok()?;
    Some(Stamped { micros, frame })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_log_survives_packing() -> io::Result<()> {
        let frame = |id, length, data| Stamped { micros: 12_345_678, frame: Frame { id, length, data } };
        let frames =
            [frame(0x18FE_F100, 8, [0xFF, 0, 1, 2, 3, 4, 5, 6]), frame(0x0CF0_0300, 2, [0xFD, 0, 0, 0, 0, 0, 0, 0])];
        assert!(text(&frames).starts_with("(0000000012.345678) can0 18FEF100#FF00010203040506\n"));
        assert_eq!(unpacked(&packed(&frames)?)?, frames);
        assert_eq!(packed(&frames)?, packed(&frames)?, "no time stamp in the file");
        assert!(unpacked(&packed(&[])?)?.is_empty());
        Ok(())
    }
}
