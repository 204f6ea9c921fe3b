//! One line of a candump log, in either layout.
//!
//! ```text
//! (0.022500) can0 0CF00300#FD00FFFFFFFFFFFF          candump -l, candump -L
//! (0.022500)  can0  0CF00300   [8]  FD 00 FF FF ...  candump -ta, -td, -tz, also with -a and -x
//! ```
//!
//! An identifier of 8 digits is extended, one of 3 digits is standard; that is how candump writes them.

/// A data frame of the log.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LogFrame {
    /// Time stamp in microseconds, as the log has it.
    pub micros: u64,
    /// Identifier, 11 or 29 bits.
    pub id: u32,
    /// The identifier has 29 bits.
    pub extended: bool,
    /// How many bytes of `data` the frame carries.
    pub length: u8,
    /// The bytes, zero beyond `length`.
    pub data: [u8; 8],
}

impl LogFrame {
    /// The bytes that the frame carries.
    #[must_use]
    pub fn bytes(&self) -> &[u8] {
        self.data.get(..usize::from(self.length)).unwrap_or(&self.data)
    }
}

/// What a line holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Line<'a> {
    /// A data frame, and the name of the bus it was seen on.
    Frame(LogFrame, &'a [u8]),
    /// A frame that carries no data for us.
    Skipped(Skipped),
    /// Nothing, or a comment.
    Blank,
    /// Not a line of candump.
    Malformed(Malformed),
}

/// Frames that are recognised and left out.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Skipped {
    /// Remote request.
    Remote,
    /// Error frame of the controller.
    Error,
    /// CAN FD frame.
    Fd,
}

impl Skipped {
    /// For people.
    #[must_use]
    pub const fn text(self) -> &'static str {
        match self {
            Self::Remote => "remote frames",
            Self::Error => "error frames",
            Self::Fd => "CAN FD frames",
        }
    }
}

/// Why a line is not one of candump's.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Malformed {
    /// It does not begin with a time stamp in brackets.
    Stamp,
    /// The name of the bus is missing.
    Bus,
    /// The identifier has neither 3 nor 8 hexadecimal digits, or is too great.
    Id,
    /// The length in square brackets is missing or above 8.
    Length,
    /// The data are no hexadecimal bytes, too many, or not as many as the length says.
    Data,
    /// Longer than any line of candump.
    TooLong,
}

impl Malformed {
    /// For people.
    #[must_use]
    pub const fn text(self) -> &'static str {
        match self {
            Self::Stamp => "no time stamp \"(seconds)\" at its beginning",
            Self::Bus => "no name of a bus after the time stamp",
            Self::Id => "no identifier of 3 or 8 hexadecimal digits",
            Self::Length => "no length \"[0]\" to \"[8]\" after the identifier",
            Self::Data => "data are not whole bytes in hexadecimal, or not as many as said",
            Self::TooLong => "longer than any line of candump",
        }
    }
}

/// Greatest standard identifier.
const STANDARD_MOST: u32 = 0x7FF;
/// Greatest extended identifier.
const EXTENDED_MOST: u32 = 0x1FFF_FFFF;
/// Set by candump in the identifier of an error frame.
const ERROR_FLAG: u32 = 0x2000_0000;

/// Reads one line, without its line feed.
#[must_use]
pub fn parse(line: &[u8]) -> Line<'_> {
    read(line).unwrap_or_else(|other| other)
}

fn read(line: &[u8]) -> Result<Line<'_>, Line<'_>> {
    let line = line.trim_ascii();
    let Some((first, rest)) = line.split_first() else { return Ok(Line::Blank) };
    if *first == b'#' {
        return Ok(Line::Blank);
    }
    let bad = Line::Malformed;
    let (micros, rest) = (*first == b'(').then(|| stamp(rest)).flatten().ok_or(bad(Malformed::Stamp))?;
    let (bus, rest) = word(rest).ok_or(bad(Malformed::Bus))?;
    let (token, rest) = word(rest).ok_or(bad(Malformed::Id))?;
    let frame = match memchr::memchr(b'#', token) {
        Some(mark) => {
            let (id, data) = token.split_at(mark);
            compact(micros, id, data.get(1..).unwrap_or_default())
        }
        None => spaced(micros, token, rest),
    }?;
    Ok(Line::Frame(frame, bus))
}

/// `seconds.fraction)`: microseconds, and what follows the bracket. Digits beyond the microsecond are dropped.
fn stamp(text: &[u8]) -> Option<(u64, &[u8])> {
    let mut seconds = 0_u64;
    let mut digits = 0;
    let mut rest = text;
    while let Some((digit, next)) = decimal(rest) {
        seconds = seconds.checked_mul(10)?.checked_add(digit)?;
        digits += 1;
        rest = next;
    }
    let mut micros = seconds.checked_mul(1_000_000)?;
    if let Some((b'.', next)) = rest.split_first() {
        rest = next;
        let mut weight = 100_000;
        while let Some((digit, next)) = decimal(rest) {
            micros = micros.checked_add(digit * weight)?;
            weight /= 10;
            rest = next;
        }
    }
    match rest.split_first() {
        Some((b')', rest)) if digits > 0 => Some((micros, rest)),
        _ => None,
    }
}

fn decimal(text: &[u8]) -> Option<(u64, &[u8])> {
    let (first, rest) = text.split_first()?;
    first.is_ascii_digit().then(|| (u64::from(first - b'0'), rest))
}

/// The next run of bytes without blanks, and what follows it.
fn word(text: &[u8]) -> Option<(&[u8], &[u8])> {
    let text = text.trim_ascii_start();
    let end = text.iter().position(u8::is_ascii_whitespace).unwrap_or(text.len());
    (end > 0).then(|| text.split_at(end))
}

/// Marks a byte that is no hexadecimal digit.
const NO_DIGIT: u8 = 0xFF;

/// The value of each hexadecimal digit, [`NO_DIGIT`] for every other byte.
const HEX: [u8; 256] = {
    let mut table = [NO_DIGIT; 256];
    let mut byte = 0_u8;
    let mut index = 0_usize;
    loop {
        table[index] = match byte {
            b'0'..=b'9' => byte - b'0',
            b'A'..=b'F' => byte - b'A' + 10,
            b'a'..=b'f' => byte - b'a' + 10,
            _ => NO_DIGIT,
        };
        if byte == u8::MAX {
            break table;
        }
        byte += 1;
        index += 1;
    }
};

fn digit(byte: u8) -> u8 {
    HEX[usize::from(byte)]
}

/// Two digits to a byte.
fn byte(high: u8, low: u8) -> Option<u8> {
    let (high, low) = (digit(high), digit(low));
    (high | low != NO_DIGIT).then_some((high << 4) | (low & 0x0F))
}

/// The identifier, and whether it is extended; an error frame is told by its flag.
fn identifier<'a>(text: &[u8]) -> Result<(u32, bool), Line<'a>> {
    let bad = Line::Malformed(Malformed::Id);
    let extended = match text.len() {
        8 => true,
        3 => false,
        _ => return Err(bad),
    };
    let mut id = 0_u32;
    let mut seen = 0;
    for each in text {
        let value = digit(*each);
        seen |= value;
        id = (id << 4) | u32::from(value & 0x0F);
    }
    match (seen, extended) {
        (NO_DIGIT, _) => Err(bad),
        (_, true) if id <= EXTENDED_MOST => Ok((id, true)),
        (_, true) if id & !EXTENDED_MOST == ERROR_FLAG => Err(Line::Skipped(Skipped::Error)),
        (_, false) if id <= STANDARD_MOST => Ok((id, false)),
        _ => Err(bad),
    }
}

/// `data` of `ID#DATA`: pairs of digits; `R` is a remote request, a second `#` is CAN FD.
fn compact<'a>(micros: u64, id: &[u8], data: &[u8]) -> Result<LogFrame, Line<'a>> {
    let bad = Line::Malformed(Malformed::Data);
    let (id, extended) = identifier(id)?;
    match data.first() {
        Some(b'R' | b'r') => return Err(Line::Skipped(Skipped::Remote)),
        Some(b'#') => return Err(Line::Skipped(Skipped::Fd)),
        _ => {}
    }
    // A raw length code beyond 8 bytes, "_9" to "_F", says nothing about the data.
    let coded = |code: u8| digit(code) > 8 && digit(code) != NO_DIGIT;
    let data = if let [data @ .., b'_', code] = data
        && coded(*code)
    {
        data
    } else {
        data
    };
    let (pairs, odd) = data.as_chunks::<2>();
    let mut frame = LogFrame { micros, id, extended, length: 0, data: [0; 8] };
    if !odd.is_empty() || pairs.len() > frame.data.len() {
        return Err(bad);
    }
    for (slot, [high, low]) in frame.data.iter_mut().zip(pairs) {
        *slot = byte(*high, *low).ok_or(bad)?;
        frame.length += 1;
    }
    Ok(frame)
}

/// `ID [length] DD DD ...`, with a direction before it (candump -x) and text after it (candump -a).
fn spaced<'a>(micros: u64, first: &[u8], rest: &[u8]) -> Result<LogFrame, Line<'a>> {
    let bad = Line::Malformed;
    let (mut token, mut rest) = (first, rest);
    if matches!(token, b"RX" | b"TX") {
        // Two flags follow the direction.
        for _ in 0..3 {
            (token, rest) = word(rest).ok_or(bad(Malformed::Id))?;
        }
    }
    let id = identifier(token);
    let (length, mut rest) = word(rest).ok_or(bad(Malformed::Length))?;
    let length = match length {
        [b'[', length @ b'0'..=b'8', b']'] => length - b'0',
        // candump writes two digits for CAN FD only.
        [b'[', b'0'..=b'9', b'0'..=b'9', b']'] => return Err(Line::Skipped(Skipped::Fd)),
        _ => return Err(bad(Malformed::Length)),
    };
    let (id, extended) = id?;
    let mut frame = LogFrame { micros, id, extended, length, data: [0; 8] };
    for slot in frame.data.iter_mut().take(usize::from(length)) {
        let (token, next) = word(rest).ok_or(bad(Malformed::Data))?;
        *slot = match *token {
            [high, low] => byte(high, low).ok_or(bad(Malformed::Data))?,
            _ if token == b"remote" => return Err(Line::Skipped(Skipped::Remote)),
            _ => return Err(bad(Malformed::Data)),
        };
        rest = next;
    }
    match word(rest) {
        None => Ok(frame),
        Some((b"remote", _)) => Err(Line::Skipped(Skipped::Remote)),
        Some((text, _)) if text.starts_with(b"'") => Ok(frame),
        Some(_) => Err(bad(Malformed::Data)),
    }
}

#[cfg(test)]
mod tests {
    use super::{Line, LogFrame, Malformed, Skipped, parse};

    const FRAME: LogFrame =
        LogFrame { micros: 22_500, id: 0x0CF0_0300, extended: true, length: 2, data: [0xFD, 0, 0, 0, 0, 0, 0, 0] };

    fn frame(line: &str) -> LogFrame {
        match parse(line.as_bytes()) {
            Line::Frame(frame, _) => frame,
            other @ (Line::Skipped(_) | Line::Blank | Line::Malformed(_)) => {
                eprintln!("{line}: {other:?}");
                LogFrame { id: u32::MAX, ..FRAME }
            }
        }
    }

    #[test]
    fn both_layouts_give_the_same_frame() {
        for line in [
            "(0.022500) can0 0CF00300#FD00",
            "(0.022500) can0 0cf00300#fd00\r",
            "(0.022500) can0 0CF00300#FD00 R",
            "(0.022500)  can0  0CF00300   [2]  FD 00",
            "(0.022500)  can0  0CF00300   [2]  fd 00\r",
            "  (0.022500)\tcan0\t0CF00300 [2] FD 00  ",
            " (0.022500)  can0  RX - -  0CF00300   [2]  FD 00",
            " (0.022500)  can0  0CF00300   [2]  FD 00   '..'",
            "(0.0225009) can0 0CF00300#FD00",
        ] {
            assert_eq!(frame(line), FRAME, "{line}");
        }
    }

    #[test]
    fn identifiers_are_told_by_their_length() {
        assert_eq!((frame("(1) can0 123#").id, frame("(1) can0 123#").extended), (0x123, false));
        assert_eq!((frame("(1) can0 00000123#").id, frame("(1) can0 00000123#").extended), (0x123, true));
        for id in ["1234", "12", "800", "40000000", "60000000", "GGG", "0CF0030G", ""] {
            assert_eq!(parse(format!("(1) can0 {id}#00").as_bytes()), Line::Malformed(Malformed::Id), "{id}");
        }
    }

    #[test]
    fn epoch_stamps_keep_their_microseconds() {
        assert_eq!(frame("(1699999999.123456) vcan0 123#AA").micros, 1_699_999_999_123_456);
        assert_eq!(frame("(1699999999.5) vcan0 123#AA").micros, 1_699_999_999_500_000);
    }

    #[test]
    fn eight_bytes_and_no_more() {
        assert_eq!(frame("(1) can0 123#1122334455667788").data, [0x11, 0x22, 0x33, 0x44, 0x55, 0x66, 0x77, 0x88]);
        assert_eq!(frame("(1) can0 123#1122334455667788_9").length, 8);
        assert_eq!(frame("(1) can0 123 [8] 11 22 33 44 55 66 77 88").length, 8);
        for line in ["(1) can0 123#112233445566778899", "(1) can0 123#1", "(1) can0 123#1G", "(1) can0 123 [2] 11"] {
            assert_eq!(parse(line.as_bytes()), Line::Malformed(Malformed::Data), "{line}");
        }
        assert_eq!(parse(b"(1) can0 123 [1] 11 22"), Line::Malformed(Malformed::Data));
        assert_eq!(parse(b"(1) can0 123 [9] 11"), Line::Malformed(Malformed::Length));
        assert_eq!(parse(b"(1) can0 123 11 22"), Line::Malformed(Malformed::Length));
    }

    #[test]
    fn what_carries_no_data_for_us_is_skipped() {
        for (line, kind) in [
            ("(1) can0 123#R", Skipped::Remote),
            ("(1) can0 123#R8", Skipped::Remote),
            ("(1)  can0  123   [8]  remote request", Skipped::Remote),
            ("(1)  can0  123   [0]  remote request", Skipped::Remote),
            ("(1) can0 123##0112233", Skipped::Fd),
            ("(1)  can0  123  [12]  11 22 33", Skipped::Fd),
            ("(1) can0 20000004#0004000000000000", Skipped::Error),
            ("(1)  can0  20000004   [8]  00 04 00 00 00 00 00 00   ERRORFRAME", Skipped::Error),
        ] {
            assert_eq!(parse(line.as_bytes()), Line::Skipped(kind), "{line}");
        }
    }

    #[test]
    fn everything_else_is_named() {
        for line in ["", "   ", "\r", "# a comment"] {
            assert_eq!(parse(line.as_bytes()), Line::Blank, "{line:?}");
        }
        for (line, why) in [
            ("can0 123#00", Malformed::Stamp),
            ("(abc) can0 123#00", Malformed::Stamp),
            ("(1.5 can0 123#00", Malformed::Stamp),
            ("(-1.5) can0 123#00", Malformed::Stamp),
            ("(99999999999999999999) can0 123#00", Malformed::Stamp),
            ("(18446744073709.551616) can0 123#00", Malformed::Stamp),
            ("(1)", Malformed::Bus),
            ("(1) can0", Malformed::Id),
            ("\u{fffd}\u{fffd}", Malformed::Stamp),
        ] {
            assert_eq!(parse(line.as_bytes()), Line::Malformed(why), "{line}");
        }
    }
}
