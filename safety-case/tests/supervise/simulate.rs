//! `supervise simulate` and `supervise disturb` from outside.

use safety_case::replay::{Request, run as replay};
use serde_json::Value;
use supervisor::Sealed;

use crate::common::{Outcome, project, supervise_in};

#[test]
fn a_scenario_is_driven_shown_and_its_log_replays_to_the_same_verdicts() -> Outcome {
    let folder = tempfile::tempdir()?;
    let arguments =
        ["simulate", "ordinary-route", "disturbed-approach", "--json", "s.json", "--html", "s.html", "--log", "logs"];
    let ran = supervise_in(folder.path(), &arguments)?;
    assert_eq!(ran.code, 0, "{}{}", ran.out, ran.err);
    assert!(
        ran.out.contains("pass  ordinary-route: ") && ran.out.contains("   2 everything as demanded"),
        "{}",
        ran.out
    );
    let json: Value = serde_json::from_str(&std::fs::read_to_string(folder.path().join("s.json"))?)?;
    assert_eq!((&json["schema"], &json["as_expected"]), (&Value::from("supervise-simulate"), &Value::from(true)));
    let drives = json["drives"].as_array().ok_or("no drives")?;
    assert_eq!(drives.len(), 2);
    for drive in drives {
        let log = folder.path().join("logs").join(drive["log"].as_str().ok_or("no log")?);
        let request = Request::of(log, Sealed::from_default()?);
        let digest = replay(&request)?.digest.map(|digest| format!("{digest:016x}"));
        assert_eq!(digest.as_deref(), drive["digest"].as_str(), "{}", drive["scenario"]);
    }
    let page = std::fs::read_to_string(folder.path().join("s.html"))?;
    assert!(page.contains("default-src 'none'") && page.contains("<svg") && page.contains("figure 4"), "the page");
    assert!(!page.contains("<script") && !page.contains("https://"));
    Ok(())
}

#[test]
fn scenarios_are_listed_and_bad_ones_are_named() -> Outcome {
    let folder = tempfile::tempdir()?;
    let list = supervise_in(folder.path(), &["simulate", "--list"])?;
    assert!(list.code == 0 && list.out.lines().count() > 30 && list.out.contains("s1-approach/0.7 s"), "{}", list.out);
    std::fs::write(folder.path().join("bad.toml"), "title = \"x\"\nlength = \"long\"\n")?;
    let own = std::fs::read_to_string(project().join("tests/scenarios/ordinary-route.toml"))?;
    std::fs::write(folder.path().join("own.toml"), own.replace("end_speed = [0, 0]", "end_speed = [90, 99]"))?;
    for (arguments, code, message) in [
        (vec!["simulate"], 2, "SCENARIO"),
        (vec!["simulate", "nothing"], 2, "no scenario is called nothing"),
        (vec!["simulate", "bad.toml"], 2, "bad.toml:2: length: "),
        (vec!["simulate", "nowhere.toml"], 2, "nowhere.toml: No such file"),
        (vec!["simulate", "--all", "--shard", "0/2"], 2, "is not K/N"),
        (vec!["simulate", "own.toml"], 1, ""),
    ] {
        let ran = supervise_in(folder.path(), &arguments)?;
        assert_eq!(ran.code, code, "{arguments:?}: {}{}", ran.out, ran.err);
        assert!(ran.err.contains(message), "{arguments:?}: {}", ran.err);
    }
    Ok(())
}

#[test]
fn disturbance_is_counted_in_parts_that_make_the_whole() -> Outcome {
    let folder = tempfile::tempdir()?;
    let common = ["disturb", "--runs", "40", "--km", "5", "--seed", "3"];
    let with = |more: &[&str]| supervise_in(folder.path(), &[&common, more].concat());
    for (shard, file) in [("1/2", "1.json"), ("2/2", "2.json")] {
        let ran = with(&["--shard", shard, "--json", file])?;
        assert!(ran.code < 2, "{}{}", ran.out, ran.err);
    }
    let whole = with(&["--json", "whole.json", "--html", "whole.html"])?;
    assert!(whole.out.contains("simulated, not comparable") && whole.out.contains("per") | whole.out.contains("each"));
    let merged = supervise_in(folder.path(), &["disturb", "--merge", "2.json", "1.json", "--json", "merged.json"])?;
    assert!(merged.code < 2, "{}", merged.err);
    let read = |file: &str| std::fs::read_to_string(folder.path().join(file));
    assert_eq!(read("whole.json")?, read("merged.json")?);
    let half = supervise_in(folder.path(), &["disturb", "--merge", "1.json"])?;
    assert!(half.code == 2 && half.err.contains("1 of 2 parts"), "{}", half.err);
    Ok(())
}

/// What a run came to in the campaign it comes to when it is driven alone.
#[test]
fn a_run_is_driven_again_and_shown() -> Outcome {
    let folder = tempfile::tempdir()?;
    let ran = supervise_in(folder.path(), &["disturb", "--runs", "40", "--km", "0", "--json", "all.json"])?;
    assert_eq!(ran.code, 0, "{}{}", ran.out, ran.err);
    let all: Value = serde_json::from_str(&std::fs::read_to_string(folder.path().join("all.json"))?)?;
    // "run 32: a pedestrian steps out, at 45.25 s"
    let example = all["run_examples"]["Warnings WarningObliged"].as_str().ok_or("nobody is warned")?;
    let (number, rest) = example.strip_prefix("run ").and_then(|rest| rest.split_once(": ")).ok_or("no number")?;
    let (kind, at) = rest.strip_suffix(" s").and_then(|rest| rest.split_once(", at ")).ok_or("no time")?;
    let ran = supervise_in(folder.path(), &["disturb", "--run", number, "--json", "run.json", "--html", "run.html"])?;
    assert_eq!(ran.code, 0, "{}{}", ran.out, ran.err);
    assert!(ran.out.starts_with(&format!("Run {number} of seed 1: {kind}, at ")), "{}", ran.out);
    let told = |line: &str| line.trim_start().starts_with(at) && line.contains("warnings not passed");
    assert!(ran.out.lines().any(told), "{example}: {}", ran.out);
    let run: Value = serde_json::from_str(&std::fs::read_to_string(folder.path().join("run.json"))?)?;
    assert_eq!((&run["schema"], &run["situation"]), (&Value::from("supervise-disturb-run"), &Value::from(kind)));
    let page = std::fs::read_to_string(folder.path().join("run.html"))?;
    assert!(
        page.contains("default-src 'none'") && page.contains("<svg") && page.contains("corridor of the supervisor")
    );
    let both = supervise_in(folder.path(), &["disturb", "--run", "1", "--check"])?;
    assert!(both.code == 2 && both.err.contains("cannot be used with"), "{}", both.err);
    Ok(())
}
