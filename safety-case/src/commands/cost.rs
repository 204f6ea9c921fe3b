//! `supervise cost`.

use std::fs;
use std::path::{Path, PathBuf};

use serde_json::json;

use super::{FINDINGS, NOT_RUN, Outcome, print, root};
use crate::cli::Cost;
use crate::cost::{
    CostError, Difference, Row, Size, Tools, bar, block, differences, has, main_rows, markdown, measure, replaced,
    retained, rows, sizes,
};
use crate::prove::shipped;

/// The target beside this machine.
const TARGET: &str = "thumbv7em-none-eabihf";

pub(super) fn run(arguments: &Cost) -> Outcome {
    if !has("valgrind") {
        print("NOT RUN: valgrind is missing, so no instruction was counted\n")?;
        return Ok(NOT_RUN);
    }
    let root = root()?;
    let tools = Tools::new(root, &[]);
    let measured = measure(&tools)?;
    let rows = rows(&measured.calls);
    let crossing = Tools::new(root, &arguments.cargo_arg);
    let mut code = Vec::new();
    for (name, tools, target) in [("this machine", &tools, None), (TARGET, &crossing, Some(TARGET))] {
        match sizes(tools, &measured.target, target)? {
            Ok(sizes) => code.push((name.to_owned(), sizes)),
            Err(missing) => print(format_args!("NOT RUN: sizes for {name}: {missing}\n"))?,
        }
    }
    let compiler = tools.rustc(&["--version"])?.split(' ').take(2).collect::<Vec<_>>().join(" ");
    let text = document(&rows, &code, &measured.nanoseconds, &compiler);
    let folder = root.join("target");
    write(&folder, "cost.md", &text)?;
    let sources = shipped(root)?;
    write(&folder, "cost.json", &format!("{:#}\n", data(&rows, &code, &measured.nanoseconds, &compiler, &sources)))?;
    print(&text)?;

    let mut bad = 0_usize;
    for row in rows.iter().filter(|row| bar(&row.stage).is_some_and(|bar| row.greatest() > bar)) {
        print(format_args!("BAR NOT MET: {} {}\n", row.stage, row.greatest()))?;
        bad = bad.saturating_add(1);
    }
    let shown = main_rows(&rows, &code, &retained());
    for (what, bar, bytes) in shown.iter().filter(|(what, ..)| what.starts_with("bytes")) {
        if bar.is_some_and(|bar| *bytes > bar) {
            print(format_args!("BAR NOT MET: {what}: {bytes}\n"))?;
            bad = bad.saturating_add(1);
        }
    }
    if let Some(path) = &arguments.write {
        let text = read(path)?;
        let block = block(&shown, &compiler, &text);
        let text = replaced(&text, &block).ok_or_else(|| format!("{}: no place for the rows", path.display()))?;
        fs::write(path, text).map_err(|error| CostError::File { path: path.clone(), error })?;
        // Times hold for one machine only: the record goes without them.
        let record = format!("{:#}\n", data(&rows, &code, &[], &compiler, &sources));
        write(&root.join("safety-case/records"), "cost.json", &record)?;
    }
    if let Some(path) = &arguments.check {
        for difference in differences(&read(path)?, &shown, &compiler) {
            let (counts, line) = told(&difference);
            print(format_args!("{}: {line}\n", path.display()))?;
            bad = bad.saturating_add(usize::from(counts));
        }
    }
    Ok(if bad == 0 { 0 } else { FINDINGS })
}

/// Whether it is a finding, and its line.
fn told(difference: &Difference) -> (bool, String) {
    match difference {
        Difference::NoPlace => (true, "has no place for the rows of the cost".to_owned()),
        Difference::Missing(what) => (true, format!("has no row \"{what}\"")),
        Difference::Number(what, shown, measured) => (true, format!("\"{what}\" shows {shown}, measured {measured}")),
        Difference::NotCompared(what) => {
            (false, format!("NOT COMPARED: \"{what}\" (not measured, or another compiler)"))
        }
    }
}

fn read(path: &Path) -> Result<String, CostError> {
    fs::read_to_string(path).map_err(|error| CostError::File { path: path.to_owned(), error })
}

fn write(folder: &Path, name: &str, text: &str) -> Result<PathBuf, CostError> {
    let path = folder.join(name);
    let done = fs::create_dir_all(folder).and_then(|()| fs::write(&path, text));
    done.map(|()| path.clone()).map_err(|error| CostError::File { path, error })
}

/// Everything, for people.
fn document(rows: &[Row], code: &[(String, Vec<Size>)], times: &[(String, f64)], compiler: &str) -> String {
    let mut lines = vec![
        "# What a cycle costs".to_owned(),
        String::new(),
        format!(
            "Instructions by callgrind on this machine, {compiler}, release; the greatest of all calls of a scenario."
        ),
        "No bound on the worst case.".to_owned(),
        String::new(),
        markdown(rows),
        "## How the whole step grows".to_owned(),
        String::new(),
    ];
    let whole = rows.iter().filter(|row| row.stage == "whole step");
    let growth: Vec<_> = whole.flat_map(Row::growth).collect();
    lines.extend(growth.iter().map(|(objects, count)| format!("- {objects} radar objects: {count}")));
    lines.extend([
        String::new(),
        "## Time on this machine: cheapest batch of the dearest scenario, ns per call (not checked)".to_owned(),
        String::new(),
    ]);
    lines.extend(times.iter().map(|(stage, time)| format!("- {stage}: {time:.1}")));
    lines.extend(["", "## Retained, bytes on this machine", ""].map(str::to_owned));
    lines.extend(retained().iter().map(|(what, bytes)| format!("- {what}: {bytes}")));
    for (target, sizes) in code {
        lines.extend([String::new(), format!("## Code for {target}, bytes"), String::new()]);
        lines.extend(["| object | text | rodata | data |", "|---|---|---|---|"].map(str::to_owned));
        let row = |size: &Size| format!("| {} | {} | {} | {} |", size.what, size.text, size.rodata, size.data);
        lines.extend(sizes.iter().map(row));
    }
    lines.extend(["", "Not measured: the stack, caches, the target's own time.", ""].map(str::to_owned));
    lines.join("\n")
}

fn data(
    rows: &[Row],
    code: &[(String, Vec<Size>)],
    times: &[(String, f64)],
    compiler: &str,
    sources: &str,
) -> serde_json::Value {
    let stages: Vec<_> = rows
        .iter()
        .map(|row| {
            let scenarios: serde_json::Map<_, _> =
                row.scenarios.iter().map(|(name, count)| (name.clone(), json!(count))).collect();
            json!({
                "stage": row.stage, "bar": bar(&row.stage), "greatest": row.greatest(), "median": row.median(),
                "scenarios": scenarios
            })
        })
        .collect();
    let code: Vec<_> = code
        .iter()
        .flat_map(|(target, sizes)| sizes.iter().map(move |size| (target, size)))
        .map(|(target, size)| {
            json!({"target": target, "what": size.what, "text": size.text, "rodata": size.rodata, "data": size.data})
        })
        .collect();
    let named = |(name, value): &(String, f64)| (name.clone(), json!(value));
    json!({
        "schema": "supervise-cost", "version": 1, "sources": sources, "compiler": compiler,
        "unit": "instructions", "stages": stages,
        "nanoseconds": times.iter().map(named).collect::<serde_json::Map<_, _>>(),
        "retained": retained().iter().map(|(name, bytes)| ((*name).to_owned(), json!(bytes))).collect::<serde_json::Map<_, _>>(),
        "code": code,
    })
}
