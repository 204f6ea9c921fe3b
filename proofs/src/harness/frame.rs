//! The link: check fields of any payload; one frame of each message at any link (E2E-1, CMD-1, CMD-2, CMD-7).
//!
//! The message is concrete, everything else any: payload, length, time, the state of the link, what was received before.

use supervisor_core::{Command, Config, Evidence, Inputs, Millis};
use supervisor_perceive::{CameraObject, MAX_CAMERA};
use supervisor_wire::inspect::{Entry, Link, List, Values, identify, read};
use supervisor_wire::{Destination, Message, Protection, Sender, Timing};

use crate::properties::frame::{
    Arrival, cmd_1a_closed_table, cmd_2b_fresh_only_when_taken, cmd_2c_held_up_to_its_timeout,
    cmd_3c_outputs_come_back, cmd_3c_written_is_read, cmd_3e_next_counter, e2e_1b_flipped_bit_is_found,
    e2e_1b_intact_exactly, e2e_1b_sealed_is_intact, e2e_1c_result_is_exact, e2e_1d_redundant_known_only_while_agreed,
    e2e_1i_brake_switches, e2e_1i_our_own_signals, e2e_1i_wheel_speed, reads_its_own, rule_5a_disobeyed_at_once,
    writes_back,
};

/// E2E-1b: Profile 11, any identifier, payload, counter and bit.
#[kani::proof]
fn e2e_1_profile_11() {
    check_fields(Protection::Profile11);
}

/// E2E-1b: the checksums of J1939.
#[kani::proof]
fn e2e_1_j1939() {
    check_fields(Protection::Tsc1);
    check_fields(Protection::Xbr);
    check_fields(Protection::Bare);
}

fn check_fields(protection: Protection) {
    let (id, payload, counter): (u32, u64, u8) = (kani::any(), kani::any(), kani::any());
    assert!(e2e_1b_intact_exactly(protection, id, payload));
    assert!(e2e_1b_sealed_is_intact(protection, id, payload, counter));
    kani::cover!(protection.open(id, payload).is_ok(), "an intact frame");
}

/// Any frame of this message, at any link, over these values.
fn any_arrival(message: Message, old: Values) -> Arrival {
    let link: Link = kani::any();
    Arrival::of(message, link.of(message), kani::any(), kani::any(), old)
}

/// Reads any payload of these messages over any values: it can be read, and writes back as it was; nothing else is changed.
/// What stands in counter and check field makes no difference to it.
macro_rules! reads {
    ($($message:ident),* $(,)?) => {
        let (payload, old): (u64, Values) = (kani::any(), kani::any());
        $(
            let (message, mut new) = (Message::$message, old);
            let result = read(message, payload, &mut new);
            assert!(result.is_err() || writes_back(message, payload, &new));
            assert!(reads_its_own(message, &old, &new));
            kani::cover!(result.is_ok(), "it is read");
        )*
    };
}

/// E2E-1, CMD-7: the commands of J1939.
#[kani::proof]
fn cmd_1_commands_of_j1939() {
    reads!(DriveTorque, ServiceBrake, Retarder);
}

/// E2E-1, CMD-7: our own commands.
#[kani::proof]
fn cmd_1_commands_of_ours() {
    reads!(TargetSpeed, BrakeSplit, Gear, ParkingBrake);
}

/// E2E-1, CMD-7: the commands of steering, and the mode.
#[kani::proof]
fn cmd_1_commands_of_steering() {
    reads!(SteeringAngle, SteeringTorque, Mode);
}

/// E2E-1, CMD-7: contactors and what is on and off.
#[kani::proof]
fn cmd_1_commands_of_switches() {
    reads!(Contactors, Auxiliaries, Warnings, Body);
}

/// E2E-1: inputs of driver and seat.
#[kani::proof]
fn e2e_1_inputs_of_the_driver() {
    reads!(Accelerator, Seat1, Seat2, BrakePedal1, BrakePedal2, DriverControls);
}

/// E2E-1: inputs of the actuators.
#[kani::proof]
fn e2e_1_inputs_of_actuators() {
    reads!(GearStatus, DriveStatus, BrakeStatus, SteeringStatus, ParkingBrakeStatus);
}

/// E2E-1: the other inputs.
#[kani::proof]
fn e2e_1_other_inputs() {
    reads!(HighVoltageStatus, AdsStatus, ElectricBrake, VehicleMass);
}

/// E2E-1: parts of object lists.
#[kani::proof]
fn e2e_1_objects() {
    reads!(RadarPosition, RadarMotion, CameraObject, CameraCorner, CameraSize);
}

/// E2E-1: what the supervisor says of itself, at a receiver that listens to it.
#[kani::proof]
fn e2e_1_status() {
    reads!(SupervisorStatus, SupervisorFaults);
}

/// E2E-1c, E2E-1j, CMD-2b, CMD-7c, RULE-5a: a frame at a link.
///
/// A link asks its message for its protection, whether it commands, its signals, and whether it may pause: one message of
/// each kind stands for all of that kind. The signals of every message are the harnesses above, check fields those before.
macro_rules! arrives {
    ($($message:ident),* $(,)?) => {$(
        let arrival = any_arrival(Message::$message, kani::any());
        assert!(e2e_1c_result_is_exact(&arrival));
        assert!(rule_5a_disobeyed_at_once(&arrival));
        assert!(cmd_2b_fresh_only_when_taken(&arrival));
        kani::cover!(arrival.result == Ok(2), "taken, two are lost");
    )*};
}

/// A command of J1939 that may pause, and one that may not.
#[kani::proof]
#[kani::unwind(48)]
#[kani::stub(supervisor_wire::Protection::open, crate::harness::uninterpreted::open)]
fn e2e_1_link_of_j1939() {
    arrives!(DriveTorque, ServiceBrake);
}

/// A command and an input of ours.
#[kani::proof]
#[kani::unwind(48)]
#[kani::stub(supervisor_wire::Protection::open, crate::harness::uninterpreted::open)]
fn e2e_1_link_of_ours() {
    arrives!(Gear, Seat1);
}

/// E2E-1e, E2E-1f, E2E-1i: the two bare messages.
#[kani::proof]
#[kani::unwind(48)]
fn e2e_1_bare() {
    let (old, frame) = (kani::any(), kani::any());
    let link: Link = kani::any();
    let arrival = |message| Arrival::of(message, link.of(message), kani::any(), frame, old);
    let (speed, brake) = (arrival(Message::Ccvs1), arrival(Message::Ebc1));
    assert!(e2e_1i_wheel_speed(&speed));
    assert!(e2e_1c_result_is_exact(&speed));
    assert!(rule_5a_disobeyed_at_once(&speed));
    assert!(e2e_1i_brake_switches(&brake));
    assert!(e2e_1c_result_is_exact(&brake));
    assert!(rule_5a_disobeyed_at_once(&brake));
    kani::cover!(speed.result == Ok(0), "taken");
    kani::cover!(brake.result.is_err(), "too short");
}

/// E2E-1i, CMD-1c: our own signals, by the codings that every row shares.
#[kani::proof]
#[kani::unwind(17)]
#[kani::stub(supervisor_wire::Protection::open, crate::harness::uninterpreted::open)]
fn e2e_1_our_own_signals() {
    for message in [Message::Seat1, Message::DriveStatus, Message::SteeringStatus] {
        let arrival = any_arrival(message, kani::any());
        assert!(e2e_1i_our_own_signals(&arrival));
        kani::cover!(arrival.result.is_ok(), "taken");
    }
}

/// CMD-2, E2E-1g, E2E-1h: how long a command counts.
#[kani::proof]
#[kani::unwind(17)]
#[kani::stub(supervisor_wire::Protection::open, crate::harness::uninterpreted::open)]
fn cmd_2_held_up_to_its_timeout() {
    for message in [Message::DriveTorque, Message::Retarder, Message::ServiceBrake, Message::Gear] {
        let (link, timing): (Link, Timing) = (kani::any(), kani::any());
        let link = link.of(message).timed(timing);
        let arrival = Arrival::of(message, link, kani::any(), kani::any(), kani::any());
        let later = kani::any();
        assert!(cmd_2c_held_up_to_its_timeout(&arrival, timing.timeout, later));
        let mut link = arrival.after;
        link.fresh = false;
        kani::cover!(arrival.result.is_ok() && matches!(link.command(later, ()), Command::Held(..)), "held");
        kani::cover!(arrival.result.is_ok() && link.command(later, ()) == Command::Absent, "absent");
    }
}

/// Writes any values into these messages and reads them again.
macro_rules! written {
    ($($message:ident),* $(,)?) => {
        let values: Values = kani::any();
        $(
            assert!(cmd_3c_written_is_read(Message::$message, &values));
            assert!(cmd_3c_outputs_come_back(Message::$message, &values));
        )*
        kani::cover!(values.outputs.drive.active, "a torque");
    };
}

/// CMD-3c: every output is read, and as what it was: those that move the bus.
#[kani::proof]
fn cmd_3_written_is_read_of_motion() {
    written!(DriveTorque, TargetSpeed, ServiceBrake, BrakeSplit, Retarder, Gear, SteeringAngle, SteeringTorque);
}

/// CMD-3c: every output is read, and as what it was: those that hold and switch.
#[kani::proof]
fn cmd_3_written_is_read_of_switches() {
    written!(ParkingBrake, Contactors, Auxiliaries, Mode);
}

/// CMD-3c: every output and every status is read, and as what it was: the others.
#[kani::proof]
fn cmd_3_written_is_read_of_the_rest() {
    written!(Warnings, Body, SupervisorStatus, SupervisorFaults);
    let ours = |message: &Message| message.is_command() || message.destination() == Destination::Status;
    assert!(Message::ALL.iter().copied().filter(ours).count() == 16, "one of ours is missing here or above");
}

/// CMD-1a: any identifier.
#[kani::proof]
#[kani::unwind(40)]
fn cmd_1_identifiers() {
    let id = kani::any();
    assert!(cmd_1a_closed_table(id));
    kani::cover!(identify(id).is_some(), "one of the table");
    kani::cover!(identify(id).is_none(), "none");
}

/// E2E-1d, RULE-6c: any inputs, any configuration.
#[kani::proof]
#[kani::unwind(17)]
#[kani::stub(supervisor_core::kernel::within_percent, crate::harness::uninterpreted::within_percent)]
fn e2e_1_redundant() {
    let inputs: Inputs = kani::any();
    let bounds = (kani::any(), kani::any(), kani::any());
    let (speed_agree, speed_agree_percent, pedal_agree) = bounds;
    let config = Config { speed_agree, speed_agree_percent, pedal_agree, ..Config::DEFAULT };
    assert!(e2e_1d_redundant_known_only_while_agreed(&inputs, &config));
    kani::cover!(Evidence::gather(&inputs, &config).speed.is_some(), "speeds agree");
    kani::cover!(Evidence::gather(&inputs, &config).speed.is_none(), "they do not");
}

/// CMD-3e: any sender, time and values; one message of each protection, because nothing else of it decides its counter.
#[kani::proof]
#[kani::unwind(40)]
fn cmd_3_counters_run_on() {
    let (sender, now, values): (Sender, Millis, Values) = (kani::any(), kani::any(), kani::any());
    for message in [Message::DriveTorque, Message::ServiceBrake, Message::Gear] {
        assert!(cmd_3e_next_counter(&sender, now, message, &values));
    }
    kani::cover!(sender.counter(Message::Gear) == Some(14), "a counter comes round");
}

/// SELF-1a, MIT-7a: parts of a list are put together in any order: the list that comes out has each of its objects, and is total for any list
/// in the making.
#[kani::proof]
#[kani::unwind(17)]
fn e2e_1_list_is_whole() {
    let (mut list, entry): (List<CameraObject, MAX_CAMERA>, Entry<CameraObject>) = (kani::any(), kani::any());
    let (now, part): (Millis, u8) = (kani::any(), kani::any());
    kani::assume(part < 3);
    let whole = list.add(now, part, &entry).map(Iterator::count);
    if let Some(count) = whole {
        assert!(entry.length.known().is_some_and(|length| usize::from(length.raw()) == count));
    }
    kani::cover!(whole == Some(MAX_CAMERA), "a full list");
    kani::cover!(whole == Some(0), "an empty list");
    kani::cover!(whole.is_none(), "not yet whole");
}
