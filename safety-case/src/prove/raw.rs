//! The raw results, `proofs/results/<harness>.json.gz`: what Kani exported, without the machine it ran on.

use std::io::{Read, Write};
use std::path::{Path, PathBuf};

use flate2::read::GzDecoder;
use flate2::{Compression, GzBuilder};
use serde_json::{Map, Value};

use super::sources::sha256;
use crate::error::{ToolError, file, write};

/// Where they stand.
pub const RESULTS: &str = "proofs/results";

/// Keys of Kani's export that name directories, the time of day, the machine or its speed, and nothing that a verdict
/// rests on. Without them the same tools give the same bytes wherever they run.
const DROPPED: [&str; 7] =
    ["timestamp", "os_info", "workspace_root", "output_dir", "goto_file", "mangled_name", "duration_ms"];
/// So begin the keys of further durations.
const DURATION: &str = "runtime_";

/// A raw result as it is kept.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Raw(Vec<u8>);

impl Raw {
    /// What stays of an export that was made on the workspace at `root`.
    #[must_use]
    pub fn of(export: &Value, root: &Path) -> Self {
        Self(format!("{}\n", cleaned(export, &root.to_string_lossy())).into_bytes())
    }

    /// Its digest.
    #[must_use]
    pub fn digest(&self) -> String {
        sha256(&self.0)
    }

    /// The export.
    ///
    /// # Errors
    /// It is no JSON.
    pub fn export(&self) -> Result<Value, serde_json::Error> {
        serde_json::from_slice(&self.0)
    }

    /// Writes it, packed: the same bytes for the same result, whenever and wherever.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn save(&self, folder: &Path, harness: &str) -> Result<(), ToolError> {
        let path = place(folder, harness);
        let mut packer = GzBuilder::new().mtime(0).operating_system(255).write(Vec::new(), Compression::best());
        let bytes = packer.write_all(&self.0).and_then(|()| packer.finish()).map_err(|error| file(&path, error))?;
        write(&path, &bytes)
    }

    /// Reads it.
    ///
    /// # Errors
    /// The file cannot be read, or is not packed.
    pub fn load(folder: &Path, harness: &str) -> Result<Self, ToolError> {
        let path = place(folder, harness);
        let mut bytes = Vec::new();
        let packed = std::fs::File::open(&path).map_err(|error| file(&path, error))?;
        GzDecoder::new(packed).read_to_end(&mut bytes).map_err(|error| file(&path, error))?;
        Ok(Self(bytes))
    }
}

fn place(folder: &Path, harness: &str) -> PathBuf {
    folder.join(format!("{harness}.json.gz"))
}

fn cleaned(value: &Value, root: &str) -> Value {
    match value {
        Value::String(text) => Value::String(relative(text, root)),
        Value::Array(values) => Value::Array(values.iter().map(|value| cleaned(value, root)).collect()),
        Value::Object(fields) => {
            let kept = fields.iter().filter(|(key, _)| !DROPPED.contains(&key.as_str()) && !key.starts_with(DURATION));
            Value::Object(kept.map(|(key, value)| (key.clone(), cleaned(value, root))).collect::<Map<_, _>>())
        }
        Value::Null | Value::Bool(_) | Value::Number(_) => value.clone(),
    }
}

/// The text with every absolute path cut: below the root, to what follows it; a registry's crate, to the crate; a
/// standard library's file, to `library/...`; any other, to its name.
fn relative(text: &str, root: &str) -> String {
    let text = text.replace(&format!("{}/", root.trim_end_matches('/')), "");
    let mut cut = String::with_capacity(text.len());
    let mut rest = text.as_str();
    while let Some(start) = rest.find('/') {
        let (before, path) = rest.split_at(start);
        cut.push_str(before);
        let end = path.find(|sign: char| sign.is_whitespace() || "\"'`:;,()<>{}[]".contains(sign));
        let (path, after) = path.split_at(end.unwrap_or(path.len()));
        let begins = before.is_empty() && cut.is_empty()
            || before.ends_with(|sign: char| !sign.is_alphanumeric() && !"._-".contains(sign));
        // A lone division sign is no path.
        let absolute = begins && path.trim_start_matches('/').contains('/');
        cut.push_str(if absolute { shortened(path) } else { path });
        rest = after;
    }
    cut.push_str(rest);
    cut
}

fn shortened(path: &str) -> &str {
    let after = |mark: &str| path.split_once(mark).map(|(_, rest)| rest);
    if let Some(crates) = after("/registry/src/") {
        return crates.split_once('/').map_or(crates, |(_, rest)| rest);
    }
    match path.find("/library/") {
        Some(start) => path.get(start..).map_or(path, |rest| rest.trim_start_matches('/')),
        None => path.rsplit('/').next().unwrap_or(path),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn no_machine_stays_in_a_raw_result() -> Result<(), Box<dyn std::error::Error>> {
        let export = json!({
            "metadata": {"timestamp": "now", "kani_version": "0.67.0"},
            "project": {"workspace_root": "/home/me/bus", "output_dir": "/home/me/bus/target", "crate_name": ["p"]},
            "cbmc": [{"cbmc_metadata": {"os_info": "linux", "version": "6.6.0"}, "cbmc_stats": {"runtime_solver_s": 1.5}}],
            "summary": {"duration_ms": 5},
            "checks": [
                {"file": "/home/me/bus/supervisor/core/src/seat.rs", "description": "a / b overflows"},
                {"file": "supervisor/core/src/seat.rs", "function": "<f as T>::{closure@/home/me/bus/a/b.rs:1:2}"},
                {"file": "/home/me/.rustup/toolchains/x/lib/rustlib/src/rust/library/core/src/num/mod.rs"},
                {"file": "/home/me/.cargo/registry/src/index.crates.io-1/heapless-0.9.1/src/vec.rs"},
                {"file": "/elsewhere/lib.rs"},
            ],
        });
        let raw = Raw::of(&export, Path::new("/home/me/bus"));
        let expected = json!({
            "metadata": {"kani_version": "0.67.0"},
            "project": {"crate_name": ["p"]},
            "cbmc": [{"cbmc_metadata": {"version": "6.6.0"}, "cbmc_stats": {}}],
            "summary": {},
            "checks": [
                {"file": "supervisor/core/src/seat.rs", "description": "a / b overflows"},
                {"file": "supervisor/core/src/seat.rs", "function": "<f as T>::{closure@a/b.rs:1:2}"},
                {"file": "library/core/src/num/mod.rs"},
                {"file": "heapless-0.9.1/src/vec.rs"},
                {"file": "lib.rs"},
            ],
        });
        assert_eq!(raw.export()?, expected);
        Ok(())
    }

    #[test]
    fn it_comes_back_and_is_packed_the_same_each_time() -> Result<(), Box<dyn std::error::Error>> {
        let folder = tempfile::tempdir()?;
        let raw = Raw::of(&json!({"a": [1, "x"]}), Path::new("/r"));
        raw.save(folder.path(), "one")?;
        raw.save(folder.path(), "two")?;
        let packed = |name: &str| std::fs::read(place(folder.path(), name));
        assert_eq!(packed("one")?, packed("two")?);
        let again = Raw::load(folder.path(), "one")?;
        assert_eq!(again, raw);
        assert_eq!(again.digest(), sha256(b"{\"a\":[1,\"x\"]}\n"));
        assert!(Raw::load(folder.path(), "three").is_err());
        Ok(())
    }
}
