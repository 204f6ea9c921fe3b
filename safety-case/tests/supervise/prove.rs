//! `supervise prove` from outside, with a stand-in for Kani that exports what a test laid ready: what is tried here is
//! the gate, not a proof.
#![cfg(unix)]

use std::ffi::OsString;
use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::{Value, json};
use tempfile::TempDir;

use crate::common::{Outcome, Ran, ran};

/// Logs the call, waits a moment, and lays the export of the harness where it is asked for, if there is one.
const KANI: &str = r#"#!/bin/sh
here=$(dirname "$0")
[ "$2" = --version ] && exit 0
case " $* " in *" list "*) cp "$here/list.json" kani-list.json; exit ;; esac
[ "${SUPERVISE_CONFIG:-}" ] && echo "configured $SUPERVISE_CONFIG" >> "$here/log"
playback=
while [ $# -gt 0 ]; do
  case $1 in
    --harness) harness=${2##*::} ;;
    --target-dir) target=$2 ;;
    --solver) solver=$2 ;;
    --export-json) export=$2 ;;
    --concrete-playback=print) playback=1 ;;
  esac
  shift
done
if [ $playback ]; then cat "$here/playback"; exit; fi
echo "begin $harness $target $solver" >> "$here/log"
sleep 0.3
echo "end $harness" >> "$here/log"
[ -f "$here/$harness.json" ] && cp "$here/$harness.json" "$export"
[ -f "$here/touch" ] && echo 'fn more() {}' >> "$(cat "$here/touch")"
exit 1
"#;

struct Bench {
    folder: TempDir,
}

impl Bench {
    /// A project with these harnesses, every one of which its Kani will prove.
    fn new(names: &[&str]) -> Result<Self, Box<dyn std::error::Error>> {
        let bench = Self { folder: tempfile::tempdir()? };
        for folder in ["terms", "observe", "core", "perceive", "wire"] {
            bench.write(&format!("root/supervisor/{folder}/src/lib.rs"), "//! Nothing.\n")?;
        }
        let functions: Vec<String> = names.iter().map(|name| format!("#[kani::proof]\nfn {name}() {{}}\n")).collect();
        bench.write("root/proofs/src/harness/m.rs", &functions.concat())?;
        bench.list(names, |_| String::new())?;
        let readme = "<!-- proofs: written by `supervise prove --table --write` -->\n<!-- end of proofs -->\n";
        bench.write("root/proofs/README.md", readme)?;
        bench.known(names)?;
        for name in names {
            bench.export(name, "Success")?;
        }
        bench.write("kani/cargo-kani", KANI)?;
        fs::set_permissions(bench.path("kani/cargo-kani"), fs::Permissions::from_mode(0o755))?;
        Ok(bench)
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn write(&self, name: &str, text: &str) -> std::io::Result<()> {
        let path = self.path(name);
        path.parent().map_or(Ok(()), fs::create_dir_all)?;
        fs::write(path, text)
    }

    fn list(&self, names: &[&str], more: impl Fn(&str) -> String) -> std::io::Result<()> {
        let entry = |name: &&str| {
            format!(
                "[[harness]]\nname = \"{name}\"\npath = \"harness::m\"\nfamily = \"safety\"\n\
                 requirements = [\"SEAT-5a\"]\nextent = \"exhaustive\"\n{}\n",
                more(name)
            )
        };
        self.write("root/proofs/harnesses.toml", &names.iter().map(entry).collect::<String>())
    }

    /// What Kani says when it is asked for all harnesses.
    fn known(&self, names: &[&str]) -> std::io::Result<()> {
        let ids: Vec<String> = names.iter().map(|name| format!("harness::m::{name}")).collect();
        self.write("kani/list.json", &json!({"standard-harnesses": {"m.rs": ids}}).to_string())
    }

    /// What Kani exports for a harness whose assertion has this status.
    fn export(&self, name: &str, status: &str) -> std::io::Result<()> {
        let file = self.path("root").join("proofs/src/harness/m.rs");
        let check = |category: &str, status: &str| {
            json!({"category": category, "status": status, "description": "d", "function": "f",
                "location": {"file": file.display().to_string(), "line": "1"}})
        };
        let checks = [check("assertion", status), check("cover", "Satisfied")];
        let result = json!({"harness_id": format!("harness::m::{name}"), "duration_ms": 5, "checks": checks,
            "status": if status == "Success" { "Success" } else { "Failure" }});
        let export = json!({"metadata": {"timestamp": "now"}, "tools": {"kani": "0", "rustc": "r", "cbmc": "c"},
            "verification_results": {"results": [result]}});
        self.write(&format!("kani/{name}.json"), &export.to_string())
    }

    fn run_with(&self, path: OsString, arguments: &[&str]) -> std::io::Result<Ran> {
        let output = Command::new(env!("CARGO_BIN_EXE_supervise"))
            .args(["prove", "--root"])
            .arg(self.path("root"))
            .args(arguments)
            .current_dir(self.folder.path())
            .env_remove("CARGO_TARGET_DIR")
            .env("PATH", path)
            .output()?;
        Ok(ran(&output))
    }

    fn run(&self, arguments: &[&str]) -> std::io::Result<Ran> {
        let mut path = self.path("kani").into_os_string();
        path.push(":");
        path.push(std::env::var_os("PATH").unwrap_or_default());
        self.run_with(path, arguments)
    }

    fn without_kani(&self, arguments: &[&str]) -> std::io::Result<Ran> {
        self.run_with(self.path("nothing").into_os_string(), arguments)
    }

    fn log(&self) -> std::io::Result<Vec<String>> {
        Ok(fs::read_to_string(self.path("kani/log"))?.lines().map(str::to_owned).collect())
    }

    fn record(&self, name: &str) -> Result<Value, Box<dyn std::error::Error>> {
        Ok(serde_json::from_str(&fs::read_to_string(self.path(name))?)?)
    }

    fn accept(&self) -> Outcome {
        let ran = self.run(&["--table", "--write", &self.path("root/proofs/README.md").display().to_string()])?;
        assert_eq!(ran.code, 0, "{}", ran.err);
        Ok(())
    }
}

fn has(folder: &Path, name: &str) -> bool {
    folder.join(name).exists()
}

#[test]
fn harnesses_run_side_by_side_and_every_one_is_recorded_with_its_raw_result() -> Outcome {
    let bench = Bench::new(&["a", "b", "c"])?;
    bench
        .list(&["a", "b", "c"], |name| if name == "b" { "solver = \"kissat\"\n".to_owned() } else { String::new() })?;
    let ran = bench.run(&["--jobs", "2"])?;
    assert_eq!(ran.code, 0, "{}{}", ran.out, ran.err);
    assert!(ran.out.contains("[3/3] ") && ran.out.contains("3 proved on the present sources; 0 failed"), "{}", ran.out);
    let log = bench.log()?;
    assert!(log.iter().take(2).all(|line| line.starts_with("begin ")), "{log:?}");
    let target = bench.path("root").canonicalize()?.join("target/kani");
    assert!(
        log.contains(&format!("begin a {}/0 minisat", target.display()))
            || log.contains(&format!("begin a {}/1 minisat", target.display())),
        "{log:?}"
    );
    assert!(log.iter().any(|line| line.starts_with("begin b ") && line.ends_with("kissat")), "{log:?}");
    let record = bench.record("root/proofs/record.json")?;
    let names: Vec<&str> =
        record["proofs"].as_array().into_iter().flatten().filter_map(|proof| proof["name"].as_str()).collect();
    assert_eq!(names, ["a", "b", "c"]);
    assert_eq!(record["proofs"][1]["solver"], "kissat");
    assert_eq!(record["proofs"][0]["tools"]["cbmc"], "c");
    assert!(["a", "b", "c"].iter().all(|name| has(&bench.path("root/proofs/results"), &format!("{name}.json.gz"))));

    let ran = bench.run(&["--check"])?;
    assert!(ran.code == 1 && ran.out.contains("OUTDATED: the table"), "{}", ran.out);
    bench.accept()?;
    let ran = bench.run(&["--check"])?;
    assert_eq!(ran.code, 0, "{}", ran.out);
    Ok(())
}

#[test]
fn a_failure_a_missing_result_and_a_vacuous_proof_fail_and_stop_no_other() -> Outcome {
    let bench = Bench::new(&["a", "b", "c", "d"])?;
    bench.export("a", "Failure")?;
    fs::remove_file(bench.path("kani/b.json"))?;
    bench.export("c", "Unreachable")?;
    fs::write(
        bench.path("kani/c.json"),
        fs::read_to_string(bench.path("kani/c.json"))?.replace("Satisfied", "Unsatisfiable"),
    )?;
    let ran = bench.run(&["--jobs", "1"])?;
    assert_eq!(ran.code, 1);
    for line in ["a: FAILED: d (proofs/src/harness/m.rs:1)", "b: NO RESULT", "c: UNDETERMINED", "d: proved"] {
        assert!(ran.out.contains(line), "{line}\n{}", ran.out);
    }
    assert!(
        ran.out.contains("--playback --harness a") && ran.out.contains("1 proved on the present sources; 3 failed"),
        "{}",
        ran.out
    );
    let ran = bench.run(&["--harness", "d"])?;
    assert_eq!(ran.code, 0, "{}", ran.out);
    bench.export("a", "Success")?;
    let ran = bench.run(&["--stale"])?;
    assert!(ran.code == 1 && ran.out.contains("[3/3] ") && !ran.out.contains("] d: "), "{}", ran.out);
    assert!(ran.out.contains("2 proved on the present sources; 2 failed"), "{}", ran.out);
    bench.export("a", "Failure")?;
    let ran = bench.run(&["--harness", "a", "d"])?;
    assert_eq!(ran.code, 1, "{}", ran.out);
    let ran = bench.run(&["--harness", "x"])?;
    assert!(ran.code == 2 && ran.err.contains("no harness named x"), "{}", ran.err);
    Ok(())
}

#[test]
fn without_kani_the_record_is_shown_and_nothing_is_called_a_success() -> Outcome {
    let bench = Bench::new(&["a"])?;
    let ran = bench.without_kani(&[])?;
    assert_eq!(ran.code, 1);
    assert!(ran.out.contains("stated, NOT RUN") && ran.out.contains("NOT RUN HERE"), "{}", ran.out);
    assert_eq!(bench.run(&[])?.code, 0);
    bench.accept()?;
    for arguments in [&[][..], &["--quick"], &["--harness", "a"]] {
        let ran = bench.without_kani(arguments)?;
        assert_eq!(ran.code, 4, "{}", ran.out);
        assert!(ran.out.contains("a ") && ran.out.contains("NOT RUN HERE"), "{}", ran.out);
    }
    assert_eq!(bench.without_kani(&["--check"])?.code, 0);

    bench.write("root/supervisor/core/src/lib.rs", "//! Nothing, said differently.\n")?;
    assert_eq!(bench.without_kani(&["--check"])?.code, 0, "a comment");
    bench.write("root/supervisor/core/src/lib.rs", "fn more() {}\n")?;
    let ran = bench.without_kani(&["--check"])?;
    assert!(ran.code == 1 && ran.out.contains("STALE (was: proved)"), "{}", ran.out);
    Ok(())
}

#[test]
fn a_record_without_its_raw_result_or_against_it_does_not_count() -> Outcome {
    let bench = Bench::new(&["a", "b"])?;
    bench.export("b", "Failure")?;
    assert_eq!(bench.run(&[])?.code, 1);
    bench.accept()?;
    let path = bench.path("root/proofs/record.json");
    let honest = fs::read_to_string(&path)?;
    let mut record: Value = serde_json::from_str(&honest)?;
    let b = record["proofs"][1].as_object_mut().ok_or("no entry")?;
    b.insert("verdict".to_owned(), json!("proved"));
    b.remove("why");
    fs::write(&path, record.to_string())?;
    let ran = bench.run(&["--check"])?;
    assert!(ran.code == 1 && ran.out.contains("UNSUPPORTED: the raw result says: FAILED"), "{}", ran.out);
    fs::write(&path, honest)?;
    fs::remove_file(bench.path("root/proofs/results/a.json.gz"))?;
    let ran = bench.run(&["--check"])?;
    assert!(ran.code == 1 && ran.out.contains("a.json.gz"), "{}", ran.out);
    Ok(())
}

#[test]
fn list_sources_and_kani_must_know_the_same_harnesses() -> Outcome {
    let bench = Bench::new(&["a", "b"])?;
    bench.known(&["a", "b", "c"])?;
    let ran = bench.run(&[])?;
    assert!(ran.code == 1 && ran.out.contains("NOT LISTED: harness::m::c"), "{}", ran.out);
    bench.accept()?;
    assert_eq!(bench.run(&["--check"])?.code, 0, "what a macro makes is only seen by Kani");
    bench.known(&["a"])?;
    let ran = bench.run(&["--quick"])?;
    assert!(ran.code == 1 && ran.out.contains("MISSING: harness::m::b"), "{}", ran.out);
    bench.list(&["a"], |_| String::new())?;
    let ran = bench.run(&["--check"])?;
    assert!(
        ran.code == 1 && ran.out.contains("NOT LISTED: harness::m::b") && ran.out.contains("OUTDATED: the record"),
        "{}",
        ran.out
    );
    Ok(())
}

#[test]
fn a_quick_run_compares_and_keeps_the_record() -> Outcome {
    let bench = Bench::new(&["a", "b", "c"])?;
    bench.list(&["a", "b", "c"], |name| if name == "a" { "key = true\n".to_owned() } else { String::new() })?;
    assert_eq!(bench.run(&[])?.code, 0);
    let before = fs::read(bench.path("root/proofs/record.json"))?;
    let ran = bench.run(&["--quick"])?;
    assert_eq!(ran.code, 0, "{}", ran.out);
    assert!(ran.out.contains("key: a\n") && ran.out.contains("2 of 2 harnesses proved again, of 3"), "{}", ran.out);
    bench.export("a", "Failure")?;
    let ran = bench.run(&["--quick"])?;
    assert!(ran.code == 1 && ran.out.contains("a: DIFFERS from the record"), "{}", ran.out);
    assert_eq!(before, fs::read(bench.path("root/proofs/record.json"))?);
    Ok(())
}

#[test]
fn shards_together_make_the_record() -> Outcome {
    let names = ["a", "b", "c", "d", "e"];
    let bench = Bench::new(&names)?;
    for shard in ["1/2", "2/2"] {
        let ran = bench.run(&["--shard", shard])?;
        assert_eq!(ran.code, 0, "{}", ran.out);
    }
    assert!(!bench.path("root/proofs/record.json").exists());
    let parts = ["1", "2"].map(|part| format!("root/target/kani/shard-{part}-of-2/record.json"));
    let counts: Vec<usize> = parts
        .iter()
        .map(|part| Ok(bench.record(part)?["proofs"].as_array().map_or(0, Vec::len)))
        .collect::<Result<_, Box<dyn std::error::Error>>>()?;
    assert_eq!(counts.iter().sum::<usize>(), 5, "{counts:?}");
    let paths = parts.map(|part| bench.path(&part).display().to_string());
    let ran = bench.without_kani(&["--merge", &paths[0]])?;
    assert!(ran.code == 1 && ran.out.contains("NOT RUN"), "{}", ran.out);
    let ran = bench.without_kani(&["--merge", &paths[0], &paths[1]])?;
    assert_eq!(ran.code, 0, "{}", ran.out);
    assert_eq!(bench.record("root/proofs/record.json")?["proofs"].as_array().map_or(0, Vec::len), 5);
    Ok(())
}

#[test]
fn sources_that_change_during_a_run_are_not_recorded_as_proved() -> Outcome {
    let bench = Bench::new(&["a"])?;
    bench.write("kani/touch", &bench.path("root/supervisor/core/src/lib.rs").display().to_string())?;
    let ran = bench.run(&[])?;
    assert!(ran.code == 2 && ran.err.contains("the sources changed"), "{}", ran.err);
    assert!(!bench.path("root/proofs/record.json").exists());
    Ok(())
}

#[test]
fn a_users_configuration_has_a_record_of_its_own() -> Outcome {
    let bench = Bench::new(&["a", "b"])?;
    bench.write("my.toml", "comfort_cap = 6144\n")?;
    let seal = ["config", "seal", "my.toml", "my.bin"];
    assert_eq!(crate::common::supervise_in(bench.folder.path(), &seal)?.code, 0);
    let ran = bench.run(&["--config", "my.bin"])?;
    assert!(ran.code == 2 && ran.err.contains("no harness"), "{}", ran.err);
    bench.list(&["a", "b"], |name| if name == "b" { "configured = true\n".to_owned() } else { String::new() })?;
    let ran = bench.run(&["--config", "my.bin"])?;
    assert_eq!(ran.code, 0, "{}{}", ran.out, ran.err);
    let record = bench.record("my.bin.proofs.json")?;
    assert_eq!(record["proofs"].as_array().map_or(0, Vec::len), 1);
    assert!(has(&bench.path("my.bin.proofs"), "b.json.gz") && !bench.path("root/proofs/record.json").exists());
    let sealed = bench.path("my.bin").canonicalize()?;
    assert!(bench.log()?.contains(&format!("configured {}", sealed.display())));
    assert_eq!(bench.run(&["--config", "my.bin", "--check"])?.code, 0);

    let mut bytes = fs::read(&sealed)?;
    bytes.iter_mut().skip(40).take(1).for_each(|byte| *byte ^= 1);
    fs::write(&sealed, bytes)?;
    let ran = bench.run(&["--config", "my.bin"])?;
    assert!(ran.code == 2 && ran.err.contains("CRC does not match"), "{}", ran.err);
    Ok(())
}

#[test]
fn a_counterexample_becomes_a_test() -> Outcome {
    let bench = Bench::new(&["a"])?;
    bench.export("a", "Failure")?;
    bench.write(
        "kani/playback",
        "said\n```\n/// Check for `assertion`: \"d\"\n#[test]\nfn kani_concrete_playback_a_1() {}\n```\n",
    )?;
    assert_eq!(bench.run(&[])?.code, 1);
    let ran = bench.run(&["--playback"])?;
    assert_eq!(ran.code, 0, "{}{}", ran.out, ran.err);
    let text = fs::read_to_string(bench.path("root/target/kani/a-playback.rs"))?;
    assert!(
        text.contains("proofs/src/harness/m.rs") && text.contains("#[test]\nfn kani_concrete_playback_a_1() {}"),
        "{text}"
    );
    bench.write("kani/playback", "nothing\n")?;
    let ran = bench.run(&["--playback", "--harness", "a"])?;
    assert!(ran.out.contains("a: fails no check that a test could show"), "{}", ran.out);
    Ok(())
}
