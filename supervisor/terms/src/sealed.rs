//! Sealed configuration (SELF-4): bytes with a CRC, checked before anything runs, watched while it runs.

use crate::limits::Config;
use crate::word::Words;

/// "EBSC", little endian.
const MAGIC: u32 = 0x4353_4245;
/// Version of the layout: changes with every change of the table.
const VERSION: u32 = 2;
/// Words around the values: magic, version, count before; CRC after.
const FRAME_WORDS: usize = 4;
/// Length of a sealed configuration in bytes.
pub const SEALED_BYTES: usize = (<Config as Words>::COUNT + FRAME_WORDS) * 4;

/// Why sealed bytes were refused. The supervisor then does not start.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ConfigError {
    /// Not [`SEALED_BYTES`] long.
    Length(usize),
    /// Not a configuration, or one of another version.
    Header,
    /// The CRC does not match.
    Crc,
    /// A word is no value of its type.
    Word,
    /// A value outside its range: the field's name in the table.
    Range(&'static str),
    /// A relation between values that does not hold.
    Relation(&'static str),
}

impl core::fmt::Display for ConfigError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Length(length) => write!(f, "{length} bytes, expected {SEALED_BYTES}"),
            Self::Header => f.write_str("not a sealed configuration of this version"),
            Self::Crc => f.write_str("CRC does not match"),
            Self::Word => f.write_str("a word holds no value of its type"),
            Self::Range(field) => write!(f, "{field} is out of range"),
            Self::Relation(relation) => write!(f, "relation does not hold: {relation}"),
        }
    }
}

impl core::error::Error for ConfigError {}

/// A configuration that has passed every check, with a digest that shows a later change.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(kani, derive(kani::Arbitrary))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
pub struct Sealed {
    config: Config,
    digest: u32,
}

impl Sealed {
    /// The default configuration of the table.
    ///
    /// # Errors
    /// If the table contradicts itself; a test shows that it does not.
    pub fn from_default() -> Result<Self, ConfigError> {
        Self::new(Config::DEFAULT)
    }

    /// SELF-4b, c: checks ranges and relations.
    ///
    /// # Errors
    /// [`ConfigError::Range`] or [`ConfigError::Relation`] with the name.
    pub fn new(config: Config) -> Result<Self, ConfigError> {
        match (config.out_of_range(), config.broken_relation()) {
            (Some(field), _) => Err(ConfigError::Range(field)),
            (None, Some(relation)) => Err(ConfigError::Relation(relation)),
            (None, None) => Ok(Self { config, digest: digest(&config) }),
        }
    }

    /// SELF-4a, d: takes sealed bytes.
    ///
    /// # Errors
    /// The first check that fails, see [`ConfigError`].
    pub fn from_sealed(bytes: &[u8]) -> Result<Self, ConfigError> {
        if bytes.len() != SEALED_BYTES {
            return Err(ConfigError::Length(bytes.len()));
        }
        let (body, seal) = bytes.split_last_chunk::<4>().ok_or(ConfigError::Length(bytes.len()))?;
        let (chunks, _) = body.as_chunks::<4>();
        let mut words = chunks.iter().map(|chunk| u32::from_le_bytes(*chunk));
        let count = u32::try_from(<Config as Words>::COUNT).ok();
        if words.next() != Some(MAGIC) || words.next() != Some(VERSION) || words.next() != count {
            return Err(ConfigError::Header);
        }
        if u32::from_le_bytes(*seal) != crc32(body) {
            return Err(ConfigError::Crc);
        }
        Self::new(Config::read(&mut || words.next()).ok_or(ConfigError::Word)?)
    }

    /// Seals this configuration into bytes.
    #[must_use]
    pub fn to_bytes(&self) -> [u8; SEALED_BYTES] {
        let mut bytes = [0; SEALED_BYTES];
        let (chunks, _) = bytes.as_chunks_mut::<4>();
        let mut slots = chunks.iter_mut();
        let mut put = |word: u32| {
            if let Some(slot) = slots.next() {
                *slot = word.to_le_bytes();
            }
        };
        put(MAGIC);
        put(VERSION);
        put(u32::try_from(<Config as Words>::COUNT).unwrap_or(0));
        self.config.write(&mut put);
        let crc = bytes.split_last_chunk::<4>().map_or(0, |(body, _)| crc32(body));
        if let Some(seal) = bytes.last_chunk_mut::<4>() {
            *seal = crc.to_le_bytes();
        }
        bytes
    }

    /// The configuration, or `None` if it changed since it was checked.
    #[must_use]
    pub fn intact(&self) -> Option<&Config> {
        (digest(&self.config) == self.digest).then_some(&self.config)
    }

    /// The same with bit `bit` of value `index` (in the order of the table) flipped, the digest left as it was: fault
    /// injection in safe code. `None` if the value at rest has no such bit.
    #[must_use]
    pub fn with_flipped_bit(&self, index: usize, bit: u32) -> Option<Self> {
        let mut words = [0_u32; <Config as Words>::COUNT];
        let mut slots = words.iter_mut();
        self.config.write(&mut |word| {
            if let Some(slot) = slots.next() {
                *slot = word;
            }
        });
        *words.get_mut(index)? ^= 1_u32.checked_shl(bit)?;
        let mut words = words.into_iter();
        Some(Self { config: Config::read(&mut || words.next())?, digest: self.digest })
    }

    /// The same with bit `bit` of the digest flipped: fault injection in safe code.
    #[must_use]
    pub const fn with_flipped_digest(mut self, bit: u32) -> Self {
        self.digest ^= 1_u32.rotate_left(bit);
        self
    }
}

/// Changes with every single flipped bit: rotation and exclusive or are both bijective.
fn digest(config: &Config) -> u32 {
    let mut digest = !0_u32;
    config.write(&mut |word| digest = digest.rotate_left(5) ^ word);
    digest
}

/// CRC-32 (IEEE 802.3), bit by bit: it runs once, at start.
fn crc32(bytes: &[u8]) -> u32 {
    const POLYNOMIAL: u32 = 0xEDB8_8320;
    let mut crc = !0_u32;
    for byte in bytes {
        crc ^= u32::from(*byte);
        for _ in 0..8 {
            crc = (crc >> 1) ^ (POLYNOMIAL & (crc & 1).wrapping_neg());
        }
    }
    !crc
}
