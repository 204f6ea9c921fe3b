//! The committed header: what cbindgen makes of the sources, with the codes of the supervisor's own tables.

use std::error::Error;
use std::path::Path;

use supervisor::report::{Fmi, Lamp, System};
use supervisor::{
    BrakeMode, Channel, ContactorRequest, DrivingMode, EpbMode, EpbRequest, ExitReason, Faults, GearRequest, Kind,
    Level, Mode, Occupancy, Origin, Priority, Reason, Record, ResetCause, RetarderMode, Stage, Wiper,
};
use supervisor_capi::SUPERVISOR_RECORD_BROKEN;

type Outcome = Result<(), Box<dyn Error>>;

fn folder() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// The sources with the tables of codes that a C programmer meets.
const TABLES: [&str; 6] = [
    "terms/src/command.rs",
    "terms/src/input.rs",
    "terms/src/verdict.rs",
    "terms/src/status.rs",
    "terms/src/threat.rs",
    "report/src/code.rs",
];

/// The tables as enumerations with the names that they have in C: cbindgen does not look into `codes!` and `faults!`. What of them
/// goes into the header stands in `cbindgen.toml`.
fn tables() -> Result<String, Box<dyn Error>> {
    let mut made = Vec::new();
    for name in TABLES {
        let text = std::fs::read_to_string(folder().join("..").join(name))?;
        let (mut codes, mut faults) = (false, false);
        for line in text.lines() {
            match line {
                "codes! {" => codes = true,
                "faults! {" => {
                    faults = true;
                    made.push("/// Faults and hints: the bits of `faults` in the status.".to_owned());
                    made.push("#[repr(u32)] pub enum SupervisorFault {".to_owned());
                }
                "}" => {
                    made.extend(faults.then(|| "}".to_owned()));
                    (codes, faults) = (false, false);
                }
                line if codes => made.push(match line.trim().strip_suffix(" {") {
                    Some(table) => format!("#[repr(u8)] pub enum Supervisor{table} {{"),
                    None => line.to_owned(),
                }),
                line if faults => made.push(match line.trim().trim_end_matches(';').split_once(" = ") {
                    Some((fault, bit)) => {
                        let bits = 1_u32.checked_shl(bit.parse()?).ok_or("a fault has no bit")?;
                        format!("{} = {bits},", words(fault))
                    }
                    None => line.to_owned(),
                }),
                _ => {}
            }
        }
    }
    Ok(made.join("\n"))
}

/// `K4_NOT_OPEN` as `K4NotOpen`.
fn words(constant: &str) -> String {
    let word = |word: &str| {
        word.chars().take(1).chain(word.chars().skip(1).map(|letter| letter.to_ascii_lowercase())).collect()
    };
    constant.split('_').map(word).collect::<Vec<String>>().concat()
}

fn made() -> Result<String, Box<dyn Error>> {
    let config = cbindgen::Config::from_file(folder().join("cbindgen.toml"))?;
    let codes = Path::new(env!("CARGO_TARGET_TMPDIR")).join("codes.rs");
    std::fs::write(&codes, tables()?)?;
    let made = cbindgen::Builder::new()
        .with_config(config)
        .with_src(codes)
        .with_src(folder().join("src/lib.rs"))
        .generate()?;
    let mut bytes = Vec::new();
    made.write(&mut bytes);
    Ok(String::from_utf8(bytes)?)
}

/// CMD-5b: the header says what the sources say. `SUPERVISOR_WRITE_HEADER=1` writes it anew.
#[test]
fn the_header_is_what_cbindgen_makes_of_the_sources() -> Outcome {
    let (path, made) = (folder().join("include/supervisor.h"), made()?);
    if std::env::var_os("SUPERVISOR_WRITE_HEADER").is_some() {
        std::fs::write(&path, &made)?;
    }
    let committed = std::fs::read_to_string(&path).unwrap_or_default();
    let again = "run `SUPERVISOR_WRITE_HEADER=1 cargo test -p supervisor-capi --test header` and commit it";
    for (number, (line, should)) in committed.lines().zip(made.lines()).enumerate() {
        assert_eq!(line, should, "{}:{}: {again}", path.display(), number + 1);
    }
    assert!(committed == made, "{} is not whole: {again}", path.display());
    Ok(())
}

/// `K4NotOpen` as `K4_NOT_OPEN`.
fn constant(name: &str) -> String {
    let mut text = String::new();
    let mut before = ' ';
    for (at, letter) in name.char_indices() {
        let after = name.get(at..).and_then(|rest| rest.chars().nth(1)).unwrap_or(' ');
        let word = before.is_lowercase() || after.is_lowercase();
        if at > 0 && letter.is_uppercase() && word {
            text.push('_');
        }
        text.push(letter.to_ascii_uppercase());
        before = letter;
    }
    text
}

/// CMD-5b: every code of the supervisor stands in the header under its own name with its own number, and no other.
#[test]
fn every_code_is_that_of_the_supervisor() -> Outcome {
    let header = std::fs::read_to_string(folder().join("include/supervisor.h"))?;
    let mut known = Vec::new();
    macro_rules! table {
        ($($name:ident),*) => {$(
            for value in $name::ALL {
                let (table, value, code) = (constant(stringify!($name)), constant(&format!("{value:?}")), value.code());
                known.push(format!("SUPERVISOR_{table}_{value} = {code},"));
            }
        )*};
    }
    table!(Channel, Kind, Reason, Origin, BrakeMode, Priority, RetarderMode, GearRequest, EpbRequest, EpbMode);
    table!(ContactorRequest, Wiper, DrivingMode, ResetCause, Record, Mode, Stage, Occupancy, ExitReason, Level);
    table!(Fmi, Lamp, System);
    known.extend(Faults::NAMES.iter().map(|(fault, name)| format!("SUPERVISOR_FAULT_{name} = {},", fault.bits())));
    let broken = format!("#define SUPERVISOR_RECORD_BROKEN {SUPERVISOR_RECORD_BROKEN}\n");
    assert!(header.contains(&broken) && Record::from_code(SUPERVISOR_RECORD_BROKEN).is_none(), "no code of a record");
    for line in &known {
        assert!(header.contains(&format!("    {line}\n")), "the header has no `{line}`");
    }
    // Those of the calls themselves have no other table.
    let own = ["SUPERVISOR_CODE_", "SUPERVISOR_FRAME_FAULT_", "SUPERVISOR_EVENT_KIND_"];
    for line in header.lines().map(str::trim).filter(|line| line.contains(" = ") && line.ends_with(',')) {
        let listed = known.iter().any(|known| known == line) || own.iter().any(|own| line.starts_with(own));
        assert!(listed, "`{line}` is no code of the supervisor");
    }
    assert!(known.len() > 150, "{} codes", known.len());
    Ok(())
}

/// SELF-1c: the lints of this package are those of the workspace but for the one that forbids what C needs.
#[test]
fn the_lints_are_those_of_the_workspace() -> Outcome {
    let workspace = std::fs::read_to_string(folder().join("../../Cargo.toml"))?;
    let own = std::fs::read_to_string(folder().join("Cargo.toml"))?;
    let lints = |text: &str, head: &str| -> Vec<String> {
        let lines = text.lines().skip_while(|line| *line != head).skip(1);
        let lines = lines.take_while(|line| !line.starts_with('['));
        lines.filter(|line| line.contains(" = ") && !line.starts_with('#')).map(str::to_owned).collect()
    };
    for table in ["rust", "clippy"] {
        let theirs = lints(&workspace, &format!("[workspace.lints.{table}]"));
        let ours = lints(&own, &format!("[lints.{table}]"));
        assert!(theirs.len() > 4, "{theirs:?}");
        let excepted = theirs.iter().map(|line| line.replace(r#"unsafe_code = "forbid""#, r#"unsafe_code = "deny""#));
        assert_eq!(ours, excepted.collect::<Vec<_>>());
    }
    Ok(())
}
