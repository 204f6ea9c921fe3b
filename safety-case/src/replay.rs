//! The replay: frames of a log through decoding and supervisor, every 10 ms of log time.

use std::fs::File;
use std::io::{self, BufWriter};
use std::path::{Path, PathBuf};

use serde_json::{Value, json};
use supervisor::{Config, Millis, Record, ResetCause, Sealed, Supervisor, perceive};

use crate::candump::{Log, LogFrame, OpenError};
use crate::cycle::Cycle;
use crate::digest::Digest;
use crate::document::Document;
use crate::grid::{Grid, Stamp, Step};
use crate::notes::{Notes, Oddity, Place};
use crate::number::{float, seconds, wrapping_millis};
use crate::page::{Page, Picture};
use crate::progress::Progress;
use crate::road::{MapError, Outcome, Road};
use crate::runs::{Run, Sink, Tracker};
use crate::stretches::{Stretch, Stretches};
use crate::summary::Summary;
use crate::timeline::{Entry, Timeline};
use crate::troubles::{Episode, Troubles};

/// What to replay, and what to write.
#[derive(Clone, Debug)]
pub struct Request {
    /// The logs of one drive, in order.
    pub logs: Vec<PathBuf>,
    /// Only frames of this bus.
    pub bus: Option<String>,
    /// The mapping, if not ours.
    pub map: Option<PathBuf>,
    /// The DBC, if not the mapping's.
    pub dbc: Option<PathBuf>,
    /// The configuration.
    pub sealed: Sealed,
    /// Why the supervisor starts.
    pub boot: ResetCause,
    /// What was persisted before; `None` if it is lost.
    pub record: Option<Record>,
    /// Where to write the JSON document.
    pub json: Option<PathBuf>,
    /// Where to write the page.
    pub html: Option<PathBuf>,
    /// Title of the page.
    pub title: String,
    /// How many entries the timeline keeps.
    pub timeline: usize,
    /// Compute the digest of every verdict.
    pub digest: bool,
    /// Show a progress bar if there is a terminal.
    pub progress: bool,
}

impl Request {
    /// One log on our link, after a clean key-on; only the summary and the digest of every verdict.
    #[must_use]
    pub fn of(log: PathBuf, sealed: Sealed) -> Self {
        Self {
            logs: vec![log],
            bus: None,
            map: None,
            dbc: None,
            sealed,
            boot: ResetCause::PowerOn,
            record: Some(Record::None),
            json: None,
            html: None,
            title: String::new(),
            timeline: 0,
            digest: true,
            progress: false,
        }
    }
}

/// Why a replay did not happen.
#[derive(Debug, thiserror::Error)]
pub enum Failure {
    /// A log cannot be opened.
    #[error(transparent)]
    Log(#[from] OpenError),
    /// The mapping or the DBC is bad.
    #[error(transparent)]
    Map(#[from] MapError),
    /// A file cannot be written.
    #[error("{}: {reason}", file.display())]
    Write {
        /// The file.
        file: PathBuf,
        /// Why.
        reason: io::Error,
    },
    /// The page could not be made.
    #[error("{}: {reason}", file.display())]
    Page {
        /// The file.
        file: PathBuf,
        /// Why.
        reason: minijinja::Error,
    },
    /// Not one line could be understood.
    #[error("{files}: none of {lines} lines is a frame; is this a candump log? {first}")]
    NoLog {
        /// The logs.
        files: String,
        /// How many lines there were.
        lines: u64,
        /// The first oddity.
        first: String,
    },
}

/// What a replay showed.
#[derive(Debug)]
pub struct Report {
    /// What decoded the frames.
    pub mapping: String,
    /// Data frames read.
    pub frames: u64,
    /// Of these, frames that were used.
    pub taken: u64,
    /// Steps of the supervisor.
    pub cycles: u64,
    /// Where the axis begins and ends, in microseconds.
    pub span: (u64, u64),
    /// The stamp of the first frame, in microseconds.
    pub first_stamp: u64,
    /// How long the replay took, in seconds.
    pub took: f64,
    /// Verdicts and interventions.
    pub summary: Summary,
    /// FNV-1a over every verdict of every cycle, if it was asked for.
    pub digest: Option<u64>,
    /// What was odd.
    pub notes: Notes,
    /// The timeline, and how many entries it left out.
    pub timeline: (Vec<Entry>, u64),
    /// The trouble codes that were ever active.
    pub troubles: Vec<Value>,
}

impl Report {
    /// The summary as it stands in the JSON document.
    #[must_use]
    pub fn summary_json(&self) -> Value {
        json!({
            "frames": self.frames, "frames_taken": self.taken, "frames_unknown": self.notes.unknown_frames(),
            "frames_refused": self.notes.refused(), "lines_malformed": self.notes.malformed(),
            "cycles": self.cycles, "from": seconds(self.span.0), "to": seconds(self.span.1),
            "first_stamp": seconds(self.first_stamp),
            "interventions": self.summary.interventions(), "brief": self.summary.brief(),
            "longest": self.summary.longest(), "verdicts": self.summary.counts(), "notes": self.notes.lines(),
            "troubles": self.troubles,
        })
    }

    /// Frames per second of the replay itself.
    #[must_use]
    pub fn rate(&self) -> f64 {
        float(self.frames) / self.took.max(1e-6)
    }
}

/// Everything that takes runs.
struct Sinks {
    stretches: Stretches,
    timeline: Timeline,
    summary: Summary,
    document: Option<Document<BufWriter<File>>>,
    page: Option<Page>,
}

impl Sink for Sinks {
    fn ended(&mut self, run: &Run) {
        if let Some(stretch) = self.stretches.ended(run) {
            self.stretch(&stretch);
        }
        self.summary.ended(run);
        self.timeline.ended(run);
        if let Some(document) = &mut self.document {
            document.ended(run);
        }
        if let Some(page) = &mut self.page {
            page.ended(run);
        }
    }
}

impl Sinks {
    fn stretch(&mut self, stretch: &Stretch) {
        self.summary.stretch(stretch);
        if stretch.intervenes()
            && let Some(document) = &mut self.document
        {
            document.intervention(stretch);
        }
    }

    fn trouble(&mut self, episode: &Episode) {
        self.timeline.span(episode.from, episode.to, "trouble code (DM1)", episode.text());
        if let Some(document) = &mut self.document {
            document.trouble(episode);
        }
    }
}

struct Engine {
    supervisor: Supervisor,
    config: Config,
    road: Road,
    grid: Grid,
    tracker: Tracker,
    troubles: Troubles,
    sinks: Sinks,
    cycles: u64,
    digest: Option<Digest>,
}

impl Engine {
    fn step(&mut self, step: Step) {
        let now = Millis::new(wrapping_millis(step.clock));
        let (inputs, scene, commands) = self.road.sample(now);
        let decision = self.supervisor.step(now, inputs, scene, commands);
        let threat = perceive(scene, &self.config);
        for episode in self.troubles.cycle(step.at, now, &decision) {
            self.sinks.trouble(&episode);
        }
        let troubles = self.troubles.active();
        let cycle = Cycle { at: step.at, inputs, scene, threat: &threat, commands, decision: &decision, troubles };
        self.tracker.cycle(&cycle, &mut self.sinks);
        if let Some(digest) = &mut self.digest {
            digest.add(&decision.verdicts);
        }
        if let Some(page) = &mut self.sinks.page {
            page.cycle(&cycle);
        }
        self.cycles += 1;
    }

    /// Steps up to the frame, then takes it.
    fn frame(&mut self, place: Place, frame: &LogFrame, notes: &mut Notes) -> bool {
        let stamp = self.grid.judge(frame.micros);
        if stamp != Stamp::Onward {
            self.odd(stamp, place, frame, notes);
        }
        while let Some(step) = self.grid.due(frame.micros) {
            self.step(step);
        }
        let now = Millis::new(wrapping_millis(self.grid.received(frame.micros)));
        match self.road.accept(now, frame) {
            Outcome::Taken(0) => return true,
            Outcome::Taken(lost) => {
                notes.add(Oddity::Lost, place, || format!("{lost} before this frame"));
                return true;
            }
            Outcome::Unknown => notes.unknown(frame.extended, frame.id, place),
            Outcome::Refused(why) => notes.refuse(why, place),
        }
        false
    }

    fn odd(&mut self, stamp: Stamp, place: Place, frame: &LogFrame, notes: &mut Notes) {
        let (kind, name) = match stamp {
            Stamp::Onward => return,
            Stamp::OutOfOrder => (Oddity::OutOfOrder, ""),
            Stamp::Backwards => (Oddity::Backwards, "backwards"),
            Stamp::Ahead => (Oddity::Ahead, "ahead"),
        };
        notes.add(kind, place, || format!("({:.6})", seconds(frame.micros)));
        if stamp.leaps() {
            if let Some(step) = self.grid.close() {
                self.step(step);
            }
            self.grid.leap(frame.micros);
            let (at, place) = (self.grid.axis(), notes.place(place));
            let text = format!("the log's clock leaps {name}, to {:.2} s ({place}) [SELF-3]", seconds(frame.micros));
            self.sinks.timeline.event(at, "clock", text);
            if let Some(document) = &mut self.sinks.document {
                document.clock(at, &place, name);
            }
        }
    }
}

/// Creates a file, with the folders above it.
///
/// # Errors
/// If it cannot be written.
pub fn create(file: &Path) -> Result<BufWriter<File>, Failure> {
    let failure = |reason| Failure::Write { file: file.to_owned(), reason };
    if let Some(folder) = file.parent().filter(|folder| !folder.as_os_str().is_empty()) {
        std::fs::create_dir_all(folder).map_err(failure)?;
    }
    File::create(file).map(BufWriter::new).map_err(failure)
}

/// Replays.
///
/// # Errors
/// If a file cannot be read or written, the mapping is bad, or the log is none.
pub fn run(request: &Request) -> Result<Report, Failure> {
    let config = *request.sealed.intact().unwrap_or(&Config::DEFAULT);
    let road = Road::open(request.map.as_deref(), request.dbc.as_deref(), &config)?;
    let mut log = Log::open(&request.logs, request.bus.as_deref())?;
    let mapping = road.name().to_owned();
    let names: Vec<String> = request.logs.iter().map(|file| file.display().to_string()).collect();
    let document = request.json.as_deref().map(create).transpose()?;
    let sinks = Sinks {
        stretches: Stretches::default(),
        timeline: Timeline::new(request.timeline),
        summary: Summary::default(),
        document: document.map(|out| Document::begin(out, &names, &mapping)),
        page: request.html.as_ref().map(|_| Page::default()),
    };
    let supervisor = Supervisor::new(request.sealed, request.boot, request.record);
    let digest = request.digest.then(Digest::default);
    let mut engine = Engine {
        supervisor,
        config,
        road,
        grid: Grid::default(),
        tracker: Tracker::default(),
        troubles: Troubles::default(),
        sinks,
        cycles: 0,
        digest,
    };

    let progress = Progress::start(request, log.bytes_read());
    let started = std::time::Instant::now();
    let mut notes = Notes::new(request.logs.clone());
    let (mut frames, mut taken, mut first_stamp, mut begin) = (0_u64, 0_u64, 0, 0);
    while let Some((place, frame)) = log.next(&mut notes) {
        taken += u64::from(engine.frame(place, &frame, &mut notes));
        if frames == 0 {
            (first_stamp, begin) = (frame.micros, engine.grid.axis());
        }
        frames += 1;
        progress.tick(frames);
    }
    if let Some(step) = engine.grid.close() {
        engine.step(step);
    }
    let Engine { mut tracker, mut troubles, mut sinks, grid, cycles, digest, .. } = engine;
    tracker.finish(&mut sinks);
    for episode in troubles.finish() {
        sinks.trouble(&episode);
    }
    for stretch in std::mem::take(&mut sinks.stretches).finish() {
        sinks.stretch(&stretch);
    }
    let took = started.elapsed().as_secs_f64();
    progress.finish();

    if frames == 0 && log.lines() > 0 {
        let first = notes.lines().into_iter().next();
        let first = first.map_or(String::new(), |line| format!("{}: {}", line.what, line.first.join(", ")));
        return Err(Failure::NoLog { files: names.join(", "), lines: log.lines(), first });
    }
    let Sinks { timeline, summary, document, page, .. } = sinks;
    let timeline = timeline.finish();
    let span = (begin, grid.axis());
    let digest = digest.map(Digest::value);
    let troubles = troubles.rows();
    let report =
        Report { mapping, frames, taken, cycles, span, first_stamp, took, summary, digest, notes, timeline, troubles };
    if let (Some(document), Some(file)) = (document, &request.json) {
        let written = document.finish(&report.summary_json());
        written.map_err(|reason| Failure::Write { file: file.clone(), reason })?;
    }
    if let (Some(page), Some(file)) = (page, &request.html) {
        let levels = config.level_ttc.0.map(|level| f64::from(level.raw()) / 1000.0);
        let picture = Picture { title: &request.title, logs: &names, report: &report, levels };
        let html = page.render(&picture).map_err(|reason| Failure::Page { file: file.clone(), reason })?;
        io::Write::write_all(&mut create(file)?, html.as_bytes())
            .map_err(|reason| Failure::Write { file: file.clone(), reason })?;
    }
    Ok(report)
}
