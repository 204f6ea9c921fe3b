//! Tells the program what it is built from, see `src/built.rs`.

use std::io;
use std::path::Path;

#[path = "src/built.rs"]
mod built;

fn main() -> io::Result<()> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap_or(Path::new("."));
    println!("cargo:rerun-if-changed=src/built.rs");
    for folder in built::SHIPPED.iter().chain(&built::BESIDE) {
        println!("cargo:rerun-if-changed={}", root.join(folder).display());
    }
    println!("cargo:rustc-env=BUILT_FROM={}", built::fingerprint(root)?);
    Ok(())
}
