//! Each rule is seen to find a planted defect; the real folder has none.

use std::collections::BTreeSet;
use std::path::Path;

use super::load::{ReadingFile, parse};
use super::plants::MORE;
use super::*;

fn real() -> Result<Analysis, AnalysisError> {
    load(&Path::new(env!("CARGO_MANIFEST_DIR")).join("analysis"))
}

#[test]
fn the_real_analysis_holds_together() -> Result<(), AnalysisError> {
    let findings: Vec<String> = check(&real()?).iter().map(ToString::to_string).collect();
    assert!(findings.is_empty(), "{}", findings.join("\n"));
    Ok(())
}

/// Plants one defect and says what kind of finding names which entry.
pub(super) type Plant = fn(&mut Analysis) -> Option<(Rule, String)>;

const PLANTS: &[(&str, Plant)] = &[
    ("unknown goal", |a| {
        let entry = a.requirements.first_mut()?;
        entry.goal.push("SG-99".to_owned());
        Some((Rule::UnknownId, entry.id.clone()))
    }),
    ("unknown reading", |a| {
        let entry = a.requirements.last_mut()?;
        entry.readings.push("R-zz".to_owned());
        Some((Rule::UnknownId, entry.id.clone()))
    }),
    ("unknown event", |a| {
        let goal = a.goals.first_mut()?;
        goal.events.push("HZ-99a".to_owned());
        Some((Rule::UnknownId, goal.id.clone()))
    }),
    ("unknown timer in a chain", |a| {
        let chain = a.timing.chain.first_mut()?;
        chain.steps.first_mut()?.timer = "TM-99".to_owned();
        Some((Rule::UnknownId, chain.id.clone()))
    }),
    ("unknown goal of a chain", |a| {
        let chain = a.timing.chain.last_mut()?;
        chain.goal = "SG-99".to_owned();
        Some((Rule::UnknownId, chain.id.clone()))
    }),
    ("unknown assumption of a timer", |a| {
        let timer = a.timing.timer.first_mut()?;
        timer.assumed = Some("AOU-99".to_owned());
        Some((Rule::UnknownId, timer.id.clone()))
    }),
    ("unknown requirement of an assumption", |a| {
        let entry = a.assumptions.first_mut()?;
        entry.requirements.push("SEAT-99z".to_owned());
        Some((Rule::UnknownId, entry.id.clone()))
    }),
    ("unknown requirement of a reading", |a| {
        let entry = a.readings.first_mut()?;
        entry.requirements.push("SEAT-99z".to_owned());
        Some((Rule::UnknownId, entry.id.clone()))
    }),
    ("requirement twice", |a| {
        let id = a.requirements.first()?.id.clone();
        a.requirements.last_mut()?.id.clone_from(&id);
        Some((Rule::DuplicateId, id))
    }),
    ("goal twice", |a| {
        let id = a.goals.first()?.id.clone();
        a.goals.last_mut()?.id.clone_from(&id);
        Some((Rule::DuplicateId, id))
    }),
    ("requirement id without letter", |a| {
        a.requirements.first_mut()?.id = "SEAT-7".to_owned();
        Some((Rule::IdForm, "SEAT-7".to_owned()))
    }),
    ("event id of another hazard", |a| {
        let event = a.hazards.first_mut()?.event.first_mut()?;
        event.id = "HZ-77a".to_owned();
        Some((Rule::IdForm, event.id.clone()))
    }),
    ("orphan goal", |a| {
        let id = a.goals.first()?.id.clone();
        for requirement in &mut a.requirements {
            requirement.goal.retain(|goal| *goal != id);
        }
        Some((Rule::OrphanGoal, id))
    }),
    ("event without goal", |a| {
        let id = a.hazards.last()?.event.last()?.id.clone();
        for goal in &mut a.goals {
            goal.events.retain(|event| *event != id);
        }
        Some((Rule::UncoveredHazard, id))
    }),
    ("hazard without event", |a| {
        let hazard = a.hazards.first_mut()?;
        hazard.event.clear();
        Some((Rule::UncoveredHazard, hazard.id.clone()))
    }),
    ("requirement without goal", |a| {
        let entry = a.requirements.first_mut()?;
        entry.goal.clear();
        Some((Rule::Incomplete, entry.id.clone()))
    }),
    ("requirement without method", |a| {
        let entry = a.requirements.first_mut()?;
        entry.method.clear();
        Some((Rule::Incomplete, entry.id.clone()))
    }),
    ("requirement without source", |a| {
        let entry = a.requirements.first_mut()?;
        entry.source = " ".to_owned();
        Some((Rule::Incomplete, entry.id.clone()))
    }),
    ("requirement of an unnamed source", |a| {
        let entry = a.requirements.iter_mut().find(|entry| entry.passage.is_none())?;
        entry.source = "hearsay".to_owned();
        Some((Rule::Incomplete, entry.id.clone()))
    }),
    ("seed without its passage", |a| {
        let entry = a.requirements.iter_mut().find(|entry| !entry.source.contains("own"))?;
        entry.passage = None;
        Some((Rule::Incomplete, entry.id.clone()))
    }),
    ("passage without its seed", |a| {
        let entry = a.requirements.iter_mut().find(|entry| entry.source == "own")?;
        entry.passage = Some("原文".to_owned());
        Some((Rule::Incomplete, entry.id.clone()))
    }),
    ("requirement without package", |a| {
        let entry = a.requirements.first_mut()?;
        entry.package = 3;
        Some((Rule::Incomplete, entry.id.clone()))
    }),
    ("goal without safe state", |a| {
        let goal = a.goals.first_mut()?;
        goal.safe_state.clear();
        Some((Rule::Incomplete, goal.id.clone()))
    }),
    ("budget without reason", |a| {
        let chain = a.timing.chain.first_mut()?;
        chain.budget_ms = Some(5000);
        Some((Rule::Incomplete, chain.id.clone()))
    }),
    ("level one too low", |a| {
        let event = a.hazards.first_mut()?.event.first_mut()?;
        event.asil = Asil::C;
        Some((Rule::AsilTable, event.id.clone()))
    }),
    ("rating off the scale", |a| {
        let event = a.hazards.first_mut()?.event.first_mut()?;
        event.e = 5;
        Some((Rule::AsilTable, event.id.clone()))
    }),
    ("goal below its events", |a| {
        let goal = a.goals.first_mut()?;
        goal.asil = Asil::C;
        Some((Rule::GoalAsil, goal.id.clone()))
    }),
    ("goal above its events", |a| {
        let goal = a.goals.iter_mut().find(|goal| goal.claim == Claim::SensorLimited)?;
        goal.asil = Asil::C;
        Some((Rule::GoalAsil, goal.id.clone()))
    }),
    ("claim above the sensors", |a| {
        let goal = a.goals.iter_mut().find(|goal| goal.asil == Asil::D)?;
        goal.claim = Claim::SensorLimited;
        Some((Rule::ClaimTooHigh, goal.id.clone()))
    }),
    ("chain one millisecond too long", |a| {
        let chain = a.timing.chain.iter().find(|chain| chain.budget_ms.is_none())?;
        let timer = |id: &str| a.timing.timer.iter().find(|timer| timer.id == id).map(|timer| timer.value_ms);
        let sum: u32 = chain.steps.iter().filter_map(|step| timer(&step.timer)).sum();
        let (id, goal) = (chain.id.clone(), chain.goal.clone());
        a.goals.iter_mut().find(|entry| entry.id == goal)?.ftti_ms = sum - 1;
        Some((Rule::ChainTooLong, id))
    }),
    ("chain above its budget", |a| {
        let chain = a.timing.chain.iter_mut().find(|chain| chain.budget_ms.is_some())?;
        chain.budget_ms = Some(1);
        Some((Rule::ChainTooLong, chain.id.clone()))
    }),
    ("chain out of order", |a| {
        let chain = a.timing.chain.iter_mut().find(|chain| chain.steps.len() > 2)?;
        chain.steps.reverse();
        Some((Rule::TimingPlace, chain.id.clone()))
    }),
    ("goal without chain", |a| {
        let id = a.goals.first()?.id.clone();
        a.timing.chain.retain(|chain| chain.goal != id);
        Some((Rule::TimingPlace, id))
    }),
    ("deliberate wait in a chain", |a| {
        let timer = a.timing.timer.iter().find(|timer| timer.role == Role::Definition)?.id.clone();
        a.timing.chain.first_mut()?.steps.first_mut()?.timer.clone_from(&timer);
        Some((Rule::TimingPlace, timer))
    }),
    ("time-out in no chain", |a| {
        let timer = a.timing.timer.iter_mut().find(|timer| timer.role == Role::Report)?;
        timer.role = Role::Chain;
        Some((Rule::TimingPlace, timer.id.clone()))
    }),
    ("share above the FTTI", |a| {
        let ftti = a.goals.first()?.ftti_ms;
        let goal = a.goals.first()?.id.clone();
        let entry = a.requirements.iter_mut().find(|entry| entry.goal == [goal.clone()])?;
        entry.ftti_share_ms = ftti + 1;
        Some((Rule::ShareTooLong, entry.id.clone()))
    }),
    ("assumption without verification", |a| {
        let entry = a.assumptions.first_mut()?;
        entry.verify.clear();
        Some((Rule::Unverified, entry.id.clone()))
    }),
    ("assumption without consequence", |a| {
        let entry = a.assumptions.first_mut()?;
        entry.violated.clear();
        Some((Rule::Unverified, entry.id.clone()))
    }),
    ("reading that its requirement does not name", |a| {
        let reading = a.readings.first()?;
        let named = reading.requirements.first()?;
        a.requirements.iter_mut().find(|entry| entry.id == *named)?.readings.clear();
        Some((Rule::ReadingLink, reading.id.clone()))
    }),
    ("forbidden word", |a| {
        a.texts.push(("x.toml".to_owned(), "ok\nThis is Certified.".to_owned()));
        Some((Rule::Overclaim, "x.toml:2".to_owned()))
    }),
    ("forbidden claim", |a| {
        a.texts.push(("x.toml".to_owned(), "assumed, and ASIL D compliant".to_owned()));
        Some((Rule::Overclaim, "x.toml:1".to_owned()))
    }),
    ("level that is not said to be assumed", |a| {
        a.texts.push(("x.toml".to_owned(), "goal SG-01 is ASIL D".to_owned()));
        Some((Rule::Overclaim, "x.toml:1".to_owned()))
    }),
];

#[test]
fn every_planted_defect_is_found() -> Result<(), AnalysisError> {
    for (name, plant) in PLANTS.iter().chain(MORE) {
        let mut analysis = real()?;
        let planted = plant(&mut analysis);
        let findings = check(&analysis);
        let found = planted.as_ref().is_some_and(|(rule, place)| {
            findings.iter().any(|finding| finding.rule == *rule && finding.place == *place)
        });
        assert!(found, "{name}: planted {planted:?}, found {findings:?}");
    }
    Ok(())
}

#[test]
fn every_rule_has_a_planted_defect() -> Result<(), AnalysisError> {
    let mut rules = BTreeSet::new();
    for (_, plant) in PLANTS.iter().chain(MORE) {
        rules.extend(plant(&mut real()?).map(|(rule, _)| rule));
    }
    assert_eq!(rules.len(), 17, "{rules:?}");
    Ok(())
}

#[test]
fn the_table_of_levels_is_the_published_one() {
    use Asil::{A, B, C, D, Qm};
    // Rows S1/E1 to S3/E4, columns C1 to C3.
    let table = [
        [[Qm, Qm, Qm], [Qm, Qm, Qm], [Qm, Qm, A], [Qm, A, B]],
        [[Qm, Qm, Qm], [Qm, Qm, A], [Qm, A, B], [A, B, C]],
        [[Qm, Qm, A], [Qm, A, B], [A, B, C], [B, C, D]],
    ];
    for (s, rows) in (1..).zip(table) {
        for (e, row) in (1..).zip(rows) {
            for (c, level) in (1..).zip(row) {
                assert_eq!(Asil::from_rating(s, e, c), Some(level), "S{s}/E{e}/C{c}");
            }
        }
    }
    for (s, e, c) in [(0, 4, 3), (3, 0, 3), (3, 4, 0)] {
        assert_eq!(Asil::from_rating(s, e, c), Some(Qm));
    }
    for (s, e, c) in [(4, 1, 1), (1, 5, 1), (1, 1, 4), (255, 255, 255)] {
        assert_eq!(Asil::from_rating(s, e, c), None);
    }
}

const READING: &str = "[[reading]]\nid = \"R-a\"\nstatus = \"decided\"\npassage = \"p\"\nquestion = \"q\"\n\
    alternatives = []\ndecision = \"d\"\nreason = \"r\"\nrequirements = []\n";

#[test]
fn an_error_names_file_and_entry() {
    let twice = format!("# [[ no header\n{READING}\n{}", READING.replace("R-a", "R-b"));
    let cases = [
        ("unknown key", twice.clone() + "colour = \"red\"\n"),
        (
            "missing key",
            twice.replacen("question = \"q\"\n", "", 2).replacen("passage", "question = \"q\"\npassage", 1),
        ),
        ("wrong value", format!("{READING}\n{}", READING.replace("R-a", "R-b").replace("decided", "guessed"))),
        ("no TOML", twice.clone() + "x = = 1\n"),
    ];
    assert!(parse::<ReadingFile>("r.toml", &twice).is_ok());
    for (name, text) in cases {
        let error = parse::<ReadingFile>("r.toml", &text).err();
        let entry = error.as_ref().and_then(|error| error.entry.as_deref());
        assert_eq!(entry, Some("R-b"), "{name}: {error:?}");
        let shown = error.map(|error| error.to_string()).unwrap_or_default();
        assert!(shown.starts_with("r.toml: R-b: "), "{name}: {shown}");
    }
}

#[test]
fn a_missing_folder_is_an_error_with_its_name() {
    let error = load(Path::new("/nowhere/analysis")).err().map(|error| error.file);
    assert_eq!(error.as_deref(), Some("/nowhere/analysis/item.toml"));
}
