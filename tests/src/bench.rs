//! The closed loop, cycle by cycle: bus → link → supervisor → bus, with the main controller one cycle behind.
//!
//! [`Hooks`] are the places where something may go wrong; without one in the way, nothing does. A bench can be cloned at
//! any cycle and driven on in another way.

use supervisor::wire::Frame;
use supervisor::{
    Commands, Config, ConfigError, Decision, Inputs, Millis, Outputs, Record, ResetCause, Scene, Sealed, Status,
    Supervisor, Verdict, Verdicts,
};

use crate::controller::{Controller, Pace};
use crate::drive::{Answer, Cycle, Scenario};
use crate::link::{Clocked, Link, Stamped};
use crate::plant::{CYCLE_MS, Plant, Truth};

/// Who sends a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Node {
    /// Sensors and actuators.
    Sensors,
    /// The main controller.
    Controller,
}

/// Places where a cycle can be disturbed, in the order in which they come.
pub trait Hooks {
    /// The vehicle, before it is read.
    fn vehicle(&mut self, _now_ms: u32, _plant: &mut Plant) {}
    /// What the main controller asks for.
    fn commands(&mut self, _now_ms: u32, _sent: &mut Outputs) {}
    /// Whether the main controller sends anything.
    fn silent(&mut self, _now_ms: u32) -> bool {
        false
    }
    /// What the sensors say.
    fn inputs(&mut self, _now_ms: u32, _inputs: &mut Inputs, _scene: &mut Scene) {}
    /// The frames of one node in this cycle.
    fn frames(&mut self, _now_ms: u32, _node: Node, _frames: &mut Vec<Frame>) {}
    /// What of these frames is there before this cycle, each with its time; none: all of them, at once.
    fn carries(&mut self, _now_ms: u32, _frames: &[Frame]) -> Option<Vec<Stamped>> {
        None
    }
    /// Whether the supervisor runs in this cycle: reads frames, steps, sends.
    fn runs(&mut self, _now_ms: u32) -> bool {
        true
    }
    /// What the supervisor's clock shows in this cycle, in ms.
    fn clock(&mut self, now_ms: u32) -> u32 {
        now_ms
    }
    /// Another supervisor in the place of this one; `true`: started anew, so its link begins anew, too.
    fn replace(
        &mut self,
        _now_ms: u32,
        _supervisor: &Supervisor,
        _last: Option<&Status>,
    ) -> Option<(Supervisor, bool)> {
        None
    }
    /// What actuators without any supervision would take from the main controller.
    fn unsupervised(&mut self, _now_ms: u32, sent: &Outputs) -> Outputs {
        *sent
    }
}

/// Nothing goes wrong.
#[derive(Clone, Copy, Debug)]
pub struct Undisturbed;

impl Hooks for Undisturbed {}

/// Whom the bus obeys.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Obeys {
    /// The supervisor.
    Supervisor,
    /// The main controller; the supervisor only watches.
    Controller,
}

/// How long actuators do as they were last told by a supervisor that says no more, in ms (AOU-06).
const LISTEN_MS: u32 = 120;

/// The closed loop between two cycles.
#[derive(Clone, Debug)]
pub struct Bench<'a> {
    now_ms: u32,
    supervisor: Supervisor,
    plant: Plant<'a>,
    controller: Controller,
    pace: Pace,
    link: Link,
    wanted: Outputs,
    obeys: Obeys,
    last: Option<Answer>,
    /// The supervisor has not run for so long, in ms.
    absent_ms: u32,
}

impl<'a> Bench<'a> {
    /// Before the first cycle: default configuration, clean key-on.
    ///
    /// # Errors
    /// If the default configuration is refused.
    pub fn new(scenario: &Scenario<'a>) -> Result<Self, ConfigError> {
        Ok(Self::configured(scenario, Sealed::from_default()?))
    }

    /// The same with a configuration of its own.
    #[must_use]
    pub fn configured(scenario: &Scenario<'a>, sealed: Sealed) -> Self {
        let supervisor = Supervisor::new(sealed, ResetCause::PowerOn, Some(Record::None));
        Self {
            now_ms: 0,
            link: Link::new(supervisor.config()),
            supervisor,
            plant: Plant::new(scenario.parameters, scenario.script, scenario.road),
            controller: Controller::default(),
            pace: Pace::default(),
            wanted: Outputs::NEUTRAL,
            obeys: Obeys::Supervisor,
            last: None,
            absent_ms: 0,
        }
    }

    /// The same with another one to obey, from now on.
    #[must_use]
    pub const fn obeying(mut self, obeys: Obeys) -> Self {
        self.obeys = obeys;
        self
    }

    /// The same with another main controller, from now on.
    #[must_use]
    pub fn driven_by(mut self, controller: Controller) -> Self {
        self.controller = controller;
        self
    }

    /// Keeps every frame from now on.
    #[must_use]
    pub fn with_log(mut self) -> Self {
        self.link.keep_log();
        self
    }

    /// Every frame that was kept.
    #[must_use]
    pub fn into_log(self) -> Vec<Stamped> {
        self.link.into_log()
    }

    /// The truth of this moment.
    #[must_use]
    pub fn truth(&self) -> Truth {
        self.plant.truth()
    }

    /// Time of the last cycle, in ms.
    #[must_use]
    pub const fn now_ms(&self) -> u32 {
        self.now_ms
    }

    /// One cycle.
    pub fn step(&mut self, hooks: &mut impl Hooks) -> Cycle {
        self.now_ms = self.now_ms.saturating_add(CYCLE_MS);
        let now_ms = self.now_ms;
        hooks.vehicle(now_ms, &mut self.plant);
        let mut sent = self.wanted;
        hooks.commands(now_ms, &mut sent);
        let due = self.pace.next(&sent);
        let commands = if hooks.silent(now_ms) { Commands::ABSENT } else { due };
        let (mut inputs, mut scene) = self.plant.sense();
        hooks.inputs(now_ms, &mut inputs, &mut scene);
        let frames = self.link.frames(now_ms, (&inputs, &scene), &commands, hooks);

        if let Some((supervisor, anew)) =
            hooks.replace(now_ms, &self.supervisor, self.last.as_ref().map(|last| &last.status))
        {
            self.supervisor = supervisor;
            if anew {
                self.link.start_anew(&Config::DEFAULT);
            }
        }
        // The first cycle always runs.
        let absent = self.last.filter(|_| !hooks.runs(now_ms));
        let answer = if let Some(last) = absent {
            self.absent_ms = self.absent_ms.saturating_add(CYCLE_MS);
            absence(&last, self.absent_ms)
        } else {
            let clock = Clocked { true_ms: now_ms, shown_ms: hooks.clock(now_ms) };
            let sample = self.link.supervisor_reads(clock, &frames);
            let now = Millis::new(clock.shown_ms);
            let decision: Decision = self.supervisor.step(now, sample.inputs, sample.scene, sample.commands);
            self.absent_ms = 0;
            Answer::from(decision)
        };
        let sample = self.link.controller_reads(now_ms, &frames);
        self.wanted = self.controller.step(Millis::new(now_ms), sample.inputs, sample.scene);
        self.last = Some(answer);
        let unsupervised = hooks.unsupervised(now_ms, &sent);
        let outputs = match self.obeys {
            Obeys::Supervisor => answer.outputs,
            Obeys::Controller => unsupervised,
        };
        let heard = self.absent_ms <= LISTEN_MS;
        let cycle = Cycle { now_ms, truth: self.plant.truth(), answer: Answer { outputs, ..answer }, heard };
        self.plant.advance(&outputs);
        cycle
    }
}

/// No supervisor: the actuators keep the last outputs for a while, then go to their safe reaction.
fn absence(last: &Answer, absent_ms: u32) -> Answer {
    let outputs = if absent_ms > LISTEN_MS { Outputs::NEUTRAL } else { last.outputs };
    Answer { outputs, verdicts: Verdicts::new([Verdict::PASS; 12]), ..*last }
}
