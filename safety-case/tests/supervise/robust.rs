//! Nothing that stands in a log ends the replay.

use std::fmt::Write;

use crate::common::{Outcome, project, supervise_in};
use safety_case::candump::{Line, parse};

/// A small generator: the same numbers in every run.
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }
    fn below(&mut self, bound: u64) -> usize {
        usize::try_from(self.next() % bound).unwrap_or(0)
    }
}

#[test]
fn any_bytes_and_any_damage_to_a_good_line_are_read() {
    let mut numbers = Numbers(0x5EED);
    let good: [&[u8]; 3] = [
        b"(0.022500) can0 0CF00300#FD00FFFFFFFFFFFF",
        b"(0.022500)  can0  0CF00300   [8]  FD 00 FF FF FF FF FF FF",
        b" (1700000000.000001)  can1  RX - -  7FF   [3]  11 22 33   '.\"3'",
    ];
    let mut frames = 0;
    for round in 0..200_000 {
        let mut line = good.get(round % 3).map(|line| line.to_vec()).unwrap_or_default();
        for _ in 0..=numbers.below(3) {
            let at = numbers.below(u64::try_from(line.len()).unwrap_or(1).max(1));
            let byte = numbers.next().to_le_bytes()[0];
            match numbers.below(4) {
                0 => line.truncate(at),
                1 => line.insert(at.min(line.len()), byte),
                2 if at < line.len() => drop(line.remove(at)),
                _ => line.iter_mut().skip(at).take(1).for_each(|slot| *slot = byte),
            }
        }
        if let Line::Frame(frame, _) = parse(&line) {
            frames += 1;
            assert!(frame.length <= 8 && frame.id <= 0x1FFF_FFFF, "{}", String::from_utf8_lossy(&line));
            assert!(frame.data.iter().skip(usize::from(frame.length)).all(|byte| *byte == 0));
        }
    }
    assert!(frames > 1000, "some survive the damage: {frames}");
}

#[test]
fn any_frames_at_any_times_are_replayed_on_both_roads() -> Outcome {
    let folder = tempfile::tempdir()?;
    let mut numbers = Numbers(0xB05);
    // Every identifier of the link, of the standard messages, and a few that nobody knows.
    let dbc = std::fs::read_to_string(project().join("supervisor/wire/ebus.dbc"))?;
    let known = dbc.lines().filter_map(|line| line.strip_prefix("BO_ ")?.split(' ').next()?.parse::<u32>().ok());
    let mut ids: Vec<u32> = known.map(|id| id & 0x1FFF_FFFF).collect();
    ids.extend([0, 0x123_4567, 0x1FFF_FFFF, 0x0CFE_6CEE, 0x0CF0_0321]);
    let (mut text, mut micros) = (String::new(), 0_u64);
    for _ in 0..50_000 {
        micros = match numbers.below(2000) {
            0 => numbers.next() >> numbers.below(64),
            1 => micros.saturating_sub(numbers.next() % 20_000_000),
            _ => micros.saturating_add(numbers.next() % 2000),
        };
        let id = ids.get(numbers.below(u64::try_from(ids.len())?)).copied().unwrap_or(0);
        write!(text, "({}.{:06}) can0 {id:08X}#", micros / 1_000_000, micros % 1_000_000)?;
        let length = if numbers.below(10) == 0 { numbers.below(9) } else { 8 };
        for byte in numbers.next().to_le_bytes().iter().take(length) {
            // Mostly zeros and ones: values that mean something.
            let byte = if numbers.below(3) == 0 { *byte } else { byte & 0x11 };
            write!(text, "{byte:02X}")?;
        }
        text.push('\n');
    }
    std::fs::write(folder.path().join("wild.log"), text)?;
    let map = project().join("safety-case/maps/ebus.toml").display().to_string();
    for mapping in [vec![], vec!["--map", map.as_str()]] {
        let arguments = [vec!["replay", "wild.log", "-q", "--json", "w.json", "--html", "w.html"], mapping].concat();
        let ran = supervise_in(folder.path(), &arguments)?;
        assert_eq!(ran.code, 0, "{}", ran.err);
        let json: serde_json::Value = serde_json::from_slice(&std::fs::read(folder.path().join("w.json"))?)?;
        assert_eq!(json["summary"]["frames"], 50_000);
    }
    Ok(())
}
