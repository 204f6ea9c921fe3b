//! What there is to cover: every statement, branch, decision and condition of the instrumented sources.

use std::collections::BTreeSet;

use serde::{Deserialize, Serialize};

/// Where something stands.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Place {
    /// Path of the file from the root of the workspace.
    pub file: String,
    /// The line.
    pub line: usize,
    /// The function, with its type.
    pub function: String,
}

/// What a point is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Kind {
    /// A statement, the value of a block, or the body of a closure.
    Statement,
    /// An arm of a `match`, one way of `if let`, `let else` or `?`, or one outcome of a decision that branches.
    Branch,
    /// A condition of a decision, whose independent effect is to be shown.
    Condition,
}

impl Kind {
    /// In a word.
    #[must_use]
    pub const fn word(self) -> &'static str {
        match self {
            Self::Statement => "statement",
            Self::Branch => "branch",
            Self::Condition => "condition",
        }
    }
}

/// A place that is reached or not.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Point {
    /// Where.
    pub place: Place,
    /// What.
    pub kind: Kind,
    /// How it reads in the source.
    pub text: String,
}

/// How a decision is made of its conditions.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Tree {
    /// A condition, by its number.
    Leaf(usize),
    /// `!`
    Not(Box<Self>),
    /// `&&`
    All(Box<Self>, Box<Self>),
    /// `||`
    Any(Box<Self>, Box<Self>),
}

/// A boolean expression that is no part of a greater one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Decision {
    /// Where.
    pub place: Place,
    /// How it reads.
    pub text: String,
    /// Whether the flow branches by it: `if`, `while`, a guard, a permission, `then`.
    pub branches: bool,
    /// The line and the text of each condition.
    pub conditions: Vec<(usize, String)>,
    /// How they are joined.
    pub tree: Tree,
}

/// A combination of conditions with which a decision was evaluated: bit `n` is condition `n`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Vector {
    /// Evaluated, not passed over by `&&` or `||`.
    pub evaluated: u32,
    /// True.
    pub values: u32,
    /// What the decision came to.
    pub outcome: bool,
}

impl Vector {
    /// The value of a condition, if it was evaluated.
    #[must_use]
    pub fn value(&self, condition: usize) -> Option<bool> {
        let bit = |word: u32| u32::try_from(condition).ok().and_then(|by| word.checked_shr(by)).unwrap_or(0) & 1 == 1;
        bit(self.evaluated).then(|| bit(self.values))
    }
}

impl Decision {
    /// In letters, for people: `TF- → F`.
    #[must_use]
    pub fn letters(&self, vector: &Vector) -> String {
        let letter = |value| match value {
            Some(true) => 'T',
            Some(false) => 'F',
            None => '-',
        };
        let mut text: String = (0..self.conditions.len()).map(|number| letter(vector.value(number))).collect();
        text.push_str(" → ");
        text.push(letter(Some(vector.outcome)));
        text
    }

    /// The conditions whose independent effect these vectors show, by masking.
    #[must_use]
    pub fn shown(&self, vectors: &BTreeSet<Vector>) -> Vec<bool> {
        let mut shown = Vec::new();
        for condition in 0..self.conditions.len() {
            let with = |value| {
                vectors.iter().any(|vector| vector.value(condition) == Some(value) && self.counts(condition, vector))
            };
            shown.push(with(true) && with(false));
        }
        shown
    }

    /// The same by unique cause: two vectors with two outcomes that differ in this condition, and elsewhere only where
    /// one of them was not evaluated.
    #[must_use]
    pub fn shown_uniquely(&self, vectors: &BTreeSet<Vector>) -> Vec<bool> {
        let differ = |number: usize, one: &Vector, other: &Vector| {
            one.value(number).zip(other.value(number)).is_some_and(|(one, other)| one != other)
        };
        let of = |condition: usize| {
            vectors.iter().any(|one| {
                vectors.iter().any(|other| {
                    one.outcome != other.outcome
                        && differ(condition, one, other)
                        && (0..self.conditions.len()).all(|number| number == condition || !differ(number, one, other))
                })
            })
        };
        (0..self.conditions.len()).map(of).collect()
    }

    /// Whether the outcome of this vector is by this condition: nothing that was evaluated beside it masks it.
    fn counts(&self, condition: usize, vector: &Vector) -> bool {
        self.tree.counts(condition, vector).unwrap_or(false)
    }
}

impl Tree {
    /// What it comes to; `None` if nothing of it was evaluated.
    fn value(&self, vector: &Vector) -> Option<bool> {
        match self {
            Self::Leaf(number) => vector.value(*number),
            Self::Not(inner) => inner.value(vector).map(|value| !value),
            Self::All(left, right) => match left.value(vector) {
                Some(true) => right.value(vector),
                other => other,
            },
            Self::Any(left, right) => match left.value(vector) {
                Some(false) => right.value(vector),
                other => other,
            },
        }
    }

    /// `None` if the condition is not in it. What stands to the left let it be evaluated, so only the right can mask it.
    fn counts(&self, condition: usize, vector: &Vector) -> Option<bool> {
        let beside = |left: &Self, right: &Self, masks: bool| {
            left.counts(condition, vector)
                .map(|counts| counts && right.value(vector) != Some(masks))
                .or_else(|| right.counts(condition, vector))
        };
        match self {
            Self::Leaf(number) => (*number == condition).then(|| vector.value(condition).is_some()),
            Self::Not(inner) => inner.counts(condition, vector),
            Self::All(left, right) => beside(left, right, false),
            Self::Any(left, right) => beside(left, right, true),
        }
    }
}

/// Everything there is to cover.
#[derive(Clone, Debug, Default)]
pub struct Plan {
    /// Every point, by its number.
    pub points: Vec<Point>,
    /// Every decision, by its number.
    pub decisions: Vec<Decision>,
    /// What is not instrumented, and why.
    pub left_out: Vec<(Place, String)>,
}

#[cfg(test)]
mod tests {
    use super::{Decision, Place, Tree, Vector};

    fn decision(tree: Tree, conditions: usize) -> Decision {
        let place = Place { file: String::new(), line: 1, function: String::new() };
        Decision { place, text: String::new(), branches: true, conditions: vec![(1, String::new()); conditions], tree }
    }

    fn leaf(number: usize) -> Tree {
        Tree::Leaf(number)
    }

    fn all(left: Tree, right: Tree) -> Tree {
        Tree::All(Box::new(left), Box::new(right))
    }

    fn any(left: Tree, right: Tree) -> Tree {
        Tree::Any(Box::new(left), Box::new(right))
    }

    fn not(inner: Tree) -> Tree {
        Tree::Not(Box::new(inner))
    }

    fn vector(letters: &str) -> Vector {
        let (conditions, outcome) = letters.split_at(letters.len() - 1);
        let mut vector = Vector { evaluated: 0, values: 0, outcome: outcome == "T" };
        for (number, letter) in conditions.chars().enumerate() {
            vector.evaluated |= u32::from(letter != '-') << number;
            vector.values |= u32::from(letter == 'T') << number;
        }
        vector
    }

    fn shown(decision: &Decision, vectors: &[&str]) -> (Vec<bool>, Vec<bool>) {
        let vectors = vectors.iter().map(|letters| vector(letters)).collect();
        (decision.shown(&vectors), decision.shown_uniquely(&vectors))
    }

    #[test]
    fn and_needs_each_condition_false_once() {
        let and = decision(all(leaf(0), leaf(1)), 2);
        assert_eq!(shown(&and, &["TTT", "F-F", "TFF"]), (vec![true, true], vec![true, true]));
        assert_eq!(shown(&and, &["TTT", "F-F"]), (vec![true, false], vec![true, false]), "the second was never false");
        assert_eq!(shown(&and, &["TTT", "TFF"]), (vec![false, true], vec![false, true]), "the first was never false");
        assert_eq!(shown(&and, &["TTT"]).0, [false, false]);
        assert_eq!(shown(&and, &[]).0, [false, false]);
    }

    #[test]
    fn or_needs_each_condition_true_once() {
        let or = decision(any(leaf(0), leaf(1)), 2);
        assert_eq!(shown(&or, &["FFF", "T-T", "FTT"]), (vec![true, true], vec![true, true]));
        assert_eq!(shown(&or, &["FFF", "FTT"]).0, [false, true]);
    }

    #[test]
    fn not_changes_nothing_of_it() {
        let not = decision(not(all(leaf(0), not(leaf(1)))), 2);
        assert_eq!(shown(&not, &["TFF", "F-T", "TTT"]).0, [true, true]);
        assert_eq!(shown(&not, &["TFF", "TTT"]).0, [false, true]);
    }

    #[test]
    fn a_masked_condition_shows_nothing() {
        // (a && b) || c
        let tree = decision(any(all(leaf(0), leaf(1)), leaf(2)), 3);
        assert_eq!(shown(&tree, &["TT-T", "F-TT"]).0, [false, false, false], "c is true: a false changes nothing");
        assert_eq!(shown(&tree, &["TT-T", "F-FF"]).0, [true, false, false]);
        assert_eq!(shown(&tree, &["TT-T", "F-FF", "TFFF", "TFTT"]).0, [true, true, true]);
    }

    #[test]
    fn masking_allows_what_unique_cause_does_not() {
        // (a || b) && c: c is true by a, and false by b.
        let tree = decision(all(any(leaf(0), leaf(1)), leaf(2)), 3);
        let (masking, unique) = shown(&tree, &["T-TT", "FTFF"]);
        assert!(masking[2] && !unique[2], "{masking:?} {unique:?}");
    }

    #[test]
    fn letters_are_read_by_people() {
        let and = decision(all(leaf(0), leaf(1)), 2);
        assert_eq!(and.letters(&vector("F-F")), "F- → F");
    }
}
