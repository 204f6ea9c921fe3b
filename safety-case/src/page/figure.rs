//! The figure: curves above, lanes below, one time axis for all.

use std::fmt::Write;

use plotly::common::{DashType, Fill, Font, HoverInfo, Line, LineShape, Mode};
use plotly::layout::{Annotation, Axis, BarMode, HoverMode, Margin, Shape, ShapeLayer, ShapeLine, ShapeType};
use plotly::{Configuration, Layout, Plot, Scatter, Trace};

use super::Picture;
use super::bars::Bars;
use super::series::{Row, SERIES, Series, Stroke};
use super::slots::{Slots, lane_axis, slots, stretches};
use super::trend::Trend;
use crate::number::{float, seconds};
use crate::replay::Report;
use crate::timeline::Entry;
use crate::words;
use supervisor::Cause;

/// Height of a lane in pixels.
const LANE: f64 = 17.0;
/// Space above each row, for its title.
const TITLE: f64 = 34.0;
/// Space above and below everything.
const EDGE: usize = 40;
/// Space for the names of the lanes.
const LEFT: usize = 168;

/// Greatest number of shaded spans.
const SILENCES: usize = 100;

/// What goes into the page.
#[derive(Debug)]
pub struct Figure {
    /// For plotly.js: data, layout, configuration.
    pub json: String,
    /// Height in pixels.
    pub height: usize,
    /// Inputs of which not one frame came.
    pub never: Vec<&'static str>,
    /// Inputs that, once known, stayed so: they need no lane.
    pub steady: Vec<&'static str>,
}

/// A row of curves that has something to show.
struct Panel {
    row: Row,
    title: &'static str,
    height: f64,
    axis: usize,
    /// The axis reaches at least from zero to here; `None` leaves it to the data.
    least: Option<f64>,
}

const PANELS: &[Panel] = &[
    Panel { row: Row::Speed, title: "Speed [km/h]", height: 130.0, axis: 1, least: Some(10.0) },
    Panel {
        row: Row::Distance,
        title: "Object ahead: distance [m], time to collision [s, right]",
        height: 130.0,
        axis: 2,
        least: Some(20.0),
    },
    Panel { row: Row::Deceleration, title: "Deceleration [m/s²]", height: 170.0, axis: 4, least: Some(6.0) },
    Panel { row: Row::Torque, title: "Drive torque, pedals [%]", height: 150.0, axis: 5, least: Some(100.0) },
    Panel { row: Row::Steering, title: "Steering-wheel angle [°]", height: 120.0, axis: 6, least: None },
];
/// The axis of times to collision lies over that of distance.
const COLLISION_AXIS: usize = 3;
/// The axis of the lanes.
pub(super) const LANE_AXIS: usize = 7;

pub(super) fn axis_name(axis: usize) -> &'static str {
    ["y", "y", "y2", "y3", "y4", "y5", "y6", "y7"].get(axis).copied().unwrap_or("y")
}

fn axis_of(row: Row) -> usize {
    match row {
        Row::Collision => COLLISION_AXIS,
        Row::Speed | Row::Distance | Row::Deceleration | Row::Torque | Row::Steering => {
            PANELS.iter().find(|panel| panel.row == row).map_or(1, |panel| panel.axis)
        }
    }
}

/// Makes the figure.
#[must_use]
pub fn figure(trends: &[Trend], lanes: Vec<Bars>, picture: &Picture<'_>) -> Figure {
    // A row with nothing but a second source or a bound shows nothing.
    let tells = |series: &Series| series.row != Row::Steering || series.stroke != Stroke::Dotted;
    let shown = |row: Row| {
        SERIES.iter().zip(trends).any(|(series, trend)| series.row == row && tells(series) && !trend.is_empty())
    };
    let panels: Vec<&Panel> = PANELS.iter().filter(|panel| shown(panel.row)).collect();
    let Slots { drawn: slots, never, steady } = slots(lanes);
    let lanes_height = float(u64::try_from(slots.len()).unwrap_or(0)) * LANE;
    let total: f64 = panels.iter().map(|panel| panel.height + TITLE).sum::<f64>() + lanes_height + TITLE;

    let mut plot = Plot::new();
    let mut layout = Layout::new()
        .auto_size(true)
        .show_legend(false)
        .bar_mode(BarMode::Overlay)
        .hover_mode(HoverMode::Closest)
        .font(Font::new().family("system-ui, \"Segoe UI\", Roboto, sans-serif").size(12).color("#243042"))
        .paper_background_color("#ffffff")
        .plot_background_color("#fbfcfd")
        .margin(Margin::new().left(LEFT).right(44).top(EDGE).bottom(EDGE));
    let mut top = total;
    for panel in &panels {
        top -= TITLE;
        let domain = [(top - panel.height) / total, top / total];
        layout = with_axis(layout, panel.axis, panel_axis(panel, trends).domain(&domain));
        layout.add_annotation(title(&legend(panel, trends), domain[1]));
        if panel.row == Row::Distance {
            let right = row_axis().overlaying("y2").side(plotly::common::AxisSide::Right).show_grid(false);
            layout = with_axis(layout, COLLISION_AXIS, right.range(vec![-0.5, 13.0]));
            for level in picture.levels {
                layout.add_shape(threshold(level));
            }
        }
        top -= panel.height;
    }
    for shape in silences(picture.report) {
        layout.add_shape(shape);
    }
    top -= TITLE;
    layout.add_annotation(title("<b>Verdicts, states and inputs</b>", top / total));
    layout = with_axis(layout, LANE_AXIS, lane_axis(&slots).domain(&[0.0, top / total]));
    let (from, to) = (seconds(picture.report.span.0), seconds(picture.report.span.1));
    layout = layout.x_axis(
        Axis::new()
            .anchor(axis_name(LANE_AXIS))
            .range(vec![from, to.max(from + 0.01)])
            .tick_suffix(" s")
            .grid_color("#e6eaf0")
            .zero_line(false)
            .mirror(true)
            .show_line(true)
            .line_color("#c3cad5"),
    );
    layout = layout.x_axis2(
        Axis::new()
            .overlaying("x")
            .matches("x")
            .side(plotly::common::AxisSide::Top)
            .anchor("free")
            .position(1.0)
            .tick_suffix(" s")
            .show_grid(false)
            .zero_line(false),
    );
    plot.set_layout(layout);
    plot.set_configuration(Configuration::new().responsive(true).display_logo(false).typeset_math(false));

    for (series, trend) in SERIES.iter().zip(trends).filter(|(series, trend)| shown(series.row) && !trend.is_empty()) {
        plot.add_trace(line(series, trend));
    }
    // The axis above is drawn only if something is on it.
    plot.add_trace(
        Scatter::new(vec![from], vec![Option::<f64>::None]).x_axis("x2").y_axis("y7").hover_info(HoverInfo::Skip),
    );
    for trace in stretches(&slots) {
        plot.add_trace(Box::new(trace));
    }
    let height = crate::number::rounded(total).and_then(|height| usize::try_from(height).ok()).unwrap_or(1200);
    Figure { json: plot.to_json(), height: height + 2 * EDGE, never, steady }
}

fn with_axis(layout: Layout, index: usize, axis: Axis) -> Layout {
    match index {
        1 => layout.y_axis(axis),
        2 => layout.y_axis2(axis),
        3 => layout.y_axis3(axis),
        4 => layout.y_axis4(axis),
        5 => layout.y_axis5(axis),
        6 => layout.y_axis6(axis),
        _ => layout.y_axis7(axis),
    }
}

fn row_axis() -> Axis {
    Axis::new()
        .anchor("x")
        .fixed_range(true)
        .grid_color("#e6eaf0")
        .zero_line_color("#c3cad5")
        .n_ticks(6)
        .range_mode(plotly::layout::RangeMode::ToZero)
}

/// Room above and below, so that no line runs along the edge.
fn panel_axis(panel: &Panel, trends: &[Trend]) -> Axis {
    let mine = SERIES.iter().zip(trends).filter(|(series, _)| series.row == panel.row);
    let greatest = mine.filter_map(|(_, trend)| trend.greatest()).reduce(f64::max).unwrap_or(0.0);
    match panel.least {
        None => row_axis(),
        Some(least) => {
            let top = greatest.max(least);
            row_axis().range(vec![-0.04 * top, 1.06 * top])
        }
    }
}

/// Spans in which several inputs were silent, or back but not yet trusted, are shaded through all rows.
fn silences(report: &Report) -> Vec<Shape> {
    let colour = |entry: &Entry| match () {
        () if entry.text.starts_with(words::cause(Cause::Stale)) => Some("rgba(209, 52, 75, 0.13)"),
        () if entry.text.starts_with(words::cause(Cause::Requalifying)) => Some("rgba(240, 180, 41, 0.15)"),
        () => None,
    };
    // What never comes back is no span.
    let several = |entry: &&Entry| entry.what.ends_with(" inputs") && entry.to < report.span.1;
    let spans = report.timeline.0.iter().filter(several);
    spans
        .filter_map(|entry| {
            let shape = Shape::new().shape_type(ShapeType::Rect).x_ref("x").y_ref("paper").layer(ShapeLayer::Below);
            let (from, to) = (seconds(entry.from), seconds(entry.to));
            Some(shape.x0(from).x1(to).y0(0.0).y1(1.0).fill_color(colour(entry)?).line(ShapeLine::new().width(0.0)))
        })
        .take(SILENCES)
        .collect()
}

fn title(text: &str, top: f64) -> Annotation {
    Annotation::new()
        .text(text)
        .x_ref("paper")
        .y_ref("paper")
        .x(0.0)
        .y(top)
        .x_anchor(plotly::common::Anchor::Left)
        .y_anchor(plotly::common::Anchor::Bottom)
        .show_arrow(false)
        .font(Font::new().size(12))
}

/// The row's title and its curves in their colours: a legend that prints.
fn legend(panel: &Panel, trends: &[Trend]) -> String {
    let mut text = format!("<b>{}</b>", panel.title);
    for (series, _) in SERIES.iter().zip(trends).filter(|(_, trend)| !trend.is_empty()).rev() {
        let here = series.row == panel.row || (panel.row == Row::Distance && series.row == Row::Collision);
        if here {
            let mark = match series.stroke {
                Stroke::Strong => "━",
                Stroke::Area => "▆",
                Stroke::Thin => "─",
                Stroke::Dashed => "╌",
                Stroke::Dotted => "┈",
            };
            let _ = write!(text, "   <span style=\"color:{}\"><b>{mark}</b> {}</span>", series.colour, series.name);
        }
    }
    text
}

/// A level's time to collision, as a dotted line in the row of the object ahead.
fn threshold(level: f64) -> Shape {
    Shape::new()
        .shape_type(ShapeType::Line)
        .x_ref("paper")
        .y_ref(axis_name(COLLISION_AXIS))
        .x0(0.0)
        .x1(1.0)
        .y0(level)
        .y1(level)
        .layer(ShapeLayer::Below)
        .line(ShapeLine::new().color("#c9b6e4").width(1.0).dash(DashType::Dot))
}

fn line(series: &Series, trend: &Trend) -> Box<dyn Trace> {
    let curve = trend.curve(3);
    let (width, dash) = match series.stroke {
        Stroke::Strong => (2.4, DashType::Solid),
        Stroke::Thin | Stroke::Area => (1.2, DashType::Solid),
        Stroke::Dashed => (1.7, DashType::Dash),
        Stroke::Dotted => (1.5, DashType::Dot),
    };
    let template = format!("{}: <b>%{{y}} {}</b> at %{{x}}<extra></extra>", series.name, series.unit);
    let scatter = Scatter::new(curve.x, curve.y);
    let scatter = match series.stroke {
        Stroke::Area => scatter.fill(Fill::ToZeroY).fill_color("rgba(193, 41, 59, 0.16)"),
        Stroke::Strong | Stroke::Dashed | Stroke::Thin | Stroke::Dotted => scatter,
    };
    scatter
        .name(series.name)
        .mode(Mode::Lines)
        .line(Line::new().color(series.colour).width(width).dash(dash).shape(LineShape::Hv))
        .x_axis("x")
        .y_axis(axis_name(axis_of(series.row)))
        .text(series.unit)
        .hover_template(template.as_str())
}
