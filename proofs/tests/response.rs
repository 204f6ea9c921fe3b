//! The monitors' properties on random cycles: any state, inputs, outputs and configuration (RSP-1, TRQ-7, SELF-10).

use arbitrary::{Arbitrary, Result, Unstructured};
use proptest::collection::vec;
use proptest::prelude::{ProptestConfig, any, proptest};
use supervisor_core::{
    AngleDeciDeg, Channels, Config, DecelMs2Q11, Evidence, Follow, Inputs, Monitors, Outputs, SteeredAngle, Ticks,
    Timer,
};
use supervisor_proofs::properties::follow::{
    Pursuit, Turn, rsp_1_follow, rsp_1_follow_fails, rsp_1_steered, rsp_1_steered_fails,
};
use supervisor_proofs::properties::response::{ALL, Watch};

/// More bytes than any of the values takes.
const BYTES: usize = 4_096;

/// The names of the properties that do not hold.
fn broken(bytes: &[u8]) -> Result<Vec<&'static str>> {
    let mut source = Unstructured::new(bytes);
    let mut old = Monitors::arbitrary(&mut source)?;
    let (mut inputs, outputs) = (Inputs::arbitrary(&mut source)?, Outputs::arbitrary(&mut source)?);
    let (ticks, total) = (Ticks::arbitrary(&mut source)?, DecelMs2Q11::arbitrary(&mut source)?);
    let emergency = bool::arbitrary(&mut source)?;
    let config = if bool::arbitrary(&mut source)? { Config::DEFAULT } else { Config::arbitrary(&mut source)? };
    if bool::arbitrary(&mut source)? {
        // Feedback seldom equals what was asked for, or what it was, by chance.
        old.gearbox.asked = inputs.gear.known();
        old.epb.asked = None;
        old.k4.seen = inputs.k4.known();
        old.weight = supervisor_core::Percent::FULL;
    }
    if bool::arbitrary(&mut source)? {
        // A foreign message alone is a bypass: nothing else would be seen of one.
        inputs.foreign = Channels::NONE;
        inputs.second_sender = false;
        old.loose = false;
        old.steers = Timer::STOPPED;
    }
    let (new, response) = old.advance(&Evidence::gather(&inputs, &config), &inputs, ticks, &config);
    let next = new.record(&outputs, total, emergency);
    let watch = Watch {
        old: &old,
        inputs: &inputs,
        ticks,
        config: &config,
        new: &new,
        response: &response,
        outputs: &outputs,
        total,
        emergency,
        next: &next,
    };
    Ok(ALL.iter().filter(|(_, holds)| !holds(&watch)).map(|(name, _)| *name).collect())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 20_000, failure_persistence: None, ..ProptestConfig::default() })]

    /// RSP-1, TRQ-7a, SELF-10a, VLC-2f: every property of the monitors.
    #[test]
    fn every_property_of_the_monitors_holds(bytes in vec(any::<u8>(), BYTES)) {
        assert_eq!(broken(&bytes), Ok(vec![]));
    }

    /// RSP-1a, RSP-1b: one actuator against a target, also near it.
    #[test]
    fn an_actuator_is_followed(
        bytes in vec(any::<u8>(), 64), target in 0_u16..400, measured in 0_u16..400, unknown in 0_u8..8, error in 0_u8..110,
    ) {
        let mut source = Unstructured::new(&bytes);
        let old = Follow::arbitrary(&mut source);
        assert!(old.is_ok());
        let old = old.unwrap_or(Follow::INITIAL);
        let old = Follow { reference: old.reference % 400, start: old.start % 400, ..old };
        let elapsed = supervisor_core::Millis::new(u32::from(error));
        let pursuit = Pursuit { old, target, measured: (unknown != 0).then_some(measured), error, elapsed };
        let new = old.advance(target, pursuit.measured, error, elapsed);
        assert!(rsp_1_follow(pursuit, &new), "{pursuit:?} gave {new:?}");
        assert!(rsp_1_follow_fails(&new, elapsed, config_time()));
    }

    /// RSP-1e, RSP-1f: the wheel against an angle, also near it.
    #[test]
    fn the_wheel_is_followed(
        bytes in vec(any::<u8>(), 64), target in -60_i16..60, measured in -60_i16..60, unknown in 0_u8..8, band in 0_u16..40,
    ) {
        let mut source = Unstructured::new(&bytes);
        let old = SteeredAngle::arbitrary(&mut source);
        assert!(old.is_ok());
        let old = old.unwrap_or(SteeredAngle::INITIAL);
        let near = |angle: AngleDeciDeg| AngleDeciDeg::new(angle.raw() % 60);
        let old = SteeredAngle { start: near(old.start), target: near(old.target), ..old };
        let (target, elapsed) = (AngleDeciDeg::new(target), supervisor_core::Millis::new(10));
        let measured = (unknown != 0).then_some(AngleDeciDeg::new(measured));
        let turn = Turn { old, target, measured, band, elapsed };
        let new = old.advance(target, measured, band, elapsed);
        assert!(rsp_1_steered(turn, &new), "{turn:?} gave {new:?}");
        assert!(rsp_1_steered_fails(&new, elapsed, config_time()));
    }
}

fn config_time() -> supervisor_core::Millis {
    Config::DEFAULT.response_drive
}

/// Every property of the monitors is listed in `ALL`.
#[test]
fn every_property_of_the_monitors_is_listed() {
    let lines = include_str!("../src/properties/response.rs").lines();
    let stated =
        lines.filter(|line| line.starts_with("pub fn") && line.contains("(watch: &Watch<'_>) -> bool")).count();
    assert!(stated > 10);
    assert_eq!(stated, ALL.len());
}
