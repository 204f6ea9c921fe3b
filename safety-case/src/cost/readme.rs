//! The rows that the README shows, and whether it still tells the truth.

use super::table::{GROWING, RANDOM};
use super::{Row, Size};

/// Where the rows begin.
const BEGIN: &str = "<!-- cost: written by `supervise cost --write` -->";
/// Where they end.
const END: &str = "<!-- end of cost -->";
/// How far a count may be from the one that is shown, in per cent.
const TOLERANCE: u64 = 3;

/// A row: what, the bar of the design, the number measured.
pub type Shown = (String, Option<u64>, u64);

/// A row of the README that does not say what was measured.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Difference {
    /// The file has no place for the rows.
    NoPlace,
    /// The row is not there.
    Missing(String),
    /// It shows this, and that was measured.
    Number(String, u64, u64),
    /// It was not measured this time, so it was not compared.
    NotCompared(String),
}

/// The rows: what, the bar, the number measured.
#[must_use]
pub fn main_rows(rows: &[Row], sizes: &[(String, Vec<Size>)], retained: &[(&str, u64)]) -> Vec<Shown> {
    let of = |stage: &str| rows.iter().find(|row| row.stage == stage);
    let greatest = |stage: &str| of(stage).map_or(0, Row::greatest);
    let lists = |full: bool| {
        let counts = of("whole step").into_iter().flat_map(|row| &row.scenarios);
        let named = counts.filter(|(name, _)| name != RANDOM && !name.ends_with(GROWING));
        let chosen = named.filter(|(name, _)| name.contains("full lists") == full);
        chosen.map(|(_, count)| *count).max().unwrap_or(0)
    };
    let single = rows.iter().filter(|row| row.stage.starts_with("vet_")).map(Row::greatest).max().unwrap_or(0);
    let text = |what: &str| what.to_owned();
    let mut all = vec![
        (text("`decide` and `vet`, all channels"), Some(6_000), greatest("decide + vet")),
        (text("dearest single `vet_*`"), Some(300), single),
        (text("whole step, 32 radar and 16 camera objects"), Some(60_000), lists(true)),
        (text("whole step, no object"), None, lists(false)),
        (text("state: decode and check"), None, greatest("image decode")),
        (text("state: encode"), None, greatest("image encode")),
        (text("configuration: digest"), None, greatest("sealed digest")),
        (text("link: one frame received"), None, greatest("wire receive, one frame")),
        (text("link: one sample"), None, greatest("wire sample")),
        (text("link: every channel sent"), None, greatest("wire send, all channels")),
    ];
    for (target, sizes) in sizes {
        let linked = sizes.last().map_or(0, |size| size.text.saturating_add(size.rodata));
        let bar = if target.starts_with("thumb") { Some(24 * 1024) } else { None };
        all.push((format!("bytes of code and constants, `Supervisor::step` linked alone, {target}"), bar, linked));
    }
    for (name, bar) in [("`Supervisor`", Some(4 * 1024)), ("`Supervisor` with its link", None)] {
        let bytes = retained.iter().find(|(what, _)| *what == name).map_or(0, |(_, bytes)| *bytes);
        all.push((format!("bytes retained, {name}"), bar, bytes));
    }
    all
}

/// "13 946".
fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (index, digit) in digits.chars().enumerate() {
        if index > 0 && digits.len().saturating_sub(index).is_multiple_of(3) {
            text.push(' ');
        }
        text.push(digit);
    }
    text
}

fn line(what: &str, bar: Option<u64>, number: u64) -> String {
    let bar = bar.map_or_else(|| "–".to_owned(), |bar| format!("≤ {}", grouped(bar)));
    format!("| {what} | {bar} | {} |", grouped(number))
}

/// What stands between the marks: what was measured now, and of what was not, what `before` says.
#[must_use]
pub fn block(rows: &[Shown], compiler: &str, before: &str) -> String {
    let mut text = format!("{BEGIN}\n| greatest of all scenarios | bar | measured, {compiler} |\n|---|---|---|\n");
    for (what, bar, number) in rows {
        text.push_str(&line(what, *bar, *number));
        text.push('\n');
    }
    for (_, line) in shown(before).filter(|(what, _)| !rows.iter().any(|(name, ..)| name == what)) {
        text.push_str(line);
        text.push('\n');
    }
    text.push_str(END);
    text
}

/// The rows that stand in a text: name, and the whole line.
fn shown(text: &str) -> impl Iterator<Item = (&str, &str)> {
    let lines = text.split_once(BEGIN).and_then(|(_, rest)| rest.split_once(END)).map_or("", |(block, _)| block);
    // The first two lines are the head.
    lines.lines().filter(|line| line.starts_with("| ")).skip(1).filter_map(|line| {
        let what = line.strip_prefix("| ")?.split(" | ").next()?;
        Some((what, line))
    })
}

fn number(line: &str) -> Option<u64> {
    let cell = line.trim_end_matches('|').rsplit('|').next()?;
    cell.chars().filter(|char| !char.is_whitespace()).collect::<String>().parse().ok()
}

/// The text with the block replaced; `None` if it has no place for it.
#[must_use]
pub fn replaced(text: &str, block: &str) -> Option<String> {
    let (before, rest) = text.split_once(BEGIN)?;
    let (_, after) = rest.split_once(END)?;
    Some(format!("{before}{block}{after}"))
}

/// Where the text does not say what was measured. Numbers of another compiler are not compared.
#[must_use]
pub fn differences(text: &str, rows: &[Shown], compiler: &str) -> Vec<Difference> {
    let Some((_, rest)) = text.split_once(BEGIN) else { return vec![Difference::NoPlace] };
    let same = rest.split_once(END).is_some_and(|(block, _)| block.contains(compiler));
    let mut all = Vec::new();
    for (what, _, measured) in rows {
        let Some((_, line)) = shown(text).find(|(name, _)| name == what) else {
            all.push(Difference::Missing(what.clone()));
            continue;
        };
        let shown = number(line).unwrap_or(0);
        let far = measured.abs_diff(shown).saturating_mul(100) > shown.saturating_mul(TOLERANCE);
        if !same {
            all.push(Difference::NotCompared(what.clone()));
        } else if far {
            all.push(Difference::Number(what.clone(), shown, *measured));
        }
    }
    let others = shown(text).filter(|(what, _)| !rows.iter().any(|(name, ..)| name == what));
    all.extend(others.map(|(what, _)| Difference::NotCompared(what.to_owned())));
    all
}

#[cfg(test)]
mod tests {
    use super::{BEGIN, Difference, END, Shown, block, differences, replaced};

    fn rows(number: u64) -> Vec<Shown> {
        vec![("the whole".to_owned(), Some(60_000), number)]
    }

    #[test]
    fn a_written_block_has_no_difference_and_another_number_has() {
        let empty = format!("head\n{BEGIN}\n{END}\ntail\n");
        assert_eq!(differences(&empty, &rows(13_946), "rustc 1"), [Difference::Missing("the whole".to_owned())]);
        let Some(text) = replaced(&empty, &block(&rows(13_946), "rustc 1", &empty)) else {
            unreachable!("it has a place")
        };
        assert!(
            text.starts_with("head\n") && text.ends_with("tail\n") && text.contains("| ≤ 60 000 | 13 946 |"),
            "{text}"
        );
        assert_eq!(differences(&text, &rows(13_946), "rustc 1"), []);
        assert_eq!(differences(&text, &rows(14_300), "rustc 1"), [], "within the tolerance");
        let far = Difference::Number("the whole".to_owned(), 13_946, 14_400);
        assert_eq!(differences(&text, &rows(14_400), "rustc 1"), [far]);
        assert_eq!(
            differences(&text, &rows(99_999), "rustc 2"),
            [Difference::NotCompared("the whole".to_owned())],
            "another compiler gives other numbers"
        );
    }

    #[test]
    fn what_was_not_measured_now_stays_and_is_not_compared() {
        let empty = format!("{BEGIN}\n{END}");
        let Some(text) = replaced(&empty, &block(&rows(5), "rustc 1", &empty)) else { unreachable!("it has a place") };
        let other = vec![("another".to_owned(), None, 7)];
        let Some(text) = replaced(&text, &block(&other, "rustc 1", &text)) else { unreachable!("it has a place") };
        assert!(text.contains("| the whole |") && text.contains("| another |"), "{text}");
        assert_eq!(differences(&text, &other, "rustc 1"), [Difference::NotCompared("the whole".to_owned())]);
        assert_eq!(differences("nothing", &other, "rustc 1"), [Difference::NoPlace]);
        assert_eq!(replaced("nothing", "x"), None);
    }
}
