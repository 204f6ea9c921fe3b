//! The properties on random cycles: any state, inputs, threat and commands, not only reachable ones (SELF-1a, SELF-1b).
//!
//! What Kani proves for every cycle is here looked at in some ten thousand, on any machine and with every build; a
//! property that is stated wrongly is found here first.

use arbitrary::{Arbitrary, Unstructured};
use proptest::collection::vec;
use proptest::prelude::{ProptestConfig, any, proptest};
use supervisor_core::{Commands, Config, Inputs, Millis, State, Threat};
use supervisor_proofs::properties::{ALL, Witness};

/// More bytes than any of the values takes.
const BYTES: usize = 2_048;

fn witness(bytes: &[u8], config: &Config) -> Option<Witness> {
    let mut source = Unstructured::new(bytes);
    let old = State::arbitrary(&mut source).ok()?;
    let inputs = Inputs::arbitrary(&mut source).ok()?;
    let threat = Threat::arbitrary(&mut source).ok()?;
    let commands = Commands::arbitrary(&mut source).ok()?;
    // Half of the cycles in time, or nothing but clock faults would be seen.
    let elapsed = u32::arbitrary(&mut source).ok()?;
    let elapsed = if elapsed % 2 == 0 { elapsed } else { elapsed % 64 };
    let now = Millis::new(old.clock.last.raw().wrapping_add(elapsed));
    Some(Witness::of(old, now, &inputs, &threat, &commands, config))
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 20_000, failure_persistence: None, ..ProptestConfig::default() })]

    /// SELF-1a, SELF-2a: every property holds on random cycles under the default configuration.
    #[test]
    fn every_property_holds_on_random_cycles(bytes in vec(any::<u8>(), BYTES)) {
        let witness = witness(&bytes, &Config::DEFAULT);
        assert!(witness.is_some());
        assert_eq!(witness.and_then(|witness| witness.broken()), None);
    }

    /// SELF-4g: and under any configuration at all, valid or not.
    #[test]
    fn every_property_holds_under_any_configuration(bytes in vec(any::<u8>(), BYTES), values in vec(any::<u8>(), BYTES)) {
        let config = Config::arbitrary(&mut Unstructured::new(&values)).unwrap_or(Config::DEFAULT);
        let witness = witness(&bytes, &config);
        assert!(witness.is_some());
        assert_eq!(witness.and_then(|witness| witness.broken()), None);
    }
}

/// Every property function of the sources is listed in `ALL`: none is stated and then forgotten.
#[test]
fn every_property_is_listed() {
    let files = [
        include_str!("../src/properties/seat.rs"),
        include_str!("../src/properties/parking.rs"),
        include_str!("../src/properties/high_voltage.rs"),
        include_str!("../src/properties/gear.rs"),
        include_str!("../src/properties/mitigation.rs"),
        include_str!("../src/properties/leave.rs"),
        include_str!("../src/properties/brake.rs"),
        include_str!("../src/properties/cap.rs"),
        include_str!("../src/properties/split.rs"),
        include_str!("../src/properties/retarder.rs"),
        include_str!("../src/properties/warnings.rs"),
        include_str!("../src/properties/body.rs"),
        include_str!("../src/properties/drive.rs"),
        include_str!("../src/properties/mode.rs"),
        include_str!("../src/properties/steering.rs"),
        include_str!("../src/properties/supervisor.rs"),
        include_str!("../src/properties/clock.rs"),
        include_str!("../src/properties/auxiliaries.rs"),
        include_str!("../src/properties/rules.rs"),
    ];
    let stated = files.iter().flat_map(|file| file.lines());
    let stated =
        stated.filter(|line| line.starts_with("pub fn") && line.contains("(cycle: &Cycle<'_>) -> bool")).count();
    let listed: usize = ALL.iter().map(|list| list.len()).sum();
    assert!(stated > 20);
    assert_eq!(stated, listed);
}
