//! From a file to scenes. An error names the file and the key, and the line where there is one.

use std::fs;
use std::path::{Path, PathBuf};

use toml::{Table, Value};

use super::Scene;
use super::entry::{self, File, Other, What};
use super::happens;
use crate::disturb::Amount;
use crate::driver::{self, after_start};
use crate::number::{kmh, nearest};
use crate::plant::Parameters;
use crate::road::Body;
use crate::traffic::{Actor, Move, Place, Way};

/// What is wrong with a scenario.
#[derive(Debug, thiserror::Error)]
pub enum LoadError {
    /// The file cannot be read.
    #[error("{}: {error}", path.display())]
    File {
        /// Which.
        path: PathBuf,
        /// Why.
        error: std::io::Error,
    },
    /// It is no scenario.
    #[error("{file}:{line}: {key}: {what}")]
    Form {
        /// Name of the file.
        file: String,
        /// The line.
        line: usize,
        /// What stands there.
        key: String,
        /// What is wrong.
        what: String,
    },
    /// A value is none.
    #[error("{file}: {key}: {what}")]
    Value {
        /// Name of the file.
        file: String,
        /// The key.
        key: String,
        /// What is wrong.
        what: String,
    },
    /// There is no such scenario.
    #[error("no scenario is called {0}; --list shows them")]
    Unknown(String),
}

/// Ten seconds from key-on to a bus that is ready to go.
const START: driver::Script<'static> = after_start![];

/// Every scenario of a folder, in the order of the file names.
///
/// # Errors
/// If the folder or a file cannot be read, or a file is no scenario.
pub fn all(folder: &Path) -> Result<Vec<Scene>, LoadError> {
    let error = |error| LoadError::File { path: folder.to_owned(), error };
    let mut files = Vec::new();
    for entry in fs::read_dir(folder).map_err(error)? {
        let path = entry.map_err(error)?.path();
        if path.extension().is_some_and(|extension| extension == "toml") {
            files.push(path);
        }
    }
    files.sort();
    let scenes: Result<Vec<Vec<Scene>>, LoadError> = files.iter().map(|path| file(path)).collect();
    Ok(scenes?.into_iter().flatten().collect())
}

/// The variants of one file.
///
/// # Errors
/// If it cannot be read or is no scenario.
pub fn file(path: &Path) -> Result<Vec<Scene>, LoadError> {
    let text = fs::read_to_string(path).map_err(|error| LoadError::File { path: path.to_owned(), error })?;
    let part =
        |part: Option<&std::ffi::OsStr>| part.map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    parse(&part(path.file_name()), &part(path.file_stem()), &text)
}

/// The same from its text.
///
/// # Errors
/// If it is no scenario.
pub fn parse(file: &str, name: &str, text: &str) -> Result<Vec<Scene>, LoadError> {
    let whole: File = toml::from_str(text).map_err(|error| form(file, text, &error))?;
    let table: Table = toml::from_str(text).map_err(|error| form(file, text, &error))?;
    if whole.variant.is_empty() {
        return Ok(vec![scene(file, name, "", whole)?]);
    }
    let mut scenes = Vec::new();
    for variant in &whole.variant {
        let mut changed = Value::Table(table.clone());
        for (key, value) in &variant.set {
            let place = key.split('.').try_fold(&mut changed, |place, step| match place {
                Value::Table(table) => Some(table.entry(step).or_insert_with(|| Value::Table(Table::new()))),
                Value::Array(array) => step.parse::<usize>().ok().and_then(|number| array.get_mut(number)),
                Value::String(_) | Value::Integer(_) | Value::Float(_) | Value::Boolean(_) | Value::Datetime(_) => None,
            });
            *place
                .ok_or_else(|| bad(file, format!("variant {}: set {key}", variant.name), "nothing stands there"))? =
                value.clone();
        }
        let key = || format!("variant {}", variant.name);
        let changed: File = changed.try_into().map_err(|error: toml::de::Error| bad(file, key(), error.message()))?;
        scenes.push(scene(file, name, &variant.name, changed)?);
    }
    Ok(scenes)
}

/// The scenes that these names mean: of a scenario, of one variant, or a file of one's own.
///
/// # Errors
/// If there is no such scenario, or a file is none.
pub fn named(scenes: &[Scene], names: &[String]) -> Result<Vec<Scene>, LoadError> {
    let mut found = Vec::new();
    for name in names {
        let path = Path::new(name);
        let its: Vec<Scene> = if path.extension().is_some_and(|extension| extension == "toml") {
            file(path)?
        } else {
            scenes.iter().filter(|scene| scene.name == *name || scene.full_name() == *name).cloned().collect()
        };
        if its.is_empty() {
            return Err(LoadError::Unknown(name.clone()));
        }
        found.extend(its);
    }
    Ok(found)
}

fn form(file: &str, text: &str, error: &toml::de::Error) -> LoadError {
    let before = error.span().and_then(|span| text.get(..span.start)).unwrap_or_default();
    let line = before.matches('\n').count();
    let there = text.lines().nth(line).unwrap_or_default();
    let key = there.split('=').next().unwrap_or_default().trim().to_owned();
    LoadError::Form { file: file.to_owned(), line: line + 1, key, what: error.message().trim().to_owned() }
}

fn bad(file: &str, key: impl Into<String>, what: impl Into<String>) -> LoadError {
    LoadError::Value { file: file.to_owned(), key: key.into(), what: what.into() }
}

/// Seconds to milliseconds, in whole cycles.
pub(super) fn ms(seconds: f64) -> u32 {
    u32::try_from(nearest(seconds * 100.0).saturating_mul(10)).unwrap_or(0)
}

fn scene(file: &str, name: &str, variant: &str, entry: File) -> Result<Scene, LoadError> {
    if !(1.0..=3600.0).contains(&entry.length) {
        return Err(bad(file, "length", "is not between 1 and 3600 s"));
    }
    if entry.requirements.is_empty() {
        return Err(bad(file, "requirements", "names none"));
    }
    let mut acts: Vec<(u32, driver::Act)> = if entry.driver.starts { START.to_vec() } else { Vec::new() };
    for (number, act) in entry.driver.acts.iter().enumerate() {
        let key = || format!("driver.acts[{number}]");
        let done = act_of(act).ok_or_else(|| bad(file, key(), "a time and exactly one thing that is done"))?;
        if acts.last().is_some_and(|(last, _)| *last > ms(act.at)) {
            return Err(bad(file, format!("{}.at", key()), "is before the act above it"));
        }
        acts.push((ms(act.at), done));
    }
    let mut actors = Vec::new();
    for (number, other) in entry.other.iter().enumerate() {
        actors.push(actor_of(file, number, other)?);
    }
    entry.expect.check(&|key, name| {
        if happens::named(name).is_some() { Ok(()) } else { Err(bad(file, key, format!("nothing is called {name}"))) }
    })?;
    let bus = &entry.bus;
    let usual = Parameters::DEFAULT;
    let parameters = Parameters {
        mass_kg: bus.mass.unwrap_or(usual.mass_kg),
        brake_dead_s: bus.brake_dead.unwrap_or(usual.brake_dead_s),
        brake_lag_s: bus.brake_lag.unwrap_or(usual.brake_lag_s),
        grip: bus.grip.unwrap_or(usual.grip),
        power_told: true,
        ..usual
    };
    Ok(Scene {
        name: name.to_owned(),
        variant: variant.to_owned(),
        title: entry.title,
        description: entry.description,
        source: entry.source,
        requirements: entry.requirements,
        published: entry.published,
        length_ms: ms(entry.length),
        parameters,
        slope: (ms(bus.slope_from), bus.slope),
        acts,
        actors,
        disturbed: entry.disturbed.then_some(Amount::TYPICAL),
        expected: entry.expect,
    })
}

/// `None` if it is not exactly one.
fn act_of(act: &entry::Act) -> Option<driver::Act> {
    use driver::Act;
    let all = [
        act.sit.map(Act::Sit),
        act.accelerator.map(Act::Accelerator),
        act.brake.map(Act::Brake),
        act.hold.map(Act::Hold),
        act.selector.map(|selector| Act::Selector(selector.into())),
        act.key.map(|key| Act::Key(key.into())),
        act.epb.map(|switch| Act::EpbSwitch(switch.into())),
        act.cruise.map(Act::CruiseSwitch),
        act.set.map(Act::Set),
        act.wheel.map(Act::Wheel),
    ];
    let mut done = all.into_iter().flatten();
    done.next().filter(|_| done.next().is_none())
}

fn actor_of(file: &str, number: usize, other: &Other) -> Result<Actor, LoadError> {
    let key = |name: &str| format!("other[{number}].{name}");
    let place = match (other.at, other.gap) {
        (Some(place), None) => Place::At(place),
        (None, Some(gap)) => Place::Gap(gap),
        (None, None) | (Some(_), Some(_)) => return Err(bad(file, key("at"), "either at or gap")),
    };
    let mut moves = Vec::new();
    for (at, next) in other.moves.iter().enumerate() {
        let key = key(&format!("moves[{at}]"));
        let way = match (next.speed, next.offset) {
            (Some(speed), None) => Way::Speed(kmh(speed), next.by),
            (None, Some(offset)) => Way::Offset(offset, next.by),
            (None, None) | (Some(_), Some(_)) => return Err(bad(file, key, "either speed or offset")),
        };
        if next.by <= 0.0 {
            return Err(bad(file, format!("{key}.by"), "is not above 0"));
        }
        moves.push(Move { at_ms: ms(next.at), way });
    }
    let body = match other.what {
        What::Car => Body::CAR,
        What::Bus => Body::BUS,
        What::Pedestrian => Body::PEDESTRIAN,
        What::Cyclist => Body::CYCLIST,
    };
    Ok(Actor {
        body,
        place,
        from_ms: ms(other.from),
        until_ms: other.until.map_or(u32::MAX, ms),
        speed: kmh(other.speed),
        offset: other.offset,
        moves,
    })
}
