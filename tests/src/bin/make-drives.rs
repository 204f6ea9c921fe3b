//! Makes the shipped drives: `cargo run --release -p supervisor-tests --bin make-drives [-- OUTDIR]`.
//!
//! Writes a log per drive and `drives.toml` into OUTDIR, by default `tests/drives`: the same bytes every time.

use std::error::Error;
use std::path::PathBuf;

use supervisor_tests::drive::{Driven, Scenario, run};
use supervisor_tests::judge::{GRACE_CYCLES, Stretch, hazards, interventions, stretches, unmet};
use supervisor_tests::s1::{Approach, PUBLISHED, approach};
use supervisor_tests::{candump, catalogue, manifest};

fn main() -> Result<(), Box<dyn Error>> {
    let default = || PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/drives"));
    let folder = std::env::args_os().nth(1).map_or_else(default, PathBuf::from);
    std::fs::create_dir_all(&folder)?;
    let mut all = Vec::new();
    for scenario in catalogue::ALL {
        let driven = run(scenario)?;
        let packed = candump::packed(&driven.frames)?;
        std::fs::write(folder.join(format!("{}.candump.gz", scenario.name)), &packed)?;
        tell(scenario, &driven, packed.len());
        all.push((scenario, driven));
    }
    std::fs::write(folder.join("drives.toml"), manifest::manifest(&all))?;
    compare()?;
    Ok(())
}

/// S1 §3.2 beside ours, as a table.
fn compare() -> Result<(), Box<dyn Error>> {
    let cell = |value: Option<f64>, digits: usize| value.map_or("–".to_owned(), |value| format!("{value:.digits$}"));
    let row = |name: &str, told: &Approach| {
        let levels: Vec<String> = told
            .levels
            .iter()
            .zip(told.speed)
            .map(|(at, speed)| format!("{} ({})", cell(*at, 2), cell(speed, 1)))
            .collect();
        println!("| {name} | {} | {} | {} |", levels.join(" | "), cell(told.standstill, 2), cell(told.rest_gap, 1));
    };
    println!(
        "\n| brake dead time | level 1 at s (km/h) | level 2 | level 3 | standstill | rest gap in m |\n|---|---|---|---|---|---|"
    );
    row("S1, published", &PUBLISHED);
    for tenths in 0_u8..=7 {
        let dead = f64::from(tenths) / 10.0;
        row(&format!("{dead:.1} s"), &approach(dead)?);
    }
    Ok(())
}

/// What one drive shows, in a few lines.
fn tell(scenario: &Scenario, driven: &Driven, bytes: usize) {
    let Driven { cycles, frames } = driven;
    let found = interventions(cycles);
    let after_start = |stretch: &&Stretch| cycles.first().is_none_or(|first| stretch.from_ms > first.now_ms);
    let all = stretches(cycles);
    let brief: Vec<usize> =
        all.iter().filter(after_start).map(|stretch| stretch.cycles).filter(|length| *length <= GRACE_CYCLES).collect();
    let (short, longest) = (brief.len(), brief.iter().max().unwrap_or(&0));
    println!(
        "{}: {} cycles, {} frames, {bytes} bytes; {} interventions, {short} times short for up to {longest} cycles",
        scenario.name,
        cycles.len(),
        frames.len(),
        found.len(),
    );
    if scenario.misdeeds.is_empty() {
        for stretch in &found {
            println!("  INTERVENTION {stretch:?}");
        }
    }
    for misdeed in scenario.misdeeds {
        let unmet = unmet(misdeed, cycles);
        if !unmet.is_empty() {
            println!("  NOT REFUSED AS EXPECTED at {} ms: {}: {unmet:?}", misdeed.from_ms, misdeed.what);
        }
    }
    for (now_ms, hazard) in hazards(cycles) {
        println!("  HAZARD {hazard:?} at {now_ms} ms");
    }
}
