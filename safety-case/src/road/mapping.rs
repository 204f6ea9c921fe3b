//! The mapping file: which signal of a DBC is which input or command. As written; [`super::bind`] checks it.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use serde::Deserialize;
use toml::Spanned;

/// What is wrong with a mapping or a DBC, and where.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}{}: {reason}", file.display(), line.map(|line| format!(":{line}")).unwrap_or_default())]
pub struct MapError {
    /// The file.
    pub file: PathBuf,
    /// The line, where it is known.
    pub line: Option<usize>,
    /// What is wrong.
    pub reason: String,
}

/// How identifiers of frames are compared with those of the DBC.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Ids {
    /// Every bit.
    #[default]
    Exact,
    /// The parameter group only; priority, source and destination do not count.
    J1939,
}

/// A mapping file.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Mapping {
    /// What it maps, for people.
    #[serde(default)]
    pub name: String,
    /// Our own link and the standard J1939 frames are decoded by the crate `supervisor-wire`.
    #[serde(default)]
    pub link: bool,
    /// The DBC, relative to this file; the option `--dbc` goes before it.
    pub dbc: Option<PathBuf>,
    /// How identifiers are compared.
    #[serde(default)]
    pub ids: Ids,
    /// Signals that are inputs.
    #[serde(default)]
    pub input: Vec<InputEntry>,
    /// Messages that are commands.
    #[serde(default)]
    pub command: Vec<CommandEntry>,
    /// Messages that carry an object of the radar.
    #[serde(default)]
    pub radar: Vec<ObjectEntry>,
    /// Messages that carry an object of the camera.
    #[serde(default)]
    pub camera: Vec<ObjectEntry>,
}

/// A signal of a DBC, and how its physical value becomes the field's.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SignalEntry {
    /// Its name in the DBC.
    pub signal: String,
    /// The physical value is multiplied by this,
    #[serde(default = "one")]
    pub factor: f64,
    /// then this is added: the field's unit.
    #[serde(default)]
    pub offset: f64,
    /// For yes/no and names: physical value, or range `a..b` with both ends, to name. Others are *not available*.
    pub values: Option<BTreeMap<String, String>>,
}

fn one() -> f64 {
    1.0
}

/// One input.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct InputEntry {
    /// The field of the supervisor's inputs.
    pub field: Spanned<String>,
    /// The message in the DBC.
    pub message: Spanned<String>,
    /// Only frames of this sender count (J1939 source address).
    pub source: Option<u8>,
    /// The signal, as in [`SignalEntry`].
    pub signal: Spanned<String>,
    /// As in [`SignalEntry`].
    #[serde(default = "one")]
    pub factor: f64,
    /// As in [`SignalEntry`].
    #[serde(default)]
    pub offset: f64,
    /// As in [`SignalEntry`].
    pub values: Option<BTreeMap<String, String>>,
    /// Older than this is stale.
    #[serde(default = "timeout")]
    pub timeout_ms: u32,
    /// How long it must be back after a gap before it counts; without it the configuration's.
    pub requalify_ms: Option<u32>,
}

fn timeout() -> u32 {
    250
}

/// One command.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CommandEntry {
    /// The channel.
    pub channel: Spanned<String>,
    /// The message in the DBC that carries all of it.
    pub message: Spanned<String>,
    /// Only frames of this sender count (J1939 source address).
    pub source: Option<u8>,
    /// Field by field: a signal as in [`SignalEntry`], or a constant. What is left out asks for nothing.
    pub fields: BTreeMap<String, Spanned<toml::Value>>,
}

/// One place of a sensor's object list.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ObjectEntry {
    /// The message in the DBC.
    pub message: Spanned<String>,
    /// Only frames of this sender count (J1939 source address).
    pub source: Option<u8>,
    /// Distance in metres.
    pub distance: Spanned<SignalEntry>,
    /// Lateral offset in metres, left positive; without it the object is straight ahead.
    pub offset: Option<Spanned<SignalEntry>>,
    /// Closing speed in m/s, positive while the gap shrinks.
    pub closing: Spanned<SignalEntry>,
    /// Class, of a camera's object: `unclassified`, `object`, `pedestrian`; without it `unclassified`.
    pub class: Option<Spanned<SignalEntry>>,
    /// Whether the place holds an object: `yes`, `no`; without it every frame does.
    pub present: Option<Spanned<SignalEntry>>,
}

/// Text of a file with its name, for errors that name the line.
#[derive(Debug)]
pub struct Text {
    /// The file.
    pub file: PathBuf,
    /// What it says.
    pub text: String,
}

impl Text {
    /// Reads a file; what is no UTF-8 is taken for Windows-1252, as DBC editors write it.
    ///
    /// # Errors
    /// If it cannot be read.
    pub fn read(file: &Path) -> Result<Self, MapError> {
        let bytes = std::fs::read(file).map_err(|error| MapError {
            file: file.to_owned(),
            line: None,
            reason: error.to_string(),
        })?;
        let text = String::from_utf8(bytes).unwrap_or_else(|error| {
            can_dbc::decode_cp1252(error.as_bytes())
                .map_or_else(|| String::from_utf8_lossy(error.as_bytes()).into_owned(), std::borrow::Cow::into_owned)
        });
        Ok(Self { file: file.to_owned(), text })
    }

    /// An error at this byte of the text.
    #[must_use]
    pub fn error(&self, at: Option<usize>, reason: impl Into<String>) -> MapError {
        let line = at.map(|at| self.text.bytes().take(at).filter(|byte| *byte == b'\n').count() + 1);
        MapError { file: self.file.clone(), line, reason: reason.into() }
    }
}

/// Reads a mapping.
///
/// # Errors
/// If it is no TOML, or a key is missing or unknown.
pub fn parse(text: &Text) -> Result<Mapping, MapError> {
    toml::from_str(&text.text).map_err(|error| text.error(error.span().map(|span| span.start), error.message()))
}

#[cfg(test)]
mod tests {
    use super::{Text, parse};

    fn error(text: &str) -> String {
        let text = Text { file: "a.toml".into(), text: text.to_owned() };
        parse(&text).map_or_else(|error| error.to_string(), |mapping| format!("{mapping:?}"))
    }

    #[test]
    fn errors_name_file_line_and_key() {
        assert!(
            error("link = true\nlnk = false\n").starts_with("a.toml:2: unknown field `lnk`"),
            "{}",
            error("link = true\nlnk = false\n")
        );
        assert!(error("\n\nlink = maybe\n").starts_with("a.toml:3: "));
        let missing = error("[[input]]\nfield = \"epb\"\nmessage = \"A\"\n");
        assert!(missing.starts_with("a.toml:1: missing field `signal`"), "{missing}");
    }
}
