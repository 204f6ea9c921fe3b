//! The configuration of the harnesses that multiply by configured numbers: the default one, or the one for which
//! `supervise prove --config` builds them (see `proofs/build.rs`).

use supervisor_core::{Config, Words};

include!(concat!(env!("OUT_DIR"), "/configured.rs"));

/// The configuration to prove for.
pub(super) fn configured() -> Config {
    let Some(words) = WORDS else { return Config::DEFAULT };
    let mut words = words.into_iter();
    let config = Config::read(&mut || words.next());
    // The build took the words from a sealed configuration: a proof must not end well where they are none.
    assert!(config.is_some());
    config.unwrap_or(Config::DEFAULT)
}

/// Any value of every limit that the assessment of an object reads; what it does not read is as configured.
pub(super) fn any_limits() -> Config {
    Config {
        level_ttc: kani::any(),
        forward_ttc: kani::any(),
        pedestrian_ttc: kani::any(),
        emergency_ttc: kani::any(),
        mitigable_ttc: kani::any(),
        level_decel: kani::any(),
        forward_offset: kani::any(),
        pedestrian_offset: kani::any(),
        corridor: kani::any(),
        gap_margin: kani::any(),
        consistent_updates: kani::any(),
        object_age: kani::any(),
        severe_decel: kani::any(),
        ..configured()
    }
}
