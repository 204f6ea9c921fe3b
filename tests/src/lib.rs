//! The bus on the desk: a closed loop of bus, driver, road and main controller around the real supervisor.
//!
//! - [`plant`]: the bus, a deterministic longitudinal model that obeys the supervisor's outputs;
//! - [`driver`], [`road`]: what hands and feet do, what stands ahead;
//! - [`controller`]: a correct main controller, written from the sources S1 to S3;
//! - [`misdeed`]: what a misbehaving one does, when, and what must come of it;
//! - [`mod@bench`]: the loop, cycle by cycle; [`drive`]: scenario in, record out; [`link`]: the CAN frames between, [`candump`]: as a log;
//! - [`judge`]: interventions, refused misdeeds, whether the bus stayed safe;
//! - [`s1`]: the published approach of S1 beside ours;
//! - [`inject`]: faults at random times in correct drives, and what comes of them;
//! - [`vectors`]: golden vectors, for a supervisor in another language;
//! - [`catalogue`], [`manifest`]: the drives that ship in `tests/drives`.

pub mod bench;
pub mod candump;
pub mod catalogue;
pub mod controller;
pub mod drive;
pub mod driver;
pub mod inject;
pub mod judge;
pub mod link;
pub mod manifest;
pub mod misdeed;
pub mod number;
pub mod plant;
pub mod road;
pub mod s1;
pub mod vectors;
