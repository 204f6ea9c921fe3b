//! The curves of a drive as one SVG: speed, acceleration, gap, time to collision, level, verdicts.
//!
//! Where the scenario is S1's, what S1 publishes stands beside it: figures 4 and 5 as far as its text gives numbers, joined by
//! straight lines (the curves between are not published as numbers).

use plotters::coord::Shift;
use plotters::prelude::*;
use supervisor::{Channel, Kind};
use supervisor_tests::s1::PUBLISHED;

use super::run::{Moment, Vetted};
use crate::words;

const WIDE: u32 = 1000;
const HIGH: u32 = 132;
const LANE: u32 = 16;
const BLUE_LINE: RGBColor = RGBColor(29, 78, 137);
const VIOLET: RGBColor = RGBColor(123, 94, 167);
const THEIRS: RGBColor = RGBColor(176, 120, 40);
const GRID: RGBColor = RGBColor(230, 234, 240);
const INK: RGBColor = RGBColor(36, 48, 66);

/// What is drawn of a drive.
#[derive(Clone, Copy, Debug)]
pub struct Curves<'a> {
    /// Its moments, in order of time.
    pub moments: &'a [Moment],
    /// What was not passed.
    pub vetted: &'a [Vetted],
    /// When S1's 60 m are left, in s, where its published curves stand beside.
    pub published: Option<f64>,
    /// How far from its middle the corridor of the supervisor and the way of the bus reach, in m, where the others are shown beside it:
    /// the first for the middle of another, the second for its near side.
    pub lane: Option<[f64; 2]>,
}

struct Line {
    points: Vec<Option<(f64, f64)>>,
    colour: RGBColor,
    width: u32,
}

struct Panel {
    title: String,
    range: [f64; 2],
    lines: Vec<Line>,
}

/// The picture of a drive.
///
/// # Errors
/// If it cannot be drawn.
pub fn picture(drive: &Curves<'_>) -> Result<String, String> {
    let zero = drive.published.unwrap_or(0.0);
    let span = span(drive, zero);
    let panels = panels(drive, zero, span);
    let shown = |vetted: &Vetted| vetted.span[1] - zero > span[0] && vetted.span[0] - zero < span[1];
    let lanes: Vec<Channel> = Channel::ALL
        .iter()
        .copied()
        .filter(|channel| drive.vetted.iter().any(|vetted| vetted.channel == *channel && shown(vetted)))
        .collect();
    let lanes_high = LANE * u32::try_from(lanes.len()).unwrap_or(0) + 44;
    let high = HIGH * u32::try_from(panels.len()).unwrap_or(0) + lanes_high;
    let mut svg = String::new();
    {
        let root = SVGBackend::with_string(&mut svg, (WIDE, high)).into_drawing_area();
        let mut rest = root.clone();
        for panel in &panels {
            let (upper, lower) = rest.split_vertically(HIGH);
            draw(&upper, panel, span).map_err(|error| error.to_string())?;
            rest = lower;
        }
        verdicts(&rest, drive.vetted, &lanes, span, zero).map_err(|error| error.to_string())?;
        root.present().map_err(|error| error.to_string())?;
    }
    Ok(svg)
}

/// What is shown, in s from the zero of the drive: all of it, or S1's approach.
fn span(drive: &Curves<'_>, zero: f64) -> [f64; 2] {
    let end = drive.moments.last().map_or(1.0, |moment| moment.at);
    let begin = if drive.lane.is_some() { drive.moments.first().map_or(0.0, |moment| moment.at) } else { 0.0 };
    if drive.published.is_some() { [-2.0, (end - zero).clamp(8.0, 10.0)] } else { [begin, end.max(begin + 1.0)] }
}

fn panels(drive: &Curves<'_>, zero: f64, [from, until]: [f64; 2]) -> Vec<Panel> {
    let shown: Vec<&Moment> =
        drive.moments.iter().filter(|moment| (from..=until).contains(&(moment.at - zero))).collect();
    let curve = |read: &dyn Fn(&Moment) -> Option<f64>| -> Vec<Option<(f64, f64)>> {
        shown.iter().map(|moment| read(moment).map(|value| (moment.at - zero, value))).collect()
    };
    let ours = |read: &dyn Fn(&Moment) -> Option<f64>| Line { points: curve(read), colour: BLUE_LINE, width: 2 };
    let published = drive.published.is_some();
    let theirs =
        |points: &[(f64, f64)]| Line { points: points.iter().copied().map(Some).collect(), colour: THEIRS, width: 2 };
    let beside = if published { "; brown: S1" } else { "" };
    let figure = |number: u8| if published { format!(", figure {number}") } else { String::new() };
    let most = |read: &dyn Fn(&Moment) -> Option<f64>, least: f64| {
        shown.iter().filter_map(|moment| read(moment)).fold(least, f64::max) * 1.05
    };

    let mut speed = vec![ours(&|moment| Some(moment.speed))];
    let mut acceleration = vec![ours(&|moment| Some(moment.acceleration.clamp(-8.0, 3.0)))];
    let mut gap = vec![ours(&|moment| moment.gap)];
    let mut level = vec![ours(&|moment| Some(f64::from(moment.level)))];
    if published {
        let [first, second, third] = PUBLISHED.levels.map(|at| at.unwrap_or(0.0));
        let rest = PUBLISHED.standstill.unwrap_or(0.0);
        let over = rest + 1.0;
        speed.push(theirs(&[(from, 40.0), (first, 40.0), (rest, 0.0), (over, 0.0)]));
        acceleration.push(theirs(&[
            (from, 0.0),
            (first, 0.0),
            (first, -1.0),
            (second, -1.0),
            (second, -2.5),
            (third, -2.5),
            (third, -5.0),
            (over, -5.0),
            (over, 0.0),
        ]));
        gap.push(theirs(&[(0.0, 60.0), (rest, PUBLISHED.rest_gap.unwrap_or(0.0))]));
        level.push(theirs(&[
            (from, 0.0),
            (first, 0.0),
            (first, 1.0),
            (second, 1.0),
            (second, 2.0),
            (third, 2.0),
            (third, 3.0),
            (over, 3.0),
            (over, 0.0),
        ]));
    }
    let collision = Line { points: curve(&|moment| moment.collision), colour: VIOLET, width: 2 };
    let ahead = shown.iter().any(|moment| moment.gap.is_some());
    let (fast, far) = (most(&|moment| Some(moment.speed), 20.0), most(&|moment| moment.gap, 20.0));
    let mut panels = vec![
        Panel { title: format!("Speed [km/h]{beside}{}", figure(4)), range: [0.0, fast], lines: speed },
        Panel { title: format!("Acceleration [m/s²]{beside}{}", figure(4)), range: [-7.0, 2.0], lines: acceleration },
    ];
    if ahead {
        panels.push(Panel { title: format!("Gap ahead [m]{beside}{}", figure(5)), range: [0.0, far], lines: gap });
        panels.push(Panel { title: "Time to collision [s]".to_owned(), range: [0.0, 12.0], lines: vec![collision] });
        panels.push(Panel { title: format!("Level of collision mitigation{beside}"), range: [0.0, 3.3], lines: level });
    }
    if let Some([corridor, way]) = drive.lane {
        let edge = |at: f64, colour| Line { points: vec![Some((from, at)), Some((until, at))], colour, width: 1 };
        let mut lines = vec![ours(&|moment| moment.offset)];
        lines.extend(
            [corridor, -corridor].map(|at| edge(at, VIOLET)).into_iter().chain([way, -way].map(|at| edge(at, THEIRS))),
        );
        let title = "Middle of the nearest other beside that of the lane [m]; violet: corridor of the supervisor; brown: in the way of the bus";
        panels.push(Panel { title: title.to_owned(), range: [-4.5, 4.5], lines });
    }
    panels
}

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Failure<'a> = DrawingAreaErrorKind<<SVGBackend<'a> as DrawingBackend>::ErrorType>;

fn draw<'a>(area: &Area<'a>, panel: &Panel, [from, until]: [f64; 2]) -> Result<(), Failure<'a>> {
    let [least, most] = panel.range;
    let mut chart = ChartBuilder::on(area)
        .margin_right(12)
        .caption(&panel.title, ("sans-serif", 13).into_font().color(&INK))
        .x_label_area_size(20)
        .y_label_area_size(130)
        .build_cartesian_2d(from..until, least..most)?;
    chart
        .configure_mesh()
        .x_labels(12)
        .y_labels(5)
        .light_line_style(WHITE)
        .bold_line_style(GRID)
        .label_style(("sans-serif", 11).into_font().color(&INK))
        .draw()?;
    for line in &panel.lines {
        // A value that is missing breaks the line.
        for piece in line.points.split(Option::is_none) {
            let points = piece.iter().flatten().copied().map(|(at, value)| (at, value.clamp(least, most)));
            chart.draw_series(LineSeries::new(points, line.colour.stroke_width(line.width)))?;
        }
    }
    Ok(())
}

/// One lane for each channel that was ever not passed.
fn verdicts<'a>(
    area: &Area<'a>,
    vetted: &[Vetted],
    lanes: &[Channel],
    [from, until]: [f64; 2],
    zero: f64,
) -> Result<(), Failure<'a>> {
    let count = u32::try_from(lanes.len()).unwrap_or(0);
    let title = if lanes.is_empty() { "Verdicts: everything passed" } else { "Verdicts that are no pass" };
    let mut chart = ChartBuilder::on(area)
        .margin_right(12)
        .caption(title, ("sans-serif", 13).into_font().color(&INK))
        .x_label_area_size(20)
        .y_label_area_size(130)
        .build_cartesian_2d(from..until, 0.0..f64::from(count.max(1)))?;
    chart
        .configure_mesh()
        .x_labels(12)
        .y_labels(0)
        .disable_y_mesh()
        .light_line_style(WHITE)
        .bold_line_style(GRID)
        .label_style(("sans-serif", 11).into_font().color(&INK))
        .draw()?;
    let names = area.strip_coord_spec();
    for (row, channel) in (0_u32..).zip(lanes.iter().rev()) {
        let low = f64::from(row);
        let bars = vetted.iter().filter(|vetted| vetted.channel == *channel).filter_map(|vetted| {
            let [begins, ends] = vetted.span.map(|at| (at - zero).clamp(from, until));
            let colour = match vetted.kind {
                Kind::Pass => return None,
                Kind::Limit => RGBColor(240, 180, 41),
                Kind::Substitute => RGBColor(209, 52, 75),
                Kind::Block => VIOLET,
            };
            let corners = [(begins, low + 0.15), (ends.max(begins), low + 0.85)];
            (ends > begins).then(|| Rectangle::new(corners, colour.filled()))
        });
        chart.draw_series(bars)?;
        let place = chart.backend_coord(&(from, low + 0.5));
        let (left, top) = area.get_base_pixel();
        let at = (place.0 - left - 122, place.1 - top - 6);
        names.draw(&Text::new(words::channel(*channel), at, ("sans-serif", 11).into_font().color(&INK)))?;
    }
    Ok(())
}
