//! What an unknown input refuses: every input × every channel, directed and complete (CMD-4b, RULE-1).
//!
//! `unknown.rs` shows on random drives that the matrix of the code says what happens. Here the specification says, in
//! situations in which everything passes while everything is known, what no longer passes when one input is unknown, for
//! any cause; everything else still passes. `fields` does not compile when an input is missing from it.

mod common;
use Situation::{Automated, Braking, Closing, Driving, OpeningK1, Standing};
use common::*;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Situation {
    /// 50 km/h, the driver's pedal, gear D asked for again.
    Driving,
    /// 50 km/h, braking with an electric part, retarder.
    Braking,
    /// 10 km/h, ADAS torque, target speed, automatic steering.
    Automated,
    /// Parked, driver seated: release, gear D, auxiliaries off, K4 open.
    Standing,
    /// K4 open, loads stopped: K1 open.
    OpeningK1,
    /// After the driver's restart: K1 close.
    Closing,
}

const SITUATIONS: [Situation; 6] = [Driving, Braking, Automated, Standing, OpeningK1, Closing];

fn bus(situation: Situation) -> Bus {
    let mut bus = match situation {
        Driving => {
            let mut bus = Bus::driving(kmh(50));
            bus.accelerator(travel(40));
            bus.ask_torque(40);
            bus.ask_gear(GearRequest::Drive);
            bus
        }
        Braking => {
            let mut bus = Bus::driving(kmh(50));
            bus.commands.brake = Command::Fresh(ServiceBrake { electric: ms2(100), ..braking(ms2(200)) });
            bus.commands.retarder =
                Command::Fresh(Retarder { torque: percent(30), mode: RetarderMode::Torque, priority: Priority::Low });
            bus.commands.body = Command::Fresh(Body { brake_lamps: true, ..Body::NEUTRAL });
            bus
        }
        Automated => {
            let mut bus = Bus::steering(kmh(10));
            bus.ask_adas(10);
            bus.commands.target_speed = Command::Fresh(kmh(30));
            bus
        }
        Standing => {
            let mut bus = Bus::parked();
            bus.inputs.selector = known(Gear::Drive);
            bus.ask_epb(EpbRequest::Release);
            bus.ask_gear(GearRequest::Drive);
            bus.ask_contactors(ContactorRequest::Open, ContactorRequest::Hold);
            bus.commands.auxiliaries = Command::Fresh(Auxiliaries { air_pump: false, ..Auxiliaries::NEUTRAL });
            bus
        }
        OpeningK1 => {
            let mut bus = Bus::parked();
            bus.loads_stopped();
            bus.ask_contactors(ContactorRequest::Open, ContactorRequest::Hold);
            bus.step();
            bus.inputs.k4 = OPEN;
            bus.ask_contactors(ContactorRequest::Hold, ContactorRequest::Open);
            bus
        }
        Closing => {
            let inputs = Inputs { k1: OPEN, k4: OPEN, ..healthy() };
            let mut bus = Bus::boot(ResetCause::PowerOn, Some(Record::None), inputs);
            bus.run_for(2_000);
            bus.inputs.key = known(Key::Start);
            bus.step();
            bus.inputs.key = known(Key::On);
            bus.ask_contactors(ContactorRequest::Hold, ContactorRequest::Close);
            bus
        }
    };
    // Short enough for what stands still here though it was told to move.
    bus.run_for(500);
    bus
}

/// Everything that can be unknown, by name. What is seen on the bus is never unknown.
fn fields() -> Vec<&'static str> {
    let inputs = named::inputs(&Inputs::NEVER).into_iter().map(|(name, _)| name);
    inputs.filter(|name| !["foreign", "second_sender"].contains(name)).chain(["radar", "camera"]).collect()
}

/// Input, how it becomes unknown, and what then no longer passes.
struct Row(&'static str, fn(&mut Bus, Cause), &'static [(Situation, Channel)]);

/// What ends the automated mode: torque, target speed and mode.
const MODE_ENDS: &[(Situation, Channel)] =
    &[(Automated, Channel::DriveTorque), (Automated, Channel::TargetSpeed), (Automated, Channel::Mode)];
/// An unknown accelerator (TRQ-1b, MODE-1b).
const ACCELERATOR: &[(Situation, Channel)] = &[
    (Driving, Channel::DriveTorque),
    (Automated, Channel::DriveTorque),
    (Automated, Channel::TargetSpeed),
    (Automated, Channel::Mode),
];
/// An unknown brake pedal: no torque against it, no comfort braking (TRQ-1c, TRQ-3).
const PEDAL: &[(Situation, Channel)] = &[
    (Driving, Channel::DriveTorque),
    (Braking, Channel::ServiceBrake),
    (Braking, Channel::Retarder),
    (Automated, Channel::DriveTorque),
    (Automated, Channel::TargetSpeed),
    (Automated, Channel::Mode),
];
/// An unknown seat (SEAT-5a, SEAT-6c, SEAT-8a).
const SEAT: &[(Situation, Channel)] =
    &[(Standing, Channel::ParkingBrake), (Standing, Channel::Gear), (Closing, Channel::Contactors)];
/// An unknown speed (GEAR-1c, AUX-1, HV-1c, STR-2e, MODE-1b).
const SPEED: &[(Situation, Channel)] = &[
    (Driving, Channel::Gear),
    (Automated, Channel::DriveTorque),
    (Automated, Channel::TargetSpeed),
    (Automated, Channel::Mode),
    (Automated, Channel::Steering),
    (Standing, Channel::Gear),
    (Standing, Channel::Auxiliaries),
    (Standing, Channel::Contactors),
    (OpeningK1, Channel::Contactors),
];
/// Unknown loads (SEAT-7g, HV-1b).
const LOADS: &[(Situation, Channel)] = &[(OpeningK1, Channel::Contactors)];
/// Unknown slip control or electric limit (VLC-2b, VLC-2d).
const ELECTRIC: &[(Situation, Channel)] = &[(Braking, Channel::ServiceBrake)];
/// Unknown drive limit or gearbox (TRQ-5a, TRQ-6c).
const TORQUE: &[(Situation, Channel)] = &[(Driving, Channel::DriveTorque), (Automated, Channel::DriveTorque)];
/// An unknown sensor of automatic steering (STR-2).
const STEERING: &[(Situation, Channel)] = &[(Automated, Channel::Steering)];

#[rustfmt::skip]
fn table() -> Vec<Row> {
    vec![
        Row("seat", |bus, cause| bus.inputs.seat[0] = unknown(cause), SEAT),
        Row("seat", |bus, cause| bus.inputs.seat[1] = unknown(cause), SEAT),
        Row("wheel_speed", |bus, cause| bus.inputs.wheel_speed = unknown(cause), SPEED),
        Row("motor_speed", |bus, cause| bus.inputs.motor_speed = unknown(cause), SPEED),
        Row("accelerator", |bus, cause| bus.inputs.accelerator[0] = unknown(cause), ACCELERATOR),
        Row("accelerator", |bus, cause| bus.inputs.accelerator[1] = unknown(cause), ACCELERATOR),
        Row("brake_pedal", |bus, cause| bus.inputs.brake_pedal[0] = unknown(cause), PEDAL),
        Row("brake_pedal", |bus, cause| bus.inputs.brake_pedal[1] = unknown(cause), PEDAL),
        Row("brake_switch", |bus, cause| bus.inputs.brake_switch = unknown(cause), PEDAL),
        Row("steering_angle", |bus, cause| bus.inputs.steering_angle = unknown(cause), STEERING),
        Row("driver_torque", |bus, cause| bus.inputs.driver_torque = unknown(cause), STEERING),
        Row("selector", |bus, cause| bus.inputs.selector = unknown(cause), &[(Driving, Channel::Gear), (Standing, Channel::Gear)]),
        Row("gear", |bus, cause| bus.inputs.gear = unknown(cause), TORQUE),
        Row("epb", |bus, cause| bus.inputs.epb = unknown(cause), &[]),
        Row("epb_switch", |bus, cause| bus.inputs.epb_switch = unknown(cause), &[]),
        Row("epb_mode", |bus, cause| bus.inputs.epb_mode = unknown(cause), &[]),
        Row("key", |bus, cause| bus.inputs.key = unknown(cause), &[]),
        Row("cruise_switch", |bus, cause| bus.inputs.cruise_switch = unknown(cause), MODE_ENDS),
        Row("driver_set", |bus, cause| bus.inputs.driver_set = unknown(cause), &[]),
        Row("k1", |bus, cause| bus.inputs.k1 = unknown(cause), &[]),
        Row("k4", |bus, cause| bus.inputs.k4 = unknown(cause), &[(OpeningK1, Channel::Contactors), (Closing, Channel::Contactors)]),
        Row("hv_current", |bus, cause| bus.inputs.hv_current = unknown(cause), LOADS),
        Row("drive_stopped", |bus, cause| bus.inputs.drive_stopped = unknown(cause), LOADS),
        Row("auxiliaries_stopped", |bus, cause| bus.inputs.auxiliaries_stopped = unknown(cause), LOADS),
        Row("drive_limit", |bus, cause| bus.inputs.drive_limit = unknown(cause), TORQUE),
        Row("executed_torque", |bus, cause| bus.inputs.executed_torque = unknown(cause), &[(Standing, Channel::Contactors)]),
        Row("electric_limit", |bus, cause| bus.inputs.electric_limit = unknown(cause), ELECTRIC),
        Row("friction_limit", |bus, cause| bus.inputs.friction_limit = unknown(cause), &[]),
        Row("electric_actual", |bus, cause| bus.inputs.electric_actual = unknown(cause), ELECTRIC),
        Row("mass", |bus, cause| bus.inputs.mass = unknown(cause), ELECTRIC),
        Row("axle_pressure", |bus, cause| bus.inputs.axle_pressure[0] = unknown(cause), ELECTRIC),
        Row("axle_pressure", |bus, cause| bus.inputs.axle_pressure[1] = unknown(cause), ELECTRIC),
        Row("deceleration", |bus, cause| bus.inputs.deceleration = unknown(cause), &[]),
        Row("abs", |bus, cause| bus.inputs.abs = unknown(cause), ELECTRIC),
        Row("asr", |bus, cause| bus.inputs.asr = unknown(cause), ELECTRIC),
        Row("stability", |bus, cause| bus.inputs.stability = unknown(cause), ELECTRIC),
        Row("ebs_red", |bus, cause| bus.inputs.ebs_red = unknown(cause), &[]),
        Row("ebs_amber", |bus, cause| bus.inputs.ebs_amber = unknown(cause), &[]),
        Row("xbr_status", |bus, cause| bus.inputs.xbr_status = unknown(cause), &[]),
        Row("eps", |bus, cause| bus.inputs.eps = unknown(cause), STEERING),
        Row("hands_off", |bus, cause| bus.inputs.hands_off = unknown(cause), &[]),
        Row("ads", |bus, cause| bus.inputs.ads = unknown(cause), MODE_ENDS),
        Row("radar", |bus, _| bus.scene.radar_known = false, MODE_ENDS),
        Row("camera", |bus, _| bus.scene.camera_known = false, MODE_ENDS),
    ]
}

/// CMD-4a: every input has a row, and no row names an input that is not there.
#[test]
fn every_input_has_a_row() {
    let rows: Vec<&str> = table().iter().map(|Row(name, ..)| *name).collect();
    for field in fields() {
        assert!(rows.contains(&field), "{field}");
    }
    for row in rows {
        assert!(fields().contains(&row), "{row}");
    }
}

/// CMD-4b: in each situation everything passes while everything is known.
#[test]
fn in_each_situation_everything_passes_while_everything_is_known() {
    for situation in SITUATIONS {
        for (channel, verdict) in bus(situation).step().verdicts.iter() {
            assert!(verdict.passed(), "{situation:?} {channel:?} {verdict:?}");
        }
    }
}

/// CMD-4b, RULE-1b, RULE-1c: each cell behaves as the table says, for every cause, in the cycle in which it begins.
#[test]
fn every_cell_behaves_as_the_table_says() {
    let mut wrong = Vec::new();
    for situation in SITUATIONS {
        let start = bus(situation);
        for Row(name, lose, refused) in table() {
            for cause in CAUSES {
                let mut bus = start.clone();
                lose(&mut bus, *cause);
                let decision = bus.step();
                for (channel, verdict) in decision.verdicts.iter() {
                    // The fault lamp goes on with what is reported: that refuses nothing.
                    let expected = refused.contains(&(situation, channel));
                    if channel != Channel::Warnings && verdict.passed() == expected {
                        wrong.push(format!("{situation:?} {name} {cause:?} {channel:?}: {verdict:?}"));
                    }
                }
                // RULE-1b: no obligation from an unknown input.
                let Outputs { epb, brake, .. } = decision.outputs;
                assert_ne!(epb.request, EpbRequest::Apply, "{situation:?} {name}");
                assert!(situation == Braking || brake.total == ms2(0), "{situation:?} {name}");
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

/// CMD-4a: every group has its own row in the code: unknown loads restrict the contactors and touch nothing else, an unknown
/// switch of the parking brake ends nothing but what begins by it.
#[test]
fn each_group_has_its_own_row() {
    let only = |group, channel, cell| {
        for other in Channel::ALL {
            let expected = if *other == channel { cell } else { supervisor::Meaning::Unaffected };
            assert_eq!(supervisor::meaning(group, *other), expected, "{group:?} {other:?}");
        }
    };
    only(supervisor::Group::Loads, Channel::Contactors, supervisor::Meaning::Refused);
    only(supervisor::Group::ParkingSwitch, Channel::ParkingBrake, supervisor::Meaning::Persists);
}
