//! Closed world (spec §2): every field of every channel × every illegal class is refused, for a named requirement.
//!
//! Classes: above a limit, below an obligation, a wrong value for the state, contradicting fields; and for every
//! channel absent, rejected, held too long. [`fields`] does not compile when a channel gets a field that it does not
//! name, and a test fails when a field has no row.

mod common;
use common::*;

/// Why a value is illegal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Wrong {
    /// Above its limit.
    Above,
    /// Below what is obliged.
    Below,
    /// A value of its table that the state does not permit.
    ForState,
    /// Contradicts another field, or lies outside every range.
    OutOfRange,
}
use Wrong::{Above, Below, ForState, OutOfRange};

/// One illegal command: the requirement that refuses it, field, class, situation, command, expected reason.
struct Illegal {
    requirement: &'static str,
    field: &'static str,
    class: Wrong,
    bus: fn() -> Bus,
    command: fn(&mut Bus),
    reason: Reason,
}

const FAST: SpeedKmhQ8 = kmh(50);

/// Every field of every channel by name, from the types themselves: a new field breaks this function.
fn fields() -> Vec<String> {
    macro_rules! names {
        ($channel:literal, $value:expr, $type:ident { $($field:ident),+ }) => {{
            let $type { $($field: _),+ } = $value;
            [$(concat!($channel, ".", stringify!($field))),+].map(String::from).to_vec()
        }};
    }
    let Outputs {
        drive,
        target_speed: _,
        brake,
        retarder,
        gear: _,
        epb,
        steering,
        contactors,
        auxiliaries,
        warnings,
        body,
        mode: _,
    } = Outputs::NEUTRAL;
    let mut all: Vec<String> = ["target_speed", "gear", "mode"].map(String::from).to_vec();
    all.extend(names!("drive", drive, DriveTorque { torque, active, origin }));
    all.extend(names!("brake", brake, ServiceBrake { total, electric, mode, priority }));
    all.extend(names!("retarder", retarder, Retarder { torque, mode, priority }));
    all.extend(names!("epb", epb, ParkingBrake { request, mode }));
    all.extend(names!("steering", steering, Steering { enable, angle, rate, overlay, weight, bar_limit }));
    all.extend(names!("contactors", contactors, Contactors { k4, k1 }));
    all.extend(names!("auxiliaries", auxiliaries, Auxiliaries { air_pump, power_steering, dc_dc }));
    all.extend(names!(
        "warnings",
        warnings,
        Warnings {
            forward_collision,
            pedestrian,
            seat_leave,
            hazard_flashers,
            fault_lamp,
            notice_lamp,
            lane_departure,
            speed_limit,
            headway
        }
    ));
    all.extend(names!(
        "body",
        body,
        Body { wipers, brake_lamps, indicator_left, indicator_right, low_beam, high_beam, horn }
    ));
    all
}

/// Fields without an illegal value: every value of their type is legal in every state, and a value that is not in the
/// type cannot be expressed here (the wire rejects its frame: CMD-1c).
const FREE: [&str; 8] = [
    "retarder.mode",
    "retarder.priority",
    "warnings.lane_departure",
    "warnings.speed_limit",
    "warnings.headway",
    "body.low_beam",
    "body.high_beam",
    "body.horn",
];

fn drive(bus: &mut Bus, torque: u8, active: bool, origin: Origin) {
    bus.commands.drive = Command::Fresh(DriveTorque { torque: percent(torque), active, origin });
}

fn steering(bus: &mut Bus, steering: Steering) {
    bus.commands.steering = Command::Fresh(steering);
}

fn retarder(bus: &mut Bus, torque: u8) {
    bus.commands.retarder =
        Command::Fresh(Retarder { torque: percent(torque), mode: RetarderMode::Torque, priority: Priority::Low });
}

fn pressed() -> Bus {
    let mut bus = Bus::driving(FAST);
    bus.accelerator(travel(40));
    bus.ask_torque(45); // map and tolerance
    bus.run_for(1_000);
    bus
}

fn cruising() -> Bus {
    let mut bus = Bus::automated(FAST);
    bus.ask_adas(60);
    bus.run_for(1_000);
    bus
}

fn threatened(milliseconds: u16) -> Bus {
    let mut bus = Bus::driving(FAST);
    bus.ahead(object(milliseconds, 1_000));
    bus.step();
    bus
}

fn warned(class: Class) -> Bus {
    let mut bus = Bus::driving(FAST);
    bus.ahead_matched(object(3_900, 1_000), class);
    bus.step();
    bus
}

fn braking_until_now() -> Bus {
    let mut bus = Bus::driving(FAST);
    bus.ask_brake(ms2(200));
    bus.run_for(100);
    bus
}

fn restarting() -> Bus {
    let mut bus = Bus::down();
    bus.driver_returns();
    for key in [Key::Off, Key::Start] {
        bus.inputs.key = known(key);
        bus.step();
    }
    bus
}

/// The table.
#[rustfmt::skip]
fn table() -> Vec<Illegal> {
    let row = |requirement, field, class, bus, command, reason| Illegal { requirement, field, class, bus, command, reason };
    vec![
        // Drive torque.
        row("TRQ-1a", "drive.torque", Above, pressed, |bus| bus.ask_torque(46), Reason::PedalMap),
        row("TRQ-2e", "drive.torque", Above, cruising, |bus| bus.ask_adas(61), Reason::AccelerationBound),
        row("TRQ-5a", "drive.torque", Above, || { let mut bus = pressed(); bus.inputs.drive_limit = known(percent(20)); bus }, |bus| bus.ask_torque(21), Reason::DriveLimit),
        row("TRQ-5b", "drive.torque", Above, || { let mut bus = pressed(); bus.ask_torque(10); bus.step(); bus }, |bus| bus.ask_torque(13), Reason::TorqueRamp),
        row("CMD-1b", "drive.torque", OutOfRange, pressed, |bus| bus.ask_torque(255), Reason::PedalMap),
        row("VLC-1d", "drive.origin", ForState, cruising, |bus| drive(bus, 10, true, Origin::Epbi), Reason::NotConfigured),
        row("VLC-1d", "drive.origin", ForState, || Bus::automated_by_epbi(FAST), |bus| drive(bus, 10, true, Origin::Adas), Reason::NotConfigured),
        row("TRQ-5f", "drive.torque", Below, || Bus::automated_by_epbi(FAST), |bus| drive(bus, 5, true, Origin::Epbi), Reason::IdleTorque),
        row("SEAT-2a", "drive.torque", ForState, || Bus::leave(FAST), |bus| bus.ask_torque(1), Reason::Leave),
        row("MIT-5a", "drive.torque", ForState, || threatened(2_700), |bus| bus.ask_torque(1), Reason::Mitigation),
        row("TRQ-6a", "drive.torque", ForState, pressed, |bus| { bus.ask_torque(10); bus.ask_brake(ms2(10)); }, Reason::BrakeDemand),
        row("TRQ-2a", "drive.active", ForState, cruising, |bus| drive(bus, 10, false, Origin::Adas), Reason::NotActive),
        row("TRQ-2b", "drive.active", ForState, pressed, |bus| drive(bus, 0, true, Origin::Adas), Reason::ModeNotGranted),
        row("TRQ-2b", "drive.origin", ForState, pressed, |bus| drive(bus, 10, true, Origin::Adas), Reason::ModeNotGranted),
        row("TRQ-2b", "drive.origin", ForState, pressed, |bus| drive(bus, 10, true, Origin::Epbi), Reason::ModeNotGranted),
        // Target speed.
        row("SPD-1a", "target_speed", Above, cruising, |bus| bus.commands.target_speed = Command::Fresh(kmh_q8(15_361)), Reason::SpeedLimit),
        row("SPD-1a", "target_speed", ForState, pressed, |bus| bus.commands.target_speed = Command::Fresh(kmh_q8(1)), Reason::ModeNotGranted),
        row("SPD-1b", "target_speed", ForState, || Bus::leave(FAST), |bus| bus.commands.target_speed = Command::Fresh(kmh_q8(1)), Reason::Leave),
        // Service brake.
        row("PHB-1a", "brake.total", Above, pressed, |bus| bus.ask_brake(DecelMs2Q11::new(7_169)), Reason::PhantomBraking),
        row("PHB-1b", "brake.total", Above, || threatened(2_700), |bus| bus.ask_brake(DecelMs2Q11::new(12_289)), Reason::BrakeCap),
        row("CMD-1b", "brake.total", OutOfRange, pressed, |bus| bus.ask_brake(DecelMs2Q11::new(u16::MAX)), Reason::PhantomBraking),
        row("SEAT-3a", "brake.total", Below, || Bus::leave(FAST), |bus| bus.ask_brake(DecelMs2Q11::new(3_993)), Reason::Leave),
        row("MIT-3b", "brake.total", Below, || threatened(2_700), |bus| bus.ask_brake(DecelMs2Q11::new(10_239)), Reason::Mitigation),
        row("VLC-2c", "brake.electric", Above, pressed, |bus| bus.commands.brake = Command::Fresh(ServiceBrake { electric: DecelMs2Q11::new(4_097), ..braking(ms2(300)) }), Reason::ElectricLimit),
        row("CMD-1b", "brake.electric", OutOfRange, pressed, |bus| bus.commands.brake = Command::Fresh(ServiceBrake { electric: ms2(101), ..braking(ms2(100)) }), Reason::FieldRange),
        row("CMD-6a", "brake.mode", ForState, || Bus::leave(FAST), |bus| bus.commands.brake = Command::Fresh(ServiceBrake { mode: BrakeMode::Off, priority: Priority::Highest, ..braking(ms2(300)) }), Reason::BrakeMode),
        row("CMD-6a", "brake.mode", ForState, || Bus::leave(FAST), |bus| bus.commands.brake = Command::Fresh(ServiceBrake { mode: BrakeMode::Addition, priority: Priority::Highest, ..braking(ms2(300)) }), Reason::BrakeMode),
        row("CMD-6b", "brake.priority", Below, || Bus::leave(FAST), |bus| bus.ask_brake(ms2(300)), Reason::BrakeMode),
        // Retarder.
        row("RET-1a", "retarder.torque", Above, pressed, |bus| { bus.ask_brake(ms2(350)); retarder(bus, 1); }, Reason::PhantomBraking),
        row("CMD-1b", "retarder.torque", OutOfRange, pressed, |bus| retarder(bus, 101), Reason::BrakeCap),
        row("RET-1b", "retarder.torque", ForState, || { let mut bus = pressed(); bus.inputs.abs = known(true); bus }, |bus| retarder(bus, 1), Reason::AntiLock),
        // Gear.
        row("GEAR-1a", "gear", ForState, || { let mut bus = pressed(); bus.inputs.selector = known(Gear::Park); bus }, |bus| bus.ask_gear(GearRequest::Park), Reason::NotStandstill),
        row("GEAR-1b", "gear", ForState, || { let mut bus = pressed(); bus.inputs.selector = known(Gear::Reverse); bus }, |bus| bus.ask_gear(GearRequest::Reverse), Reason::NotStandstill),
        row("GEAR-1d", "gear", ForState, Bus::parked, |bus| bus.ask_gear(GearRequest::Drive), Reason::Selector),
        row("SEAT-6a", "gear", ForState, Bus::parked_by_leave, |bus| bus.ask_gear(GearRequest::Hold), Reason::NeutralObliged),
        row("SEAT-6c", "gear", ForState, || { let mut bus = Bus::parked(); bus.vacant(); bus.inputs.selector = known(Gear::Drive); bus }, |bus| bus.ask_gear(GearRequest::Drive), Reason::SeatNotOccupied),
        // Parking brake.
        row("SEAT-5a", "epb.request", ForState, || { let mut bus = Bus::parked(); bus.vacant(); bus }, |bus| bus.ask_epb(EpbRequest::Release), Reason::SeatNotOccupied),
        row("SEAT-5b", "epb.request", ForState, || { let mut bus = Bus::parked_by_leave(); bus.driver_returns(); bus }, |bus| bus.ask_epb(EpbRequest::Release), Reason::ParkedByLeave),
        row("EPB-1a", "epb.request", ForState, pressed, |bus| bus.ask_epb(EpbRequest::Apply), Reason::EpbSpeed),
        row("SEAT-4a", "epb.request", Below, || Bus::leave(kmh(1)), |bus| bus.ask_epb(EpbRequest::None), Reason::EpbApply),
        row("CMD-6a", "epb.mode", ForState, || Bus::leave(kmh(1)), |bus| bus.commands.epb = Command::Fresh(ParkingBrake { request: EpbRequest::Apply, mode: EpbMode::Manual }), Reason::EpbApply),
        // Steering.
        row("STR-2", "steering.enable", ForState, pressed, |bus| steering(bus, STEER), Reason::SteeringRefused),
        row("STR-2g", "steering.enable", ForState, || { let mut bus = Bus::automated(kmh(10)); bus.inputs.eps = known(EpsState::Derated); bus }, |bus| steering(bus, STEER), Reason::PowerSteering),
        row("STR-2e", "steering.enable", ForState, || { let mut bus = Bus::automated(kmh(10)); bus.speed(kmh(61)); bus }, |bus| steering(bus, STEER), Reason::SteeringSpeed),
        row("STR-1c", "steering.angle", Above, || Bus::steering(kmh(10)), |bus| steering(bus, Steering { angle: angle(41), ..STEER }), Reason::SteeringAngle),
        row("STR-1c", "steering.angle", Below, || Bus::steering(kmh(10)), |bus| steering(bus, Steering { angle: angle(-41), ..STEER }), Reason::SteeringAngle),
        row("STR-1a", "steering.angle", OutOfRange, || Bus::steering(kmh(10)), |bus| steering(bus, Steering { angle: angle(7_201), ..STEER }), Reason::SteeringAngle),
        row("STR-1a", "steering.angle", OutOfRange, || Bus::steering(kmh(10)), |bus| steering(bus, Steering { angle: angle(i16::MIN), ..STEER }), Reason::SteeringAngle),
        row("STR-1c", "steering.rate", Above, || Bus::steering(kmh(10)), |bus| steering(bus, Steering { rate: RateDeciDegS::new(4_001), ..STEER }), Reason::SteeringRate),
        row("STR-1e", "steering.overlay", Above, || Bus::steering(kmh(10)), |bus| steering(bus, Steering { overlay: hand_torque(5_121), ..STEER }), Reason::SteeringOverlay),
        row("STR-1e", "steering.overlay", Below, || Bus::steering(kmh(10)), |bus| steering(bus, Steering { overlay: hand_torque(i16::MIN), ..STEER }), Reason::SteeringOverlay),
        row("STR-2c", "steering.weight", Above, || Bus::automated(kmh(10)), |bus| steering(bus, STEER), Reason::SteeringWeight),
        row("STR-2d", "steering.weight", Below, || Bus::steering(kmh(10)), |bus| steering(bus, Steering { weight: percent(0), ..STEER }), Reason::SteeringWeight),
        row("CMD-1b", "steering.weight", OutOfRange, || Bus::steering(kmh(10)), |bus| steering(bus, Steering { weight: percent(101), ..STEER }), Reason::SteeringWeight),
        row("STR-1f", "steering.bar_limit", Above, || Bus::steering(kmh(10)), |bus| steering(bus, Steering { bar_limit: BarTorque50mNm::new(101), ..STEER }), Reason::BarTorque),
        // Contactors.
        row("HV-1c", "contactors.k4", ForState, pressed, |bus| bus.ask_contactors(ContactorRequest::Open, ContactorRequest::Hold), Reason::NotStandstill),
        row("SEAT-7d", "contactors.k4", ForState, || { let mut bus = Bus::parked(); bus.inputs.executed_torque = known(percent(5)); bus }, |bus| bus.ask_contactors(ContactorRequest::Open, ContactorRequest::Hold), Reason::LoadsNotStopped),
        row("HV-1d", "contactors.k4", ForState, || Bus::parked().reset(ResetCause::Other), |bus| bus.ask_contactors(ContactorRequest::Close, ContactorRequest::Hold), Reason::NoRestart),
        row("SEAT-8c", "contactors.k4", ForState, restarting, |bus| bus.ask_contactors(ContactorRequest::Close, ContactorRequest::Hold), Reason::K1NotClosed),
        row("SEAT-7a", "contactors.k4", Below, Bus::opening_k4, |bus| bus.ask_contactors(ContactorRequest::Hold, ContactorRequest::Hold), Reason::Shutdown),
        row("SEAT-7f", "contactors.k1", ForState, Bus::parked, |bus| bus.ask_contactors(ContactorRequest::Hold, ContactorRequest::Open), Reason::K4NotOpen),
        row("SEAT-7g", "contactors.k1", ForState, || { let mut bus = Bus::parked(); bus.inputs.k4 = known(Contact::Open); bus }, |bus| bus.ask_contactors(ContactorRequest::Hold, ContactorRequest::Open), Reason::LoadsNotStopped),
        row("HV-1c", "contactors.k1", ForState, pressed, |bus| bus.ask_contactors(ContactorRequest::Hold, ContactorRequest::Open), Reason::NotStandstill),
        row("SEAT-8a", "contactors.k1", ForState, Bus::down, |bus| bus.ask_contactors(ContactorRequest::Hold, ContactorRequest::Close), Reason::NoRestart),
        row("SEAT-7e", "contactors.k1", Below, || { let mut bus = Bus::opening_k1(); bus.loads_stopped(); bus.ask_contactors(ContactorRequest::Open, ContactorRequest::Hold); bus }, |_| {}, Reason::Shutdown),
        // Auxiliaries.
        row("AUX-1a", "auxiliaries.air_pump", Below, pressed, |bus| bus.commands.auxiliaries = Command::Fresh(Auxiliaries { air_pump: false, ..Auxiliaries::NEUTRAL }), Reason::NotStandstill),
        row("AUX-1b", "auxiliaries.power_steering", Below, pressed, |bus| bus.commands.auxiliaries = Command::Fresh(Auxiliaries { power_steering: false, ..Auxiliaries::NEUTRAL }), Reason::NotStandstill),
        row("AUX-1c", "auxiliaries.dc_dc", Below, pressed, |bus| bus.commands.auxiliaries = Command::Fresh(Auxiliaries { dc_dc: false, ..Auxiliaries::NEUTRAL }), Reason::NotStandstill),
        // Warnings: off while obliged.
        row("FCW-1a", "warnings.forward_collision", Below, || warned(Class::Object), |_| {}, Reason::WarningObliged),
        row("PCW-1a", "warnings.pedestrian", Below, || warned(Class::Pedestrian), |_| {}, Reason::WarningObliged),
        row("SEAT-1b", "warnings.seat_leave", Below, || Bus::leave(FAST), |bus| bus.commands.warnings = Command::Fresh(Warnings { hazard_flashers: true, ..Warnings::NEUTRAL }), Reason::WarningObliged),
        row("SEAT-1d", "warnings.hazard_flashers", Below, || Bus::leave(FAST), |bus| bus.commands.warnings = Command::Fresh(Warnings { seat_leave: true, ..Warnings::NEUTRAL }), Reason::WarningObliged),
        row("RPT-1a", "warnings.fault_lamp", Below, || { let mut bus = pressed(); bus.speed_unknown(); bus }, |_| {}, Reason::WarningObliged),
        row("STR-2b", "warnings.notice_lamp", Below, || { let mut bus = Bus::steering(kmh(10)); bus.inputs.driver_torque = known(hand_torque(7_000)); bus.run_for(400); bus }, |bus| bus.commands.warnings = Command::Fresh(Warnings { fault_lamp: true, ..Warnings::NEUTRAL }), Reason::WarningObliged),
        // Body.
        row("BODY-1a", "body.brake_lamps", Below, braking_until_now, |_| {}, Reason::BrakeLamps),
        row("BODY-1d", "body.indicator_left", ForState, || Bus::leave(FAST), |bus| bus.commands.body = Command::Fresh(Body { indicator_left: true, brake_lamps: true, ..Body::NEUTRAL }), Reason::HazardFlashers),
        row("BODY-1d", "body.indicator_right", ForState, || Bus::leave(FAST), |bus| bus.commands.body = Command::Fresh(Body { indicator_right: true, brake_lamps: true, ..Body::NEUTRAL }), Reason::HazardFlashers),
        // Mode.
        row("MODE-1a", "mode", ForState, pressed, |bus| bus.commands.mode = Command::Fresh(DrivingMode::Automated), Reason::ModeNotGranted),
    ]
}

fn channel_of(field: &str) -> Channel {
    match field.split('.').next() {
        Some("drive") => Channel::DriveTorque,
        Some("target_speed") => Channel::TargetSpeed,
        Some("brake") => Channel::ServiceBrake,
        Some("retarder") => Channel::Retarder,
        Some("gear") => Channel::Gear,
        Some("epb") => Channel::ParkingBrake,
        Some("steering") => Channel::Steering,
        Some("contactors") => Channel::Contactors,
        Some("auxiliaries") => Channel::Auxiliaries,
        Some("warnings") => Channel::Warnings,
        Some("body") => Channel::Body,
        Some("mode") => Channel::Mode,
        other => unreachable!("no channel {other:?}"),
    }
}

/// Whether a channel goes out with the value that asks for nothing.
fn is_neutral(channel: Channel, outputs: &Outputs) -> bool {
    let neutral = Outputs::NEUTRAL;
    match channel {
        Channel::DriveTorque => outputs.drive == neutral.drive,
        Channel::TargetSpeed => outputs.target_speed == neutral.target_speed,
        Channel::ServiceBrake => outputs.brake == neutral.brake,
        Channel::Retarder => outputs.retarder == neutral.retarder,
        Channel::Gear => outputs.gear == neutral.gear,
        Channel::ParkingBrake => outputs.epb == neutral.epb,
        Channel::Steering => outputs.steering == neutral.steering,
        Channel::Contactors => outputs.contactors == neutral.contactors,
        Channel::Auxiliaries => outputs.auxiliaries == neutral.auxiliaries,
        Channel::Warnings => outputs.warnings == neutral.warnings,
        Channel::Body => outputs.body == neutral.body,
        Channel::Mode => outputs.mode == neutral.mode,
    }
}

/// CMD-1b, CMD-1c, CMD-3b, CMD-5b, CMD-5c: each row is refused, with its reason, and names its requirement.
#[test]
fn every_illegal_command_is_refused_for_its_reason() {
    let mut wrong = Vec::new();
    for Illegal { requirement, field, class, bus, command, reason } in table() {
        let mut bus = bus();
        command(&mut bus);
        let decision = bus.step();
        Bus::assert_idempotent(&decision);
        let verdict = decision.verdicts.of(channel_of(field));
        // CMD-3b: what is blocked goes out neutral.
        if verdict.kind == Kind::Block && !is_neutral(channel_of(field), &decision.outputs) {
            wrong.push(format!("CMD-3b: {requirement} {field} {class:?} is blocked and not neutral: {verdict:?}"));
        }
        // CMD-5c: the offending value is not its own limit.
        if verdict.passed() || verdict.reason != reason || verdict.value == verdict.limit {
            wrong.push(format!("{requirement} {field} {class:?}, expected {reason:?}: {verdict:?}"));
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

/// CMD-1a, CMD-1b: every field of every channel has a row, or is free by name; no row names a field that is not there.
#[test]
fn every_field_has_a_row() {
    let rows: Vec<&str> = table().iter().map(|row| row.field).collect();
    let all = fields();
    for field in &all {
        let free = FREE.contains(&field.as_str()) || field == "body.wipers";
        assert!(rows.contains(&field.as_str()) != free, "{field}");
    }
    for row in rows {
        assert!(all.iter().any(|field| field == row), "{row}");
    }
    assert_eq!(Channel::ALL.len(), 12, "CMD-1a: the channels of spec §2");
}

/// Sets the command of a channel to neutral: absent (0), held for so long (1), or rejected.
type SetCommand = fn(&mut Bus, u8, u32);

/// CMD-2d, CMD-2e, E2E-2a to E2E-2c, E2E-2g to E2E-2j, BODY-1e: every channel refuses an absent, a rejected and a too old command, and passes the same one in time.
#[test]
fn every_channel_refuses_absent_rejected_and_too_old_commands() {
    // Time-out and how to set the channel's command to "neutral, with this wrapper".
    macro_rules! channel {
        ($channel:ident, $field:ident, $timeout:literal) => {
            (Channel::$channel, $timeout, |bus: &mut Bus, kind: u8, age: u32| {
                let value = Outputs::NEUTRAL.$field;
                bus.commands.$field = match kind {
                    0 => Command::Absent,
                    1 => Command::Held(Millis::new(age), value),
                    code => Command::Rejected(Rejection::from_code(code - 2).unwrap_or(Rejection::Form)),
                };
            })
        };
    }
    let channels: [(Channel, u32, SetCommand); 12] = [
        channel!(DriveTorque, drive, 125),
        channel!(TargetSpeed, target_speed, 125),
        channel!(ServiceBrake, brake, 125),
        channel!(Retarder, retarder, 250),
        channel!(Gear, gear, 250),
        channel!(ParkingBrake, epb, 500),
        channel!(Steering, steering, 125),
        channel!(Contactors, contactors, 250),
        channel!(Auxiliaries, auxiliaries, 500),
        channel!(Warnings, warnings, 500),
        channel!(Body, body, 500),
        channel!(Mode, mode, 500),
    ];
    for (channel, timeout, set) in channels {
        for (kind, age, reason) in [
            (0, 0, Some(Reason::CommandLost)),
            (1, 0, None),
            (1, timeout, None),
            (1, timeout + 1, Some(Reason::CommandLost)),
            (1, u32::MAX, Some(Reason::CommandLost)),
            (2, 0, Some(Reason::CommandRejected)),
            (3, 0, Some(Reason::CommandRejected)),
            (4, 0, Some(Reason::CommandRejected)),
            (5, 0, Some(Reason::CommandRejected)),
            (6, 0, Some(Reason::CommandRejected)),
        ] {
            let mut bus = Bus::driving(FAST);
            set(&mut bus, kind, age);
            let decision = bus.step();
            match reason {
                Some(reason) => assert_verdict(&decision, channel, Kind::Block, reason),
                None => assert_passed(&decision, channel),
            }
        }
    }
}

/// CMD-1b, STR-1a, STR-1f: idle steering is no way in: fields outside their range are refused with steering disabled too.
#[test]
fn idle_steering_fields_are_checked_too() {
    let idle = Steering::NEUTRAL;
    let wild = [
        Steering { angle: angle(7_201), ..idle },
        Steering { angle: angle(-7_201), ..idle },
        Steering { angle: angle(i16::MIN), ..idle },
        Steering { rate: RateDeciDegS::new(u16::MAX), ..idle },
        Steering { bar_limit: BarTorque50mNm::new(101), ..idle },
        Steering { bar_limit: BarTorque50mNm::new(255), ..idle },
        Steering { weight: percent(1), ..idle },
        Steering { weight: percent(101), ..idle },
        Steering { overlay: hand_torque(1), ..idle },
        Steering { overlay: hand_torque(i16::MIN), ..idle },
    ];
    for mut bus in [Bus::driving(FAST), Bus::automated(kmh(10)), Bus::parked()] {
        for request in wild {
            bus.commands.steering = Command::Fresh(request);
            let decision = bus.step();
            assert_refused(&decision, Channel::Steering);
            let Steering { enable, angle, weight, overlay, bar_limit, .. } = decision.outputs.steering;
            assert!(!enable && weight == Percent::ZERO && overlay == TorqueNmQ10::ZERO);
            assert!(angle.raw().unsigned_abs() <= 7_200 && bar_limit.raw() <= 100);
        }
    }
}

/// CMD-1b: a torque or weight byte beyond 100 never goes out, whatever the rest of the frame says.
#[test]
fn no_percentage_beyond_100_goes_out() {
    for value in 101..=255 {
        for mut bus in [pressed(), cruising(), Bus::steering(kmh(10))] {
            bus.accelerator(travel(100));
            for origin in Origin::ALL {
                drive(&mut bus, value, true, *origin);
                retarder(&mut bus, value);
                bus.commands.steering = Command::Fresh(Steering { weight: percent(value), ..STEER });
                let outputs = bus.step().outputs;
                assert!(outputs.drive.torque <= Percent::FULL);
                assert!(outputs.retarder.torque <= Percent::FULL);
                assert!(outputs.steering.weight <= Percent::FULL);
            }
        }
    }
}

/// CMD-7a: no field of any command is evidence: with every flag of the controller's frames set nothing is granted.
#[test]
fn no_field_of_a_command_is_evidence() {
    let mut bus = Bus::parked();
    bus.vacant();
    bus.commands.mode = Command::Fresh(DrivingMode::Automated);
    drive(&mut bus, 10, true, Origin::Driver);
    bus.ask_epb(EpbRequest::Release);
    bus.ask_gear(GearRequest::Drive);
    bus.commands.steering = Command::Fresh(STEER);
    bus.commands.target_speed = Command::Fresh(kmh(30));
    bus.run_with(60_000, 50, |decision| {
        let Outputs { drive, gear, epb, mode, steering, target_speed, .. } = decision.outputs;
        assert_eq!((drive.torque, target_speed, mode), (Percent::ZERO, kmh(0), DrivingMode::Manual));
        assert_ne!(epb.request, EpbRequest::Release);
        assert_ne!(gear, GearRequest::Drive);
        assert!(!steering.enable);
    });
}
