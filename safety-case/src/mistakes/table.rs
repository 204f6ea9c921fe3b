//! The score and its table, in Markdown.

use std::collections::BTreeSet;

use super::check::word;
use super::list::List;
use super::record::{Entry, Outcome, Record};
use crate::prove::Sources;

/// Where the table begins.
const BEGIN: &str = "<!-- mistakes: written by `supervise mistakes --write` -->";
/// Where it ends.
const END: &str = "<!-- end of mistakes -->";

/// How many of so many.
struct Score {
    caught: usize,
    of: usize,
}

impl Score {
    /// A catch counts where its harness is proved without the mistake.
    fn of<'a>(entries: impl Iterator<Item = &'a Entry> + Clone, proved: &BTreeSet<String>) -> Self {
        let real = entries.filter(|entry| entry.outcome.is_mistake());
        let counts =
            |entry: &&Entry| matches!(&entry.outcome, Outcome::Caught { harness, .. } if proved.contains(harness));
        let caught = real.clone().filter(counts).count();
        Self { caught, of: real.count() }
    }
}

/// What stands between the marks: what the record says of the list, the marks included.
///
/// Only what ran on these sources counts.
#[must_use]
pub fn block(list: &List, record: &Record, sources: &Sources, proved: &BTreeSet<String>) -> String {
    let mut lines = vec![BEGIN.to_owned()];
    let named: Vec<&Entry> = record.named.iter().filter(|entry| entry.is_current(sources)).collect();
    let score = Score::of(named.iter().copied(), proved);
    let known = list.mistake.iter().filter(|mistake| mistake.survives.is_some()).count();
    lines.push(format!(
        "{} of {} named mistakes are caught by a proof alone, without any test{}.",
        score.caught,
        list.mistake.len(),
        if known == 0 { String::new() } else { format!("; {known} survive, and are known to") }
    ));
    lines.extend(
        ["", "| mistake | what it would do in the bus | caught by | s |", "|---|---|---|---|"].map(str::to_owned),
    );
    for mistake in &list.mistake {
        let entry = named.iter().find(|entry| entry.name == mistake.name);
        let (by, seconds) = match (entry, &mistake.survives) {
            (_, Some(why)) => (format!("**survives**: {why}"), String::new()),
            (None, None) => ("**not run on these sources**".to_owned(), String::new()),
            (Some(entry), None) => (by(&entry.outcome, proved), entry.seconds.to_string()),
        };
        lines.push(format!("| `{}` | {} | {by} | {seconds} |", mistake.name, cell(&mistake.what)));
    }
    drawn(list, record, sources, proved, &mut lines);
    lines.push(END.to_owned());
    lines.join("\n")
}

fn drawn(list: &List, record: &Record, sources: &Sources, proved: &BTreeSet<String>, lines: &mut Vec<String>) {
    let run: Vec<&Entry> = record.drawn.mistakes.iter().filter(|entry| entry.is_current(sources)).collect();
    let score = Score::of(run.iter().copied(), proved);
    lines.push(String::new());
    if score.of == 0 {
        lines.push("Drawn mistakes: **not run on these sources**.".to_owned());
        return;
    }
    lines.push(format!(
        "Of {} drawn by seed {} from the {} that cargo-mutants lists for `{}` ({} more do not compile), {} are caught and {} \
         survive the proofs:",
        score.of,
        record.drawn.seed,
        record.drawn.of,
        list.drawn.package,
        run.len().saturating_sub(score.of),
        score.caught,
        score.of.saturating_sub(score.caught),
    ));
    lines.push(String::new());
    let survivors: Vec<&&Entry> =
        run.iter().filter(|entry| entry.outcome.is_mistake() && !entry.outcome.is_caught()).collect();
    if !survivors.is_empty() {
        lines.extend(["| survivor | | why |", "|---|---|---|"].map(str::to_owned));
    }
    for entry in survivors {
        let why = list.explained.iter().find(|explained| explained.mutation == entry.name);
        let why = why.map_or("**not explained**", |explained| explained.why.as_str());
        lines.push(format!("| `{}` | {} | {} |", cell(&entry.name), word(&entry.outcome), cell(why)));
    }
}

fn by(outcome: &Outcome, proved: &BTreeSet<String>) -> String {
    match outcome {
        Outcome::Caught { harness, .. } if !proved.contains(harness) => format!("`{harness}`, **itself not proved**"),
        Outcome::Caught { harness, .. } => format!("`{harness}`"),
        other @ (Outcome::Survived | Outcome::Undecided | Outcome::DoesNotCompile { .. }) => {
            format!("**{}**", word(other))
        }
    }
}

/// A bar would end the cell.
fn cell(text: &str) -> String {
    text.replace('|', "\\|")
}

/// The text with the block replaced; `None` if it has no place for it.
#[must_use]
pub fn replaced(text: &str, block: &str) -> Option<String> {
    let (before, rest) = text.split_once(BEGIN)?;
    let (_, after) = rest.split_once(END)?;
    Some(format!("{before}{block}{after}"))
}

#[cfg(test)]
mod tests {
    use super::{BEGIN, END, block, replaced};
    use crate::mistakes::{Drawn, Entry, List, Mistake, Outcome, Record};
    use crate::prove::Sources;

    fn entry(name: &str, outcome: Outcome, sources: &str) -> Entry {
        let text = str::to_owned;
        Entry { name: text(name), change: text(""), outcome, tried: Vec::new(), seconds: 9, sources: text(sources) }
    }

    fn mistake(name: &str, survives: Option<&str>) -> Mistake {
        let text = str::to_owned;
        Mistake {
            name: text(name),
            what: text("It rolls | away."),
            file: text("f"),
            find: text("a"),
            replace: text("b"),
            harness: Vec::new(),
            assertion: None,
            requirements: Vec::new(),
            survives: survives.map(text),
        }
    }

    fn caught() -> Outcome {
        Outcome::Caught { harness: "seat_5".to_owned(), check: "c".to_owned() }
    }

    #[test]
    fn only_what_ran_on_these_sources_counts() {
        let drawn = Drawn { seed: 7, count: 2, package: "core".to_owned(), within: 1 };
        let mistake = vec![mistake("one", None), mistake("two", None), mistake("three", Some("no harness"))];
        let list = List { drawn, module: Vec::new(), explained: Vec::new(), mistake };
        let named = vec![entry("one", caught(), "now"), entry("two", caught(), "before")];
        let mut record = Record { named, ..Record::default() };
        (record.drawn.seed, record.drawn.of) = (7, 725);
        let error = "e".to_owned();
        record.drawn.mistakes = vec![
            entry("a || b", Outcome::Survived, "now"),
            entry("c", caught(), "now"),
            entry("d", Outcome::DoesNotCompile { error }, "now"),
        ];
        let proved = std::collections::BTreeSet::from(["seat_5".to_owned()]);
        let text = block(&list, &record, &Sources::same("now"), &proved);
        for part in [
            "1 of 3 named mistakes are caught by a proof alone, without any test; 1 survive, and are known to.",
            "| `one` | It rolls \\| away. | `seat_5` | 9 |",
            "| `two` | It rolls \\| away. | **not run on these sources** |  |",
            "| `three` | It rolls \\| away. | **survives**: no harness |  |",
            "Of 2 drawn by seed 7 from the 725",
            "(1 more do not compile), 1 are caught",
            "| `a \\|\\| b` | survived | **not explained** |",
        ] {
            assert!(text.contains(part), "{part}:\n{text}");
        }
        assert!(block(&list, &record, &Sources::same("later"), &proved).contains("0 of 3"));
        let unproved = block(&list, &record, &Sources::same("now"), &std::collections::BTreeSet::new());
        assert!(
            unproved.contains("0 of 3") && unproved.contains("| `seat_5`, **itself not proved** | 9 |"),
            "{unproved}"
        );
        let page = format!("head\n{BEGIN}\nold\n{END}\ntail");
        assert_eq!(replaced(&page, &text), Some(format!("head\n{text}\ntail")));
        assert_eq!(replaced("nothing", &text), None);
    }
}
