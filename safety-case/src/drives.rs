//! The drives that ship with the project: replayed, each with its page, and a page that links them.

use std::fmt::Write as _;
use std::io::Write as _;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};
use supervisor::Sealed;

use crate::page::{IndexEntry, duration, index};
use crate::replay::{Report, Request, create, run as replay};

/// The list that ships beside the drives.
#[derive(Debug, Default, Deserialize)]
struct Manifest {
    #[serde(default)]
    drive: Vec<Listed>,
}

/// What the list says of a drive; the simulation that made it wrote this.
#[derive(Clone, Debug, Deserialize)]
struct Listed {
    name: String,
    title: Option<String>,
    description: Option<String>,
    interventions: Option<u64>,
    digest: Option<String>,
}

/// A drive that was replayed.
#[derive(Clone, Debug, Serialize)]
pub struct Drive {
    /// Its name.
    pub name: String,
    /// Interventions.
    pub interventions: u64,
    /// Whether every verdict is that of the simulation that made it.
    pub same: bool,
    /// A few lines on it.
    pub told: String,
}

/// Replays every drive of `root` and writes its page and JSON into the folder, and an index beside them.
///
/// # Errors
/// If there are no drives, one cannot be read, or the pages cannot be written.
pub fn replayed(
    root: &Path,
    target: &Path,
    say: &mut dyn FnMut(&str),
) -> Result<Vec<Drive>, Box<dyn std::error::Error>> {
    let folder = root.join("tests").join("drives");
    let logs = logs(&folder);
    if logs.is_empty() {
        return Err(format!(
            "no *.candump.gz in {}; replay a log of your own with `supervise replay LOG`",
            folder.display()
        )
        .into());
    }
    let manifest = std::fs::read_to_string(folder.join("drives.toml")).unwrap_or_default();
    let manifest: Manifest = toml::from_str(&manifest).unwrap_or_default();
    let (mut entries, mut drives) = (Vec::new(), Vec::new());
    for log in logs {
        let file = log.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
        let name = file.trim_end_matches(".candump.gz").to_owned();
        let listed = manifest.drive.iter().find(|drive| drive.name == name);
        let title = listed.and_then(|drive| drive.title.clone()).unwrap_or_else(|| name.clone());
        let request = Request {
            json: Some(target.join(format!("{name}.json"))),
            html: Some(target.join(format!("{name}.html"))),
            title: title.clone(),
            timeline: 2000,
            digest: listed.is_some_and(|drive| drive.digest.is_some()),
            ..Request::of(log, Sealed::from_default()?)
        };
        let report = replay(&request)?;
        let (told, same) = told(&name, &title, &report, listed);
        say(told.trim_end());
        entries.push(IndexEntry {
            title,
            description: listed.and_then(|drive| drive.description.clone()).unwrap_or_default(),
            page: format!("{name}.html"),
            json: format!("{name}.json"),
            interventions: report.summary.interventions(),
            longest: longest(&report),
            length: duration(report.span.1.saturating_sub(report.span.0)),
        });
        drives.push(Drive { name, interventions: report.summary.interventions(), same, told });
    }
    create(&target.join("index.html"))?.write_all(index(&entries)?.as_bytes())?;
    Ok(drives)
}

/// The logs of the folder, in the order of their names.
fn logs(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path());
    let mut logs: Vec<PathBuf> = entries.filter(|file| file.to_string_lossy().ends_with(".candump.gz")).collect();
    logs.sort();
    logs
}

fn longest(report: &Report) -> String {
    report.summary.longest().map_or(String::new(), |longest| {
        format!("{:.2}–{:.2} s  {}  {}", longest.from_s, longest.to_s, longest.channel, longest.text)
    })
}

/// A few lines on a drive, and whether its verdicts are those of the simulation that made it.
fn told(name: &str, title: &str, report: &Report, drive: Option<&Listed>) -> (String, bool) {
    let interventions = report.summary.interventions();
    let mut text = String::new();
    let length = duration(report.span.1.saturating_sub(report.span.0));
    let count = if interventions == 0 { "no".to_owned() } else { interventions.to_string() };
    // Writing to a String cannot fail.
    let _ = writeln!(text, "{title}  ({name}, {length})");
    let _ = writeln!(text, "    {count} interventions, {} shorter than 4 cycles", report.summary.brief());
    if interventions > 0 {
        let _ = writeln!(text, "    longest: {}", longest(report));
    }
    let mut same = true;
    if let Some(expected) = drive.and_then(|drive| drive.digest.as_deref()) {
        same = report.digest.map(|digest| format!("{digest:016x}")).as_deref() == Some(expected);
        let word = if same { "the same as" } else { "NOT those" };
        let _ = writeln!(text, "    every verdict {word} in the simulation that made it ({expected})");
    }
    if let Some(expected) = drive.and_then(|drive| drive.interventions).filter(|expected| *expected != interventions) {
        same = false;
        let _ = writeln!(text, "    the simulation had {expected} interventions");
    }
    (text, same)
}
