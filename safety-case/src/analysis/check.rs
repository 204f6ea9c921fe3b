//! What has to hold across the files.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

use super::model::{Analysis, Asil, Claim, Event, Role, Timer, Timing};
use super::{fmea, limitations, methods, tools};

/// What kind of defect a finding is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Rule {
    /// An id that nothing defines is referred to.
    UnknownId,
    /// An id is defined twice.
    DuplicateId,
    /// An id has not the form of its kind.
    IdForm,
    /// A goal that no requirement serves.
    OrphanGoal,
    /// A hazard without event, or an event that no goal covers.
    UncoveredHazard,
    /// A text, source, goal, method or reason is missing.
    Incomplete,
    /// A level differs from the table of severity, exposure, controllability.
    AsilTable,
    /// A goal's level is not the greatest of its events.
    GoalAsil,
    /// A goal that its sensors limit claims more than B.
    ClaimTooHigh,
    /// A chain is longer than the FTTI of its goal, or than its budget.
    ChainTooLong,
    /// A chain has no order, a goal no chain, or a timer stands where its role does not belong.
    TimingPlace,
    /// The share of a requirement exceeds the FTTI of a goal.
    ShareTooLong,
    /// An assumption says not how it is verified or what follows when it fails.
    Unverified,
    /// A reading and a requirement do not refer to each other.
    ReadingLink,
    /// The confidence level of a tool does not follow from impact and detection.
    ToolLevel,
    /// A proposed reading that no limitation names, or the reverse.
    Unlisted,
    /// A word that claims more than the analysis shows, or a level that is not said to be assumed.
    Overclaim,
}

/// One defect.
#[derive(Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Finding {
    /// Its kind.
    pub rule: Rule,
    /// The entry, or file and line.
    pub place: String,
    /// What is wrong.
    pub message: String,
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {} [{:?}]", self.place, self.message, self.rule)
    }
}

/// Every defect of the analysis, in the order of the rules; empty when it holds together.
#[must_use]
pub fn check(analysis: &Analysis) -> Vec<Finding> {
    let mut findings = Findings(Vec::new());
    check_ids(analysis, &mut findings);
    check_hazards_and_goals(analysis, &mut findings);
    check_requirements(analysis, &mut findings);
    check_assumptions(analysis, &mut findings);
    check_timing(&analysis.timing, analysis, &mut findings);
    check_readings(analysis, &mut findings);
    check_the_making(analysis, &mut findings);
    findings.0.extend(check_words(&analysis.texts));
    findings.0.sort();
    findings.0
}

/// What is found, in the making.
pub(super) struct Findings(Vec<Finding>);

impl Findings {
    pub(super) fn add(&mut self, rule: Rule, place: &str, message: impl Into<String>) {
        self.0.push(Finding { rule, place: place.to_owned(), message: message.into() });
    }

    pub(super) fn unknown<'a>(
        &mut self,
        place: &str,
        named: impl IntoIterator<Item = &'a String>,
        known: &BTreeSet<&str>,
    ) {
        for id in named {
            if !known.contains(id.as_str()) {
                self.add(Rule::UnknownId, place, format!("refers to {id}, which nothing defines"));
            }
        }
    }

    pub(super) fn blank(&mut self, place: &str, what: &str, text: &str) {
        if text.trim().is_empty() {
            self.add(Rule::Incomplete, place, format!("has no {what}"));
        }
    }
}

/// The ids that may be referred to.
pub(super) struct Known<'a> {
    pub goals: BTreeSet<&'a str>,
    pub requirements: BTreeSet<&'a str>,
    pub assumptions: BTreeSet<&'a str>,
    pub readings: BTreeSet<&'a str>,
    pub faults: BTreeSet<&'a str>,
}

/// Failure modes, tools, methods, limitations and risks.
fn check_the_making(analysis: &Analysis, findings: &mut Findings) {
    let known = Known {
        goals: ids(&analysis.goals, |goal| &goal.id),
        requirements: ids(&analysis.requirements, |requirement| &requirement.id),
        assumptions: ids(&analysis.assumptions, |assumption| &assumption.id),
        readings: ids(&analysis.readings, |reading| &reading.id),
        faults: analysis.faults.iter().map(String::as_str).collect(),
    };
    fmea::check(&analysis.failures, &known, findings);
    tools::check(&analysis.tools, findings);
    methods::check(&analysis.methods, findings);
    limitations::check(&analysis.limitations, &analysis.risks, &analysis.readings, &known, findings);
}

/// The ids of one kind.
fn ids<'a, T>(entries: &'a [T], id: impl Fn(&'a T) -> &'a String) -> BTreeSet<&'a str> {
    entries.iter().map(|entry| id(entry).as_str()).collect()
}

impl Analysis {
    /// Every id but those of requirements, with what it must begin with.
    pub fn all_ids(&self) -> impl Iterator<Item = (&str, &str)> {
        let Self { item, hazards, goals, assumptions, timing, readings, .. } = self;
        let Self { failures, tools, methods, limitations, risks, .. } = self;
        let events =
            hazards.iter().flat_map(|hazard| hazard.event.iter().map(|event| (hazard.id.as_str(), event.id.as_str())));
        let rows = methods.iter().flat_map(|table| table.row.iter().map(|row| (table.id.as_str(), row.id.as_str())));
        (item.interface.iter().map(|entry| ("IF-", entry.id.as_str())))
            .chain(item.mode.iter().map(|entry| ("OM-", entry.id.as_str())))
            .chain(hazards.iter().map(|entry| ("HZ-", entry.id.as_str())))
            .chain(events)
            .chain(goals.iter().map(|entry| ("SG-", entry.id.as_str())))
            .chain(assumptions.iter().map(|entry| ("AOU-", entry.id.as_str())))
            .chain(timing.timer.iter().map(|entry| ("TM-", entry.id.as_str())))
            .chain(timing.chain.iter().map(|entry| ("CH-", entry.id.as_str())))
            .chain(readings.iter().map(|entry| ("R-", entry.id.as_str())))
            .chain(failures.iter().map(|entry| ("FM-", entry.id.as_str())))
            .chain(tools.iter().map(|entry| ("TL-", entry.id.as_str())))
            .chain(methods.iter().map(|entry| ("MT-", entry.id.as_str())))
            .chain(rows)
            .chain(limitations.iter().map(|entry| ("LIM-", entry.id.as_str())))
            .chain(risks.iter().map(|entry| ("RR-", entry.id.as_str())))
    }

    /// Every id that a text may name: those of all entries, of the faults, and the groups of requirements.
    #[must_use]
    pub fn ids(&self) -> BTreeSet<String> {
        let mut ids: BTreeSet<String> = self.all_ids().map(|(_, id)| id.to_owned()).collect();
        for requirement in &self.requirements {
            ids.insert(requirement.id.trim_end_matches(|last: char| last.is_ascii_lowercase()).to_owned());
            ids.insert(requirement.id.clone());
        }
        ids.extend(self.faults.iter().cloned());
        ids
    }
}

fn check_ids(analysis: &Analysis, findings: &mut Findings) {
    let mut seen = BTreeSet::new();
    let mut twice = |id: &str, findings: &mut Findings| {
        if !seen.insert(id.to_owned()) {
            findings.add(Rule::DuplicateId, id, "is defined more than once");
        }
    };
    for (prefix, id) in analysis.all_ids() {
        if id.strip_prefix(prefix).is_none_or(str::is_empty) {
            findings.add(Rule::IdForm, id, format!("does not begin with {prefix}"));
        }
        twice(id, findings);
    }
    for requirement in &analysis.requirements {
        if !is_requirement_id(&requirement.id) {
            findings.add(Rule::IdForm, &requirement.id, "is not of the form AREA-7a");
        }
        twice(&requirement.id, findings);
    }
}

/// `AREA-7a`: capitals and digits, a hyphen, a number, one small letter.
fn is_requirement_id(id: &str) -> bool {
    let Some((area, rest)) = id.split_once('-') else { return false };
    let Some(number) = rest.strip_suffix(|last: char| last.is_ascii_lowercase()) else { return false };
    area.starts_with(|first: char| first.is_ascii_uppercase())
        && area.chars().all(|c| c.is_ascii_uppercase() || c.is_ascii_digit())
        && !number.is_empty()
        && number.chars().all(|c| c.is_ascii_digit())
}

fn check_hazards_and_goals(analysis: &Analysis, findings: &mut Findings) {
    let events: BTreeMap<&str, &Event> =
        analysis.hazards.iter().flat_map(|hazard| &hazard.event).map(|event| (event.id.as_str(), event)).collect();
    let covered: BTreeSet<&str> = analysis.goals.iter().flat_map(|goal| &goal.events).map(String::as_str).collect();
    for hazard in &analysis.hazards {
        if hazard.event.is_empty() {
            findings.add(Rule::UncoveredHazard, &hazard.id, "has no hazardous event");
        }
        for event in &hazard.event {
            if Asil::from_rating(event.s, event.e, event.c) != Some(event.asil) {
                let rating = format!("S{}/E{}/C{}", event.s, event.e, event.c);
                findings.add(Rule::AsilTable, &event.id, format!("{:?} does not follow from {rating}", event.asil));
            }
            if !covered.contains(event.id.as_str()) {
                findings.add(Rule::UncoveredHazard, &event.id, "is covered by no goal");
            }
            findings.blank(&event.id, "situation", &event.situation);
            findings.blank(&event.id, "reason for S", &event.s_reason);
            findings.blank(&event.id, "reason for E", &event.e_reason);
            findings.blank(&event.id, "reason for C", &event.c_reason);
        }
    }
    let served: BTreeSet<&str> =
        analysis.requirements.iter().flat_map(|requirement| &requirement.goal).map(String::as_str).collect();
    let known = events.keys().copied().collect();
    for goal in &analysis.goals {
        findings.unknown(&goal.id, &goal.events, &known);
        if !served.contains(goal.id.as_str()) {
            findings.add(Rule::OrphanGoal, &goal.id, "is served by no requirement");
        }
        let greatest = goal.events.iter().filter_map(|id| events.get(id.as_str())).map(|event| event.asil).max();
        if greatest != Some(goal.asil) {
            findings.add(Rule::GoalAsil, &goal.id, format!("is {:?}, its events ask for {greatest:?}", goal.asil));
        }
        if goal.claim == Claim::SensorLimited && goal.asil > Asil::B {
            findings.add(Rule::ClaimTooHigh, &goal.id, "is limited by its sensors and claims more than B");
        }
        findings.blank(&goal.id, "text", &goal.text);
        findings.blank(&goal.id, "safe state", &goal.safe_state);
        findings.blank(&goal.id, "begin of its FTTI", &goal.ftti_from);
        findings.blank(&goal.id, "reason for its FTTI", &goal.ftti_reason);
    }
}

fn check_requirements(analysis: &Analysis, findings: &mut Findings) {
    let goals: BTreeMap<&str, u32> = analysis.goals.iter().map(|goal| (goal.id.as_str(), goal.ftti_ms)).collect();
    let known = goals.keys().copied().collect();
    let readings = ids(&analysis.readings, |reading| &reading.id);
    for requirement in &analysis.requirements {
        let id = &requirement.id;
        findings.unknown(id, &requirement.goal, &known);
        findings.unknown(id, &requirement.readings, &readings);
        findings.blank(id, "text", &requirement.text);
        findings.blank(id, "source", &requirement.source);
        let seeded = ["S1", "S2", "S3", "S4"].iter().any(|seed| requirement.source.contains(seed));
        let own = requirement.source.contains("own");
        if !seeded && !own {
            findings.add(Rule::Incomplete, id, "has a source that is neither S1 to S4 nor own");
        }
        if (seeded && !own && requirement.passage.is_none()) || (!seeded && requirement.passage.is_some()) {
            findings.add(Rule::Incomplete, id, "has a source without its passage, or a passage without its source");
        }
        if requirement.goal.is_empty() {
            findings.add(Rule::Incomplete, id, "has no goal");
        }
        if requirement.method.is_empty() {
            findings.add(Rule::Incomplete, id, "has no verification method");
        }
        if !(1..=2).contains(&requirement.package) {
            findings.add(Rule::Incomplete, id, "has no work package 1 or 2");
        }
        for (goal, ftti) in requirement.goal.iter().filter_map(|goal| goals.get_key_value(goal.as_str())) {
            if requirement.ftti_share_ms > *ftti {
                let share = requirement.ftti_share_ms;
                findings.add(Rule::ShareTooLong, id, format!("takes {share} ms of the {ftti} ms of {goal}"));
            }
        }
    }
}

fn check_assumptions(analysis: &Analysis, findings: &mut Findings) {
    let requirements = ids(&analysis.requirements, |requirement| &requirement.id);
    for assumption in &analysis.assumptions {
        findings.unknown(&assumption.id, &assumption.requirements, &requirements);
        findings.blank(&assumption.id, "text", &assumption.text);
        if assumption.verify.trim().is_empty() {
            findings.add(Rule::Unverified, &assumption.id, "says not how it is verified");
        }
        if assumption.violated.trim().is_empty() {
            findings.add(Rule::Unverified, &assumption.id, "says not what follows when it does not hold");
        }
    }
}

fn check_timing(timing: &Timing, analysis: &Analysis, findings: &mut Findings) {
    let requirements = ids(&analysis.requirements, |requirement| &requirement.id);
    let assumptions = ids(&analysis.assumptions, |assumption| &assumption.id);
    let used: BTreeSet<&str> =
        timing.chain.iter().flat_map(|chain| &chain.steps).map(|step| step.timer.as_str()).collect();
    for timer in &timing.timer {
        findings.unknown(&timer.id, &timer.requirements, &requirements);
        findings.unknown(&timer.id, &timer.assumed, &assumptions);
        findings.blank(&timer.id, "reason", &timer.reason);
        if timer.requirements.is_empty() {
            findings.add(Rule::Incomplete, &timer.id, "belongs to no requirement");
        }
        if (timer.role == Role::Chain) != used.contains(timer.id.as_str()) {
            let message = format!("has the role {:?}, which does not fit the chains", timer.role);
            findings.add(Rule::TimingPlace, &timer.id, message);
        }
    }
    let timers: BTreeMap<&str, &Timer> = timing.timer.iter().map(|timer| (timer.id.as_str(), timer)).collect();
    let known = timers.keys().copied().collect();
    let goals: BTreeMap<&str, u32> = analysis.goals.iter().map(|goal| (goal.id.as_str(), goal.ftti_ms)).collect();
    let known_goals = goals.keys().copied().collect();
    for chain in &timing.chain {
        findings.unknown(&chain.id, [&chain.goal], &known_goals);
        findings.unknown(&chain.id, chain.steps.iter().map(|step| &step.timer), &known);
        if chain.steps.is_empty() || !chain.steps.is_sorted_by_key(|step| step.phase) {
            findings.add(Rule::TimingPlace, &chain.id, "is not detection, decision, actuation in this order");
        }
        if chain.budget_ms.is_some() != chain.budget_reason.as_ref().is_some_and(|reason| !reason.trim().is_empty()) {
            findings.add(Rule::Incomplete, &chain.id, "has a budget without a reason, or a reason without a budget");
        }
        let steps = chain.steps.iter().filter_map(|step| timers.get(step.timer.as_str()));
        let sum = steps.fold(0_u64, |sum, timer| sum.saturating_add(u64::from(timer.value_ms)));
        let bound = chain.budget_ms.or_else(|| goals.get(chain.goal.as_str()).copied());
        if let Some(bound) = bound.filter(|bound| sum > u64::from(*bound)) {
            findings.add(Rule::ChainTooLong, &chain.id, format!("takes {sum} ms, {bound} ms are allowed"));
        }
    }
    for goal in &analysis.goals {
        if !timing.chain.iter().any(|chain| chain.goal == goal.id && chain.budget_ms.is_none()) {
            findings.add(Rule::TimingPlace, &goal.id, "has no chain that is held against its FTTI");
        }
    }
}

fn check_readings(analysis: &Analysis, findings: &mut Findings) {
    let known = ids(&analysis.requirements, |requirement| &requirement.id);
    let mut forward = BTreeSet::new();
    for reading in &analysis.readings {
        findings.unknown(&reading.id, &reading.requirements, &known);
        findings.blank(&reading.id, "decision", &reading.decision);
        findings.blank(&reading.id, "reason", &reading.reason);
        if reading.requirements.is_empty() {
            findings.add(Rule::Incomplete, &reading.id, "decides no requirement");
        }
        forward.extend(reading.requirements.iter().map(|id| (reading.id.as_str(), id.as_str())));
    }
    let backward: BTreeSet<(&str, &str)> = analysis
        .requirements
        .iter()
        .flat_map(|entry| entry.readings.iter().map(|reading| (reading.as_str(), entry.id.as_str())))
        .collect();
    for (reading, requirement) in forward.symmetric_difference(&backward) {
        findings.add(Rule::ReadingLink, reading, format!("and {requirement} do not name each other"));
    }
}

/// Words that nothing here may use of itself, in lower case.
pub const FORBIDDEN: [&str; 6] =
    ["certified", "certification", "asil d compliant", "asil-d compliant", "asil-d-compliant", "asil compliant"];

/// Where these texts, each with its name, claim more than is shown.
#[must_use]
pub fn check_words(texts: &[(String, String)]) -> Vec<Finding> {
    let mut findings = Vec::new();
    for (file, text) in texts {
        for (number, line) in (1_usize..).zip(text.lines()) {
            let mut add = |message: String| {
                findings.push(Finding { rule: Rule::Overclaim, place: format!("{file}:{number}"), message });
            };
            let lower = line.to_lowercase();
            for word in FORBIDDEN.iter().filter(|word| lower.contains(*word)) {
                add(format!("says \"{word}\""));
            }
            let level = ["asil a", "asil b", "asil c", "asil d"].iter().any(|level| lower.contains(level));
            if level && !lower.contains("assumed") {
                add("names a level without saying that it is assumed".to_owned());
            }
        }
    }
    findings
}
