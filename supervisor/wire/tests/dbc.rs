//! `ebus.dbc` and the code say the same: frames written by the code are read by the DBC's positions, factors and
//! labels, and give the values that went in.

#![expect(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on has failed")]

mod common;

use std::collections::BTreeSet;
use std::fmt::Debug;

use can_dbc::{AttributeValue, ByteOrder, Dbc, MessageId, ValueType};
use common::*;
use proptest::prelude::*;
use supervisor_core::{Inputs, Millis, Outputs, Signal, Status, Word};
use supervisor_perceive::{CameraObject, RadarObject, Scene};
use supervisor_wire::{Frame, Message, Protection, Sender, Source};

fn dbc() -> Dbc {
    Dbc::try_from(include_str!("../ebus.dbc")).unwrap()
}

/// What the DBC says of one frame's signal.
#[derive(Debug)]
struct Read {
    physical: f64,
    label: Option<String>,
    /// Raw value and the greatest one.
    raw: u64,
    greatest: u64,
}

fn read(dbc: &Dbc, frame: &Frame, name: &str) -> Read {
    let id = MessageId::Extended(frame.id);
    let signal = dbc.signal_by_name(id, name).unwrap_or_else(|| panic!("{name}"));
    assert_eq!(signal.byte_order, ByteOrder::LittleEndian);
    let width = u32::try_from(signal.size).unwrap();
    let raw = bits(frame.payload(), u32::try_from(signal.start_bit).unwrap(), width);
    let signed = signal.value_type == ValueType::Signed;
    let number = i64::try_from(raw).unwrap() - if signed && raw >> (width - 1) == 1 { 1 << width } else { 0 };
    let labels = dbc.value_descriptions_for_signal(id, name).unwrap_or_default();
    let label = labels.iter().find(|label| label.id == number).map(|label| label.description.clone());
    let greatest = if signed { (1 << (width - 1)) - 1 } else { (1 << width) - 1 };
    let value = if signed { f64::from(i32::try_from(number).unwrap()) } else { f64::from(u32::try_from(raw).unwrap()) };
    Read { physical: value * signal.factor + signal.offset, label, raw, greatest }
}

/// What went in.
enum Value {
    Number(f64),
    Label(String),
    NotAvailable,
}

fn label(value: impl Debug) -> Value {
    Value::Label(format!("{value:?}"))
}
fn number(raw: impl Into<f64>, per_bit: f64) -> Value {
    Value::Number(raw.into() * per_bit)
}
fn truth(value: bool, yes: &str, no: &str) -> Value {
    Value::Label(if value { yes } else { no }.to_owned())
}
fn signal<T>(signal: Signal<T>, value: impl FnOnce(T) -> Value) -> Value {
    match signal {
        Signal::Known(known) => value(known),
        Signal::Unknown(_) => Value::NotAvailable,
    }
}

/// Every signal of every message of the table, with its unit; said here a second time, by hand.
#[expect(clippy::too_many_lines, reason = "a table")]
fn expected(
    message: Message,
    inputs: &Inputs,
    outputs: &Outputs,
    radar: &RadarObject,
    camera: &CameraObject,
    (stamp, status): (Millis, &Status),
) -> Vec<(&'static str, Value)> {
    const Q8: f64 = 1.0 / 256.0;
    const Q10: f64 = 1.0 / 1024.0;
    const Q11: f64 = 1.0 / 2048.0;
    let onoff = |value| truth(value, "On", "Off");
    let yes = |value| signal(value, |value| truth(value, "Yes", "No"));
    let switch = |value| signal(value, |value| truth(value, "On", "Off"));
    let list = |count: u8| [("Cycle", number(0, 1.0)), ("Index", number(0, 1.0)), ("Length", number(count, 1.0))];
    let (i, o) = (inputs, outputs);
    match message {
        Message::Ccvs1 => vec![("WheelBasedVehicleSpeed", signal(i.wheel_speed, |v| number(v.raw(), Q8)))],
        Message::Ebc1 => vec![
            ("ASRBrakeControlActive", switch(i.asr)),
            ("ABSActive", switch(i.abs)),
            ("EBSRedWarning", switch(i.ebs_red)),
            ("ABSEBSAmberWarning", switch(i.ebs_amber)),
        ],
        Message::GearStatus => {
            vec![("SelectedGear", signal(i.selector, label)), ("CurrentGear", signal(i.gear, label))]
        }
        Message::Seat1 => vec![("SeatSensor1", signal(i.seat[0], label))],
        Message::Seat2 => vec![("SeatSensor2", signal(i.seat[1], label))],
        Message::Accelerator => vec![
            ("AccelPedalPosition1", signal(i.accelerator[0], |v| number(v.raw(), 0.4))),
            ("AccelPedalPosition2", signal(i.accelerator[1], |v| number(v.raw(), 0.4))),
        ],
        Message::BrakePedal1 => vec![
            ("EBSBrakeSwitch", yes(i.brake_switch)),
            ("BrakePedalPosition1", signal(i.brake_pedal[0], |v| number(v.raw(), 0.4))),
        ],
        Message::BrakePedal2 => vec![("BrakePedalPosition2", signal(i.brake_pedal[1], |v| number(v.raw(), 0.4)))],
        Message::DriveStatus => vec![
            ("DriveStopped", yes(i.drive_stopped)),
            ("MotorSpeed", signal(i.motor_speed, |v| number(v.raw(), Q8))),
            ("ExecutedTorque", signal(i.executed_torque, |v| number(v.raw(), 1.0))),
            ("DriveLimit", signal(i.drive_limit, |v| number(v.raw(), 1.0))),
            ("ElectricLimit", signal(i.electric_limit, |v| number(v.raw(), Q11))),
        ],
        Message::BrakeStatus => vec![
            ("XBRStatus", signal(i.xbr_status, label)),
            ("StabilityActive", yes(i.stability)),
            ("FrictionLimit", signal(i.friction_limit, |v| number(v.raw(), Q11))),
            ("MeasuredDeceleration", signal(i.deceleration, |v| number(v.raw(), Q11))),
            ("PressureFront", signal(i.axle_pressure[0], |v| number(v.raw(), 5.0))),
            ("PressureRear", signal(i.axle_pressure[1], |v| number(v.raw(), 5.0))),
        ],
        Message::SteeringStatus => vec![
            ("HandsOff", yes(i.hands_off)),
            ("SteeringWheelAngle", signal(i.steering_angle, |v| number(v.raw(), 0.1))),
            ("DriverTorque", signal(i.driver_torque, |v| number(v.raw(), Q10))),
            ("EPSState", signal(i.eps, label)),
        ],
        Message::ParkingBrakeStatus => vec![
            ("EPBState", signal(i.epb, label)),
            ("EPBSwitch", signal(i.epb_switch, label)),
            ("EPBMode", signal(i.epb_mode, label)),
        ],
        Message::DriverControls => vec![
            ("Key", signal(i.key, label)),
            ("CruiseSwitch", switch(i.cruise_switch)),
            ("DriverSet", yes(i.driver_set)),
        ],
        Message::HighVoltageStatus => vec![
            ("K1", signal(i.k1, label)),
            ("K4", signal(i.k4, label)),
            ("HVCurrent", signal(i.hv_current, |v| number(v.raw(), 0.1))),
            ("AuxiliariesStopped", yes(i.auxiliaries_stopped)),
        ],
        Message::AdsStatus => vec![("ADSState", signal(i.ads, label))],
        Message::RadarPosition => list(1)
            .into_iter()
            .chain([
                ("RadarDistance", number(radar.distance.raw(), 0.01)),
                ("RadarOffset", number(radar.offset.raw(), 0.01)),
            ])
            .collect(),
        Message::RadarMotion => list(1)
            .into_iter()
            .chain([
                ("RadarAge", number(radar.age.raw(), 1.0)),
                ("RadarUpdates", number(radar.updates.raw(), 1.0)),
                ("RadarClosing", number(radar.closing.raw(), 0.01)),
            ])
            .collect(),
        Message::CameraObject => list(1)
            .into_iter()
            .chain([
                ("CameraClass", label(camera.class)),
                ("CameraDistance", number(camera.distance.raw(), 0.01)),
                ("CameraClosing", number(camera.closing.raw(), 0.01)),
            ])
            .collect(),
        Message::CameraCorner => list(1)
            .into_iter()
            .chain([
                ("CameraAge", number(camera.age.raw(), 1.0)),
                ("CameraLeft", number(camera.pixels.left, 1.0)),
                ("CameraTop", number(camera.pixels.top, 1.0)),
            ])
            .collect(),
        Message::CameraSize => list(1)
            .into_iter()
            .chain([
                ("CameraWidth", number(camera.pixels.width, 1.0)),
                ("CameraHeight", number(camera.pixels.height, 1.0)),
            ])
            .collect(),
        Message::DriveTorque => vec![
            ("OverrideControlMode", truth(o.drive.active, "TorqueControl", "Disabled")),
            ("RequestedTorque", number(o.drive.torque.raw(), 1.0)),
            ("ControlPurpose", Value::Label(format!("_{:?}", o.drive.origin))),
        ],
        Message::TargetSpeed => vec![("TargetSpeed", number(o.target_speed.raw(), Q8))],
        Message::ServiceBrake => vec![
            ("ExternalAccelerationDemand", number(o.brake.total.raw(), -Q11)),
            ("XBRPriority", label(o.brake.priority)),
            ("XBRControlMode", label(o.brake.mode)),
        ],
        Message::BrakeSplit => vec![("ElectricDeceleration", number(o.brake.electric.raw(), Q11))],
        Message::Retarder => vec![
            ("RetarderControlMode", truth(o.retarder.mode.code() == 2, "TorqueControl", "Disabled")),
            ("RetarderPriority", label(o.retarder.priority)),
            ("RetarderTorque", number(o.retarder.torque.raw(), -1.0)),
        ],
        Message::Gear => vec![("GearRequest", label(o.gear))],
        Message::ParkingBrake => vec![("EPBRequest", label(o.epb.request)), ("EPBRequestMode", label(o.epb.mode))],
        Message::SteeringAngle => vec![
            ("SteeringEnable", onoff(o.steering.enable)),
            ("TargetAngle", number(o.steering.angle.raw(), 0.1)),
            ("TargetRate", number(o.steering.rate.raw(), 0.1)),
        ],
        Message::SteeringTorque => vec![
            ("OverlayTorque", number(o.steering.overlay.raw(), Q10)),
            ("AngleWeight", number(o.steering.weight.raw(), 1.0)),
            ("BarTorqueLimit", number(o.steering.bar_limit.raw(), 0.05)),
        ],
        Message::Contactors => vec![("K4Request", label(o.contactors.k4)), ("K1Request", label(o.contactors.k1))],
        Message::Auxiliaries => vec![
            ("AirPump", onoff(o.auxiliaries.air_pump)),
            ("PowerSteering", onoff(o.auxiliaries.power_steering)),
            ("DCDC", onoff(o.auxiliaries.dc_dc)),
        ],
        Message::Warnings => vec![
            ("ForwardCollision", onoff(o.warnings.forward_collision)),
            ("PedestrianCollision", onoff(o.warnings.pedestrian)),
            ("SeatLeave", onoff(o.warnings.seat_leave)),
            ("HazardFlashers", onoff(o.warnings.hazard_flashers)),
            ("FaultLamp", onoff(o.warnings.fault_lamp)),
            ("NoticeLamp", onoff(o.warnings.notice_lamp)),
            ("LaneDeparture", onoff(o.warnings.lane_departure)),
            ("SpeedLimit", onoff(o.warnings.speed_limit)),
            ("Headway", onoff(o.warnings.headway)),
        ],
        Message::Body => vec![
            ("Wipers", label(o.body.wipers)),
            ("BrakeLamps", onoff(o.body.brake_lamps)),
            ("IndicatorLeft", onoff(o.body.indicator_left)),
            ("IndicatorRight", onoff(o.body.indicator_right)),
            ("LowBeam", onoff(o.body.low_beam)),
            ("HighBeam", onoff(o.body.high_beam)),
            ("Horn", onoff(o.body.horn)),
        ],
        Message::Mode => vec![("DrivingMode", label(o.mode))],
        Message::ElectricBrake => {
            vec![("ElectricActual", signal(i.electric_actual, |v| number(v.raw(), Q11)))]
        }
        Message::VehicleMass => vec![("Mass", signal(i.mass, |v| number(v.raw(), 10.0)))],
        Message::SupervisorStatus => vec![
            ("SafeState", truth(status.safe_state, "Yes", "No")),
            ("ParkedByLeave", truth(status.parked_by_leave, "Yes", "No")),
            ("SeatOccupancy", label(status.occupancy)),
            ("ModeGranted", label(status.mode)),
            ("MitigationLevel", label(status.level)),
            ("ShutdownStage", label(status.stage)),
            ("PersistentRecord", label(status.record)),
            ("ExitReason", label(status.exit)),
            ("TimeStamp", number(stamp.raw(), 0.001)),
        ],
        Message::SupervisorFaults => vec![
            ("Faults", number(status.faults.to_word(), 1.0)),
            ("ParkedFor", number(status.parked_for.raw(), 0.001)),
        ],
    }
}

/// CMD-1d: every signal of every frame, read by the DBC, is the value that went in; no signal is left out.
#[test]
fn values() {
    let dbc = dbc();
    for seed in 1..200 {
        let mut random = Random::new(seed);
        let (inputs, outputs, radar, camera) = (random.inputs(), random.outputs(), random.radar(), random.camera());
        let mut scene = Scene::clear();
        scene.radar.push(radar).unwrap();
        scene.camera.push(camera).unwrap();
        let mut frames = Vec::new();
        let mut sender = Sender::new();
        sender.encode_inputs(ms(0), &inputs, &scene, &mut |frame| frames.push(frame));
        sender.encode_commands(ms(0), &fresh(&outputs), &mut |frame| frames.push(frame));
        Sender::new().encode_outputs(ms(0), &outputs, &mut |frame| frames.push(frame));
        let (stamp, status) = (ms(u32::try_from(seed * 20_000_000).unwrap()), random.status());
        sender.encode_status(stamp, &status, &mut |frame| frames.push(frame));
        assert_eq!(frames.len(), dbc.messages.len());
        for frame in frames {
            let message = Message::ALL
                .iter()
                .copied()
                .find(|message| [message.id(), message.id_from(Source::Supervisor)].contains(&frame.id))
                .unwrap();
            let expected = expected(message, &inputs, &outputs, &radar, &camera, (stamp, &status));
            let names = |names: &mut dyn Iterator<Item = &str>| names.map(str::to_owned).collect::<BTreeSet<_>>();
            assert_eq!(
                names(&mut expected.iter().map(|(name, _)| *name)),
                names(&mut message.signals().iter().map(|signal| signal.name))
            );
            for (name, value) in expected {
                let read = read(&dbc, &frame, name);
                match value {
                    Value::Number(number) => assert!((read.physical - number).abs() < 1e-4, "{name} {number} {read:?}"),
                    Value::Label(label) => {
                        let found = read.label.clone().unwrap_or_default();
                        assert!(
                            found == label || label.starts_with('_') && found.ends_with(&label),
                            "{name} {label} {read:?}"
                        );
                    }
                    Value::NotAvailable => {
                        assert_eq!(read.raw, read.greatest, "{name} {read:?}");
                        assert!(read.label.is_none_or(|label| label == "NotAvailable"));
                    }
                }
            }
        }
    }
}

/// CMD-1a: the DBC has exactly the messages and signals of the table, at the same places, with the same attributes.
#[test]
fn layout() {
    let dbc = dbc();
    let mut ids = BTreeSet::new();
    for message in Message::ALL {
        for source in [Source::MainController, Source::Supervisor] {
            let id = MessageId::Extended(message.id_from(source));
            let Some(found) = dbc.messages.iter().find(|found| found.id == id) else { panic!("{message:?}") };
            if !ids.insert(id.raw()) {
                continue;
            }
            let output = source == Source::Supervisor;
            assert_eq!(found.name, format!("{}{}", message.name(), if output { "_Out" } else { "" }));
            assert_eq!(found.size, 8);
            let sender = match (message.is_command(), output) {
                (false, _) => None,
                (true, false) => Some("MainController"),
                (true, true) => Some("Supervisor"),
            };
            assert!(sender.is_none() || found.transmitter.as_deref() == sender);
            for signal in message.signals() {
                let same = dbc.signal_by_name(id, signal.name).unwrap();
                assert_eq!((same.start_bit, same.size), (signal.start.into(), signal.width.into()), "{signal:?}");
            }
            let own: BTreeSet<_> = message.signals().iter().map(|signal| signal.name).collect();
            for signal in found.signals.iter().filter(|signal| !own.contains(signal.name.as_str())) {
                // Counter, check field, and fixed signals of J1939.
                let comment = dbc.signal_comment(id, &signal.name).unwrap();
                let protection = ["CRC", "Counter", "MessageCounter", "MessageChecksum"];
                assert!(protection.contains(&signal.name.as_str()) || comment.starts_with("Fixed: "), "{signal:?}");
            }
            let attribute = |name| match dbc.resolved_message_attribute(id, name) {
                Some(AttributeValue::Uint(value)) => i64::try_from(*value).ok(),
                Some(AttributeValue::Int(value)) => Some(*value),
                _ => None,
            };
            assert_eq!(attribute("VFrameFormat"), Some(3), "J1939PG");
            assert_eq!(attribute("GenMsgCycleTime"), Some(message.period().raw().into()));
            let (profile, data_id) = match message.protection() {
                Protection::Bare => (0, 0),
                Protection::Profile11 => (1, message.id_from(source) & 0xFFFF),
                Protection::Tsc1 => (2, 0),
                Protection::Xbr => (3, 0),
            };
            assert_eq!(attribute("E2EProfile"), Some(profile));
            assert_eq!(attribute("E2EDataID"), Some(data_id.into()));
        }
    }
    assert_eq!(ids.len(), dbc.messages.len());
}

proptest! {
    /// CMD-1b: the signals that the DBC calls fixed have that value in every frame.
    #[test]
    fn fixed_signals(seed in any::<u64>()) {
        let dbc = dbc();
        let outputs = Random::new(seed).outputs();
        let mut frames = Vec::new();
        Sender::new().encode_outputs(ms(0), &outputs, &mut |frame| frames.push(frame));
        for frame in frames {
            let id = MessageId::Extended(frame.id);
            let message = dbc.messages.iter().find(|message| message.id == id).unwrap();
            for signal in &message.signals {
                let comment = dbc.signal_comment(id, &signal.name).unwrap_or_default();
                if let Some(value) = comment.strip_prefix("Fixed: ") {
                    let raw = read(&dbc, &frame, &signal.name).raw;
                    let digits: String = value.chars().take_while(char::is_ascii_digit).collect();
                    let fixed = if digits.is_empty() { (1 << signal.size) - 1 } else { digits.parse().unwrap() };
                    prop_assert_eq!(raw, fixed, "{}", signal.name);
                }
            }
        }
    }
}
