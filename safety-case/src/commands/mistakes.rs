//! `supervise mistakes`.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use super::hold::Held;
use super::{FINDINGS, NOT_RUN, Outcome, print, root, telling};
use crate::cli::Mistakes;
use crate::error::ToolError;
use crate::mistakes;
use crate::mistakes::{Kani, List, Record, Request, Shard, block, check, replaced, run as plant};
use crate::prove::{self, Place, Present, RECORD, Sources, State};

pub(super) fn run(arguments: &Mistakes) -> Outcome {
    let root = root()?;
    let runs = !arguments.check && arguments.write.is_none();
    if runs && let Some(missing) = missing(arguments) {
        print(format_args!("NOT RUN HERE: {missing}. No mistake was planted; what follows is the record.\n"))?;
        show(root, arguments)?;
        return Ok(NOT_RUN);
    }
    if runs {
        let request = Request {
            names: arguments.name.clone(),
            drawn: arguments.drawn,
            seed: arguments.seed,
            shard: arguments.shard.map_or(Shard::WHOLE, Shard::new),
            jobs: arguments.jobs.max(1),
            again: arguments.again,
        };
        let _held = Held::at_once(root, "mistakes")?;
        telling(|say| plant(root, &request, &Kani, say))?;
    }
    show(root, arguments)
}

fn missing(arguments: &Mistakes) -> Option<&'static str> {
    if !prove::available() {
        Some("cargo kani is not installed (cargo install --locked kani-verifier && cargo kani setup)")
    } else if arguments.drawn.is_some() && !mistakes::available() {
        Some("cargo mutants is not installed (cargo install --locked cargo-mutants)")
    } else {
        None
    }
}

/// What the record shows on the present sources, and what it does not.
fn show(root: &Path, arguments: &Mistakes) -> Outcome {
    let (list, record, sources) = (List::load(root)?, Record::load(root)?, Sources::load(root)?);
    let proved = proved(root, &sources)?;
    let block = block(&list, &record, &sources, &proved);
    for line in block.lines().filter(|line| line.contains(" named mistakes are ") || line.starts_with("Of ")) {
        print(format_args!("{line}\n"))?;
    }
    if let Some(path) = &arguments.write {
        let text = fs::read_to_string(path).map_err(|error| format!("{}: {error}", path.display()))?;
        let text = replaced(&text, &block).ok_or_else(|| format!("{}: no place for the table", path.display()))?;
        fs::write(path, text).map_err(|error| format!("{}: {error}", path.display()))?;
    }
    let findings = check(&list, &record, root, &sources, &proved)?;
    for finding in &findings {
        print(format_args!("{finding}\n"))?;
    }
    Ok(if findings.is_empty() { 0 } else { FINDINGS })
}

/// The harnesses that are proved on the sources without any mistake.
fn proved(root: &Path, sources: &Sources) -> Result<BTreeSet<String>, ToolError> {
    let (harnesses, record) = (prove::List::load(root)?, prove::Record::load(&root.join(RECORD))?);
    let present = Present { sources: sources.clone(), configuration: prove::default_configuration()? };
    let place = Place::committed(root);
    let proved = harnesses.harness.iter().filter(|of| State::of(of, &record, &place, &present).is_proved());
    Ok(proved.map(|harness| harness.name.clone()).collect())
}
