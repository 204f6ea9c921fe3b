//! Drives scenes, or a part of them, and keeps of each what is shown.

use std::path::{Path, PathBuf};

use supervisor::{Channel, ConfigError, Kind, Level};
use supervisor_tests::candump;
use supervisor_tests::drive::Cycle;
use supervisor_tests::judge::digest;
use supervisor_tests::scenario::Scene;
use supervisor_tests::scenario::criteria::{Row, Standing};
use supervisor_tests::scenario::happens::Happened;
use supervisor_tests::scenario::run::{Ran, run};

use super::picture::Curves;
use crate::spread::{Steps, cores, mine, spread};

/// What is wanted.
#[derive(Clone, Debug, Default)]
pub struct Request {
    /// The seed.
    pub seed: u64,
    /// Part K of N, from 1; none: all.
    pub shard: Option<(usize, usize)>,
    /// Threads; none: one for each core.
    pub jobs: Option<usize>,
    /// Where logs go.
    pub log: Option<PathBuf>,
}

/// Why a scene was not driven.
#[derive(Debug, thiserror::Error)]
pub enum RunError {
    /// The configuration is refused.
    #[error("{0}")]
    Configuration(#[from] ConfigError),
    /// A log cannot be written.
    #[error("{}: {error}", path.display())]
    Log {
        /// Which.
        path: PathBuf,
        /// Why.
        error: std::io::Error,
    },
}

/// A moment of a drive, as it is drawn.
#[derive(Clone, Copy, Debug)]
pub struct Moment {
    /// Time in s.
    pub at: f64,
    /// Speed in km/h.
    pub speed: f64,
    /// Acceleration in m/s².
    pub acceleration: f64,
    /// Gap in m.
    pub gap: Option<f64>,
    /// Time to collision in s, up to 12 s.
    pub collision: Option<f64>,
    /// Level.
    pub level: u8,
    /// The nearest of the others beside the middle of the lane, in m, where that is told.
    pub offset: Option<f64>,
}

/// A stretch in which a channel was not passed.
#[derive(Clone, Copy, Debug)]
pub struct Vetted {
    /// Which channel.
    pub channel: Channel,
    /// What was done to it.
    pub kind: Kind,
    /// From when to when, in s.
    pub span: [f64; 2],
}

/// What is kept of a drive.
#[derive(Clone, Debug)]
pub struct Driven {
    /// The scene.
    pub scene: Scene,
    /// What was demanded, and whether it was so.
    pub rows: Vec<Row>,
    /// What happened.
    pub events: Vec<Happened>,
    /// How many cycles.
    pub cycles: usize,
    /// Fingerprint of every verdict: that of a replay of its log.
    pub digest: u64,
    /// The curves.
    pub moments: Vec<Moment>,
    /// What was vetted.
    pub vetted: Vec<Vetted>,
    /// The highest level.
    pub level: Level,
}

impl Driven {
    /// How it stands.
    #[must_use]
    pub fn standing(&self) -> Standing {
        self.scene.expected.standing(&self.rows)
    }

    /// Whether everything that is demanded was so.
    #[must_use]
    pub fn passed(&self) -> bool {
        self.standing() == Standing::Met
    }

    /// The word for how it stands.
    #[must_use]
    pub fn word(&self) -> &'static str {
        match self.standing() {
            Standing::Met => "pass",
            Standing::Known => "KNOWN",
            Standing::NotMet => "FAIL",
            Standing::Cured => "CURED",
        }
    }

    /// What is drawn of it.
    #[must_use]
    pub fn curves(&self) -> Curves<'_> {
        let sixty_metres = || self.events.iter().find(|event| event.what == "60 m left");
        let zero = || sixty_metres().map_or(0.0, |event| f64::from(event.at_ms) / 1000.0);
        let published = self.scene.published.then(zero);
        Curves { moments: &self.moments, vetted: &self.vetted, published, lane: None }
    }
}

/// A curve has no more points than this, about.
const POINTS: usize = 900;
/// A time to collision beyond this is not drawn, in s.
const LONGEST_S: f64 = 12.0;

/// Drives them.
///
/// # Errors
/// If the default configuration is refused, or a log cannot be written.
pub fn simulate(scenes: &[Scene], request: &Request) -> Result<Vec<Driven>, RunError> {
    let work: Vec<&Scene> =
        scenes.iter().enumerate().filter(|(number, _)| mine(request.shard, *number)).map(|(_, scene)| scene).collect();
    let steps = Steps::new("scenarios", work.len());
    let one = |scene: &&Scene| -> Result<Driven, RunError> {
        let ran = run(scene, request.seed)?;
        if let Some(folder) = &request.log {
            log(folder, scene, &ran)?;
        }
        Ok(kept((*scene).clone(), &ran))
    };
    spread(&work, request.jobs.unwrap_or_else(cores), &steps, one).into_iter().collect()
}

/// The name of a log: a variant has no place for slashes and spaces.
#[must_use]
pub fn log_name(scene: &Scene) -> String {
    let plain = |letter: char| if letter.is_ascii_alphanumeric() || matches!(letter, '-' | '.') { letter } else { '-' };
    format!("{}.candump.gz", scene.full_name().chars().map(plain).collect::<String>())
}

fn log(folder: &Path, scene: &Scene, ran: &Ran) -> Result<(), RunError> {
    let path = folder.join(log_name(scene));
    let written = std::fs::create_dir_all(folder)
        .and_then(|()| candump::packed(&ran.frames))
        .and_then(|packed| std::fs::write(&path, packed));
    written.map_err(|error| RunError::Log { path, error })
}

fn kept(scene: Scene, ran: &Ran) -> Driven {
    // Of S1's approach a few seconds are shown, and nothing of what comes before.
    let points = if scene.published { 5 * POINTS } else { POINTS };
    let every = ran.cycles.len().div_ceil(points).max(1);
    Driven {
        rows: ran.rows.clone(),
        events: ran.events.clone(),
        cycles: ran.cycles.len(),
        digest: digest(ran.cycles.iter().map(|cycle| cycle.answer)),
        moments: ran.cycles.iter().step_by(every).map(moment).collect(),
        vetted: vetted(&ran.cycles),
        level: ran.cycles.iter().map(|cycle| cycle.answer.status.level).max().unwrap_or(Level::None),
        scene,
    }
}

/// What is drawn of a cycle.
pub(crate) fn moment(cycle: &Cycle) -> Moment {
    let truth = &cycle.truth;
    let near = truth.ahead.filter(|ahead| ahead.gap < 150.0);
    let collision = near.filter(|ahead| ahead.closing > 0.1).map(|ahead| ahead.gap.max(0.0) / ahead.closing);
    Moment {
        at: f64::from(cycle.now_ms) / 1000.0,
        speed: truth.speed * 3.6,
        acceleration: truth.acceleration,
        gap: near.map(|ahead| ahead.gap),
        collision: collision.filter(|collision| *collision <= LONGEST_S),
        level: cycle.answer.status.level.code(),
        offset: None,
    }
}

/// Where each channel was not passed.
pub(crate) fn vetted(cycles: &[Cycle]) -> Vec<Vetted> {
    let mut found: Vec<Vetted> = Vec::new();
    for channel in Channel::ALL.iter().copied() {
        let mut open: Option<Vetted> = None;
        for cycle in cycles {
            let at = f64::from(cycle.now_ms) / 1000.0;
            let verdict = cycle.answer.verdicts.of(channel);
            match &mut open {
                Some(vetted) if !verdict.passed() && vetted.kind == verdict.kind => vetted.span[1] = at + 0.01,
                Some(_) | None => {
                    found.extend(open.take());
                    open = (!verdict.passed()).then_some(Vetted { channel, kind: verdict.kind, span: [at, at + 0.01] });
                }
            }
        }
        found.extend(open);
    }
    found
}
