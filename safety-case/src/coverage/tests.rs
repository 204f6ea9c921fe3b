//! The instrumenter against golden text, the shipped sources, and the compiler.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;
use std::process::Command;

use super::{Accepted, Finding, Kind, Plan, Seen, compare, figures, instrument, plan};

fn put_into(source: &str) -> (String, Plan) {
    let mut plan = Plan::default();
    match instrument("x.rs", source, false, &mut plan) {
        Ok(text) => (text, plan),
        Err(error) => unreachable!("{error}: {source}"),
    }
}

/// `::recorder::` is left out, so that it can be read.
fn text(source: &str) -> String {
    put_into(source).0.replace("::recorder::", "")
}

#[test]
fn operators_stay_where_they_are() {
    assert_eq!(
        text("fn f() { let x = a && !(b || c); }"),
        "fn f() { hit(0);let x = ({let __d=Eval::new(0);let __o=__d.c(0,a) && !(__d.c(1,b) || __d.c(2,c));__d.done(__o)}); }"
    );
    assert_eq!(
        text("fn f() { if a < g(b == 1) { c() } }"),
        "fn f() { hit(0);if ({let __d=Eval::new(0);let __o=__d.c(0,a < g(({let __d=Eval::new(1);let __o=__d.c(0,b == 1);\
         __d.done(__o)})));__d.done(__o)}) { hit(1);c() } }"
    );
}

#[test]
fn arms_closures_and_ways_are_points() {
    assert_eq!(
        text("fn f() { match x { A => 1, B => { 2 } } }"),
        "fn f() { hit(0);match x { A => {hit(1);1}, B => {hit(2);{ hit(3);2 }} } }"
    );
    assert_eq!(text("fn f() { x.map(|y| y.z()) }"), "fn f() { hit(0);x.map(|y| {hit(1);y.z()}) }");
    assert_eq!(text("fn f() { g(x?) }"), "fn f() { hit(0);g(tried(1,2,x)?) }");
    assert_eq!(
        text("fn f() { if let A(y) = x { y() } }"),
        "fn f() { hit(0);if let A(y) = x {hit(1); hit(3);y() } else {hit(2);} }"
    );
    assert_eq!(
        text("fn f() { let A(y) = x else { return }; y() }"),
        "fn f() { hit(0);let A(y) = x else {hit(2); hit(3);return };hit(1); hit(4);y() }"
    );
    assert!(
        text("fn f() { match x { A if b => 1, _ => 2 } }")
            .contains("A if ({let __d=Eval::new(0);let __o=__d.c(0,b);__d.done(__o)}) =>")
    );
}

#[test]
fn conditions_are_found_where_they_are_given_to_a_function() {
    for source in [
        "fn f() { x.lower_if(a, b, c); }",
        "fn f() { t.run_while(a, b) }",
        "fn f() { a.then_some(1) }",
        "fn f() { permit!(a => R) }",
        "fn f() -> bool { a }",
        "const fn f() -> bool { a }",
    ] {
        let (text, plan) = put_into(source);
        assert!(text.contains("__d.c(0,a)"), "{text}");
        assert_eq!(plan.decisions.len(), 1, "{source}");
        assert!(!text.contains("const fn"), "nothing is recorded at compile time: {text}");
    }
    let branches = |source| put_into(source).1.decisions.first().is_some_and(|decision| decision.branches);
    assert!(
        branches("fn f() { permit!(a => R) }")
            && branches("fn f() { a.then_some(1) }")
            && branches("fn f() { if a {} }")
    );
    assert!(!branches("fn f() -> bool { a }"));
}

#[test]
fn what_is_not_instrumented_is_said() {
    let (_, plan) = put_into("fn f() { unknown!(a && b); }");
    assert_eq!(plan.left_out.iter().map(|(_, why)| why.as_str()).collect::<Vec<_>>(), ["unknown!"]);
    assert!(put_into("#[cfg(kani)] fn f() { if a {} }").1.decisions.is_empty(), "that is not compiled here");
}

/// Text is only put in: without it every shipped source is what it was.
#[test]
fn nothing_is_taken_out_of_a_shipped_source() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap_or(Path::new("."));
    let Ok((plan, changed)) = plan(root) else { unreachable!("they are there and Rust") };
    let left_out: Vec<&str> = plan.left_out.iter().map(|(place, _)| place.function.as_str()).collect();
    assert_eq!(left_out, ["Timer::reached", "Timer::is_running", "Timer::elapsed"], "and nothing else");
    assert!(plan.points.len() > 500 && plan.points.len() < super::recorder::POINTS);
    assert!(plan.decisions.len() > 200 && plan.decisions.len() < super::recorder::DECISIONS);
    let sources = changed
        .iter()
        .filter(|(file, _)| file.starts_with("supervisor") && file.extension().is_some_and(|of| of == "rs"));
    for (file, text) in sources {
        let before = fs::read_to_string(root.join(file)).unwrap_or_default();
        let (mut rest, mut left) = (before.chars().peekable(), 0_usize);
        for letter in text.chars() {
            if rest.next_if_eq(&letter).is_none() {
                left += 1;
            }
        }
        assert_eq!(rest.next(), None, "{}: it is not a part of what it became", file.display());
        assert_eq!(text.lines().count(), before.lines().count(), "{}: lines stay", file.display());
        assert_eq!(text.chars().count(), before.chars().count() + left);
    }
}

const PROGRAM: &str = r#"
use std::cell::Cell;
thread_local! { static ORDER: Cell<u32> = const { Cell::new(1) }; }
fn asked(digit: u32, value: bool) -> bool {
    ORDER.set(ORDER.get() * 10 + digit);
    value
}
fn deep(x: Option<u32>) -> Option<u32> {
    let Some(y) = x else { return None };
    let z = Some(y)?;
    if let Some(3) = x { Some(30) } else { Some(z) }
}
fn tree(a: bool, b: bool, c: bool) -> u32 {
    let first = asked(1, a) && (asked(2, b) || !asked(3, c));
    let second = match (a, b) {
        (true, _) if asked(4, b) => 1,
        (true, _) => 2,
        (false, b) => b.then(|| 3).unwrap_or(4),
    };
    if first && asked(5, c) { second + 10 } else if asked(6, second == 3 || c) { second + 20 } else { second }
}
fn main() {
    for bits in 0..8 {
        ORDER.set(1);
        println!("{} {}", tree(bits & 1 > 0, bits & 2 > 0, bits & 4 > 0), ORDER.get());
    }
    println!("{:?} {:?} {:?}", deep(None), deep(Some(3)), deep(Some(4)));
}
"#;

fn rustc(folder: &Path, arguments: &[&str]) {
    let done = Command::new("rustc")
        .current_dir(folder)
        .args(["--edition", "2024", "--cap-lints", "allow"])
        .args(arguments)
        .output();
    match done {
        Ok(done) => assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr)),
        Err(error) => unreachable!("rustc: {error}"),
    }
}

/// An instrumented program does what it did, evaluates what it evaluated, and its records show what it did.
#[test]
fn an_instrumented_program_does_what_it_did() {
    let Ok(folder) = tempfile::tempdir() else { unreachable!("there is a temporary folder") };
    let folder = folder.path();
    let (text, plan) = put_into(PROGRAM);
    // The loop's macros, and thread_local.
    assert!(plan.left_out.iter().all(|(_, why)| why == "println!"), "{:?}", plan.left_out);
    let recorder =
        fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("src/coverage/recorder.rs")).unwrap_or_default();
    for (file, text) in [("before.rs", PROGRAM), ("after.rs", &text), ("recorder.rs", &recorder)] {
        assert!(fs::write(folder.join(file), text).is_ok());
    }
    rustc(folder, &["before.rs"]);
    rustc(folder, &["--crate-type", "rlib", "recorder.rs"]);
    rustc(folder, &["--extern", "recorder=librecorder.rlib", "after.rs"]);
    let run = |program: &str| {
        let seen = folder.join("seen.txt");
        let done = Command::new(folder.join(program)).env("SUPERVISE_COVERAGE", seen).output();
        done.map(|done| String::from_utf8_lossy(&done.stdout).into_owned()).unwrap_or_default()
    };
    let before = run("before");
    assert_eq!(before.lines().count(), 9);
    assert_eq!(before, run("after"), "values and the order of evaluation");
    let mut seen = Seen::default();
    assert_eq!(seen.add(&fs::read_to_string(folder.join("seen.txt")).unwrap_or_default()), Ok(()));
    let (_, open) = figures(&plan, &seen);
    let open: Vec<_> = open.iter().map(|open| (open.kind, open.text.as_str())).collect();
    assert_eq!(open, [(Kind::Branch, "Some(y)?: returns")], "everything else was reached, each condition both ways");
}

#[test]
fn a_missing_case_is_reported_and_may_be_listed() {
    let source = "fn f() {\n if a && b {\n  c();\n }\n}\n";
    let (_, plan) = put_into(source);
    let recorded = |lines: &str| {
        let mut seen = Seen::default();
        assert_eq!(seen.add(lines), Ok(()));
        figures(&plan, &seen)
    };
    let whole = "p 0\np 1\nd 0 3 3 1\nd 0 3 1 0\nd 0 1 0 0\n";
    let (rows, open) = recorded(whole);
    assert!(open.is_empty(), "{open:?}");
    let sum = rows.get("x.rs").and_then(|file| file.get("f")).copied().unwrap_or_default();
    assert_eq!((sum.statements.of, sum.branches.of, sum.conditions.of), (2, 2, 2));

    let (_, open) = recorded("p 0\np 1\nd 0 3 3 1\nd 0 1 0 0\n");
    let [missing] = open.as_slice() else { unreachable!("{open:?}") };
    assert_eq!(missing.to_string(), "x.rs:2 f: condition `b` of `a && b`, seen F- → F, TT → T");
    assert_eq!(compare(&open, &[]), [Finding::Open(missing.clone())]);

    let entry = |text: &str| Accepted {
        file: "x.rs".to_owned(),
        function: "f".to_owned(),
        kind: Kind::Condition,
        text: text.to_owned(),
        decision: None,
        reason: "why".to_owned(),
    };
    assert!(compare(&open, &[entry("b")]).is_empty());
    assert_eq!(compare(&open, &[entry("b"), entry("a")]), [Finding::Idle(entry("a"))]);
    assert_eq!(compare(&[], &[entry("b")]), [Finding::Idle(entry("b"))], "covered now");

    let (_, open) = recorded("p 0\nd 0 1 0 0\n");
    let texts: Vec<_> = open.iter().map(|open| open.text.as_str()).collect();
    assert_eq!(texts, ["a && b: true", "a", "b", "c();"]);
}

#[test]
fn a_record_that_is_none_is_refused() {
    for bad in ["x 1", "p", "p -1", "d 1 2 3", "p 1 2", "d 0 1 1 1 1"] {
        assert_eq!(Seen::default().add(&format!("p 1\n{bad}\n")), Err(2), "{bad}");
    }
    let mut seen = Seen::default();
    assert_eq!(seen.add("p 3\np 3\nd 2 1 1 1\n"), Ok(()));
    assert_eq!((seen.points, seen.vectors.len(), seen.full), (BTreeSet::from([3]), 1, BTreeSet::new()));
    assert_eq!(BTreeMap::from_iter(seen.vectors).get(&2).map(BTreeSet::len), Some(1));
}
