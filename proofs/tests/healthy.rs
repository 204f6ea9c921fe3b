//! The properties on cycles near the healthy one: a driver on the seat, nothing ahead, everything known, and a few fields
//! of inputs, state and commands that are any (SELF-11a). Wholly random cycles seldom come so far that something passes.

use arbitrary::{Arbitrary, Result, Unstructured};
use proptest::collection::vec;
use proptest::prelude::{ProptestConfig, any, proptest};
use supervisor_core::{
    AdsState, Command, Commands, Config, Contact, Count, DecelMs2Q11, Drive, DriveTorque, DrivingMode, EpbState,
    EpsState, Flow, Gear, GearRequest, Inputs, Key, Latches, Level, Mass10Kg, Millis, Mode, Monitors, Parking,
    Pedal250, Percent, Pressure5KPa, Seat, SeatState, Signal, SpeedKmhQ8, Stage, State, Steering, SteeringState,
    Threat, Timer, TorqueNmQ10,
};
use supervisor_proofs::properties::Witness;

/// More bytes than any of the values takes.
const BYTES: usize = 6_144;

type Source<'a> = Unstructured<'a>;

/// Whether something is as it should be, this time: seven times of eight.
fn sound(source: &mut Source<'_>) -> Result<bool> {
    Ok(source.int_in_range(0_u8..=7)? != 0)
}

fn mostly<T: for<'a> Arbitrary<'a>>(source: &mut Source<'_>, value: T) -> Result<T> {
    if sound(source)? { Ok(value) } else { T::arbitrary(source) }
}

fn known<T>(value: T) -> Signal<T> {
    Signal::Known(value)
}

fn inputs(source: &mut Source<'_>) -> Result<Inputs> {
    let speed = if sound(source)? { source.int_in_range(0..=20_000)? } else { source.int_in_range(0..=1_000)? };
    let pedal = source.int_in_range(0_u8..=250)?;
    let mut inputs = Inputs {
        seat: [known(Seat::Occupied); 2],
        wheel_speed: known(SpeedKmhQ8::new(speed)),
        motor_speed: known(SpeedKmhQ8::new(speed + source.int_in_range(0..=400)?)),
        accelerator: [known(Pedal250::new(pedal)); 2],
        brake_pedal: [known(Pedal250::ZERO); 2],
        brake_switch: known(false),
        steering_angle: known(supervisor_core::AngleDeciDeg::new(source.int_in_range(-300..=300)?)),
        driver_torque: known(TorqueNmQ10::ZERO),
        selector: known(Gear::Drive),
        gear: known(Gear::Drive),
        epb: known(EpbState::Released),
        key: known(Key::On),
        cruise_switch: known(true),
        driver_set: known(bool::arbitrary(source)?),
        k1: known(Contact::Closed),
        k4: known(Contact::Closed),
        drive_limit: known(Percent::new(source.int_in_range(50..=100)?)),
        executed_torque: known(Percent::ZERO),
        electric_limit: known(DecelMs2Q11::new(2_048)),
        friction_limit: known(DecelMs2Q11::new(20_480)),
        electric_actual: known(DecelMs2Q11::ZERO),
        mass: known(Mass10Kg::new(1_000)),
        axle_pressure: [known(Pressure5KPa::new(100)); 2],
        deceleration: known(DecelMs2Q11::ZERO),
        abs: known(false),
        asr: known(false),
        stability: known(false),
        ebs_red: known(false),
        ebs_amber: known(false),
        eps: known(EpsState::Active),
        ads: known(AdsState::Active),
        ..Inputs::NEVER
    };
    macro_rules! vary {
        ($($field:ident)+) => {
            $(if source.int_in_range(0_u8..=31)? == 0 { inputs.$field = Arbitrary::arbitrary(source)?; })+
        };
    }
    vary!(seat wheel_speed motor_speed accelerator brake_pedal brake_switch steering_angle driver_torque gear epb);
    vary!(cruise_switch driver_set drive_limit abs asr ads eps deceleration executed_torque selector);
    Ok(inputs)
}

fn old(source: &mut Source<'_>) -> Result<State> {
    let mut state = State::arbitrary(source)?;
    let long = Timer::STOPPED.run(Millis::ZERO).run(Millis::new(100_000));
    macro_rules! mostly_initial {
        ($($field:ident: $machine:ident),+) => { $(state.$field = mostly(source, $machine::INITIAL)?;)+ };
    }
    mostly_initial!(latches: Latches, monitors: Monitors, parking: Parking);
    state.seat = mostly(source, SeatState { occupied: long, ..SeatState::INITIAL })?;
    state.flow = mostly(source, Flow::RECORDED)?;
    state.high_voltage.stage = mostly(source, Stage::Up)?;
    state.mitigation = mostly(source, supervisor_core::Mitigation::INITIAL)?;
    state.brake.lost = mostly(source, Timer::STOPPED)?;
    state.brake.total = mostly(source, DecelMs2Q11::ZERO)?;
    state.clock.started = mostly(source, true)?;
    state.clock.faults = mostly(source, 0)?;
    state.drive = Drive {
        mode: mostly(source, Mode::Automated)?,
        torque: Percent::new(source.int_in_range(0..=110)?),
        automated: Percent::new(source.int_in_range(0..=110)?),
        release_needed: mostly(source, false)?,
        hill: mostly(source, Timer::STOPPED)?,
        ..state.drive
    };
    let weight = if sound(source)? { mostly(source, Percent::FULL)? } else { Percent::ZERO };
    state.steering = SteeringState {
        weight,
        angle: supervisor_core::AngleDeciDeg::new(source.int_in_range(-400..=400)?),
        takeover: mostly(source, Timer::STOPPED)?,
        barred: mostly(source, false)?,
        astray: mostly(source, false)?,
        ..state.steering
    };
    Ok(state)
}

fn commands(source: &mut Source<'_>) -> Result<Commands> {
    let mut commands = Commands::arbitrary(source)?;
    let drive = DriveTorque { torque: Percent::new(source.int_in_range(0..=100)?), ..Arbitrary::arbitrary(source)? };
    let drive = DriveTorque { active: mostly(source, true)?, ..drive };
    commands.drive = mostly(source, Command::Fresh(drive))?;
    commands.brake = mostly(source, Command::Fresh(supervisor_core::ServiceBrake::NEUTRAL))?;
    commands.retarder = mostly(source, Command::Fresh(supervisor_core::Retarder::NEUTRAL))?;
    commands.gear = mostly(source, Command::Fresh(GearRequest::Hold))?;
    commands.mode = mostly(source, Command::Fresh(DrivingMode::Automated))?;
    let steering = Steering {
        enable: true,
        angle: supervisor_core::AngleDeciDeg::new(source.int_in_range(-400..=400)?),
        rate: supervisor_core::RateDeciDegS::new(source.int_in_range(0..=200)?),
        overlay: TorqueNmQ10::new(source.int_in_range(-5_000..=5_000)?),
        weight: mostly(source, Percent::FULL)?,
        bar_limit: supervisor_core::BarTorque50mNm::new(source.int_in_range(0..=110)?),
    };
    commands.steering = mostly(source, Command::Fresh(steering))?;
    Ok(commands)
}

fn witness(bytes: &[u8], config: &Config) -> Result<Witness> {
    let mut source = Unstructured::new(bytes);
    let old = old(&mut source)?;
    let (inputs, commands) = (inputs(&mut source)?, commands(&mut source)?);
    let threat = mostly(&mut source, Threat { level: Level::None, ..Threat::CLEAR })?;
    let elapsed = mostly(&mut source, 10_u32)?;
    let now = Millis::new(old.clock.last.raw().wrapping_add(elapsed));
    Ok(Witness::of(old, now, &inputs, &threat, &commands, config))
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 20_000, failure_persistence: None, ..ProptestConfig::default() })]

    /// SELF-11a, SELF-11e, SELF-11k: every property holds near the healthy cycle, in both longitudinal modes.
    #[test]
    fn every_property_holds_near_the_healthy_cycle(bytes in vec(any::<u8>(), BYTES), by_epbi in any::<bool>()) {
        let config = Config { longitudinal_mode: Count::new(u8::from(by_epbi)), ..Config::DEFAULT };
        let witness = witness(&bytes, &config);
        assert!(witness.is_ok());
        assert_eq!(witness.ok().and_then(|witness| witness.broken()), None);
    }
}

/// The premise of the above: torque, automated mode and steering do pass near the healthy cycle.
#[test]
fn something_passes_near_the_healthy_cycle() {
    let mut passed = [0_u32; 4];
    let mut seed = 1_u64;
    for _ in 0..2_000 {
        let bytes: Vec<u8> = (0..BYTES)
            .map(|_| {
                seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
                seed.to_be_bytes()[0]
            })
            .collect();
        let Ok(witness) = witness(&bytes, &Config::DEFAULT) else { continue };
        let out = &witness.outputs;
        let passes = [
            out.drive.torque > Percent::ZERO,
            out.mode == DrivingMode::Automated,
            out.steering.enable,
            out.target_speed > SpeedKmhQ8::ZERO,
        ];
        for (count, passes) in passed.iter_mut().zip(passes) {
            *count += u32::from(passes);
        }
    }
    assert!(passed.iter().all(|count| *count > 50), "passed: {passed:?}");
}
