//! The copy with every mutant in it, and the test programs that are built of it.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use serde::Deserialize;
use walkdir::WalkDir;

use super::list::{PACKAGES, placed};
use super::switch::{CRATE, Mutant, Switched, switched};
use crate::mistakes::Listed;
use crate::prove::ProveError;

/// What is not copied: builds, history, and what no test reads.
const OTHERS: [&str; 5] = ["target", ".git", "results", "corpus", "artifacts"];
/// What is copied of the above all the same: tests replay it.
const CORPUS: &str = "fuzz/corpus";
/// So often is what the compiler refuses taken out.
const ROUNDS: usize = 60;

/// A built copy.
#[derive(Debug)]
pub struct Built {
    /// The mutants that are in it.
    pub inside: BTreeSet<u32>,
    /// Those that the compiler refuses as such.
    pub unviable: BTreeSet<u32>,
    /// Its test programs: name, program, folder to run it in.
    pub programs: Vec<(String, PathBuf, PathBuf)>,
}

fn file(path: &Path, error: std::io::Error) -> ProveError {
    ProveError::File { path: path.to_owned(), error }
}

fn put(path: &Path, bytes: &[u8]) -> Result<(), ProveError> {
    if fs::read(path).is_ok_and(|present| present == bytes) {
        return Ok(());
    }
    let folder = path.parent().map_or(Ok(()), fs::create_dir_all);
    folder.and_then(|()| fs::write(path, bytes)).map_err(|error| file(path, error))
}

/// Copies the workspace.
fn copied(root: &Path, copy: &Path) -> Result<(), ProveError> {
    let wanted = |entry: &walkdir::DirEntry| {
        let within = entry.path().strip_prefix(root).unwrap_or(entry.path());
        within.starts_with(CORPUS) || !OTHERS.iter().any(|other| entry.file_name() == *other)
    };
    for entry in WalkDir::new(root).into_iter().filter_entry(wanted) {
        let entry = entry.map_err(|error| ProveError::Arguments(error.to_string()))?;
        if entry.file_type().is_file() {
            let bytes = fs::read(entry.path()).map_err(|error| file(entry.path(), error))?;
            put(&copy.join(entry.path().strip_prefix(root).unwrap_or(entry.path())), &bytes)?;
        }
    }
    Ok(())
}

/// Adds the crate with the switch.
fn with_switch(copy: &Path) -> Result<(), ProveError> {
    let manifest = "[package]\nname = \"mutant_switch\"\nversion = \"0.0.0\"\nedition = \"2024\"\n";
    put(&copy.join("mutant_switch/Cargo.toml"), manifest.as_bytes())?;
    put(&copy.join("mutant_switch/src/lib.rs"), CRATE.as_bytes())?;
    for (_, folder) in PACKAGES {
        let path = copy.join(folder).join("Cargo.toml");
        let text = fs::read_to_string(&path).map_err(|error| file(&path, error))?;
        let form = |message: String| ProveError::Form { path: path.clone(), message };
        let mut table: toml::Table = text.parse().map_err(|error: toml::de::Error| form(error.to_string()))?;
        let dependencies = table.entry("dependencies").or_insert_with(|| toml::Table::new().into());
        let mut switch = toml::Table::new();
        switch.insert("path".to_owned(), "../../mutant_switch".into());
        dependencies.as_table_mut().map(|all| all.insert("mutant_switch".to_owned(), switch.into()));
        put(&path, toml::to_string(&table).map_err(|error| form(error.to_string()))?.as_bytes())?;
    }
    Ok(())
}

/// Every mutant by its file, with the file's text.
type Files = BTreeMap<String, (String, Vec<Mutant>)>;

fn files(root: &Path, all: &[(u32, Listed)]) -> Result<Files, ProveError> {
    let mut files = Files::new();
    for (number, listed) in all {
        if !files.contains_key(&listed.file) {
            let path = root.join(&listed.file);
            let text = fs::read_to_string(&path).map_err(|error| file(&path, error))?;
            files.insert(listed.file.clone(), (text, Vec::new()));
        }
        if let Some((text, mutants)) = files.get_mut(&listed.file) {
            mutants.extend(placed(*number, listed, text));
        }
    }
    Ok(files)
}

/// What the compiler says in one line of its JSON.
#[derive(Debug, Deserialize)]
struct Said {
    reason: String,
    message: Option<Message>,
    executable: Option<PathBuf>,
    manifest_path: Option<PathBuf>,
    target: Option<Target>,
}

#[derive(Debug, Deserialize)]
struct Target {
    name: String,
}

#[derive(Debug, Deserialize)]
struct Message {
    level: String,
    #[serde(rename = "message")]
    text: String,
    #[serde(default)]
    spans: Vec<Span>,
}

#[derive(Debug, Deserialize)]
struct Span {
    file_name: String,
    byte_start: usize,
}

fn cargo(copy: &Path, target: &Path, arguments: &[&str]) -> Result<(bool, Vec<Said>), ProveError> {
    let mut command = Command::new("cargo");
    command.current_dir(copy).args(arguments).args(["--message-format", "json"]).stdin(Stdio::null());
    command.env("CARGO_TARGET_DIR", target).env("RUSTFLAGS", "--cap-lints=allow").env_remove("MUTANT");
    for (name, value) in [("OPT_LEVEL", "1"), ("LTO", "off"), ("DEBUG", "0"), ("DEBUG_ASSERTIONS", "true")] {
        command.env(format!("CARGO_PROFILE_RELEASE_{name}"), value);
    }
    let done = command.stderr(Stdio::null()).output().map_err(ProveError::Tool)?;
    let said =
        String::from_utf8_lossy(&done.stdout).lines().filter_map(|line| serde_json::from_str(line).ok()).collect();
    Ok((done.status.success(), said))
}

/// The function that the compiler misses as a constant one: `c`, where it says that it cannot call the method `A::<B>::c`.
fn missed(message: &str) -> Option<String> {
    let called = message.strip_prefix("cannot call non-const")?.split('`').nth(1)?;
    called
        .rsplit("::")
        .find(|part| !part.starts_with('<') && !part.is_empty())
        .map(|name| name.chars().take_while(|character| character.is_alphanumeric() || *character == '_').collect())
}

/// Builds the copy: whatever the compiler refuses is taken out until it compiles.
///
/// # Errors
/// A file cannot be written, cargo does not start, or it does not compile for another reason.
pub fn built(
    root: &Path,
    folder: &Path,
    all: &[(u32, Listed)],
    say: &mut dyn FnMut(&str),
) -> Result<Built, ProveError> {
    let (copy, target) = (folder.join("copy"), folder.join("build"));
    copied(root, &copy)?;
    with_switch(&copy)?;
    let mut files = files(root, all)?;
    let (mut constant, mut unviable) = (BTreeSet::new(), BTreeSet::new());
    let mut check = vec!["check", "--release", "--keep-going", "--all-features", "-p", "supervisor-report"];
    check.extend(PACKAGES.iter().flat_map(|(package, _)| ["-p", package]));
    let with_tests = ["test", "--release", "--no-run", "-p", "supervisor-tests", "-p", "supervisor-proofs"];
    for round in 1..=ROUNDS {
        let mut texts: BTreeMap<&String, Switched> = BTreeMap::new();
        for (name, (text, mutants)) in &files {
            let form = |error: syn::Error| ProveError::Form { path: root.join(name), message: error.to_string() };
            let switched = switched(text, mutants, &constant).map_err(form)?;
            put(&copy.join(name), switched.text.as_bytes())?;
            unviable.extend(switched.unviable.iter().copied());
            texts.insert(name, switched);
        }
        let inside: BTreeSet<u32> = texts.values().flat_map(|switched| switched.inside.iter().copied()).collect();
        let (mut compiles, mut said) = cargo(&copy, &target, &check)?;
        if compiles {
            // What calls the crates may need a constant function, too.
            (compiles, said) = cargo(&copy, &target, &with_tests)?;
        }
        if compiles {
            say(&format!("{} of {} mutants are switched, {} do not compile", inside.len(), all.len(), unviable.len()));
            return Ok(Built { inside, unviable, programs: programs(&copy, said) });
        }
        let (before, mut unknown) = ((constant.len(), unviable.len()), String::new());
        for message in said.into_iter().filter_map(|said| said.message).filter(|message| message.level == "error") {
            let at = message.spans.iter().find_map(|span| {
                let (_, switched) = texts.iter().find(|(name, _)| span.file_name.ends_with(name.as_str()))?;
                switched.at(span.byte_start)
            });
            match (missed(&message.text), at) {
                (Some(name), _) => drop(constant.insert(name)),
                (None, Some(number)) => drop(unviable.insert(number)),
                (None, None) if !message.spans.is_empty() => {
                    unknown = format!("{}: {:?}", message.text, message.spans);
                }
                (None, None) => {}
            }
        }
        say(&format!("round {round}: {} do not compile, {} functions stay constant", unviable.len(), constant.len()));
        if (constant.len(), unviable.len()) == before {
            return Err(ProveError::Arguments(format!("the copy does not compile: {unknown}")));
        }
        for (_, mutants) in files.values_mut() {
            mutants.retain(|mutant| !unviable.contains(&mutant.number));
        }
    }
    Err(ProveError::Arguments(format!("the copy does not compile after {ROUNDS} rounds")))
}

fn programs(copy: &Path, said: Vec<Said>) -> Vec<(String, PathBuf, PathBuf)> {
    let mut programs = Vec::new();
    for said in said.into_iter().filter(|said| said.reason == "compiler-artifact") {
        if let (Some(program), Some(manifest), Some(target)) = (said.executable, said.manifest_path, said.target) {
            let folder = manifest.parent().unwrap_or(copy).to_owned();
            let package = folder.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
            programs.push((format!("{package}/{}", target.name), program, folder));
        }
    }
    programs
}

#[cfg(test)]
mod tests {
    use super::missed;

    #[test]
    fn the_function_that_is_missed_is_named() {
        for (message, name) in [
            ("cannot call non-const associated function `Timer::new` in constants", Some("new")),
            ("cannot call non-const method `Signal::<T>::known` in constant functions", Some("known")),
            ("cannot call non-const function `kernel::less` in statics", Some("less")),
            ("mismatched types", None),
        ] {
            assert_eq!(missed(message).as_deref(), name, "{message}");
        }
    }
}
