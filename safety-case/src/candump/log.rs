//! One or several logs as one stream of frames.

use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::AtomicU64;

use super::line::{Line, LogFrame, Malformed, parse};
use super::lines::{Lines, Text};
use super::source::{OpenError, Source};
use crate::notes::{Notes, Oddity, Place};

/// How much of a line is shown when it is named.
const SHOWN: usize = 60;

/// The logs of one drive, in the order given.
#[derive(Debug)]
pub struct Log {
    files: Vec<PathBuf>,
    bus: Option<Vec<u8>>,
    read: Arc<AtomicU64>,
    open: Option<Lines<Source>>,
    next: usize,
    place: Place,
    lines: u64,
}

impl Log {
    /// Checks that every file can be opened before the first is read.
    ///
    /// # Errors
    /// The first file that cannot.
    pub fn open(files: &[PathBuf], bus: Option<&str>) -> Result<Self, OpenError> {
        for file in files.iter().filter(|file| file.as_os_str() != "-") {
            Source::open(file, &Arc::default())?;
        }
        let bus = bus.map(|bus| bus.as_bytes().to_vec());
        let read = Arc::default();
        Ok(Self { files: files.to_vec(), bus, read, open: None, next: 0, place: Place::default(), lines: 0 })
    }

    /// Counts the bytes read from the files, for a progress bar.
    #[must_use]
    pub fn bytes_read(&self) -> Arc<AtomicU64> {
        Arc::clone(&self.read)
    }

    /// Lines that were not blank.
    #[must_use]
    pub const fn lines(&self) -> u64 {
        self.lines
    }

    /// The next frame and where it stands. Everything that is none is counted in `notes`.
    pub fn next(&mut self, notes: &mut Notes) -> Option<(Place, LogFrame)> {
        loop {
            let Some(open) = &mut self.open else {
                let file = self.files.get(self.next)?;
                self.place = Place { file: self.next, line: 0 };
                self.next += 1;
                match Source::open(file, &self.read) {
                    Ok(source) => self.open = Some(Lines::new(source)),
                    // It could be opened before: it vanished while others were read.
                    Err(error) => notes.add(Oddity::Broken, self.place, || error.reason.to_string()),
                }
                continue;
            };
            let Some(text) = open.next() else {
                self.open = None;
                continue;
            };
            self.place.line += 1;
            let text = match text {
                Text::Line(text) => text,
                Text::TooLong => {
                    self.lines += 1;
                    notes.add(Oddity::Malformed(Malformed::TooLong), self.place, String::new);
                    continue;
                }
                Text::Broken(reason) => {
                    notes.add(Oddity::Broken, self.place, || reason);
                    continue;
                }
            };
            let oddity = match parse(text) {
                Line::Frame(frame, bus) if self.bus.as_ref().is_none_or(|wanted| wanted == bus) => {
                    self.lines += 1;
                    return Some((self.place, frame));
                }
                Line::Frame(..) => Oddity::OtherBus,
                Line::Skipped(kind) => Oddity::Skipped(kind),
                Line::Malformed(why) => Oddity::Malformed(why),
                Line::Blank => continue,
            };
            self.lines += 1;
            notes.add(oddity, self.place, || shown(text));
        }
    }
}

/// The beginning of a line, as text.
fn shown(line: &[u8]) -> String {
    let line = line.trim_ascii();
    let head = line.get(..SHOWN).unwrap_or(line);
    let text: String =
        String::from_utf8_lossy(head).chars().map(|each| if each.is_control() { '·' } else { each }).collect();
    if head.len() < line.len() { format!("{text}…") } else { text }
}

#[cfg(test)]
mod tests {
    use std::io::Write;

    use super::Log;
    use crate::notes::{Notes, Oddity};

    type Outcome = Result<(), Box<dyn std::error::Error>>;

    fn replay(name: &str, content: &[u8]) -> Result<(u64, Notes), Box<dyn std::error::Error>> {
        let folder = tempfile::tempdir()?;
        let file = folder.path().join(name);
        std::fs::write(&file, content)?;
        let mut log = Log::open(std::slice::from_ref(&file), None)?;
        let mut notes = Notes::new(vec![file]);
        let mut frames = 0;
        while log.next(&mut notes).is_some() {
            frames += 1;
        }
        Ok((frames, notes))
    }

    fn zipped(content: &[u8]) -> Result<Vec<u8>, std::io::Error> {
        let mut encoder = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::default());
        encoder.write_all(content)?;
        encoder.finish()
    }

    fn synthetic(lines: u32) -> String {
        (0..lines)
            .map(|line| format!("({}.{:06}) can0 18FEF100#FF{line:08X}FFFF\n", line / 1000, line % 1000))
            .collect::<Vec<_>>()
            .concat()
    }

    #[test]
    fn plain_and_zipped_are_told_by_their_bytes() -> Outcome {
        let text = synthetic(1000);
        assert_eq!(replay("plain.gz", text.as_bytes())?.0, 1000);
        assert_eq!(replay("zipped.log", &zipped(text.as_bytes())?)?.0, 1000);
        Ok(())
    }

    #[test]
    fn carriage_returns_and_an_empty_file() -> Outcome {
        assert_eq!(replay("crlf", b"(1.0) can0 123#00\r\n\r\n(1.1) can0 123#00\r\n")?.0, 2);
        let (frames, notes) = replay("empty", b"")?;
        assert_eq!((frames, notes.lines().len()), (0, 0));
        Ok(())
    }

    #[test]
    fn a_truncated_gzip_gives_what_it_has_and_says_so() -> Outcome {
        let whole = zipped(synthetic(20_000).as_bytes())?;
        let (frames, notes) = replay("cut.gz", whole.get(..whole.len() / 2).unwrap_or_default())?;
        assert!(frames > 1000 && frames < 20_000, "{frames}");
        assert_eq!(notes.count(&Oddity::Broken), 1);
        assert_eq!(notes.malformed(), 0, "a cut line is not taken for a malformed one");
        let line = notes.lines().into_iter().next().and_then(|line| line.first.into_iter().next()).unwrap_or_default();
        assert!(line.contains(&format!("cut.gz:{}", frames + 1)) && line.contains("truncated"), "{line}");
        Ok(())
    }

    #[test]
    fn a_damaged_gzip_gives_what_it_has_and_says_so() -> Outcome {
        let mut whole = zipped(synthetic(20_000).as_bytes())?;
        let middle = whole.len() / 2;
        whole.iter_mut().skip(middle).take(64).for_each(|byte| *byte = 0xFF);
        let (_, notes) = replay("bad.gz", &whole)?;
        assert_eq!(notes.count(&Oddity::Broken), 1);
        Ok(())
    }

    #[test]
    fn malformed_lines_are_named_and_never_fatal() -> Outcome {
        let (frames, notes) =
            replay("odd", b"(1.0) can0 123#00\nrubbish\x00\xff\n(1.1) can0 123#0\n(1.2) can0 123#00\n")?;
        assert_eq!((frames, notes.malformed()), (2, 2));
        let first: Vec<String> = notes.lines().into_iter().flat_map(|line| line.first).collect();
        assert!(first.iter().any(|line| line.contains("odd:2: rubbish·")), "{first:?}");
        assert!(first.iter().any(|line| line.contains("odd:3: (1.1) can0 123#0")), "{first:?}");
        Ok(())
    }

    #[test]
    fn a_file_that_is_not_there_is_an_error_that_names_it() {
        let error = Log::open(&["/nowhere/a.log".into()], None).map(|_| ()).map_err(|error| error.to_string());
        assert!(error.is_err_and(|text| text.starts_with("/nowhere/a.log: ")));
    }

    #[test]
    fn a_folder_is_an_error_that_names_it() {
        assert!(Log::open(&[std::env::temp_dir()], None).is_err());
    }

    #[test]
    fn ten_megabytes_read_in_one_go() -> Outcome {
        let lines = 250_000;
        assert_eq!(replay("long", synthetic(lines).as_bytes())?.0, u64::from(lines));
        Ok(())
    }
}
