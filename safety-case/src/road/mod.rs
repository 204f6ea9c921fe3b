//! The two roads from frames to inputs and commands: our own link, and a DBC with a mapping.

mod bind;
mod bits;
mod extract;
mod field;
mod mapped;
mod mapping;
mod value;

use std::path::Path;

use supervisor::wire::{Frame, Receiver, Refusal};
use supervisor::{Commands, Config, Inputs, Millis, Scene};

pub use mapped::Mapped;
pub use mapping::{Ids, MapError, Mapping};
pub use value::snake;

use crate::candump::LogFrame;
use mapping::Text;

/// The mapping that holds without `--map`.
const DEFAULT_MAP: &str = include_str!("../../maps/default.toml");
/// The DBC of our own link and of the standard J1939 frames.
const DEFAULT_DBC: &str = include_str!("../../../supervisor/wire/ebus.dbc");

/// What came of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// It was used; so many frames before it are missing by its counter.
    Taken(u8),
    /// Its identifier means nothing.
    Unknown,
    /// It was refused.
    Refused(Refused),
}

/// Why a frame was refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Refused {
    /// By our own link.
    Link(Refusal),
    /// By the mapping: too short for its signals.
    Short,
}

impl std::fmt::Display for Refused {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Link(refusal) => refusal.fmt(f),
            Self::Short => f.write_str("too short for the signals of the mapping"),
        }
    }
}

/// Frames in, inputs and commands out.
#[derive(Debug)]
pub struct Road {
    name: String,
    link: Option<Receiver>,
    mapped: Option<Mapped>,
    inputs: Inputs,
    scene: Scene,
    commands: Commands,
}

impl Road {
    /// Reads the mapping and the DBC: those given, or the ones that ship.
    ///
    /// # Errors
    /// If a file cannot be read, is not what it should be, or both do not fit each other.
    pub fn open(map: Option<&Path>, dbc: Option<&Path>, config: &Config) -> Result<Self, MapError> {
        let text = match map {
            Some(file) => Text::read(file)?,
            None => Text { file: "default.toml (built in)".into(), text: DEFAULT_MAP.to_owned() },
        };
        let mapping = mapping::parse(&text)?;
        let entries = mapping.input.len() + mapping.command.len() + mapping.radar.len() + mapping.camera.len();
        if !mapping.link && entries == 0 {
            return Err(
                text.error(None, "maps nothing: no `link = true`, no [[input]], [[command]], [[radar]] or [[camera]]")
            );
        }
        let beside = mapping.dbc.as_ref().map(|dbc| text.file.parent().unwrap_or(Path::new("")).join(dbc));
        let dbc = if let Some(file) = dbc.map(Path::to_owned).or(beside) {
            bind::dbc(&file)?
        } else {
            let text = Text { file: "ebus.dbc (built in)".into(), text: DEFAULT_DBC.to_owned() };
            (bind::dbc_text(&text)?, text.file)
        };
        let mapped = (entries > 0).then(|| bind::bind(&mapping, &text, &dbc, config)).transpose()?;
        let name = if mapping.name.is_empty() { text.file.display().to_string() } else { mapping.name };
        Ok(Self {
            name,
            link: mapping.link.then(|| Receiver::new(config)),
            mapped,
            inputs: Inputs::NEVER,
            scene: Scene::default(),
            commands: Commands::ABSENT,
        })
    }

    /// What a mapping and a DBC decode that are no files: errors call them `map.toml` and `bus.dbc`.
    ///
    /// # Errors
    /// As [`open`](Self::open).
    pub fn of_texts(map: String, dbc: String, config: &Config) -> Result<Mapped, MapError> {
        let map = Text { file: "map.toml".into(), text: map };
        let dbc = Text { file: "bus.dbc".into(), text: dbc };
        let mapping = mapping::parse(&map)?;
        let parsed = bind::dbc_text(&dbc)?;
        bind::bind(&mapping, &map, &(parsed, dbc.file), config)
    }

    /// What it decodes, for people.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Takes a frame.
    pub fn accept(&mut self, now: Millis, frame: &LogFrame) -> Outcome {
        let link = self
            .link
            .as_mut()
            .filter(|_| frame.extended)
            .map(|link| link.accept(now, &Frame { id: frame.id, length: frame.length, data: frame.data }));
        let mapped = self.mapped.as_mut().and_then(|mapped| mapped.accept(now, frame));
        match (mapped, link) {
            (Some(Ok(())), None | Some(Err(_))) => Outcome::Taken(0),
            (_, Some(Ok(accepted))) => Outcome::Taken(accepted.lost),
            (Some(Err(())), None | Some(Err(_))) => Outcome::Refused(Refused::Short),
            (None, Some(Err(refusal))) if refusal.message.is_some() => Outcome::Refused(Refused::Link(refusal)),
            (None, None | Some(Err(_))) => Outcome::Unknown,
        }
    }

    /// What is known and asked for now; to be called once per cycle.
    pub fn sample(&mut self, now: Millis) -> (&Inputs, &Scene, &Commands) {
        match (&mut self.link, &mut self.mapped) {
            (Some(link), None) => {
                let sample = link.sample(now);
                (sample.inputs, sample.scene, sample.commands)
            }
            (link, mapped) => {
                if let Some(link) = link {
                    let sample = link.sample(now);
                    self.inputs = *sample.inputs;
                    self.scene.clone_from(sample.scene);
                    self.commands = *sample.commands;
                }
                if let Some(mapped) = mapped {
                    mapped.sample(now, &mut self.inputs, &mut self.scene, &mut self.commands);
                }
                (&self.inputs, &self.scene, &self.commands)
            }
        }
    }
}
