//! The life of a command: absent, fresh, held, rejected; on demand; commands of several frames.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

mod common;

use common::*;
use supervisor_core::*;
use supervisor_wire::*;

/// A frame of `message` with this counter.
fn counted(message: Message, counter: u8) -> Frame {
    resealed(message, &frame(message, &Inputs::NEVER, &Outputs::NEUTRAL, 0), counter)
}

/// CMD-2a, CMD-2b, CMD-2c, CMD-2d: a command is fresh in the cycle after its frame, then held with its age, absent
/// after the time-out, rejected from a refused frame to the next good one; whichever channel it is.
#[test]
fn life_of_a_command() {
    let mut receiver = Receiver::new(&Config::DEFAULT);
    let message = Message::Gear;
    let drive = Outputs { gear: GearRequest::Drive, ..Outputs::NEUTRAL };
    let sent = |counter| resealed(message, &frame(message, &Inputs::NEVER, &drive, 0), counter);
    let gear = |receiver: &mut Receiver, now| receiver.sample(ms(now)).commands.gear;
    assert_eq!(gear(&mut receiver, 0), Command::Absent);
    // The first frame has no predecessor.
    assert_eq!(receiver.accept(ms(5), &sent(0)).unwrap_err().fault, Fault::NoPredecessor);
    assert_eq!(gear(&mut receiver, 10), Command::Rejected(Rejection::Requalifying));
    assert!(receiver.accept(ms(105), &sent(1)).is_ok());
    assert_eq!(gear(&mut receiver, 110), Command::Fresh(GearRequest::Drive));
    assert_eq!(gear(&mut receiver, 120), Command::Held(ms(15), GearRequest::Drive));
    assert_eq!(gear(&mut receiver, 355), Command::Held(ms(250), GearRequest::Drive));
    assert_eq!(gear(&mut receiver, 356), Command::Absent);
    // After a gap once more.
    assert_eq!(receiver.accept(ms(400), &sent(2)).unwrap_err().fault, Fault::NoPredecessor);
    assert!(receiver.accept(ms(500), &sent(3)).is_ok());
    assert_eq!(gear(&mut receiver, 500), Command::Fresh(GearRequest::Drive));
    // Refused, why; and good again.
    for (frame, why) in [
        (Frame { length: 7, ..sent(4) }, Rejection::Form),
        (Frame::new(message.id(), sent(4).payload() ^ 1), Rejection::Checksum),
        (sent(3), Rejection::Counter),
        (resealed(message, &Frame::new(message.id(), 7 << 16), 4), Rejection::Field),
    ] {
        assert!(receiver.accept(ms(510), &frame).is_err());
        assert_eq!(gear(&mut receiver, 510), Command::Rejected(why));
        assert_eq!(gear(&mut receiver, 520), Command::Rejected(why), "until the next good frame");
    }
    assert!(receiver.accept(ms(600), &sent(5)).is_ok());
    assert_eq!(gear(&mut receiver, 600), Command::Fresh(GearRequest::Drive));
    // A refused frame in the same cycle counts more than the good one before it.
    assert!(receiver.accept(ms(601), &sent(6)).is_ok());
    assert!(receiver.accept(ms(602), &sent(6)).is_err());
    assert_eq!(gear(&mut receiver, 610), Command::Rejected(Rejection::Counter));
    // Silence after a refused frame: absent, by the last good one.
    assert_eq!(gear(&mut receiver, 851), Command::Rejected(Rejection::Counter));
    assert_eq!(gear(&mut receiver, 852), Command::Absent);
}

/// CMD-2e, E2E-1c: while frames are refused only for having no good predecessor, nothing of them is obeyed.
#[test]
fn rejected_before_known() {
    let mut receiver = Receiver::new(&Config::DEFAULT);
    for number in 0..100_u32 {
        // Each frame is five steps on: never in sequence.
        let counter = u8::try_from(number * 5 % 15).unwrap();
        assert!(receiver.accept(ms(number * 100), &counted(Message::Gear, counter)).is_err());
        let expected = if number == 0 { Rejection::Requalifying } else { Rejection::Counter };
        assert_eq!(receiver.sample(ms(number * 100)).commands.gear, Command::Rejected(expected));
    }
    assert_eq!(receiver.sample(ms(9900 + 250)).commands.gear, Command::Rejected(Rejection::Counter));
    assert_eq!(receiver.sample(ms(9900 + 251)).commands.gear, Command::Absent);
}

/// E2E-1h: TSC1 is on demand. After a frame that asks for nothing, silence is no time-out; during a request it is.
#[test]
fn on_demand() {
    let idle = DriveTorque::NEUTRAL;
    let torque = Percent::new(1);
    for (drive, retarder, times_out) in [
        (idle, Retarder::NEUTRAL, false),
        (DriveTorque { torque, ..idle }, Retarder { mode: RetarderMode::Torque, ..Retarder::NEUTRAL }, true),
        (
            DriveTorque { active: true, ..idle },
            Retarder { torque, mode: RetarderMode::Torque, ..Retarder::NEUTRAL },
            true,
        ),
        (DriveTorque { origin: Origin::Adas, ..idle }, Retarder { torque, ..Retarder::NEUTRAL }, false),
    ] {
        let outputs = Outputs { drive, retarder, ..Outputs::NEUTRAL };
        let mut receiver = Receiver::new(&Config::DEFAULT);
        for message in [Message::DriveTorque, Message::Retarder] {
            for counter in [0, 1] {
                let sent = resealed(message, &frame(message, &Inputs::NEVER, &outputs, 0), counter);
                let _ = receiver.accept(ms(0), &sent);
            }
        }
        let commands = *receiver.sample(ms(0)).commands;
        assert_eq!((commands.drive, commands.retarder), (Command::Fresh(drive), Command::Fresh(retarder)));
        let commands = *receiver.sample(ms(100)).commands;
        assert_eq!(commands.drive, Command::Held(ms(100), drive));
        for now in (130..10_000).step_by(10) {
            let commands = *receiver.sample(ms(now)).commands;
            if times_out {
                assert_eq!(commands.drive, Command::Absent);
                assert_eq!(commands.retarder == Command::Absent, now > 250);
            } else {
                // Held, and never older than the time-out: not lost.
                assert_eq!(commands.drive, Command::Held(ms(125), drive));
                assert_eq!(commands.retarder, Command::Held(ms(now.min(250)), retarder));
            }
        }
        // After the pause the first frame is the predecessor only.
        let again = |counter| {
            resealed(Message::DriveTorque, &frame(Message::DriveTorque, &Inputs::NEVER, &outputs, 0), counter)
        };
        assert_eq!(receiver.accept(ms(10_000), &again(2)).unwrap_err().fault, Fault::NoPredecessor);
        assert_eq!(receiver.sample(ms(10_000)).commands.drive, Command::Rejected(Rejection::Requalifying));
        assert!(receiver.accept(ms(10_010), &again(3)).is_ok());
        assert_eq!(receiver.sample(ms(10_010)).commands.drive, Command::Fresh(drive));
    }
}

/// CMD-1d: XBR without its companion is all friction; the companion, lost or refused, never loses the demand.
#[test]
fn brake_without_split() {
    let brake = ServiceBrake {
        total: DecelMs2Q11::new(4096),
        electric: DecelMs2Q11::new(1024),
        mode: BrakeMode::Maximum,
        priority: Priority::Highest,
    };
    let friction = ServiceBrake { electric: DecelMs2Q11::ZERO, ..brake };
    let outputs = Outputs { brake, ..Outputs::NEUTRAL };
    let sent = |message, counter| resealed(message, &frame(message, &Inputs::NEVER, &outputs, 0), counter);
    let mut receiver = Receiver::new(&Config::DEFAULT);
    for counter in [0, 1] {
        let _ = receiver.accept(ms(0), &sent(Message::ServiceBrake, counter));
    }
    assert_eq!(receiver.sample(ms(0)).commands.brake, Command::Fresh(friction));
    // The companion has no predecessor, then counts; it makes nothing fresh.
    let _ = receiver.accept(ms(10), &sent(Message::BrakeSplit, 0));
    assert_eq!(receiver.sample(ms(10)).commands.brake, Command::Held(ms(10), friction));
    let _ = receiver.accept(ms(20), &sent(Message::BrakeSplit, 1));
    assert_eq!(receiver.sample(ms(20)).commands.brake, Command::Held(ms(20), brake));
    assert_eq!(receiver.sample(ms(30)).commands.brake, Command::Held(ms(30), brake));
    // Refused: friction at once. Good again: as before.
    let _ = receiver.accept(ms(40), &sent(Message::BrakeSplit, 1));
    assert_eq!(receiver.sample(ms(40)).commands.brake, Command::Held(ms(40), friction));
    let _ = receiver.accept(ms(50), &sent(Message::BrakeSplit, 2));
    let _ = receiver.accept(ms(50), &sent(Message::ServiceBrake, 2));
    assert_eq!(receiver.sample(ms(50)).commands.brake, Command::Fresh(brake));
    // Lost: friction after its time-out, while XBR goes on.
    let _ = receiver.accept(ms(100), &sent(Message::ServiceBrake, 3));
    assert_eq!(receiver.sample(ms(100)).commands.brake, Command::Fresh(brake));
    assert_eq!(receiver.sample(ms(175)).commands.brake, Command::Held(ms(75), brake));
    assert_eq!(receiver.sample(ms(176)).commands.brake, Command::Held(ms(76), friction));
    // XBR itself lost, the companion there.
    for (now, counter) in [(200, 3), (220, 4), (240, 5)] {
        let _ = receiver.accept(ms(now), &sent(Message::BrakeSplit, counter));
    }
    assert_eq!(receiver.sample(ms(240)).commands.brake, Command::Absent);
}

/// CMD-2a: a steering command needs both frames with one counter; old halves are never mixed with new ones.
#[test]
fn steering_pairs() {
    let steering = |angle, overlay| Steering {
        enable: true,
        angle: AngleDeciDeg::new(angle),
        overlay: TorqueNmQ10::new(overlay),
        ..Steering::NEUTRAL
    };
    let sent = |message, value: i16, counter| {
        let outputs = Outputs { steering: steering(value, value), ..Outputs::NEUTRAL };
        resealed(message, &frame(message, &Inputs::NEVER, &outputs, 0), counter)
    };
    let (angle, torque) = (Message::SteeringAngle, Message::SteeringTorque);
    let mut receiver = Receiver::new(&Config::DEFAULT);
    let read = |receiver: &mut Receiver, now| receiver.sample(ms(now)).commands.steering;
    assert_eq!(read(&mut receiver, 0), Command::Absent);
    let _ = receiver.accept(ms(0), &sent(angle, 1, 0));
    assert_eq!(read(&mut receiver, 0), Command::Rejected(Rejection::Requalifying));
    let _ = receiver.accept(ms(0), &sent(torque, 1, 0));
    assert_eq!(read(&mut receiver, 0), Command::Rejected(Rejection::Requalifying));
    // One half is ahead: not yet a pair.
    let _ = receiver.accept(ms(50), &sent(angle, 2, 1));
    assert_eq!(read(&mut receiver, 50), Command::Rejected(Rejection::Requalifying));
    let _ = receiver.accept(ms(51), &sent(torque, 2, 1));
    assert_eq!(read(&mut receiver, 60), Command::Fresh(steering(2, 2)));
    assert_eq!(read(&mut receiver, 70), Command::Held(ms(19), steering(2, 2)));
    // The next angle alone changes nothing; in the other order just as well.
    let _ = receiver.accept(ms(100), &sent(angle, 3, 2));
    assert_eq!(read(&mut receiver, 100), Command::Held(ms(49), steering(2, 2)));
    let _ = receiver.accept(ms(105), &sent(torque, 3, 2));
    assert_eq!(read(&mut receiver, 105), Command::Fresh(steering(3, 3)));
    let _ = receiver.accept(ms(150), &sent(torque, 4, 3));
    assert_eq!(read(&mut receiver, 150), Command::Held(ms(45), steering(3, 3)));
    let _ = receiver.accept(ms(150), &sent(angle, 4, 3));
    assert_eq!(read(&mut receiver, 150), Command::Fresh(steering(4, 4)));
    // A refused half rejects the whole at once, whichever it is.
    for (half, other, counter) in [(angle, torque, 4), (torque, angle, 5)] {
        let now = 150 + 10 * u32::from(counter);
        let _ = receiver.accept(ms(now), &sent(other, 5, counter));
        let _ = receiver.accept(ms(now), &Frame { length: 0, ..sent(half, 5, counter) });
        assert_eq!(read(&mut receiver, now), Command::Rejected(Rejection::Form));
        let _ = receiver.accept(ms(now), &sent(half, 5, counter));
        assert_eq!(read(&mut receiver, now), Command::Fresh(steering(5, 5)));
    }
    // A refused half with the counter of the other makes no pair: the old angle does not go with the new torque.
    let _ = receiver.accept(ms(201), &sent(torque, 6, 6));
    let _ = receiver.accept(ms(201), &sent(angle, 6, 6));
    let _ = receiver.accept(ms(202), &sent(angle, 7, 10));
    let _ = receiver.accept(ms(202), &sent(torque, 7, 8));
    let _ = receiver.accept(ms(202), &sent(torque, 8, 10));
    assert_eq!(read(&mut receiver, 202), Command::Rejected(Rejection::Counter));
    let _ = receiver.accept(ms(203), &sent(angle, 9, 11));
    assert_eq!(read(&mut receiver, 203), Command::Held(ms(2), steering(6, 6)));
    // A half that is lost again and again: both frames are in time, but no pair is.
    for round in 0..4_u8 {
        let now = 220 + 25 * u32::from(round);
        let _ = receiver.accept(ms(now), &sent(angle, 6, (12 + 2 * round) % 15));
        let _ = receiver.accept(ms(now), &sent(torque, 6, (11 + 2 * round) % 15));
        assert_eq!(read(&mut receiver, now), Command::Held(ms(now - 201), steering(6, 6)));
    }
    assert_eq!(read(&mut receiver, 326), Command::Held(ms(125), steering(6, 6)));
    assert_eq!(read(&mut receiver, 327), Command::Absent);
    assert_eq!(read(&mut receiver, 326), Command::Absent, "lost is lost, also if the clock steps back");
}

/// E2E-1g: one half of a steering command that times out makes it absent.
#[test]
fn steering_half_lost() {
    for lost in [Message::SteeringAngle, Message::SteeringTorque] {
        let mut receiver = Receiver::new(&Config::DEFAULT);
        for number in 0..20_u32 {
            for message in [Message::SteeringAngle, Message::SteeringTorque] {
                if message != lost || number < 4 {
                    let counter = u8::try_from(number % 15).unwrap();
                    let _ = receiver.accept(ms(number * 50), &counted(message, counter));
                }
            }
            let steering = receiver.sample(ms(number * 50)).commands.steering;
            match number {
                0 => assert_eq!(steering, Command::Rejected(Rejection::Requalifying)),
                1..=3 => assert_eq!(steering, Command::Fresh(Steering::NEUTRAL)),
                4..=5 => assert_eq!(steering, Command::Held(ms(number * 50 - 150), Steering::NEUTRAL)),
                _ => assert_eq!(steering, Command::Absent),
            }
        }
    }
}

/// CMD-2a: the commands of a channel are told apart: each channel reports its own message.
#[test]
fn each_channel_its_own() {
    let mut random = Random::new(6);
    for silent in Message::ALL.iter().copied().filter(|message| message.is_command()) {
        let mut bench = Bench::new(&Config::DEFAULT);
        let outputs = random.outputs();
        for _ in 0..100 {
            let Bench { sender, receiver, now } = &mut bench;
            sender.encode_commands(*now, &fresh(&outputs), &mut |frame| {
                if frame.id != silent.id() {
                    let _ = receiver.accept(*now, &frame);
                }
            });
            bench.pass(10);
        }
        let mut expected = fresh(&outputs);
        let commands = *bench.receiver.sample(bench.now).commands;
        macro_rules! lose {
            ($($message:ident: $field:ident),*) => {
                match silent {
                    $(Message::$message => expected.$field = Command::Absent,)*
                    Message::SteeringAngle | Message::SteeringTorque => expected.steering = Command::Absent,
                    _ => expected.brake = Command::Fresh(ServiceBrake { electric: DecelMs2Q11::ZERO, ..outputs.brake }),
                }
            };
        }
        lose!(DriveTorque: drive, TargetSpeed: target_speed, ServiceBrake: brake, Retarder: retarder, Gear: gear,
            ParkingBrake: epb, Contactors: contactors, Auxiliaries: auxiliaries, Warnings: warnings, Body: body, Mode: mode);
        assert_eq!(commands, expected, "{silent:?}");
        // In the next cycle nothing is fresh.
        bench.pass(10);
        let again = *bench.receiver.sample(bench.now).commands;
        assert!(matches!(again.gear, Command::Held(..) | Command::Absent));
        assert!(matches!(again.steering, Command::Held(..) | Command::Absent));
    }
}

/// VLC-1e: of several good brake requests in one cycle the greatest deceleration wins, wherever it stands among them,
/// as one: with its mode and priority. A request that is off is none. The next cycle starts afresh.
#[test]
fn strongest_brake() {
    let request = |total, mode, priority| ServiceBrake {
        total: DecelMs2Q11::new(total),
        electric: DecelMs2Q11::ZERO,
        mode,
        priority,
    };
    let weak = request(2048, BrakeMode::Addition, Priority::Low);
    let strong = request(8192, BrakeMode::Maximum, Priority::High);
    let last = request(4096, BrakeMode::Maximum, Priority::Medium);
    let off = request(16_384, BrakeMode::Off, Priority::Highest);
    let equal = request(8192, BrakeMode::Addition, Priority::Highest);
    for (requests, expected) in [
        (&[strong, weak][..], strong),
        (&[weak, strong], strong),
        (&[weak, strong, last], strong),
        (&[strong, off], strong),
        (&[off, weak], weak),
        (&[off], off),
        (&[strong, equal], equal),
        (&[weak], weak),
    ] {
        let mut receiver = Receiver::new(&Config::DEFAULT);
        let mut counter = 0;
        let mut ask = |receiver: &mut Receiver, now, brake| {
            let outputs = Outputs { brake, ..Outputs::NEUTRAL };
            let message = Message::ServiceBrake;
            let sent = resealed(message, &frame(message, &Inputs::NEVER, &outputs, 0), counter);
            counter += 1;
            receiver.accept(ms(now), &sent)
        };
        // A strong one in the cycle before: gone with it.
        let _ = ask(&mut receiver, 0, equal);
        assert!(ask(&mut receiver, 0, request(10_240, BrakeMode::Maximum, Priority::Highest)).is_ok());
        let _ = receiver.sample(ms(0));
        for brake in requests {
            assert!(ask(&mut receiver, 5, *brake).is_ok());
        }
        assert_eq!(receiver.sample(ms(10)).commands.brake, Command::Fresh(expected));
        assert_eq!(receiver.sample(ms(20)).commands.brake, Command::Held(ms(15), expected));
        assert!(ask(&mut receiver, 25, weak).is_ok());
        assert_eq!(receiver.sample(ms(30)).commands.brake, Command::Fresh(weak));
    }
}

/// VLC-1e, RULE-5a: a refused frame among them counts as before: it is disobeyed at once, and a stronger demand in it
/// is none. A good one after it is enough, and what was asked for before the refused one stands.
#[test]
fn strongest_brake_keeps_the_checks() {
    let message = Message::ServiceBrake;
    let sent = |total, counter| {
        let brake = ServiceBrake { total: DecelMs2Q11::new(total), mode: BrakeMode::Maximum, ..ServiceBrake::NEUTRAL };
        let outputs = Outputs { brake, ..Outputs::NEUTRAL };
        (brake, resealed(message, &frame(message, &Inputs::NEVER, &outputs, 0), counter))
    };
    let mut receiver = Receiver::new(&Config::DEFAULT);
    let _ = receiver.accept(ms(0), &sent(0, 0).1);
    let (first, frame) = sent(6000, 1);
    assert!(receiver.accept(ms(0), &frame).is_ok());
    // Stronger, but repeated.
    assert!(receiver.accept(ms(0), &sent(9000, 1).1).is_err());
    assert_eq!(receiver.clone().sample(ms(0)).commands.brake, Command::Rejected(Rejection::Counter));
    assert!(receiver.accept(ms(1), &sent(1000, 2).1).is_ok());
    assert_eq!(receiver.sample(ms(10)).commands.brake, Command::Fresh(first));
}

/// VLC-1e: the electric part comes by its own message, and is the last one whichever request wins.
#[test]
fn strongest_brake_and_split() {
    let brake = |total, electric| ServiceBrake {
        total: DecelMs2Q11::new(total),
        electric: DecelMs2Q11::new(electric),
        mode: BrakeMode::Maximum,
        priority: Priority::Low,
    };
    let mut receiver = Receiver::new(&Config::DEFAULT);
    for (counter, value) in [(0, brake(0, 0)), (1, brake(8000, 500)), (2, brake(4000, 700))] {
        let outputs = Outputs { brake: value, ..Outputs::NEUTRAL };
        for message in [Message::BrakeSplit, Message::ServiceBrake] {
            let _ = receiver.accept(ms(0), &resealed(message, &frame(message, &Inputs::NEVER, &outputs, 0), counter));
        }
    }
    assert_eq!(receiver.sample(ms(0)).commands.brake, Command::Fresh(brake(8000, 700)));
    // The next cycle: a split before its request does not make the old request count.
    for (message, value) in [(Message::BrakeSplit, brake(1000, 300)), (Message::ServiceBrake, brake(1000, 300))] {
        let outputs = Outputs { brake: value, ..Outputs::NEUTRAL };
        let _ = receiver.accept(ms(10), &resealed(message, &frame(message, &Inputs::NEVER, &outputs, 0), 3));
    }
    assert_eq!(receiver.sample(ms(10)).commands.brake, Command::Fresh(brake(1000, 300)));
}
