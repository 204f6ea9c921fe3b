//! Builds a copy, and names the test programs that come of it.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use serde::Deserialize;

use super::Copy;
use crate::error::ToolError;

/// What cargo says in one line of its JSON.
#[derive(Clone, Debug, Deserialize)]
pub struct Said {
    message: Option<Message>,
    executable: Option<PathBuf>,
    manifest_path: Option<PathBuf>,
    target: Option<Target>,
    profile: Option<Profile>,
}

#[derive(Clone, Debug, Deserialize)]
struct Target {
    name: String,
}

#[derive(Clone, Copy, Debug, Deserialize)]
struct Profile {
    test: bool,
}

/// What the compiler says.
#[derive(Clone, Debug, Deserialize)]
pub struct Message {
    level: String,
    /// In short.
    #[serde(rename = "message")]
    pub text: String,
    /// For people.
    pub rendered: Option<String>,
    /// Of which places it speaks.
    #[serde(default)]
    pub spans: Vec<Span>,
}

/// A place of which the compiler speaks.
#[derive(Clone, Debug, Deserialize)]
pub struct Span {
    /// The file.
    pub file_name: String,
    /// Where it begins, in bytes.
    pub byte_start: usize,
}

/// A test program.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Program {
    /// The folder of its package.
    pub package: String,
    /// Its name.
    pub name: String,
    /// Where it runs.
    pub folder: PathBuf,
    /// Itself.
    pub path: PathBuf,
}

impl Program {
    fn of(said: &Said) -> Option<Self> {
        if !said.profile.is_some_and(|profile| profile.test) {
            return None;
        }
        let folder = said.manifest_path.as_deref().and_then(Path::parent)?.to_owned();
        let package = folder.file_name()?.to_str()?.to_owned();
        Some(Self { package, name: said.target.as_ref()?.name.clone(), folder, path: said.executable.clone()? })
    }

    /// Ready to run, without input.
    #[must_use]
    pub fn command(&self) -> Command {
        let mut command = Command::new(&self.path);
        command.current_dir(&self.folder).stdin(Stdio::null());
        command
    }
}

/// cargo in a copy, with these variables; whether it ended well, what it said in JSON, and its own words.
///
/// # Errors
/// It does not start.
pub fn cargo(
    copy: &Copy,
    arguments: &[&str],
    variables: &[(&str, &str)],
) -> Result<(bool, Vec<Said>, String), ToolError> {
    let mut command = Command::new("cargo");
    command.current_dir(copy.root()).args(arguments).args(["--message-format=json", "--target-dir"]).arg(copy.target());
    // What is put in is not written for people.
    command.env("RUSTFLAGS", "--cap-lints=allow").envs(variables.iter().copied()).stdin(Stdio::null());
    let done = command.stderr(Stdio::piped()).output().map_err(ToolError::start("cargo"))?;
    let lines = String::from_utf8_lossy(&done.stdout).into_owned();
    let said = lines.lines().filter_map(|line| serde_json::from_str(line).ok()).collect();
    Ok((done.status.success(), said, String::from_utf8_lossy(&done.stderr).into_owned()))
}

/// The errors among what was said.
pub fn errors(said: &[Said]) -> impl Iterator<Item = &Message> {
    said.iter().filter_map(|said| said.message.as_ref()).filter(|message| message.level == "error")
}

/// The test programs among what was built, in order.
#[must_use]
pub fn programs(said: &[Said]) -> Vec<Program> {
    let mut programs: Vec<Program> = said.iter().filter_map(Program::of).collect();
    programs.sort();
    programs
}
