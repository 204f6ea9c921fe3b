//! Has Creusot translate this crate and Why3's provers discharge each verification condition; writes what they said to
//! `raw/`, and to `record.json` what follows from it.
//!
//! `cargo run --example discharge -- CREUSOT_RUSTC PRELUDE TOOLCHAIN`: the compiler that Creusot builds, the folder that
//! its prelude generator fills, and the toolchain that both were built with; `why3`, `z3` and `cvc5` on PATH.
//!
//! **Not yet run as a whole**: until it is, `record.json` says of every contract "stated, not discharged".

#[path = "../tests/record/mod.rs"]
mod record;

use record::{Condition, Contract, Record, Tools, digests, verdict};
use std::{
    collections::BTreeMap,
    env, fs,
    path::{Path, PathBuf},
    process::{Command, Stdio},
};

type Outcome<T> = Result<T, Box<dyn std::error::Error>>;

/// For how many seconds each prover tries each condition.
const PATIENCE: &str = "10";
const PROVERS: [&str; 2] = ["z3", "cvc5"];

fn main() -> Outcome<()> {
    let arguments: Vec<String> = env::args().skip(1).collect();
    let [compiler, prelude, toolchain] = &arguments[..] else {
        return Err("usage: discharge CREUSOT_RUSTC PRELUDE TOOLCHAIN".into());
    };
    let home = Path::new(env!("CARGO_MANIFEST_DIR"));
    let work = env::temp_dir().join(format!("supervisor-creusot-{}", std::process::id()));
    fs::create_dir_all(&work)?;
    translate(home, &work, compiler, toolchain)?;
    let library = work.join("library");
    copy_prelude(Path::new(prelude), &library)?;
    let config = work.join("why3.conf");
    // It also tells of versions that it does not know; that they work, each proof shows.
    Command::new("why3").arg("-C").arg(&config).args(["config", "detect"]).stdout(Stdio::null()).status()?;

    let raw = home.join("raw");
    let _ = fs::remove_dir_all(&raw);
    fs::create_dir_all(&raw)?;
    let mut modules = Vec::new();
    find(&work.join("translated"), &mut modules)?;
    modules.sort();
    let mut contracts = Vec::new();
    for module in &modules {
        let contract = discharge(module, &library, &config, &raw)?;
        println!("{}: {} ({} conditions)", contract.function, contract.verdict, contract.conditions.len());
        contracts.push(contract);
    }
    let tools = Tools {
        creusot: "0.11.0".into(),
        rustc: first_line(Command::new("rustc").env("RUSTUP_TOOLCHAIN", toolchain).arg("--version"))?,
        why3: first_line(Command::new("why3").arg("--version"))?,
        z3: first_line(Command::new("z3").arg("--version"))?,
        cvc5: first_line(Command::new("cvc5").arg("--version"))?,
    };
    let command = format!("why3 prove -a split_vc -t {PATIENCE} -P z3 (then cvc5) --json");
    let record = Record { version: 1, tools, command, sources: digests(home), contracts };
    fs::write(home.join("record.json"), serde_json::to_string_pretty(&record)? + "\n")?;
    fs::remove_dir_all(&work)?;
    Ok(())
}

/// As `cargo creusot` does it, without an installation of it.
fn translate(home: &Path, work: &Path, compiler: &str, toolchain: &str) -> Outcome<()> {
    let options = serde_json::json!({
        "span_mode": "Off", "spans_relative_to": null, "export_metadata": true, "stdout": false, "output_file": null,
        "output_dir": work.join("translated"), "check": false, "monolithic": false, "extern_paths": [],
        "simple_triggers": false, "erasure_check": "No", "erasure_check_dir": null,
    });
    let status = Command::new("cargo")
        .current_dir(home)
        .args(["check", "--lib", "-F", "creusot-std/creusot creusot-std/nightly"])
        .env("RUSTC", compiler)
        .env("RUSTUP_TOOLCHAIN", toolchain)
        .env("RUSTC_BOOTSTRAP", "1")
        .env("CARGO_CREUSOT", "1")
        .env("CARGO_INCREMENTAL", "0")
        .env("CARGO_TARGET_DIR", work.join("target"))
        .env("CREUSOT_ARGS", options.to_string())
        .status()?;
    if status.success() { Ok(()) } else { Err("Creusot does not translate this crate".into()) }
}

/// Creusot's prelude without its modules of signed bit vectors: those need a Why3 newer than 1.8.2, and nothing here uses
/// them. A translation that did would not load.
fn copy_prelude(prelude: &Path, library: &Path) -> Outcome<()> {
    let folder = library.join("creusot");
    fs::create_dir_all(&folder)?;
    for entry in fs::read_dir(prelude)? {
        let path = entry?.path();
        let mut skipped = false;
        let text = fs::read_to_string(&path)?;
        let kept = text.lines().filter(|line| {
            if let Some(name) = line.strip_prefix("module ") {
                skipped = name.starts_with("Int") && name.ends_with("BW");
            }
            !skipped
        });
        fs::write(folder.join(path.file_name().ok_or("no name")?), kept.collect::<Vec<_>>().join("\n") + "\n")?;
    }
    Ok(())
}

fn find(folder: &Path, modules: &mut Vec<PathBuf>) -> Outcome<()> {
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if path.is_dir() {
            find(&path, modules)?;
        } else if path.extension().is_some_and(|extension| extension == "coma") {
            modules.push(path);
        }
    }
    Ok(())
}

/// Each condition by the first prover; by the next those that are left.
fn discharge(module: &Path, library: &Path, config: &Path, raw: &Path) -> Outcome<Contract> {
    let (folder, file) = (module.parent().ok_or("no folder")?, module.file_name().ok_or("no name")?);
    let function = module.file_stem().ok_or("no name")?.to_string_lossy().into_owned();
    let mut best: BTreeMap<usize, Condition> = BTreeMap::new();
    for prover in PROVERS {
        let said = Command::new("why3")
            .current_dir(folder)
            .arg("-C")
            .arg(config)
            .args(["prove", "--json", "-a", "split_vc", "-t", PATIENCE, "-P", prover, "-L"])
            .arg(library)
            .arg(file)
            .stderr(Stdio::inherit())
            .output()?
            .stdout;
        let conditions = record::conditions(prover, &said)?;
        fs::write(raw.join(format!("{function}.{prover}.json")), &said)?;
        for (place, condition) in conditions.into_iter().enumerate() {
            let better = |old: &Condition| !old.is_valid() && condition.is_valid();
            if best.get(&place).is_none_or(better) {
                best.insert(place, condition);
            }
        }
        if !best.is_empty() && best.values().all(Condition::is_valid) {
            break;
        }
    }
    let conditions: Vec<Condition> = best.into_values().collect();
    Ok(Contract { function, verdict: verdict(&conditions).into(), conditions })
}

fn first_line(command: &mut Command) -> Outcome<String> {
    let output = String::from_utf8(command.output()?.stdout)?;
    Ok(output.lines().next().unwrap_or_default().trim().to_owned())
}
