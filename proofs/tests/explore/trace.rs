//! The way to a finding, for people: what was read, what went out, what changed.

use std::fmt::Write as _;

use stateright::Model;
use supervisor_core::{BrakeMode, Outputs};

use crate::coverage::describe;
use crate::model::{Explorer, Node, Ran};

/// The cycles of a path: the vector of each, and how it ran.
pub struct Drive {
    /// Where it began.
    pub first: Node,
    /// Index of the start.
    pub start: usize,
    /// Every cycle.
    pub cycles: Vec<(usize, Ran)>,
}

/// Runs the actions of a path again, cycle by cycle.
pub fn drive(explorer: &Explorer, first: &Node, actions: &[usize]) -> Drive {
    let start = explorer.init_states().iter().position(|node| node == first).unwrap_or(0);
    let mut at = first.clone();
    let mut cycles = Vec::new();
    for &action in actions {
        let Some(vector) = explorer.of.vectors.get(action) else { break };
        let Some(ran) = explorer.cycles(&at, vector) else { break };
        if let Some(last) = ran.last() {
            at = last.next.clone();
        }
        cycles.extend(ran.into_iter().map(|ran| (action, ran)));
    }
    Drive { first: first.clone(), start, cycles }
}

/// What goes out, without what asks for nothing.
fn words(outputs: &Outputs) -> String {
    let mut text = String::new();
    let mut say = |condition: bool, what: String| {
        if condition {
            // Writing to a String cannot fail.
            let _ = write!(text, "{}{what}", if text.is_empty() { "" } else { ", " });
        }
    };
    let Outputs { drive, brake, gear, epb, steering, contactors, warnings, mode, .. } = outputs;
    say(drive.torque.raw() > 0, format!("torque {} % ({:?})", drive.torque.raw(), drive.origin));
    let decel = f64::from(brake.total.raw()) / 2048.0;
    say(brake.total.raw() > 0 || brake.mode != BrakeMode::Off, format!("brake {decel:.2} m/s²"));
    say(outputs.retarder.torque.raw() > 0, format!("retarder {} %", outputs.retarder.torque.raw()));
    say(gear.code() != 0, format!("gear {gear:?}"));
    say(epb.request.code() != 0, format!("parking brake {:?}", epb.request));
    say(contactors.k4.code() != 0, format!("K4 {:?}", contactors.k4));
    say(contactors.k1.code() != 0, format!("K1 {:?}", contactors.k1));
    say(steering.enable, format!("steers, weight {} %", steering.weight.raw()));
    say(warnings.seat_leave, "seat warning".to_owned());
    say(warnings.hazard_flashers, "flashers".to_owned());
    say(mode.code() != 0, format!("mode {mode:?}"));
    if text.is_empty() { "nothing".to_owned() } else { text }
}

/// The drive as text.
pub fn text(explorer: &Explorer, drive: &Drive) -> String {
    let mut text = String::new();
    let mut put = |line: String| {
        text.push_str(&line);
        text.push('\n');
    };
    put(format!("exploration `{}`, from {:?}", explorer.of.name, explorer.of.starts.get(drive.start)));
    let mut modes = describe(&drive.first.state);
    let mut before: Option<(usize, String)> = None;
    let mut same = 0_u32;
    for (action, Ran { decision, next, .. }) in &drive.cycles {
        let name = explorer.of.vectors.get(*action).map_or("?", |vector| vector.name.as_str());
        let out = words(&decision.outputs);
        let now = describe(&next.state);
        let changes: Vec<String> = modes
            .iter()
            .zip(&now)
            .filter(|(old, new)| old != new)
            .map(|((name, old), (_, new))| format!("{name}: {old} -> {new}"))
            .collect();
        let this = Some((*action, out.clone()));
        if changes.is_empty() && before == this && next.broken.is_none() {
            same += 1;
            continue;
        }
        if same > 0 {
            put(format!("{:>10}   the same for {same} cycles more", ""));
            same = 0;
        }
        let seconds = f64::from(next.state.clock.last.raw()) / 1000.0;
        put(format!("{seconds:>8.3} s  reads: {name}"));
        put(format!("{:>10}   sends: {out}", ""));
        if !changes.is_empty() {
            put(format!("{:>10}   state: {}", "", changes.join(", ")));
        }
        if let Some(broken) = next.broken {
            put(format!("{:>10}   BROKEN: {}", "", explorer.name_of(broken)));
        }
        (modes, before) = (now, this);
    }
    text
}
