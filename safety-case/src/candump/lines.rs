//! Lines of a stream in bounded memory: nothing is allocated per line, and no line can be too long.

use std::io::{ErrorKind, Read};

/// Longest line that is looked at; candump's longest is about 100 bytes.
const LONGEST: usize = 4096;
/// Bytes that are read at once.
const BLOCK: usize = 256 * 1024;

/// What comes next.
#[derive(Debug, PartialEq, Eq)]
pub enum Text<'a> {
    /// A line, without its line feed.
    Line(&'a [u8]),
    /// A line longer than any line of candump was left out.
    TooLong,
    /// The stream broke here: the reason. What stood before the break was given out already, but for a partial line.
    Broken(String),
}

/// Splits a stream into lines.
#[derive(Debug)]
pub struct Lines<R> {
    stream: R,
    buffer: Vec<u8>,
    start: usize,
    end: usize,
    state: State,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum State {
    Reading,
    /// In the middle of a line that is too long.
    Discarding,
    Ended,
    Done,
}

impl<R: Read> Lines<R> {
    /// Lines of `stream`.
    #[must_use]
    pub fn new(stream: R) -> Self {
        Self { stream, buffer: vec![0; BLOCK + LONGEST], start: 0, end: 0, state: State::Reading }
    }

    /// The next line, or `None` at the end.
    #[expect(clippy::should_implement_trait, reason = "it lends from its buffer, which an Iterator cannot")]
    pub fn next(&mut self) -> Option<Text<'_>> {
        loop {
            let unread = self.buffer.get(self.start..self.end).unwrap_or_default();
            if let Some(length) = memchr::memchr(b'\n', unread) {
                let (start, end) = (self.start, self.start + length);
                self.start = end + 1;
                if self.state == State::Discarding {
                    self.state = State::Reading;
                    return Some(Text::TooLong);
                }
                return Some(Text::Line(self.buffer.get(start..end).unwrap_or_default()));
            }
            match self.state {
                State::Done => return None,
                State::Ended => {
                    let (start, end) = (self.start, self.end);
                    self.start = self.end;
                    self.state = State::Done;
                    return (start < end).then(|| Text::Line(self.buffer.get(start..end).unwrap_or_default()));
                }
                State::Reading | State::Discarding => {
                    if unread.len() > LONGEST {
                        self.state = State::Discarding;
                    }
                    if self.state == State::Discarding {
                        self.start = self.end;
                    }
                    if let Err(reason) = self.fill() {
                        (self.start, self.end, self.state) = (0, 0, State::Done);
                        return Some(Text::Broken(reason));
                    }
                }
            }
        }
    }

    /// Moves what is unread to the front and reads on behind it.
    fn fill(&mut self) -> Result<(), String> {
        self.buffer.copy_within(self.start..self.end, 0);
        (self.start, self.end) = (0, self.end - self.start);
        let free = self.buffer.get_mut(self.end..).unwrap_or_default();
        loop {
            match self.stream.read(free) {
                Ok(0) => {
                    // An unfinished line that is too long ends with the stream.
                    let discarding = self.state == State::Discarding;
                    self.state = State::Ended;
                    return if discarding { Err("the last line is endless".to_owned()) } else { Ok(()) };
                }
                Ok(count) => {
                    self.end += count;
                    return Ok(());
                }
                Err(error) if error.kind() == ErrorKind::Interrupted => {}
                Err(error) => return Err(reason(&error)),
            }
        }
    }
}

/// What broke the stream, for people.
fn reason(error: &std::io::Error) -> String {
    if error.kind() == ErrorKind::UnexpectedEof {
        "the compressed data end too early (truncated file)".to_owned()
    } else {
        error.to_string()
    }
}

#[cfg(test)]
mod tests {
    use super::{Lines, Text};
    use std::io::Read;

    fn all(stream: impl Read) -> Vec<String> {
        let mut lines = Lines::new(stream);
        let mut found = Vec::new();
        while let Some(text) = lines.next() {
            found.push(match text {
                Text::Line(line) => String::from_utf8_lossy(line).into_owned(),
                Text::TooLong => "<too long>".to_owned(),
                Text::Broken(why) => format!("<{why}>"),
            });
        }
        found
    }

    #[test]
    fn splits_with_and_without_a_last_line_feed() {
        assert_eq!(all(&b""[..]), Vec::<String>::new());
        assert_eq!(all(&b"a\nb"[..]), ["a", "b"]);
        assert_eq!(all(&b"a\n\nb\n"[..]), ["a", "", "b"]);
    }

    #[test]
    fn an_endless_line_is_left_out_in_bounded_memory() {
        let endless = std::io::repeat(b'x').take(3_000_000).chain(&b"\nb\n"[..]);
        assert_eq!(all((&b"a\n"[..]).chain(endless)), ["a", "<too long>", "b"]);
        assert_eq!(all(std::io::repeat(b'x').take(3_000_000)), ["<the last line is endless>"]);
    }

    #[test]
    fn lines_across_blocks_are_whole() {
        let text = (0..100_000).map(|number| format!("{number}\n")).collect::<Vec<_>>().concat();
        let lines = all(text.as_bytes());
        assert_eq!(lines.len(), 100_000);
        assert!(lines.iter().enumerate().all(|(number, line)| *line == number.to_string()));
    }
}
