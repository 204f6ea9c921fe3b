//! `supervise simulate`.

use super::{FINDINGS, Outcome, built_root, print, write};
use crate::cli::Simulate;
use crate::inject::Sources;
use crate::simulate::document::document;
use crate::simulate::page::page;
use crate::simulate::table::{list, summary, table};
use crate::simulate::{Request, simulate};
use supervisor_tests::scenario::{folder, load};

pub(super) fn run(arguments: &Simulate) -> Outcome {
    let all = load::all(&folder())?;
    if arguments.list {
        print(list(&all))?;
        return Ok(0);
    }
    let scenes = if arguments.all { all } else { load::named(&all, &arguments.scenarios)? };
    let request =
        Request { seed: arguments.seed, shard: arguments.shard, jobs: arguments.jobs, log: arguments.log.clone() };
    let driven = simulate(&scenes, &request)?;
    if let Some(path) = &arguments.json {
        write(path, &format!("{:#}\n", document(&driven, arguments.seed, &Sources::load(built_root()?)?)))?;
    }
    if let Some(path) = &arguments.html {
        write(path, &page(&driven, arguments.seed)?)?;
    }
    print(table(&driven))?;
    print(summary(&driven))?;
    Ok(if driven.iter().all(|drive| drive.standing().as_expected()) { 0 } else { FINDINGS })
}
