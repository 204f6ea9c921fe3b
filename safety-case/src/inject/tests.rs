//! The list refuses what does not exist, the matrix merges, the standing follows from both.

use std::error::Error;
use std::path::{Path, PathBuf};

use super::judge::{Standing, failed, rows};
use super::list::List;
use super::matrix::{Cell, Drive, Matrix, SCHEMA, Sources};
use super::page::page;
use super::run::{Request, campaign};
use super::table::{summary, table};
use crate::analysis::load;

type Tested = Result<(), Box<dyn Error>>;

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("analysis")
}

const ENTRY: &str = r#"
[[fault]]
id = "FI-01"
group = "controller"
what = "Full torque."
inject = "full_torque"
place = "commands"
when = "driving"
lasts_ms = [1000, 2000]
goals = ["SG-01"]
expected = "detected"
reason = "Vetted."
"#;

fn parsed(text: &str) -> Result<List, Box<dyn Error>> {
    Ok(List::parse("faults.toml", text, &load(&folder())?)?)
}

#[test]
fn the_faults_of_this_project_are_whole() -> Tested {
    let list = List::load(&folder())?;
    assert!(list.faults.len() >= 40, "{} faults", list.faults.len());
    let groups = ["controller", "frames", "sensors", "actuators", "clock", "memory", "power"];
    for group in groups {
        let is = |fault: &&super::Fault| serde_json::to_value(fault.group).is_ok_and(|name| name == group);
        assert!(list.faults.iter().any(|fault| is(&fault)), "no fault of {group}");
    }
    Ok(())
}

#[test]
fn an_error_names_file_and_line() -> Tested {
    parsed(ENTRY)?;
    let wrong = [
        ("\"full_torque\"", "\"full_trque\"", "faults.toml:6: no injector is called full_trque"),
        ("\"commands\"", "\"inputs\"", "faults.toml:7: full_torque works in the commands"),
        ("\"driving\"", "\"sometimes\"", "faults.toml:8: nothing is called sometimes"),
        ("[1000, 2000]", "[2000, 1000]", "faults.toml:9: least and greatest duration, both above 0"),
        ("SG-01", "SG-77", "faults.toml:10: no safety goal is called SG-77"),
        ("\"detected\"", "\"residual\"", "faults.toml:11: residual, and no assumption of use"),
        ("\"detected\"", "\"ignored\"", "faults.toml:11: unknown variant `ignored`"),
        ("\"FI-01\"", "\"F1\"", "faults.toml:3: an id has the form FI-07"),
        ("\"Vetted.\"", "\"\"", "faults.toml:12: is empty"),
        ("group", "grop", "faults.toml:4: unknown field `grop`"),
        (
            "\"detected\"",
            "\"residual\"\nassumption = \"AOU-99\"",
            "faults.toml:12: no assumption of use is called AOU-99",
        ),
        ("\"detected\"", "\"detected\"\nassumption = \"AOU-14\"", "faults.toml:12: an assumption of use belongs to"),
    ];
    for (find, replace, expected) in wrong {
        let error = parsed(&ENTRY.replace(find, replace)).err().ok_or(expected)?.to_string();
        assert!(error.starts_with(expected), "{error}");
    }
    let error = parsed(&[ENTRY, ENTRY].concat()).err().ok_or("twice the same id")?.to_string();
    assert_eq!(error, "faults.toml:15: FI-01 is defined more than once");
    Ok(())
}

fn matrix(cells: Vec<Cell>) -> Matrix {
    let drive = Drive { name: "cruise".to_owned(), cycles: 10, interventions: 0, harms: 0 };
    Matrix {
        schema: SCHEMA.to_owned(),
        version: 1,
        seed: 1,
        runs: 2,
        shards: 2,
        sources: Sources::default(),
        drives: vec![drive],
        cells,
    }
}

fn cell(averted: usize, reported: usize, missed: usize) -> Cell {
    let named = Cell { fault: "FI-01".to_owned(), scenario: "cruise".to_owned(), ..Cell::default() };
    Cell { harmless: 1, averted, reported, missed, ..named }
}

#[test]
fn a_missed_fault_stands_against_its_expectation_and_a_known_one_says_so() -> Tested {
    let stands = |text: &str, cell: Cell| -> Result<(Standing, bool), Box<dyn Error>> {
        let (list, matrix) = (parsed(text)?, matrix(vec![cell]));
        let rows = rows(&list, &matrix);
        let row = rows.first().ok_or("no row")?;
        assert!(table(&rows).contains(row.standing.word()) && page(&rows, &matrix)?.contains("FI-01"));
        Ok((row.standing, failed(&rows, &matrix)))
    };
    assert_eq!(stands(ENTRY, cell(3, 0, 0))?, (Standing::AsExpected, false));
    assert_eq!(stands(ENTRY, cell(0, 0, 0))?, (Standing::NotShown, false));
    assert_eq!(stands(ENTRY, cell(3, 0, 1))?, (Standing::Against, true));
    assert_eq!(stands(ENTRY, cell(3, 1, 0))?, (Standing::Against, true), "reported is not averted");
    let reported = ENTRY.replace("\"detected\"", "\"detected\"\neffect = \"reported\"");
    assert_eq!(stands(&reported, cell(3, 1, 0))?, (Standing::AsExpected, false));
    let tolerated = ENTRY.replace("\"detected\"", "\"tolerated\"");
    assert_eq!(stands(&tolerated, cell(1, 0, 0))?, (Standing::Against, true), "dangerous after all");
    let residual = ENTRY.replace("\"detected\"", "\"residual\"\nassumption = \"AOU-14\"");
    assert_eq!(stands(&residual, cell(0, 0, 5))?, (Standing::Residual, false));
    let known = format!("{ENTRY}known = \"late by a cycle\"\n");
    assert_eq!(stands(&known, cell(3, 0, 1))?, (Standing::Known, false));
    Ok(())
}

#[test]
fn a_disturbed_drive_fails_the_campaign() -> Tested {
    let list = parsed(ENTRY)?;
    let mut disturbed = matrix(vec![cell(1, 0, 0)]);
    disturbed.drives.iter_mut().for_each(|drive| drive.interventions = 1);
    let rows = rows(&list, &disturbed);
    assert!(failed(&rows, &disturbed) && summary(&rows, &disturbed).contains("DISTURBED cruise"));
    Ok(())
}

#[test]
fn parts_merge_only_if_they_belong_together() -> Tested {
    let other = Cell { scenario: "stop-and-go".to_owned(), ..cell(1, 0, 0) };
    let (one, two) = (matrix(vec![other]), matrix(vec![cell(2, 0, 0)]));
    let whole = Matrix::merge(vec![one.clone(), two.clone()])?;
    assert_eq!((whole.cells.len(), whole.shards), (2, 1));
    assert_eq!(Matrix::read(&whole.write()?)?, whole, "read as it is written");
    assert!(Matrix::merge(vec![one.clone()]).is_err(), "a part is missing");
    assert!(Matrix::merge(vec![one.clone(), one.clone()]).is_err(), "the same part twice");
    let changed = Matrix { seed: 2, ..two };
    assert!(Matrix::merge(vec![one, changed]).is_err(), "another campaign");
    Ok(())
}

#[test]
fn shards_give_the_whole() -> Tested {
    let list = List::load(&folder())?;
    let request = Request {
        seed: 3,
        runs: 1,
        faults: vec!["FI-04".to_owned(), "FI-17".to_owned()],
        scenarios: vec!["stop-and-go".to_owned(), "behind-a-car".to_owned()],
        ..Request::default()
    };
    let part = |shard| campaign(&list, &Request { shard, ..request.clone() }, Sources::default());
    let whole = part(None)?;
    assert_eq!(Matrix::merge(vec![part(Some((1, 2)))?, part(Some((2, 2)))?])?, whole);
    assert_eq!(whole.cells.iter().map(Cell::runs).sum::<usize>(), 3, "FI-17 needs a clear road");
    let unknown = Request { faults: vec!["FI-999".to_owned()], ..request.clone() };
    assert!(campaign(&list, &unknown, Sources::default()).is_err());
    Ok(())
}
