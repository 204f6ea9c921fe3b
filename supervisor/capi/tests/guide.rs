//! The guide: its assumptions of use are those of the safety case.

use std::error::Error;
use std::fmt::Write as _;
use std::path::Path;

const BEGIN: &str =
    "<!-- assumptions: written by SUPERVISOR_WRITE_GUIDE=1 cargo test -p supervisor-capi --test guide -->\n";
const END: &str = "<!-- end of assumptions -->";

/// The value of a line `key = "value"`.
fn value<'a>(line: &'a str, key: &str) -> Option<&'a str> {
    line.strip_prefix(key)?.strip_prefix(" = \"")?.strip_suffix('"')
}

/// The table: one row for each assumption.
fn table(toml: &str) -> Result<String, Box<dyn Error>> {
    let mut text = "| id | assumption | how to verify it |\n|---|---|---|\n".to_owned();
    for entry in toml.split("[[assumption]]").skip(1) {
        let of = |key: &str| {
            let found = entry.lines().find_map(|line| value(line, key));
            found.ok_or_else(|| format!("an assumption without `{key}`: {entry}"))
        };
        writeln!(text, "| {} | {} | {} |", of("id")?, of("text")?, of("verify")?)?;
    }
    Ok(text)
}

/// SELF-4e, SELF-8a: every assumption of use stands in the guide as the safety case has it.
#[test]
fn the_assumptions_are_those_of_the_safety_case() -> Result<(), Box<dyn Error>> {
    let package = Path::new(env!("CARGO_MANIFEST_DIR"));
    let table = table(&std::fs::read_to_string(package.join("../../safety-case/analysis/assumptions.toml"))?)?;
    let path = package.join("README.md");
    let guide = std::fs::read_to_string(&path)?;
    let (before, rest) = guide.split_once(BEGIN).ok_or("the guide has no place for the assumptions")?;
    let (committed, after) = rest.split_once(END).ok_or("the place of the assumptions has no end")?;
    if std::env::var_os("SUPERVISOR_WRITE_GUIDE").is_some() {
        std::fs::write(&path, format!("{before}{BEGIN}{table}{END}{after}"))?;
        return Ok(());
    }
    assert_eq!(committed, table, "run `SUPERVISOR_WRITE_GUIDE=1 cargo test -p supervisor-capi --test guide`");
    assert!(table.lines().count() >= 30, "{table}");
    for id in guide.split("AOU-").skip(1).filter_map(|rest| rest.get(..2)) {
        assert!(table.contains(&format!("| AOU-{id} |")), "AOU-{id} is no assumption");
    }
    Ok(())
}
