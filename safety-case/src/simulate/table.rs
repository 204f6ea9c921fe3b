//! What came of scenarios, for a terminal.

use std::fmt::Write;

use supervisor_tests::scenario::Scene;
use supervisor_tests::scenario::criteria::Standing;

use super::run::Driven;

/// What there is.
#[must_use]
pub fn list(scenes: &[Scene]) -> String {
    let mut text = String::new();
    let wide = scenes.iter().map(|scene| scene.full_name().chars().count()).max().unwrap_or(0);
    for scene in scenes {
        // Writing to a String cannot fail.
        let _ = writeln!(text, "{:<wide$}  {:>4} s  {}", scene.full_name(), scene.length_ms / 1000, scene.title);
    }
    text
}

/// Every demand in a row.
#[must_use]
pub fn table(driven: &[Driven]) -> String {
    let mut text = String::new();
    for drive in driven {
        let _ = writeln!(text, "{:<5} {}: {}", drive.word(), drive.scene.full_name(), drive.scene.title);
        for row in &drive.rows {
            let mark = if row.passed { " " } else { "!" };
            let _ = writeln!(text, "    {mark} {}: {}  ({})", row.what, row.found, row.wanted);
        }
    }
    text
}

/// The sums, what is known and what is new.
#[must_use]
pub fn summary(driven: &[Driven]) -> String {
    let demands: usize = driven.iter().map(|drive| drive.rows.len()).sum();
    let mut text = format!("{} scenarios, {demands} demands\n", driven.len());
    for (standing, word) in [
        (Standing::Met, "everything as demanded"),
        (Standing::Known, "not as demanded, known"),
        (Standing::NotMet, "NOT as demanded"),
        (Standing::Cured, "as demanded, and its file says that it is not: take `known` out"),
    ] {
        let of_it: Vec<&Driven> = driven.iter().filter(|drive| drive.standing() == standing).collect();
        if of_it.is_empty() {
            continue;
        }
        let _ = writeln!(text, "{:>4} {word}", of_it.len());
        for drive in of_it.iter().filter(|_| standing != Standing::Met) {
            let known = drive.scene.expected.known.as_deref().unwrap_or_default();
            let _ = writeln!(text, "     {}: {known}", drive.scene.full_name());
        }
    }
    text
}
