//! What was counted, for a terminal.

use std::fmt::Write;

use super::tally::{Tally, Times, mean, quantile};
use crate::number::float;
use crate::statistics::{rate, share};

/// S1 table 2, for what stands beside ours.
pub const S1: &str = "S1 table 2: 0.097 % false triggers in 2 000 runs at 70 % load, 30.2 ms on average from the distance \
received to the deceleration sent. Ours are simulated, not comparable.";

/// A count of runs as a share with its interval, in per cent.
#[must_use]
pub fn percent(count: u64, of: u64) -> String {
    let [least, most] = share(count, of).map(|share| share * 100.0);
    let found = if of == 0 { 0.0 } else { float(count) / float(of) * 100.0 };
    format!("{count} of {of} = {found:.3} % ({least:.3} to {most:.3} %)")
}

/// A count on the days as a rate for each 1 000 km with its interval.
#[must_use]
pub fn per_1000_km(count: u64, tally: &Tally) -> String {
    let km = float(tally.metres.max(1)) / 1000.0;
    let [least, most] = rate(count, km, 1000.0);
    format!("{count} = {:.1} ({least:.1} to {most:.1})", float(count) / km * 1000.0)
}

/// Mean and quantiles of a time in ms.
#[must_use]
pub fn times(times: &Times) -> String {
    let Some(mean) = mean(times) else { return "–".to_owned() };
    let at = |percent| quantile(times, percent).unwrap_or(0);
    format!("mean {mean:.1}, least {}, half {}, 95 % {}, 99 % {}, most {}", at(0), at(50), at(95), at(99), at(100))
}

/// What came of runs that somebody may want to see, and the first of them.
pub fn first_runs(tally: &Tally) -> impl Iterator<Item = (&str, String)> {
    tally.run_numbers.iter().map(|(what, numbers)| {
        let numbers: Vec<String> = numbers.iter().map(u64::to_string).collect();
        (what.as_str(), format!("first in the runs {}; `disturb --run` shows one", numbers.join(", ")))
    })
}

/// Everything.
#[must_use]
pub fn table(tally: &Tally) -> String {
    let mut text = String::new();
    let all = tally.all_runs();
    // Writing to a String cannot fail.
    let _ = writeln!(text, "Runs with the correct main controller (seed {}, intervals of 95 %)", tally.seed);
    let _ = writeln!(text, "  with an intervention that moves the bus: {}", percent(all.disturbed, all.runs));
    let _ = writeln!(text, "  with an intervention on the warnings:    {}", percent(all.warned, all.runs));
    let _ = writeln!(text, "  with a level that began without a cause: {}", percent(all.false_triggers, all.runs));
    let _ = writeln!(text, "  with a collision:                        {}", percent(all.collisions, all.runs));
    let [busy, there] = tally.load.map(float);
    let _ = writeln!(text, "  bus load {:.1} %, {} frames lost", busy / there.max(1.0) * 100.0, tally.lost);
    for (kind, runs) in &tally.runs {
        let _ = writeln!(
            text,
            "  {kind:<38} {:>6} runs, {:>5} with a level, {} without a cause, {} disturbed, {} warned, {} collided",
            runs.runs, runs.levels, runs.false_triggers, runs.disturbed, runs.warned, runs.collisions
        );
    }
    for (what, numbers) in first_runs(tally) {
        let _ = writeln!(text, "    {what}: {numbers}");
    }
    for (cause, count) in &tally.run_causes {
        let example = tally.run_examples.get(cause).map_or("", String::as_str);
        let _ = writeln!(text, "    {count:>5} × {cause}; first: {example}");
    }
    let reaction = &tally.reaction;
    let _ = writeln!(text, "From an object to a deceleration, in ms");
    for (name, found) in
        [("bus", &reaction.bus), ("wait", &reaction.wait), ("supervisor", &reaction.supervisor), ("all", &reaction.all)]
    {
        let _ = writeln!(text, "  {name:<10} {}", times(found));
    }
    let _ = writeln!(text, "  {S1}");
    days(&mut text, tally);
    text
}

fn days(text: &mut String, tally: &Tally) {
    let hours = float(tally.seconds) / 3600.0;
    let (km, days) = (float(tally.metres) / 1000.0, tally.days);
    let _ = writeln!(text, "Ordinary driving: {km:.1} km in {hours:.1} h on {days} days, {} stops", tally.stops);
    let _ = writeln!(
        text,
        "  the driver of the model needed more than 2 m/s² in {} stops, and ran into something {} times",
        tally.hard, tally.collisions
    );
    let all: u64 = tally.all_causes().values().sum();
    let _ = writeln!(text, "  for each 1 000 km (intervals of 95 %):");
    let _ = writeln!(text, "  {:<44} {}", "interventions", per_1000_km(all, tally));
    for (cause, count) in tally.all_causes() {
        let _ = writeln!(text, "    {cause:<42} {}", per_1000_km(count, tally));
    }
    let levels: u64 = tally.levels.values().sum();
    let _ = writeln!(text, "  {:<44} {}", "collision mitigation in all", per_1000_km(levels, tally));
    for (level, count) in &tally.levels {
        let _ = writeln!(text, "  {:<44} {}", format!("  up to level {level}"), per_1000_km(*count, tally));
    }
    let _ = writeln!(text, "  {:<44} {}", "collision warnings", per_1000_km(tally.warnings, tally));
    for (piece, count) in &tally.pieces {
        let disturbed: u64 = tally.causes.get(piece).map_or(0, |causes| causes.values().sum());
        let _ = writeln!(text, "  {piece:<26} {count:>6} times, {disturbed} interventions");
    }
    for (key, cases) in &tally.cases {
        for case in cases {
            let _ = writeln!(text, "    DISTURBED {key}: {case}");
        }
    }
}
