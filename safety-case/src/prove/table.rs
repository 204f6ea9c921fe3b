//! The table of `proofs/README.md`, made from the record.

use super::harness::{Checks, Harness, List};
use super::judge::Verdict;
use super::record::Record;

/// Where the table begins.
const BEGIN: &str = "<!-- proofs: written by `supervise prove --table --write` -->";
/// Where it ends.
const END: &str = "<!-- end of proofs -->";
/// How the extent of an exhaustive harness begins.
const EXHAUSTIVE: &str = "exhaustive";

/// The claim that a harness makes, as far as the record goes.
#[must_use]
pub fn claim(harness: &Harness, record: &Record) -> String {
    if let Some(why) = &harness.open {
        return format!("open: {why}");
    }
    let Some(proof) = record.of(&harness.name) else { return "open: stated, not run".to_owned() };
    match &proof.verdict {
        Verdict::Proved => match harness.extent.strip_prefix(EXHAUSTIVE) {
            Some(rest) => format!("proved for all inputs and time{rest}"),
            None => {
                match harness.extent.strip_prefix("bounded").map(|bound| bound.trim_matches([' ', ':', '(', ')', ',']))
                {
                    Some("") | None => format!("bounded ({})", harness.extent),
                    Some(bound) => format!("bounded ({bound})"),
                }
            }
        },
        Verdict::Failed(_) => "open: failed".to_owned(),
        Verdict::Vacuous(_) => "open: vacuous".to_owned(),
        Verdict::Undetermined(_) => "open: undetermined".to_owned(),
    }
}

/// The table in Markdown.
#[must_use]
pub fn table(list: &List, record: &Record) -> String {
    let mut lines = vec![
        "| harness | requirements | claim | solver | seconds | checks / covers |".to_owned(),
        "|---|---|---|---|---|---|".to_owned(),
    ];
    for harness in &list.harness {
        let (solver, seconds, counts) = match record.of(&harness.name) {
            Some(proof) => (
                proof.solver.to_string(),
                proof.seconds.to_string(),
                format!(
                    "{}{} / {}",
                    proof.checks,
                    if proof.decides == Checks::Own { " own" } else { "" },
                    proof.covers
                ),
            ),
            None => ("–".to_owned(), "–".to_owned(), "–".to_owned()),
        };
        let claim = claim(harness, record).replace('|', "\\|");
        let requirements = harness.requirements.join(", ");
        lines.push(format!("| `{}` | {requirements} | {claim} | {solver} | {seconds} | {counts} |", harness.name));
    }
    let proved = |harness: &&Harness| {
        let verdict = record.of(&harness.name).map(|proof| &proof.verdict);
        harness.open.is_none() && verdict == Some(&Verdict::Proved)
    };
    let exhaustive = |harness: &&Harness| harness.extent.starts_with(EXHAUSTIVE);
    let all = list.harness.iter().filter(proved);
    let (time, bounded) = (all.clone().filter(exhaustive).count(), all.filter(|harness| !exhaustive(harness)).count());
    let open = list.harness.len().saturating_sub(time).saturating_sub(bounded);
    let seconds: u64 = record.proofs.iter().map(|proof| proof.seconds).sum();
    lines.push(String::new());
    lines.push(format!(
        "{} harnesses: {time} proved for all inputs and time, {bounded} bounded, {open} open. {} minutes on one core.",
        list.harness.len(),
        seconds.div_ceil(60),
    ));
    for tools in tools(record) {
        lines.push(format!("Tools: {tools}."));
    }
    lines.join("\n") + "\n"
}

/// The tools of the record, each set once.
fn tools(record: &Record) -> Vec<String> {
    let mut all: Vec<String> = Vec::new();
    for tools in record.proofs.iter().map(|proof| &proof.tools) {
        let line = format!("Kani {}, {}, CBMC {}", tools.kani, tools.rustc, tools.cbmc);
        if !all.contains(&line) {
            all.push(line);
        }
    }
    all
}

/// What stands between the marks, the marks included.
#[must_use]
pub fn block(list: &List, record: &Record) -> String {
    format!("{BEGIN}\n{}{END}", table(list, record))
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
    use super::super::record::Proof;
    use super::super::record::tests::{list, proof};
    use super::*;

    #[test]
    fn the_table_claims_no_more_than_the_record() -> Result<(), Box<dyn std::error::Error>> {
        let mut list = list(&["all", "some", "default", "failed", "new", "known"])?;
        let mut record = Record::default();
        for harness in &mut list.harness {
            match harness.name.as_str() {
                "some" => "bounded: four objects".clone_into(&mut harness.extent),
                "default" => "exhaustive for the default retarder".clone_into(&mut harness.extent),
                "known" => harness.open = Some("a | b".to_owned()),
                _ => {}
            }
        }
        for name in ["all", "some", "default", "known"] {
            record.put(proof(name, 61), &list);
        }
        record.put(Proof { verdict: Verdict::Failed("x".to_owned()), ..proof("failed", 61) }, &list);
        let text = table(&list, &record);
        for line in [
            "| `all` | SEAT-5a | proved for all inputs and time | kissat | 61 | 5 / 2 |",
            "| `some` | SEAT-5a | bounded (four objects) | kissat | 61 | 5 / 2 |",
            "| `default` | SEAT-5a | proved for all inputs and time for the default retarder | kissat | 61 | 5 / 2 |",
            "| `failed` | SEAT-5a | open: failed | kissat | 61 | 5 / 2 |",
            "| `new` | SEAT-5a | open: stated, not run | – | – | – |",
            "| `known` | SEAT-5a | open: a \\| b | kissat | 61 | 5 / 2 |",
            "6 harnesses: 2 proved for all inputs and time, 1 bounded, 3 open. 6 minutes on one core.",
        ] {
            assert!(text.lines().any(|found| found == line), "{line}\n{text}");
        }
        Ok(())
    }

    #[test]
    fn it_is_written_between_its_marks() -> Result<(), Box<dyn std::error::Error>> {
        let list = list(&["a"])?;
        let text = format!("head\n{BEGIN}\nold\n{END}\ntail\n");
        let block = block(&list, &Record::default());
        let once = replaced(&text, &block).ok_or("no place")?;
        assert!(
            once.starts_with("head\n") && once.ends_with("tail\n") && once.contains("| `a` |") && !once.contains("old")
        );
        assert_eq!(replaced(&once, &block), Some(once.clone()));
        assert_eq!(replaced("nothing", &block), None);
        Ok(())
    }
}
