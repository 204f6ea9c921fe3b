//! `supervise replay` from outside: exit codes, messages, JSON, page.

use std::io::Write;
use std::process::{Command, Stdio};

use crate::common::{Outcome, drive, project, ran, supervise_in};
use serde_json::Value;

/// A frame of CCVS1 every 100 ms for `seconds`.
fn speeds(seconds: u32) -> String {
    let line = |index: u32| format!("({}.{:06}) can0 18FEF100#FF0010FFFFFFFFFF\n", index / 10, index % 10 * 100_000);
    (0..seconds * 10).map(line).collect::<Vec<_>>().concat()
}

#[test]
fn help_teaches_with_examples() -> Outcome {
    let folder = tempfile::tempdir()?;
    let help = supervise_in(folder.path(), &["--help"])?;
    assert_eq!(help.code, 0);
    for text in ["Examples:", "supervise replay", "Exit codes:", "limits", "config", "analysis"] {
        assert!(help.out.contains(text), "{text}");
    }
    let replay = supervise_in(folder.path(), &["replay", "--help"])?;
    for text in ["--map", "--json", "--html", "[[input]]", "SELF-3", "--fail-on-intervention"] {
        assert!(replay.out.contains(text), "{text}");
    }
    Ok(())
}

#[test]
fn what_cannot_be_read_is_named_and_ends_with_2() -> Outcome {
    let folder = tempfile::tempdir()?;
    std::fs::write(folder.path().join("picture.png"), b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR\n\0\0")?;
    std::fs::write(folder.path().join("good.log"), speeds(1))?;
    for (arguments, message) in [
        (vec!["replay"], "LOG"),
        (vec!["replay", "nowhere.log"], "nowhere.log: No such file"),
        (vec!["replay", "good.log", "nowhere.log"], "nowhere.log: No such file"),
        (vec!["replay", "."], ".: Is a directory"),
        (vec!["replay", "picture.png"], "is this a candump log? lines not understood"),
        (vec!["replay", "good.log", "--dbc", "my.dbc"], "--map"),
        (vec!["replay", "good.log", "--map", "nowhere.toml"], "nowhere.toml: No such file"),
        (vec!["replay", "good.log", "--config", "good.log"], "good.log: "),
        (vec!["replay", "good.log", "--json", "good.log/x.json"], "x.json: "),
        (vec!["replay", "good.log", "--boot", "sideways"], "power-on"),
        (vec!["frobnicate"], "unrecognized subcommand"),
    ] {
        let ran = supervise_in(folder.path(), &arguments)?;
        assert_eq!(ran.code, 2, "{arguments:?}: {}", ran.err);
        assert!(ran.err.contains(message), "{arguments:?}: {}", ran.err);
    }
    Ok(())
}

#[test]
fn a_bad_mapping_names_file_line_and_signal() -> Outcome {
    let folder = tempfile::tempdir()?;
    std::fs::write(folder.path().join("good.log"), speeds(1))?;
    let map = folder.path().join("my.toml");
    for (text, message) in [
        ("link = maybe\n", "my.toml:1: "),
        ("name = \"x\"\n", "my.toml: maps nothing"),
        ("link = true\ndbc = \"my.dbc\"\n", "my.dbc: No such file"),
        (
            "[[input]]\nfield = \"wheel_speed\"\nmessage = \"CCVS1\"\nsignal = \"WheelSpeed\"\n",
            "my.toml:4: message `CCVS1` of ebus.dbc (built in) has no signal `WheelSpeed`; it has WheelBasedVehicleSpeed",
        ),
    ] {
        std::fs::write(&map, text)?;
        let ran = supervise_in(folder.path(), &["replay", "good.log", "--map", "my.toml"])?;
        assert_eq!(ran.code, 2, "{text}");
        assert!(ran.err.contains(message), "{}", ran.err);
    }
    std::fs::write(folder.path().join("bad.dbc"), "this is no DBC\n")?;
    std::fs::write(&map, "link = true\n")?;
    let ran = supervise_in(folder.path(), &["replay", "good.log", "--map", "my.toml", "--dbc", "bad.dbc"])?;
    assert_eq!(ran.code, 2);
    assert!(ran.err.contains("bad.dbc: not a DBC") && ran.err.contains("1:1"), "{}", ran.err);
    Ok(())
}

#[test]
fn an_empty_log_is_replayed_with_a_warning() -> Outcome {
    let folder = tempfile::tempdir()?;
    std::fs::write(folder.path().join("empty.log"), "")?;
    let ran = supervise_in(folder.path(), &["replay", "empty.log", "--json", "e.json", "--html", "e.html"])?;
    assert_eq!(ran.code, 0, "{}", ran.err);
    assert!(ran.err.contains("not one frame in empty.log"), "{}", ran.err);
    let json: Value = serde_json::from_slice(&std::fs::read(folder.path().join("e.json"))?)?;
    assert_eq!(json["summary"]["cycles"], 0);
    Ok(())
}

#[test]
fn odd_lines_are_counted_and_named_and_never_fatal() -> Outcome {
    let folder = tempfile::tempdir()?;
    let log = format!("{}rubbish\n(2.5) can0 123#00\n(2.6) can0 18FEF100#R\n(2.7) can1 18FEF100#\n", speeds(2));
    std::fs::write(folder.path().join("odd.log"), log)?;
    let ran = supervise_in(folder.path(), &["replay", "odd.log", "--bus", "can0"])?;
    assert_eq!(ran.code, 0, "{}", ran.err);
    for text in [
        "1 × lines not understood: no time stamp",
        "odd.log:21: rubbish",
        "1 × unknown identifier 123",
        "odd.log:22",
        "1 × skipped: remote frames",
        "1 × skipped: frames of another bus",
    ] {
        assert!(ran.out.contains(text), "{text}\n{}", ran.out);
    }
    Ok(())
}

#[test]
fn a_truncated_gzip_is_replayed_as_far_as_it_goes() -> Outcome {
    let folder = tempfile::tempdir()?;
    let whole = std::fs::read(drive("approach-correct"))?;
    std::fs::write(folder.path().join("cut.gz"), whole.get(..whole.len() / 2).unwrap_or_default())?;
    let ran = supervise_in(folder.path(), &["replay", "cut.gz", "-q"])?;
    assert_eq!(ran.code, 0, "{}", ran.err);
    assert!(ran.out.contains("1 × logs that break off") && ran.out.contains("truncated file"), "{}", ran.out);
    Ok(())
}

#[test]
fn a_clock_that_runs_backwards_is_named_and_shows_as_a_clock_fault() -> Outcome {
    let folder = tempfile::tempdir()?;
    std::fs::write(folder.path().join("back.log"), format!("{}{}", speeds(2), speeds(3)))?;
    let ran = supervise_in(folder.path(), &["replay", "back.log", "--json", "b.json"])?;
    assert_eq!(ran.code, 0, "{}", ran.err);
    assert!(ran.out.contains("the log's clock leaps backwards, to 0.00 s (back.log:21) [SELF-3]"), "{}", ran.out);
    let json: Value = serde_json::from_slice(&std::fs::read(folder.path().join("b.json"))?)?;
    let events = json["events"].as_array().ok_or("no events")?;
    let clock = events.iter().find(|event| event["type"] == "clock").ok_or("no clock event")?;
    assert_eq!((&clock["kind"], &clock["place"]), (&"backwards".into(), &"back.log:21".into()));
    let fault = |event: &&Value| event["lane"] == "fault_clock" && event["code"] == 1;
    let faults: Vec<_> = events.iter().filter(fault).collect();
    assert_eq!(faults.iter().map(|event| event["cycles"].as_u64()).collect::<Vec<_>>(), [Some(1)], "one cycle");
    assert_eq!(json["summary"]["cycles"], 191 + 291, "the axis never goes back");
    Ok(())
}

#[test]
fn both_layouts_files_and_pipes_give_the_same() -> Outcome {
    let folder = tempfile::tempdir()?;
    let mut text = String::new();
    std::io::Read::read_to_string(
        &mut flate2::read::GzDecoder::new(std::fs::File::open(drive("approach-correct"))?),
        &mut text,
    )?;
    let spaced = |line: &str| {
        let mut words = line.split_whitespace();
        let (stamp, bus, frame) = (words.next()?, words.next()?, words.next()?);
        let (id, data) = frame.split_once('#')?;
        let bytes: Vec<&str> = (0..data.len() / 2).filter_map(|at| data.get(2 * at..2 * at + 2)).collect();
        Some(format!(" {stamp}  {bus}  {id}   [{}]  {}\r\n", bytes.len(), bytes.join(" ")))
    };
    let other: String = text.lines().filter_map(spaced).collect::<Vec<_>>().concat();
    std::fs::write(folder.path().join("a.log"), &text)?;
    std::fs::write(folder.path().join("b.log"), other)?;
    let events = |name: &str| -> Result<Value, Box<dyn std::error::Error>> {
        let json: Value = serde_json::from_slice(&std::fs::read(folder.path().join(name))?)?;
        Ok(json["events"].clone())
    };
    supervise_in(folder.path(), &["replay", &drive("approach-correct"), "--json", "0.json", "-q"])?;
    supervise_in(folder.path(), &["replay", "a.log", "--json", "a.json", "-q"])?;
    supervise_in(folder.path(), &["replay", "b.log", "--json", "b.json", "-q"])?;
    let mut pipe = Command::new(env!("CARGO_BIN_EXE_supervise"))
        .args(["replay", "-", "--json", "p.json", "-q"])
        .current_dir(folder.path())
        .stdin(Stdio::piped())
        .stdout(Stdio::null())
        .spawn()?;
    pipe.stdin.take().ok_or("no pipe")?.write_all(text.as_bytes())?;
    assert!(pipe.wait()?.success());
    let first = events("0.json")?;
    assert!(first.as_array().is_some_and(|events| events.len() > 50));
    for name in ["a.json", "b.json", "p.json"] {
        assert_eq!(first, events(name)?, "{name}");
    }
    Ok(())
}

#[test]
fn interventions_can_fail_a_build() -> Outcome {
    let folder = tempfile::tempdir()?;
    let ran = supervise_in(folder.path(), &["replay", &drive("approach-misbehaving"), "-q", "--fail-on-intervention"])?;
    assert_eq!(ran.code, 3, "{}", ran.err);
    let ran = supervise_in(folder.path(), &["replay", &drive("approach-misbehaving"), "-q"])?;
    assert_eq!(ran.code, 0, "{}", ran.err);
    std::fs::write(folder.path().join("speeds.log"), speeds(5))?;
    let ran = supervise_in(folder.path(), &["replay", "speeds.log", "-q", "--fail-on-intervention"])?;
    assert_eq!(ran.code, 0, "nobody asked for anything: {}", ran.out);
    Ok(())
}

#[test]
fn the_json_document_keeps_its_schema_and_loses_no_cycle() -> Outcome {
    let folder = tempfile::tempdir()?;
    let ran = supervise_in(folder.path(), &["replay", &drive("approach-misbehaving"), "-q", "--json", "d.json"])?;
    assert_eq!(ran.code, 0, "{}", ran.err);
    let json: Value = serde_json::from_slice(&std::fs::read(folder.path().join("d.json"))?)?;
    assert_eq!((&json["schema"], &json["version"]), (&"supervise-replay".into(), &1.into()));
    for key in ["program", "logs", "mapping", "cycle_s", "events", "summary"] {
        assert!(!json[key].is_null(), "{key}");
    }
    for key in
        ["frames", "frames_taken", "cycles", "from", "to", "interventions", "brief", "longest", "verdicts", "notes"]
    {
        assert!(!json["summary"][key].is_null(), "{key}");
    }
    let events = json["events"].as_array().ok_or("no events")?;
    let cycles = json["summary"]["cycles"].as_u64().ok_or("no cycles")?;
    let channels = [
        "drive_torque",
        "target_speed",
        "service_brake",
        "retarder",
        "gear",
        "parking_brake",
        "steering",
        "contactors",
        "auxiliaries",
        "warnings",
        "body",
        "mode",
    ];
    for channel in channels {
        let mine = || events.iter().filter(|event| event["type"] == "verdict" && event["channel"] == channel);
        assert_eq!(mine().filter_map(|event| event["cycles"].as_u64()).sum::<u64>(), cycles, "{channel}");
        let mut end = json["summary"]["from"].clone();
        for event in mine() {
            assert_eq!(event["t"], end, "{channel}: no hole");
            end = event["until"].clone();
        }
        assert_eq!(end, json["summary"]["to"], "{channel}");
    }
    let count = events.iter().filter(|event| event["type"] == "intervention").count();
    assert_eq!(json["summary"]["interventions"], count);
    Ok(())
}

/// The figure that stands in a page.
fn figure(page: &str) -> Result<Value, Box<dyn std::error::Error>> {
    let start = page.find("const FIGURE = ").ok_or("no figure")? + "const FIGURE = ".len();
    let text = page.get(start..).ok_or("no figure")?;
    Ok(serde_json::Deserializer::from_str(text).into_iter::<Value>().next().ok_or("no figure")??)
}

#[test]
fn the_page_loads_nothing_and_shows_every_verdict() -> Outcome {
    let folder = tempfile::tempdir()?;
    let arguments = ["replay", &drive("approach-misbehaving"), "-q", "--json", "d.json", "--html", "d.html"];
    assert_eq!(supervise_in(folder.path(), &arguments)?.code, 0);
    let page = std::fs::read_to_string(folder.path().join("d.html"))?;
    assert!(page.contains("default-src 'none'; script-src 'unsafe-inline'"), "the browser is told to load nothing");
    // Outside plotly.js, which has addresses of its maps in it and is forbidden to follow them.
    let (before, rest) = page.split_once("/**\n* plotly.js").ok_or("no plotly.js")?;
    let (_, after) = rest.split_once("</script>").ok_or("no end of plotly.js")?;
    for part in [before, after] {
        for load in ["src=", "<link", "@import", "url(", "http://", "https://", "import(", "fetch("] {
            assert!(!part.contains(load), "{load}");
        }
    }
    let figure = figure(&page)?;
    let names = figure["layout"]["yaxis7"]["ticktext"].as_array().ok_or("no lanes")?;
    let traces = figure["data"].as_array().ok_or("no traces")?;
    let json: Value = serde_json::from_slice(&std::fs::read(folder.path().join("d.json"))?)?;
    let number = |value: &Value| value.as_f64().unwrap_or(f64::NAN);
    for event in json["events"].as_array().ok_or("no events")?.iter().filter(|event| event["type"] == "verdict") {
        let name = event["channel"].as_str().unwrap_or_default().replace('_', " ").replace("mode", "mode request");
        let lane = names.iter().position(|lane| *lane == name).ok_or("no lane")?;
        let shown = traces.iter().filter(|trace| trace["type"] == "bar").any(|trace| {
            (0..trace["y"].as_array().map_or(0, Vec::len)).any(|index| {
                let from = number(&trace["base"][index]);
                let to = from + number(&trace["x"][index]);
                trace["y"][index] == lane && from <= number(&event["t"]) + 1e-6 && to >= number(&event["until"]) - 1e-6
            })
        });
        assert!(shown, "{event}");
    }
    Ok(())
}

#[test]
fn a_reader_that_stops_early_is_no_error() -> Outcome {
    let folder = tempfile::tempdir()?;
    let mut child = Command::new(env!("CARGO_BIN_EXE_supervise"))
        .args(["replay", &drive("approach-misbehaving")])
        .current_dir(folder.path())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()?;
    drop(child.stdout.take());
    let ran = ran(&child.wait_with_output()?);
    assert_eq!((ran.code, ran.err.as_str()), (0, ""));
    Ok(())
}

/// The recorded bus: silent from 385.48 to 387.54 s, wrong content for 0.64 s after that.
#[test]
fn the_recorded_bus_shows_its_silence_and_its_return() -> Outcome {
    let log = project().join("../shared/data/ebus/ebus.candump.gz");
    if !log.exists() {
        println!("SKIPPED: {} is not here; the recorded bus was NOT replayed", log.display());
        return Ok(());
    }
    let folder = tempfile::tempdir()?;
    let (log, map) = (log.display().to_string(), project().join("safety-case/maps/ebus.toml").display().to_string());
    for mapping in [vec![], vec!["--map", map.as_str()]] {
        let arguments = [vec!["replay", &log, "-q", "--json", "e.json", "--html", "e.html"], mapping].concat();
        let ran = supervise_in(folder.path(), &arguments)?;
        assert_eq!(ran.code, 0, "{}", ran.err);
        let json: Value = serde_json::from_slice(&std::fs::read(folder.path().join("e.json"))?)?;
        assert_eq!((&json["summary"]["frames"], &json["summary"]["lines_malformed"]), (&40_513.into(), &0.into()));
        let events = json["events"].as_array().ok_or("no events")?;
        let span = |lane: &str, text: &str| {
            let found = |event: &&Value| {
                event["lane"] == lane
                    && event["t"].as_f64() > Some(385.0)
                    && event["text"].as_str().is_some_and(|said| said.starts_with(text))
            };
            events.iter().find(found).map(|event| (event["t"].as_f64(), event["until"].as_f64()))
        };
        // Silent since 385.48 s: stale after the time-out of 250 ms, until the first frame at 387.54 s.
        assert_eq!(span("wheel_speed", "stale"), Some((Some(385.74), Some(387.55))));
        // Wrong content until 388.18 s counts for nothing: known again after 1 s of good frames.
        assert_eq!(span("wheel_speed", "back, but"), Some((Some(387.55), Some(388.58))));
        assert_eq!(span("wheel_speed", "known"), Some((Some(388.58), Some(401.59))));
        // The wrong gear of these 0.64 s was never believed.
        let wrong = |event: &Value| event["lane"] == "gear_confirmed" && event["text"] == "R";
        assert!(!events.iter().any(wrong));
        assert!(std::fs::read_to_string(folder.path().join("e.html"))?.contains("No main controller in this log."));
    }
    Ok(())
}

/// RPT-1c: a drive shows its trouble codes in text, JSON and page: its controller falls silent three times.
#[test]
fn trouble_codes_are_shown_in_text_json_and_page() -> Outcome {
    let folder = tempfile::tempdir()?;
    let log = drive("approach-misbehaving");
    let ran = supervise_in(folder.path(), &["replay", &log, "--json", "t.json", "--html", "t.html"])?;
    assert_eq!(ran.code, 0, "{}", ran.err);
    let line = "trouble code (DM1)      SPN 516432 FMI 9 ×1, amber warning: No drive. The main controller's drive command \
                is missing or damaged. (healed) [RPT-1]";
    assert!(ran.out.contains(line), "{}", ran.out);
    let json: Value = serde_json::from_slice(&std::fs::read(folder.path().join("t.json"))?)?;
    let events = json["events"].as_array().ok_or("no events")?;
    let troubles: Vec<_> = events.iter().filter(|event| event["type"] == "trouble").collect();
    let brief: Vec<_> = troubles.iter().map(|each| (&each["spn"], &each["fmi"], &each["count"])).collect();
    let (nine, one) = (Value::from(9), Value::from(1));
    assert_eq!(brief, [(&516_432.into(), &nine, &one), (&516_448.into(), &nine, &one)]);
    // The code lags the fault: by 0.5 s when it comes, by 10 s when it goes. Three bursts are one occurrence.
    let missing = |event: &&Value| event["lane"] == "fault_drive_command_lost" && event["code"] == 1;
    let bursts: Vec<_> = events.iter().filter(missing).filter(|event| event["cycles"].as_u64() >= Some(50)).collect();
    let [first, .., last] = bursts.as_slice() else { return Err("no bursts".into()) };
    let lag = |key: &str, fault: &Value| Some(troubles.first()?[key].as_f64()? - fault[key].as_f64()?);
    assert!(lag("t", first).is_some_and(|lag| (lag - 0.5).abs() < 0.001), "{first}");
    assert!(lag("until", last).is_some_and(|lag| (lag - 10.0).abs() < 0.001), "{last}");
    assert_eq!(json["summary"]["troubles"].as_array().map(Vec::len), Some(2));
    let page = std::fs::read_to_string(folder.path().join("t.html"))?;
    assert!(page.contains("<h2>Trouble codes (DM1)</h2>") && page.contains("2 active, amber warning lamp"));
    // A drive without any has no such section.
    let ran = supervise_in(folder.path(), &["replay", &drive("approach-correct"), "-q", "--html", "c.html"])?;
    assert_eq!(ran.code, 0, "{}", ran.err);
    assert!(!std::fs::read_to_string(folder.path().join("c.html"))?.contains("Trouble codes"));
    Ok(())
}
