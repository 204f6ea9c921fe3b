//! `supervise prove`.

mod running;

use std::fs;
use std::path::{Path, PathBuf};
use std::time::Duration;

use super::{FINDINGS, NOT_RUN, Outcome, built_root, print};
use crate::cli::Prove;
use crate::error::ToolError;
use crate::prove::{
    Harness, List, Options, Place, Present, Record, Sources, State, available, block, configuration_digest, declared,
    default_configuration, differences, replaced, table,
};
use crate::spread::cores;

/// Where the table stands.
const README: &str = "proofs/README.md";

/// What every way of running needs.
struct Gate {
    root: PathBuf,
    /// Each worker builds in a folder of this one.
    target: PathBuf,
    list: List,
    present: Present,
    options: Options,
    jobs: usize,
    /// Whether the record is the one that is committed, and not a shard's or a user's.
    committed: bool,
    place: Place,
}

pub(super) fn run(arguments: &Prove) -> Outcome {
    let gate = Gate::new(arguments)?;
    if arguments.list {
        return gate.listed();
    }
    if arguments.table {
        return gate.table(arguments.write.as_deref());
    }
    if !arguments.merge.is_empty() {
        return gate.merge(&arguments.merge);
    }
    if arguments.check {
        return gate.check();
    }
    if !available() {
        let code = gate.check()?;
        print(
            "NOT RUN HERE: cargo kani is not installed (cargo install --locked kani-verifier && cargo kani setup).\n",
        )?;
        print("What stands above is the committed record.\n")?;
        return Ok(if code == 0 { NOT_RUN } else { code });
    }
    if arguments.playback {
        return gate.playback(&arguments.harness);
    }
    if arguments.quick { gate.quick() } else { gate.prove(&arguments.harness, arguments.stale, arguments.shard) }
}

impl Gate {
    fn new(arguments: &Prove) -> Result<Self, Box<dyn std::error::Error>> {
        // The default configuration is built in.
        let root = match &arguments.root {
            Some(root) => root,
            None => built_root()?,
        };
        let root = root.canonicalize().map_err(|error| ToolError::File { path: root.to_owned(), error })?;
        let target =
            std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root.join("target"), |folder| root.join(folder));
        let mut gate = Self {
            target: target.join("kani"),
            list: List::load(&root)?,
            present: Present { sources: Sources::load(&root)?, configuration: default_configuration()? },
            options: Options {
                package: None,
                solver: arguments.solver,
                timeout: arguments.timeout.map(Duration::from_secs),
                configuration: None,
                assertion: None,
            },
            jobs: arguments.jobs.map_or_else(cores, usize::from),
            committed: true,
            place: Place::committed(&root),
            root,
        };
        if let Some(path) = &arguments.config {
            gate.configure(path)?;
        }
        if let Some((shard, of)) = arguments.shard {
            gate.committed = false;
            gate.place = Place::beside(&gate.target.join(format!("shard-{shard}-of-{of}/record.json")));
        }
        Ok(gate)
    }

    /// Only what multiplies by configured numbers, for the sealed configuration at `path`; the record stands beside it.
    fn configure(&mut self, path: &Path) -> Result<(), Box<dyn std::error::Error>> {
        let path = path.canonicalize().map_err(|error| ToolError::File { path: path.to_owned(), error })?;
        let sealed = super::config::read(&path)?;
        self.present.configuration = configuration_digest(&sealed.to_bytes());
        let beside = |ending: &str| {
            let mut name = path.clone().into_os_string();
            name.push(ending);
            PathBuf::from(name)
        };
        self.place = Place { record: beside(".proofs.json"), results: beside(".proofs") };
        self.list.harness.retain(|harness| harness.configured);
        self.committed = false;
        self.target = self.target.join("configured");
        self.options.configuration = Some(path);
        if self.list.harness.is_empty() {
            return Err("no harness of proofs/harnesses.toml is marked configured".into());
        }
        Ok(())
    }

    fn record(&self) -> Result<Record, ToolError> {
        Record::load(&self.place.record)
    }

    /// Shows the list.
    fn listed(&self) -> Outcome {
        let record = self.record()?;
        for harness in &self.list.harness {
            let marks = [("key", harness.key), ("configured", harness.configured), ("stubs", harness.stubs)];
            let marks = marks.iter().filter(|(_, marked)| *marked).map(|(mark, _)| format!(", {mark}"));
            let marks = marks.collect::<String>();
            let seconds =
                record.of(&harness.name).map_or_else(|| "not run".to_owned(), |proof| format!("{} s", proof.seconds));
            let Harness { path, name, extent, solver, .. } = harness;
            print(format_args!("{path}::{name:<56} {extent}, {solver}, {seconds}{marks}\n"))?;
        }
        print(format_args!("{} harnesses\n", self.list.harness.len()))?;
        Ok(0)
    }

    /// Prints the table, or puts it into a file and the words of the list into the record.
    fn table(&self, file: Option<&Path>) -> Outcome {
        let mut record = self.record()?;
        let Some(path) = file else {
            print(table(&self.list, &record))?;
            return Ok(0);
        };
        record.adopt(&self.list);
        record.save(&self.place.record)?;
        let failed = |error| ToolError::File { path: path.to_owned(), error };
        let text = fs::read_to_string(path).map_err(failed)?;
        let text = replaced(&text, &block(&self.list, &record));
        let text = text.ok_or_else(|| format!("{}: no place for the table", path.display()))?;
        fs::write(path, text).map_err(failed)?;
        Ok(0)
    }

    /// Joins the parts that shards made.
    fn merge(&self, parts: &[PathBuf]) -> Outcome {
        let mut record = self.record()?;
        for part in parts {
            let count = record.merge(&Place::beside(part), &self.place, &self.list)?;
            print(format_args!("{}: {count} harnesses\n", part.display()))?;
        }
        print(format_args!("The table follows by prove --table --write {README}.\n"))?;
        self.show(false)
    }

    /// Runs nothing: shows what the record says today, and whether list, sources and table agree with it.
    fn check(&self) -> Outcome {
        self.show(true)
    }

    fn show(&self, with_table: bool) -> Outcome {
        let record = self.record()?;
        let (mut proved, mut bad) = (0_usize, 0_usize);
        for harness in &self.list.harness {
            let state = State::of(harness, &record, &self.place, &self.present);
            let run = record.of(&harness.name).map(|proof| {
                format!(
                    " ({}, {}, {} s, {} checks, {} covers)",
                    harness.extent, proof.solver, proof.seconds, proof.checks, proof.covers
                )
            });
            print(format_args!("{:<56} {state}{}\n", harness.name, run.unwrap_or_default()))?;
            proved = proved.saturating_add(usize::from(state.is_proved()));
            bad = bad.saturating_add(usize::from(state.is_bad()));
        }
        let others = if self.committed { self.disagreements(&record, with_table)? } else { Vec::new() };
        for line in &others {
            print(format_args!("{line}\n"))?;
        }
        let open = self.list.harness.len().saturating_sub(proved).saturating_sub(bad);
        print(format_args!(
            "{proved} proved on the present sources; {bad} failed, vacuous, undetermined, stale or not run; {open} open\n"
        ))?;
        Ok(if bad == 0 && others.is_empty() { 0 } else { FINDINGS })
    }

    /// Where list, sources, record and table do not say the same.
    fn disagreements(&self, record: &Record, with_table: bool) -> Result<Vec<String>, ToolError> {
        let mut lines = differences(&self.list, &declared(&self.root)?);
        let mut adopted = record.clone();
        adopted.adopt(&self.list);
        if adopted != *record {
            lines.push("OUTDATED: the record has other harnesses, requirements or extents than the list".to_owned());
        }
        if !with_table {
            return Ok(lines);
        }
        let path = self.root.join(README);
        let text = fs::read_to_string(&path).unwrap_or_default();
        if replaced(&text, &block(&self.list, record)).as_ref() != Some(&text) {
            lines.push(format!(
                "OUTDATED: the table of {README} is not that of the record (prove --table --write {README})"
            ));
        }
        Ok(lines)
    }
}
