//! `supervise replay`.

use std::fmt::Write;
use std::path::Path;

use super::{INTERVENED, Outcome, print};
use crate::cli::ReplayArgs;
use crate::notes::NoteLine;
use crate::number::{grouped, rounded, seconds};
use crate::replay::{Report, Request, run as replay};
use crate::timeline::Entry;

/// How many odd things are printed.
const ODD: usize = 12;

/// Runs it.
///
/// # Errors
/// Bad files, mapping or configuration.
pub fn run(arguments: &ReplayArgs) -> Outcome {
    let sealed = super::config::read_or_default(arguments.config.as_deref())?;
    let first = arguments.logs.first().and_then(|log| log.file_name()).map(|name| name.to_string_lossy().into_owned());
    let request = Request {
        logs: arguments.logs.clone(),
        bus: arguments.bus.clone(),
        map: arguments.map.clone(),
        dbc: arguments.dbc.clone(),
        sealed,
        boot: arguments.boot.into(),
        record: arguments.record.into(),
        json: arguments.json.clone(),
        html: arguments.html.clone(),
        title: arguments.title.clone().or(first).unwrap_or_default(),
        timeline: arguments.timeline,
        digest: false,
        progress: !arguments.quiet,
    };
    let report = replay(&request)?;
    let mut text = String::new();
    if !arguments.quiet {
        text.push_str(&timeline(&report.timeline, arguments.json.as_deref()));
    }
    text.push_str(&summary(&report));
    for file in arguments.json.iter().chain(&arguments.html) {
        writeln!(text, "written: {}", file.display())?;
    }
    print(text)?;
    if report.frames == 0 {
        eprintln!("supervise: warning: not one frame in {}", request.title);
    }
    Ok(if arguments.fail_on_intervention && report.summary.interventions() > 0 { INTERVENED } else { 0 })
}

/// The timeline as text.
#[must_use]
pub fn timeline((entries, left_out): &(Vec<Entry>, u64), json: Option<&Path>) -> String {
    let mut text = String::new();
    let wide = entries.iter().map(|entry| entry.time().chars().count()).max().unwrap_or(0);
    for entry in entries {
        let times = if entry.times > 1 { format!("  ({} ×)", grouped(entry.times)) } else { String::new() };
        let line = format!("{:>wide$} s  {:<22}  {}{times}", entry.time(), entry.what, entry.text);
        text.push_str(line.trim_end());
        text.push('\n');
    }
    if *left_out > 0 {
        let everything = match json {
            Some(file) => format!("{} has everything", file.display()),
            None => "--timeline COUNT prints more, --json FILE has everything".to_owned(),
        };
        let _ = writeln!(text, "… and {} further entries: {everything}", grouped(*left_out));
    }
    if !text.is_empty() {
        text.push('\n');
    }
    text
}

/// The summary as text.
#[must_use]
pub fn summary(report: &Report) -> String {
    let mut text = report.summary.table();
    text.push('\n');
    let (from, to) = (seconds(report.span.0), seconds(report.span.1));
    let rate = rounded(report.rate()).and_then(|rate| u64::try_from(rate).ok()).unwrap_or(0);
    let interventions = report.summary.interventions();
    let mut line = |what: &str, value: String| {
        let _ = writeln!(text, "{what:<15}{value}");
    };
    line("replayed", format!("{from:.2}–{to:.2} s, {} cycles, decoded as {}", grouped(report.cycles), report.mapping));
    line(
        "",
        format!(
            "{} frames, {} used, {} unknown, {} refused, in {:.2} s ({} frames/s)",
            grouped(report.frames),
            grouped(report.taken),
            grouped(report.notes.unknown_frames()),
            grouped(report.notes.refused()),
            report.took,
            grouped(rate)
        ),
    );
    match report.summary.longest() {
        None => line("interventions", format!("none ({} shorter than 4 cycles)", grouped(report.summary.brief()))),
        Some(longest) => {
            line(
                "interventions",
                format!("{} ({} shorter than 4 cycles)", grouped(interventions), grouped(report.summary.brief())),
            );
            line(
                "longest",
                format!("{:.2}–{:.2} s  {}  {}", longest.from_s, longest.to_s, longest.channel, longest.text),
            );
        }
    }
    text.push_str(&odd(&report.notes.lines()));
    text
}

/// What was odd in the logs, as text.
fn odd(lines: &[NoteLine]) -> String {
    let mut text = String::new();
    for (index, note) in lines.iter().take(ODD).enumerate() {
        let what = if index == 0 { "odd" } else { "" };
        let _ = writeln!(text, "{what:<15}{} × {}", grouped(note.count), note.what);
        for first in note.first.iter().take(2) {
            let _ = writeln!(text, "{:<17}{first}", "");
        }
    }
    if let Some(more) = lines.len().checked_sub(ODD).filter(|more| *more > 0) {
        let _ = writeln!(text, "{:<15}… and {more} further kinds (--json FILE has them)", "");
    }
    text
}
