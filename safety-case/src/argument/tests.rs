//! Each rule is seen to find a planted defect; the real argument has none.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use super::{Argument, Module, Node, Rule, check, load, sheets};
use crate::analysis::{self, Analysis};

type Outcome = Result<(), Box<dyn std::error::Error>>;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap_or(Path::new("."))
}

fn real() -> Result<(Argument, Analysis), Box<dyn std::error::Error>> {
    Ok((load(root())?, analysis::load(&root().join("safety-case/analysis"))?))
}

#[test]
fn the_real_argument_holds_together() -> Outcome {
    let (argument, analysis) = real()?;
    let findings: Vec<String> = check(&argument, &analysis).iter().map(ToString::to_string).collect();
    assert!(findings.is_empty() && argument.modules.len() > 3, "{}", findings.join("\n"));
    Ok(())
}

fn node<'a>(argument: &'a mut Argument, id: &str) -> Option<&'a mut Node> {
    argument.modules.iter_mut().find_map(|module| module.nodes.get_mut(id))
}

fn first(argument: &mut Argument) -> Option<&mut Module> {
    argument.modules.first_mut()
}

/// Plants one defect and says which rule finds it.
type Plant = fn(&mut Argument) -> Option<Rule>;

const PLANTS: &[(&str, Plant)] = &[
    ("an id that says no kind", |a| {
        let node = Node { text: "x".to_owned(), ..Node::default() };
        first(a)?.nodes.insert("X-1".to_owned(), node);
        Some(Rule::NoKind)
    }),
    ("a goal without support", |a| {
        node(a, "G-Hazards")?.undeveloped = false;
        Some(Rule::Unsupported)
    }),
    ("undeveloped, and supported", |a| {
        node(a, "G-Derived")?.undeveloped = true;
        Some(Rule::Supported)
    }),
    ("a context as support", |a| {
        node(a, "S-Top")?.supported_by.push("C-Item".to_owned());
        Some(Rule::WrongKind)
    }),
    ("named twice", |a| {
        let top = node(a, "S-Top")?;
        let again = top.supported_by.first()?.clone();
        top.supported_by.push(again);
        Some(Rule::Twice)
    }),
    ("defeated without a doubt", |a| {
        node(a, "G-Times")?.defeated = true;
        Some(Rule::NotChallenged)
    }),
    ("a goal that doubts", |a| {
        node(a, "G-Times")?.challenges = Some("G-Derived".to_owned());
        Some(Rule::NoDoubt)
    }),
    ("a second top", |a| {
        let node = Node { text: "x".to_owned(), undeveloped: true, ..Node::default() };
        first(a)?.nodes.insert("G-Alone".to_owned(), node);
        Some(Rule::Top)
    }),
    ("an unknown support", |a| {
        node(a, "S-Top")?.supported_by.push("G-Nowhere".to_owned());
        Some(Rule::Unknown)
    }),
    ("an unknown id in a text", |a| {
        node(a, "G-Times")?.text.push_str(" (AOU-99)");
        Some(Rule::Unknown)
    }),
    ("a circle", |a| {
        node(a, "G-Derived")?.supported_by.push("G-Requirements".to_owned());
        Some(Rule::Circular)
    }),
    ("an id in two modules", |a| {
        let copy = a.modules.last()?.nodes.first_key_value().map(|(id, node)| (id.clone(), node.clone()))?;
        first(a)?.nodes.insert(copy.0, copy.1);
        Some(Rule::Duplicate)
    }),
    ("a circle that stands alone", |a| {
        let text = "x".to_owned();
        let one = Node { text: text.clone(), supported_by: vec!["G-Y".to_owned()], ..Node::default() };
        let other = Node { text, supported_by: vec!["G-X".to_owned()], ..Node::default() };
        first(a)?.nodes.extend([("G-X".to_owned(), one), ("G-Y".to_owned(), other)]);
        Some(Rule::Unreachable)
    }),
    ("a solution without what it does not show", |a| {
        node(a, "Sn-Analysis")?.not_shown = None;
        Some(Rule::Incomplete)
    }),
    ("evidence of no kind", |a| {
        node(a, "Sn-Analysis")?.evidence = Some("hearsay all".to_owned());
        Some(Rule::Evidence)
    }),
    ("a safety goal that is not argued for", |a| {
        let module = a.modules.iter_mut().find(|module| module.nodes.contains_key("G-SG01"))?;
        module.nodes.remove("G-SG01");
        Some(Rule::SafetyGoal)
    }),
];

#[test]
fn every_planted_defect_is_found() -> Outcome {
    let mut rules = BTreeSet::new();
    for (name, plant) in PLANTS {
        let (mut argument, analysis) = real()?;
        let rule = plant(&mut argument).ok_or(*name)?;
        let findings = check(&argument, &analysis);
        assert!(findings.iter().any(|finding| finding.rule == rule), "{name}: {findings:?}");
        rules.insert(rule);
    }
    assert_eq!(rules.len(), 15, "{rules:?}");
    Ok(())
}

#[test]
fn an_error_names_file_and_node() -> Outcome {
    let folder = tempfile::tempdir()?;
    let file = folder.path().join(super::FOLDER).join("index.gsn.yaml");
    std::fs::create_dir_all(file.parent().ok_or("no folder")?)?;
    let head = "module:\n  name: M\n  brief: b\n";
    for (text, says) in [
        (format!("{head}G1:\n  txet: a\n"), "G1: unknown field `txet`"),
        (format!("{head}G1:\n  text: a\nG1:\n  text: b\n"), "G1"),
        ("G1:\n  text: a\n".to_owned(), "has no `module`"),
        (format!("{head}G1:\n  text: [\n"), "index.gsn.yaml"),
    ] {
        std::fs::write(&file, &text)?;
        let error = load(folder.path()).err().map(|error| error.to_string()).unwrap_or_default();
        assert!(error.contains("index.gsn.yaml") && error.contains(says), "{text}: {error}");
    }
    std::fs::write(&file, format!("{head}G1:\n  text: a\n  undeveloped: true\n"))?;
    assert_eq!(load(folder.path())?.modules.len(), 1);
    Ok(())
}

#[test]
fn every_node_is_drawn_once_in_full_and_the_same_twice() -> Outcome {
    let (argument, _) = real()?;
    let (one, two) = (sheets(&argument, &BTreeMap::new())?, sheets(&argument, &BTreeMap::new())?);
    let pictures = |sheets: &[super::Sheet]| sheets.iter().map(|sheet| sheet.svg.clone()).collect::<String>();
    let all = pictures(&one);
    assert_eq!(all, pictures(&two));
    for (_, id, node) in argument.nodes() {
        assert!(all.contains(&format!(">{id}</text>")), "{id} is not drawn");
        assert!(!node.undeveloped || all.contains("undeveloped"), "{id}");
    }
    Ok(())
}
