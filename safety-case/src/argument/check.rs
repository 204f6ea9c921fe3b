//! What has to hold across the argument: the checks of gsn2x (their numbers stand beside ours), and our own.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

use super::{Argument, Element, Node};
use crate::analysis::{Analysis, Evidence};

/// What kind of defect a finding is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Rule {
    /// An id that says no kind (V01).
    NoKind,
    /// A goal or strategy that nothing supports and that is not marked as undeveloped (V02).
    Unsupported,
    /// Marked as undeveloped, and supported (V03).
    Supported,
    /// Support or context of a kind that can be none (V04).
    WrongKind,
    /// Named twice in one list (V05), or a node that names itself (V06, C13).
    Twice,
    /// Called defeated, and nothing challenges it (V10).
    NotChallenged,
    /// It challenges, and is no counter-goal or counter-solution (V12).
    NoDoubt,
    /// Not exactly one goal at the top (C01, C02).
    Top,
    /// Refers to what nothing defines (C03, C14).
    Unknown,
    /// Supports itself by a circle (C04).
    Circular,
    /// An id in two modules (C07).
    Duplicate,
    /// Nothing leads to it (C08).
    Unreachable,
    /// A node without text, a module without a name, or a solution without evidence or without what it does not show.
    Incomplete,
    /// Evidence that is none, or stands at a node that needs none.
    Evidence,
    /// A safety goal that the argument does not name by its own goal, or the reverse.
    SafetyGoal,
}

/// One defect.
#[derive(Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Finding {
    /// File and node.
    pub place: String,
    /// Its kind.
    pub rule: Rule,
    /// What is wrong.
    pub message: String,
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {} [{:?}]", self.place, self.message, self.rule)
    }
}

struct Check<'a> {
    argument: &'a Argument,
    nodes: BTreeMap<&'a str, &'a Node>,
    findings: Vec<Finding>,
}

/// Every defect of the argument, by place; empty when it holds together.
#[must_use]
pub fn check(argument: &Argument, analysis: &Analysis) -> Vec<Finding> {
    let nodes = argument.nodes().map(|(_, id, node)| (id, node)).collect();
    let mut check = Check { argument, nodes, findings: Vec::new() };
    check.duplicates();
    for (module, id, node) in argument.nodes() {
        let place = format!("{}: {id}", module.file);
        check.node(&place, id, node);
        check.references(&place, id, node);
        check.words(&place, node, &analysis.ids());
    }
    check.circles();
    check.top();
    check.safety_goals(analysis);
    check.findings.sort();
    check.findings
}

impl Check<'_> {
    fn add(&mut self, rule: Rule, place: &str, message: impl Into<String>) {
        self.findings.push(Finding { place: place.to_owned(), rule, message: message.into() });
    }

    fn duplicates(&mut self) {
        let mut seen: BTreeMap<&str, &str> = BTreeMap::new();
        let argument = self.argument;
        for (module, id, _) in argument.nodes() {
            if let Some(other) = seen.insert(id, &module.file) {
                self.add(Rule::Duplicate, &format!("{}: {id}", module.file), format!("stands in {other} as well"));
            }
        }
        for module in &argument.modules {
            if module.name.trim().is_empty() || module.brief.trim().is_empty() {
                self.add(Rule::Incomplete, &module.file, "has no name, or does not say what it is about");
            }
            for file in module.uses.iter().filter(|file| !argument.modules.iter().any(|other| other.file == **file)) {
                self.add(Rule::Unknown, &module.file, format!("uses {file}, which is not there"));
            }
        }
    }

    fn node(&mut self, place: &str, id: &str, node: &Node) {
        let Some(element) = Element::of(id) else {
            self.add(Rule::NoKind, place, "begins like no kind of node");
            return;
        };
        if node.text.trim().is_empty() {
            self.add(Rule::Incomplete, place, "has no text");
        }
        let supported = !node.supported_by.is_empty();
        if element.needs_support() && !supported && !node.undeveloped {
            self.add(Rule::Unsupported, place, "is supported by nothing and not marked as undeveloped");
        }
        if node.undeveloped && (supported || !element.needs_support()) {
            self.add(Rule::Supported, place, "is marked as undeveloped, and is supported or can not be");
        }
        if node.challenges.is_some() && !matches!(element, Element::CounterGoal | Element::CounterSolution) {
            self.add(Rule::NoDoubt, place, "challenges, and is no counter-goal or counter-solution");
        }
        let nodes = self.nodes.clone();
        if node.defeated && !nodes.values().any(|other| other.challenges.as_deref() == Some(id)) {
            self.add(Rule::NotChallenged, place, "is called defeated, and nothing challenges it");
        }
        if element.is_solution() {
            if node.pieces().next().is_none() {
                self.add(Rule::Incomplete, place, "names no evidence");
            }
            if node.not_shown.as_ref().is_none_or(|text| text.trim().is_empty()) {
                self.add(Rule::Incomplete, place, "does not say what it does not show");
            }
        } else if node.not_shown.is_some() {
            self.add(Rule::Evidence, place, "is no solution, and says what it does not show");
        }
        for piece in node.pieces() {
            if let Err(error) = Evidence::try_from(piece.to_owned()) {
                self.add(Rule::Evidence, place, error);
            }
        }
    }

    fn references(&mut self, place: &str, id: &str, node: &Node) {
        use Element::{Assumption, Context, CounterGoal, CounterSolution, Goal, Justification, Solution, Strategy};
        let supports: &[Element] = match Element::of(id) {
            Some(Goal | Strategy) => &[Goal, Strategy, Solution],
            Some(CounterGoal | CounterSolution) => &[CounterGoal, CounterSolution],
            Some(Solution | Context | Assumption | Justification) | None => &[],
        };
        let contexts: &[Element] = match Element::of(id) {
            Some(Goal | Strategy | CounterGoal) => &[Context, Assumption, Justification],
            Some(Solution | Context | Assumption | Justification | CounterSolution) | None => &[],
        };
        for (what, list, kinds) in
            [("support", &node.supported_by, supports), ("context", &node.in_context_of, contexts)]
        {
            let mut seen = BTreeSet::new();
            for named in list {
                if named == id || !seen.insert(named) {
                    self.add(Rule::Twice, place, format!("names {named} twice, or itself, as {what}"));
                }
                if !self.nodes.contains_key(named.as_str()) {
                    self.add(Rule::Unknown, place, format!("refers to {named}, which nothing defines"));
                } else if !Element::of(named).is_some_and(|kind| kinds.contains(&kind)) {
                    self.add(Rule::WrongKind, place, format!("can not have {named} as {what}"));
                }
            }
        }
        if let Some(named) = &node.challenges {
            if named == id {
                self.add(Rule::Twice, place, "challenges itself");
            } else if !self.nodes.contains_key(named.as_str()) {
                self.add(Rule::Unknown, place, format!("challenges {named}, which nothing defines"));
            }
        }
    }

    /// An id of the analysis that a text names must exist.
    fn words(&mut self, place: &str, node: &Node, known: &BTreeSet<String>) {
        for text in [Some(&node.text), node.not_shown.as_ref()].into_iter().flatten() {
            for (_, id) in crate::trace::named(text) {
                if !known.contains(id) {
                    self.add(Rule::Unknown, place, format!("names {id}, which nothing defines"));
                }
            }
        }
    }

    fn circles(&mut self) {
        let argument = self.argument;
        for (module, id, node) in argument.nodes() {
            let (mut todo, mut seen): (Vec<&str>, BTreeSet<&str>) =
                (node.supported_by.iter().map(String::as_str).collect(), BTreeSet::new());
            while let Some(next) = todo.pop() {
                if seen.insert(next)
                    && let Some(next) = self.nodes.get(next)
                {
                    todo.extend(next.supported_by.iter().map(String::as_str));
                }
            }
            if seen.contains(id) {
                self.add(Rule::Circular, &format!("{}: {id}", module.file), "supports itself by a circle");
            }
        }
    }

    fn top(&mut self) {
        let argument = self.argument;
        let referred: BTreeSet<&str> = argument
            .nodes()
            .flat_map(|(_, _, node)| node.supported_by.iter().chain(&node.in_context_of))
            .map(String::as_str)
            .collect();
        let is_doubt = |id: &str| matches!(Element::of(id), Some(Element::CounterGoal | Element::CounterSolution));
        let tops: Vec<&str> =
            argument.nodes().map(|(_, id, _)| id).filter(|id| !referred.contains(id) && !is_doubt(id)).collect();
        let one = tops.len() == 1 && tops.iter().all(|id| Element::of(id) == Some(Element::Goal));
        if !one && !argument.modules.is_empty() {
            self.add(Rule::Top, "argument", format!("has not one goal at the top but: {}", tops.join(", ")));
        }
        // From the top, and from each doubt of what is reached, everything must be reached.
        let mut todo: Vec<&str> = tops;
        let mut reached = BTreeSet::new();
        while let Some(id) = todo.pop() {
            if !reached.insert(id) {
                continue;
            }
            if let Some(node) = self.nodes.get(id) {
                todo.extend(node.supported_by.iter().chain(&node.in_context_of).map(String::as_str));
            }
            let doubts = argument.nodes().filter(|(_, _, node)| node.challenges.as_deref() == Some(id));
            todo.extend(doubts.map(|(_, id, _)| id));
        }
        for (module, id, _) in argument.nodes().filter(|(_, id, _)| !reached.contains(id)) {
            self.add(Rule::Unreachable, &format!("{}: {id}", module.file), "stands alone: nothing leads to it");
        }
    }

    /// `G-SG01` speaks of SG-01.
    fn safety_goals(&mut self, analysis: &Analysis) {
        let goals: BTreeSet<String> =
            analysis.goals.iter().map(|goal| format!("G-{}", goal.id.replace('-', ""))).collect();
        let missing: Vec<String> =
            goals.iter().filter(|goal| !self.nodes.contains_key(goal.as_str())).cloned().collect();
        if !self.argument.modules.is_empty() {
            for goal in missing {
                self.add(Rule::SafetyGoal, &goal, "stands for a safety goal, and is not in the argument");
            }
        }
        let argument = self.argument;
        for (module, id, _) in argument.nodes().filter(|(_, id, _)| id.starts_with("G-SG") && !goals.contains(*id)) {
            self.add(Rule::SafetyGoal, &format!("{}: {id}", module.file), "stands for no goal of goals.toml");
        }
    }
}
