//! `supervise disturb`.

use super::{FINDINGS, Outcome, built_root, config, print, write};
use crate::cli::Disturb;
use crate::disturb::page::page;
use crate::disturb::record::{RECORD, read};
use crate::disturb::table::table;
use crate::disturb::{Request, Sources, Tally, campaign, single};

pub(super) fn run(arguments: &Disturb) -> Outcome {
    let root = built_root()?;
    let sealed = config::read_or_default(arguments.config.as_deref())?;
    if let Some(number) = arguments.run {
        let single = single(sealed, arguments.seed, number).ok_or("nothing is drawn for this run")?;
        if let Some(path) = &arguments.json {
            write(path, &format!("{:#}\n", single.document()))?;
        }
        if let Some(path) = &arguments.html {
            write(path, &single.page()?)?;
        }
        print(single.table())?;
        return Ok(0);
    }
    let sources = Sources::load(root, &sealed)?;
    let tally = if arguments.check {
        read(&root.join(RECORD))?
    } else if arguments.merge.is_empty() {
        let Disturb { seed, runs, km, shard, jobs, .. } = *arguments;
        campaign(&Request { sealed, seed, runs, km, shard, jobs }, sources.clone())
    } else {
        let parts: Vec<Tally> = arguments.merge.iter().map(|path| read(path)).collect::<Result<_, _>>()?;
        Tally::merge(&parts)?
    };
    if let Some(path) = &arguments.json {
        write(path, &tally.write()?)?;
    }
    if let Some(path) = &arguments.html {
        write(path, &page(&tally)?)?;
    }
    let differences = tally.sources.differences(&sources);
    for what in &differences {
        print(format_args!("STALE: {what} changed since this was run\n"))?;
    }
    print(table(&tally))?;
    Ok(if differences.is_empty() { 0 } else { FINDINGS })
}
