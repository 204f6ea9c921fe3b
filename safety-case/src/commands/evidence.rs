//! `supervise evidence`.

use std::fs;
use std::path::Path;
use std::time::{Instant, SystemTime, UNIX_EPOCH};

use serde_json::json;

use super::{FINDINGS, Outcome, print, root, write};
use crate::cli::Evidence;
use crate::error::{file, read};
use crate::evidence::figures::{blocks, replaced};
use crate::evidence::folder::{RUN, changed, files, ours, write_all};
use crate::evidence::{Collected, Request, collect};
use crate::prove::stepped;

pub(super) fn run(arguments: &Evidence) -> Outcome {
    let root = match &arguments.root {
        Some(path) => path.canonicalize().map_err(|error| file(path, error))?,
        None => root()?.to_owned(),
    };
    if arguments.digest {
        print(format_args!("{}\n", stepped(&root)?))?;
        return Ok(0);
    }
    let out = arguments.out.clone().unwrap_or_else(|| root.join("target/evidence"));
    let began = Instant::now();
    let writes = !arguments.check && arguments.write.is_none();
    if writes {
        ours(&out)?;
    }
    let drives = (writes && !arguments.no_drives).then(|| out.join("drives"));
    let request = Request { log: arguments.log.clone(), drives };
    let mut failure = None;
    let collected = collect(&root, &request, &mut |line| {
        failure = failure.take().or_else(|| print(format_args!("{:>4} s  {line}\n", began.elapsed().as_secs())).err());
    })?;
    if let Some(error) = failure {
        return Err(error.into());
    }
    if let Some(path) = &arguments.write {
        return tables(&root, path, &collected);
    }
    let mut findings = collected.findings.clone();
    if arguments.check {
        findings.extend(changed(&out)?);
    } else {
        let count = write_all(&out, &files(&root, &collected)?, request.drives.is_some())?;
        let now = SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |time| time.as_secs());
        let run = json!({
            "schema": "supervise-evidence-run", "version": 1, "unix_seconds": now, "took_ms": u64::try_from(began.elapsed().as_millis()).unwrap_or(u64::MAX),
            "program": concat!("supervise ", env!("CARGO_PKG_VERSION")),
        });
        write(&out.join(RUN), &format!("{run:#}\n"))?;
        print(format_args!("{count} files\n"))?;
    }
    print("\n")?;
    for standing in &collected.standings {
        print(format_args!("{:<8} {}\n", standing.state.word(), standing.title))?;
    }
    print(format_args!("{} open items, {} findings\n", collected.open.len(), findings.len()))?;
    for finding in &findings {
        print(format_args!("{finding}\n"))?;
    }
    if !arguments.check {
        print(format_args!("\nOpen {}\n", out.join("index.html").display()))?;
    }
    Ok(if findings.is_empty() { 0 } else { FINDINGS })
}

/// Writes the tables of the records into a document.
fn tables(root: &Path, path: &Path, collected: &Collected) -> Outcome {
    let (text, any) = replaced(&read(path)?, &blocks(root, &collected.standings)?);
    if !any {
        return Err(format!("{}: no place for the tables of the records", path.display()).into());
    }
    fs::write(path, text).map_err(|error| file(path, error))?;
    Ok(0)
}
