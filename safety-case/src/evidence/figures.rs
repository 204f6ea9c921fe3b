//! Tables of the documents that follow from the records: written between marks, and compared at each check.
//!
//! Only records that are committed stand in them, so that they are the same on every machine.

use std::path::Path;

use super::records::{COMMITTED, Standing, State};
use crate::error::{ToolError, read};
use crate::number::grouped;

/// Documents that have such tables.
pub const DOCUMENTS: [&str; 2] = ["README.md", "safety-case/README.md"];
/// Where the claims of the independent oracle stand.
const ORACLE: &str = "tests/tests/oracle";
const END: &str = "<!-- end of evidence -->";

/// A table, by its name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Block {
    /// Its name.
    pub name: &'static str,
    /// What stands between the marks, the marks included.
    pub text: String,
}

fn begin(name: &str) -> String {
    format!("<!-- evidence {name}: written by `supervise evidence --write` -->")
}

/// Every table.
///
/// # Errors
/// The oracle cannot be read.
pub fn blocks(root: &Path, standings: &[Standing]) -> Result<Vec<Block>, ToolError> {
    let block = |name, table: String| Block { name, text: format!("{}\n{table}{END}", begin(name)) };
    Ok(vec![
        block("attacks", attacks(standings, claims(root)?)),
        block("records", records(standings)),
        block("target", target(standings)),
    ])
}

/// The text with every table in it replaced; and whether it has any.
#[must_use]
pub fn replaced(text: &str, blocks: &[Block]) -> (String, bool) {
    let (mut text, mut any) = (text.to_owned(), false);
    for block in blocks {
        let Some((before, rest)) = text.split_once(&begin(block.name)) else { continue };
        let Some((_, after)) = rest.split_once(END) else { continue };
        text = format!("{before}{}{after}", block.text);
        any = true;
    }
    (text, any)
}

/// How many claims the oracle has; none without it.
fn claims(root: &Path) -> Result<usize, ToolError> {
    let mut count = 0_usize;
    let walk = walkdir::WalkDir::new(root.join(ORACLE)).sort_by_file_name();
    for entry in walk.into_iter().filter_map(Result::ok).filter(|entry| entry.file_type().is_file()) {
        let text = read(entry.path())?;
        // `Claim { id: ..`, on one line or on two; the declaration has no value.
        let claims = text.split("Claim {").skip(1).filter(|rest| rest.trim_start().starts_with("id: \""));
        count = count.saturating_add(claims.count());
    }
    Ok(count)
}

/// What stands before the figures of a record that is not fresh.
fn state(standing: Option<&Standing>, absent: &str, said: impl FnOnce(&Standing) -> String) -> String {
    match standing {
        Some(standing) => match &standing.state {
            State::Fresh => said(standing),
            State::Stale { changed } => format!("**stale** ({} changed since): {}", changed.join(", "), said(standing)),
            State::NotRun => absent.to_owned(),
        },
        None => absent.to_owned(),
    }
}

fn attacks(standings: &[Standing], claims: usize) -> String {
    let of = |name: &str| standings.iter().find(|standing| standing.name == name);
    let mut text = "| attack | what came of it |\n|---|---|\n".to_owned();
    let mut row = |attack: &str, came: &str| {
        text.push_str("| ");
        text.push_str(attack);
        text.push_str(" | ");
        text.push_str(came);
        text.push_str(" |\n");
    };
    let get = |standing: &Standing, name: &str| standing.get(name).unwrap_or("?").to_owned();
    let faults = of("inject").map_or("?".to_owned(), |standing| get(standing, "faults"));
    let drives = of("inject").map_or("?".to_owned(), |standing| get(standing, "drives"));
    row(
        &format!(
            "{faults} faults of main controller, frames, sensors, actuators, clock, memory, power, in {drives} correct drives at random times (`inject`)"
        ),
        &state(of("inject"), "**not run**", |standing| {
            let get = |name| get(standing, name);
            format!(
                "of {} dangerous runs of faults that are to be detected {} averted and {} reported in time, {} late, {} missed; {} false interventions in the drives without a fault; faults against their expectation: {}, and {} more that are known; {} were never dangerous; residual ones have an assumption of use",
                get("dangerous"),
                get("averted"),
                get("reported"),
                get("late"),
                get("missed"),
                get("interventions"),
                get("against"),
                get("known"),
                get("not_shown"),
            )
        }),
    );
    row(
        "an oracle that shares nothing with the core, over random drives and a fuzz target (`tests/tests/oracle`)",
        &format!(
            "{claims} claims over the whole past; what it found wrong is cured, where rows contradict each other readings are decided (`oracle/findings.rs`)"
        ),
    );
    row(
        "every test at once, instrumented (`coverage`)",
        &state(of("coverage"), "**not run**", |standing| {
            let get = |name| get(standing, name);
            format!(
                "`decide` and `vet`: statements {}, branches {}, MC/DC {}; {} items are open, each listed with its reason",
                get("statements"),
                get("branches"),
                get("conditions"),
                get("open"),
            )
        }),
    );
    row(
        "mistakes planted in the shipped code, against the proofs alone (`mistakes`)",
        &state(of("mistakes"), "**not run**", |standing| {
            let get = |name| get(standing, name);
            format!(
                "{} of {} caught by a proof; {} changes nothing that goes out, and says why; of {} drawn ones {} caught, the others stand in `proofs/README.md`",
                get("caught"),
                get("named"),
                get("surviving"),
                get("drawn"),
                get("drawn_caught"),
            )
        }),
    );
    row(
        "mutants of the shipped crates against the tests (`mutants`)",
        &state(of("mutants"), "**no record yet**: nothing is claimed", |standing| {
            let get = |name| get(standing, name);
            format!(
                "of {} listed {} have an outcome: {} caught, {} proved by Kani to change nothing, {} survived ({} with a reason why nothing changes), {} do not compile",
                get("listed"),
                get("run"),
                get("caught"),
                get("equal"),
                get("survived"),
                get("explained"),
                get("unviable"),
            )
        }),
    );
    row(
        "fuzzed command streams, frames, logs and mappings (`fuzz`)",
        &state(of("fuzz"), "the committed corpus, in every `cargo test`; **no campaign is recorded**", fuzzed),
    );
    row(
        "scenarios of the sources, of UN R131 as it is quoted, and of our own, in closed loop (`simulate --all`)",
        &state(of("simulate"), "**not run**", scenarios),
    );
    row(
        "a correct main controller on a busy and noisy bus, and ordinary driving, simulated: is anybody disturbed? (`disturb`)",
        &state(of("disturb"), "**not run**", disturbed),
    );
    text
}

fn fuzzed(standing: &Standing) -> String {
    let short = match standing.open.as_slice() {
        [] => "both are shown".to_owned(),
        open => format!("**short of that** is {}", open.join(", ")),
    };
    format!(
        "{} vetted cycles in {} inputs, {} of them broke something; the design asks for a billion cycles, and for half an hour without a new edge of each target: {short}",
        sum(standing, ".cycles"),
        sum(standing, ".inputs"),
        sum(standing, ".found"),
    )
}

fn scenarios(standing: &Standing) -> String {
    let get = |name| standing.get(name).unwrap_or("?");
    format!(
        "of {} variants {} as demanded, {} known not to be, {} not as expected; not as demanded: {}",
        get("variants"),
        get("as_demanded"),
        get("known_not_to"),
        get("not_as_expected"),
        standing
            .open
            .iter()
            .map(|open| format!("`{}`", open.split(':').next().unwrap_or_default()))
            .collect::<Vec<_>>()
            .join(", "),
    )
}

/// What QEMU shows of the target, and what of it is above its bar.
fn target(standings: &[Standing]) -> String {
    let standing = standings.iter().find(|standing| standing.name == "target");
    let figures = standing.into_iter().flat_map(|standing| &standing.figures).map(|figure| {
        let value = figure.value.parse().map_or_else(|_| figure.value.clone(), grouped);
        format!("| {} | {value} |\n", figure.what)
    });
    let above = state(standing, "not run", |standing| match standing.open.as_slice() {
        [] => "none".to_owned(),
        open => open.join("; "),
    });
    let last = format!("| **bars of the design that are not met** | {above} |\n");
    let head = "| on the target | what came of it |\n|---|---|\n".to_owned();
    [head].into_iter().chain(figures).chain([last]).collect()
}

fn disturbed(standing: &Standing) -> String {
    let get = |name| standing.get(name).unwrap_or("?");
    format!(
        "of {} runs {} disturbed, warnings apart; {} levels without a cause, {} collisions; {} times braked in {} m of ordinary driving: **the law of the sources is too early there**, see `disturb --check`",
        get("runs"),
        get("disturbed"),
        get("false_triggers"),
        get("collisions"),
        get("braked"),
        get("metres"),
    )
}

/// The figures as they are.
fn listed(standing: &Standing) -> String {
    standing.figures.iter().map(|figure| format!("{}: {}", figure.what, figure.value)).collect::<Vec<_>>().join("; ")
}

/// The sum of the figures whose names end so, grouped.
fn sum(standing: &Standing, end: &str) -> String {
    let numbers = standing.figures.iter().filter(|figure| figure.name.ends_with(end));
    let all = numbers.filter_map(|figure| figure.value.parse::<u64>().ok());
    grouped(all.fold(0, u64::saturating_add))
}

fn records(standings: &[Standing]) -> String {
    let mut text = "| record | stands | says | made by |\n|---|---|---|---|\n".to_owned();
    for name in COMMITTED {
        let Some(standing) = standings.iter().find(|standing| standing.name == name) else { continue };
        let stands = match &standing.state {
            State::Fresh => "of these sources".to_owned(),
            State::Stale { changed } => format!("**stale**: {} changed", changed.join(", ")),
            State::NotRun => "**not run**".to_owned(),
        };
        let says = if standing.figures.is_empty() { "–".to_owned() } else { listed(standing) };
        let row = format!("| {} | {stands} | {says} | `{}` |\n", standing.title, standing.command);
        text.push_str(&row);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::{Block, END, begin, replaced};

    #[test]
    fn a_table_is_written_between_its_marks_and_only_there() {
        let block = Block { name: "records", text: format!("{}\nnew\n{END}", begin("records")) };
        let text = format!("head\n{}\nold\n{END}\ntail\n", begin("records"));
        let (once, any) = replaced(&text, std::slice::from_ref(&block));
        assert!(any && once.contains("\nnew\n") && !once.contains("old"), "{once}");
        assert!(once.starts_with("head\n") && once.ends_with("tail\n"));
        assert_eq!(replaced(&once, std::slice::from_ref(&block)).0, once);
        assert_eq!(replaced("nothing", &[block]), ("nothing".to_owned(), false));
    }
}
