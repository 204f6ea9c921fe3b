//! The matrix for a terminal.

use std::fmt::Write;

use super::judge::{Row, Standing};
use super::list::{Effect, Expected};
use super::matrix::Matrix;

/// Longest description in a row, in characters.
const WIDE: usize = 58;

/// The word for what is expected.
#[must_use]
pub const fn expected(row: &Row<'_>) -> &'static str {
    match (row.fault.expected, row.fault.effect) {
        (Expected::Detected, Effect::Averted) => "detected",
        (Expected::Detected, Effect::Reported) => "reported",
        (Expected::Tolerated, _) => "tolerated",
        (Expected::Residual, _) => "residual",
    }
}

/// Every fault in a row.
#[must_use]
pub fn table(rows: &[Row<'_>]) -> String {
    let mut text = String::new();
    let head = "fault  expected   runs  dangerous  averted  reported  late  missed  reaction ms (least/middle/greatest)  of FTTI  stands";
    let _ = writeln!(text, "{head}");
    for row in rows.iter().filter(|row| row.standing != Standing::NotRun) {
        let sum = &row.sum;
        let times = row.detection().map_or("-".to_owned(), |[least, middle, most]| format!("{least}/{middle}/{most}"));
        let share = if sum.detection_ms.is_empty() { "-".to_owned() } else { format!("{} %", sum.share) };
        let what: String = row.fault.what.chars().take(WIDE).collect();
        let _ = writeln!(
            text,
            "{:<6} {:<10} {:>4} {:>10} {:>8} {:>9} {:>5} {:>7}  {times:>16} {share:>8}  {:<16} {what}",
            row.fault.run.id,
            expected(row),
            sum.runs(),
            sum.dangerous(),
            sum.averted,
            sum.reported,
            sum.late,
            sum.missed,
            row.standing.word(),
        );
    }
    text
}

/// What contradicts, what is known, what was not shown, and the sums.
#[must_use]
pub fn summary(rows: &[Row<'_>], matrix: &Matrix) -> String {
    let mut text = String::new();
    for row in rows {
        match row.standing {
            Standing::Against => {
                let _ =
                    writeln!(text, "AGAINST {}: {} Expected: {}", row.fault.run.id, row.fault.what, row.fault.reason);
                for example in &row.sum.examples {
                    let _ = writeln!(
                        text,
                        "  {} at {} ms for {} ms, {} {}",
                        example.outcome, example.from_ms, example.lasts_ms, example.goal, example.said
                    );
                }
            }
            Standing::Known => {
                let known = row.fault.known.as_deref().unwrap_or_default();
                let _ = writeln!(text, "KNOWN {}: {known}", row.fault.run.id);
            }
            Standing::AsExpected | Standing::NotShown | Standing::Residual | Standing::NotRun => {}
        }
    }
    for drive in matrix.drives.iter().filter(|drive| drive.interventions > 0 || drive.harms > 0) {
        let (interventions, harms) = (drive.interventions, drive.harms);
        let _ =
            writeln!(text, "DISTURBED {}: {interventions} interventions, {harms} harms without a fault", drive.name);
    }
    for (number, what) in figures(rows, matrix) {
        let _ = writeln!(text, "{number:>7} {what}");
    }
    text
}

/// The figures that count.
#[must_use]
pub fn figures(rows: &[Row<'_>], matrix: &Matrix) -> Vec<(usize, &'static str)> {
    let of = |expected: Expected, count: fn(&Row<'_>) -> usize| {
        rows.iter().filter(|row| row.fault.expected == expected).map(count).sum::<usize>()
    };
    let standing = |standing: Standing| rows.iter().filter(|row| row.standing == standing).count();
    vec![
        (rows.iter().filter(|row| row.standing != Standing::NotRun).count(), "faults were run"),
        (matrix.cells.len(), "cells fault × scenario"),
        (rows.iter().map(|row| row.sum.runs()).sum(), "runs, each with the supervisor and without"),
        (of(Expected::Detected, |row| row.sum.dangerous()), "dangerous runs of faults that are to be detected"),
        (of(Expected::Detected, |row| row.sum.averted), "of these averted in time"),
        (of(Expected::Detected, |row| row.sum.reported), "of these reported in time, not averted"),
        (of(Expected::Detected, |row| row.sum.late), "of these seen too late"),
        (of(Expected::Detected, |row| row.sum.missed), "of these missed"),
        (of(Expected::Residual, |row| row.sum.dangerous()), "dangerous runs of residual faults"),
        (of(Expected::Tolerated, |row| row.sum.dangerous()), "dangerous runs of faults that are to be tolerated"),
        (standing(Standing::NotShown), "faults that were never dangerous: nothing is shown for them"),
        (standing(Standing::Known), "faults that stand against their expectation, known"),
        (standing(Standing::Against), "faults that stand against their expectation"),
        (matrix.drives.len(), "drives without a fault"),
        (matrix.drives.iter().map(|drive| drive.interventions).sum(), "false interventions in them"),
    ]
}
