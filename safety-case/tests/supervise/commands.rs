//! The other commands of `supervise` from outside.

use crate::common::{Outcome, project, supervise_in};
use serde_json::Value;

#[test]
fn limits_are_printed_as_text_and_json() -> Outcome {
    let folder = tempfile::tempdir()?;
    let text = supervise_in(folder.path(), &["limits"])?;
    assert_eq!(text.code, 0);
    let row = text.out.lines().find(|line| line.starts_with("comfort_cap ")).ok_or("no comfort_cap")?;
    assert!(row.contains("7168") && row.contains("PHB-1") && row.contains("1/2048 m/s²"), "{row}");
    let json = supervise_in(folder.path(), &["limits", "--json"])?;
    let rows: Value = serde_json::from_str(&json.out)?;
    let rows = rows.as_array().ok_or("no rows")?;
    assert_eq!(rows.len() + 1, text.out.lines().count());
    assert!(rows.iter().all(|row| row["default"].as_array().is_some_and(|values| !values.is_empty())));
    Ok(())
}

#[test]
fn a_configuration_is_sealed_shown_and_used() -> Outcome {
    let folder = tempfile::tempdir()?;
    std::fs::write(folder.path().join("my.toml"), "comfort_cap = 6144\nlevel_ttc = [4500, 3600, 2700]\n")?;
    let sealed = supervise_in(folder.path(), &["config", "seal", "my.toml", "my.bin"])?;
    assert_eq!(sealed.code, 0, "{}", sealed.err);
    assert!(sealed.out.contains("comfort_cap = 6144") && sealed.out.contains("default 7168"), "{}", sealed.out);
    let shown = supervise_in(folder.path(), &["config", "show", "my.bin"])?;
    let changed: Vec<&str> = shown.out.lines().filter(|line| line.starts_with('*')).collect();
    assert_eq!(changed.len(), 2, "{changed:?}");
    std::fs::write(folder.path().join("a.log"), "(0.0) can0 18FEF100#FF0010FFFFFFFFFF\n")?;
    let ran = supervise_in(folder.path(), &["replay", "a.log", "-q", "--config", "my.bin"])?;
    assert_eq!(ran.code, 0, "{}", ran.err);

    let mut bytes = std::fs::read(folder.path().join("my.bin"))?;
    bytes.iter_mut().skip(40).take(1).for_each(|byte| *byte ^= 1);
    std::fs::write(folder.path().join("my.bin"), bytes)?;
    let ran = supervise_in(folder.path(), &["replay", "a.log", "-q", "--config", "my.bin"])?;
    assert_eq!(ran.code, 2);
    assert!(ran.err.contains("my.bin: CRC does not match"), "{}", ran.err);
    Ok(())
}

#[test]
fn a_bad_configuration_names_file_line_and_field() -> Outcome {
    let folder = tempfile::tempdir()?;
    for (text, message) in [
        ("\ncomfort_kap = 1\n", "my.toml:2: `comfort_kap`: is not in the table of limits"),
        ("comfort_cap = 1\n", "my.toml:1: `comfort_cap`: 1 is not in 2048..12288"),
        ("comfort_cap = 3.5\n", "my.toml:1: `comfort_cap`: takes one whole number in 1/2048 m/s²"),
        ("level_ttc = [1, 2]\n", "my.toml:1: `level_ttc`: takes 3 whole numbers in ms"),
        ("level_ttc = [2700, 3600, 4400]\n", "level_ttc falls with the level"),
        ("comfort_cap\n", "my.toml:1: "),
    ] {
        std::fs::write(folder.path().join("my.toml"), text)?;
        let ran = supervise_in(folder.path(), &["config", "seal", "my.toml", "my.bin"])?;
        assert_eq!(ran.code, 2, "{text}");
        assert!(ran.err.contains(message), "{}", ran.err);
        assert!(!folder.path().join("my.bin").exists());
    }
    Ok(())
}

#[test]
fn the_analysis_is_counted_and_its_absence_is_an_error() -> Outcome {
    let folder = tempfile::tempdir()?;
    let ran = supervise_in(folder.path(), &["analysis"])?;
    assert!(ran.code == 0 || ran.code == 1, "{}", ran.err);
    assert!(ran.out.contains(" hazards\n") && ran.out.contains(" findings\n"), "{}", ran.out);
    let ran = supervise_in(folder.path(), &["analysis", "."])?;
    assert_eq!(ran.code, 2);
    assert!(ran.err.contains("item.toml"), "{}", ran.err);
    Ok(())
}

#[test]
fn alone_it_replays_the_shipped_drives_and_links_their_pages() -> Outcome {
    let folder = tempfile::tempdir()?;
    let ran = supervise_in(folder.path(), &[])?;
    assert_eq!(ran.code, 0, "{}", ran.err);
    let pages = project().join("target/supervise");
    let index = std::fs::read_to_string(pages.join("index.html"))?;
    for name in ["approach-correct", "approach-misbehaving", "seat-correct", "seat-misbehaving"] {
        assert!(ran.out.contains(name) && index.contains(&format!("{name}.html")), "{name}");
        assert!(pages.join(format!("{name}.html")).exists() && pages.join(format!("{name}.json")).exists());
    }
    assert!(index.contains("default-src 'none'") && !index.contains("http://") && !index.contains("https://"));
    Ok(())
}
