//! `supervise trace`.

use super::{FINDINGS, Outcome, print, root, write};
use crate::cli::TraceArgs;
use crate::trace::{Trace, json, page, rows, summary, trace};

/// Runs it.
///
/// # Errors
/// If the sources or the analysis cannot be read, an id is not known, or a file cannot be written.
pub fn run(arguments: &TraceArgs) -> Outcome {
    let root = match &arguments.root {
        Some(root) => root.as_path(),
        None => root()?,
    };
    let trace = trace(root)?;
    if let Some(path) = &arguments.json {
        write(path, &format!("{:#}\n", json(&trace)))?;
    }
    if let Some(path) = &arguments.html {
        write(path, &page(&trace)?)?;
    }
    print(text(&trace, arguments)?)?;
    Ok(if trace.findings.is_empty() { 0 } else { FINDINGS })
}

fn text(trace: &Trace, arguments: &TraceArgs) -> Result<String, String> {
    if arguments.ids.is_empty() {
        let findings: Vec<String> = trace.findings.iter().map(|finding| format!("{finding}\n")).collect();
        return Ok(findings.concat() + &summary(trace));
    }
    let mut text = String::new();
    for id in &arguments.ids {
        let shown = rows(trace, id);
        if shown.is_empty() {
            return Err(format!("no requirement {id}, and no group of that name"));
        }
        text.push_str(&shown);
    }
    Ok(text)
}
