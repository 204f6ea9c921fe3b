//! Back to back: every golden vector through the C library, as a C program calls it.

#[path = "../../supervisor/capi/tests/common/library.rs"]
mod library;

use std::error::Error;
use std::ffi::OsStr;
use std::path::PathBuf;

use library::{built, c_compiler, output, package, program};
use supervisor::Sealed;
use supervisor_tests::vectors::files::{vectors, write_binary};

type Outcome = Result<(), Box<dyn Error>>;

/// The program, the sealed configuration, every vector in a file, and how many cycles they have.
struct Prepared {
    program: PathBuf,
    sealed: PathBuf,
    files: Vec<PathBuf>,
    cycles: usize,
}

fn prepared(cc: &str) -> Result<Prepared, Box<dyn Error>> {
    let folder = built().join("vectors");
    std::fs::create_dir_all(&folder)?;
    let sealed = folder.join("default.bin");
    std::fs::write(&sealed, Sealed::from_default()?.to_bytes())?;
    let (mut files, mut cycles) = (Vec::new(), 0);
    for vector in vectors()? {
        let file = folder.join(format!("{}.vec", vector.name));
        write_binary(&file, &vector)?;
        cycles += vector.cycles.len();
        files.push(file);
    }
    let example = package().join("example");
    let sources = ["host/replay.c", "common/replay.c", "common/digest.c"].map(|file| example.join(file));
    let include = format!("-I{}", example.join("common").display());
    let program = program(cc, "replay", &["-std=c99", &include], &sources)?;
    Ok(Prepared { program, sealed, files, cycles })
}

/// SELF-3a: the C library decides and sends the same to the bit, in every cycle of every drive and of the boundary set;
/// and a vector with another digest is found.
#[test]
fn the_c_library_decides_the_same_to_the_bit() -> Outcome {
    let Some(cc) = c_compiler("the back-to-back test of the C library") else { return Ok(()) };
    let Prepared { program, sealed, files, cycles } = prepared(&cc)?;
    let mut arguments: Vec<&OsStr> = vec![sealed.as_os_str()];
    arguments.extend(files.iter().map(|file| file.as_os_str()));
    let said = output(&program, &arguments)?;
    println!("{said}");
    assert!(cycles > 160_000, "{cycles} cycles");
    assert_eq!(said.trim_end(), format!("decisions identical: {cycles} of {cycles}"));
    // One bit of one digest.
    let first = files.first().ok_or("no vector")?;
    let mut bytes = std::fs::read(first)?;
    *bytes.get_mut(24).ok_or("no cycle")? ^= 1;
    let changed = first.with_extension("changed.vec");
    std::fs::write(&changed, bytes)?;
    let said = output(&program, &[sealed.as_os_str(), changed.as_os_str()]);
    let said = said.err().map(|error| error.to_string()).unwrap_or_default();
    assert!(said.contains("cycle 0 is the first that differs"), "{said}");
    Ok(())
}
