//! Makes and shows the corpus of the targets that step the supervisor.
//!
//! ```text
//! cargo run --release --example corpus                         what the committed corpus reaches, and how fast
//! cargo run --release --example corpus -- command_stream 5000  tries so many streams more, keeps those that reach more
//! ```
//! The streams come from a fixed seed: bytes of a small generator, and cuts of what was kept before. Exit code 1 if a mode is
//! not reached.

use std::process::ExitCode;
use std::time::Instant;

use supervisor_fuzz::Dice;
use supervisor_fuzz::attack::{Reached, command_stream, differential, wire_bytes};
use supervisor_fuzz::corpus::{files, folder};

type Run = fn(&[u8], &mut Reached);

const TARGETS: [(&str, Run); 3] =
    [("command_stream", command_stream), ("differential", differential), ("wire_bytes", wire_bytes)];
const SEED: u64 = 20_261_126;

/// Tries `count` streams more; what reaches more than all before is kept as a file.
fn make(target: &str, run: Run, count: usize) -> std::io::Result<()> {
    std::fs::create_dir_all(folder(target))?;
    let mut kept = files(target)?;
    let mut reached = Reached::default();
    kept.iter().for_each(|bytes| run(bytes, &mut reached));
    let mut dice = Dice::Number(SEED + kept.len() as u64);
    for tried in 0..count {
        let mut bytes: Vec<u8> = match kept.len() {
            0 => Vec::new(),
            _ if dice.flag() => Vec::new(),
            many => {
                let whole = &kept[dice.below(many)];
                whole[..dice.below(whole.len() + 1)].to_vec()
            }
        };
        let length = bytes.len() + 16 + dice.below(400);
        while bytes.len() < length {
            // Small numbers name what happens; others are values.
            bytes.push(if dice.flag() { dice.byte() } else { dice.byte() & 15 });
        }
        let before = reached.size();
        run(&bytes, &mut reached);
        if reached.size() > before {
            let file = folder(target).join(format!("stream-{:04}", kept.len()));
            std::fs::write(file, &bytes)?;
            kept.push(bytes);
        }
        if tried % 1_000 == 999 {
            eprintln!("{target}: {} of {count} tried, {} kept, {} reached", tried + 1, kept.len(), reached.size());
        }
    }
    Ok(())
}

fn show(target: &str, run: Run) -> std::io::Result<bool> {
    let files = files(target)?;
    let (mut reached, began) = (Reached::default(), Instant::now());
    files.iter().for_each(|bytes| run(bytes, &mut reached));
    let seconds = began.elapsed().as_secs_f64();
    println!("{target}: {} files\n{}", files.len(), reached.report());
    println!(
        "{:.0} streams a second, {:.0} cycles a second\n",
        files.len() as f64 / seconds,
        reached.cycles as f64 / seconds
    );
    Ok(reached.modes_missing().is_empty())
}

fn main() -> std::io::Result<ExitCode> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    if let [target, count] = arguments.as_slice() {
        let known = TARGETS.iter().find(|(name, _)| name == target);
        let (Some((target, run)), Ok(count)) = (known, count.parse()) else {
            eprintln!("usage: corpus [command_stream|differential|wire_bytes COUNT]");
            return Ok(ExitCode::from(2));
        };
        make(target, *run, count)?;
    }
    let mut all = true;
    for (target, run) in TARGETS {
        all &= show(target, run)?;
    }
    Ok(if all { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}
