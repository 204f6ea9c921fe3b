//! Time-outs, gaps, requalification, the clock.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

mod common;

use common::*;
use supervisor_core::*;
use supervisor_perceive::Scene;
use supervisor_wire::*;

const TIMING: Timing = Timing { timeout: Millis::new(125), requalify: Millis::new(1000) };

/// E2E-1j: never, requalifying from the first good frame, known once good frames have run for the whole time.
#[test]
fn start() {
    let mut qualifier = Qualifier::NEVER;
    assert_eq!(qualifier.quality(ms(7), TIMING), Err(Cause::NeverReceived));
    for now in (100..1100).step_by(50) {
        qualifier.good(ms(now), TIMING);
        assert_eq!(qualifier.quality(ms(now), TIMING), Err(Cause::Requalifying), "{now}");
    }
    // Not by waiting: by a good frame.
    assert_eq!(qualifier.quality(ms(1100), TIMING), Err(Cause::Requalifying));
    qualifier.good(ms(1100), TIMING);
    assert_eq!(qualifier.quality(ms(1100), TIMING), Ok(ms(0)));
    assert_eq!(qualifier.quality(ms(1125), TIMING), Ok(ms(25)));
}

/// E2E-1j: one millisecond short is short.
#[test]
fn requalify_boundary() {
    for (last, known) in [(999, false), (1000, true)] {
        let mut qualifier = Qualifier::NEVER;
        for now in (0..last).step_by(100).chain([last]) {
            qualifier.good(ms(now), TIMING);
        }
        assert_eq!(qualifier.quality(ms(last), TIMING).is_ok(), known);
    }
}

fn known(now: u32) -> Qualifier {
    let mut qualifier = Qualifier::NEVER;
    for back in (0..=10).rev() {
        qualifier.good(ms(now.wrapping_sub(back * 100)), TIMING);
    }
    assert_eq!(qualifier.quality(ms(now), TIMING), Ok(ms(0)));
    qualifier
}

/// E2E-1g: exactly the time-out is in time, one millisecond more is stale; a gap calls for requalification, whether
/// anybody looked during it or not.
#[test]
fn timeout_boundary() {
    for looked in [false, true] {
        let mut qualifier = known(5000);
        assert_eq!(qualifier.quality(ms(5125), TIMING), Ok(ms(125)));
        qualifier.good(ms(5125), TIMING);
        assert_eq!(qualifier.quality(ms(5125), TIMING), Ok(ms(0)), "no gap");
        if looked {
            assert_eq!(qualifier.quality(ms(5251), TIMING), Err(Cause::Stale));
        }
        qualifier.good(ms(5251), TIMING);
        assert_eq!(qualifier.quality(ms(5251), TIMING), Err(Cause::Requalifying));
    }
}

/// RULE-5a, E2E-1j: a failed frame counts at once; the next good one is enough while known, but not before.
#[test]
fn failures() {
    let mut qualifier = known(5000);
    qualifier.bad(ms(5050), TIMING);
    assert_eq!(qualifier.quality(ms(5050), TIMING), Err(Cause::EndToEnd));
    qualifier.bad(ms(5100), TIMING);
    qualifier.good(ms(5125), TIMING);
    assert_eq!(qualifier.quality(ms(5125), TIMING), Ok(ms(0)));
    // A failed frame is no sign of life.
    qualifier.bad(ms(5200), TIMING);
    assert_eq!(qualifier.quality(ms(5250), TIMING), Err(Cause::EndToEnd));
    assert_eq!(qualifier.quality(ms(5251), TIMING), Err(Cause::Stale));
    // Failed after a gap: requalification has not begun, and begins anew with each failure.
    qualifier.bad(ms(5300), TIMING);
    assert_eq!(qualifier.quality(ms(5300), TIMING), Err(Cause::EndToEnd));
    for now in (5400..6350).step_by(50) {
        qualifier.good(ms(now), TIMING);
        assert_eq!(qualifier.quality(ms(now), TIMING), Err(Cause::Requalifying));
    }
    qualifier.bad(ms(6350), TIMING);
    assert_eq!(qualifier.quality(ms(6400), TIMING), Err(Cause::EndToEnd));
    for now in (6400..7400).step_by(50) {
        qualifier.good(ms(now), TIMING);
        assert_eq!(qualifier.quality(ms(now), TIMING), Err(Cause::Requalifying), "{now}");
    }
    qualifier.good(ms(7400), TIMING);
    assert_eq!(qualifier.quality(ms(7400), TIMING), Ok(ms(0)));
}

/// E2E-1b: frames that fail from the start: failed for as long as they come, then stale.
#[test]
fn failing_from_the_start() {
    let mut qualifier = Qualifier::NEVER;
    for now in (0..2000).step_by(100) {
        qualifier.bad(ms(now), TIMING);
        assert_eq!(qualifier.quality(ms(now), TIMING), Err(Cause::EndToEnd));
    }
    assert_eq!(qualifier.quality(ms(1900 + 125), TIMING), Err(Cause::EndToEnd));
    assert_eq!(qualifier.quality(ms(1900 + 126), TIMING), Err(Cause::Stale));
}

/// END-1b, SELF-3b: stale stays stale, also when the clock comes round to where the last frame was.
#[test]
fn stale_for_ever() {
    let mut qualifier = known(5000);
    assert_eq!(qualifier.quality(ms(5126), TIMING), Err(Cause::Stale));
    assert_eq!(qualifier.quality(ms(5000), TIMING), Err(Cause::Stale));
    // A clock that steps back is a gap.
    let mut qualifier = known(5000);
    assert_eq!(qualifier.quality(ms(4999), TIMING), Err(Cause::Stale));
    let mut qualifier = known(5000);
    qualifier.good(ms(4999), TIMING);
    assert_eq!(qualifier.quality(ms(4999), TIMING), Err(Cause::Requalifying));
}

/// Everything that one run of frames gives: with losses, failures, gaps and changes.
fn run(start: u32) -> Vec<String> {
    let mut bench = Bench::new(&Config::DEFAULT);
    let mut random = Random::new(7);
    bench.now = ms(start);
    let mut seen = Vec::new();
    let (mut inputs, mut outputs, mut scene) = (random.inputs(), random.outputs(), random.scene());
    for cycle in 0..600_u32 {
        if cycle.is_multiple_of(50) {
            (inputs, outputs, scene) = (random.inputs(), random.outputs(), random.scene());
        }
        let silent = (200..240).contains(&cycle);
        let noise = random.next();
        bench.send_but(&inputs, &scene, &fresh(&outputs), |frame| {
            if noise.is_multiple_of(23) {
                frame.data[3] ^= 4;
            }
            !silent && !noise.is_multiple_of(29)
        });
        seen.push(format!("{:?}", bench.receiver.sample(bench.now)));
        bench.pass(10);
    }
    seen
}

/// END-1b, SELF-3b: a wrap of the clock anywhere changes nothing.
#[test]
fn clock_wrap() {
    let reference = run(100_000);
    for before in [0, 10, 90, 1000, 1990, 2400, 3000] {
        let wrapped = run(0_u32.wrapping_sub(before));
        for (cycle, (one, other)) in reference.iter().zip(&wrapped).enumerate() {
            assert_eq!(one, other, "cycle {cycle}, wrap after {before} ms");
        }
    }
}

/// E2E-1g: each message is timed out by the class of its control time, to the millisecond; the others go on.
#[test]
fn every_timeout() {
    let config = at_once();
    for message in Message::ALL.iter().copied().filter(|message| matches!(message.destination(), Destination::Input)) {
        let timeout = match message.control_time() {
            ControlTime::Ms50 => config.timeout_50,
            ControlTime::Ms100 => config.timeout_100,
            ControlTime::Ms200 => config.timeout_200,
        };
        let inputs = Random::new(8).known_inputs();
        let mut receiver = Receiver::new(&config);
        receiver.accept(ms(0), &frame(message, &inputs, &Outputs::NEUTRAL, 0)).unwrap();
        let known = |inputs: &Inputs| format!("{inputs:?}").matches("Known").count();
        let (at, after) = (*receiver.sample(timeout).inputs, *receiver.sample(ms(timeout.raw() + 1)).inputs);
        assert_eq!(known(&at), message.signals().len(), "{message:?}");
        assert_eq!(known(&after), 0, "{message:?}");
        assert_eq!(format!("{after:?}").matches("Stale").count(), message.signals().len());
    }
}

/// E2E-1j: the recorded silence of 2.06 s and the wrong content after it, here in the speed: it is stale, then
/// requalifying through all of the wrong content, and known again after 1 s of frames.
#[test]
fn recorded_gap() {
    let mut receiver = Receiver::new(&Config::DEFAULT);
    let ccvs1 = |high: u8| Frame { id: 0x18FE_F100, length: 8, data: [0xF7, 0, high, 0x0F, 255, 255, 255, 255] };
    let mut seen = Vec::new();
    for now in (0..6000).step_by(10) {
        // As recorded: every 100 ms, silent from 2000 to 4060, then 0.64 s of wrong content: here 250 km/h.
        if now % 100 == 0 && now <= 2000 || now >= 4060 && now % 100 == 60 {
            receiver.accept(ms(now), &ccvs1(if (4060..4700).contains(&now) { 250 } else { 3 })).unwrap();
        }
        let speed = receiver.sample(ms(now)).inputs.wheel_speed;
        if seen.last().is_none_or(|(_, last)| *last != speed) {
            seen.push((now, speed));
        }
    }
    let slow = Signal::Known(SpeedKmhQ8::new(3 << 8));
    assert_eq!(
        seen,
        [
            (0, Signal::Unknown(Cause::Requalifying)),
            (1000, slow),
            (2260, Signal::Unknown(Cause::Stale)),
            (4060, Signal::Unknown(Cause::Requalifying)),
            (5060, slow),
        ]
    );
}

/// E2E-1i: J1939 values and what they mean, at every boundary.
#[test]
fn not_available() {
    const NOT_AVAILABLE: Cause = Cause::NotAvailable;
    let mut receiver = Receiver::new(&at_once());
    let mut read = |id: u32, data: [u8; 8]| {
        receiver.accept(ms(0), &Frame { id, length: 8, data }).unwrap();
        *receiver.sample(ms(0)).inputs
    };
    for raw in 0..=u16::MAX {
        let [low, high] = raw.to_le_bytes();
        let expected = match raw {
            0..=0xFAFF => Signal::Known(SpeedKmhQ8::new(raw)),
            0xFB00..=0xFDFF => Signal::Unknown(Cause::OutOfRange),
            0xFE00..=0xFFFF => Signal::Unknown(NOT_AVAILABLE),
        };
        assert_eq!(read(0x18FE_F100, [0xF7, low, high, 0x0F, 255, 255, 255, 255]).wheel_speed, expected);
    }
    for raw in 0..=u8::MAX {
        let switch = |shift: u8| match raw >> shift & 3 {
            0 => Signal::Known(false),
            1 => Signal::Known(true),
            _ => Signal::Unknown(NOT_AVAILABLE),
        };
        let brakes = read(0x18F0_010B, [raw, 0, 0, 0, 0, raw, 0, 0]);
        assert_eq!((brakes.asr, brakes.abs), (switch(2), switch(4)));
        assert_eq!((brakes.brake_switch, brakes.brake_pedal), (Signal::NEVER, [Signal::NEVER; 2]), "E2E-1f: bare");
        assert_eq!((brakes.ebs_red, brakes.ebs_amber), (switch(2), switch(4)));
    }
}

/// E2E-1i: in our messages the greatest raw value of a signal is "not available", and the frame is still good.
#[test]
fn not_available_of_ours() {
    let mut bench = Bench::new(&at_once());
    bench.send(&Inputs::NEVER, &Scene::default(), &Commands::ABSENT);
    let sample = bench.receiver.sample(ms(0));
    let text = format!("{:?}", sample.inputs);
    assert_eq!(text.matches("NotAvailable").count(), 42, "{text}");
    assert!(!sample.scene.radar_known && !sample.scene.camera_known);
    // The value of a type that the field has no room for is "not available", not another value.
    let full = Inputs {
        motor_speed: Signal::Known(SpeedKmhQ8::new(u16::MAX)),
        steering_angle: Signal::Known(AngleDeciDeg::new(i16::MAX)),
        driver_torque: Signal::Known(TorqueNmQ10::new(-1)),
        drive_limit: Signal::Known(Percent::new(255)),
        ..Inputs::NEVER
    };
    let mut bench = Bench::new(&at_once());
    bench.send(&full, &Scene::default(), &Commands::ABSENT);
    let inputs = bench.receiver.sample(ms(0)).inputs;
    assert_eq!(inputs.motor_speed, Signal::Unknown(Cause::NotAvailable));
    assert_eq!(inputs.steering_angle, Signal::Unknown(Cause::NotAvailable));
    assert_eq!(inputs.driver_torque, Signal::Known(TorqueNmQ10::new(-1)));
    assert_eq!(inputs.drive_limit, Signal::Unknown(Cause::NotAvailable));
}

/// E2E-1e: frames of the recorded bus are taken as they are.
#[test]
fn recorded_frames() {
    let mut receiver = Receiver::new(&at_once());
    for (id, data) in [(0x18F0_010B, 0x4F6C_C3FF_FF01_0BF3_u64), (0x18FE_F100, 0xF700_000F_FFFF_FFFF)] {
        receiver.accept(ms(0), &Frame { id, length: 8, data: data.to_be_bytes() }).unwrap();
    }
    let inputs = receiver.sample(ms(0)).inputs;
    assert_eq!((inputs.abs, inputs.asr), (Signal::Known(false), Signal::Unknown(Cause::NotAvailable)));
    assert_eq!((inputs.ebs_red, inputs.ebs_amber), (Signal::Known(false), Signal::Known(false)));
    assert_eq!(inputs.wheel_speed, Signal::Known(SpeedKmhQ8::ZERO));
}
