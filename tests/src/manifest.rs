//! `drives.toml`: what each shipped drive shows, for people and for tests, written from the drives themselves.

use std::fmt::Write as _;

use crate::drive::{Driven, Scenario};
use crate::judge::{digest, events, hazards, interventions};

/// The manifest of these drives.
#[must_use]
pub fn manifest(drives: &[(&Scenario, Driven)]) -> String {
    let mut text = String::from(
        "# The shipped drives. Written by `cargo run --release -p supervisor-tests --bin make-drives`; do not edit.\n\
         # Times are in seconds of the log. The supervisor steps at every multiple of 10 ms, from 0.01 s on, after\n\
         # every frame with an earlier stamp; it starts with reset cause \"power on\" and an intact record of nothing.\n\
         # digest: FNV-1a (64 bits) over kind, reason (one byte each), value, limit, margin (i32, little endian) of\n\
         # all 12 verdicts of every step.\n",
    );
    for (scenario, driven) in drives {
        // Writing to a String cannot fail.
        let _ = entry(&mut text, scenario, driven);
    }
    text
}

fn entry(text: &mut String, scenario: &Scenario, driven: &Driven) -> std::fmt::Result {
    let seconds = |ms: u32| f64::from(ms) / 1000.0;
    let cycles = &driven.cycles;
    writeln!(text, "\n[[drive]]")?;
    writeln!(text, "name = \"{}\"", scenario.name)?;
    writeln!(text, "file = \"{}.candump.gz\"", scenario.name)?;
    writeln!(text, "title = \"{}\"", scenario.title)?;
    writeln!(text, "description = \"{}\"", scenario.description)?;
    writeln!(text, "controller = \"{}\"", if scenario.misdeeds.is_empty() { "correct" } else { "misbehaving" })?;
    writeln!(text, "length = {:.2}", seconds(scenario.length_ms))?;
    writeln!(text, "frames = {}", driven.frames.len())?;
    writeln!(text, "interventions = {}", interventions(cycles).len())?;
    writeln!(text, "hazards = {}", hazards(cycles).len())?;
    writeln!(text, "digest = \"{:016x}\"", digest(cycles.iter().map(|cycle| cycle.answer)))?;
    for event in events(cycles) {
        writeln!(text, "\n[[drive.event]]\nat = {:.2}\nwhat = \"{}\"", seconds(event.now_ms), event.what)?;
    }
    for misdeed in scenario.misdeeds {
        writeln!(text, "\n[[drive.misdeed]]")?;
        writeln!(text, "from = {:.2}\nuntil = {:.2}", seconds(misdeed.from_ms), seconds(misdeed.until_ms))?;
        writeln!(text, "what = \"{}\"", misdeed.what)?;
        writeln!(text, "expected = [")?;
        for (channel, reason) in misdeed.expected {
            writeln!(text, "    {{ channel = \"{channel:?}\", reason = \"{reason:?}\" }},")?;
        }
        writeln!(text, "]")?;
    }
    Ok(())
}
