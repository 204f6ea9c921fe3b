//! What fails the check.

use std::path::Path;

use supervisor::LIMITS;

use super::figures::{DOCUMENTS, blocks, replaced};
use super::names::Names;
use super::{Collected, Finding};
use crate::analysis::{self, Analysis, check_words};
use crate::argument;
use crate::error::{ToolError, read};

/// Documents whose words are looked at, beside those of the analysis and the argument.
const WORDS: [&str; 5] = ["README.md", "safety-case", "proofs/README.md", "tests/README.md", "fuzz/README.md"];

/// Every finding, by check and place.
///
/// # Errors
/// A list or document cannot be read.
pub fn findings(root: &Path, collected: &Collected) -> Result<Vec<Finding>, ToolError> {
    let Collected { analysis, argument, trace, standings, .. } = collected;
    let mut all = Vec::new();
    let analysed = analysis::check(analysis).into_iter();
    all.extend(analysed.map(|finding| {
        Finding::new("analysis", &shortened(root, &finding.place), format!("{} [{:?}]", finding.message, finding.rule))
    }));
    let argued = argument::check(argument, analysis).into_iter();
    all.extend(
        argued.map(|finding| {
            Finding::new("argument", &finding.place, format!("{} [{:?}]", finding.message, finding.rule))
        }),
    );
    all.extend(trace.findings.iter().map(|finding| {
        let place = format!("{}:{}", finding.place.file, finding.place.line);
        Finding::new(
            "traceability",
            &place,
            format!("{}: {} [{:?}]", finding.place.item, finding.message, finding.rule),
        )
    }));
    let names = Names::load(root, analysis)?;
    all.extend(names.dangling(analysis, argument));
    all.extend(names.parts_without_failure(analysis));
    all.extend(timers(analysis));
    all.extend(words(root)?);
    let blocks = blocks(root, standings)?;
    for document in DOCUMENTS {
        let path = root.join(document);
        let text = if path.exists() { read(&path)? } else { String::new() };
        let (wanted, any) = replaced(&text, &blocks);
        if !any {
            all.push(Finding::new("figures", document, "has no table of the records between its marks".to_owned()));
        } else if wanted != text {
            let line =
                wanted.lines().zip(text.lines()).position(|(one, other)| one != other).map_or(0, |line| line + 1);
            let message = format!("a figure is not that of its record (`supervise evidence --write {document}`)");
            all.push(Finding::new("figures", &format!("{document}:{line}"), message));
        }
    }
    all.sort();
    all.dedup();
    Ok(all)
}

fn shortened(root: &Path, place: &str) -> String {
    place.strip_prefix(&format!("{}/", root.display())).unwrap_or(place).to_owned()
}

/// A number of `timing.toml` that names a field of the table of limits in ms must be its default: else the chains prove nothing.
fn timers(analysis: &Analysis) -> Vec<Finding> {
    let mut findings = Vec::new();
    for timer in &analysis.timing.timer {
        let Some(name) = &timer.config else { continue };
        let place = format!("timing.toml: {}", timer.id);
        match LIMITS.iter().find(|limit| limit.name == name) {
            None => findings.push(Finding::new("timing", &place, format!("{name} is not in the table of limits"))),
            Some(limit) if limit.unit == "ms" && limit.count == 1 => {
                let default = limit.default.first().copied().unwrap_or(0);
                if i64::from(timer.value_ms) != default {
                    let message = format!("says {} ms, the table of limits {default} ms for {name}", timer.value_ms);
                    findings.push(Finding::new("timing", &place, message));
                }
            }
            // A rate or a row of values: what it comes to is said there.
            Some(_) => {}
        }
    }
    findings
}

/// Words that claim more than is shown, in documents, argument and pages.
fn words(root: &Path) -> Result<Vec<Finding>, ToolError> {
    let mut texts = Vec::new();
    for name in WORDS {
        for entry in walkdir::WalkDir::new(root.join(name)).sort_by_file_name().into_iter().filter_map(Result::ok) {
            let path = entry.path();
            let of_kind =
                path.extension().is_some_and(|ext| ["md", "yaml", "html", "svg"].iter().any(|kind| ext == *kind));
            if entry.file_type().is_file() && of_kind {
                let place = path.strip_prefix(root).unwrap_or(path).to_string_lossy().replace('\\', "/");
                texts.push((place, read(path)?));
            }
        }
    }
    Ok(check_words(&texts).into_iter().map(|finding| Finding::new("words", &finding.place, finding.message)).collect())
}
