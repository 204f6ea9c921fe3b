//! Every loop of the shipped crates has a constant bound (SELF-1): one over anything that is not in this table fails.
//!
//! The search is by text: it knows loop statements and what runs over a collection, and it refuses `while` and `loop`
//! altogether. What it does not know, a new adaptor say, it does not find.

use std::fs;
use std::path::{Path, PathBuf};

/// What a loop looks like in our sources.
const MARKS: [&str; 15] = [
    "for ",
    "while ",
    "loop {",
    ".iter()",
    ".iter_mut()",
    ".into_iter()",
    ".for_each(",
    "from_fn(",
    ".is_sorted_by(",
    ".fold(",
    ".all(",
    ".any(",
    ".position(",
    ".sum::<",
    ".map(|message|",
];

/// What is run over, as it stands in the source, and what bounds it.
const BOUNDS: &[(&str, &str)] = &[
    ("Message::ALL", "messages of the link: Message::COUNT"),
    ("Self::ALL", "messages of the link, or values of an enumeration"),
    ("&mut self.links", "messages of the link: Message::COUNT"),
    ("array::from_fn(|number| link", "messages of the link: Message::COUNT"),
    ("messages.", "messages of the link: Message::COUNT"),
    ("self.signals()", "signals of one message: the table"),
    ("Message::SteeringAngle", "2 frames"),
    ("self.links.get(message.number())", "2 frames"),
    ("Message::RadarPosition", "2 frames"),
    ("Message::SupervisorStatus", "2 frames"),
    ("slot.sent.iter_mut()", "2 frames sent"),
    ("Message::CameraObject", "3 frames"),
    ("in list(", "objects of a list: MAX_RADAR, MAX_CAMERA, and the empty one"),
    ("objects.", "objects of a list: MAX_RADAR, MAX_CAMERA"),
    ("ages.", "objects of a list: MAX_RADAR, MAX_CAMERA"),
    ("in [false, true]", "2 classes"),
    ("in [(Class::", "2 classes"),
    ("self.position(", "no loop: where a point lies"),
    ("sizes.iter()", "2 classes"),
    ("in seen", "MAX_CAMERA"),
    ("in camera", "MAX_CAMERA"),
    ("radar.", "MAX_RADAR"),
    ("camera.", "MAX_CAMERA"),
    (".fold(Assessment::NOTHING", "MAX_RADAR + MAX_CAMERA"),
    ("Channel::ALL", "channels: 12"),
    ("verdicts.iter()", "channels: 12"),
    ("self.events.iter()", "length of the record: its type"),
    ("self.grave.iter()", "length of the record: its type"),
    ("older.unwrap_or_default().iter()", "length of the ring: its type"),
    ("diagnosis.record.iter()", "length of the record: its type"),
    ("values.take(", "events of the record, or TROUBLE_CODES; never more than the caller has room for"),
    ("bytes.into_iter()", "bytes of an answer: SUPERVISOR_ANSWER_BYTES"),
    ("spans.iter()", "arguments of one call of the C interface"),
    ("in troubles", "trouble codes: TROUBLE_CODES"),
    ("self.entries.iter", "trouble codes: TROUBLE_CODES"),
    ("self.active()", "trouble codes: TROUBLE_CODES"),
    ("from_fn(|at|", "8 bytes"),
    ("Faults::NAMES", "faults: at most 32"),
    ("TABLE.iter()", "groups of inputs: the table"),
    ("words.", "words of the state or of the configuration: Words::COUNT"),
    ("chunks.", "words of the configuration: Words::COUNT"),
    ("in self.0", "values of a row: its type"),
    ("self.0.iter()", "values of a row: its type"),
    ("in &mut row", "values of a row: its type"),
    ("values.is_sorted_by", "values of a row: its type"),
    ("in lamps", "6 lamps"),
    ("for byte in bytes", "SEALED_BYTES"),
    ("0..8", "bits of a byte"),
    ("bytes.fold(0, |crc, byte|", "9 bytes: data id and payload"),
    ("payload.to_le_bytes()", "8 bytes"),
    ("insert(payload, 60, 4, 0).to_le_bytes()", "8 bytes and 4 of the identifier"),
    ("id_bytes.into_iter()", "4 bytes"),
    ("[(0, false), (2, true)]", "2 values"),
    ("[(0, Origin::Driver)", "3 values"),
];

fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    let Ok(entries) = fs::read_dir(folder) else { unreachable!("{} is a folder", folder.display()) };
    for path in entries.filter_map(Result::ok).map(|entry| entry.path()) {
        if path.is_dir() {
            sources(&path, found);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            found.push(path);
        }
    }
}

/// Whether a line has the mark; a word only where a word begins, and not in `impl .. for ..`.
fn has(line: &str, mark: &str) -> bool {
    let word = mark.chars().next().is_some_and(char::is_alphabetic);
    line.match_indices(mark).any(|(at, _)| {
        let before = line.get(..at).unwrap_or("");
        !word || ((before.is_empty() || before.ends_with(['{', ';', ' ', ':'])) && !before.contains("impl"))
    })
}

/// A line without its texts: what is quoted is no code.
fn unquoted(line: &str) -> String {
    line.split('"').step_by(2).collect()
}

/// The lines of a source with a loop; comments, texts and unit tests are none.
fn loops(text: &str) -> Vec<&str> {
    let code = text.split("#[cfg(test)]\nmod ").next().unwrap_or("");
    let lines = code.lines().map(str::trim).filter(|line| !line.starts_with("//"));
    lines.filter(|line| MARKS.iter().any(|mark| has(&unquoted(line), mark))).collect()
}

/// The bound of a loop, if it is known to have one.
fn bound(line: &str) -> Option<&'static str> {
    let endless = has(line, "while ") || has(line, "loop {");
    BOUNDS.iter().find(|(over, _)| !endless && line.contains(over)).map(|(_, bound)| *bound)
}

/// SELF-1d: each loop of the shipped crates runs over something of a constant length.
#[test]
fn every_loop_of_the_shipped_crates_has_a_constant_bound() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../supervisor");
    let mut files = Vec::new();
    sources(&root, &mut files);
    // The panic handler of the C library has to be endless; that nothing reaches it is seen in the linked program.
    // What stands in an example does not ship.
    let is_in = |path: &Path, folder: &str| path.components().any(|part| part.as_os_str() == folder);
    files.retain(|path| is_in(path, "src") && !is_in(path, "example") && !path.ends_with("capi/src/panic.rs"));
    files.sort();
    let (mut count, mut unknown) = (0, Vec::new());
    for path in files {
        let Ok(text) = fs::read_to_string(&path) else { unreachable!("{} is a text", path.display()) };
        let name = path.strip_prefix(&root).unwrap_or(&path).display();
        for line in loops(&text) {
            match bound(line) {
                Some(bound) => println!("{name}: {bound} | {line}"),
                None => unknown.push(format!("{name}: {line}")),
            }
            count += 1;
        }
    }
    assert!(unknown.is_empty(), "no bound is known for:\n{}", unknown.join("\n"));
    assert!(count > 30, "the sources were found: {count}");
}

/// SELF-1d: the search finds loops and nothing else, and knows no bound of what nobody bounded.
#[test]
fn the_search_finds_loops() {
    for line in ["for x in y {", "    while x {", "loop {", "'a: loop {", "a.iter().max()", "let a = b.fold(0, f);"] {
        assert_eq!(loops(line).len(), 1, "{line}");
        assert_eq!(bound(line), None, "{line}");
    }
    for line in ["impl A for B {", "// for x in y {", "let before = 1;", "impl<T> Words for Row<T> {", "a.map(f)"] {
        assert!(loops(line).is_empty(), "{line}");
    }
    assert_eq!(bound("while words.next() {"), None);
}
