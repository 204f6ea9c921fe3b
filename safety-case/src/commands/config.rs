//! `supervise config`: sealed configurations.

use std::path::Path;

use supervisor::{Config, LIMITS, Limit, Sealed, Words};

use super::limits::{defaults, list};
use super::{Outcome, print};
use crate::cli::ConfigCommand;

/// What is wrong with a configuration, and in which file.
#[derive(Debug, thiserror::Error)]
#[error("{file}{}: {reason}", line.map(|line| format!(":{line}")).unwrap_or_default())]
pub struct ConfigFailure {
    file: String,
    line: Option<usize>,
    reason: String,
}

/// Runs it.
///
/// # Errors
/// If a file cannot be read or written, or a value is bad; the field is named.
pub fn run(command: &ConfigCommand) -> Outcome {
    match command {
        ConfigCommand::Seal { input, output } => {
            let sealed = seal(input)?;
            std::fs::write(output, sealed.to_bytes()).map_err(|error| failure(output, None, error.to_string()))?;
            print(format!("{}{} bytes sealed in {}\n", changes(&sealed), supervisor::SEALED_BYTES, output.display()))?;
        }
        ConfigCommand::Show { file } => {
            print(show(&read_or_default(file.as_deref())?))?;
        }
    }
    Ok(0)
}

fn failure(file: &Path, line: Option<usize>, reason: String) -> ConfigFailure {
    ConfigFailure { file: file.display().to_string(), line, reason }
}

/// Reads sealed bytes.
///
/// # Errors
/// If the file cannot be read, or is no sealed configuration.
pub(super) fn read(file: &Path) -> Result<Sealed, ConfigFailure> {
    let bytes = std::fs::read(file).map_err(|error| failure(file, None, error.to_string()))?;
    Sealed::from_sealed(&bytes).map_err(|error| failure(file, None, error.to_string()))
}

/// Reads sealed bytes; without a file, the defaults.
pub(super) fn read_or_default(file: Option<&Path>) -> Result<Sealed, Box<dyn std::error::Error>> {
    Ok(match file {
        Some(file) => read(file)?,
        None => Sealed::from_default()?,
    })
}

/// The words of a configuration, in the order of the table.
fn words(config: &Config) -> Vec<u32> {
    let mut words = Vec::new();
    config.write(&mut |word| words.push(word));
    words
}

/// Words of signed fields rest as two's complement in the low half; every range so far begins at zero or above.
fn word(value: i64) -> Option<u32> {
    u32::try_from(value).ok().or_else(|| i16::try_from(value).ok().map(|value| u32::from(value.cast_unsigned())))
}

fn number(word: u32, limit: &Limit) -> i64 {
    match u16::try_from(word) {
        Ok(half) if limit.least < 0 => i64::from(half.cast_signed()),
        _ => i64::from(word),
    }
}

/// Puts the values of a TOML file over the defaults.
fn seal(file: &Path) -> Result<Sealed, ConfigFailure> {
    let text = std::fs::read_to_string(file).map_err(|error| failure(file, None, error.to_string()))?;
    let line = |at: usize| Some(text.bytes().take(at).filter(|byte| *byte == b'\n').count() + 1);
    let table: std::collections::BTreeMap<toml::Spanned<String>, toml::Spanned<toml::Value>> = toml::from_str(&text)
        .map_err(|error| failure(file, error.span().and_then(|span| line(span.start)), error.message().to_owned()))?;
    let mut words = words(&Config::DEFAULT);
    for (name, value) in &table {
        let bad = |reason: String| failure(file, line(value.span().start), format!("`{}`: {reason}", name.get_ref()));
        let mut at = 0;
        let limit = LIMITS.iter().find(|limit| {
            let found = limit.name == name.get_ref();
            at += if found { 0 } else { limit.count };
            found
        });
        let limit = limit.ok_or_else(|| bad("is not in the table of limits (see `supervise limits`)".to_owned()))?;
        let values: Option<Vec<i64>> = match value.get_ref() {
            toml::Value::Integer(value) => Some(vec![*value]),
            toml::Value::Array(values) => values.iter().map(toml::Value::as_integer).collect(),
            toml::Value::String(_)
            | toml::Value::Float(_)
            | toml::Value::Boolean(_)
            | toml::Value::Datetime(_)
            | toml::Value::Table(_) => None,
        };
        let values = values.filter(|values| values.len() == limit.count).ok_or_else(|| {
            let shape =
                if limit.count == 1 { "one whole number".to_owned() } else { format!("{} whole numbers", limit.count) };
            bad(format!("takes {shape} in {}", limit.unit))
        })?;
        for (value, slot) in values.iter().zip(words.iter_mut().skip(at)) {
            let range = limit.least..=limit.greatest;
            let word = word(*value).filter(|_| range.contains(value));
            *slot = word
                .ok_or_else(|| bad(format!("{value} is not in {}..{}, {}", limit.least, limit.greatest, limit.unit)))?;
        }
    }
    let mut source = words.into_iter();
    let config = Config::read(&mut || source.next());
    let config = config.ok_or_else(|| failure(file, None, "a value has no place in its field".to_owned()))?;
    Sealed::new(config).map_err(|error| failure(file, None, error.to_string()))
}

/// Every field with its values: name, values, whether they differ from the defaults.
fn fields(sealed: &Sealed) -> Vec<(&'static Limit, Vec<i64>, bool)> {
    let Some(config) = sealed.intact() else { return Vec::new() };
    let mut words = words(config).into_iter();
    LIMITS
        .iter()
        .map(|limit| {
            let values: Vec<i64> = words.by_ref().take(limit.count).map(|word| number(word, limit)).collect();
            let differs = values != defaults(limit);
            (limit, values, differs)
        })
        .collect()
}

fn changes(sealed: &Sealed) -> String {
    let changed = fields(sealed).into_iter().filter(|(.., differs)| *differs);
    let lines = changed.map(|(limit, values, _)| {
        format!("{} = {} {} (default {})\n", limit.name, list(&values), limit.unit, list(&defaults(limit)))
    });
    lines.collect::<Vec<_>>().concat()
}

fn show(sealed: &Sealed) -> String {
    let line = |(limit, values, differs): &(&Limit, Vec<i64>, bool)| {
        let mark = if *differs { '*' } else { ' ' };
        let was = if *differs { format!("  (default {})", list(&defaults(limit))) } else { String::new() };
        format!("{mark} {:<24} {} {}{was}\n", limit.name, list(values), limit.unit)
    };
    fields(sealed).iter().map(line).collect()
}
