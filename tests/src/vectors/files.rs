//! The files of a vector.
//!
//! | file | what |
//! |---|---|
//! | `NAME.frames.csv` | a line for each frame that comes in: cycle, time in ms, identifier, length, data |
//! | `NAME.commands.csv` | a line for each cycle: the commands as they reached the vetting |
//! | `NAME.decisions.csv` | a line for each cycle: verdicts, outputs, status, how many frames were sent, the digest |
//! | `NAME.h` | frames and cycles as C arrays; a cycle has its digest |
//! | `NAME.vec` | the same in one binary file, to be read cycle by cycle |
//!
//! The binary file, numbers least significant byte first: `"EBSV"`, version 1, number of cycles, reset cause + 256 ·
//! record (255: fails its CRC), four bytes each; then for each cycle: time (4), number of frames (4), digest (8), and for
//! each frame: time (4), identifier (4), data (8), length (1), zeros (3).

use std::fmt::Write as _;
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::Path;

use flate2::{Compression, GzBuilder};
use sha2::{Digest as _, Sha256};
use supervisor::wire::Frame;
use supervisor::{ConfigError, Record};

use super::columns::{Column, commands, decision};
use super::digest::digest;
use super::{Read, Vector, run};

/// Why the files could not be written.
#[derive(Debug)]
pub enum VectorError {
    /// A file.
    File(io::Error),
    /// The default configuration is refused.
    Config(ConfigError),
}

impl std::fmt::Display for VectorError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::File(error) => write!(f, "{error}"),
            Self::Config(error) => write!(f, "{error}"),
        }
    }
}

impl std::error::Error for VectorError {}

impl From<io::Error> for VectorError {
    fn from(error: io::Error) -> Self {
        Self::File(error)
    }
}

impl From<ConfigError> for VectorError {
    fn from(error: ConfigError) -> Self {
        Self::Config(error)
    }
}

/// What a start is in the binary file.
fn start(vector: &Vector) -> u32 {
    u32::from(vector.cause.code()) + 256 * u32::from(vector.record.map_or(u8::MAX, Record::code))
}

/// Writes a file and keeps its SHA-256.
struct Summed {
    file: BufWriter<File>,
    sum: Sha256,
}

impl Summed {
    fn create(path: &Path) -> io::Result<Self> {
        Ok(Self { file: BufWriter::new(File::create(path)?), sum: Sha256::new() })
    }
    fn put(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.sum.update(bytes);
        self.file.write_all(bytes)
    }
    fn finish(mut self) -> io::Result<String> {
        self.file.flush()?;
        Ok(format!("{:x}", self.sum.finalize()))
    }
}

fn data(frame: &Frame) -> String {
    frame.data.iter().take(usize::from(frame.length)).fold(String::new(), |mut text, byte| {
        // Writing to a String cannot fail.
        let _ = write!(text, "{byte:02X}");
        text
    })
}

fn line<'a>(cells: impl Iterator<Item = &'a String>) -> String {
    let mut text = String::new();
    for cell in cells {
        text.push(',');
        text.push_str(cell);
    }
    text.push('\n');
    text
}

/// A row of numbers; the first row of a table has the names above it.
fn row(first: bool, head: &str, cycle: usize, now_ms: u32, columns: &[Column], rest: &[(&str, String)]) -> String {
    let mut text = String::new();
    if first {
        let names: Vec<String> = columns.iter().map(|(name, _)| name.clone()).collect();
        let more: Vec<String> = rest.iter().map(|(name, _)| (*name).to_owned()).collect();
        text.push_str(head);
        text.push_str(&line(names.iter().chain(&more)));
    }
    let _ = write!(text, "{cycle},{now_ms}");
    for (_, value) in columns {
        let _ = write!(text, ",{value}");
    }
    text.push_str(&line(rest.iter().map(|(_, value)| value)));
    text
}

/// The name as a C identifier.
fn identifier(name: &str) -> String {
    name.replace('-', "_")
}

/// The binary file.
struct Binary(Summed);

impl Binary {
    fn create(path: &Path, vector: &Vector) -> io::Result<Self> {
        let mut file = Summed::create(path)?;
        file.put(b"EBSV")?;
        for word in [1, u32::try_from(vector.cycles.len()).unwrap_or(u32::MAX), start(vector)] {
            file.put(&word.to_le_bytes())?;
        }
        Ok(Self(file))
    }
    fn cycle(&mut self, read: &Read, digest: u64) -> io::Result<()> {
        self.0.put(&read.now_ms.to_le_bytes())?;
        self.0.put(&u32::try_from(read.frames.len()).unwrap_or(u32::MAX).to_le_bytes())?;
        self.0.put(&digest.to_le_bytes())?;
        for (at_ms, frame) in &read.frames {
            self.0.put(&at_ms.to_le_bytes())?;
            self.0.put(&frame.id.to_le_bytes())?;
            self.0.put(&frame.data)?;
            self.0.put(&[frame.length, 0, 0, 0])?;
        }
        Ok(())
    }
}

/// Writes the binary file of a vector alone.
///
/// # Errors
/// It cannot be written, or the default configuration is refused.
pub fn write_binary(path: &Path, vector: &Vector) -> Result<(), VectorError> {
    let mut file = Binary::create(path, vector)?;
    run(vector, |read, made| Ok::<(), VectorError>(file.cycle(read, digest(&made.decision, &made.sent))?))?;
    file.0.finish()?;
    Ok(())
}

/// Writes the five files of a vector; each name with its SHA-256.
///
/// # Errors
/// A file cannot be written, or the default configuration is refused.
pub fn write(folder: &Path, vector: &Vector) -> Result<Vec<(String, String)>, VectorError> {
    let name = |kind: &str| format!("{}.{kind}", vector.name);
    let create = |kind: &str| Summed::create(&folder.join(name(kind)));
    let (mut frames, mut asked, mut decided) =
        (create("frames.csv")?, create("commands.csv")?, create("decisions.csv")?);
    let (mut header, mut binary) = (create("h")?, Binary::create(&folder.join(name("vec")), vector)?);
    frames.put(b"cycle,at_ms,id,length,data\n")?;
    let prefix = identifier(&vector.name);
    let mut cycles = String::new();
    header.put(b"/* Made by make-vectors; structures as in vectors.h. */\n#include \"vectors.h\"\n\n")?;
    header.put(format!("static const struct vector_frame {prefix}_frames[] = {{\n").as_bytes())?;
    let (mut cycle, mut before) = (0_usize, 0_usize);
    run(vector, |read, made| {
        let columns = decision(made);
        let digest = digest(&made.decision, &made.sent);
        binary.cycle(read, digest)?;
        for (at_ms, frame) in &read.frames {
            let (id, length) = (frame.id, frame.length);
            frames.put(format!("{cycle},{at_ms},{id:08X},{length},{}\n", data(frame)).as_bytes())?;
            let bytes = frame.data.map(|byte| byte.to_string()).join(",");
            header.put(format!("{{{at_ms}u,0x{id:08X}u,{{{bytes}}},{length}}},\n").as_bytes())?;
        }
        let first = cycle == 0;
        asked.put(row(first, "cycle,now_ms", cycle, read.now_ms, &commands(&made.commands), &[]).as_bytes())?;
        let rest = [("sent", made.sent.len().to_string()), ("digest", format!("{digest:016x}"))];
        decided.put(row(first, "cycle,now_ms", cycle, read.now_ms, &columns, &rest).as_bytes())?;
        // Writing to a String cannot fail.
        let _ = writeln!(cycles, "{{{}u,{before}u,{}u,0x{digest:016x}ull}},", read.now_ms, read.frames.len());
        (cycle, before) = (cycle + 1, before + read.frames.len());
        Ok::<(), VectorError>(())
    })?;
    header.put(format!("}};\nstatic const struct vector_cycle {prefix}_cycles[] = {{\n{cycles}}};\n").as_bytes())?;
    Ok(vec![
        (name("frames.csv"), frames.finish()?),
        (name("commands.csv"), asked.finish()?),
        (name("decisions.csv"), decided.finish()?),
        (name("h"), header.finish()?),
        (name("vec"), binary.0.finish()?),
    ])
}

/// A file packed as the logs are: the same bytes for the same content.
///
/// # Errors
/// None in practice: it writes to memory.
pub fn packed(bytes: &[u8]) -> io::Result<Vec<u8>> {
    let mut encoder = GzBuilder::new().mtime(0).operating_system(255).write(Vec::new(), Compression::best());
    encoder.write_all(bytes)?;
    encoder.finish()
}

/// The structures of the C arrays.
pub const STRUCTURES: &str = "\
/* Golden vectors of the bus safety supervisor as C arrays. Made by make-vectors. */
#ifndef VECTORS_H
#define VECTORS_H
#include <stdint.h>

/* A frame that comes in, and when. */
struct vector_frame {
    uint32_t at_ms;
    uint32_t id;
    uint8_t data[8];
    uint8_t length;
};

/* A step: its time, which frames came before it, and the digest of what it decided and sent. */
struct vector_cycle {
    uint32_t now_ms;
    uint32_t first_frame;
    uint32_t frames;
    uint64_t digest;
};

#endif
";

/// Every vector: the boundary set and the shipped drives, as their logs have them.
///
/// # Errors
/// A log cannot be read.
pub fn vectors() -> io::Result<Vec<Vector>> {
    let mut all = super::boundary::all();
    for scenario in crate::catalogue::ALL {
        let log = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("drives/{}.candump.gz", scenario.name));
        let frames = crate::candump::unpacked(&std::fs::read(log)?)?;
        all.push(Vector::of_drive(scenario.name, &frames, scenario.length_ms));
    }
    Ok(all)
}

/// Writes the files of every vector into the folder; each name with its SHA-256, in the order of the names.
///
/// # Errors
/// A log cannot be read, a file cannot be written.
pub fn all(folder: &Path, told: &mut impl FnMut(&str, usize)) -> Result<Vec<(String, String)>, VectorError> {
    std::fs::write(folder.join("vectors.h"), STRUCTURES)?;
    let mut sums = vec![("vectors.h".to_owned(), format!("{:x}", Sha256::digest(STRUCTURES)))];
    for vector in vectors()? {
        sums.extend(write(folder, &vector)?);
        told(&vector.name, vector.cycles.len());
    }
    sums.sort();
    Ok(sums)
}

/// What is kept in the repository: frames and decisions of the boundary set, packed, and the SHA-256 of every file.
///
/// # Errors
/// A file cannot be read.
pub fn keep(folder: &Path, sums: &[(String, String)]) -> io::Result<Vec<(String, Vec<u8>)>> {
    let mut kept = Vec::new();
    for kind in ["frames.csv", "decisions.csv"] {
        let mut together = Vec::new();
        for (name, _) in sums.iter().filter(|(name, _)| name.starts_with("boundary-") && name.ends_with(kind)) {
            together.extend_from_slice(format!("# {name}\n").as_bytes());
            together.extend(std::fs::read(folder.join(name))?);
        }
        kept.push((format!("boundary.{kind}.gz"), packed(&together)?));
    }
    let lines: Vec<String> = sums.iter().map(|(name, sum)| format!("{sum}  {name}\n")).collect();
    kept.push(("SHA256SUMS".to_owned(), lines.concat().into_bytes()));
    Ok(kept)
}
