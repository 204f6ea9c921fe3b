//! The page: one file that shows a whole drive, offline, with zoom and hover.

mod bars;
mod figure;
mod html;
mod series;
mod slots;
mod trend;

use crate::cycle::Cycle;
use crate::lanes::COUNT;
use crate::replay::Report;
use crate::runs::{Run, Sink};
use bars::Bars;
use series::SERIES;
use trend::Trend;

pub use html::{IndexEntry, duration, index};

/// What the page shows beside the curves and lanes.
#[derive(Clone, Copy, Debug)]
pub struct Picture<'a> {
    /// Title.
    pub title: &'a str,
    /// The logs.
    pub logs: &'a [String],
    /// Everything that was counted.
    pub report: &'a Report,
    /// Times to collision at which the levels enter, in seconds.
    pub levels: [f64; 3],
}

/// Gathers what the page shows while the replay goes on.
#[derive(Debug)]
pub struct Page {
    trends: Vec<Trend>,
    lanes: Vec<Bars>,
}

impl Default for Page {
    fn default() -> Self {
        Self { trends: vec![Trend::default(); SERIES.len()], lanes: vec![Bars::default(); COUNT] }
    }
}

impl Page {
    /// Takes the curves of a cycle.
    pub fn cycle(&mut self, cycle: &Cycle<'_>) {
        for (trend, series) in self.trends.iter_mut().zip(SERIES) {
            trend.push(cycle.at, (series.read)(cycle));
        }
    }

    /// The page as one HTML file.
    ///
    /// # Errors
    /// If the template does not render.
    pub fn render(self, picture: &Picture<'_>) -> Result<String, minijinja::Error> {
        let figure = figure::figure(&self.trends, self.lanes, picture);
        html::page(&figure, picture)
    }
}

impl Sink for Page {
    fn ended(&mut self, run: &Run) {
        if let Some(bars) = self.lanes.get_mut(run.lane) {
            bars.push(run);
        }
    }
}
