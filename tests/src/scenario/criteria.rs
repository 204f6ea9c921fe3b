//! What must come of a scenario, as data, and whether it did: one row for each demand.
//!
//! Always demanded: no hazard of [`judge::hazards`]: no collision, no level that falls while the bus closes in, no release of
//! the parking brake without a driver, K4 before K1, nothing opened while rolling, no torque and no silence in leave.

use serde::Deserialize;
use supervisor::Channel;

use super::happens::{Happened, named};
use crate::drive::Cycle;
use crate::judge::{self, Stretch};

/// What is demanded. What is not named is not demanded.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Expected {
    /// The least gap to anything in the corridor, in m, is greater than this.
    pub least_gap: Option<f64>,
    /// The gap at the end, in m: least and greatest.
    pub rest_gap: Option<[f64; 2]>,
    /// The speed at the end, in km/h: least and greatest.
    pub end_speed: Option<[f64; 2]>,
    /// The greatest deceleration by the brakes, in m/s²: least and greatest.
    pub deceleration: Option<[f64; 2]>,
    /// Channels on which the correct main controller may be vetted; on all others never for more than 3 cycles.
    pub vetted: Vec<String>,
    /// This happens, in this order; other things may happen between.
    pub order: Vec<String>,
    /// This never happens, from the time on that is named for it ...
    pub never: Vec<String>,
    /// ... in s; without it, after the start.
    pub never_from: Option<f64>,
    /// So long it takes from one to the next.
    pub within: Vec<Within>,
    /// Not everything that is demanded is so, and why: a finding that is not cured.
    pub known: Option<String>,
}

/// How a scenario stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Standing {
    /// Everything that is demanded was so.
    Met,
    /// It was not, as is known.
    Known,
    /// It was not.
    NotMet,
    /// It was, though it is known not to be: the finding is cured, and still stands in the file.
    Cured,
}

impl Standing {
    /// Nothing new.
    #[must_use]
    pub const fn as_expected(self) -> bool {
        matches!(self, Self::Met | Self::Known)
    }
}

/// A time from one thing to the next.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Within {
    /// From the first time that this happens ...
    pub from: String,
    /// ... to the first time after it that this happens ...
    pub to: String,
    /// ... least and greatest, in s.
    pub takes: [f64; 2],
}

/// One demand.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Row {
    /// What.
    pub what: String,
    /// What is demanded.
    pub wanted: String,
    /// What was.
    pub found: String,
    /// Whether they agree.
    pub passed: bool,
}

/// The bus is ready to go, in ms: what happens before is its start.
const READY_MS: u32 = 10_400;

impl Expected {
    /// Looks at every name: `check` says what is wrong with the name of a key.
    ///
    /// # Errors
    /// What `check` says.
    pub fn check<E>(&self, check: &impl Fn(String, &str) -> Result<(), E>) -> Result<(), E> {
        for (key, names) in [("order", &self.order), ("never", &self.never)] {
            for (number, name) in names.iter().enumerate() {
                check(format!("expect.{key}[{number}]"), name)?;
            }
        }
        for (number, within) in self.within.iter().enumerate() {
            check(format!("expect.within[{number}].from"), &within.from)?;
            check(format!("expect.within[{number}].to"), &within.to)?;
        }
        Ok(())
    }

    /// How it stands with these rows.
    #[must_use]
    pub fn standing(&self, rows: &[Row]) -> Standing {
        match (rows.iter().all(|row| row.passed), self.known.is_some()) {
            (true, false) => Standing::Met,
            (false, true) => Standing::Known,
            (false, false) => Standing::NotMet,
            (true, true) => Standing::Cured,
        }
    }

    /// One row for each demand.
    #[must_use]
    pub fn judge(&self, cycles: &[Cycle], events: &[Happened]) -> Vec<Row> {
        let mut rows = vec![hazards(cycles), self.interventions(cycles)];
        let row = |what: &str, wanted: String, found: Option<f64>, passed: bool| Row {
            what: what.to_owned(),
            wanted,
            found: found.map_or("nothing".to_owned(), |found| format!("{found:.2}")),
            passed,
        };
        let inside =
            |found: Option<f64>, [least, most]: [f64; 2]| found.is_some_and(|found| (least..=most).contains(&found));
        let range = |[least, most]: [f64; 2]| format!("{least} to {most}");
        if let Some(least) = self.least_gap {
            let found = cycles.iter().filter_map(|cycle| cycle.truth.ahead.map(|ahead| ahead.gap)).reduce(f64::min);
            // Nothing in the corridor is far enough.
            let passed = found.is_none_or(|found| found > least);
            rows.push(row("least gap in m", format!("above {least}"), found, passed));
        }
        if let Some(wanted) = self.rest_gap {
            let found = cycles.last().and_then(|cycle| cycle.truth.ahead).map(|ahead| ahead.gap);
            rows.push(row("gap at the end in m", range(wanted), found, inside(found, wanted)));
        }
        if let Some(wanted) = self.end_speed {
            let found = cycles.last().map(|cycle| cycle.truth.speed * 3.6);
            rows.push(row("speed at the end in km/h", range(wanted), found, inside(found, wanted)));
        }
        if let Some(wanted) = self.deceleration {
            let rolling = cycles.iter().filter(|cycle| cycle.truth.speed > 0.5 && cycle.now_ms > READY_MS);
            let found = rolling.map(|cycle| cycle.truth.braking).reduce(f64::max);
            rows.push(row("greatest deceleration in m/s²", range(wanted), found, inside(found, wanted)));
        }
        if !self.order.is_empty() {
            rows.push(self.in_order(events));
        }
        rows.extend(self.never.iter().map(|name| self.never(name, cycles, events)));
        rows.extend(self.within.iter().map(|within| within.judge(events)));
        rows
    }

    fn interventions(&self, cycles: &[Cycle]) -> Row {
        let allowed = |channel: Channel| self.vetted.iter().any(|name| *name == format!("{channel:?}"));
        let all = judge::interventions(cycles);
        let against: Vec<&Stretch> = all.iter().filter(|stretch| !allowed(stretch.channel)).collect();
        let tell = |stretch: &&Stretch| {
            let at = f64::from(stretch.from_ms) / 1000.0;
            format!("{:?} {:?} at {at:.2} s for {} cycles", stretch.channel, stretch.first.reason, stretch.cycles)
        };
        let wanted =
            if self.vetted.is_empty() { "none".to_owned() } else { format!("none but on {}", self.vetted.join(", ")) };
        let found = if against.is_empty() {
            "none".to_owned()
        } else {
            against.iter().map(tell).collect::<Vec<_>>().join("; ")
        };
        Row {
            what: "interventions against the correct main controller".to_owned(),
            wanted,
            found,
            passed: against.is_empty(),
        }
    }

    /// Each after the one before it.
    fn in_order(&self, events: &[Happened]) -> Row {
        let mut rest = events.iter().filter(|event| event.at_ms > 0);
        let mut found = Vec::new();
        for name in &self.order {
            let event = rest.find(|event| event.what == name);
            found.push(event.map_or_else(
                || format!("no {name}"),
                |event| format!("{name} ({:.2} s)", f64::from(event.at_ms) / 1000.0),
            ));
            if event.is_none() {
                break;
            }
        }
        let passed = found.len() == self.order.len() && found.last().is_some_and(|last| !last.starts_with("no "));
        Row { what: "in this order".to_owned(), wanted: self.order.join(", "), found: found.join(", "), passed }
    }

    fn never(&self, name: &str, cycles: &[Cycle], events: &[Happened]) -> Row {
        let from_ms = self.never_from.map_or(READY_MS, super::load::ms);
        let began = cycles.iter().find(|cycle| cycle.now_ms >= from_ms);
        let holds = began.zip(named(name)).is_some_and(|(cycle, holds)| holds(cycle));
        let event = events.iter().find(|event| event.what == name && event.at_ms >= from_ms);
        let found = match (holds, event) {
            (true, _) => format!("holds at {:.2} s", f64::from(from_ms) / 1000.0),
            (false, Some(event)) => format!("at {:.2} s", f64::from(event.at_ms) / 1000.0),
            (false, None) => "never".to_owned(),
        };
        let from = f64::from(from_ms) / 1000.0;
        let passed = !holds && event.is_none();
        Row { what: name.to_owned(), wanted: format!("never from {from:.1} s on"), found, passed }
    }
}

impl Within {
    fn judge(&self, events: &[Happened]) -> Row {
        let begins = events.iter().find(|event| event.what == self.from);
        let ends =
            begins.and_then(|begins| events.iter().find(|event| event.what == self.to && event.at_ms >= begins.at_ms));
        let took = begins.zip(ends).map(|(begins, ends)| f64::from(ends.at_ms - begins.at_ms) / 1000.0);
        let [least, most] = self.takes;
        Row {
            what: format!("from {} to {} in s", self.from, self.to),
            wanted: format!("{least} to {most}"),
            found: took.map_or("does not happen".to_owned(), |took| format!("{took:.2}")),
            passed: took.is_some_and(|took| (least..=most).contains(&took)),
        }
    }
}

fn hazards(cycles: &[Cycle]) -> Row {
    let found = judge::hazards(cycles);
    let tell = |(at_ms, hazard): &(u32, judge::Hazard)| format!("{hazard:?} at {:.2} s", f64::from(*at_ms) / 1000.0);
    let text = found.iter().map(tell).collect::<Vec<_>>().join("; ");
    Row {
        what: "hazards".to_owned(),
        wanted: "none".to_owned(),
        passed: found.is_empty(),
        found: if found.is_empty() { "none".to_owned() } else { text },
    }
}
