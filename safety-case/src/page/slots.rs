//! The lanes' part of the figure: bars under headings.

use plotly::Trace;
use plotly::common::Font;
use plotly::layout::Axis;
use serde::Serialize;

use super::bars::{Bar, Bars};
use super::figure::{LANE_AXIS, axis_name};
use crate::lanes::{Group, LANES, Lane, Tone};
use crate::number::{float, seconds};

/// A horizontal bar per stretch; the crate's own bars cannot begin elsewhere than at zero.
#[derive(Clone, Debug, Default, Serialize)]
pub(super) struct Stretches {
    r#type: &'static str,
    orientation: &'static str,
    name: &'static str,
    base: Vec<f64>,
    x: Vec<f64>,
    y: Vec<usize>,
    width: f64,
    hovertext: Vec<String>,
    text: Vec<String>,
    textposition: &'static str,
    textfont: Ink,
    hovertemplate: &'static str,
    hoverlabel: Label,
    marker: Marker,
    xaxis: &'static str,
    yaxis: &'static str,
    showlegend: bool,
}

#[derive(Clone, Debug, Default, Serialize)]
struct Marker {
    color: &'static str,
    line: Edge,
}

#[derive(Clone, Debug, Default, Serialize)]
struct Ink {
    color: &'static str,
    size: f64,
}

#[derive(Clone, Debug, Default, Serialize)]
struct Label {
    align: &'static str,
}

/// Keeps the shortest stretch visible.
#[derive(Clone, Debug, Default, Serialize)]
struct Edge {
    color: &'static str,
    width: f64,
}

impl Trace for Stretches {
    fn to_json(&self) -> String {
        serde_json::to_string(self).unwrap_or_default()
    }
}

/// The tones that are drawn, in the order of the legend: name, colour, colour of the words in it.
pub const TONES: &[(Tone, &str, &str, &str)] = &[
    (Tone::Good, "pass, or as it should be", "#bfe3c8", "#33563f"),
    (Tone::Note, "worth seeing", "#8fb8de", "#1c3f63"),
    (Tone::Caution, "limit, requalifying, fault", "#f0b429", "#4d3600"),
    (Tone::Alarm, "substitute, obligation, signal lost", "#d1344b", "#ffffff"),
    (Tone::Refusal, "block", "#7b5ea7", "#ffffff"),
    (Tone::Void, "no command, not available", "#d5dae1", "#5d6b80"),
];

/// A line of the lanes' part: a heading, or a lane with its bars.
pub(super) enum Slot {
    Heading(&'static str),
    Lane(&'static Lane, Vec<Bar>),
}

/// The lanes' part, from the top.
#[derive(Default)]
pub(super) struct Slots {
    pub drawn: Vec<Slot>,
    pub never: Vec<&'static str>,
    pub steady: Vec<&'static str>,
}

/// Known from some moment on, and never anything else after that.
fn is_steady(lane: &Lane, bars: &[Bar]) -> bool {
    let mut rest = bars.iter().map(|bar| bar.tone(lane)).skip_while(|tone| *tone != Tone::Good).peekable();
    rest.peek().is_some() && rest.all(|tone| tone == Tone::Good)
}

/// Which lanes are drawn, under their headings; which inputs never came, and which have nothing to tell.
pub(super) fn slots(lanes: Vec<Bars>) -> Slots {
    let mut found: Vec<(&Lane, Vec<Bar>)> = Vec::new();
    let Slots { mut never, mut steady, .. } = Slots::default();
    for (lane, bars) in LANES.iter().zip(lanes) {
        let bars = bars.finish();
        let dull = bars.iter().all(|bar| bar.tone(lane) == Tone::Idle);
        match lane.group {
            Group::Input if dull => never.push(lane.title.as_str()),
            Group::Input if is_steady(lane, &bars) && !lane.key.starts_with("seat") => steady.push(lane.title.as_str()),
            Group::Verdict | Group::Input => found.push((lane, bars)),
            Group::State | Group::Actuator | Group::Warning | Group::Fault if !dull => found.push((lane, bars)),
            Group::State | Group::Actuator | Group::Warning | Group::Fault => {}
        }
    }
    let mut slots = Vec::new();
    for (group, heading) in [
        (Group::Verdict, "VERDICTS"),
        (Group::State, "STATE"),
        (Group::Actuator, "REQUESTS"),
        (Group::Warning, "WARNINGS"),
        (Group::Input, "INPUTS"),
        (Group::Fault, "FAULTS"),
    ] {
        let mut mine = found.extract_if(.., |(lane, _)| lane.group == group).peekable();
        if mine.peek().is_some() {
            slots.push(Slot::Heading(heading));
            slots.extend(mine.map(|(lane, bars)| Slot::Lane(lane, bars)));
        }
    }
    Slots { drawn: slots, never, steady }
}

/// One trace per tone.
pub(super) fn stretches(slots: &[Slot]) -> Vec<Stretches> {
    let mut traces: Vec<(Tone, Stretches)> =
        TONES.iter().map(|(tone, name, colour, ink)| (*tone, empty(name, colour, ink))).collect();
    for (y, slot) in slots.iter().enumerate() {
        let Slot::Lane(lane, bars) = slot else { continue };
        for bar in bars {
            let tone = bar.tone(lane);
            let Some((_, trace)) = traces.iter_mut().find(|(mine, _)| *mine == tone) else { continue };
            trace.base.push(seconds(bar.from));
            trace.x.push(seconds(bar.to.saturating_sub(bar.from)));
            trace.y.push(y);
            trace.hovertext.push(bar.hover(lane));
            trace.text.push(bar.label(lane));
        }
    }
    traces.into_iter().map(|(_, trace)| trace).filter(|trace| !trace.x.is_empty()).collect()
}

fn empty(name: &'static str, colour: &'static str, ink: &'static str) -> Stretches {
    Stretches {
        r#type: "bar",
        orientation: "h",
        name,
        width: 0.72,
        hovertemplate: "%{hovertext}<extra></extra>",
        // The script of the page draws the words, where they fit.
        textposition: "none",
        textfont: Ink { color: ink, size: 9.5 },
        hoverlabel: Label { align: "left" },
        marker: Marker { color: colour, line: Edge { color: colour, width: 0.6 } },
        xaxis: "x",
        yaxis: axis_name(LANE_AXIS),
        ..Stretches::default()
    }
}

/// The axis of the lanes: their names.
pub(super) fn lane_axis(slots: &[Slot]) -> Axis {
    let ticks = (0..slots.len()).map(|slot| float(u64::try_from(slot).unwrap_or(0))).collect();
    let names = slots.iter().map(|slot| match slot {
        Slot::Heading(title) => format!("<b>{title}</b>"),
        Slot::Lane(lane, _) => lane.title.clone(),
    });
    let last = float(u64::try_from(slots.len()).unwrap_or(0)) - 0.5;
    Axis::new()
        .anchor("x")
        .fixed_range(true)
        .range(vec![last, -0.5])
        .tick_values(ticks)
        .tick_text(names.collect())
        .tick_font(Font::new().size(11))
        .show_grid(false)
        .zero_line(false)
}
