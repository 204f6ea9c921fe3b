//! Which configurations are accepted (SELF-4).

use supervisor_core::{Config, Sealed};

use crate::properties::configuration::self_4_sealed_exactly;

/// SELF-4b, SELF-4c, SELF-4d: any configuration is sealed exactly when every value is in its range and no relation is broken.
#[kani::proof]
#[kani::unwind(220)]
fn self_4_only_valid_is_sealed() {
    let config: Config = kani::any();
    assert!(self_4_sealed_exactly(&config));
    let sealed = Sealed::new(config).is_ok();
    kani::cover!(
        sealed && config.cycle_greatest != Config::DEFAULT.cycle_greatest,
        "another configuration is accepted"
    );
    kani::cover!(!sealed, "one is refused");
}
