//! Endurance: eight hours change nothing, nor does a wrap of the clock (END-1a, END-1b).
//!
//! The script of `endurance/script.rs` lasts twelve minutes and is played again and again, in cycles of 10 ms. Debug
//! builds play three passes of it and try fewer wraps; the full eight hours run in release builds (`.ci/run`).

mod common;
#[path = "endurance/script.rs"]
mod script;

use common::*;
use script::{LENGTH, ROAD, SCRIPT};

/// Passes of twelve minutes after the first: forty are eight hours, 2.88 million cycles.
const PASSES: u32 = if cfg!(debug_assertions) { 2 } else { 40 };

/// Whoever plays the script.
struct Player {
    bus: Bus,
    acts: &'static [(u32, Edit)],
    at: u32,
}

impl Player {
    /// From the start of the script, with this bus.
    fn of(bus: Bus) -> Self {
        Self { bus, acts: SCRIPT, at: 0 }
    }

    /// What is due now.
    fn act(&mut self) {
        while let Some(((due, act), rest)) = self.acts.split_first() {
            if *due > self.at {
                break;
            }
            act(&mut self.bus);
            self.acts = rest;
        }
    }

    /// One cycle, judged by the oracle or not.
    fn cycle(&mut self, elapsed: u32, judged: bool) -> Decision {
        self.act();
        self.at += elapsed;
        if judged { self.bus.step_by(elapsed) } else { self.bus.step_unjudged(elapsed) }
    }
}

fn booted(now: u32) -> Bus {
    let mut bus = Bus::boot(ResetCause::PowerOn, Some(Record::None), healthy());
    bus.now = now;
    bus
}

/// A pass of the script in cycles of 10 ms: every decision.
fn pass(bus: Bus, judged: bool, mut look: impl FnMut(usize, &Decision)) -> Bus {
    let mut player = Player::of(bus);
    for index in 0..usize::try_from(LENGTH / CYCLE).unwrap_or(0) {
        look(index, &player.cycle(CYCLE, judged));
    }
    player.bus
}

/// The script is worth playing: every machine moves.
fn assert_touches_everything(decisions: &[Decision]) {
    let seen = |ask: fn(&Decision) -> bool| decisions.iter().any(ask);
    for level in LEVELS {
        assert!(decisions.iter().any(|decision| decision.status.level == level), "{level:?}");
    }
    for stage in Stage::ALL {
        assert!(decisions.iter().any(|decision| decision.status.stage == *stage), "{stage:?}");
    }
    for mode in Mode::ALL {
        assert!(decisions.iter().any(|decision| decision.status.mode == *mode), "{mode:?}");
    }
    for occupancy in Occupancy::ALL {
        assert!(decisions.iter().any(|decision| decision.status.occupancy == *occupancy), "{occupancy:?}");
    }
    assert!(seen(applies) && seen(released) && seen(opens_k4) && seen(opens_k1) && seen(closes));
    assert!(seen(|decision| decision.outputs.steering.weight == Percent::FULL), "steering acts");
    assert!(seen(|decision| decision.status.faults.contains(Faults::TAKEOVER)), "the driver takes over");
    assert!(seen(|decision| decision.outputs.drive.torque > percent(40)), "the driver drives");
    assert!(seen(|decision| decision.outputs.drive.origin == Origin::Adas), "the assistance drives");
    assert!(seen(|decision| decision.status.faults.contains(Faults::BRAKE_COMMAND_LOST)), "the brake ramps");
    assert!(decisions.iter().all(|decision| !decision.status.safe_state), "and nothing is faulty");
}

/// What the first pass, which begins at a boot, cannot share with the others: until the seat is confirmed (1 s), and,
/// until a mode has begun in this very pass, the record of why the last one ended.
fn after_start(index: usize, decision: &Decision, begun: &mut bool) -> Option<Decision> {
    *begun |= decision.status.mode != Mode::Manual;
    let exit = if *begun { decision.status.exit } else { ExitReason::None };
    (index >= CONFIRMED).then_some(Decision { status: Status { exit, ..decision.status }, ..*decision })
}

/// Cycles until the seat is confirmed after a boot, and what that permits is settled.
const CONFIRMED: usize = 101;

/// END-1a: the script played after eight hours gives the very decisions of the script after start, field by field, and
/// so does every pass between.
#[test]
fn eight_hours_change_no_decision() {
    let (mut first, mut start, mut begun) = (Vec::new(), Vec::new(), false);
    let bus = pass(booted(0), true, |index, decision| {
        first.push(*decision);
        start.push(after_start(index, decision, &mut begun));
    });
    assert_touches_everything(&first);
    let mut second = Vec::new();
    begun = false;
    let mut bus = pass(bus, true, |index, decision| {
        let now = after_start(index, decision, &mut begun);
        assert_eq!(start.get(index), Some(&now), "cycle {index} of the second pass and of the first");
        second.push(*decision);
    });
    let mut cycles = first.len() + second.len();
    for number in 2..=PASSES {
        bus = pass(bus, false, |index, decision| {
            cycles += 1;
            assert!(Some(decision) == second.get(index), "cycle {index} of pass {number} and of the second");
        });
    }
    println!("{cycles} cycles of 10 ms: {} passes of {LENGTH} ms, every decision the same", PASSES + 1);
    assert!(
        cfg!(debug_assertions) || bus.now - LENGTH >= 8 * 3_600_000,
        "the last pass begins eight hours after start"
    );
}

/// Cycles that do not all last 10 ms; ten of them last 100 ms.
const UNEVEN: [u32; 10] = [10, 9, 11, 10, 1, 19, 10, 12, 8, 10];

/// END-1b: with a clock that begins before its wrap, anywhere in the script, every decision is the one of a clock that
/// begins at 0.
#[test]
fn a_wrap_anywhere_in_the_script_changes_no_decision() {
    let step = if cfg!(debug_assertions) { 120_000 } else { 12_000 };
    let mut wraps = 0;
    for before in (0..LENGTH).step_by(step) {
        // A little before a whole cycle, so that the wrap falls between two and on one.
        let starts = [0, 0_u32.wrapping_sub(before + 7)];
        let [mut even, mut wrapped] = starts.map(|now| Player::of(booted(now)));
        let until = LENGTH.min(before + 30_000);
        for elapsed in UNEVEN.iter().cycle() {
            if even.at >= until {
                break;
            }
            let (was, is) = (even.cycle(*elapsed, false), wrapped.cycle(*elapsed, false));
            assert_eq!(was, is, "{} ms after the start, {before} ms before the wrap", even.at);
        }
        assert!(wrapped.bus.now < starts[1] || before + 7 >= until, "the clock has wrapped");
        wraps += 1;
    }
    println!("{wraps} wraps");
}

/// END-1b: in every single cycle of the script, the same cycle with the wrap exactly there decides the same.
#[test]
fn a_wrap_in_every_cycle_of_the_script_changes_no_decision() {
    let mut player = Player::of(booted(0));
    let mut wraps = 0;
    for elapsed in UNEVEN.iter().cycle() {
        if player.at >= LENGTH {
            break;
        }
        player.act();
        // The last cycle ended `ahead` ms before the wrap.
        let ahead = wraps % elapsed + 1;
        let last = 0_u32.wrapping_sub(ahead);
        let mut wrapped = player.bus.with_state(|state| {
            let started = state.clock.started;
            State {
                clock: Clock { last: if started { Millis::new(last) } else { state.clock.last }, ..state.clock },
                ..state
            }
        });
        wrapped.now = last;
        let is = wrapped.step_unjudged(*elapsed);
        let was = player.cycle(*elapsed, false);
        assert!(wrapped.now < CYCLE * 2, "it has wrapped");
        assert_eq!(was, is, "{} ms after the start", player.at);
        wraps += 1;
    }
    assert_eq!(wraps, LENGTH / 10);
}

/// One supervisor between its two links, on one clock: frames in, frames out.
struct Unit {
    sensors: wire::Sender,
    controller: wire::Sender,
    receiver: wire::Receiver,
    supervisor: Supervisor,
    actuators: wire::Sender,
}

impl Unit {
    fn new(sealed: &Sealed) -> Self {
        let supervisor = Supervisor::new(*sealed, ResetCause::PowerOn, Some(Record::None));
        Self {
            sensors: wire::Sender::new(),
            controller: wire::Sender::new(),
            receiver: wire::Receiver::new(supervisor.config()),
            supervisor,
            actuators: wire::Sender::new(),
        }
    }

    fn cycle(&mut self, now: Millis, bus: &Bus) -> (Decision, Vec<wire::Frame>, u32) {
        let (receiver, mut refused) = (&mut self.receiver, 0);
        let mut take = |frame: wire::Frame| refused += u32::from(receiver.accept(now, &frame).is_err());
        self.sensors.encode_inputs(now, &bus.inputs, &bus.scene, &mut take);
        self.controller.encode_commands(now, &bus.commands, &mut take);
        let sample = self.receiver.sample(now);
        let decision = self.supervisor.step(now, sample.inputs, sample.scene, sample.commands);
        let mut frames = Vec::new();
        self.actuators.encode_outputs(now, &decision.outputs, &mut |frame| frames.push(frame));
        (decision, frames, refused)
    }
}

/// END-1b: the same from frame to frame: time-outs, requalification, periods and counters of the link over a wrap.
#[test]
fn a_wrap_changes_no_frame() {
    let Ok(sealed) = Sealed::from_default() else { unreachable!("the table is valid") };
    // Before the link counts, while it requalifies, on the road, in leave.
    for before in [5, 500, 17_003, 57_001, 68_004] {
        let mut units = [0, 0_u32.wrapping_sub(before)].map(|now| (Unit::new(&sealed), now));
        let (mut player, mut released) = (Player::of(booted(0)), false);
        for elapsed in UNEVEN.iter().cycle() {
            if player.at >= ROAD {
                break;
            }
            player.act();
            player.at += elapsed;
            let [was, is] = units.each_mut().map(|(unit, now)| {
                *now = now.wrapping_add(*elapsed);
                unit.cycle(Millis::new(*now), &player.bus)
            });
            released |= was.0.outputs.epb.request == EpbRequest::Release;
            assert_eq!(was, is, "{} ms after the start, {before} ms before the wrap", player.at);
        }
        assert!(released, "the link carries inputs and commands");
    }
}
