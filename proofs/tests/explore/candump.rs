//! The way to a finding as a log of frames that `supervise replay` shows.
//!
//! The link is not a wire: it takes time to trust a sender, and it samples by its periods. The log therefore begins with
//! the first cycle held until every input is known, and what comes after is what the supervisor reads *by the link*:
//! an input that is unknown for one cycle only stays unknown longer, and what is held for a timer is held a period longer.
//! The text beside it is the exact way.

use std::error::Error;
use std::fmt::Write as _;
use std::fs;

use supervisor_core::{Commands, Config, Inputs, Millis, Record, ResetCause, State};
use supervisor_perceive::{Scene, perceive};
use supervisor_proofs::properties::Witness;
use supervisor_wire::{Frame, Receiver, Sender};

use crate::model::{Explorer, TICK};
use crate::report::folder;
use crate::trace::Drive;

/// The replay steps every 10 ms.
const STEP: u32 = 10;
/// The longest period of the link, in ms.
const SLOWEST: u32 = 200;
/// A vector that is held for more cycles than this is held for a timer, and longer by that period.
const LONG: usize = 4;
/// Between two frames, in µs.
const SPACING: u64 = 100;

/// The log of a drive.
fn log(explorer: &Explorer, drive: &Drive) -> String {
    let (mut sensors, mut controller) = (Sender::new(), Sender::new());
    let mut text = String::new();
    let mut now = 0_u32;
    let mut steps = |count: u32, inputs: &Inputs, scene: &Scene, commands: &Commands| {
        for _ in 0..count {
            let mut micros = u64::from(now) * 1000 + 1000;
            now += STEP;
            let mut put = |frame: Frame| {
                // Writing to a String cannot fail.
                let _ = write!(text, "({:010}.{:06}) can0 {:08X}#", micros / 1_000_000, micros % 1_000_000, frame.id);
                for byte in frame.data.iter().take(usize::from(frame.length)) {
                    let _ = write!(text, "{byte:02X}");
                }
                text.push('\n');
                micros += SPACING;
            };
            sensors.encode_inputs(Millis::new(now), inputs, scene, &mut put);
            controller.encode_commands(Millis::new(now), commands, &mut put);
        }
    };
    // Until every sender is trusted, and what is held long enough to be a timer's: the slowest sends every 200 ms.
    let trusted = explorer.of.config.requalify.raw() + 2 * SLOWEST;
    let mut before = None;
    for (index, (action, ran)) in drive.cycles.iter().enumerate() {
        let run = drive.cycles.iter().skip(index).take_while(|(other, _)| other == action).count();
        let last = index + 1 == drive.cycles.len();
        let begins = before.replace(*action) != Some(*action);
        let extra = match index {
            0 => trusted,
            _ if last || begins && run > LONG => SLOWEST,
            _ => 0,
        };
        if let Some(vector) = explorer.of.vectors.get(*action) {
            steps((TICK.raw() + extra) / STEP, &ran.inputs, &vector.scene, &vector.commands);
        }
    }
    text
}

/// Writes log and configuration; the command that shows them.
pub fn write(slice: &str, explorer: &Explorer, drive: &Drive) -> Result<String, Box<dyn Error>> {
    let name = |suffix: &str| folder().join(format!("{slice}-counterexample.{suffix}"));
    fs::create_dir_all(folder())?;
    fs::write(name("candump"), log(explorer, drive))?;
    fs::write(name("sealed"), explorer.of.sealed.to_bytes())?;
    let start = explorer.of.starts.get(drive.start).ok_or("no such start")?;
    let boot = match start.cause {
        ResetCause::PowerOn => "power-on",
        ResetCause::Watchdog => "watchdog",
        ResetCause::Other => "other",
    };
    let record = match start.record {
        Some(Record::None) => "none",
        Some(Record::Leave) => "leave",
        Some(Record::HighVoltageDown) => "hv-down",
        None => "lost",
    };
    Ok(format!(
        "cargo run --release -- replay {} --config {} --boot {boot} --record {record}",
        name("candump").display(),
        name("sealed").display()
    ))
}

fn frame(line: &str) -> Option<(u64, Frame)> {
    let (stamp, rest) = line.strip_prefix('(')?.split_once(") can0 ")?;
    let (seconds, micros) = stamp.split_once('.')?;
    let (id, digits) = rest.split_once('#')?;
    let mut frame = Frame { id: u32::from_str_radix(id, 16).ok()?, length: 0, data: [0; 8] };
    for (byte, at) in frame.data.iter_mut().zip((0..digits.len()).step_by(2)) {
        *byte = u8::from_str_radix(digits.get(at..at + 2)?, 16).ok()?;
        frame.length += 1;
    }
    Some((seconds.parse::<u64>().ok()? * 1_000_000 + micros.parse::<u64>().ok()?, frame))
}

/// Replays a log as `supervise replay` does, a step at every multiple of 10 ms: every cycle as it ran.
pub fn replay(log: &str, config: &Config, state: State) -> Result<Vec<Witness>, Box<dyn Error>> {
    let mut receiver = Receiver::new(config);
    let mut ran = Vec::new();
    let (mut state, mut now) = (state, STEP);
    for line in log.lines() {
        let (micros, frame) = frame(line).ok_or_else(|| format!("no frame: {line}"))?;
        while u64::from(now) * 1000 <= micros {
            let sample = receiver.sample(Millis::new(now));
            let threat = perceive(sample.scene, config);
            let witness = Witness::of(state, Millis::new(now), sample.inputs, &threat, sample.commands, config);
            state = witness.next;
            ran.push(witness);
            now += STEP;
        }
        // A frame that is refused (the first command has no predecessor) shows in the sample.
        let _ = receiver.accept(Millis::new(u32::try_from(micros / 1000)?), &frame);
    }
    Ok(ran)
}
