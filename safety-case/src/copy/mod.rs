//! A copy of the workspace, in which sources are changed: the sources themselves are never touched.

mod programs;

pub use programs::{Message, Program, Said, Span, cargo, errors, programs};

use std::collections::{BTreeMap, BTreeSet, HashSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use crate::error::{ToolError, file as failed, form, read};
use crate::mistakes::Change;

/// What the proofs are built from. Members of the workspace outside of it are left out of the copy's manifest.
const FOLDERS: [&str; 2] = ["supervisor", "proofs"];
/// What the tests of the step are built from; they read the corpus of the fuzzers.
pub const WITH_TESTS: [&str; 4] = ["supervisor", "proofs", "tests", "fuzz"];
/// What in there is none of it: workspaces of their own, builds, and recorded results.
const OTHERS: [&str; 3] = ["creusot", "target", "results"];

/// A copy of the workspace.
#[derive(Clone, Debug)]
pub struct Copy {
    folders: &'static [&'static str],
    original: PathBuf,
    root: PathBuf,
    target: PathBuf,
}

impl Copy {
    /// A copy in this folder, which need not exist; what is built of it goes beside it.
    ///
    /// # Errors
    /// It cannot be written.
    pub fn new(original: &Path, folder: &Path) -> Result<Self, ToolError> {
        let copy = Self::of(&FOLDERS, original, folder)?;
        copy.restore()?;
        Ok(copy)
    }

    /// A copy of these folders, in which nothing stands yet.
    ///
    /// # Errors
    /// The folder for what is built cannot be made.
    pub fn of(folders: &'static [&'static str], original: &Path, folder: &Path) -> Result<Self, ToolError> {
        let (root, target) = (folder.join("copy"), folder.join("build"));
        fs::create_dir_all(&target).map_err(|error| failed(&target, error))?;
        Ok(Self { folders, original: original.to_owned(), root, target })
    }

    /// The root of the copied workspace.
    #[must_use]
    pub fn root(&self) -> &Path {
        &self.root
    }
    /// Where it is built.
    #[must_use]
    pub fn target(&self) -> &Path {
        &self.target
    }

    /// Makes the copy what the original is: whatever a mistake, or a run that was cut off, has left in it.
    ///
    /// A file that is as it must be is left alone, so that it is not built again.
    ///
    /// # Errors
    /// A file cannot be read or written.
    pub fn restore(&self) -> Result<(), ToolError> {
        self.restore_with(&BTreeMap::new())
    }

    /// The same, but for these files, which are changed or new; the manifest takes their first folders in as members, too.
    ///
    /// # Errors
    /// A file cannot be read or written.
    pub fn restore_with(&self, changed: &BTreeMap<PathBuf, String>) -> Result<(), ToolError> {
        let mut wanted = HashSet::new();
        for (file, text) in changed {
            self.put(file, text.as_bytes())?;
            wanted.insert(self.root.join(file));
        }
        for folder in self.folders {
            self.take(Path::new(folder), changed, &mut wanted)?;
        }
        for file in ["Cargo.lock", "clippy.toml"] {
            let path = self.original.join(file);
            let text = fs::read(&path).map_err(|error| failed(&path, error))?;
            self.put(Path::new(file), &text)?;
        }
        let new = changed.keys().filter_map(|file| file.iter().next()?.to_str());
        let new: BTreeSet<&str> = new.filter(|folder| !self.folders.contains(folder)).collect();
        self.put(Path::new("Cargo.toml"), self.manifest(&new)?.as_bytes())?;
        for folder in self.folders {
            sweep(&self.root.join(folder), &wanted)?;
        }
        Ok(())
    }

    /// Restores the copy and plants one mistake.
    ///
    /// # Errors
    /// A file cannot be read or written.
    pub fn plant(&self, change: &Change) -> Result<(), ToolError> {
        self.restore()?;
        self.put(Path::new(&change.file), change.text.as_bytes())
    }

    /// Whether the copy compiles; if not, what the compiler says.
    ///
    /// # Errors
    /// cargo does not start.
    pub fn compiles(&self, package: &str) -> Result<Result<(), String>, ToolError> {
        let mut command = Command::new("cargo");
        command.current_dir(&self.root).args(["check", "--quiet", "--lib", "-p", package, "--target-dir"]);
        command.arg(self.target.join("check")).stdin(Stdio::null());
        let done = command.output().map_err(ToolError::start("cargo"))?;
        let said = String::from_utf8_lossy(&done.stderr);
        let first = said.lines().find(|line| line.starts_with("error")).unwrap_or("error without a word");
        Ok(if done.status.success() { Ok(()) } else { Err(first.to_owned()) })
    }

    fn put(&self, file: &Path, text: &[u8]) -> Result<(), ToolError> {
        let path = self.root.join(file);
        if fs::read(&path).is_ok_and(|present| present == text) {
            return Ok(());
        }
        let folder = path.parent().map_or(Ok(()), fs::create_dir_all);
        folder.and_then(|()| fs::write(&path, text)).map_err(|error| failed(&path, error))
    }

    fn take(
        &self,
        folder: &Path,
        changed: &BTreeMap<PathBuf, String>,
        wanted: &mut HashSet<PathBuf>,
    ) -> Result<(), ToolError> {
        let from = self.original.join(folder);
        for entry in fs::read_dir(&from).map_err(|error| failed(&from, error))? {
            let entry = entry.map_err(|error| failed(&from, error))?;
            let (name, path) = (folder.join(entry.file_name()), entry.path());
            if path.is_dir() {
                if !OTHERS.iter().any(|other| entry.file_name() == *other) {
                    self.take(&name, changed, wanted)?;
                }
            } else if !changed.contains_key(&name) {
                let text = fs::read(&path).map_err(|error| failed(&path, error))?;
                self.put(&name, &text)?;
                wanted.insert(self.root.join(name));
            }
        }
        Ok(())
    }

    /// The manifest of the workspace with the members that are copied.
    fn manifest(&self, new: &BTreeSet<&str>) -> Result<String, ToolError> {
        let path = self.original.join("Cargo.toml");
        let mut manifest = table(&path)?;
        let members = manifest.get_mut("workspace").and_then(|workspace| workspace.get_mut("members"));
        let members = members.and_then(toml::Value::as_array_mut).ok_or_else(|| form(&path, &"it has no members"))?;
        let copied = |member: &str| self.folders.iter().any(|folder| Path::new(member).starts_with(folder));
        members.retain(|member| member.as_str().is_some_and(copied));
        members.extend(new.iter().map(|folder| toml::Value::from(*folder)));
        toml::to_string(&manifest).map_err(|error| form(&path, &error))
    }
}

fn table(path: &Path) -> Result<toml::Table, ToolError> {
    read(path)?.parse().map_err(|error: toml::de::Error| form(path, &error))
}

/// The manifest of a package two folders below the root, with a dependency on a package that stands right there.
///
/// # Errors
/// It cannot be read, or is no manifest.
pub fn with_dependency(root: &Path, package: &str, on: &str) -> Result<(PathBuf, String), ToolError> {
    let file = Path::new(package).join("Cargo.toml");
    let path = root.join(&file);
    let mut manifest = table(&path)?;
    let needs = manifest.entry("dependencies").or_insert_with(|| toml::Value::Table(toml::Table::new()));
    let place = toml::Table::from_iter([("path".to_owned(), toml::Value::from(format!("../../{on}")))]);
    if let Some(needs) = needs.as_table_mut() {
        needs.insert(on.to_owned(), toml::Value::Table(place));
    }
    Ok((file, toml::to_string(&manifest).map_err(|error| form(&path, &error))?))
}

/// Removes what is no longer in the original.
fn sweep(folder: &Path, wanted: &HashSet<PathBuf>) -> Result<(), ToolError> {
    for entry in fs::read_dir(folder).map_err(|error| failed(folder, error))? {
        let path = entry.map_err(|error| failed(folder, error))?.path();
        if path.is_dir() {
            sweep(&path, wanted)?;
        } else if !wanted.contains(&path) {
            fs::remove_file(&path).map_err(|error| failed(&path, error))?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use std::fs;
    use std::path::Path;

    use super::Copy;
    use crate::mistakes::Change;

    fn write(root: &Path, file: &str, text: &str) {
        let path = root.join(file);
        let folder = path.parent().map_or(Ok(()), fs::create_dir_all);
        let done = folder.and_then(|()| fs::write(&path, text));
        assert!(done.is_ok(), "{done:?}");
    }

    fn read(root: &Path, file: &str) -> String {
        fs::read_to_string(root.join(file)).unwrap_or_default()
    }

    #[test]
    fn a_mistake_stands_in_the_copy_alone_and_goes_again() {
        let Ok(folder) = tempfile::tempdir() else { unreachable!("there is a temporary folder") };
        let original = folder.path().join("original");
        let manifest = "[workspace]\nmembers = [\"supervisor\", \"supervisor/core\", \"proofs\", \"tests\"]\n";
        let source = "fn less() {}\n";
        for (file, text) in [
            ("Cargo.toml", manifest),
            ("Cargo.lock", ""),
            ("clippy.toml", ""),
            ("supervisor/core/src/lib.rs", source),
            ("proofs/src/lib.rs", source),
            ("proofs/creusot/src/lib.rs", source),
            ("tests/src/lib.rs", source),
        ] {
            write(&original, file, text);
        }
        let Ok(copy) = Copy::new(&original, &folder.path().join("worker")) else { unreachable!("it can be written") };
        assert_eq!(read(copy.root(), "supervisor/core/src/lib.rs"), source);
        assert!(!copy.root().join("proofs/creusot").exists() && !copy.root().join("tests").exists());
        let text = read(copy.root(), "Cargo.toml");
        assert!(text.contains("\"proofs\"") && !text.contains("\"tests\""), "{text}");

        let change = Change { file: "supervisor/core/src/lib.rs".to_owned(), text: "fn more() {}\n".to_owned() };
        assert!(copy.plant(&change).is_ok());
        assert_eq!(read(copy.root(), "supervisor/core/src/lib.rs"), "fn more() {}\n");
        assert_eq!(read(&original, "supervisor/core/src/lib.rs"), source);

        write(copy.root(), "proofs/src/left.rs", source);
        let other = Change { file: "proofs/src/lib.rs".to_owned(), text: "fn other() {}\n".to_owned() };
        assert!(copy.plant(&other).is_ok());
        assert_eq!(read(copy.root(), "supervisor/core/src/lib.rs"), source, "one mistake at a time");
        assert!(!copy.root().join("proofs/src/left.rs").exists());
        assert!(copy.restore().is_ok());
        assert_eq!(read(copy.root(), "proofs/src/lib.rs"), source);
    }
}
