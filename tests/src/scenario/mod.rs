//! Scenarios as data: `tests/scenarios/*.toml` says who does what on which road, where that comes from, and what must come
//! of it.
//!
//! - [`load`]: from file to [`Scene`], errors with file and key; [`entry`]: the keys of a file;
//! - [`mod@run`]: a scene in the closed loop; [`happens`]: what can happen, by name; [`criteria`]: what must come of it.

pub mod criteria;
pub mod entry;
pub mod happens;
pub mod load;
pub mod run;

use std::path::{Path, PathBuf};

use crate::disturb::Amount;
use crate::driver::Act;
use crate::plant::Parameters;
use crate::traffic::Actor;
use criteria::Expected;

/// One scenario in one variant, ready to be driven.
#[derive(Clone, Debug)]
pub struct Scene {
    /// Name of the file without extension.
    pub name: String,
    /// Name of the variant; empty if there is one only.
    pub variant: String,
    /// One line for people.
    pub title: String,
    /// What happens.
    pub description: String,
    /// Where it comes from.
    pub source: String,
    /// The demands that it shows.
    pub requirements: Vec<String>,
    /// S1's published approach is drawn beside it.
    pub published: bool,
    /// Length in ms.
    pub length_ms: u32,
    /// The bus.
    pub parameters: Parameters,
    /// From this time on the road has this slope.
    pub slope: (u32, f64),
    /// What the driver does, in order of time.
    pub acts: Vec<(u32, Act)>,
    /// The others.
    pub actors: Vec<Actor>,
    /// What is disturbed.
    pub disturbed: Option<Amount>,
    /// What must come of it.
    pub expected: Expected,
}

impl Scene {
    /// Name and variant.
    #[must_use]
    pub fn full_name(&self) -> String {
        if self.variant.is_empty() { self.name.clone() } else { format!("{}/{}", self.name, self.variant) }
    }
}

/// The folder of the scenarios of this project.
#[must_use]
pub fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("scenarios")
}
