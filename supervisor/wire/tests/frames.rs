//! Is a frame taken: identifier, length, check field, reserved bits, every signal.

#![expect(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on has failed")]

mod common;

use std::collections::BTreeSet;

use common::*;
use proptest::prelude::*;
use supervisor_core::*;
use supervisor_perceive::Scene;
use supervisor_wire::*;

fn receiver() -> Receiver {
    Receiver::new(&at_once())
}

/// Takes `frame` after a predecessor of the same message, so that only its own faults count.
fn take(message: Message, frame: &Frame) -> Result<Accepted, Refusal> {
    let neutral = common::frame(message, &Inputs::NEVER, &Outputs::NEUTRAL, 0);
    take_after(&mut receiver_of(message, &at_once()), message, &neutral, frame)
}

/// The same, with a good frame that is there already.
fn take_after(receiver: &mut Receiver, message: Message, neutral: &Frame, frame: &Frame) -> Result<Accepted, Refusal> {
    if message.protection() != Protection::Bare {
        let (start, width, count) = counter_place(message);
        let counter = u8::try_from(bits(frame.payload(), start, width)).unwrap();
        let before = (counter + count - 1) % count;
        let _ = receiver.accept(ms(0), &resealed(message, neutral, before));
    }
    receiver.accept(ms(10), frame)
}

fn refused(message: Message, fault: Fault) -> Result<Accepted, Refusal> {
    Err(Refusal { message: Some(message), fault })
}

/// E2E-1a: every message has one class; identifiers are distinct, also those of the outputs.
#[test]
fn table() {
    let mut ids = BTreeSet::new();
    for (number, message) in Message::ALL.iter().enumerate() {
        assert_eq!(message.number(), number);
        assert!(ids.insert(message.id()), "{message:?}");
        let output = message.id_from(Source::Supervisor);
        assert_eq!(output != message.id(), message.is_command());
        assert!(ids.insert(output) || !message.is_command());
        assert_eq!(message.id_from(Source::MainController), message.id());
        assert!(message.id() < 1 << 29);
        let longest = match message.control_time() {
            ControlTime::Ms50 => 50,
            ControlTime::Ms100 => 100,
            ControlTime::Ms200 => 200,
        };
        assert!(message.period().raw() <= longest, "{message:?}");
    }
    assert_eq!(Message::COUNT, Message::ALL.len());
    let bare: Vec<_> = Message::ALL.iter().filter(|message| message.protection() == Protection::Bare).collect();
    assert_eq!(bare, [&Message::Ccvs1, &Message::Ebc1]);
}

/// E2E-1b: no two data ids look alike to the CRC, so no frame passes for another message or another sender.
#[test]
fn data_ids() {
    let mut seen = BTreeSet::new();
    for message in protected().filter(|message| message.protection() == Protection::Profile11) {
        for source in [Source::MainController, Source::Supervisor] {
            let id = message.id_from(source);
            let crc = resealed(message, &Frame::new(id, 0), 0).data[0];
            assert!(seen.insert(crc) || !message.is_command() && source == Source::Supervisor, "{message:?}");
            assert_ne!(crc, 0, "zeros would pass");
        }
    }
}

/// E2E-1b: frames sealed by `PyPI` autosar-e2e 1.0.0, `e2e_p11_protect(data, data_id, increment_counter=False)`.
#[test]
fn profile_11_oracle() {
    for (message, hex) in [
        (Message::Seat1, [GOLDEN_SEAT_CRC, 0x05, 1, 0, 0, 0, 0, 0]),
        (Message::TargetSpeed, [GOLDEN_SPEED_CRC, 0x0E, 0x34, 0x12, 0, 0, 0, 0]),
    ] {
        let frame = Frame { id: message.id(), length: 8, data: hex };
        assert!(take(message, &frame).is_ok(), "{message:?}");
        assert_eq!(resealed(message, &frame, hex[1]), frame);
    }
}
const GOLDEN_SEAT_CRC: u8 = 0xB2;
const GOLDEN_SPEED_CRC: u8 = 0xD4;

/// E2E-1b, CMD-7c: whatever one bit is flipped, the frame is refused; of protected messages, all 64 bits.
///
/// TSC1 is the exception: its checksum misses bit 1 of a byte where the sum passes a multiple of 256. Such a frame is
/// a command like any other.
#[test]
fn every_flipped_bit() {
    let mut random = Random::new(1);
    for message in protected() {
        for round in 0..16 {
            let frame = common::frame(message, &random.inputs(), &random.outputs(), round % 8);
            assert_eq!(take(message, &frame), Ok(Accepted { message, lost: 0 }));
            for bit in 0..64 {
                let flipped = Frame::new(frame.id, frame.payload() ^ 1 << bit);
                let missed = message.protection() == Protection::Tsc1 && bit % 8 == 1;
                assert!(missed || take(message, &flipped).is_err(), "{message:?} bit {bit}");
            }
        }
    }
}

/// E2E-1b: with any other check field the frame is refused, as [`Fault::Checksum`].
#[test]
fn every_wrong_check_field() {
    for message in protected() {
        let frame = common::frame(message, &Inputs::NEVER, &Outputs::NEUTRAL, 3);
        let (start, width) = if message.protection() == Protection::Profile11 { (0, 8) } else { (60, 4) };
        for raw in (0..1 << width).filter(|raw| *raw != bits(frame.payload(), start, width)) {
            let wrong = Frame::new(frame.id, with_bits(frame.payload(), start, width, raw));
            assert_eq!(take(message, &wrong), refused(message, Fault::Checksum));
        }
    }
}

/// E2E-1b: the frame of zeros with id 0 passes the checksum of TSC1; it is refused, and so are zeros with any id.
#[test]
fn zeros() {
    assert_eq!(receiver().accept(ms(0), &Frame::new(0, 0)).unwrap_err().message, None);
    for message in protected() {
        assert!(take(message, &Frame::new(message.id(), 0)).is_err(), "{message:?}");
        assert!(take(message, &Frame::new(message.id(), u64::MAX)).is_err(), "{message:?}");
    }
}

/// E2E-1c: a counter that is reserved or "not available" is refused, though the check field is right.
#[test]
fn counters_out_of_range() {
    for message in protected() {
        let frame = common::frame(message, &Inputs::NEVER, &Outputs::NEUTRAL, 0);
        let (.., count) = counter_place(message);
        for counter in count..16 {
            assert_eq!(take_raw(message, &resealed(message, &frame, counter)), refused(message, Fault::NoCounter));
        }
    }
}

fn take_raw(message: Message, frame: &Frame) -> Result<Accepted, Refusal> {
    receiver_of(message, &at_once()).accept(ms(0), frame)
}

/// CMD-1a: an identifier that is not in the table is refused; also one bit beside those that are.
#[test]
fn identifiers() {
    let ids: BTreeSet<_> = Message::ALL
        .iter()
        .flat_map(|message| [Source::MainController, Source::Supervisor].map(|source| message.id_from(source)))
        .collect();
    for id in &ids {
        for bit in 0..32 {
            let other = id ^ 1 << bit;
            if !ids.contains(&other) {
                let refusal = receiver().accept(ms(0), &Frame::new(other, 0)).unwrap_err();
                assert_eq!(refusal, Refusal { message: None, fault: Fault::Identifier });
                assert_eq!(refusal.fault.rejection(), None);
            }
        }
    }
}

/// TRQ-2f, CMD-1a: one road leads to the drive torque, whoever asks: no other command carries a torque of the drive, a
/// throttle or a pedal position.
#[test]
fn one_road_to_the_drive() {
    let commands = Message::ALL.iter().copied().filter(|message| message.is_command());
    let to_drive = |message: &Message| message.destination() == Destination::Command(Channel::DriveTorque);
    assert_eq!(commands.clone().filter(to_drive).collect::<Vec<_>>(), [Message::DriveTorque]);
    let others = commands.filter(|message| !to_drive(message)).flat_map(Message::signals);
    let names: Vec<_> = others.map(|signal| signal.name).collect();
    assert!(names.len() > 20, "{names:?}");
    assert!(!names.iter().any(|name| name.contains("Throttle") || name.contains("Pedal")), "{names:?}");
}

/// SELF-10b: a command with the supervisor's own address is a second sender of it; an actuator obeys it alone.
#[test]
fn sources() {
    for message in Message::ALL.iter().copied().filter(|message| message.is_command()) {
        let frame = common::frame(message, &Inputs::NEVER, &Outputs::NEUTRAL, 0);
        let own = resealed(message, &Frame { id: message.id_from(Source::Supervisor), ..frame }, 0);
        assert_eq!(receiver().accept(ms(0), &own), refused(message, Fault::Source));
        let mut actuator = Receiver::listening_to(Source::Supervisor, &at_once());
        assert_eq!(actuator.accept(ms(0), &frame), refused(message, Fault::Source));
        assert_eq!(actuator.accept(ms(0), &own), refused(message, Fault::NoPredecessor));
        assert_eq!(
            actuator.accept(ms(10), &resealed(message, &own, 1)),
            Ok(Accepted { message, lost: 0 }),
            "{message:?}"
        );
    }
}

/// SELF-10b: the supervisor takes no status from the bus: it is its own.
#[test]
fn no_status_of_another() {
    for message in [Message::SupervisorStatus, Message::SupervisorFaults] {
        let frame = common::frame(message, &Inputs::NEVER, &Outputs::NEUTRAL, 0);
        assert_eq!(receiver().accept(ms(0), &frame), refused(message, Fault::Source));
    }
}

/// CMD-1b: only frames of 8 bytes are taken.
#[test]
fn lengths() {
    for message in Message::ALL.iter().copied() {
        let frame = common::frame(message, &Inputs::NEVER, &Outputs::NEUTRAL, 1);
        for length in (0..=255).filter(|length| *length != 8) {
            assert_eq!(take(message, &Frame { length, ..frame }), refused(message, Fault::Length));
        }
        assert!(take(message, &frame).is_ok());
    }
}

/// CMD-1b: every stray reserved bit is refused, though the check field is right.
#[test]
fn reserved_bits() {
    let mut random = Random::new(2);
    let mut count = 0;
    for message in protected() {
        let own = message.signals().iter().fold(0, |own, signal| with_bits(own, signal.start, signal.width, u64::MAX));
        let header = if message.protection() == Protection::Profile11 { 0xFFF } else { 0xFF << 56 };
        let frame = common::frame(message, &random.inputs(), &random.outputs(), 1);
        for bit in (0..64).filter(|bit| (own | header) >> bit & 1 == 0) {
            let stray = resealed(message, &Frame::new(frame.id, frame.payload() ^ 1 << bit), 1);
            assert_eq!(take(message, &stray), refused(message, Fault::Reserved), "bit {bit}");
            count += 1;
        }
        // Reserved bits are 1 in J1939 and 0 in ours; XBR's EBI mode is 0.
        let expected = match message.protection() {
            Protection::Profile11 => 0,
            Protection::Tsc1 => u64::MAX,
            Protection::Xbr => with_bits(u64::MAX, 16, 2, 0),
            Protection::Bare => unreachable!(),
        };
        assert_eq!((frame.payload() ^ expected) & !(own | header), 0, "{message:?}");
    }
    assert!(count > 700, "{count}");
}

/// The raw values that mean something, said once more.
fn meaningful(signal: &SignalLayout, raw: u64) -> bool {
    match signal.name {
        "SeatSensor1" | "SeatSensor2" | "DriveStopped" | "StabilityActive" | "HandsOff" | "EPBState" | "EPBMode"
        | "CruiseSwitch" | "DriverSet" | "K1" | "K4" | "AuxiliariesStopped" | "EBSBrakeSwitch" => raw != 2,
        "EPSState" | "ADSState" | "SelectedGear" | "CurrentGear" => raw <= 3 || raw == 7,
        "CameraClass" | "EPBRequest" | "K4Request" | "K1Request" | "XBRControlMode" => raw <= 2,
        "OverrideControlMode" | "RetarderControlMode" => raw == 0 || raw == 2,
        "ControlPurpose" => raw <= 1 || raw == 31,
        "RequestedTorque" => (125..=250).contains(&raw),
        "RetarderTorque" => raw <= 125,
        "ExternalAccelerationDemand" => raw <= 32_127,
        "GearRequest" => raw <= 4,
        "ExitReason" => raw <= 11,
        "SeatOccupancy" | "ModeGranted" | "PersistentRecord" => raw < 3,
        // In a list of one object.
        "Index" => raw == 0,
        "Length" => (1..=if signal.width == 6 { 32 } else { 16 }).contains(&raw),
        _ => true,
    }
}

/// CMD-1b, CMD-1c: each raw value of each signal is taken, or refused with the name of the signal.
#[test]
fn every_raw_value() {
    let mut scene = Scene::clear();
    scene.radar.push(Random::new(3).radar()).unwrap();
    scene.camera.push(Random::new(4).camera()).unwrap();
    for message in protected() {
        let mut frame = common::frame(message, &Inputs::NEVER, &Outputs::NEUTRAL, 0);
        Sender::new().encode_inputs(ms(0), &Inputs::NEVER, &scene, &mut |sent| {
            if sent.id == message.id() {
                frame = sent;
            }
        });
        let neutral = frame;
        let mut receiver = receiver_of(message, &at_once());
        let mut random = Random::new(5);
        for signal in message.signals() {
            // All of them; of the widest, both ends and some between.
            let count = 1_u64 << signal.width;
            let some = (0..1000).map(|_| random.below(count)).chain([count - 2, count - 1]);
            for raw in (0..count.min(1 << 16)).chain(some) {
                let payload = with_bits(frame.payload(), signal.start, signal.width, raw);
                let sent = resealed(message, &Frame::new(frame.id, payload), 1);
                let result = take_after(&mut receiver, message, &neutral, &sent);
                if meaningful(signal, raw) {
                    assert_eq!(result, Ok(Accepted { message, lost: 0 }), "{message:?} {} {raw}", signal.name);
                } else {
                    let Err(Refusal { fault: Fault::Signal(name), .. }) = result else { panic!("{signal:?} {raw}") };
                    assert!(name == signal.name || signal.name == "Length" && name == "Index", "{signal:?} {name}");
                }
            }
        }
    }
}

/// What the receiver knows after this frame and its predecessor, encoded again.
fn encoded_again(message: Message, frame: &Frame) -> Option<Frame> {
    let mut receiver = receiver_of(message, &at_once());
    let (start, width, count) = counter_place(message);
    let counter = u8::try_from(bits(frame.payload(), start, width)).unwrap();
    let _ = receiver.accept(ms(0), &resealed(message, frame, (counter + count - 1) % count));
    receiver.accept(ms(0), frame).ok()?;
    // A steering command and a brake split need their other half.
    for other in [Message::SteeringAngle, Message::SteeringTorque, Message::ServiceBrake] {
        if message != other {
            let half = common::frame(other, &Inputs::NEVER, &Outputs::NEUTRAL, 0);
            for counter in [(counter + 14) % 15, counter] {
                let _ = receiver.accept(ms(0), &resealed(other, &half, counter % counter_place(other).2));
            }
        }
    }
    let sample = receiver.sample(ms(0));
    let mut again = None;
    let mut emit = |sent: Frame| {
        if sent.id == frame.id {
            again = Some(resealed(message, &sent, counter));
        }
    };
    let mut sender = Sender::new();
    sender.encode_inputs(ms(0), sample.inputs, sample.scene, &mut emit);
    sender.encode_commands(ms(0), sample.commands, &mut emit);
    // One frame of the two is enough here: the other says what it says at the start.
    if message.destination() == Destination::Status {
        let half =
            if message == Message::SupervisorStatus { Message::SupervisorFaults } else { Message::SupervisorStatus };
        let _ = receiver.accept(ms(0), &common::frame(half, &Inputs::NEVER, &Outputs::NEUTRAL, 0));
        let (stamp, status) = receiver.status(ms(0)).ok()?;
        sender.encode_status(stamp, &status, &mut emit);
    }
    again
}

proptest! {
    /// SELF-1a: any frames at any times: no panic, whatever is asked for in between.
    #[test]
    fn any_frames(frames in prop::collection::vec((0..80_usize, any::<u8>(), any::<[u8; 8]>(), any::<u16>()), 1..200)) {
        let (mut receiver, mut sender) = (Receiver::new(&Config::DEFAULT), Sender::new());
        let mut now = 0_u32;
        for (which, length, data, step) in frames {
            now = now.wrapping_add(u32::from(step) * u32::from(step));
            let id = Message::ALL.get(which).map_or_else(|| u32::from_le_bytes([data[0], data[1], data[2], data[3]]), |message| message.id());
            let length = if length < 250 { 8 } else { length };
            let frame = Frame { id, length, data };
            let _ = receiver.accept(ms(now), &frame);
            let _ = receiver.accept_actuator(ms(now), &frame, &mut sender);
            sender.encode_outputs(ms(now), &Outputs::NEUTRAL, &mut |_| ());
            if let Some(message) = Message::ALL.get(which) {
                let sealed = if message.protection() == Protection::Bare { frame } else { resealed(*message, &frame, length & 15) };
                let _ = receiver.accept(ms(now), &sealed);
            }
            let _ = receiver.sample(ms(now));
            let _ = receiver.status(ms(now));
        }
    }

    /// CMD-1b: a protected frame that is taken comes out the same when it is encoded again, to the bit.
    #[test]
    fn taken_means_encoded_the_same(which in 0..Message::COUNT, data in any::<u64>(), sparse in any::<[u64; 2]>(), counter in 0..8_u8) {
        let message = Message::ALL[which];
        let list = matches!(message.destination(), Destination::Radar(_) | Destination::Camera(_));
        if message.protection() != Protection::Bare && !list {
            let own = message.signals().iter().fold(0, |own, signal| with_bits(own, signal.start, signal.width, u64::MAX));
            let neutral = common::frame(message, &Inputs::NEVER, &Outputs::NEUTRAL, 0).payload();
            // Anywhere, where the signals are, and near the neutral value.
            for payload in [data, neutral & !own | data & own, neutral ^ (sparse[0] & sparse[1] & data & own)] {
                let frame = resealed(message, &Frame::new(message.id(), payload), counter);
                if take(message, &frame).is_ok() {
                    prop_assert_eq!(encoded_again(message, &frame), Some(frame));
                }
            }
        }
    }

    /// E2E-1e: a bare message is taken whatever its bits are: those of others are none of our business.
    #[test]
    fn bare_frames(which in 0..2_usize, data in any::<u64>()) {
        let message = Message::ALL[which];
        prop_assert_eq!(receiver().accept(ms(0), &Frame::new(message.id(), data)), Ok(Accepted { message, lost: 0 }));
    }
}

/// Every fault says in words what is wrong with which message and signal.
#[test]
fn words() {
    let message = Some(Message::ServiceBrake);
    let say = |fault| Refusal { message, fault }.to_string();
    assert_eq!(say(Fault::Checksum), "XBR: checksum wrong");
    assert_eq!(say(Fault::Signal("XBRControlMode")), "XBR: value of XBRControlMode is not in its table");
    assert_eq!(
        Refusal { message: None, fault: Fault::Identifier }.to_string(),
        "unknown: identifier is not in the table"
    );
    let all = [
        Fault::Source,
        Fault::Length,
        Fault::NoCounter,
        Fault::Reserved,
        Fault::Repeated,
        Fault::Sequence,
        Fault::NoPredecessor,
    ];
    assert_eq!(all.map(say).into_iter().collect::<BTreeSet<_>>().len(), all.len());
}

/// CMD-2a: the vetting is told the kind of fault.
#[test]
fn rejections() {
    for (fault, rejection) in [
        (Fault::Identifier, None),
        (Fault::Source, None),
        (Fault::Length, Some(Rejection::Form)),
        (Fault::Reserved, Some(Rejection::Form)),
        (Fault::Checksum, Some(Rejection::Checksum)),
        (Fault::NoCounter, Some(Rejection::Counter)),
        (Fault::Repeated, Some(Rejection::Counter)),
        (Fault::Sequence, Some(Rejection::Counter)),
        (Fault::Signal(""), Some(Rejection::Field)),
        (Fault::NoPredecessor, Some(Rejection::Requalifying)),
    ] {
        assert_eq!(fault.rejection(), rejection);
    }
}
