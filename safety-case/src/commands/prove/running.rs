//! What needs Kani: to run harnesses, to compare with the record, to make a test of a counterexample.

use std::collections::BTreeSet;
use std::fs;
use std::io;
use std::thread;

use super::{FINDINGS, Gate, Outcome, print};
use crate::error::ToolError;
use crate::prove::{
    Harness, Outcome as Ran, Progress, Proof, Quick, RECORD, Record, Sources, State, Verdict, Workers, compile,
    differences, named, ordered, playback, quick, shard,
};

impl Gate {
    /// Runs the named harnesses, or all, or only what is not proved today, or a shard of these, and keeps the record.
    pub(super) fn prove(&self, names: &[String], stale: bool, part: Option<(usize, usize)>) -> Outcome {
        let mut record = self.record()?;
        let known = if self.configured() { record.clone() } else { Record::load(&self.root.join(RECORD))? };
        let mut chosen = named(&self.list, names)?;
        if let Some(part) = part {
            chosen = shard(&chosen, &known, part);
        }
        if stale {
            let of = |harness: &Harness| State::of(harness, &record, &self.place, &self.present);
            chosen.retain(|harness| !of(harness).is_proved());
        }
        let chosen = ordered(chosen, &known);
        // One of the shards looks for all of them.
        let all = names.is_empty() && !self.configured() && part.is_none_or(|(shard, _)| shard == 1);
        let (mut proved, mut bad) = (0_usize, 0_usize);
        thread::scope(|scope| {
            // Kani's list takes a compilation of all: it comes beside the proofs, and is compared when they are done.
            let list = all.then(|| scope.spawn(|| compile(&self.root, &self.target.join("all"), &self.options)));
            self.workers().run(&chosen, &known, |harness, result, progress| match result {
                Ok(ran) => {
                    proved = proved.saturating_add(usize::from(ran.verdict == Verdict::Proved));
                    bad = bad.saturating_add(usize::from(ran.verdict != Verdict::Proved && harness.open.is_none()));
                    told(harness, &ran, progress)?;
                    self.keep(&mut record, harness, ran)
                }
                Err(error) => {
                    bad = bad.saturating_add(1);
                    line(progress, &format!("{}: NO RESULT: {error}", harness.name))
                }
            })?;
            if let Some(list) = list {
                let known =
                    list.join().map_err(|_| ToolError::Arguments("the compilation of all broke off".to_owned()))?;
                bad = bad.saturating_add(self.compared(&known?)?);
            }
            Ok::<(), Box<dyn std::error::Error>>(())
        })?;
        if names.is_empty() && part.is_none() {
            // The table follows when the record is as it shall be.
            print("\n")?;
            let code = self.show(false)?;
            return Ok(if bad == 0 { code } else { FINDINGS });
        }
        print(format_args!("{proved} of {} harnesses proved\n", chosen.len()))?;
        Ok(if bad == 0 { 0 } else { FINDINGS })
    }

    /// Compiles all, runs the key harnesses and a tenth of the rest again, and compares with the record, which stays as
    /// it is.
    pub(super) fn quick(&self) -> Outcome {
        let record = self.record()?;
        print(format_args!("compiling {} harnesses ...\n", self.list.harness.len()))?;
        let mut bad = self.compared(&compile(&self.root, &self.target.join("all"), &self.options)?)?;
        let Quick { key, drawn, left_out } = quick(&self.list, &record, &self.present.sources.whole, self.jobs);
        for (what, harnesses) in
            [("key", &key), ("drawn by the digest of the sources", &drawn), ("left out for time", &left_out)]
        {
            let names: Vec<&str> = harnesses.iter().map(|harness| harness.name.as_str()).collect();
            print(format_args!("{what}: {}\n", if names.is_empty() { "none".to_owned() } else { names.join(", ") }))?;
        }
        let chosen = ordered(key.into_iter().chain(drawn).collect(), &record);
        let mut proved = 0_usize;
        self.workers().run(&chosen, &record, |harness, result, progress| match result {
            Ok(ran) => {
                told(harness, &ran, progress)?;
                let recorded = record.of(&harness.name).map(|proof| &proof.verdict);
                let differs = recorded.is_some_and(|recorded| *recorded != ran.verdict);
                if differs {
                    line(progress, &format!("{}: DIFFERS from the record", harness.name))?;
                }
                proved = proved.saturating_add(usize::from(ran.verdict == Verdict::Proved));
                let failed = ran.verdict != Verdict::Proved && harness.open.is_none();
                bad = bad.saturating_add(usize::from(differs || failed));
                Ok(())
            }
            Err(error) => {
                bad = bad.saturating_add(1);
                line(progress, &format!("{}: NO RESULT: {error}", harness.name))
            }
        })?;
        let all = self.list.harness.len();
        print(format_args!("{proved} of {} harnesses proved again, of {all} that are listed\n", chosen.len()))?;
        Ok(if bad == 0 { 0 } else { FINDINGS })
    }

    /// Makes tests of the counterexamples of these harnesses.
    pub(super) fn playback(&self, names: &[String]) -> Outcome {
        let record = self.record()?;
        let failed = |harness: &&Harness| matches!(record.of(&harness.name), Some(proof) if matches!(proof.verdict, Verdict::Failed(_)));
        let mut chosen = named(&self.list, names)?;
        if names.is_empty() {
            chosen.retain(failed);
        }
        for harness in &chosen {
            let tests = playback(&self.root, &self.target.join("playback"), harness, &self.options)?;
            if tests.is_empty() {
                print(format_args!("{}: fails no check that a test could show\n", harness.name))?;
                continue;
            }
            let path = self.target.join(format!("{}-playback.rs", harness.name));
            let text = format!("{}{}\n", how_to(harness), tests.join("\n\n"));
            fs::write(&path, text).map_err(|error| ToolError::File { path: path.clone(), error })?;
            print(format_args!("{}: {} in {}\n", harness.name, counted(tests.len(), "test"), path.display()))?;
        }
        print(format_args!("{} with a counterexample looked for\n", counted(chosen.len(), "harness")))?;
        Ok(0)
    }

    /// Says where the list and the harnesses that Kani knows differ; the number of lines.
    fn compared(&self, known: &BTreeSet<String>) -> io::Result<usize> {
        let lines = differences(&self.list, known);
        for line in &lines {
            print(format_args!("{line}\n"))?;
        }
        Ok(lines.len())
    }

    fn configured(&self) -> bool {
        self.options.configuration.is_some()
    }

    fn workers(&self) -> Workers<'_> {
        Workers { root: &self.root, target: &self.target, jobs: self.jobs, options: &self.options }
    }

    /// Puts it into the record, with its raw result.
    fn keep(&self, record: &mut Record, harness: &Harness, ran: Ran) -> Result<(), ToolError> {
        if Sources::load(&self.root)? != self.present.sources {
            return Err(ToolError::Arguments(
                "the sources changed while the proofs ran: nothing more is recorded".to_owned(),
            ));
        }
        ran.raw.save(&self.place.results, &harness.name)?;
        let proof = Proof {
            name: harness.name.clone(),
            requirements: harness.requirements.clone(),
            extent: harness.extent.clone(),
            verdict: ran.verdict,
            checks: ran.checks,
            decides: harness.checks,
            covers: ran.covers,
            solver: ran.solver,
            seconds: ran.seconds,
            tools: ran.tools,
            sources: self.present.sources.of(&harness.name).to_owned(),
            configuration: self.present.configuration.clone(),
            result: ran.raw.digest(),
        };
        record.put(proof, &self.list);
        record.save(&self.place.record)
    }
}

fn told(harness: &Harness, ran: &Ran, progress: &Progress) -> Result<(), ToolError> {
    let Ran { verdict, checks, covers, seconds, solver, .. } = ran;
    line(
        progress,
        &format!("{}: {verdict} in {seconds} s by {solver}, {checks} checks, {covers} covers", harness.name),
    )?;
    match verdict {
        Verdict::Failed(_) => {
            line(progress, &format!("  a test of it: supervise prove --playback --harness {}", harness.name))
        }
        Verdict::Proved | Verdict::Vacuous(_) | Verdict::Undetermined(_) => Ok(()),
    }
}

fn line(progress: &Progress, text: &str) -> Result<(), ToolError> {
    let (done, all) = progress.count();
    let said = progress.aside(|| print(format_args!("[{done}/{all}] {text}; {}\n", progress.times())));
    said.map_err(|error| ToolError::File { path: "standard output".into(), error })
}

fn counted(count: usize, what: &str) -> String {
    let ending = if count == 1 {
        ""
    } else if what.ends_with('s') {
        "es"
    } else {
        "s"
    };
    format!("{count} {what}{ending}")
}

/// How to run the tests of a counterexample.
fn how_to(harness: &Harness) -> String {
    let file = format!("proofs/src/{}.rs", harness.path.replace("::", "/"));
    format!(
        "// Counterexamples of {name}. To run them: paste the tests at the end of {file}, then\n\
         //   cargo kani playback -Z concrete-playback -p supervisor-proofs -- {name}\n\
         // Each replays the values that Kani found, in order, through the harness, and fails where the proof fails; print\n\
         // or debug there.\n\n",
        name = harness.name
    )
}
