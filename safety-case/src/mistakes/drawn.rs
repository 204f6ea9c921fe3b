//! Mistakes drawn by a seed from the list that cargo-mutants makes.

use std::ops::Range;
use std::path::Path;
use std::process::{Command, Stdio};

use serde::Deserialize;
use sha2::{Digest, Sha256};

use super::change::{Change, source};
use crate::error::ToolError;
use crate::mutants::Genre;

/// A place in a file, both counted from 1.
#[derive(Clone, Copy, Debug, Deserialize)]
struct Place {
    line: usize,
    column: usize,
}

#[derive(Clone, Copy, Debug, Deserialize)]
struct Span {
    start: Place,
    end: Place,
}

/// One mutation as cargo-mutants lists it.
#[derive(Clone, Debug, Deserialize)]
pub struct Listed {
    /// File, place, and what is done, in words.
    pub name: String,
    /// The source file.
    pub file: String,
    /// The package of the file.
    pub package: String,
    replacement: String,
    genre: String,
    span: Span,
    function: Option<Function>,
}

#[derive(Clone, Debug, Deserialize)]
struct Function {
    function_name: String,
    span: Option<Span>,
}

impl Listed {
    /// The function that it stands in; empty outside of any.
    #[must_use]
    pub fn function(&self) -> &str {
        self.function.as_ref().map_or("", |function| &function.function_name)
    }

    /// What kind of mutation it is; nothing if cargo-mutants has a new one.
    #[must_use]
    pub fn genre(&self) -> Option<Genre> {
        match self.genre.as_str() {
            "FnValue" => Some(Genre::Body),
            "BinaryOperator" => Some(Genre::Binary),
            "UnaryOperator" => Some(Genre::Unary),
            "MatchArm" => Some(Genre::Arm),
            "MatchArmGuard" => Some(Genre::Guard),
            "StructField" => Some(Genre::Field),
            _ => None,
        }
    }

    /// What stands there instead.
    #[must_use]
    pub fn replacement(&self) -> &str {
        &self.replacement
    }

    /// Where it stands in the text of its file, in bytes.
    #[must_use]
    pub fn place(&self, text: &str) -> Option<Range<usize>> {
        Some(offset(text, self.span.start)?..offset(text, self.span.end)?)
    }

    /// Where the function stands that it is in, in bytes.
    #[must_use]
    pub fn extent(&self, text: &str) -> Option<Range<usize>> {
        let span = self.function.as_ref()?.span?;
        Some(offset(text, span.start)?..offset(text, span.end)?)
    }

    /// The file with the mistake in it.
    ///
    /// # Errors
    /// The file cannot be read; the mutation does not fit it, because the list was made of another text.
    pub fn change(&self, root: &Path) -> Result<Change, ToolError> {
        let text = source(root, &self.file)?;
        let at = |place: Place| offset(&text, place).unwrap_or(usize::MAX);
        Change::at(&self.file, &text, at(self.span.start), at(self.span.end), &self.replacement).map_err(|message| {
            ToolError::Form { path: root.join(&self.file), message: format!("{}: {message}", self.name) }
        })
    }
}

/// The byte at a place; columns count characters.
fn offset(text: &str, place: Place) -> Option<usize> {
    let line = text.split_inclusive('\n').nth(place.line.checked_sub(1)?)?;
    let before: usize = text.split_inclusive('\n').take(place.line.saturating_sub(1)).map(str::len).sum();
    let within = line.char_indices().nth(place.column.checked_sub(1)?).map_or(line.len(), |(byte, _)| byte);
    Some(before.saturating_add(within))
}

/// Whether cargo-mutants is there.
#[must_use]
pub fn available() -> bool {
    let mut command = Command::new("cargo");
    command.args(["mutants", "--version"]).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    command.status().is_ok_and(|status| status.success())
}

/// Every mutation of a package that cargo-mutants knows.
///
/// # Errors
/// It does not run, or its list is not understood.
pub fn listed(root: &Path, package: &str) -> Result<Vec<Listed>, ToolError> {
    let mut command = Command::new("cargo");
    command.current_dir(root).args(["mutants", "--list", "--json", "--no-shuffle", "--no-config", "-p", package]);
    let done = command.stdin(Stdio::null()).output().map_err(ToolError::start("cargo"))?;
    let bad = |message: String| ToolError::Form { path: "cargo mutants --list --json".into(), message };
    if !done.status.success() {
        return Err(bad(String::from_utf8_lossy(&done.stderr).into_owned()));
    }
    serde_json::from_slice(&done.stdout).map_err(|error| bad(error.to_string()))
}

/// All of them in the order in which this seed draws them.
///
/// The order is that of a digest of seed and name: the same everywhere, without a generator whose next version may
/// draw others.
#[must_use]
pub fn draw(mut all: Vec<Listed>, seed: u64) -> Vec<Listed> {
    all.sort_by_cached_key(|listed| {
        Sha256::new().chain_update(seed.to_le_bytes()).chain_update(&listed.name).finalize()
    });
    all
}

#[cfg(test)]
mod tests {
    use super::{Listed, Place, Span, draw, offset};

    fn listed(name: usize) -> Listed {
        let place = Place { line: 1, column: 1 };
        let span = Span { start: place, end: place };
        let (file, replacement, genre) = Default::default();
        Listed { name: name.to_string(), file, package: String::new(), replacement, genre, span, function: None }
    }

    fn names(seed: u64) -> Vec<String> {
        draw((0..50).map(listed).collect(), seed).into_iter().map(|listed| listed.name).collect()
    }

    #[test]
    fn a_seed_draws_the_same_always_and_another_draws_others() {
        assert_eq!(names(1), names(1));
        assert_ne!(names(1).first(), names(2).first());
        let mut all = names(1);
        all.sort_by_key(|name| name.parse::<usize>().unwrap_or(0));
        assert_eq!(all, (0..50).map(|name| name.to_string()).collect::<Vec<_>>(), "each once");
    }

    #[test]
    fn places_count_characters_from_one() {
        let text = "ab\n²c\n";
        let at = |line, column| offset(text, Place { line, column });
        assert_eq!((at(1, 1), at(1, 2), at(2, 1), at(2, 2)), (Some(0), Some(1), Some(3), Some(5)));
        assert_eq!((at(0, 1), at(1, 0), at(9, 1)), (None, None, None));
    }

    #[test]
    fn what_cargo_mutants_writes_is_understood() {
        let text = r#"[{"name": "f.rs:1:4: replace < with <= in g", "file": "f.rs", "replacement": "<=", "genre": "BinaryOperator",
            "package": "p", "function": null, "span": {"start": {"line": 1, "column": 4}, "end": {"line": 1, "column": 5}}}]"#;
        let Ok(all) = serde_json::from_str::<Vec<Listed>>(text) else { unreachable!("it is a list") };
        assert!(all.first().is_some_and(|listed| listed.span.end.column == 5 && listed.replacement == "<="));
    }
}
