//! An actuator of few positions: every history of four cycles, against the sentence of SELF-10a.

use supervisor_observe::Moves;

/// What was asked for (after the cycle before) and what is seen, in one cycle.
type Cycle = (Option<u8>, Option<u8>);

const POSITIONS: [Option<u8>; 4] = [None, Some(0), Some(1), Some(2)];

/// Alone: known, another position than the last known one, and not the one asked for last and not yet reached.
fn expected(history: &[Cycle]) -> Vec<bool> {
    let (mut last, mut open): (Option<u8>, Option<u8>) = (None, None);
    let mut found = Vec::new();
    for (asked, seen) in history {
        open = asked.or(open);
        let moved = last.is_some() && seen.is_some() && *seen != last;
        found.push(moved && *seen != open);
        if seen.is_some() && *seen == open {
            open = None;
        }
        last = seen.or(last);
    }
    found
}

fn actual(history: &[Cycle]) -> Vec<bool> {
    let mut moves = Moves::INITIAL;
    let mut found = Vec::new();
    for (asked, seen) in history {
        let (next, alone) = moves.record(*asked).advance(*seen);
        found.push(alone);
        moves = next;
    }
    found
}

fn explore(history: &mut Vec<Cycle>, left: u32, count: &mut u32) {
    *count += 1;
    assert_eq!(actual(history), expected(history), "SELF-10a: {history:?}");
    if left == 0 {
        return;
    }
    for asked in POSITIONS {
        for seen in POSITIONS {
            history.push((asked, seen));
            explore(history, left - 1, count);
            history.pop();
        }
    }
}

/// SELF-10a: all 69 905 histories of up to four cycles, three positions or none asked for and seen.
#[test]
fn every_history() {
    let mut count = 0;
    explore(&mut Vec::new(), 4, &mut count);
    assert_eq!(count, 69_905);
}
