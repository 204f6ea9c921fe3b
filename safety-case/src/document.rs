//! The JSON document: written while the replay goes on, one event per line, so that it is as long as it likes.
//!
//! Schema `supervise-replay`, version 1:
//!
//! ```json
//! {"schema":"supervise-replay","version":1,"program":"…","logs":["…"],"mapping":"…","cycle_s":0.01,
//! "events":[
//! {"type":"verdict","t":2.21,"until":3.19,"cycles":98,"channel":"service_brake","kind":"substitute",
//!  "reason":"Mitigation","code":10,"requirement":"MIT-1..4","unit":"m/s²",
//!  "value":0.0,"limit":1.0,"margin":-1.0,"raw":{"value":0,"limit":2048,"margin":-2048}},
//! {"type":"state","t":2.21,"until":3.19,"cycles":98,"group":"state","lane":"level","code":1,"text":"level 1"},
//! {"type":"intervention","t":2.21,"until":4.9,"cycles":269,"channel":"service_brake","reasons":["Mitigation"]},
//! {"type":"trouble","t":2.5,"until":14.0,"healed":true,"fault":"SPEED_UNKNOWN","spn":84,"fmi":2,"count":1,
//!  "lamp":"amber warning","ads_code":7,"system":"Speed","driver":"…","why":"…"},
//! {"type":"clock","t":9.0,"place":"a.log:17","kind":"backwards"}
//! ],
//! "summary":{…}}
//! ```
//!
//! - `t` and `until` are seconds on the axis of the replay; `until` is where the next event of the same channel or
//!   lane begins. An event is written when it ends, so the list is in the order of `until`.
//! - A verdict is one stretch of one kind and reason; its numbers are those of its smallest margin. `value`,
//!   `limit`, `margin` are numbers in `unit`, or, with `"unit":"name"`, the names of what was asked for and given;
//!   they are missing where the verdict has none. `fields` names what was changed in a command of many fields,
//!   `rejection` why its frame was refused. `raw` is what the core says, in the bits of the field.
//! - A trouble is a stretch in which a code of DM1 was active, after its debounce and until it healed or the log ended;
//!   `summary.troubles` has one row per code, from its first time to the end of its last.
//! - An intervention is a stretch of more than three cycles of one channel without a pass; see `stretches.rs`.
//! - Fields may be added in the same version; none is renamed or removed.

use std::io::{self, Write};

use serde_json::{Value, json};
use supervisor::{Kind, Reason};

use crate::difference::{difference, rejection};
use crate::lanes::{Group, LANES, channel, verdict};
use crate::number::seconds;
use crate::physical::{Quantity, physical, quantity};
use crate::road::snake;
use crate::runs::{Run, Sink};
use crate::stretches::Stretch;
use crate::troubles::Episode;
use crate::words;

/// Name of the schema.
pub const SCHEMA: &str = "supervise-replay";
/// Version of the schema.
pub const VERSION: u32 = 1;

/// A document that is being written. The first error ends the writing and is kept.
pub struct Document<W: Write> {
    out: W,
    state: io::Result<bool>,
}

impl<W: Write> std::fmt::Debug for Document<W> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Document").field("state", &self.state).finish_non_exhaustive()
    }
}

impl<W: Write> Document<W> {
    /// Writes the head.
    pub fn begin(mut out: W, logs: &[String], mapping: &str) -> Self {
        let head = json!({
            "schema": SCHEMA, "version": VERSION, "program": concat!("supervise ", env!("CARGO_PKG_VERSION")),
            "logs": logs, "mapping": mapping, "cycle_s": seconds(crate::cycle::CYCLE),
        });
        let mut text = head.to_string();
        // The document goes on where its head ends.
        text.pop();
        let state = writeln!(out, "{text},\n\"events\":[").map(|()| false);
        Self { out, state }
    }

    fn write(&mut self, event: &Value) {
        if let Ok(comma) = &mut self.state {
            let before = if *comma { ",\n" } else { "" };
            *comma = true;
            if let Err(error) = write!(self.out, "{before}{event}") {
                self.state = Err(error);
            }
        }
    }

    /// The clock of the log leapt.
    pub fn clock(&mut self, at: u64, place: &str, kind: &str) {
        self.write(&json!({"type": "clock", "t": seconds(at), "place": place, "kind": kind}));
    }

    /// A trouble code was active.
    pub fn trouble(&mut self, episode: &Episode) {
        self.write(&episode.json());
    }

    /// The supervisor intervened.
    pub fn intervention(&mut self, stretch: &Stretch) {
        let reasons: Vec<String> = stretch.reasons.iter().map(|reason| format!("{reason:?}")).collect();
        self.write(&json!({
            "type": "intervention", "t": seconds(stretch.from), "until": seconds(stretch.to), "cycles": stretch.cycles,
            "channel": snake(&stretch.channel), "reasons": reasons,
        }));
    }

    /// Writes the summary and ends the document.
    ///
    /// # Errors
    /// The first error of the whole writing.
    pub fn finish(mut self, summary: &Value) -> io::Result<()> {
        self.state?;
        writeln!(self.out, "\n],\n\"summary\":{summary}}}")?;
        self.out.flush()
    }
}

impl<W: Write> Sink for Document<W> {
    fn ended(&mut self, run: &Run) {
        if self.state.is_ok() {
            self.write(&event(run));
        }
    }
}

/// The event of a run.
#[must_use]
pub fn event(run: &Run) -> Value {
    let (t, until) = (seconds(run.from), seconds(run.to));
    let Some(channel) = channel(run.lane) else {
        let lane = LANES.get(run.lane);
        return json!({
            "type": "state", "t": t, "until": until, "cycles": run.cycles,
            "group": lane.map(|lane| match lane.group {
                Group::Verdict => "verdict",
                Group::State => "state",
                Group::Actuator => "actuator",
                Group::Warning => "warning",
                Group::Input => "input",
                Group::Fault => "fault",
            }),
            "lane": lane.map(|lane| &lane.key), "code": run.code, "text": lane.map(|lane| lane.says(run.code)),
        });
    };
    let (kind, reason) = verdict(run.code);
    let mut event = json!({
        "type": "verdict", "t": t, "until": until, "cycles": run.cycles, "channel": snake(&channel),
        "kind": snake(&kind), "reason": format!("{reason:?}"), "code": reason.code(),
        "requirement": words::requirement(channel, reason),
    });
    let (Some(detail), Some(fields)) = (&run.detail, event.as_object_mut()) else { return event };
    let worst = &detail.worst;
    let mut add = |name: &str, value: Value| fields.insert(name.to_owned(), value);
    if let Some(why) = rejection(channel, &detail.asked).filter(|_| reason == Reason::CommandRejected) {
        add("rejection", snake(&why).into());
    }
    match quantity(channel, worst) {
        Quantity::Nothing => return event,
        Quantity::Number(unit, per_unit, _) => {
            add("unit", unit.into());
            add("value", physical(worst.value, per_unit).into());
            add("limit", physical(worst.limit, per_unit).into());
            add("margin", physical(worst.margin, per_unit).into());
        }
        Quantity::Name(name) => {
            add("unit", "name".into());
            add("value", name(worst.value).into());
            add("limit", name(worst.limit).into());
        }
    }
    if let Some(fields) = difference(channel, &detail.asked, &detail.given).filter(|_| worst.kind != Kind::Pass) {
        add("fields", fields.into());
    }
    add("raw", json!({"value": worst.value, "limit": worst.limit, "margin": worst.margin}));
    event
}

#[cfg(test)]
mod tests {
    use super::{Document, event};
    use crate::lanes::LANES;
    use crate::runs::{Detail, Run, Sink};
    use serde_json::{Value, json};
    use supervisor::{Commands, Kind, Outputs, Reason, Verdict};

    fn verdict_run() -> Run {
        let worst = Verdict::below(Kind::Substitute, Reason::Mitigation, 0, 2048);
        let detail = Detail { worst, asked: Commands::ABSENT, given: Outputs::NEUTRAL, commanded: true, usable: true };
        let code = u16::from_le_bytes([Reason::Mitigation.code(), Kind::Substitute.code()]);
        Run { lane: 2, code, from: 2_210_000, to: 3_190_000, cycles: 98, detail: Some(Box::new(detail)) }
    }

    #[test]
    fn the_schema_of_a_verdict_is_stable() {
        let expected = json!({
            "type": "verdict", "t": 2.21, "until": 3.19, "cycles": 98, "channel": "service_brake",
            "kind": "substitute", "reason": "Mitigation", "code": 10, "requirement": "MIT-1..4",
            "unit": "m/s²", "value": 0.0, "limit": 1.0, "margin": -1.0,
            "raw": {"value": 0, "limit": 2048, "margin": -2048},
        });
        assert_eq!(event(&verdict_run()), expected);
    }

    #[test]
    fn the_schema_of_a_state_is_stable() {
        let lane = LANES.iter().position(|lane| lane.key == "level").unwrap_or_default();
        let run = Run { lane, code: 1, from: 0, to: 10_000, cycles: 1, detail: None };
        let expected = json!({
            "type": "state", "t": 0.0, "until": 0.01, "cycles": 1, "group": "state", "lane": "level", "code": 1,
            "text": "level 1",
        });
        assert_eq!(event(&run), expected);
    }

    #[test]
    fn the_document_is_one_json_value() -> Result<(), Box<dyn std::error::Error>> {
        for events in 0..3 {
            let mut bytes = Vec::new();
            let mut document = Document::begin(&mut bytes, &["a.log".to_owned()], "map");
            (0..events).for_each(|_| document.ended(&verdict_run()));
            document.finish(&json!({"frames": 1}))?;
            let value: Value = serde_json::from_slice(&bytes)?;
            assert_eq!(value["schema"], super::SCHEMA);
            assert_eq!(value["version"], super::VERSION);
            assert_eq!(value["events"].as_array().map(Vec::len), Some(events));
            assert_eq!(value["summary"]["frames"], 1);
        }
        Ok(())
    }
}
