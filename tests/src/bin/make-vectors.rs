//! Makes the golden vectors: `cargo run --release -p supervisor-tests --bin make-vectors [-- OUTDIR]`.
//!
//! Writes the files of every shipped drive and of the boundary set into OUTDIR, by default `target/vectors`, and what is
//! kept of them into `tests/vectors`: the boundary set's frames and decisions, packed, and the SHA-256 of every file.
//! `-- --binary OUTDIR` writes the binary files alone, the sealed configuration beside them (`default.bin`), and keeps
//! nothing.

use std::error::Error;
use std::path::{Path, PathBuf};

use supervisor::Sealed;
use supervisor_tests::vectors::files::{all, keep, vectors, write_binary};

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args_os().skip(1).peekable();
    let binary = arguments.next_if(|argument| argument == "--binary").is_some();
    let default = || PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../target/vectors"));
    let folder = arguments.next().map_or_else(default, PathBuf::from);
    std::fs::create_dir_all(&folder)?;
    if binary {
        std::fs::write(folder.join("default.bin"), Sealed::from_default()?.to_bytes())?;
        for vector in vectors()? {
            write_binary(&folder.join(format!("{}.vec", vector.name)), &vector)?;
            println!("{}: {} cycles", vector.name, vector.cycles.len());
        }
        return Ok(());
    }
    let sums = all(&folder, &mut |name, cycles| println!("{name}: {cycles} cycles"))?;
    let kept = keep(&folder, &sums)?;
    let home = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/vectors"));
    std::fs::create_dir_all(home)?;
    for (name, bytes) in kept {
        println!("tests/vectors/{name}: {} bytes", bytes.len());
        std::fs::write(home.join(name), bytes)?;
    }
    Ok(())
}
