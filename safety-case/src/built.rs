//! What this program was built from. What it drives and what it seals is built in, while the digests in its records are of the files:
//! a program that is older than the files must not record anything.
//!
//! The build script includes this file.

use std::fs;
use std::hash::{DefaultHasher, Hasher};
use std::io;
use std::path::{Path, PathBuf};

/// The shipped crates.
pub const SHIPPED: [&str; 5] = [
    "supervisor/terms/src",
    "supervisor/observe/src",
    "supervisor/core/src",
    "supervisor/perceive/src",
    "supervisor/wire/src",
];
/// What else is built in: the facade, and the bus on the desk.
pub const BESIDE: [&str; 2] = ["supervisor/src", "tests/src"];

/// A fingerprint of all of these files. Comparable between programs of one compiler only.
///
/// # Errors
/// A folder or a file cannot be read.
pub fn fingerprint(root: &Path) -> io::Result<String> {
    let mut hash = DefaultHasher::new();
    for folder in SHIPPED.iter().chain(&BESIDE) {
        let mut files = Vec::new();
        walk(&root.join(folder), &mut files)?;
        files.sort();
        for file in files {
            let bytes = fs::read(&file)?;
            hash.write(file.strip_prefix(root).unwrap_or(&file).as_os_str().as_encoded_bytes());
            hash.write_usize(bytes.len());
            hash.write(&bytes);
        }
    }
    Ok(format!("{:016x}", hash.finish()))
}

fn walk(folder: &Path, files: &mut Vec<PathBuf>) -> io::Result<()> {
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if path.is_dir() {
            walk(&path, files)?;
        } else {
            files.push(path);
        }
    }
    Ok(())
}
