//! Files: plain or gzip, told by their first bytes, never by their name.

use std::fs::File;
use std::io::{self, Chain, Cursor, Read};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use flate2::read::MultiGzDecoder;

/// The first bytes of every gzip file.
const GZIP: [u8; 2] = [0x1F, 0x8B];

/// A log that cannot be read at all.
#[derive(Debug, thiserror::Error)]
#[error("{}: {reason}", file.display())]
pub struct OpenError {
    /// The file.
    pub file: PathBuf,
    /// Why.
    pub reason: io::Error,
}

/// Counts the bytes that were read from the file itself, for the progress bar.
struct Counted<R> {
    inner: R,
    count: Arc<AtomicU64>,
}

impl<R: Read> Read for Counted<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let count = self.inner.read(buffer)?;
        self.count.fetch_add(u64::try_from(count).unwrap_or(u64::MAX), Ordering::Relaxed);
        Ok(count)
    }
}

/// An open log.
pub struct Source {
    stream: Box<dyn Read + Send>,
}

impl std::fmt::Debug for Source {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("Source")
    }
}

impl Source {
    /// Opens a file, or the standard input for `-`. `read` counts the bytes taken from it.
    ///
    /// # Errors
    /// If it cannot be opened, or its first bytes cannot be read (a folder, for example).
    pub fn open(file: &Path, read: &Arc<AtomicU64>) -> Result<Self, OpenError> {
        let error = |reason| OpenError { file: file.to_owned(), reason };
        let raw: Box<dyn Read + Send> =
            if file == Path::new("-") { Box::new(io::stdin()) } else { Box::new(File::open(file).map_err(error)?) };
        let mut raw = Counted { inner: raw, count: Arc::clone(read) };
        let mut head = Vec::with_capacity(GZIP.len());
        raw.by_ref().take(2).read_to_end(&mut head).map_err(error)?;
        let zipped = head == GZIP;
        let whole: Chain<Cursor<Vec<u8>>, _> = Cursor::new(head).chain(raw);
        let stream: Box<dyn Read + Send> = if zipped {
            Box::new(MultiGzDecoder::new(io::BufReader::with_capacity(128 * 1024, whole)))
        } else {
            Box::new(whole)
        };
        Ok(Self { stream })
    }
}

impl Read for Source {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        self.stream.read(buffer)
    }
}
