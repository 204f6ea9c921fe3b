//! The static library as it ships, and programs in C that are linked with it.

use std::ffi::OsStr;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::Command;

type Result<T> = std::result::Result<T, Box<dyn std::error::Error>>;

/// What every C file of ours compiles with, without a warning.
pub const STRICT: [&str; 5] = ["-Wall", "-Wextra", "-Wconversion", "-pedantic", "-Werror"];

/// The folder of the package, also for the tests of the bus on the desk.
pub fn package() -> PathBuf {
    let own = Path::new(env!("CARGO_MANIFEST_DIR"));
    if own.join("cbindgen.toml").is_file() { own.to_owned() } else { own.join("../supervisor/capi") }
}

/// Where these tests build.
pub fn built() -> PathBuf {
    package().join("../../target/capi")
}

/// A compiler: the one of this variable, or the first of these that is here.
pub fn compiler(variable: &str, usual: &[&str]) -> Option<String> {
    let works = |name: &str| Command::new(name).arg("--version").output().is_ok_and(|done| done.status.success());
    let chosen = std::env::var(variable).ok().into_iter().chain(usual.iter().map(|name| (*name).to_owned()));
    chosen.into_iter().find(|name| works(name))
}

/// Says what is not run, and why: past the test runner, which keeps what a passed test prints to itself.
pub fn not_run(what: &str, why: &str) {
    // Nobody may be there to read it.
    let _ = writeln!(std::io::stderr(), "NOT RUN: {what}: {why}");
}

/// The C compiler of this machine; says loudly what is not run without one.
pub fn c_compiler(what: &str) -> Option<String> {
    let found = compiler("CC", &["cc", "gcc", "clang"]);
    if found.is_none() {
        not_run(what, "no C compiler is here");
    }
    found
}

/// Runs it; what it prints, or why it failed.
///
/// # Errors
/// It cannot be started, or fails.
pub fn run(command: &mut Command) -> Result<String> {
    let done = command.output().map_err(|error| format!("{command:?}: {error}"))?;
    let (out, error) = (String::from_utf8_lossy(&done.stdout), String::from_utf8_lossy(&done.stderr));
    if done.status.success() {
        Ok(out.into_owned())
    } else {
        Err(format!("{command:?}: {}\n{out}{error}", done.status).into())
    }
}

/// The static library, built as it ships: release, for this machine.
///
/// # Errors
/// It does not build.
pub fn library() -> Result<PathBuf> {
    let mut cargo = Command::new(env!("CARGO"));
    cargo.args(["build", "--release", "--quiet", "-p", "supervisor-capi", "--target-dir"]).arg(built());
    // Not what is set for the tests themselves: the profile is the one that ships.
    for (name, _) in std::env::vars_os() {
        if name.to_str().is_some_and(|name| name.starts_with("CARGO_P") || name == "RUSTFLAGS") {
            cargo.env_remove(name);
        }
    }
    run(cargo.current_dir(package()))?;
    Ok(built().join("release/libsupervisor_capi.a"))
}

/// A program of these C files and the library; what it does not reach is dropped.
///
/// # Errors
/// It does not compile or link.
pub fn program(compiler: &str, name: &str, options: &[&str], files: &[PathBuf]) -> Result<PathBuf> {
    let (library, program) = (library()?, built().join(name));
    let mut command = Command::new(compiler);
    command.args(options).args(STRICT).arg("-I").arg(package().join("include"));
    command.args(["-O1", "-ffunction-sections", "-Wl,--gc-sections"]).args(files).arg(library);
    // C++ takes a file for what it is called; the library is none of that language.
    run(command.arg("-o").arg(&program))?;
    Ok(program)
}

/// What the program prints.
///
/// # Errors
/// It fails.
pub fn output(program: &Path, arguments: &[&OsStr]) -> Result<String> {
    run(Command::new(program).args(arguments))
}
