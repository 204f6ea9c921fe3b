//! `supervise analysis`.

use std::fmt::Write;
use std::path::Path;

use super::{FINDINGS, Outcome, print};
use crate::analysis::{check, load};
use crate::cli::AnalysisArgs;
use crate::inject::List;
use crate::inject::list::FILE;

/// Runs it.
///
/// # Errors
/// If the analysis cannot be read; file and entry are named.
pub fn run(arguments: &AnalysisArgs) -> Outcome {
    let ours = || Path::new(env!("CARGO_MANIFEST_DIR")).join("analysis");
    let folder = arguments.folder.clone().unwrap_or_else(ours);
    let analysis = load(&folder)?;
    let findings = check(&analysis);
    let mut text = String::new();
    for finding in &findings {
        writeln!(text, "{finding}")?;
    }
    // A folder without faults is an analysis, too.
    let faults = if folder.join(FILE).exists() { List::load(&folder)?.faults.len() } else { 0 };
    let events: usize = analysis.hazards.iter().map(|hazard| hazard.event.len()).sum();
    for (count, what) in [
        (analysis.hazards.len(), "hazards"),
        (events, "hazardous events"),
        (analysis.goals.len(), "safety goals"),
        (analysis.requirements.len(), "requirements"),
        (analysis.assumptions.len(), "assumptions of use"),
        (analysis.readings.len(), "readings of the sources"),
        (analysis.failures.len(), "failure modes of the supervisor's parts"),
        (analysis.tools.len(), "tools"),
        (analysis.methods.iter().map(|table| table.row.len()).sum(), "methods answered"),
        (analysis.limitations.len(), "known limitations and anomalies"),
        (analysis.risks.len(), "risks that are left"),
        (faults, "faults to inject"),
        (findings.len(), "findings"),
    ] {
        writeln!(text, "{count:>5} {what}")?;
    }
    print(text)?;
    Ok(if findings.is_empty() { 0 } else { FINDINGS })
}
