//! Gear, target speed, retarder, electric brake (GEAR-1, SPD-1, RET-1, VLC-2 as far as it exists).

mod common;
use common::*;

const FAST: SpeedKmhQ8 = kmh(50);

// SPD, RET, VLC-2.

/// SPD-1a: up to 60 km/h in the automated mode, none without it.
#[test]
fn the_target_speed_stays_below_its_limit() {
    let mut bus = Bus::automated(FAST);
    for (speed, passes) in [(kmh(0), true), (kmh(60), true), (kmh_q8(15_361), false), (kmh_q8(u16::MAX), false)] {
        bus.commands.target_speed = Command::Fresh(speed);
        let decision = bus.step();
        assert_eq!(decision.verdicts.of(Channel::TargetSpeed).passed(), passes);
        assert_eq!(decision.outputs.target_speed, speed.min(kmh(60)));
        if !passes {
            assert_verdict(&decision, Channel::TargetSpeed, Kind::Limit, Reason::SpeedLimit);
        }
    }
    let mut bus = Bus::driving(FAST);
    bus.commands.target_speed = Command::Fresh(kmh(30));
    assert_verdict(&bus.step(), Channel::TargetSpeed, Kind::Limit, Reason::ModeNotGranted);
}

/// SPD-1b: while an obligation runs the target speed is none.
#[test]
fn while_an_obligation_runs_there_is_no_target_speed() {
    let mut bus = Bus::automated(FAST);
    bus.commands.target_speed = Command::Fresh(kmh(60));
    bus.ahead(object(4_399, 1_000));
    let decision = bus.step();
    assert_eq!(decision.outputs.target_speed, kmh(0));
    assert_verdict(&decision, Channel::TargetSpeed, Kind::Limit, Reason::Mitigation);
    let mut bus = Bus::leave(FAST);
    bus.commands.target_speed = Command::Fresh(kmh(60));
    assert_eq!(bus.step().outputs.target_speed, kmh(0));
}

/// SPD-1c: a falling target speed neither brakes nor fulfils an obligation.
#[test]
fn a_falling_target_speed_is_no_brake() {
    let mut bus = Bus::automated(FAST);
    bus.commands.target_speed = Command::Fresh(kmh(50));
    bus.run_for(100);
    bus.commands.target_speed = Command::Fresh(kmh(0));
    let decision = bus.step();
    assert_passed(&decision, Channel::TargetSpeed);
    assert_eq!(decision.outputs.brake.total, ms2(0));
    bus.ahead(object(2_000, 1_000));
    assert_eq!(bus.step().outputs.brake.total, ms2(500));
}

/// RET-1b: while ABS works the retarder is off.
#[test]
fn while_abs_works_the_retarder_is_off() {
    let request = Retarder { torque: percent(50), mode: RetarderMode::Torque, priority: Priority::High };
    let mut bus = Bus::driving(FAST);
    bus.commands.retarder = Command::Fresh(request);
    assert_passed(&bus.step(), Channel::Retarder);
    bus.inputs.abs = known(true);
    let decision = bus.step();
    assert_eq!(decision.outputs.retarder.torque, Percent::ZERO);
    assert_verdict(&decision, Channel::Retarder, Kind::Limit, Reason::AntiLock);
}

/// RET-1a, SELF-2a: the retarder does not stand in for an obliged service brake.
#[test]
fn the_retarder_does_not_lower_the_obliged_service_brake() {
    let mut bus = Bus::leave(FAST);
    bus.commands.retarder =
        Command::Fresh(Retarder { torque: percent(100), mode: RetarderMode::Torque, priority: Priority::High });
    bus.inputs.abs = known(true);
    assert_eq!(
        bus.step().outputs.brake.total,
        ms2(195),
        "with ABS at work the retarder is off and the total must stand"
    );
}

/// VLC-2b, VLC-2c, VLC-2d, VLC-2e: the electric part obeys its limit, the total does not fall with it.
#[test]
fn the_electric_part_obeys_its_limit_and_the_total_stays() {
    let limit = ms2(200);
    let changes: [(&str, Edit, DecelMs2Q11); 9] = [
        ("healthy", |_| {}, limit),
        ("limit 0", |bus| bus.inputs.electric_limit = known(ms2(0)), ms2(0)),
        ("limit unknown", |bus| bus.inputs.electric_limit = unknown(Cause::Stale), ms2(0)),
        ("ABS", |bus| bus.inputs.abs = known(true), ms2(0)),
        ("ASR", |bus| bus.inputs.asr = known(true), ms2(0)),
        ("ESC", |bus| bus.inputs.stability = known(true), ms2(0)),
        ("ABS unknown", |bus| bus.inputs.abs = unknown(Cause::Stale), ms2(0)),
        ("ASR unknown", |bus| bus.inputs.asr = unknown(Cause::Stale), ms2(0)),
        ("ESC unknown", |bus| bus.inputs.stability = unknown(Cause::Stale), ms2(0)),
    ];
    for (name, change, most) in changes {
        let mut bus = Bus::driving(FAST);
        change(&mut bus);
        for electric in [ms2(0), ms2(200), DecelMs2Q11::new(ms2(200).raw() + 1), ms2(300)] {
            bus.commands.brake = Command::Fresh(ServiceBrake { electric, ..braking(ms2(300)) });
            let decision = bus.step();
            assert_eq!(decision.outputs.brake.total, ms2(300), "{name}: VLC-2e");
            assert_eq!(decision.outputs.brake.electric, electric.min(most), "{name}");
            if electric > most {
                assert_verdict(&decision, Channel::ServiceBrake, Kind::Limit, Reason::ElectricLimit);
            }
        }
    }
}

// Gear.

fn with_gear(speed: SpeedKmhQ8, gear: Gear, selector: Gear) -> Bus {
    let mut bus = Bus::driving(speed);
    bus.inputs.gear = known(gear);
    bus.inputs.selector = known(selector);
    bus.step();
    bus
}

/// GEAR-1a: P at standstill only, by the higher speed.
#[test]
fn park_is_for_standstill_only() {
    for (low, high, passes) in
        [(kmh(0), STANDSTILL, true), (kmh(0), ROLLING, false), (ROLLING, ROLLING, false), (FAST, FAST, false)]
    {
        let mut bus = with_gear(kmh(0), Gear::Drive, Gear::Park);
        bus.speeds(low, high);
        bus.ask_gear(GearRequest::Park);
        let decision = bus.step();
        assert_eq!(decision.verdicts.of(Channel::Gear).passed(), passes, "{low:?} {high:?}");
        if !passes {
            assert_verdict(&decision, Channel::Gear, Kind::Block, Reason::NotStandstill);
            assert_eq!(decision.outputs.gear, GearRequest::Hold);
        }
    }
}

/// GEAR-1b: above standstill no change between D and R, directly or through neutral, however long that lasts.
#[test]
fn no_change_of_direction_above_standstill() {
    for (gear, other, request) in
        [(Gear::Drive, Gear::Reverse, GearRequest::Reverse), (Gear::Reverse, Gear::Drive, GearRequest::Drive)]
    {
        for (speed, passes) in [(kmh(0), true), (STANDSTILL, true), (ROLLING, false), (kmh(5), false)] {
            let mut bus = with_gear(speed, gear, other);
            bus.ask_gear(request);
            assert_eq!(bus.step().verdicts.of(Channel::Gear).passed(), passes, "{gear:?} {speed:?}");

            let mut bus = with_gear(speed, gear, Gear::Neutral);
            bus.inputs.gear = known(Gear::Neutral);
            bus.run_for(5_000);
            bus.inputs.selector = known(other);
            bus.ask_gear(request);
            assert_eq!(bus.step().verdicts.of(Channel::Gear).passed(), passes, "{gear:?} {speed:?} through N");
        }
    }
}

/// GEAR-1b, GEAR-1d: back into the same direction while rolling passes: from neutral too.
#[test]
fn the_same_direction_again_passes_while_rolling() {
    for (gear, request) in [(Gear::Drive, GearRequest::Drive), (Gear::Reverse, GearRequest::Reverse)] {
        let mut bus = with_gear(kmh(5), gear, gear);
        bus.inputs.gear = known(Gear::Neutral);
        bus.run_for(1_000);
        bus.ask_gear(request);
        assert_passed(&bus.step(), Channel::Gear);
    }
}

/// GEAR-1b: with an unknown gearbox between, the direction is not forgotten.
#[test]
fn an_unknown_gearbox_does_not_forget_the_direction() {
    let mut bus = with_gear(kmh(5), Gear::Drive, Gear::Drive);
    bus.inputs.gear = unknown(Cause::Stale);
    bus.run_for(1_000);
    bus.inputs.gear = known(Gear::Neutral);
    bus.inputs.selector = known(Gear::Reverse);
    bus.ask_gear(GearRequest::Reverse);
    assert_refused(&bus.step(), Channel::Gear);
}

/// GEAR-1c: with unknown speed the gear is held: nothing is engaged. Neutral, the safe direction, is not hindered (rule 3).
#[test]
fn with_unknown_speed_the_gear_is_held() {
    for (request, selector) in
        [(GearRequest::Drive, Gear::Drive), (GearRequest::Reverse, Gear::Reverse), (GearRequest::Park, Gear::Park)]
    {
        for gear in [Gear::Drive, Gear::Reverse, Gear::Neutral, Gear::Park] {
            let mut bus = with_gear(FAST, gear, selector);
            bus.speed_unknown();
            bus.ask_gear(request);
            let decision = bus.step();
            assert_eq!(decision.outputs.gear, GearRequest::Hold, "{gear:?} {request:?}");
            assert_refused(&decision, Channel::Gear);
        }
    }
    let mut bus = Bus::driving(FAST);
    bus.speed_unknown();
    assert_eq!(bus.run_for(1_000).outputs.gear, GearRequest::Hold, "and the supervisor asks for nothing");
}

/// GEAR-1d: D, R and P only as the driver's selector says; unknown says nothing.
#[test]
fn a_gear_needs_the_drivers_selector() {
    let mut selectors: Vec<Signal<Gear>> = Gear::ALL.iter().map(|gear| known(*gear)).collect();
    selectors.extend(CAUSES.iter().map(|cause| unknown(*cause)));
    for (request, gear) in
        [(GearRequest::Drive, Gear::Drive), (GearRequest::Reverse, Gear::Reverse), (GearRequest::Park, Gear::Park)]
    {
        for selector in &selectors {
            let mut bus = with_gear(kmh(0), Gear::Neutral, Gear::Neutral);
            bus.inputs.selector = *selector;
            bus.ask_gear(request);
            let decision = bus.step();
            assert_eq!(decision.outputs.gear == request, *selector == known(gear), "{request:?} {selector:?}");
            if *selector != known(gear) {
                assert_verdict(&decision, Channel::Gear, Kind::Block, Reason::Selector);
            }
        }
    }
}

/// RULE-3a: neutral, the safe direction, passes at every known speed.
#[test]
fn neutral_passes_at_every_known_speed() {
    for speed in [kmh(0), ROLLING, FAST] {
        for selector in Gear::ALL {
            let mut bus = with_gear(speed, Gear::Drive, *selector);
            bus.ask_gear(GearRequest::Neutral);
            assert_passed(&bus.step(), Channel::Gear);
        }
    }
}
