//! Structured streams of inputs and commands, over many cycles.

use super::{Reached, judge};
use crate::common::Bus;
use crate::common::random::{Dice, STARTS, change_bus, change_command, change_input, change_scene, cycle, obey, start};

/// So many cycles a stream has at most: a second of driving, ten times.
const LONGEST: u64 = 1_000;

/// A drive: the first byte says where it begins, each event changes a few inputs and commands and lets some cycles pass.
///
/// # Panics
/// If a property, or a claim of the bench's own oracle, does not hold in a cycle.
pub fn command_stream(bytes: &[u8], reached: &mut Reached) {
    let mut dice = Dice::Bytes(bytes);
    let mut bus = start(dice.below(STARTS));
    let end = reached.cycles + LONGEST;
    while !dice.is_used_up() && reached.cycles < end {
        event(&mut bus, &mut dice, reached);
    }
}

fn event(bus: &mut Bus, dice: &mut Dice<'_>, reached: &mut Reached) {
    if let (Some(decision), false) = (bus.last, dice.one_in(8)) {
        obey(&decision.outputs, &mut bus.inputs);
    }
    match dice.below(8) {
        0 => change_bus(dice, &mut bus.inputs),
        1 => change_scene(dice, &mut bus.scene),
        2..=4 => change_command(dice, &mut bus.commands),
        _ => change_input(dice, &mut bus.inputs),
    }
    if dice.one_in(16) {
        bus.follows = !bus.follows;
    }
    // So long that a speed that is lost ends a level.
    let long = dice.one_in(16);
    for _ in 0..if long { 220 } else { dice.of(&[0, 0, 1, 1, 2, 5, 30, 110]) } {
        let (old, inputs, scene, commands) = (bus.state(), bus.inputs, bus.scene.clone(), bus.commands);
        let decision = bus.step_by(if long { 50 } else { cycle(dice) });
        judge(old, bus.now, bus.sealed(), (&inputs, &scene, &commands), &decision);
        reached.look(&decision);
    }
}
