//! `supervise inject`.

use super::{FINDINGS, Outcome, built_root, print, write};
use crate::cli::Inject;
use crate::inject::judge::failed;
use crate::inject::page::page;
use crate::inject::record::{RECORD, read};
use crate::inject::table::{summary, table};
use crate::inject::{List, Matrix, Request, Sources, campaign, rows};

pub(super) fn run(arguments: &Inject) -> Outcome {
    let root = built_root()?;
    let list = List::load(&root.join("safety-case/analysis"))?;
    let sources = Sources::load(root)?;
    let matrix = if arguments.check {
        read(&root.join(RECORD))?
    } else if arguments.merge.is_empty() {
        campaign(&list, &request(arguments), sources.clone())?
    } else {
        Matrix::merge(arguments.merge.iter().map(|path| read(path)).collect::<Result<_, _>>()?)?
    };
    if let Some(path) = &arguments.json {
        write(path, &matrix.write()?)?;
    }
    let rows = rows(&list, &matrix);
    if let Some(path) = &arguments.html {
        write(path, &page(&rows, &matrix)?)?;
    }
    let differences = matrix.sources.differences(&sources);
    for what in &differences {
        print(format_args!("STALE: {what} changed since this was run\n"))?;
    }
    if !arguments.check {
        print(table(&rows))?;
    }
    print(summary(&rows, &matrix))?;
    Ok(if failed(&rows, &matrix) || !differences.is_empty() { FINDINGS } else { 0 })
}

fn request(arguments: &Inject) -> Request {
    Request {
        seed: arguments.seed,
        runs: arguments.runs,
        shard: arguments.shard,
        faults: arguments.fault.clone(),
        scenarios: arguments.scenario.clone(),
        jobs: arguments.jobs,
    }
}
