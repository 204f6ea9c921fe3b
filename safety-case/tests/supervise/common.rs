//! What the tests of the binary share.

use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

/// The outcome of a test.
pub type Outcome = Result<(), Box<dyn std::error::Error>>;

/// A run of `supervise`.
pub struct Ran {
    /// Exit code.
    pub code: i32,
    /// Standard output.
    pub out: String,
    /// Standard error.
    pub err: String,
}

/// Runs `supervise` in a folder.
pub fn supervise_in(folder: &Path, arguments: &[&str]) -> Result<Ran, std::io::Error> {
    let output = Command::new(env!("CARGO_BIN_EXE_supervise"))
        .args(arguments)
        .current_dir(folder)
        .stdin(Stdio::null())
        .output()?;
    Ok(ran(&output))
}

/// What came of a run.
pub fn ran(output: &Output) -> Ran {
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    Ran { code: output.status.code().unwrap_or(-1), out: text(&output.stdout), err: text(&output.stderr) }
}

/// The root of the project.
pub fn project() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// A drive that ships with the project.
pub fn drive(name: &str) -> String {
    project().join("tests/drives").join(format!("{name}.candump.gz")).display().to_string()
}
