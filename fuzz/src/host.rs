//! The parsers of the host: bytes that are no log, no DBC, no mapping give an error that names the place, never a panic.

use safety_case::candump::{Line, Lines, Text, parse};
use safety_case::road::Road;
use supervisor::{Commands, Config, Inputs, Millis, Scene};

/// A log of candump, line by line: what each frame says.
pub fn candump_log(bytes: &[u8]) {
    let mut lines = Lines::new(bytes);
    while let Some(text) = lines.next() {
        if let Text::Line(text) = text {
            let _ = parse(text);
        }
    }
}

/// A mapping, a DBC and a log, with a zero byte between: read, bound to each other, and the log decoded.
pub fn dbc_map(bytes: &[u8]) {
    let mut parts = bytes.splitn(3, |byte| *byte == 0);
    let mut text = || String::from_utf8_lossy(parts.next().unwrap_or_default()).into_owned();
    let (map, dbc, log) = (text(), text(), text());
    let Ok(mut mapped) = Road::of_texts(map, dbc, &Config::DEFAULT) else { return };
    let (mut inputs, mut scene, mut commands) = (Inputs::NEVER, Scene::default(), Commands::ABSENT);
    for (at, line) in (0..).zip(log.lines()) {
        if let Line::Frame(frame, _) = parse(line.as_bytes()) {
            let _ = mapped.accept(Millis::new(at), &frame);
            mapped.sample(Millis::new(at), &mut inputs, &mut scene, &mut commands);
        }
    }
}
