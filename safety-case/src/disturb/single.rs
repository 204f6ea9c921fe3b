//! One run of a campaign, driven again and shown: why it came out as it did.

use std::fmt::Write;

use serde_json::{Value, json};
use supervisor::{Config, Sealed};
use supervisor_tests::disturb::Amount;
use supervisor_tests::disturb::run::{Outcome, Prepared, watch};
use supervisor_tests::drive::Cycle;
use supervisor_tests::plant::CORRIDOR_M;
use supervisor_tests::scenario::happens::happened;
use supervisor_tests::traffic::Other;

use crate::simulate::picture::{Curves, picture};
use crate::simulate::run::{Moment, Vetted, moment, vetted};
use crate::template::render;
use crate::words;

const PAGE: &str = include_str!("../../templates/run.html");

/// Something that happened, and where the bus and the nearest other were.
#[derive(Clone, Debug)]
pub struct Row {
    /// When.
    pub moment: Moment,
    /// How far ahead the nearest other is, in m, whether it is in the way or not.
    pub ahead: Option<f64>,
    /// What happened.
    pub what: String,
}

impl Row {
    /// Time in s, speed in km/h, acceleration in m/s², gap and offset of the nearest other in m.
    fn numbers(&self) -> [String; 5] {
        let Moment { at, speed, acceleration, offset, .. } = self.moment;
        // Without the sign of what is rounded to 0.
        let tenths = |value: f64| format!("{:.1}", (value * 10.0).round() / 10.0 + 0.0);
        let metres = |value: Option<f64>| value.map_or("–".to_owned(), tenths);
        [format!("{at:.2}"), tenths(speed), tenths(acceleration), metres(self.ahead), metres(offset)]
    }
}

/// A run.
#[derive(Clone, Debug)]
pub struct Single {
    /// The seed of the campaign.
    pub seed: u64,
    /// Its number in it.
    pub number: u64,
    /// What came of it.
    pub outcome: Outcome,
    /// Every cycle, as it is drawn.
    pub moments: Vec<Moment>,
    /// What was not passed.
    pub vetted: Vec<Vetted>,
    /// What happened, in order of time.
    pub rows: Vec<Row>,
    /// Reach of the corridor for the middle of another, and of the way of the bus, as the picture wants them.
    pub lane: [f64; 2],
}

/// Where another can be, and whether the nearest one is there in a cycle.
type Place<'a> = (&'a str, &'a dyn Fn(&Cycle, &Other) -> bool);

/// Drives the run of this number.
#[must_use]
pub fn single(sealed: Sealed, seed: u64, number: u64) -> Option<Single> {
    let (mut cycles, mut nearest): (Vec<Cycle>, Vec<Option<Other>>) = (Vec::new(), Vec::new());
    let outcome = watch(&Prepared::new(sealed), Amount::TYPICAL, seed, number, &mut |cycle, others| {
        cycles.push(*cycle);
        nearest.push(others.iter().copied().min_by(|one, other| one.gap.abs().total_cmp(&other.gap.abs())));
    })?;
    let config = sealed.intact().unwrap_or(&Config::DEFAULT);
    let corridor = f64::from(config.corridor.raw()) / 100.0;
    let width = nearest.iter().flatten().map(|other| other.width).next().unwrap_or(0.0);
    let lane = [corridor, CORRIDOR_M + width / 2.0];
    let moments: Vec<Moment> = cycles
        .iter()
        .zip(&nearest)
        .map(|(cycle, other)| Moment { offset: other.map(|other| other.offset), ..moment(cycle) })
        .collect();

    let mut found: Vec<(u32, String)> =
        happened(&cycles).into_iter().map(|event| (event.at_ms, event.what.to_owned())).collect();
    for (stretch, reason) in &outcome.interventions {
        let (channel, why) = (words::channel(stretch.channel), words::reason(*reason).0);
        found.push((stretch.from_ms, format!("{channel} not passed, {} cycles: {why}", stretch.cycles)));
    }
    let places: [Place<'_>; 3] = [
        ("something reaches into the way of the bus", &|cycle, _| cycle.truth.ahead.is_some()),
        ("its middle is in the corridor of the supervisor", &|_, other| other.offset.abs() <= corridor),
        ("COLLISION", &|cycle, _| cycle.truth.ahead.is_some_and(|ahead| ahead.gap <= 0.0)),
    ];
    for (what, is) in places {
        let first = cycles.iter().zip(&nearest).find(|(cycle, other)| other.is_some_and(|other| is(cycle, &other)));
        found.extend(first.map(|(cycle, _)| (cycle.now_ms, what.to_owned())));
    }
    found.sort_by_key(|(at_ms, _)| *at_ms);
    let row = |(at_ms, what): (u32, String)| {
        let at = cycles.iter().position(|cycle| cycle.now_ms == at_ms)?;
        Some(Row { moment: *moments.get(at)?, ahead: nearest.get(at)?.map(|other| other.gap), what })
    };
    let rows = found.into_iter().filter_map(row).collect();
    Some(Single { seed, number, outcome, vetted: vetted(&cycles), moments, rows, lane })
}

impl Single {
    /// What it is, in a line.
    #[must_use]
    pub fn title(&self) -> String {
        let Outcome { kind, drive, .. } = &self.outcome;
        format!("Run {} of seed {}: {}, at {drive}", self.number, self.seed, kind.name())
    }

    /// What came of it, in a line.
    #[must_use]
    pub fn result(&self) -> String {
        let Outcome { collided, level, false_triggers, interventions, .. } = &self.outcome;
        format!(
            "{}, highest level {}, {false_triggers} without a cause, {} interventions",
            if *collided { "COLLISION" } else { "no collision" },
            level.code(),
            interventions.len()
        )
    }

    /// For the terminal.
    #[must_use]
    pub fn table(&self) -> String {
        let mut text = format!("{}\n", self.title());
        let heads = ["s", "km/h", "m/s²", "ahead m", "side m"].map(str::to_owned);
        let lines = self.rows.iter().map(|row| (row.numbers(), row.what.as_str()));
        for ([at, speed, acceleration, ahead, side], what) in [(heads, "")].into_iter().chain(lines) {
            // Writing to a String cannot fail.
            let _ = writeln!(text, "{at:>8} {speed:>6} {acceleration:>6} {ahead:>8} {side:>7}  {what}");
        }
        let _ = writeln!(text, "{}", self.result());
        text
    }

    /// As JSON.
    #[must_use]
    pub fn document(&self) -> Value {
        let rows = self.rows.iter().map(|Row { moment, ahead, what }| {
            json!({
                "t": moment.at, "speed_kmh": moment.speed, "acceleration": moment.acceleration, "level": moment.level,
                "ahead_m": ahead, "side_m": moment.offset, "what": what
            })
        });
        json!({
            "schema": "supervise-disturb-run", "version": 1, "seed": self.seed, "run": self.number,
            "situation": self.outcome.kind.name(), "drive": self.outcome.drive, "collided": self.outcome.collided,
            "level": self.outcome.level.code(), "without_a_cause": self.outcome.false_triggers, "events": rows.collect::<Vec<_>>(),
        })
    }

    /// As one HTML file.
    ///
    /// # Errors
    /// If the picture cannot be drawn, or the template does not render.
    pub fn page(&self) -> Result<String, String> {
        let lane = self.moments.iter().any(|moment| moment.offset.is_some()).then_some(self.lane);
        let curves = Curves { moments: &self.moments, vetted: &self.vetted, published: None, lane };
        let rows = self.rows.iter().map(|row| json!({"numbers": row.numbers(), "what": row.what}));
        let context = json!({
            "title": self.title(), "result": self.result(), "collided": self.outcome.collided,
            "rows": rows.collect::<Vec<_>>(), "picture": picture(&curves)?,
        });
        render(PAGE, context).map_err(|error| error.to_string())
    }
}
