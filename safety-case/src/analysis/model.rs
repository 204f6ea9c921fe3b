//! The shape of the data: one struct per entry, closed against unknown keys.

use std::collections::BTreeSet;

use serde::{Deserialize, Serialize};

use super::fmea::Failure;
use super::limitations::{Limitation, Risk};
use super::methods::MethodTable;
use super::tools::Tool;

/// The item: what is analysed.
#[derive(Debug, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Item {
    /// Id.
    pub id: String,
    /// Short name.
    pub name: String,
    /// What it is for.
    pub purpose: String,
    /// The element of the item that this project delivers.
    pub element: String,
    /// What counts as evidence.
    pub trust: String,
    /// The vehicles it is made for.
    pub vehicles: String,
}

/// What belongs to the element and what does not.
#[derive(Debug, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Boundary {
    /// Parts of the element.
    pub inside: Vec<String>,
    /// Parts of its surroundings.
    pub outside: Vec<String>,
}

/// One interface of the element.
#[derive(Debug, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Interface {
    /// Id, `IF-nn`.
    pub id: String,
    /// Short name.
    pub name: String,
    /// `in`, `out` or `both`, seen from the supervisor.
    pub direction: Direction,
    /// Who is on the other side.
    pub counterpart: String,
    /// What is exchanged.
    pub content: String,
}

/// Direction of an interface, seen from the supervisor.
#[derive(Clone, Copy, Debug, Deserialize, Serialize, PartialEq, Eq)]
#[serde(rename_all = "lowercase")]
pub enum Direction {
    /// Read by the supervisor.
    In,
    /// Written by the supervisor.
    Out,
    /// Both.
    Both,
}

/// One operating mode.
#[derive(Debug, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct OperatingMode {
    /// Id, `OM-nn`.
    pub id: String,
    /// Short name.
    pub name: String,
    /// What it means.
    pub meaning: String,
}

/// The file `item.toml`.
#[derive(Debug, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct ItemFile {
    /// The item.
    pub item: Item,
    /// Its boundary.
    pub boundary: Boundary,
    /// Its interfaces.
    pub interface: Vec<Interface>,
    /// Its operating modes.
    pub mode: Vec<OperatingMode>,
}

/// An assumed integrity level, in rising order.
#[derive(Clone, Copy, Debug, Deserialize, Serialize, PartialEq, Eq, PartialOrd, Ord)]
#[serde(rename_all = "UPPERCASE")]
pub enum Asil {
    /// Quality management.
    Qm,
    /// A.
    A,
    /// B.
    B,
    /// C.
    C,
    /// D.
    D,
}

impl Asil {
    /// The level that the table of ISO 26262-3 gives to severity, exposure and controllability; `None` outside of the scales
    /// S0–S3, E0–E4, C0–C3.
    #[must_use]
    pub fn from_rating(severity: u8, exposure: u8, controllability: u8) -> Option<Self> {
        if severity > 3 || exposure > 4 || controllability > 3 {
            return None;
        }
        if severity == 0 || exposure == 0 || controllability == 0 {
            return Some(Self::Qm);
        }
        // At most 10: the ratings have just been bounded.
        Some(match severity + exposure + controllability {
            10 => Self::D,
            9 => Self::C,
            8 => Self::B,
            7 => Self::A,
            _ => Self::Qm,
        })
    }
}

/// A hazard at vehicle level.
#[derive(Debug, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Hazard {
    /// Id, `HZ-nn`.
    pub id: String,
    /// Short name.
    pub title: String,
    /// What happens.
    pub description: String,
    /// The situations in which it is rated.
    pub event: Vec<Event>,
}

/// A hazardous event: a hazard in an operational situation.
#[derive(Debug, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Event {
    /// Id, `HZ-nnx`.
    pub id: String,
    /// Operational situation.
    pub situation: String,
    /// Severity, 0 to 3.
    pub s: u8,
    /// Why.
    pub s_reason: String,
    /// Exposure, 0 to 4.
    pub e: u8,
    /// Why.
    pub e_reason: String,
    /// Controllability, 0 to 3.
    pub c: u8,
    /// Why.
    pub c_reason: String,
    /// The assumed level; [`check`](super::check) compares it with [`Asil::from_rating`].
    pub asil: Asil,
}

/// To what rigour a goal is worked on.
#[derive(Clone, Copy, Debug, Deserialize, Serialize, PartialEq, Eq)]
#[serde(rename_all = "kebab-case")]
pub enum Claim {
    /// As if it were assumed ASIL D.
    AsilDOriented,
    /// To its assumed level.
    AsAssumed,
    /// No higher than its sensors: QM to B.
    SensorLimited,
}

/// A safety goal.
#[derive(Debug, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Goal {
    /// Id, `SG-nn`.
    pub id: String,
    /// Hazardous events that it covers.
    pub events: Vec<String>,
    /// The goal in one sentence.
    pub text: String,
    /// The state that the bus is brought to.
    pub safe_state: String,
    /// Fault-tolerant time interval.
    pub ftti_ms: u32,
    /// The moment from which it counts.
    pub ftti_from: String,
    /// Why it may be that long.
    pub ftti_reason: String,
    /// The greatest assumed level of its events.
    pub asil: Asil,
    /// To what rigour it is worked on.
    pub claim: Claim,
}

/// A verification method.
#[derive(Clone, Copy, Debug, Deserialize, Serialize, PartialEq, Eq, PartialOrd, Ord)]
#[serde(rename_all = "lowercase")]
pub enum Method {
    /// Machine-checked proof.
    Proof,
    /// Test.
    Test,
    /// Statistical or exhaustive campaign.
    Campaign,
    /// Analysis of design or object code.
    Analysis,
    /// Review by a person.
    Review,
}

/// One requirement: one demand.
#[derive(Debug, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Requirement {
    /// Id, `AREA-nx`.
    pub id: String,
    /// The demand in one sentence.
    pub text: String,
    /// Where it comes from: S1 to S4 with section, "own", or both.
    #[serde(default)]
    pub source: String,
    /// The passage of the source, verbatim, `…` where something is left out.
    pub passage: Option<String>,
    /// The safety goals that it serves.
    #[serde(default)]
    pub goal: Vec<String>,
    /// How it is verified.
    #[serde(default)]
    pub method: Vec<Method>,
    /// Its own share of the FTTI of its goals, 0 where there is no timing.
    #[serde(default)]
    pub ftti_share_ms: u32,
    /// The work package that implements it.
    pub package: u8,
    /// The readings that decide it.
    #[serde(default)]
    pub readings: Vec<String>,
    /// Why, for own numbers and decided readings.
    pub reason: Option<String>,
    /// Why no single item of code implements it, where that is so (`supervise trace`).
    pub without_code: Option<String>,
}

/// An assumption of use.
#[derive(Debug, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Assumption {
    /// Id, `AOU-nn`.
    pub id: String,
    /// What it is about.
    pub topic: String,
    /// What is assumed.
    pub text: String,
    /// Where it comes from.
    pub source: String,
    /// The requirements that rest on it.
    pub requirements: Vec<String>,
    /// The own numbers that it covers.
    #[serde(default)]
    pub values: Vec<String>,
    /// How the integrator verifies it.
    #[serde(default)]
    pub verify: String,
    /// What follows when it does not hold.
    #[serde(default)]
    pub violated: String,
}

/// The place of a timer relative to the FTTI.
#[derive(Clone, Copy, Debug, Deserialize, Serialize, PartialEq, Eq)]
#[serde(rename_all = "lowercase")]
pub enum Role {
    /// Between hazard and safe state: stands in a chain.
    Chain,
    /// Belongs to the definition of the hazard.
    Definition,
    /// The bus is in the safe state of the goal meanwhile.
    Covered,
    /// Delays only the end of a safe reaction.
    Release,
    /// Delays only a permission.
    Permission,
    /// Delays only a report.
    Report,
}

/// A time-out, debounce, timer or response time.
#[derive(Debug, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Timer {
    /// Id, `TM-nn`.
    pub id: String,
    /// Short name.
    pub name: String,
    /// Its value.
    pub value_ms: u32,
    /// Its name in the core's table of limits, where it stands there.
    pub config: Option<String>,
    /// The assumption that carries it, where no requirement of ours sets it.
    pub assumed: Option<String>,
    /// Its place.
    pub role: Role,
    /// The requirements that it belongs to.
    pub requirements: Vec<String>,
    /// Why the place and the value are right.
    pub reason: String,
}

/// A phase of the reaction to a fault, in order.
#[derive(Clone, Copy, Debug, Deserialize, Serialize, PartialEq, Eq, PartialOrd, Ord)]
#[serde(rename_all = "lowercase")]
pub enum Phase {
    /// Until the fault is seen.
    Detection,
    /// Until the reaction is decided.
    Decision,
    /// Until the reaction has its effect.
    Actuation,
}

/// One step of a chain.
#[derive(Debug, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Step {
    /// Its phase.
    pub phase: Phase,
    /// The timer whose value it takes.
    pub timer: String,
}

/// The times from a fault to the safe state of a goal.
#[derive(Debug, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Chain {
    /// Id, `CH-nnx`.
    pub id: String,
    /// The goal in whose FTTI it fits.
    pub goal: String,
    /// The fault.
    pub fault: String,
    /// Detection, decision, actuation.
    pub steps: Vec<Step>,
    /// What has to be known about it.
    pub note: Option<String>,
    /// For a second line against a second fault: the time it is held against instead of the FTTI.
    pub budget_ms: Option<u32>,
    /// Why that budget.
    pub budget_reason: Option<String>,
}

/// The file `timing.toml`.
#[derive(Debug, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Timing {
    /// All timers.
    pub timer: Vec<Timer>,
    /// All chains.
    pub chain: Vec<Chain>,
}

/// Who has decided a reading.
#[derive(Clone, Copy, Debug, Deserialize, Serialize, PartialEq, Eq)]
#[serde(rename_all = "lowercase")]
pub enum Status {
    /// Decided in the specification.
    Decided,
    /// Proposed while the requirements were split.
    Proposed,
}

/// A passage that can be read in more than one way.
#[derive(Debug, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Reading {
    /// Id, `R-x`.
    pub id: String,
    /// Decided or proposed.
    pub status: Status,
    /// The passage.
    pub passage: String,
    /// What is unclear.
    pub question: String,
    /// The ways to read it.
    pub alternatives: Vec<String>,
    /// The way taken.
    pub decision: String,
    /// Why.
    pub reason: String,
    /// The requirements that follow it.
    pub requirements: Vec<String>,
}

/// The whole safety analysis.
#[derive(Debug, Serialize)]
pub struct Analysis {
    /// Item, boundary, interfaces, operating modes.
    pub item: ItemFile,
    /// Hazards with their events.
    pub hazards: Vec<Hazard>,
    /// Safety goals.
    pub goals: Vec<Goal>,
    /// Requirements, file by file in the order of their names.
    pub requirements: Vec<Requirement>,
    /// Assumptions of use.
    pub assumptions: Vec<Assumption>,
    /// Timers and chains.
    pub timing: Timing,
    /// Readings.
    pub readings: Vec<Reading>,
    /// Failure modes of the supervisor's parts.
    pub failures: Vec<Failure>,
    /// Tools.
    pub tools: Vec<Tool>,
    /// Methods.
    pub methods: Vec<MethodTable>,
    /// Limitations and anomalies.
    pub limitations: Vec<Limitation>,
    /// Risks that are left.
    pub risks: Vec<Risk>,
    /// The ids of the faults to inject.
    pub faults: BTreeSet<String>,
    /// Name and text of each file, comments included, for the words.
    #[serde(skip)]
    pub texts: Vec<(String, String)>,
}
