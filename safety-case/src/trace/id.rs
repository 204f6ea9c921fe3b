//! Ids of requirements as they stand in text: one demand, a group, a list, a range.

use std::fmt;

/// `SEAT-5a`, one demand, or `SEAT-5`, the group of all its demands.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Id {
    /// `SEAT`.
    pub area: String,
    /// 5.
    pub number: u32,
    /// `a`; without it, the group.
    pub letter: Option<char>,
}

impl fmt::Display for Id {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}-{}", self.area, self.number)?;
        self.letter.map_or(Ok(()), |letter| write!(f, "{letter}"))
    }
}

impl Id {
    /// The id that the whole text is.
    #[must_use]
    pub fn parse(text: &str) -> Option<Self> {
        let (area, rest) = text.get(..shape(text)?).filter(|whole| *whole == text)?.split_once('-')?;
        let number = rest.trim_end_matches(|last: char| last.is_ascii_lowercase());
        let mut letters = rest.get(number.len()..)?.chars();
        let (letter, more) = (letters.next(), letters.next());
        let padded = number.len() > 1 && number.starts_with('0');
        (more.is_none() && !padded).then_some(())?;
        Some(Self { area: area.to_owned(), number: number.parse().ok()?, letter })
    }

    /// Its group: itself without the letter.
    #[must_use]
    pub fn group(&self) -> Self {
        Self { letter: None, ..self.clone() }
    }
}

/// How many bytes at the start of the text have the form of an id, of whatever kind: capitals and digits, a hyphen, a
/// number, small letters. Readings, `R-` and small letters, have it too.
fn shape(text: &str) -> Option<usize> {
    let run = |text: &str, of: fn(&char) -> bool| text.chars().take_while(of).map(char::len_utf8).sum::<usize>();
    let area = run(text, |c| c.is_ascii_uppercase() || c.is_ascii_digit());
    let rest = text.get(area..)?.strip_prefix('-')?;
    let digits = run(rest, char::is_ascii_digit);
    let letters = run(rest.get(digits..)?, char::is_ascii_lowercase);
    let end = area + 1 + digits + letters;
    let reading = text.starts_with("R-") && letters == 1;
    let goes_on = text.get(end..)?.starts_with(|next: char| next.is_alphanumeric() || next == '_');
    let named = text.starts_with(|first: char| first.is_ascii_uppercase()) && (digits > 0 || reading);
    (named && !goes_on).then_some(end)
}

/// Everything in a text that has the form of an id, with the byte where it begins.
#[must_use]
pub fn named(text: &str) -> Vec<(usize, &str)> {
    let mut found = Vec::new();
    let mut before = ' ';
    let mut past = 0;
    for (at, c) in text.char_indices() {
        let begins = at >= past && !(before.is_alphanumeric() || before == '-' || before == '_');
        before = c;
        if let Some(length) = text.get(at..).filter(|_| begins).and_then(shape) {
            past = at + length;
            found.extend(text.get(at..past).map(|id| (at, id)));
        }
    }
    found
}

/// The ids of a list, ranges written out.
#[derive(Debug, Default, PartialEq, Eq)]
pub struct Listed {
    /// The ids.
    pub ids: Vec<Id>,
    /// Ranges that are none, as they are written.
    pub broken: Vec<String>,
}

/// The ids that a comment *begins* with: up to the first ": " or ". ". None if its first words are no id, as in
/// "MIT-6 speaks of mitigation".
#[must_use]
pub fn head(comment: &str) -> Listed {
    let comment = comment.trim();
    let end = [": ", ". ", ":\n", ".\n"].iter().filter_map(|end| comment.find(end)).min().unwrap_or(comment.len());
    let text = comment.get(..end).unwrap_or_default().trim_end_matches([':', '.']);
    let mut listed = Listed::default();
    if list(text, &mut listed) { listed } else { Listed::default() }
}

/// The ids that stand in parentheses, alone between the commas, as in "(S3 §2.4, SEAT-4)"; not those of a sentence.
#[must_use]
pub fn in_parentheses(comment: &str) -> Listed {
    let mut listed = Listed::default();
    for rest in comment.split('(').skip(1) {
        list(rest.split(')').next().unwrap_or_default(), &mut listed);
    }
    listed
}

/// Reads "SEAT-5a, SEAT-5b", "SEAT-5a to SEAT-5d", "SEAT-5a to d", "SEAT-5a, b", "SEAT-5a/b"; says whether it begins
/// with an id.
fn list(text: &str, into: &mut Listed) -> bool {
    let mut last = None;
    let mut begins = false;
    for (place, part) in text.split([',', ';', '/']).flat_map(|part| part.split(" and ")).enumerate() {
        let part = part.trim().trim_matches('`');
        last = match part.split_once(" to ").or_else(|| part.split_once('–')) {
            Some((from, to)) => one(from.trim(), last.as_ref()).and_then(|from| {
                let to = one(to.trim(), Some(&from))?;
                match between(&from, &to) {
                    Some(ids) => into.ids.extend(ids),
                    None => into.broken.push(part.to_owned()),
                }
                Some(to)
            }),
            None => one(part, last.as_ref()).inspect(|id| into.ids.push(id.clone())),
        };
        begins |= place == 0 && last.is_some();
    }
    begins
}

/// An id, or the letter of another demand of the group of `last`.
fn one(text: &str, last: Option<&Id>) -> Option<Id> {
    let mut chars = text.chars();
    let alone = chars.next().filter(|c| c.is_ascii_lowercase() && chars.next().is_none());
    match (alone, last) {
        (Some(letter), Some(last)) if last.letter.is_some() => Some(Id { letter: Some(letter), ..last.clone() }),
        _ => Id::parse(text),
    }
}

/// Every id from one to the other: demands of one group, or groups of one area, rising.
fn between(from: &Id, to: &Id) -> Option<Vec<Id>> {
    let id = |number, letter| Id { area: from.area.clone(), number, letter };
    (from.area == to.area && from < to).then_some(())?;
    match (from.letter, to.letter) {
        (Some(first), Some(last)) if from.number == to.number => {
            Some((first..=last).map(|letter| id(from.number, Some(letter))).collect())
        }
        (None, None) => Some((from.number..=to.number).map(|number| id(number, None)).collect()),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(listed: &Listed) -> String {
        listed.ids.iter().map(ToString::to_string).collect::<Vec<_>>().join(" ")
    }

    #[test]
    fn ids_are_told_from_what_only_looks_like_one() {
        let found = |text| named(text).into_iter().map(|(_, id)| id).collect::<Vec<_>>();
        assert_eq!(found("SEAT-5a's, `E2E-1j`; (MIT-4) AOU-01 R-b"), ["SEAT-5a", "E2E-1j", "MIT-4", "AOU-01", "R-b"]);
        assert_eq!(found("seat-5 26262-3 K1 S3 SEAT- SEAT-5_x SEAT-5X a-SEAT-5 R-bc"), [""; 0]);
        assert_eq!(Id::parse("SEAT-5a").map(|id| (id.number, id.letter)), Some((5, Some('a'))));
        for wrong in ["SEAT-5ab", "SG-05", "SEAT-5a ", "R-b", "", "SEAT-99999999999"] {
            assert_eq!(Id::parse(wrong), None, "{wrong}");
        }
    }

    #[test]
    fn a_head_is_a_list_at_the_start() {
        for (text, ids) in [
            ("SEAT-5a: never", "SEAT-5a"),
            ("SEAT-5a, SEAT-5c: never", "SEAT-5a SEAT-5c"),
            ("SEAT-5a to SEAT-5d: never", "SEAT-5a SEAT-5b SEAT-5c SEAT-5d"),
            ("SEAT-5a, c to d: never", "SEAT-5a SEAT-5c SEAT-5d"),
            ("MIT-4a, b and MIT-5a. Never, MIT-7a", "MIT-4a MIT-4b MIT-5a"),
            ("EPB-1b/c", "EPB-1b EPB-1c"),
            ("MIT-1 to MIT-3: levels", "MIT-1 MIT-2 MIT-3"),
            ("STR-2b, S4 6.3.2, 6.3.9: every end", "STR-2b"),
            ("MIT-6 speaks of mitigation: SEAT-5a", ""),
            ("never: SEAT-5a", ""),
            ("SEAT-5c, a refused release: none", "SEAT-5c"),
        ] {
            assert_eq!(words(&head(text)), ids, "{text}");
        }
    }

    #[test]
    fn parentheses_hold_ids_alone() {
        assert_eq!(
            words(&in_parentheses("who? (S3 §2.4, SEAT-4, MIT-1 to MIT-2), (SELF-9).")),
            "SEAT-4 MIT-1 MIT-2 SELF-9"
        );
        assert_eq!(words(&in_parentheses("none (SELF-7 clears it)")), "");
    }

    #[test]
    fn a_range_that_is_none_is_named() {
        for text in ["SEAT-5d to SEAT-5a", "SEAT-5a to MIT-5d", "SEAT-5 to SEAT-6a", "SEAT-5a to SEAT-6b"] {
            assert_eq!(head(text).broken, [text], "{text}");
        }
    }
}
