//! The scenarios of `tests/scenarios`, in closed loop: what they demand is so, and the demands can fail.

use std::collections::BTreeSet;
use std::error::Error;

use supervisor_tests::scenario::criteria::Row;
use supervisor_tests::scenario::load::{all, named, parse};
use supervisor_tests::scenario::run::run;
use supervisor_tests::scenario::{Scene, folder};

type Outcome = Result<(), Box<dyn Error>>;

const S1: [&str; 3] = ["s1-approach", "s1-pedestrian", "disturbed-approach"];
const S2: [&str; 2] = ["s2-override", "s2-small-pedal"];
const S3: [&str; 4] = ["s3-leave", "s3-return", "s3-start-without-sequence", "slope-leave"];
const R131: [&str; 3] = ["r131-stationary", "r131-moving", "r131-between-cars"];
const ROAD: [&str; 7] = ["stationary", "moving", "braking-lead", "pedestrian-crossing", "cut-in", "cut-out", "slope"];
const ORDINARY: [&str; 3] = ["low-friction", "ordinary-stop", "ordinary-route"];

fn scenes(names: &[&str]) -> Result<Vec<Scene>, Box<dyn Error>> {
    let names: Vec<String> = names.iter().map(|name| (*name).to_owned()).collect();
    Ok(named(&all(&folder())?, &names)?)
}

fn as_demanded(names: &[&str]) -> Outcome {
    for scene in scenes(names)? {
        let ran = run(&scene, 1)?;
        let missed: Vec<&Row> = ran.rows.iter().filter(|row| !row.passed).collect();
        let standing = scene.expected.standing(&ran.rows);
        assert!(standing.as_expected() && ran.rows.len() >= 3, "{}: {missed:#?}", scene.full_name());
    }
    Ok(())
}

/// MIT-1a, MIT-2a, MIT-3a, MIT-4c, MIT-4h: S1's approach for 0 to 0.7 s of brake dead time, on a busy bus too; level 3.
#[test]
fn the_approach_of_s1_is_as_demanded() -> Outcome {
    as_demanded(&S1)
}

/// TRQ-3a, TRQ-4a, TRQ-4c, MODE-1a: S2's override and hand-over.
#[test]
fn the_override_of_s2_is_as_demanded() -> Outcome {
    as_demanded(&S2)
}

/// SEAT-1a, SEAT-4a, SEAT-5d, SEAT-6a, SEAT-7a, SEAT-7e, SEAT-7k, SEAT-8a, SEAT-9a: S3's sequence, and the return at every stage.
#[test]
fn the_sequence_of_s3_is_as_demanded() -> Outcome {
    as_demanded(&S3)
}

/// MIT-1a, MIT-2a, MIT-3a, FCW-1a, FUS-3e: the tests of UN R131 at 80 km/h, and between two cars that stand.
#[test]
fn the_tests_of_r131_are_as_demanded() -> Outcome {
    as_demanded(&R131)
}

/// MIT-1a, MIT-4c, MIT-6a, FUS-3e: standing, slower, braking and crossing targets, cut-in, cut-out, slopes.
#[test]
fn the_longitudinal_table_is_as_demanded() -> Outcome {
    as_demanded(&ROAD)
}

/// SELF-11a, MIT-6c, RSP-1l: ordinary driving meets no intervention; slipping wheels escalate nothing.
#[test]
fn ordinary_and_slippery_roads_are_as_demanded() -> Outcome {
    as_demanded(&ORDINARY)
}

#[test]
fn every_scenario_is_in_one_of_these_tests() -> Outcome {
    let there: BTreeSet<String> = all(&folder())?.into_iter().map(|scene| scene.name).collect();
    let tested = [&S1[..], &S2, &S3, &R131, &ROAD, &ORDINARY].concat().into_iter().map(str::to_owned).collect();
    assert_eq!(there, tested);
    Ok(())
}

/// A stationary car, not braked for: what a demand must see.
const TEXT: &str = r#"
title = "x"
description = "x"
source = "own"
requirements = ["MIT-1a"]
length = 30
[driver]
acts = [{ at = 10.5, hold = 20 }]
[[other]]
what = "car"
at = 60
[expect]
"#;

#[test]
fn every_demand_can_fail() -> Outcome {
    let fails = [
        "least_gap = 500",
        "rest_gap = [200, 300]",
        "end_speed = [50, 60]",
        "deceleration = [20, 30]",
        "order = [\"standstill\", \"level 1\", \"leave\"]",
        "never = [\"level 1\"]",
        "within = [{ from = \"level 1\", to = \"leave\", takes = [0, 1] }]",
        "within = [{ from = \"level 1\", to = \"standstill\", takes = [100, 200] }]",
    ];
    for demand in fails {
        let scenes = parse("x.toml", "x", &format!("{TEXT}{demand}\n"))?;
        let ran = run(scenes.first().ok_or("no scene")?, 1)?;
        let missed: Vec<&Row> = ran.rows.iter().filter(|row| !row.passed).collect();
        assert_eq!(missed.len(), 1, "{demand}: {:#?}", ran.rows);
    }
    Ok(())
}

#[test]
fn an_error_names_file_and_key() {
    let with = |from: &str, to: &str| parse("x.toml", "x", &TEXT.replace(from, to));
    assert!(with("", "").is_ok());
    for (from, to, message) in [
        ("length = 30", "length = \"long\"", "x.toml:6: length: "),
        ("length = 30", "length = 0", "x.toml: length: is not between"),
        ("length = 30", "lenght = 30", "x.toml:6: lenght: unknown field `lenght`"),
        ("what = \"car\"", "what = \"tram\"", "x.toml:10: what: unknown variant `tram`"),
        ("at = 60", "", "x.toml: other[0].at: either at or gap"),
        ("hold = 20", "hold = 20, brake = 1", "x.toml: driver.acts[0]: a time and exactly one"),
        ("[\"MIT-1a\"]", "[]", "x.toml: requirements: names none"),
        ("[expect]", "[expect]\nnever = [\"level 7\"]", "x.toml: expect.never[0]: nothing is called level 7"),
        (
            "[expect]",
            "[expect]\n[[variant]]\nname = \"v\"\nset = { \"driver.acts.4.hold\" = 1 }",
            "x.toml: variant v: set driver.acts.4.hold: nothing stands there",
        ),
        (
            "[expect]",
            "[expect]\n[[variant]]\nname = \"v\"\nset = { \"bus.mas\" = 1 }",
            "x.toml: variant v: unknown field `mas`",
        ),
    ] {
        let error = with(from, to).map(|_| ()).map_err(|error| error.to_string());
        assert!(error.as_ref().is_err_and(|error| error.starts_with(message)), "{to}: {error:?}");
    }
}
