//! The bus on the desk: a closed loop of bus, driver, road and main controller around the real supervisor.
//!
//! - [`plant`]: the bus, a deterministic longitudinal model that obeys the supervisor's outputs;
//! - [`driver`], [`road`], [`bend`], [`sensing`]: what hands and feet do, what stands ahead, and what radar and camera see of it;
//! - [`traffic`]: others on the road who move; [`disturb`]: noise, and a bus that is busy; [`ordinary`]: a day of a city bus;
//! - [`scenario`]: scenarios as data, with what must come of them;
//! - [`controller`]: a correct main controller, written from the sources S1 to S3;
//! - [`misdeed`]: what a misbehaving one does, when, and what must come of it;
//! - [`mod@bench`]: the loop, cycle by cycle; [`drive`]: scenario in, record out; [`link`]: the CAN frames between, [`candump`]: as a log;
//! - [`judge`]: interventions, refused misdeeds, whether the bus stayed safe;
//! - [`s1`]: the published approach of S1 beside ours;
//! - [`inject`]: faults at random times in correct drives, and what comes of them;
//! - [`vectors`]: golden vectors, for a supervisor in another language;
//! - [`catalogue`], [`manifest`]: the drives that ship in `tests/drives`.

pub mod bench;
pub mod bend;
pub mod candump;
pub mod catalogue;
pub mod controller;
pub mod disturb;
pub mod drive;
pub mod driver;
pub mod inject;
pub mod judge;
pub mod link;
pub mod manifest;
pub mod misdeed;
pub mod number;
pub mod ordinary;
pub mod plant;
pub mod road;
pub mod s1;
pub mod scenario;
pub mod sensing;
pub mod traffic;
pub mod vectors;
