//! The configurations that the proofs of perception are made for.

use supervisor_core::Config;

/// The configured limits: those of the table. A proof that names them holds for them, and is to be made again for others.
pub(super) fn configured() -> Config {
    Config::DEFAULT
}

/// Any value of every limit that the assessment of an object compares with; times to collision, which it multiplies by, and what it
/// does not read are as configured.
pub(super) fn any_limits() -> Config {
    Config {
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
