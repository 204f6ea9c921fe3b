//! Which modes of the retained state were seen.

use std::collections::BTreeMap;
use std::fmt::Debug;
use std::sync::atomic::{AtomicU32, Ordering};

use supervisor_core::{
    Config, Direction, ExitReason, Faults, LastKey, Millis, Mode, PedalChain, Pending, Restart, Stage, State,
};

use crate::identity::timers;
use crate::vectors::SCALED;

/// What of a state has few values: every value is a mode that must be seen.
struct Group {
    name: &'static str,
    values: Vec<(u8, String)>,
    of: fn(&State) -> u8,
}

fn codes<T: Copy + Debug>(all: &[T], code: fn(T) -> u8) -> Vec<(u8, String)> {
    all.iter().map(|value| (code(*value), format!("{value:?}"))).collect()
}

macro_rules! enums {
    ($($name:literal: $type:ident = |$state:ident| $value:expr;)*) => {
        vec![$(Group { name: $name, values: codes($type::ALL, $type::code), of: |$state| $value.code() },)*]
    };
}

macro_rules! facts {
    ($($name:literal = |$state:ident| $value:expr;)*) => {
        vec![$(Group {
            name: $name,
            values: vec![(0, "no".to_owned()), (1, "yes".to_owned())],
            of: |$state| u8::from($value),
        },)*]
    };
}

/// A stage of the shutdown takes longer than it may.
fn overdue(state: &State, of: Stage, deadline: Millis) -> bool {
    state.high_voltage.stage == of && state.high_voltage.wait.reached(deadline)
}

/// Every enumeration of the retained state, from its own list of values; every fact.
fn groups() -> Vec<Group> {
    let mut groups = enums! {
        "boot.pending": Pending = |state| state.boot.pending;
        "parking.pedal": PedalChain = |state| state.parking.pedal;
        "high_voltage.stage": Stage = |state| state.high_voltage.stage;
        "high_voltage.restart": Restart = |state| state.high_voltage.restart;
        "high_voltage.key": LastKey = |state| state.high_voltage.key;
        "drive.mode": Mode = |state| state.drive.mode;
        "drive.exit": ExitReason = |state| state.drive.exit;
        "gear.direction": Direction = |state| state.gear.direction;
    };
    groups.extend(facts! {
        "high_voltage.k4_overdue" = |state| overdue(state, Stage::OpeningK4, SCALED.k4_deadline);
        "high_voltage.k1_overdue" = |state| overdue(state, Stage::OpeningK1, SCALED.k1_deadline);
        "seat.leave" = |state| state.seat.leave;
        "parking.by_leave" = |state| state.parking.by_leave;
        "parking.slow" = |state| state.parking.slow;
        "mitigation.one" = |state| state.mitigation.one;
        "mitigation.two" = |state| state.mitigation.two;
        "mitigation.three" = |state| state.mitigation.three;
        "mitigation.hold" = |state| state.mitigation.hold;
        "mitigation.permitted" = |state| state.mitigation.permitted;
        "mitigation.forward" = |state| state.mitigation.forward;
        "mitigation.pedestrian" = |state| state.mitigation.pedestrian;
        "drive.armed" = |state| state.drive.armed;
        "drive.release_needed" = |state| state.drive.release_needed;
        "brake.slow" = |state| state.brake.slow;
        "steering.acts" = |state| state.steering.weight.raw() > 0;
        "steering.barred" = |state| state.steering.barred;
        "steering.astray" = |state| state.steering.astray;
        "steering.lost" = |state| state.steering.lost;
        "monitors.helps" = |state| state.monitors.helps;
        "monitors.disobeys" = |state| state.monitors.disobeys;
        "monitors.loose" = |state| state.monitors.loose;
        "monitors.emergency" = |state| state.monitors.emergency;
        "latches.safe_state" = |state| state.is_safe_state();
        "latches.contactor" = |state| state.latches.faults.contains(Faults::CONTACTOR);
        "latches.off_seen" = |state| state.latches.off_seen;
    });
    groups
}

/// What was seen.
pub struct Coverage {
    groups: Vec<(Group, AtomicU32)>,
    timers: BTreeMap<&'static str, AtomicU32>,
}

impl Coverage {
    /// Nothing yet.
    pub fn new(config: &Config) -> Self {
        Self {
            groups: groups().into_iter().map(|group| (group, AtomicU32::new(0))).collect(),
            timers: timers(&State::corrupted(), config).map(|(name, _)| (name, AtomicU32::new(0))).collect(),
        }
    }

    /// Sees a state.
    pub fn see(&self, state: &State, config: &Config) {
        for (group, seen) in &self.groups {
            mark(seen, (group.of)(state));
        }
        for (name, phase) in timers(state, config) {
            if let Some(seen) = self.timers.get(name) {
                mark(seen, phase);
            }
        }
    }

    /// Every mode, `group=value`, and whether it was seen.
    pub fn modes(&self) -> BTreeMap<String, bool> {
        let of = |seen: &AtomicU32, code: u8| seen.load(Ordering::Relaxed) & bit(code) != 0;
        let enums = self.groups.iter().flat_map(|(group, seen)| {
            group.values.iter().map(move |(code, value)| (format!("{}={value}", group.name), of(seen, *code)))
        });
        let phases = self.timers.iter().flat_map(|(name, seen)| {
            let phases = [(0, "stopped"), (1, "running"), (2, "reached")];
            phases.into_iter().map(move |(code, phase)| (format!("{name}={phase}"), of(seen, code)))
        });
        enums.chain(phases).collect()
    }
}

fn bit(code: u8) -> u32 {
    1_u32.rotate_left(code.into())
}

fn mark(seen: &AtomicU32, code: u8) {
    if seen.load(Ordering::Relaxed) & bit(code) == 0 {
        seen.fetch_or(bit(code), Ordering::Relaxed);
    }
}

/// The modes of a state, in words.
pub fn describe(state: &State) -> Vec<(&'static str, String)> {
    let word = |group: Group| {
        let code = (group.of)(state);
        let value = group.values.into_iter().find(|(other, _)| *other == code);
        (group.name, value.map_or_else(|| code.to_string(), |(_, value)| value))
    };
    groups().into_iter().map(word).collect()
}
