//! The files of the folder, written at once, and the digest of each.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use serde_json::{Value, json};

use super::export::{junit, needs, sbom, strictdoc};
use super::page::page;
use super::tones::tones;
use super::{Collected, Finding};
use crate::argument::sheets;
use crate::error::{ToolError, file, form, read, write};
use crate::inject;
use crate::prove::sha256;

/// The digests, in the form of `sha256sum --check`.
pub const MANIFEST: &str = "manifest.sha256";
/// What sphinx-needs has to be told of `needs.json`: its types and fields.
const NEEDS: &str = include_str!("../../templates/needs.toml");
/// What differs between two runs, and is not in the manifest.
pub const RUN: &str = "run.json";
/// Committed records that are copied, so that the folder stands alone.
const COPIED: [&str; 10] = [
    "proofs/record.json",
    "proofs/mistakes.json",
    "proofs/creusot/record.json",
    "safety-case/records/inject.json",
    "safety-case/records/coverage.json",
    "safety-case/records/mutants.json",
    "safety-case/records/fuzz.json",
    "safety-case/records/disturb.json",
    "safety-case/records/simulate.json",
    "safety-case/records/target.json",
];

/// Name and content of every file but the manifest, the drives and the run.
///
/// # Errors
/// A page does not render, or a record cannot be read.
pub fn files(root: &Path, collected: &Collected) -> Result<BTreeMap<String, String>, Box<dyn std::error::Error>> {
    let Collected { analysis, argument, trace, standings, inventory, .. } = collected;
    let mut files = BTreeMap::new();
    let mut add = |name: &str, text: String| {
        files.insert(name.to_owned(), text);
    };
    let tones = tones(argument, standings, trace);
    let sheets = sheets(argument, &tones)?;
    for sheet in &sheets {
        add(&format!("argument/{}.svg", sheet.root), sheet.svg.clone());
    }
    for (name, text) in &argument.texts {
        add(&format!("argument/{}", name.rsplit('/').next().unwrap_or(name)), text.clone());
    }
    for name in COPIED {
        let path = root.join(name);
        if path.exists() {
            add(
                &format!("records/{}", name.trim_start_matches("safety-case/records/").replace('/', "-")),
                read(&path)?,
            );
        }
    }
    let matrix = root.join(inject::record::RECORD);
    if matrix.exists() {
        let list = inject::List::load(&root.join("safety-case/analysis"))?;
        let matrix = inject::record::read(&matrix)?;
        add("inject.html", inject::page::page(&inject::rows(&list, &matrix), &matrix)?);
    }
    let pretty = |value: &Value| format!("{value:#}\n");
    add("trace.html", crate::trace::page(trace)?);
    add("trace.json", pretty(&crate::trace::json(trace)));
    add("analysis.json", pretty(&serde_json::to_value(analysis)?));
    add("requirements.sdoc", strictdoc(analysis, trace));
    add("needs.json", pretty(&needs(analysis, trace, env!("CARGO_PKG_VERSION"))));
    add("needs.toml", NEEDS.to_owned());
    add("tests.xml", junit(trace, collected.log.as_ref())?);
    if inventory.not_run.is_none() {
        add("sbom.cdx.json", sbom(inventory)?);
    }
    add("evidence.json", pretty(&document(collected, &tones)));
    add("index.html", page(collected, &sheets, &tones)?);
    Ok(files)
}

/// The state of all of it, for other programs.
fn document(collected: &Collected, tones: &BTreeMap<String, &'static str>) -> Value {
    json!({
        "schema": "supervise-evidence", "version": 1, "findings": collected.findings, "open": collected.open,
        "records": collected.standings, "figures": super::records::figures(&collected.standings),
        "argument": collected.argument, "solutions": tones, "inventory": collected.inventory,
        "tools": collected.versions, "drives": collected.drives.as_ref().map(|drives| json!(drives)),
    })
}

/// Refuses a folder that holds what no run of ours has written: its files are not ours to remove.
///
/// # Errors
/// It holds such files, or cannot be read.
pub fn ours(folder: &Path) -> Result<(), ToolError> {
    let listed = listed(folder)?;
    // The drives are written before the manifest: a run that was broken off leaves them alone.
    let foreign = present(folder)?.into_iter().find(|name| !listed.contains(name) && !name.starts_with("drives/"));
    foreign.map_or(Ok(()), |name| {
        let path = folder.join(name);
        Err(form(&path, &"was not written by `supervise evidence`: name a folder that is empty, or not there"))
    })
}

/// Writes the files into a folder of ours; what an earlier run wrote and this one does not goes. Then the manifest over
/// everything that is there.
///
/// # Errors
/// The folder cannot be read or written, or is not ours.
pub fn write_all(folder: &Path, files: &BTreeMap<String, String>, drives: bool) -> Result<usize, ToolError> {
    ours(folder)?;
    for name in present(folder)? {
        if !(files.contains_key(&name) || drives && name.starts_with("drives/")) {
            fs::remove_file(folder.join(&name)).map_err(|error| file(&folder.join(&name), error))?;
        }
    }
    for (name, text) in files {
        write(&folder.join(name), text.as_bytes())?;
    }
    let mut manifest = String::new();
    let names = present(folder)?;
    for name in &names {
        let digest = digest(&folder.join(name))?;
        // Writing to a string does not fail.
        let _ = writeln!(manifest, "{digest}  {name}");
    }
    write(&folder.join(MANIFEST), manifest.as_bytes())?;
    Ok(names.len())
}

/// Files whose digest is not that of the manifest, files that it does not name, and files that are gone; nothing if the folder
/// was never made.
///
/// # Errors
/// The folder cannot be read.
pub fn changed(folder: &Path) -> Result<Vec<Finding>, ToolError> {
    let path = folder.join(MANIFEST);
    if !path.exists() {
        return Ok(Vec::new());
    }
    let text = read(&path)?;
    let digests: BTreeMap<&str, &str> =
        text.lines().filter_map(|line| line.split_once("  ")).map(|(digest, name)| (name, digest)).collect();
    let mut findings = Vec::new();
    let names = present(folder)?;
    for name in &names {
        let message = match digests.get(name.as_str()) {
            None => "is not in the manifest",
            Some(known) if **known != digest(&folder.join(name))? => "has another digest than the manifest says",
            Some(_) => continue,
        };
        findings.push(Finding::new("manifest", name, message.to_owned()));
    }
    for name in digests.keys().filter(|name| !names.iter().any(|present| present == *name)) {
        findings.push(Finding::new("manifest", name, "is in the manifest, and is gone".to_owned()));
    }
    Ok(findings)
}

/// The names of the manifest; none without it.
fn listed(folder: &Path) -> Result<BTreeSet<String>, ToolError> {
    let path = folder.join(MANIFEST);
    let text = if path.exists() { read(&path)? } else { String::new() };
    Ok(text.lines().filter_map(|line| line.split_once("  ")).map(|(_, name)| name.to_owned()).collect())
}

fn digest(path: &Path) -> Result<String, ToolError> {
    fs::read(path).map(|bytes| sha256(&bytes)).map_err(|error| file(path, error))
}

/// Every file of the folder but the manifest and the run, in order.
fn present(folder: &Path) -> Result<Vec<String>, ToolError> {
    if !folder.exists() {
        return Ok(Vec::new());
    }
    let mut names = Vec::new();
    for entry in walkdir::WalkDir::new(folder).sort_by_file_name() {
        let entry = entry.map_err(|error| form(folder, &error))?;
        let name = entry.path().strip_prefix(folder).unwrap_or(entry.path()).to_string_lossy().replace('\\', "/");
        if entry.file_type().is_file() && name != MANIFEST && name != RUN {
            names.push(name);
        }
    }
    names.sort();
    Ok(names)
}
