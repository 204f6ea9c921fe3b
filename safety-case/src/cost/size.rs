//! Sizes: what one `step` takes of code when linked, what each crate's object holds, and what is retained.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::SystemTime;

use supervisor::wire::{Receiver, Sender};
use supervisor::{Decision, Sealed, StateImage, Supervisor};

use super::tool::{Tools, output};
use super::{CostError, has};

/// The shipped packages, in the order in which they build on each other.
const PACKAGES: [&str; 7] = [
    "supervisor-terms",
    "supervisor-observe",
    "supervisor-core",
    "supervisor-perceive",
    "supervisor-wire",
    "supervisor-report",
    "supervisor",
];
/// What a hosted target has in its C and standard libraries; the bare one links its own.
const HOSTED: [&str; 6] = ["memcpy", "memmove", "memset", "memcmp", "bcmp", "rust_eh_personality"];
/// Part of the mangled name of the only way in.
const STEP: &str = "10Supervisor4step";

/// A size in bytes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Size {
    /// Of what.
    pub what: String,
    /// Code.
    pub text: u64,
    /// Constants.
    pub rodata: u64,
    /// Initialised and zeroed data: a static variable. There is none.
    pub data: u64,
}

/// What is retained from cycle to cycle, on this machine: name and bytes.
#[must_use]
pub fn retained() -> [(&'static str, u64); 7] {
    let bytes = |size: usize| u64::try_from(size).unwrap_or(u64::MAX);
    let (supervisor, receiver) = (size_of::<Supervisor>(), size_of::<Receiver>());
    let sender = size_of::<Sender>();
    [
        ("retained state (words and complements)", bytes(size_of::<StateImage>())),
        ("sealed configuration", bytes(size_of::<Sealed>())),
        ("`Supervisor`", bytes(supervisor)),
        ("`wire::Receiver`", bytes(receiver)),
        ("`wire::Sender`", bytes(sender)),
        ("`Supervisor` with its link", bytes(supervisor.saturating_add(receiver).saturating_add(sender))),
        ("`Decision` (not retained)", bytes(size_of::<Decision>())),
    ]
}

/// The sizes of the release objects for a target (`None`: this machine), and of `Supervisor::step` linked alone.
///
/// The objects are built without link-time optimisation, one per package, and hold all that is public, unused or not.
/// The linked size drops what `step` does not reach; that it links without a panic handler shows that it has no panic.
///
/// # Errors
/// `Ok(Err(..))` says what is missing here; `Err` that something failed.
pub fn sizes(tools: &Tools, folder: &Path, target: Option<&str>) -> Result<Result<Vec<Size>, String>, CostError> {
    let chosen: Vec<&str> = target.iter().flat_map(|target| ["--target", *target]).collect();
    let library = {
        let mut arguments = vec!["--print", "target-libdir"];
        arguments.extend(&chosen);
        PathBuf::from(tools.rustc(&arguments)?)
    };
    let builds_core = tools.arguments.iter().any(|argument| argument.contains("build-std"));
    if !library.is_dir() && !builds_core {
        return Ok(Err(format!("the target {} is not installed", target.unwrap_or("of this machine"))));
    }
    if !has("size") || !has("nm") {
        return Ok(Err("size or nm is missing".to_owned()));
    }
    let objects = folder.join("objects");
    for package in PACKAGES {
        let mut command = tools.cargo(&["rustc", "--quiet", "--release", "--lib", "-p", package, "--target-dir"]);
        command.arg(&objects).env("CARGO_PROFILE_RELEASE_LTO", "off");
        command.args(&chosen).args(["--", "--emit=obj"]);
        output(&mut command)?;
    }
    let built = target.map_or_else(|| objects.clone(), |target| objects.join(target)).join("release/deps");
    let mut all = Vec::new();
    let mut files = Vec::new();
    for package in PACKAGES {
        let file = newest(&built, &format!("{}-", package.replace('-', "_")), ".o")?;
        let file = file.ok_or_else(|| CostError::Form(format!("{package}: no object in {}", built.display())))?;
        all.push(sections(package, &file)?);
        files.push(file);
    }
    let libraries = if builds_core { &built } else { &library };
    match link(tools, &files, libraries, target.is_none(), &built)? {
        Ok(linked) => all.push(sections("`Supervisor::step`, linked alone", &linked)?),
        Err(missing) => return Ok(Err(missing)),
    }
    Ok(Ok(all))
}

/// Links `step` alone, with everything dropped that it does not reach.
fn link(
    tools: &Tools,
    files: &[PathBuf],
    libraries: &Path,
    hosted: bool,
    folder: &Path,
) -> Result<Result<PathBuf, String>, CostError> {
    let Some(linker) = linker(tools)? else { return Ok(Err("rust-lld is missing".to_owned())) };
    let facade = files.last().ok_or_else(|| CostError::Form("no object".to_owned()))?;
    let symbols = output(Command::new("nm").arg(facade))?;
    let mut functions = symbols.lines().filter(|line| line.contains(" T "));
    let step = functions.find_map(|line| line.split_whitespace().last().filter(|name| name.contains(STEP)));
    let Some(step) = step else { return Ok(Err("the object has no symbol of Supervisor::step".to_owned())) };
    let image = folder.join("step.elf");
    let mut command = Command::new(linker);
    command.args(["-flavor", "gnu", "--gc-sections", "-e", step, "-o"]).arg(&image).args(files);
    for library in ["libcore-", "libcompiler_builtins-"] {
        command.args(newest(libraries, library, ".rlib")?);
    }
    if hosted {
        command.args(HOSTED.map(|name| format!("--defsym={name}=0")));
    }
    output(&mut command)?;
    Ok(Ok(image))
}

/// The linker that comes with the compiler, or one in the path.
fn linker(tools: &Tools) -> Result<Option<PathBuf>, CostError> {
    let host = tools.rustc(&["-vV"])?;
    let host = host.lines().find_map(|line| line.strip_prefix("host: ")).unwrap_or_default().to_owned();
    let root = PathBuf::from(tools.rustc(&["--print", "sysroot"])?);
    let own = root.join("lib/rustlib").join(host).join("bin/rust-lld");
    Ok(if own.is_file() { Some(own) } else { Some(PathBuf::from("rust-lld")).filter(|_| has("rust-lld")) })
}

/// The newest file of a folder whose name begins and ends so.
fn newest(folder: &Path, begin: &str, end: &str) -> Result<Option<PathBuf>, CostError> {
    let failed = |error| CostError::File { path: folder.to_owned(), error };
    let mut found: Option<(SystemTime, PathBuf)> = None;
    for entry in fs::read_dir(folder).map_err(failed)? {
        let entry = entry.map_err(failed)?;
        let name = entry.file_name().to_string_lossy().into_owned();
        if !name.starts_with(begin) || !name.ends_with(end) {
            continue;
        }
        let time = entry.metadata().and_then(|data| data.modified()).map_err(failed)?;
        if found.as_ref().is_none_or(|(newest, _)| *newest < time) {
            found = Some((time, entry.path()));
        }
    }
    Ok(found.map(|(_, path)| path))
}

fn sections(what: &str, file: &Path) -> Result<Size, CostError> {
    Ok(sum(what, &output(Command::new("size").args(["-A", "-d"]).arg(file))?))
}

/// Sums the sections of `size -A -d`: code, constants, data.
fn sum(what: &str, text: &str) -> Size {
    let mut size = Size { what: what.to_owned(), text: 0, rodata: 0, data: 0 };
    for line in text.lines() {
        let mut parts = line.split_whitespace();
        let (Some(name), Some(Ok(bytes))) = (parts.next(), parts.next().map(str::parse::<u64>)) else { continue };
        let of = |kind: &str| name == kind || name.starts_with(&format!("{kind}."));
        if of(".text") {
            size.text = size.text.saturating_add(bytes);
        } else if of(".rodata") || of(".data.rel.ro") {
            size.rodata = size.rodata.saturating_add(bytes);
        } else if of(".data") || of(".bss") {
            size.data = size.data.saturating_add(bytes);
        }
    }
    size
}

#[cfg(test)]
mod tests {
    use super::sum;

    #[test]
    fn sections_are_summed_by_kind() {
        let text = "a.o  :\nsection size addr\n.text 0 0\n.text.f 40 0\n.rodata.x 8 0\n.data.rel.ro.y 16 0\n\
            .data.z 4 0\n.bss 2 0\n.comment 99 0\n.textual 7 0\nTotal 176\n";
        let size = sum("a", text);
        assert_eq!((size.text, size.rodata, size.data), (40, 24, 6));
    }
}
