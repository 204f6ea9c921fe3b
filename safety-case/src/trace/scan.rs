//! Walks the sources and gathers the tags.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use super::TraceError;
use super::id::{Id, Listed, head, in_parentheses, named};
use super::rust::{self, File, Form, Item, Passage};
use serde::Serialize;

/// What a tag says about the item that carries it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    /// It implements the requirement.
    Code,
    /// It is a number of the table of limits that the requirement sets.
    Limit,
    /// It states the requirement as a property.
    Property,
    /// It tests it.
    Test,
    /// It is a step of `.ci/run` that checks it.
    Check,
}

/// A place in the sources.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
pub struct Place {
    /// The file, from the root, with `/`.
    pub file: String,
    /// The line, from 1.
    pub line: usize,
    /// The item.
    pub item: String,
}

/// An id that an item carries.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Tag {
    /// What it says.
    pub kind: Kind,
    /// The id.
    pub id: Id,
    /// Where.
    pub place: Place,
}

/// A test function.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Test {
    /// Where.
    pub place: Place,
    /// Its doc comment begins with an id.
    pub tagged: bool,
    /// It stands where every test needs a tag.
    pub needs_tag: bool,
}

/// Everything that was found.
#[derive(Debug, Default)]
pub struct Scan {
    /// How many files were read.
    pub files: usize,
    /// The tags.
    pub tags: Vec<Tag>,
    /// The tests.
    pub tests: Vec<Test>,
    /// Everything that has the form of an id, wherever it stands.
    pub mentions: Vec<(String, Place)>,
    /// Ranges that are none.
    pub broken: Vec<(String, Place)>,
    /// The functions that Kani runs.
    pub harnesses: Vec<Place>,
}

/// The folders that are read.
const FOLDERS: [&str; 5] = ["supervisor", "proofs", "tests", "fuzz", "safety-case"];
const SCRIPT: &str = ".ci/run";

/// What the items of a file are for.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Role {
    /// Code that is shipped.
    Shipped,
    /// The properties.
    Properties,
    /// The harnesses.
    Harnesses,
    /// Tests of the requirements.
    Tests,
    /// All the rest: tests may carry tags, what else is named there must exist and counts for nothing.
    Other,
}

fn role(file: &str) -> Role {
    let shipped = file.starts_with("supervisor/");
    match file {
        "proofs/src/properties.rs" => Role::Properties,
        _ if file.starts_with("proofs/src/properties/") => Role::Properties,
        _ if file.starts_with("proofs/src/harness/") => Role::Harnesses,
        _ if file.starts_with("tests/tests/") || (shipped && file.contains("/tests/")) => Role::Tests,
        _ if shipped && (file.starts_with("supervisor/src/") || file.contains("/src/")) => Role::Shipped,
        _ => Role::Other,
    }
}

/// Reads all sources below the root.
///
/// # Errors
/// A file cannot be read or is no Rust.
pub fn scan(root: &Path) -> Result<Scan, TraceError> {
    let mut files = Vec::new();
    for folder in FOLDERS {
        collect(&root.join(folder), &mut files)?;
    }
    files.sort();
    let mut scan = Scan::default();
    for path in files {
        let name = path.strip_prefix(root).unwrap_or(&path).to_string_lossy().replace('\\', "/");
        let text = read(&path)?;
        let file = rust::read(&text).map_err(|error| TraceError::Rust {
            place: format!("{name}:{}", error.span().start().line),
            message: error.to_string(),
        })?;
        scan.files += 1;
        scan.file(&name, &file);
    }
    let script = root.join(SCRIPT);
    if script.exists() {
        scan.script(&read(&script)?);
    }
    Ok(scan)
}

fn read(path: &Path) -> Result<String, TraceError> {
    fs::read_to_string(path).map_err(|error| TraceError::File { path: path.to_owned(), error })
}

/// Every Rust file of a folder that is there; not what cargo builds.
fn collect(folder: &Path, files: &mut Vec<PathBuf>) -> Result<(), TraceError> {
    let failed = |error: io::Error| TraceError::File { path: folder.to_owned(), error };
    let entries = match fs::read_dir(folder) {
        Ok(entries) => entries,
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(()),
        Err(error) => return Err(failed(error)),
    };
    for entry in entries {
        let path = entry.map_err(failed)?.path();
        if path.is_dir() && !path.ends_with("target") {
            collect(&path, files)?;
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            files.push(path);
        }
    }
    Ok(())
}

impl Scan {
    fn file(&mut self, name: &str, file: &File) {
        let role = role(name);
        let at = |item: Option<&Item>, line| {
            // The macro around a part of its input says nothing to a reader.
            let whole = item.map_or("(file)", |item| item.name.as_str());
            let part = whole.rsplit("!::").next().unwrap_or(whole);
            Place { file: name.to_owned(), line, item: part.to_owned() }
        };
        for item in file.items.iter().filter(|item| item.test) {
            let needs_tag = role == Role::Tests || name.starts_with("tests/");
            self.tests.push(Test { place: at(Some(item), item.line), tagged: false, needs_tag });
        }
        if role == Role::Harnesses {
            let functions = file.items.iter().filter(|item| item.function);
            self.harnesses.extend(functions.map(|item| at(Some(item), item.line)));
        }
        for passage in &file.passages {
            let item = passage.item.and_then(|index| file.items.get(index));
            self.mention(role, passage, &at(item, passage.line));
            let Some(item) = item else { continue };
            let (kind, listed) = tags(role, item, passage);
            let Some(kind) = kind else { continue };
            let place = at(Some(item), item.line);
            self.broken.extend(listed.broken.into_iter().map(|range| (range, at(Some(item), passage.line))));
            if kind == Kind::Test && !listed.ids.is_empty() {
                self.tests.iter_mut().filter(|test| test.place == place).for_each(|test| test.tagged = true);
            }
            // In a function the line of the comment says where; else that of the item.
            let line = if item.function && kind == Kind::Code { passage.line } else { item.line };
            self.tags.extend(listed.ids.into_iter().map(|id| Tag { kind, id, place: Place { line, ..place.clone() } }));
        }
    }

    /// What is named must exist: in every comment, and in the literals of what is shipped and of its tests.
    fn mention(&mut self, role: Role, passage: &Passage, place: &Place) {
        if passage.form == Form::Literal && role == Role::Other {
            return;
        }
        for (at, id) in named(&passage.text) {
            let lines = passage.text.get(..at).map_or(0, |before| before.matches('\n').count());
            self.mentions.push((id.to_owned(), Place { line: place.line + lines, ..place.clone() }));
        }
    }

    /// A comment below `step "name"` that begins with an id says that the step checks it.
    fn script(&mut self, text: &str) {
        let mut step = None;
        for (line, words) in (1..).zip(text.lines().map(str::trim)) {
            if let Some(name) = words.strip_prefix("step \"").and_then(|rest| rest.split('"').next()) {
                step = Some(name);
            }
            let Some(comment) = words.strip_prefix('#') else { continue };
            let place = Place { file: SCRIPT.to_owned(), line, item: step.unwrap_or("(file)").to_owned() };
            self.mentions.extend(named(comment).into_iter().map(|(_, id)| (id.to_owned(), place.clone())));
            let listed = head(comment);
            self.broken.extend(listed.broken.into_iter().map(|range| (range, place.clone())));
            if step.is_some() {
                let tag = |id| Tag { kind: Kind::Check, id, place: place.clone() };
                self.tags.extend(listed.ids.into_iter().map(tag));
            }
        }
    }
}

/// The ids that the paragraphs of a comment begin with.
fn heads(text: &str) -> Listed {
    let mut all = Listed::default();
    for listed in text.split("\n\n").map(head) {
        all.ids.extend(listed.ids);
        all.broken.extend(listed.broken);
    }
    all
}

/// The tags in a passage, and of what kind they are.
///
/// In functions and constants of the code a tag begins a comment, or a paragraph of one, or stands in parentheses; in
/// tests and properties it begins the doc comment or a paragraph of it. Types, fields and variants declare and implement
/// nothing: what they name is a mention.
fn tags(role: Role, item: &Item, passage: &Passage) -> (Option<Kind>, Listed) {
    let nothing = (None, Listed::default());
    if passage.form == Form::Literal {
        let id = Id::parse(&passage.text).filter(|_| role == Role::Shipped && item.name.starts_with("limits!::"));
        return id.map_or(nothing, |id| (Some(Kind::Limit), Listed { ids: vec![id], broken: Vec::new() }));
    }
    if item.test && passage.form == Form::Doc {
        return (Some(Kind::Test), heads(&passage.text));
    }
    match role {
        Role::Properties if item.function && passage.form == Form::Doc => (Some(Kind::Property), heads(&passage.text)),
        Role::Shipped if (item.function || item.constant) && !item.for_tests && !item.test => {
            let mut listed = heads(&passage.text);
            let inside = in_parentheses(&passage.text);
            listed.ids.extend(inside.ids.into_iter().filter(|id| !listed.ids.contains(id)).collect::<Vec<_>>());
            listed.broken.extend(inside.broken);
            (Some(Kind::Code), listed)
        }
        Role::Shipped | Role::Properties | Role::Harnesses | Role::Tests | Role::Other => nothing,
    }
}
