//! The order of frames: lost, repeated, out of sequence; and what a refused frame does.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

mod common;

use common::*;
use supervisor_core::*;
use supervisor_perceive::Scene;
use supervisor_wire::*;

/// A frame of `message` with this counter.
fn counted(message: Message, counter: u8) -> Frame {
    resealed(message, &frame(message, &Inputs::NEVER, &Outputs::NEUTRAL, 0), counter)
}

fn step(message: Message, last: u8, next: u8) -> Result<u8, Fault> {
    let mut receiver = receiver_of(message, &Config::DEFAULT);
    let _ = receiver.accept(ms(0), &counted(message, last));
    match receiver.accept(ms(10), &counted(message, next)) {
        Ok(accepted) => {
            assert_eq!(accepted.message, message);
            Ok(accepted.lost)
        }
        Err(refusal) => {
            assert_eq!(refusal.message, Some(message));
            Err(refusal.fault)
        }
    }
}

/// E2E-1c: every pair of counters of every protected message: one to three steps on are taken, with the number of
/// lost frames; a repeated one and every other step, also back, are refused.
#[test]
fn every_step() {
    for message in protected() {
        let (.., count) = counter_place(message);
        for last in 0..count {
            for next in 0..count {
                let expected = match (next + count - last) % count {
                    0 => Err(Fault::Repeated),
                    step @ 1..=3 => Ok(step - 1),
                    _ => Err(Fault::Sequence),
                };
                assert_eq!(step(message, last, next), expected, "{message:?} {last} {next}");
            }
        }
    }
}

/// E2E-1c: the counter runs on through its wrap for as long as you like.
#[test]
fn wrap() {
    for message in protected() {
        let (.., count) = counter_place(message);
        let mut receiver = receiver_of(message, &Config::DEFAULT);
        let _ = receiver.accept(ms(0), &counted(message, 0));
        for number in 1..100_u32 {
            let counter = u8::try_from(number % u32::from(count)).unwrap();
            let accepted = receiver.accept(ms(number * 10), &counted(message, counter));
            assert_eq!(accepted, Ok(Accepted { message, lost: 0 }));
        }
    }
}

/// E2E-1c: an old frame is refused, each of those that a counter can tell; a frame that is refused for its counter
/// is the one that the next is compared with.
#[test]
fn replay() {
    for message in protected() {
        let (.., count) = counter_place(message);
        for back in 0..=count - 4 {
            let mut receiver = receiver_of(message, &Config::DEFAULT);
            for number in 0..count {
                let _ = receiver.accept(ms(u32::from(number)), &counted(message, number));
            }
            let old = count - 1 - back;
            let fault = if back == 0 { Fault::Repeated } else { Fault::Sequence };
            let refusal = receiver.accept(ms(50), &counted(message, old)).unwrap_err();
            assert_eq!(refusal.fault, fault, "{message:?} {back}");
            assert!(receiver.accept(ms(60), &counted(message, (old + 1) % count)).is_ok());
        }
    }
}

/// E2E-1c: a frozen sender repeats one frame: refused for ever, never known.
#[test]
fn frozen() {
    for message in protected() {
        let mut receiver = receiver_of(message, &at_once());
        let _ = receiver.accept(ms(0), &counted(message, 0));
        for number in 1..500 {
            let refusal = receiver.accept(ms(number * 10), &counted(message, 0)).unwrap_err();
            assert_eq!(refusal.fault, Fault::Repeated);
        }
    }
}

/// E2E-1c: a command after a gap, and the very first, is refused: an old frame replayed alone is never obeyed. An
/// input begins its requalification with it.
#[test]
fn first_frames() {
    for message in protected() {
        for (gap, first) in [(0, true), (1, false), (timeout(message), false), (timeout(message) + 1, true)] {
            let mut receiver = receiver_of(message, &at_once());
            if gap > 0 {
                let _ = receiver.accept(ms(0), &counted(message, 0));
                let _ = receiver.sample(ms(0));
            }
            // Five steps on: out of sequence, unless it is a first frame.
            let result = receiver.accept(ms(gap), &counted(message, 5)).map_err(|refusal| refusal.fault);
            match (first, message.is_command()) {
                (true, true) => assert_eq!(result, Err(Fault::NoPredecessor), "{message:?} {gap}"),
                (true, false) => assert_eq!(result, Ok(Accepted { message, lost: 0 }), "{message:?} {gap}"),
                (false, _) => assert_eq!(result, Err(Fault::Sequence), "{message:?} {gap}"),
            }
        }
    }
}

fn timeout(message: Message) -> u32 {
    match message.control_time() {
        ControlTime::Ms50 => 125,
        ControlTime::Ms100 => 250,
        ControlTime::Ms200 => 500,
    }
}

/// RULE-5a, E2E-1b: a failed frame makes an input unknown at once, and only until the next good one.
#[test]
fn input_fails_at_once() {
    let mut receiver = Receiver::new(&at_once());
    let inputs = Inputs { seat: [Signal::Known(Seat::Occupied), Signal::NEVER], ..Inputs::NEVER };
    let good = frame(Message::Seat1, &inputs, &Outputs::NEUTRAL, 0);
    let _ = receiver.accept(ms(0), &good);
    assert_eq!(receiver.sample(ms(0)).inputs.seat[0], Signal::Known(Seat::Occupied));
    let broken = Frame::new(good.id, good.payload() ^ 1 << 16);
    assert_eq!(receiver.accept(ms(50), &broken).unwrap_err().fault, Fault::Checksum);
    for now in [50, 60, 90] {
        assert_eq!(receiver.sample(ms(now)).inputs.seat[0], Signal::Unknown(Cause::EndToEnd));
    }
    let _ = receiver.accept(ms(100), &resealed(Message::Seat1, &good, 1));
    assert_eq!(receiver.sample(ms(100)).inputs.seat[0], Signal::Known(Seat::Occupied));
}

/// RULE-5a: the other messages are not touched by a failed frame.
#[test]
fn only_its_own_message() {
    let mut bench = Bench::new(&at_once());
    let mut random = Random::new(5);
    let (inputs, outputs) = (random.inputs(), random.outputs());
    for _ in 0..50 {
        bench.send(&inputs, &Scene::clear(), &fresh(&outputs));
        bench.pass(10);
    }
    let before = *bench.receiver.sample(bench.now).inputs;
    assert_eq!(before, inputs);
    let _ = bench.receiver.accept(bench.now, &Frame::new(Message::Seat2.id(), 0));
    let after = *bench.receiver.sample(bench.now).inputs;
    let seat = [inputs.seat[0], Signal::Unknown(Cause::EndToEnd)];
    assert_eq!(after, Inputs { seat, ..inputs });
}

/// E2E-1b: Profile 11 finds every two flipped bits, and every burst of up to 8 bits behind the CRC.
#[test]
fn profile_11_finds() {
    let message = Message::TargetSpeed;
    let check = |frame: &Frame, counter| bits(resealed(message, frame, counter).payload(), 0, 8);
    let zero = check(&Frame::new(message.id(), 0), 0);
    // The check is linear: what a flipped bit does to it. `resealed` sets the counter itself.
    let syndrome = |bit: u32| match bit {
        0..=7 => 1 << bit,
        8..=11 => check(&Frame::new(message.id(), 0), 1 << (bit - 8)) ^ zero,
        _ => check(&Frame::new(message.id(), 1 << bit), 0) ^ zero,
    };
    let syndromes: Vec<u64> = (0..64).map(syndrome).collect();
    for (second, one) in syndromes.iter().enumerate() {
        assert_ne!(*one, 0);
        assert!(syndromes[..second].iter().all(|other| other != one), "{second}");
    }
    // Bytes go over the bus from 0 to 7, each from its most significant bit.
    let sent: Vec<u64> = (0..64).map(|at| syndromes[at / 8 * 8 + 7 - at % 8]).collect();
    for window in sent[8..].windows(8) {
        for burst in 1..256_u32 {
            let flipped = window.iter().enumerate().filter(|(bit, _)| burst >> bit & 1 == 1);
            assert_ne!(flipped.fold(0, |sum, (_, syndrome)| sum ^ syndrome), 0);
        }
    }
}
