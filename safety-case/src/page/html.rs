//! The HTML around the figure.

use serde::Serialize;
use serde_json::json;
use supervisor::Channel;

use super::Picture;
use super::figure::Figure;
use super::slots::TONES;
use crate::number::{grouped, seconds};
use crate::template::render;
use crate::words;

const PAGE: &str = include_str!("../../templates/page.html");
const INDEX: &str = include_str!("../../templates/index.html");
const SCRIPT: &str = include_str!("../../templates/page.js");

/// How many entries of the timeline the page shows.
const ENTRIES: usize = 400;
/// How many odd things it shows.
const ODD: usize = 40;

/// plotly.js as the crate carries it, without its formula renderer, which nothing here needs.
fn library() -> String {
    let both = plotly::Plot::offline_js_sources();
    let end = both.find("</script>").unwrap_or(both.len());
    let body = both.get(..end).unwrap_or_default();
    body.split_once('>').map_or_else(String::new, |(_, script)| script.to_owned())
}

/// JSON that may stand inside a script element.
fn inside_script(json: &str) -> String {
    json.replace("</", "<\\/").replace("<!--", "<\\!--").replace('\u{2028}', "\\u2028").replace('\u{2029}', "\\u2029")
}

#[derive(Serialize)]
struct Share {
    class: &'static str,
    percent: f64,
    cycles: String,
    label: &'static str,
}

#[derive(Serialize)]
struct ChannelRow {
    name: &'static str,
    shares: Vec<Share>,
    cells: Vec<String>,
}

const KINDS: [(&str, &str); 5] =
    [("pass", "pass"), ("limit", "limit"), ("substitute", "substitute"), ("block", "block"), ("silent", "no command")];

fn channels(picture: &Picture<'_>) -> Vec<ChannelRow> {
    let total = crate::number::float(picture.report.cycles.max(1));
    let row =
        |channel: &Channel| {
            let counts = picture.report.summary.by_kind(*channel);
            let cells = counts.iter().map(|count| if *count == 0 { "·".to_owned() } else { grouped(*count) }).collect();
            let shares = counts.iter().zip(KINDS).filter(|(count, _)| **count > 0).map(|(count, (class, label))| {
                Share { class, percent: 100.0 * crate::number::float(*count) / total, cycles: grouped(*count), label }
            });
            ChannelRow { name: words::channel(*channel), shares: shares.collect(), cells }
        };
    Channel::ALL.iter().map(row).collect()
}

/// "41.6 s", "6 min 42 s", "8 h 3 min".
#[must_use]
pub fn duration(micros: u64) -> String {
    let minutes = micros / 60_000_000;
    let rest = seconds(micros % 60_000_000);
    match minutes {
        0 => format!("{rest:.1} s"),
        1..60 => format!("{minutes} min {rest:.0} s"),
        _ => format!("{} h {} min", minutes / 60, minutes % 60),
    }
}

/// The page of one drive.
///
/// # Errors
/// If the template does not render.
pub fn page(figure: &Figure, picture: &Picture<'_>) -> Result<String, minijinja::Error> {
    let report = picture.report;
    let (entries, left_out) = &report.timeline;
    let rows: Vec<_> = entries
        .iter()
        .take(ENTRIES)
        .map(|entry| {
            let class = entry.text.split_whitespace().next().filter(|_| entry.act).unwrap_or("").to_lowercase();
            json!({
                "from": seconds(entry.from), "to": seconds(entry.to), "time": entry.time(), "what": entry.what,
                "text": entry.text, "times": entry.times, "class": class,
            })
        })
        .collect();
    let further = u64::try_from(entries.len().saturating_sub(ENTRIES)).unwrap_or(0) + left_out;
    let refused = report.notes.refused();
    let cards = json!([
        {"label": "replayed", "value": duration(report.span.1.saturating_sub(report.span.0))},
        {"label": "frames", "value": grouped(report.frames)},
        {"label": "cycles of 10 ms", "value": grouped(report.cycles)},
        {"label": "interventions", "value": grouped(report.summary.interventions()),
         "class": if report.summary.interventions() == 0 { "good" } else { "alarm" }},
        {"label": "shorter than 4 cycles", "value": grouped(report.summary.brief())},
        {"label": "frames refused", "value": grouped(refused), "class": if refused == 0 { "" } else { "caution" }},
        {"label": "lines not understood", "value": grouped(report.notes.malformed())},
    ]);
    let tones: Vec<_> = TONES.iter().map(|(_, name, colour, _)| json!({"name": name, "colour": colour})).collect();
    let kinds = KINDS.map(|(class, label)| json!({"class": class, "label": label}));
    let context = json!({
        "title": picture.title,
        "logs": picture.logs.iter().map(|log| log.rsplit(['/', '\\']).next().unwrap_or(log)).collect::<Vec<_>>(),
        "mapping": report.mapping,
        "cards": cards,
        "interventions": report.summary.interventions(),
        "brief": report.summary.brief(),
        "longest": report.summary.longest(),
        "channels": channels(picture),
        "kinds": kinds,
        "rows": rows,
        "further": further,
        "notes": report.notes.lines().into_iter().take(ODD).collect::<Vec<_>>(),
        "troubles": report.troubles,
        "never": figure.never,
        "steady": figure.steady,
        "silent": !report.summary.commanded(),
        "tones": tones,
        "height": figure.height,
        "script": SCRIPT,
        "library": library(),
        "figure": inside_script(&figure.json),
    });
    render(PAGE, context)
}

/// One drive on the index.
#[derive(Clone, Debug, Serialize)]
pub struct IndexEntry {
    /// Title.
    pub title: String,
    /// What happens in it.
    pub description: String,
    /// The page, relative to the index.
    pub page: String,
    /// The JSON document.
    pub json: String,
    /// Interventions.
    pub interventions: u64,
    /// The longest intervention, in words.
    pub longest: String,
    /// Length in words.
    pub length: String,
}

/// The page that links the pages of several drives.
///
/// # Errors
/// If the template does not render.
pub fn index(entries: &[IndexEntry]) -> Result<String, minijinja::Error> {
    render(INDEX, json!({"entries": entries}))
}
